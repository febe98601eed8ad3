"""One unit for each quantity of a table: metres and millimetres side by side are misread."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from heeltoe.views.content.tree import Block, Inline, Section, Table
from heeltoe.views.words.numbers import Numbers, Value

# What is written in more than one unit of a system.
_SCALED = ("displacement", "force", "pressure", "energy", "rotation")


def with_one_unit(blocks: tuple[Block, ...], numbers: Numbers) -> tuple[Block, ...]:
    """Return blocks whose tables have each quantity in one unit."""
    return tuple(_block(block, numbers) for block in blocks)


def _block(block: Block, numbers: Numbers) -> Block:
    if isinstance(block, Section):
        return replace(block, blocks=with_one_unit(block.blocks, numbers))
    if not isinstance(block, Table):
        return block
    rows = block.rows
    for quantity in _SCALED:
        amounts = list(_values(rows, quantity))
        if len({_unit(amount.text) for amount in amounts}) > 1:
            texts = dict(zip(map(id, amounts), numbers.alike(amounts), strict=True))
            rows = tuple(tuple(texts.get(id(cell), cell) for cell in row) for row in rows)
    return replace(block, rows=rows)


def _values(rows: tuple[tuple[Inline, ...], ...], quantity: str) -> Iterator[Value]:
    return (cell for row in rows for cell in row if isinstance(cell, Value) and cell.quantity == quantity)


def _unit(text: str) -> str:
    return text.rpartition(" ")[2]
