"""Numbers as people read them, with their units.

A table has one unit for each quantity, that of its largest number: metres above millimetres are misread.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from heeltoe.units.systems import FOOT, Scale, unit_system

NOTHING = "–"
"""Stands where there is no number to show."""
# Digits behind the first of the largest number of a table.
_ALIKE = 3
# What is less than this part of the unit that people chose is what rounding left.
_NOISE = 1e-12


def length(metres: float, units: str = "si") -> str:
    """Write a length as people say it: in m from one metre, else in mm, to no less than a hundredth; in ft from ten
    feet, else in inches."""
    size = abs(metres)
    if units == "us":
        return _us_length(metres)
    if size >= 1.0:
        return f"{metres:.2f} m"
    if size >= 0.9995e-3:
        return f"{1e3 * metres:.1f} mm"
    return f"{1e3 * metres:.2f} mm" if size >= 0.5e-5 or not size else "under 0.01 mm"


def _us_length(metres: float) -> str:
    size = abs(metres) / FOOT
    if size >= 10.0:
        return f"{metres / FOOT:.2f} ft"
    inches = 12.0 * metres / FOOT
    if abs(inches) >= 0.9995:
        return f"{inches:.2f} in"
    if abs(inches) >= 0.04:
        return f"{inches:.3f} in"
    if not inches:
        return "0 in"
    return f"{inches:.4f} in" if abs(inches) >= 2e-4 else "under 0.0004 in"


def lengths(metres: Sequence[float], units: str = "si") -> list[str]:
    """Write the lengths of one table, as :func:`length` does where that gives them all the same unit."""
    return one_unit([length(value, units) for value in metres], metres, "displacement", units)


def one_unit(texts: Sequence[str], values: Sequence[float], quantity: str, units: str) -> list[str]:
    """Write the numbers of one quantity in a table in one unit.

    Parameters
    ----------
    texts
        Each as it is written by itself; they stay where all have one unit.
    values
        The numbers in SI.
    quantity
        As :meth:`heeltoe.units.systems.Units.scale` takes it.
    units
        ``"si"`` or ``"us"``.
    """
    if len({text.rpartition(" ")[2] for text in texts}) < 2:
        return list(texts)
    largest = max(map(abs, values))
    scale = unit_system(units).scale(quantity, largest)
    step = 10.0 ** (math.floor(math.log10(scale(largest))) - _ALIKE)
    return [f"{_to(scale(value), step, quantity == 'displacement')} {scale.unit}" for value in values]


def _to(value: float, step: float, measured: bool) -> str:
    """Write a number to a step, or where it is small to its own first three digits, up to a hundredth of the step;
    smaller values cannot be measured on a dam."""
    if not value:
        return "0"
    own = max(10.0 ** (math.floor(math.log10(abs(value))) - 2), 1e-2 * step)
    decimals = max(0, round(-math.log10(min(step, own))))
    if abs(value) >= 0.5 * 10.0**-decimals:
        return f"{value:.{decimals}f}"
    return f"under {10.0**-decimals:.{decimals}f}" if measured else digits(value, 4)


def speed(metres_per_second: float, units: str = "si") -> str:
    """Write a velocity to two digits."""
    return f"{metres_per_second / FOOT:.2g} ft/s" if units == "us" else f"{metres_per_second:.2g} m/s"


def angle(radians: float) -> str:
    """Write a rotation in mrad: that times the width of the crack in metres is the opening in millimetres; in rad from
    one radian."""
    return f"{radians:.3g} rad" if abs(radians) >= 1.0 else f"{1e3 * radians:.3g} mrad"


def measured(value: float, unit: str, units: str = "si") -> str:
    """Write a number in ``"m"``, ``"rad"`` or ``"g"`` as people say it."""
    if unit == "m":
        return length(value, units)
    return angle(value) if unit == "rad" else f"{value:.3g} {unit}"


def scaled(value: float, scale: Scale, count: int = 3) -> str:
    """Write a value in SI with the unit of a scale, to a number of digits, none cut off before the point."""
    shown = scale(value)
    return f"{'0' if is_noise(shown) else number(shown, count)} {scale.unit}"


def is_noise(value: float) -> bool:
    """Whether a number in the unit in which it is shown is zero but for rounding."""
    return abs(value) < _NOISE


def number(value: float, digits: int = 3) -> str:
    """Write a number to a number of digits, without an exponent where people would write none."""
    if value == 0.0:
        return "0"
    size = abs(value)
    if not 1e-3 <= size < 1e6:
        return f"{value:.{digits}g}"
    rounded = float(f"{value:.{digits}g}")
    decimals = max(0, digits - 1 - int(f"{abs(rounded):e}".rpartition("e")[2]))
    return f"{rounded if decimals else value:.{decimals}f}"


def digits(value: float, count: int) -> str:
    """Write a number to a number of digits, without an exponent where people would write none."""
    if isinstance(value, int):
        return str(value)
    if value == 0.0 or not math.isfinite(value):
        return "0" if value == 0.0 else NOTHING
    if not 1e-4 <= abs(value) < 1e7:
        mantissa, _, exponent = f"{value:.{max(0, count - 2)}e}".partition("e")
        return f"{mantissa}·10{_raised(int(exponent))}"
    rounded = float(f"{value:.{count}g}")
    decimals = max(0, count - 1 - math.floor(math.log10(abs(rounded))))
    text = f"{rounded:.{decimals}f}"
    return text.rstrip("0").removesuffix(".") if decimals else text


def _raised(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
