"""A friction law on the terminal: a sketch of its curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console

from heeltoe.units.sentences import written
from heeltoe.views.terminal.screen import label_grid, print_title

if TYPE_CHECKING:
    from heeltoe.mechanics.law_curve import LawCurve

_WIDE, _HIGH = 60, 12
#: How the places on the curve are written, by what it goes by.
_WRITTEN = {"slip path": "{at:.3g mm}", "slip speed": "{at:.3g m/s}", "normal stress": "{at:.3g MPa}"}
_NAMES = {"slip path": "at_m", "slip speed": "at_m_s", "normal stress": "at_pa"}


def print_law(curve: LawCurve, console: Console, units: str = "si") -> None:
    """Print a sketch of a friction law, and what it comes to."""
    print_title(curve.title, f"law: {curve.law}", console)
    console.print()
    for line in sketch(curve, units):
        console.print(line, markup=False, highlight=False)
    console.print()
    grid = label_grid()
    stress = written("{stress_pa:.3g MPa}", units, stress_pa=curve.normal_stress_pa)
    grid.add_row("before any slip", f"{curve.at_rest:.4g} under a normal stress of {stress}")
    first, last = (f"{friction:.4g}" for friction in (curve.friction[0], curve.friction[-1]))
    steady = float(np.ptp(curve.friction)) == 0.0
    grid.add_row("sliding", first if steady else f"{first} at the left end of the curve, {last} at its right end")
    for source in curve.references:
        grid.add_row("source", source)
    console.print(grid)


def sketch(curve: LawCurve, units: str = "si") -> list[str]:
    """Return the lines of a sketch: apparent friction over its variable."""
    most = 1.05 * max(float(curve.friction.max()), curve.at_rest, 1e-9)
    rows = [[" "] * _WIDE for _ in range(_HIGH)]
    columns = np.linspace(curve.at[0], curve.at[-1], _WIDE)
    for column, value in enumerate(np.interp(columns, curve.at, curve.friction)):
        rows[min(int(value / most * _HIGH), _HIGH - 1)][column] = "*"
    lines = [f"{(k + 1) * most / _HIGH:6.2f} |{''.join(rows[k]).rstrip()}" for k in reversed(range(_HIGH))]
    left, right = (_at(curve, place, units) for place in (curve.at[0], curve.at[-1]))
    axis = left + curve.over.center(_WIDE - len(left) - len(right)) + right
    return ["apparent friction", *lines, "  0.00 +" + "-" * _WIDE, " " * 8 + axis]


def _at(curve: LawCurve, place: float, units: str) -> str:
    name = _NAMES[curve.over]
    return written(_WRITTEN[curve.over].replace("{at:", f"{{{name}:"), units, **{name: float(place)})
