"""Sentences in the units of the United States: lengths, forces and the like that stand in them in SI are converted."""

from __future__ import annotations

import re

from heeltoe.units.systems import FOOT, KIP, POUND, Scale, unit_system
from heeltoe.units.write import number

_US = unit_system("us")
_INCH = Scale(12.0 / FOOT, "in")
_KSI_FROM = 1e9
_NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
# What the units of sentences are in SI, and what kind of quantity they belong to.
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
    "J/m": (1.0, "energy"),
    "kJ/m": (1e3, "energy"),
    "MJ/m": (1e6, "energy"),
    "kg/m³": (1.0, "density"),
    "kg/m^3": (1.0, "density"),
    "t/m": (1e3, "mass"),
}
_QUANTITIES = re.compile(
    rf"(?<![\w.])((?:{_NUMBER}(?:,|[ \u00a0](?:and|to|or))[ \u00a0])*{_NUMBER})([ \u00a0])"
    rf"({'|'.join(sorted(map(re.escape, UNITS), key=len, reverse=True))})(?![\w/²³^])"
)


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
