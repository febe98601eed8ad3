"""A report's document as the page takes it: plain blocks of texts, for a page that makes elements of them."""

from __future__ import annotations

import base64
from typing import Any

from heeltoe.plain import harmless
from heeltoe.views.report.content import (
    Block,
    Code,
    Document,
    FigureBlock,
    Inline,
    Listing,
    Notes,
    Paragraph,
    Section,
    Strong,
    Symbol,
    Table,
)
from heeltoe.views.words.numbers import Value


def told_document(document: Document) -> dict[str, Any]:
    """Return a document; what a page does not show, as references and appendices, is left out."""
    return {"title": document.title, "subtitle": document.subtitle, "blocks": _blocks(document.blocks)}


def _blocks(blocks: tuple[Block, ...]) -> list[dict[str, Any]]:
    return [told for told in map(_block, blocks) if told]


def _block(block: Block) -> dict[str, Any]:
    if isinstance(block, Section):
        if block.title.startswith("Appendix"):
            return {}
        inner = _blocks(block.blocks)
        return {"kind": "section", "title": block.title, "blocks": inner} if inner else {}
    if isinstance(block, Paragraph):
        return {"kind": "paragraph", "parts": _parts(block.parts)}
    if isinstance(block, Notes):
        items = [_parts(item) for item in block.items]
        return {"kind": "notes", "grave": block.kind, "title": block.title, "items": items}
    if isinstance(block, Table):
        rows = [[_parts((cell,)) for cell in row] for row in block.rows]
        return {"kind": "table", "head": list(block.head), "rows": rows, "caption": block.caption, "align": block.align}
    if isinstance(block, FigureBlock):
        data = base64.b64encode(block.svg).decode("ascii")
        return {
            "kind": "figure",
            "name": block.name,
            "caption": block.caption,
            "svg": data,
            "width": block.share * block.size[0],
        }
    if isinstance(block, Listing):
        return {"kind": "listing", "text": block.text}
    return {}


def _parts(parts: tuple[Inline, ...]) -> list[dict[str, str]]:
    return [_part(part) for part in parts]


def _part(part: Inline) -> dict[str, str]:
    if isinstance(part, Code | Strong):
        return {"as": "code" if isinstance(part, Code) else "strong", "text": harmless(part.text)}
    if isinstance(part, Symbol):
        return {"as": "", "text": part.letter + part.index}
    return {"as": "", "text": part.text if isinstance(part, Value) else harmless(part)}
