"""Numbers of the JSON as people read them: the names of the contract say what they are and in which unit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from heeltoe.units.systems import FOOT, POUND, unit_system
from heeltoe.units.write import NOTHING, angle, digits, length

# Endings of names, the longest first, and what they mean.
_ENDINGS = {
    "_rad_s2": "angular acceleration",
    "_rad_s": "angular velocity",
    "_pa": "pressure",
    "_m_s2": "acceleration",
    "_m_s": "velocity",
    "_1_s": "rate",
    "_rad": "rotation",
    "_kg": "mass",
    "_m": "displacement",
    "_s": "time",
    "_g": "g",
    "_j": "energy",
    "_n": "force",
}
# Less than this [Pa] is what rounding leaves of no stress.
_NO_PRESSURE = 1e-3
# Digits behind the first of the largest number of a table.
_ALIKE = 3


@dataclass(frozen=True)
class Value:
    """A number of the result, as people read it, that remembers where it stands in the JSON.

    Attributes
    ----------
    key
        Path in the JSON of the result, ``energy.input_j`` or ``flexible.residual_slip_m``.
    number
        What stands there.
    text
        The same with its unit.
    quantity
        What it is a number of, as :meth:`Numbers.text` takes it; empty where the text is more than number and unit.
    shown
        The number as it is shown: the other way round where that reads better.
    """

    key: str
    number: float | int
    text: str
    quantity: str = ""
    shown: float = 0.0


def _to(number: float, step: float) -> str:
    """Write a number to a step, or where it is small to its own first three digits, up to a hundredth of the step."""
    if not number:
        return "0"
    own = max(10.0 ** (math.floor(math.log10(abs(number))) - 2), 1e-2 * step)
    return f"{number:.{max(0, round(-math.log10(min(step, own))))}f}"


class Numbers:
    """Writes the numbers of one result.

    Parameters
    ----------
    data
        The JSON of the result.
    units
        ``"si"`` or ``"us"``.
    """

    def __init__(self, data: Mapping[str, Any], units: str = "si") -> None:
        self.data = data
        self.units = unit_system(units)

    def raw(self, key: str) -> Any:
        """Return what stands in the JSON under a path; None where there is nothing."""
        found: Any = self.data
        for name in key.split("."):
            if isinstance(found, list) and name.isdigit():
                found = found[int(name)] if int(name) < len(found) else None
            else:
                found = found.get(name) if isinstance(found, Mapping) else None
        return found

    def __call__(self, key: str, quantity: str | None = None, *, sign: float = 1.0) -> Value | str:
        """Return a number with its unit; a dash where there is none.

        Parameters
        ----------
        key
            Path in the JSON.
        quantity
            What it is, where its name does not say so.
        sign
            Minus one shows it the other way round.
        """
        number = self.raw(key)
        if number is None or isinstance(number, bool) or not math.isfinite(number):
            return NOTHING
        shown = number if sign > 0.0 else 0.0 - number
        number = number if isinstance(number, int) else float(number)
        what = quantity or kind(key)
        return Value(key, number, self.text(shown, what), what, float(shown))

    def alike(self, values: Sequence[Value]) -> list[Value]:
        """Return numbers of one quantity in one unit, that of the largest, where they were written in several."""
        quantity = values[0].quantity
        most = max(abs(each.number) for each in values)
        scale = self.units.scale(quantity, most)
        step = 10.0 ** (math.floor(math.log10(scale(most))) - _ALIKE) if most else 0.0
        return [replace(each, text=f"{_to(scale(each.shown), step)} {scale.unit}") for each in values]

    def text(self, number: float, quantity: str) -> str:
        """Write a number in SI as people read it, in the report's units."""
        if quantity in ("displacement", "length", "velocity", "force", "pressure", "energy"):
            return self._scaled(number, quantity)
        if quantity == "mass":
            if self.units.name == "us":
                return f"{digits(number * FOOT / POUND / 2e3, 4)} ton/ft"
            return f"{digits(number / 1e3, 4)} t/m"
        if quantity == "acceleration" and self.units.name == "us":
            return f"{digits(number / FOOT, 4)} ft/s²"
        unit = {
            "rotation": "",
            "angular velocity": " rad/s",
            "angular acceleration": " rad/s²",
            "acceleration": " m/s²",
            "rate": " 1/s",
            "time": " s",
            "g": " g",
            "share": " %",
        }.get(quantity, "")
        if quantity == "rotation":
            return angle(number)
        return digits(100.0 * number if quantity == "share" else number, 3 if quantity == "share" else 4) + unit

    def _scaled(self, number: float, quantity: str) -> str:
        if quantity == "displacement":
            return length(number, self.units.name)
        if quantity == "pressure" and abs(number) < _NO_PRESSURE:
            number = 0.0
        scale = self.units.scale(quantity, abs(number))
        return f"{digits(scale(number), 3 if quantity == 'velocity' else 4)} {scale.unit}"


def kind(key: str) -> str:
    """Return what kind of quantity a name of the contract ends in; ``"number"`` where it says nothing."""
    last = key.rpartition(".")[2]
    if last.isdigit() or last in ("mean", "std", "min", "max"):
        last = key.split(".")[-2]
    return next((meaning for ending, meaning in _ENDINGS.items() if last.endswith(ending)), "number")


def headline(value: float | None, kind: str, units: str) -> str:
    """Write a headline number; a dash where there is none, or nothing happens."""
    if not value or not math.isfinite(value):
        return "-"
    return angle(value) if kind == "rotation" else length(value, units)
