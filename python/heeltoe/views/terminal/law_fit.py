"""Friction laws that were fitted to shear tests, in the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rich.console import Console

from heeltoe.units.sentences import counted, written
from heeltoe.views.terminal.render import label_grid, print_items, print_title, safe

if TYPE_CHECKING:
    from heeltoe.mechanics.law_fit import Fall, LawFits, Parameter

_FORMS = {"Pa": "{:.3g MPa}", "m": "{:.3g mm}", "m/s": "{:.3g m/s}"}
_NAMES = {"Pa": "pa", "m": "m", "m/s": "m_s"}


def print_law_fits(fits: LawFits, title: str, console: Console, units: str = "si") -> None:
    """Print the laws with their numbers, what was chosen and why, and the block of a case file."""
    print_title(title, "friction laws from shear tests", console)
    console.print()
    used = "" if fits.used == fits.tests else f", {fits.used} of them fitted"
    console.print(f"{counted(fits.tests, 'test')} of {counted(fits.specimens, 'specimen')}{used}")
    stress = written("{stress_pa:.3g MPa}", units, stress_pa=fits.normal_stress_pa)
    friction = f"{fits.friction:.3f}, 95 % of further tests between {fits.low:.3f} and {fits.high:.3f}"
    console.print(f"apparent friction at a normal stress of {stress}: {friction}", soft_wrap=True)
    console.print()
    grid = label_grid()
    for fit in fits.fits:
        numbers = [f"{number.name} {_shown(number, units)}" for number in fit.parameters]
        grid.add_row(fit.law, safe("; ".join([*numbers, fit.why])))
    console.print(grid)
    if fits.falls or fits.notes:
        console.print()
    print_items([*map(_fall, fits.falls), *(note.text(units) for note in fits.notes)], console)
    console.print()
    for line in fits.crack.splitlines():
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def _fall(fall: Fall) -> str:
    """Say whether the friction falls."""
    chance = f"probability {fall.probability:.2g} where there is none"
    if not fall.found:
        return f"No fall of the friction with {fall.by} is found in {counted(fall.tests, 'test')} ({chance})."
    return f"The friction falls by {fall.friction:.2f} with {fall.by} in {counted(fall.tests, 'test')} ({chance})."


def _shown(number: Parameter, units: str) -> str:
    best, low, high = (_one(value, number.unit, units) for value in (number.value, number.low, number.high))
    return f"{best} ({low} to {high})"


def _one(value: float, unit: str, units: str) -> str:
    if unit == "rad":
        return f"{math.degrees(value):.3g} deg"
    if unit not in _FORMS:
        return f"{value:.3g}"
    name = f"value_{_NAMES[unit]}"
    return written(_FORMS[unit].replace("{:", f"{{{name}:"), units, **{name: value})
