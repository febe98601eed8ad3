"""What all that the terminal shows has in common (rich)."""

from __future__ import annotations

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.motion import GroundMotion


def quiet_table() -> Table:
    """Return an empty table with quiet lines."""
    return Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, header_style="dim", border_style="dim")


def label_grid() -> Table:
    """Return an empty list of labels and texts."""
    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="dim", no_wrap=True)
    grid.add_column()
    return grid


def print_warnings(warnings: tuple[str, ...], console: Console) -> None:
    """Print warnings below what they are about."""
    if warnings:
        console.print()
    for warning in warnings:
        console.print(f"[yellow]warning[/yellow]  {escape(warning)}")


def sampling(motion: GroundMotion) -> str:
    """Say how a motion is sampled."""
    return f"every {motion.dt:.5g} s" if motion.is_uniform else "in unequal steps"
