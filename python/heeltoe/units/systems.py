"""Systems of units, SI and that of the United States: one factor and one label for each quantity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from heeltoe.errors.error import InputError

# Exact by definition (NIST Special Publication 811, appendix B.8) [m], [m], [kg], [N].
FOOT, INCH, POUND, POUND_FORCE = 0.3048, 0.0254, 0.45359237, 4.4482216152605
KIP = 1e3 * POUND_FORCE
"""A thousand pounds of force [N]."""

# A quantity has one or more scales (SI value of one unit, its name), from the largest; one is taken whose unit the
# largest value reaches, else the last.
_SI: dict[str, tuple[tuple[float, str], ...]] = {
    "length": ((1.0, "m"),),
    "displacement": ((1.0, "m"), (1e-3, "mm")),
    "velocity": ((1.0, "m/s"),),
    "force": ((1e6, "MN/m"), (1e3, "kN/m")),
    "pressure": ((1e6, "MPa"), (1e3, "kPa")),
    "energy": ((1e6, "MJ/m"), (1e3, "kJ/m"), (1.0, "J/m")),
}
_US: dict[str, tuple[tuple[float, str], ...]] = {
    "length": ((FOOT, "ft"),),
    "displacement": ((FOOT, "ft"), (INCH, "in")),
    "velocity": ((FOOT, "ft/s"),),
    "force": ((KIP / FOOT, "kip/ft"),),
    "pressure": ((POUND_FORCE / INCH**2, "psi"),),
    "energy": ((KIP, "ft-kip/ft"),),
}
_BOTH: dict[str, tuple[tuple[float, str], ...]] = {
    "rotation": ((1.0, "rad"), (1e-3, "mrad")),
}
# How many of a unit the largest value must come to, for that unit to be taken; 1 where nothing is said.
_ENOUGH = {"ft": 10.0, "rad": 0.2, "MPa": 0.1, "MN/m": 0.5, "MJ/m": 0.1, "kJ/m": 0.1}
_SYSTEMS = {"si": _SI | _BOTH, "us": _US | _BOTH}


@dataclass(frozen=True)
class Scale:
    """One unit: `factor` times a value in SI is the number in it."""

    factor: float
    unit: str

    def __call__(self, values: Any) -> Any:
        """Return values in SI as numbers in this unit."""
        return values * self.factor


@dataclass(frozen=True)
class Units:
    """A system of units, ``"si"`` or ``"us"``."""

    name: str

    def scale(self, quantity: str, largest: float | None = None) -> Scale:
        """Return the unit of a quantity for values up to `largest` in SI; the first one where none is given."""
        choices = _SYSTEMS[self.name][quantity]
        if largest is None:
            value, unit = choices[0]
        else:
            reached = (choice for choice in choices if largest >= _ENOUGH.get(choice[1], 1.0) * choice[0])
            value, unit = next(reached, choices[-1])
        return Scale(1.0 / value, unit)


def unit_system(name: str, field: str = "units") -> Units:
    """Return the system of units of this name.

    Raises
    ------
    InputError
        Where it is neither ``"si"`` nor ``"us"``.
    """
    if name not in _SYSTEMS:
        raise InputError("not-a-choice", field, name, choices="si or us")
    return Units(name)
