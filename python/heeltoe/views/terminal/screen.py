"""The parts that all screens of a terminal have in common (rich)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

from rich import box
from rich.console import Console, RenderableType
from rich.markup import escape
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from heeltoe.errors.sanitize import harmless, plain

T = TypeVar("T")
#: A short screen has at most so many lines, files apart, where it is at least 100 columns wide.
MOST_LINES = 15


def safe(text: str) -> str:
    """Return a text as one line of markup that shows it: brackets mean brackets, and no letter moves the cursor.

    Every text of a screen goes through here, whoever has written it.
    """
    return escape(harmless(text).replace("\n", " ").replace("\t", " "))


def print_items(items: Iterable[str], console: Console, mark: str = "-") -> None:
    """Print marked-up texts one below the other, each indented behind its mark."""
    grid = Table.grid(padding=(0, 1))
    for item in items:
        grid.add_row(mark, item)
    console.print(grid)


def fits(table: Table, console: Console) -> bool:
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


def print_title(title: str, what: str, console: Console) -> None:
    """Print the title of a case, and what is shown of it."""
    # Titles and names are people's words, in which brackets mean brackets.
    console.print(f"[bold]{escape(plain(title) or 'Untitled case')}[/bold]  ({what})", soft_wrap=True)


def quiet_table(*, close: bool = False) -> Table:
    """Return an empty table with quiet lines, and with `close` columns where there are many."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, header_style="dim", border_style="dim")
    if close:
        table.padding = (0, 1, 0, 0)
    return table


def label_grid() -> Table:
    """Return an empty list of labels and texts."""
    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="dim", no_wrap=True)
    grid.add_column()
    return grid


def label_lines(lines: Iterable[tuple[str, str]]) -> Table:
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
