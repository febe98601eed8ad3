"""What all that the terminal shows has in common (rich)."""

from __future__ import annotations

from collections.abc import Iterable

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.plain import plain


def print_title(title: str, what: str, console: Console) -> None:
    """Print the title of a case, and what is shown of it."""
    # Titles and names are people's words, in which brackets mean brackets.
    console.print(f"[bold]{escape(plain(title) or 'Untitled case')}[/bold]  ({what})", soft_wrap=True)


def quiet_table() -> Table:
    """Return an empty table with quiet lines."""
    return Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, header_style="dim", border_style="dim")


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


def print_warnings(warnings: Iterable[str], console: Console) -> None:
    """Print warnings below what they are about."""
    for place, warning in enumerate(warnings):
        if not place:
            console.print()
        console.print(f"[yellow]warning[/yellow]  {escape(warning)}")
