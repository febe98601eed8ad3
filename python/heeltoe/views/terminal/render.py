"""The content tree on a terminal (rich), and what else all screens have in common."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

from rich import box
from rich.console import Console, RenderableType
from rich.markup import escape
from rich.measure import Measurement
from rich.table import Table as RichTable
from rich.text import Text

from heeltoe.errors.sanitize import harmless, plain
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
from heeltoe.views.words.numbers import Value

T = TypeVar("T")
#: A short screen has at most so many lines, files apart, where it is at least 100 columns wide.
MOST_LINES = 15
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


def safe(text: str) -> str:
    """Return a text as one line of markup that shows it: brackets mean brackets, and no letter moves the cursor.

    Every text of a screen goes through here, whoever has written it.
    """
    return escape(harmless(text).replace("\n", " ").replace("\t", " "))


def print_items(items: Iterable[str], console: Console, mark: str = "-") -> None:
    """Print marked-up texts one below the other, each indented behind its mark."""
    grid = RichTable.grid(padding=(0, 1))
    for item in items:
        grid.add_row(mark, item)
    console.print(grid)


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


def fits(table: RichTable, console: Console) -> bool:
    """Whether no cell of a table is cut."""
    wide = console.options.update(max_width=10_000)
    return Measurement.get(console, wide, table).maximum <= console.width


def in_parts(columns: Sequence[T], fit: Callable[[list[T]], bool]) -> list[list[T]]:
    """Divide columns so that each part fits, as far as one of at least one column does."""
    parts = [list(columns[:1])]
    for column in columns[1:]:
        if fit([*parts[-1], column]):
            parts[-1].append(column)
        else:
            parts.append([column])
    return parts


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


def print_title(title: str, what: str, console: Console) -> None:
    """Print the title of a case, and what is shown of it."""
    # Titles and names are people's words, in which brackets mean brackets.
    console.print(f"[bold]{escape(plain(title) or 'Untitled case')}[/bold]  ({what})", soft_wrap=True)


def quiet_table(*, close: bool = False) -> RichTable:
    """Return an empty table with quiet lines, and with `close` columns where there are many."""
    table = RichTable(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, header_style="dim", border_style="dim")
    if close:
        table.padding = (0, 1, 0, 0)
    return table


def label_grid() -> RichTable:
    """Return an empty list of labels and texts."""
    grid = RichTable.grid(padding=(0, 2))
    grid.add_column(style="dim", no_wrap=True)
    grid.add_column()
    return grid


def label_lines(lines: Iterable[tuple[str, str]]) -> RichTable:
    """Return labels beside their texts."""
    grid = label_grid()
    for label, text in lines:
        grid.add_row(label, text)
    return grid


#: How the note on which outline of a drawing is the dam begins: it is never cut short.
_DRAWN = "section from a drawing: "


class Screen:
    """A console that counts the lines it is given, so that a short screen stays short."""

    def __init__(self, console: Console) -> None:
        self.console = console
        # The title has the first line, and what --details shows the last.
        self.left = MOST_LINES - 2

    def lines(self, block: RenderableType) -> int:
        """Return how many lines a block takes."""
        return len(self.console.render_lines(block, pad=False))

    def add(self, block: RenderableType) -> None:
        """Print a block."""
        self.left -= self.lines(block)
        self.console.print(block)

    def add_warnings(self, texts: Sequence[str], more: str) -> None:
        """Print warnings, the most important first, whole or a line each as there is room, and where the rest is."""
        for text in texts:
            if text.startswith(_DRAWN):
                self.add(Text(text, style="dim"))
        rows = [Text.assemble(("warning", "yellow"), "  ", text) for text in texts if not text.startswith(_DRAWN)]
        needed, rest = sum(map(self.lines, rows)), ""
        if needed > self.left:
            room = max(1, self.left)
            left = max(0, len(rows) - room)
            rows = [_clipped(row, self.console.width) for row in rows[:room]]
            rest = f"{left} more warning{'s' if left > 1 else ''}, " if left else "the warnings in full, "
        elif 0 < needed < self.left:
            self.add(Text(""))
        for row in rows:
            self.add(row)
        print_more(self.console, f"{rest}{more}")


def _clipped(row: Text, width: int) -> Text:
    """Return a line that ends where a clause does, or with a word if no clause of half a line fits."""
    if len(row) <= width:
        return row
    room = row.plain[: width - 2]
    clause = max(room.rfind(mark) for mark in (": ", "; ", ", "))
    end = clause if clause > width // 2 else room.rfind(" ")
    return row[:end] + Text(" …")


def print_warnings(warnings: Iterable[str], console: Console) -> None:
    """Print warnings below what they are about."""
    for place, warning in enumerate(warnings):
        if not place:
            console.print()
        console.print(f"[yellow]warning[/yellow]  {safe(warning)}")


def print_more(console: Console, what: str = "details") -> None:
    """Say where the rest is."""
    console.print(f"--details shows {what}", style="dim", soft_wrap=True)
