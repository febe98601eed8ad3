"""Friction laws that were fitted to shear tests, in the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Console

from heeltoe.views.content.law_fit import fall_sentence, numbers_of, summary_lines
from heeltoe.views.terminal.screen import label_grid, print_items, print_title, safe

if TYPE_CHECKING:
    from heeltoe.mechanics.law_fit import LawFits


def print_law_fits(fits: LawFits, title: str, console: Console, units: str = "si") -> None:
    """Print the laws with their numbers, what was chosen and why, and the block of a case file."""
    print_title(title, "friction laws from shear tests", console)
    console.print()
    for line in summary_lines(fits, units):
        console.print(line, soft_wrap=True)
    console.print()
    grid = label_grid()
    for fit in fits.fits:
        grid.add_row(fit.law, safe("; ".join([*numbers_of(fit.parameters, units), fit.why])))
    console.print(grid)
    if fits.falls or fits.notes:
        console.print()
    print_items([*map(fall_sentence, fits.falls), *(note.text(units) for note in fits.notes)], console)
    console.print()
    for line in fits.crack.splitlines():
        console.print(line, markup=False, highlight=False, soft_wrap=True)
