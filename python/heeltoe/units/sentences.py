"""Sentences that hold quantities, and are written in SI or in the units of the United States.

A sentence is a template and its quantities in SI: ``"it slides {slip_m:.4g mm} and stops"``. What stands in the braces
is how the quantity is written in SI, format and unit; in the units of the United States it is written in what people
there use for such a quantity, to as many digits. Whatever has no unit, text too, is the same in both.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from string import Formatter
from typing import Any

from heeltoe.units.systems import FOOT, KIP, POUND, Scale, unit_system
from heeltoe.units.write import number

_US = unit_system("us")
_INCH = Scale(12.0 / FOOT, "in")
_KSI_FROM = 1e9
# What units of sentences are in SI, and what kind of quantity they belong to; all forces, energies and masses are per
# metre of dam, whether or not the sentence says so. Other units are the same everywhere.
UNITS: dict[str, tuple[float, str]] = {
    "mm": (1e-3, "displacement"),
    "cm": (1e-2, "displacement"),
    "m": (1.0, "length"),
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
# Digits of what is written in full in SI (format "g"), and the fewest and most of what has fixed decimals there.
_IN_FULL, _FEWEST, _MOST = 4, 3, 5


def scale(quantity: str, largest: float) -> Scale:
    """Return the unit of the United States in which people write a quantity of up to `largest` in SI."""
    if quantity == "acceleration":
        return Scale(1.0 / FOOT, "ft/s²")
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
    spec, _, unit = form.partition(" ")
    values = list(value) if isinstance(value, Sequence) else [value]
    texts = [_in_si(each, spec, unit) for each in values]
    if units == "us" and unit in UNITS:
        to = scale(UNITS[unit][1], max(map(abs, values)))
        texts = [_in_us(to(each), spec, text) for each, text in zip(values, texts, strict=True)]
        unit = to.unit
    listed = texts[0] if len(texts) == 1 else f"{', '.join(texts[:-1])} {word or 'and'} {texts[-1]}"
    return f"{listed} {unit}" if unit else listed


def _in_si(value: float, spec: str, unit: str) -> str:
    factor = UNITS[unit][0] if unit in UNITS else _OTHERS.get(unit, 1.0)
    if factor != 1.0:
        value = value / factor if factor > 1.0 else value * round(1.0 / factor)
    return format(value, spec)


def _in_us(value: float, spec: str, text: str) -> str:
    """Write a number to as many digits as its text in SI has, as far as they say something."""
    precision = spec.strip(".fge")
    if spec.endswith("f"):
        count = min(_MOST, max(_FEWEST, len(text.lstrip("-0.").replace(".", ""))))
    else:
        count = int(precision) + spec.endswith("e") if precision else _IN_FULL
    shown = number(value, count) if abs(value) < 1e6 else f"{float(f'{value:.{count}g}'):.0f}"
    return shown.rstrip("0").rstrip(".") if spec.endswith("g") and "." in shown else shown


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


class _Writer(Formatter):
    """Fills templates, with quantities in one system of units."""

    def __init__(self, units: str) -> None:
        self.units = units

    def format_field(self, value: Any, format_spec: str) -> str:
        if isinstance(value, Sentence):
            return value.text(self.units)
        return value if isinstance(value, str) else quantity(value, format_spec, self.units)


_NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
_QUANTITIES = re.compile(
    rf"(?<![\w.])((?:{_NUMBER}(?:,|[ \u00a0](?:and|to|or))[ \u00a0])*{_NUMBER})([ \u00a0])"
    rf"({'|'.join(sorted(map(re.escape, UNITS), key=len, reverse=True))})(?![\w/²³^])"
)


def us_words(text: str) -> str:
    """Return a sentence with what it says in SI in the units of the United States, to as many digits."""
    return _QUANTITIES.sub(_converted, text.replace("per metre of dam", "per foot of dam"))


def _converted(found: re.Match[str]) -> str:
    factor, quantity = UNITS[found[3]]
    largest = max(abs(float(each)) for each in re.findall(_NUMBER, found[1]))
    to = scale(quantity, largest * factor)
    values = re.sub(_NUMBER, lambda each: _number(each[0], factor * to.factor), found[1])
    return f"{values}{found[2]}{to.unit}"


def _number(text: str, factor: float) -> str:
    figures = len(re.sub(r"\D", "", text.partition("e")[0]).lstrip("0"))
    value, shown = float(text) * factor, min(4, max(2, figures))
    return number(value, shown) if abs(value) < 1e6 else f"{float(f'{value:.{shown}g}'):.0f}"
