"""The content tree on a terminal (rich)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rich.console import Console
from rich.markup import escape
from rich.table import Table as RichTable

from heeltoe.errors.sanitize import harmless
from heeltoe.views.content.tree import (
    Beside,
    Block,
    Code,
    Equation,
    FigureBlock,
    Inline,
    Listing,
    Notes,
    Paragraph,
    References,
    Section,
    Strong,
    Symbol,
    Table,
)
from heeltoe.views.terminal.screen import fits, in_parts, print_items, quiet_table, safe
from heeltoe.views.words.numbers import Value

_NOTICE = {"failure": "red", "warning": "yellow", "note": "dim"}


def render(blocks: Iterable[Block], console: Console) -> None:
    """Print blocks of a content tree; figures and equations are for files alone."""
    for block in blocks:
        if isinstance(block, (FigureBlock, Beside, Equation)):
            continue
        console.print()
        if isinstance(block, Section):
            console.print(f"[bold underline]{safe(block.title)}[/]")
            render(block.blocks, console)
        elif isinstance(block, Paragraph):
            console.print(_inline(block.parts))
        elif isinstance(block, Notes):
            console.print(f"[{_NOTICE[block.kind]}]{safe(block.title)}[/]")
            print_items(map(_inline, block.items), console)
        elif isinstance(block, Table):
            print_table(block, console)
        elif isinstance(block, References):
            print_items((f"{place}. {safe(text)}" for place, text in enumerate(block.items, 1)), console, mark="")
        elif isinstance(block, Listing):
            console.print(escape(harmless(block.text)), soft_wrap=True)


def print_table(table: Table, console: Console) -> None:
    """Print a table below its caption; columns that find no room beside the first go into a table below."""
    if table.caption:
        console.print(safe(table.caption), style="italic", highlight=False)
    for columns in _parts(table, console):
        console.print(_drawn(table, columns))


def _parts(table: Table, console: Console) -> list[list[int]]:
    """Divide the columns of numbers so that none is cut; words wrap."""
    everything = list(range(len(table.head)))
    if table.widths or "r" not in table.align or fits(_drawn(table, everything), console):
        return [everything]
    parts = in_parts(everything[1:], lambda part: fits(_drawn(table, [0, *part]), console))
    return [[0, *part] for part in parts]


def _drawn(table: Table, columns: Sequence[int]) -> RichTable:
    drawn = quiet_table()
    right = [table.align[place : place + 1] == "r" for place in range(len(table.head))]
    for place in columns:
        drawn.add_column(
            safe(table.head[place]),
            justify="right" if right[place] else "left",
            no_wrap=right[place] and not table.widths,
            ratio=int(10 * table.widths[place]) if table.widths else None,
        )
    for row in table.rows:
        drawn.add_row(*(_inline((row[place],)) for place in columns))
    drawn.expand = bool(table.widths)
    return drawn


def _inline(parts: Sequence[Inline]) -> str:
    """Write running text as markup."""
    return "".join(map(_piece, parts)).replace("\u00a0", " ")


def _piece(part: Inline) -> str:
    if isinstance(part, Value):
        return safe(part.text)
    if isinstance(part, Strong):
        return f"[bold]{safe(part.text)}[/]"
    if isinstance(part, Symbol):
        return safe(f"{part.letter}_{part.index}" if part.index else part.letter)
    return safe(part.text if isinstance(part, Code) else part)
