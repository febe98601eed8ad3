"""Sentences that hold quantities, and are written in SI or in the units of the United States.

A sentence is a template and its quantities in SI: ``"it slides {slip_m:.4g mm} and stops"``. What stands in the braces
is how the quantity is written in SI, format and unit; in the units of the United States it is written in what people
there use for such a quantity, to as many digits. Whatever has no unit, text too, is the same in both.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from string import Formatter
from typing import Any

from heeltoe.errors.sanitize import plain
from heeltoe.units.systems import FOOT, KIP, POUND, Scale, unit_system
from heeltoe.units.write import is_noise, number

_US = unit_system("us")
_INCH = Scale(12.0 / FOOT, "in")
_KSI_FROM = 1e9
# What units of sentences are in SI, and what kind of quantity they belong to; all forces, energies and masses are per
# metre of dam, whether or not the sentence says so. Other units are the same everywhere.
UNITS: dict[str, tuple[float, str]] = {
    "mm": (1e-3, "displacement"),
    "cm": (1e-2, "displacement"),
    "m": (1.0, "length"),
    "m²": (1.0, "area"),
    "m/s": (1.0, "velocity"),
    "cm/s": (1e-2, "velocity"),
    "m/s²": (1.0, "acceleration"),
    "m/s^2": (1.0, "acceleration"),
    "N/m": (1.0, "force"),
    "kN/m": (1e3, "force"),
    "MN/m": (1e6, "force"),
    "N/m²": (1.0, "stiffness"),
    "N/m^2": (1.0, "stiffness"),
    "Pa": (1.0, "pressure"),
    "kPa": (1e3, "pressure"),
    "MPa": (1e6, "pressure"),
    "GPa": (1e9, "pressure"),
    "J": (1.0, "energy"),
    "J/m": (1.0, "energy"),
    "kJ/m": (1e3, "energy"),
    "MJ/m": (1e6, "energy"),
    "kg/m³": (1.0, "density"),
    "kg/m^3": (1.0, "density"),
    "t/m": (1e3, "mass"),
}
# The same everywhere, but not SI units themselves.
_OTHERS = {"ms": 1e-3, "%": 1e-2}
# A displacement from this on is written in metres [m].
_METRES_FROM = 1.0
# Digits of what is written in full in SI (format "g").
_IN_FULL = 4
# Words within a sentence may be sentences themselves.
_LONGEST = 2000


def scale(quantity: str, largest: float) -> Scale:
    """Return the unit of the United States in which people write a quantity of up to `largest` in SI."""
    if quantity == "acceleration":
        return Scale(1.0 / FOOT, "ft/s²")
    if quantity == "area":
        return Scale(1.0 / FOOT**2, "ft²")
    if quantity == "density":
        return Scale(FOOT**3 / POUND, "lb/ft³")
    if quantity == "mass":
        return Scale(FOOT / POUND / 2e3, "ton/ft")
    if quantity == "stiffness":
        return Scale(FOOT**2 / KIP, "kip/ft²")
    if quantity == "pressure" and abs(largest) >= _KSI_FROM:
        return Scale(_US.scale("pressure").factor / 1e3, "ksi")
    if quantity == "length" and 0.0 < abs(largest) < FOOT:
        return _INCH
    return _US.scale(quantity, abs(largest))


def quantity(value: float | Sequence[float], form: str, units: str = "si") -> str:
    """Write a quantity in SI, or several of a kind, as a form says.

    Parameters
    ----------
    value
        The number, or numbers, in SI.
    form
        Format and unit as SI has them: ``".4g mm"``. Several numbers share a unit and are joined by "and", or by the
        word behind a stroke: ``".4g mm|to"``.
    units
        ``"si"`` or ``"us"``.
    """
    form, _, word = form.partition("|")
    texts, unit = numbers(list(value) if isinstance(value, Sequence) else [value], form, units)
    text = listed(texts, word or "and")
    return f"{text} {unit}" if unit else text


def listed(parts: Sequence[str], word: str = "and") -> str:
    """Write things one after the other, with a word before the last."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} {word} {parts[-1]}"


def counted(count: int, what: str) -> str:
    """Write how many of something there are."""
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def numbers(values: Sequence[float], form: str, units: str = "si") -> tuple[list[str], str]:
    """Write quantities of a kind, see :func:`quantity`; return the numbers and the unit that they share."""
    spec, _, unit = form.partition(" ")
    si = UNITS[unit][0] if unit in UNITS else _OTHERS.get(unit, 1.0)
    if units == "us" and unit in UNITS:
        to = scale(UNITS[unit][1], max(map(abs, values), default=0.0))
        return [_in_us(to(value), spec, si * to.factor) for value in values], to.unit
    if unit == "mm" and max(map(abs, values), default=0.0) >= _METRES_FROM:
        # As heeltoe.units.write.length says it: limits and slips of one size are in one unit everywhere.
        return [_in_si(value, ".2f" if spec.endswith("f") else spec) for value in values], "m"
    # Whole factors leave round numbers round.
    return [_in_si(value / si if si > 1.0 else value * round(1.0 / si), spec) for value in values], unit


def _in_si(value: float, spec: str) -> str:
    """Write a number by its format, without an exponent where people would write none."""
    if not spec.endswith("g"):
        return format(value, spec)
    if is_noise(value):
        return "0"
    text = format(value, spec)
    return f"{float(text):.0f}" if "e" in text and 1.0 <= abs(value) < 1e6 else text


def _in_us(value: float, spec: str, step: float) -> str:
    """Write a number in another unit, of which `step` are one in SI, as finely as its format writes it in SI."""
    precision = spec.strip("z.fge")
    if spec.endswith("f"):
        # Never coarser than twice what the decimals in SI tell apart.
        decimals = max(0, math.ceil(int(precision) - math.log10(2.0 * step)))
        return f"{value:z.{decimals}f}"
    count = int(precision) + spec.endswith("e") if precision else _IN_FULL
    if spec.endswith("g") and is_noise(value):
        return "0"
    shown = number(value, count) if abs(value) < 1e6 else f"{float(f'{value:.{count}g}'):.0f}"
    return shown.rstrip("0").rstrip(".") if spec.endswith("g") and "." in shown and "e" not in shown else shown


@dataclass(frozen=True)
class Sentence:
    """A sentence with its quantities.

    Attributes
    ----------
    template
        What it says; ``{name:form}`` stands for a quantity, see :func:`quantity`, and ``{name}`` for words.
    quantities
        Names with numbers in SI, several numbers of a kind, words, or sentences within this one.
    """

    template: str
    quantities: tuple[tuple[str, Any], ...] = ()

    @classmethod
    def of(cls, template: str, **quantities: Any) -> Sentence:
        """Make a sentence of a template and its quantities by name."""
        return cls(template, tuple(quantities.items()))

    def text(self, units: str = "si") -> str:
        """Return what it says in units ``"si"`` or ``"us"``."""
        return _Writer(units).vformat(self.template, (), dict(self.quantities))

    def __str__(self) -> str:
        return self.text()

    def to_json(self) -> str:
        """Return what it says in SI."""
        return self.text()


def written(template: str, units: str, /, **quantities: Any) -> str:
    """Return what a sentence with these quantities says in some units, see :class:`Sentence`."""
    return Sentence.of(template, **quantities).text(units)


class _Writer(Formatter):
    """Fills templates, with quantities in one system of units."""

    def __init__(self, units: str) -> None:
        self.units = units

    def format_field(self, value: Any, format_spec: str) -> str:
        if isinstance(value, Sentence):
            return value.text(self.units)
        return plain(value, _LONGEST) if isinstance(value, str) else quantity(value, format_spec, self.units)
