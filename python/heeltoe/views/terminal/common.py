"""What all that the terminal shows has in common (rich)."""

from __future__ import annotations

from copy import copy
from typing import Any, cast

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.motion.ground_motion import GroundMotion


class _InUnits:
    """Prints what a console prints, with quantities in the units of the United States; people's own words stay."""

    def __init__(self, console: Console, own: str) -> None:
        self._console = console
        self._own = own

    def print(self, *things: Any, **options: Any) -> None:
        self._console.print(*map(self._changed, things), **options)

    def _changed(self, thing: Any) -> Any:
        if isinstance(thing, str):
            return self._words(thing)
        if isinstance(thing, Table):
            changed = copy(thing)
            changed.caption = self._changed(thing.caption)
            changed.columns, changed.rows = [column.copy() for column in thing.columns], []
            cells = zip(*(column.cells for column in thing.columns), strict=True)
            for row, texts in zip(thing.rows, cells, strict=True):
                changed.add_row(*map(self._changed, texts), style=row.style, end_section=row.end_section)
            return changed
        return thing

    def _words(self, text: str) -> str:
        from heeltoe.units.sentences import us_words

        return self._own.join(map(us_words, text.split(self._own))) if self._own else us_words(text)


def in_units(console: Console, units: str, own: str) -> Console:
    """Return what prints on a console in units ``"si"`` or ``"us"``; `own` are words in which no unit is meant."""
    return console if units == "si" else cast(Console, _InUnits(console, escape(own)))


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
