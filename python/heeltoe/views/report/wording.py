"""Sentences of a report in the units of the United States."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from heeltoe.units.sentences import us_words
from heeltoe.views.report.content import Block, FigureBlock, Inline, Notes, Paragraph, Section, Table


def reworded(blocks: tuple[Block, ...], words: Callable[[str], str] = us_words) -> tuple[Block, ...]:
    """Return blocks with all their own sentences changed; numbers of the JSON, code and people's words stay."""

    def part(each: Inline) -> Inline:
        return words(each) if isinstance(each, str) else each

    def block(each: Block) -> Block:
        if isinstance(each, Section):
            return replace(each, blocks=reworded(each.blocks, words))
        if isinstance(each, Paragraph):
            return replace(each, parts=tuple(map(part, each.parts)))
        if isinstance(each, Notes):
            return replace(each, items=tuple(tuple(map(part, item)) for item in each.items))
        if isinstance(each, Table):
            rows = tuple(tuple(map(part, row)) for row in each.rows)
            return replace(each, rows=rows, caption=words(each.caption))
        return replace(each, caption=words(each.caption)) if isinstance(each, FigureBlock) else each

    return tuple(map(block, blocks))
