"""Numbers of the JSON as people read them: the names of the contract say what they are and in which unit."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from heeltoe.base.blocks import ending_of
from heeltoe.units.systems import FOOT, POUND, unit_system
from heeltoe.units.write import NOTHING, angle, digits, length, one_unit

#: Kind of a number, by its SI unit.
QUANTITIES = {
    "": "number",
    "rad/s²": "angular acceleration",
    "rad/s": "angular velocity",
    "m/s²": "acceleration",
    "m/s": "velocity",
    "N s per metre of dam": "impulse",
    "1/s": "rate",
    "rad": "rotation",
    "N m per metre of dam": "moment",
    "m²": "area",
    "kg per metre of dam": "mass",
    "Pa": "pressure",
    "Hz": "frequency",
    "m": "displacement",
    "s": "time",
    "g": "g",
    "J per metre of dam": "energy",
    "N per metre of dam": "force",
}
#: Units by the endings of names, the longest first.
ENDINGS = {ending_of(unit): unit for unit in sorted(QUANTITIES, key=lambda unit: -len(ending_of(unit))) if unit}
# Less than this [Pa] is what rounding leaves of no stress.
_NO_PRESSURE = 1e-3


@dataclass(frozen=True)
class Value:
    """A number of the result, as people read it, that remembers where it stands in the JSON.

    Attributes
    ----------
    key
        Path in the JSON of the result, ``energy.input_j`` or ``static.sliding_safety_factor``.
    number
        What stands there.
    text
        The same with its unit.
    quantity
        Quantity of the number, as :meth:`Numbers.text` takes it; empty where the text is more than number and unit.
    shown
        The number as it is shown: the other way round where that reads better.
    """

    key: str
    number: float | int
    text: str
    quantity: str = ""
    shown: float = 0.0


class Numbers:
    """Writes the numbers of one result.

    Parameters
    ----------
    data
        The JSON of the result.
    units
        ``"si"`` or ``"us"``.
    """

    def __init__(self, data: Mapping[str, object], units: str = "si") -> None:
        self.data = data
        self.units = unit_system(units)

    def raw(self, key: str) -> Any:
        """Return what stands in the JSON under a path; None where there is nothing."""
        data: Any = self.data
        for name in key.split("."):
            if isinstance(data, list) and name.isdigit():
                data = data[int(name)] if int(name) < len(data) else None
            else:
                data = data.get(name) if isinstance(data, Mapping) else None
        return data

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
        if what == "pressure" and abs(shown) < _NO_PRESSURE:
            shown = 0.0
        return Value(key, number, self.text(shown, what), what, float(shown))

    def alike(self, values: Sequence[Value]) -> list[Value]:
        """Return numbers of one quantity in one unit, that of the largest, where they were written in several."""
        texts, shown = [amount.text for amount in values], [amount.shown for amount in values]
        written = one_unit(texts, shown, values[0].quantity, self.units.name)
        return [replace(amount, text=text) for amount, text in zip(values, written, strict=True)]

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
        scale = self.units.scale(quantity, abs(number))
        return f"{digits(scale(number), 3 if quantity == 'velocity' else 4)} {scale.unit}"


def kind(key: str) -> str:
    """Return what kind of quantity a name of the contract ends in; ``"number"`` where it says nothing."""
    last = key.rpartition(".")[2]
    if last.isdigit() or last in ("mean", "std", "min", "max"):
        last = key.split(".")[-2]
    return QUANTITIES[next((unit for ending, unit in ENDINGS.items() if last.endswith(ending)), "")]


@dataclass(frozen=True)
class Amount:
    """A number of a table whose unit depends on the others there.

    Attributes
    ----------
    value
        In SI; None where there is none.
    kind
        ``"slip"``, ``"opening"`` or ``"rotation"``.
    zero
        What stands for nothing.
    """

    value: float | None
    kind: str = "slip"
    zero: str = "-"

    @property
    def quantity(self) -> str:
        """Quantity of the number, as :meth:`heeltoe.units.systems.Units.scale` takes it."""
        return "rotation" if self.kind == "rotation" else "displacement"

    def text(self, units: str) -> str:
        """Write it by itself."""
        assert self.value is not None
        return angle(self.value) if self.kind == "rotation" else length(self.value, units)


#: What stands in a cell: words, a number, or several of these one behind the other.
Cell = str | Amount | tuple[str | Amount, ...]


def in_one_unit(rows: Iterable[Sequence[Cell]], units: str) -> list[list[str]]:
    """Write the cells of one table, each quantity in one unit; a dash where a number is missing or endless."""
    table = [[cell if isinstance(cell, tuple) else (cell,) for cell in row] for row in rows]
    amounts: dict[str, dict[Amount, str]] = {}
    for part in (part for row in table for cell in row for part in cell):
        if isinstance(part, Amount) and part.value and math.isfinite(part.value):
            amounts.setdefault(part.quantity, {})[part] = part.text(units)
    texts: dict[Amount, str] = {}
    for quantity, group in amounts.items():
        values = [part.value or 0.0 for part in group]
        texts |= zip(group, one_unit(list(group.values()), values, quantity, units), strict=True)

    def text(part: str | Amount) -> str:
        return part if isinstance(part, str) else texts.get(part, "-" if part.value is None else part.zero)

    return [["".join(map(text, cell)) for cell in row] for row in table]
