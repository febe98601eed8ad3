"""Numbers of the book: as many digits as another machine finds too, and when two texts say the same."""

from __future__ import annotations

import math
import re

from validation.row import Row

#: Said in place of a number that no other machine finds again.
VARIES = "not the same on two machines"
#: Below this a deviation is rounding.
ROUNDING = 1e-9
#: Digits at the least, and at the most.
FEWEST, MOST = 4, 8
_NUMBER = re.compile(r"(< )?([-+]?\d+(?:\.(\d+))?(?:e([-+]?\d+))?)")


def ours(row: Row) -> str:
    """Return our number: a condition's as the power of ten that it stays below, others to what their tolerance asks."""
    if row.digits == 0:
        return VARIES
    if _bounded(row):
        # A share of what is allowed is below the whole of it; how far below depends on the machine's rounding.
        return _below(max(abs(row.ours), 0.1) if row.tolerance == 1.0 else abs(row.ours))
    return number(row, row.ours)


def reference(row: Row) -> str:
    """Return the reference: as it is known from outside, and as our number where it is one of ours."""
    return number(row, row.reference) if row.kind in ("own run", "condition") else f"{row.reference:.9g}"


def number(row: Row, value: float) -> str:
    """Return a number of a row to a hundredth of the row's tolerance."""
    if row.digits is not None:
        return f"{value:.{row.digits}g}"
    step = _step(row) * (abs(row.reference) if row.relative else 1.0)
    digits = FEWEST if step == 0.0 or value == 0.0 else math.floor(math.log10(abs(value) / step)) + 1
    return f"{value:.{min(max(digits, FEWEST), MOST)}g}"


def deviation(row: Row) -> str:
    """Return the deviation to two digits, and no finer than a hundredth of the tolerance."""
    if _bounded(row) or row.digits is not None:
        return ""
    step, value = _step(row), row.deviation
    if row.tolerance == 0.0 == value:
        return "0"
    per_cent = row.relative and step >= 1e-6
    unit, scale = (" %", 100.0) if per_cent else ("", 1.0)
    if abs(value) < step:
        return f"< {scale * step:.3g}{unit}"
    rounded = scale * round(value / step) * step
    digits = max(2, math.floor(math.log10(abs(rounded))) + 1)
    return f"{rounded:+.{digits}g}{unit}"


def tolerance(row: Row) -> str:
    """Return the tolerance, and how far deviations are explained."""
    if row.tolerance is None:
        return "none"
    limits = [row.tolerance] if row.explained is None else [row.tolerance, row.explained]
    texts = [f"{100.0 * limit:.3g} %" if row.relative and limit >= 1e-4 else f"{limit:.2g}" for limit in limits]
    return texts[0] if len(texts) == 1 else f"{texts[0]}; explained to {texts[1]}"


def _step(row: Row) -> float:
    """Return what a deviation is rounded to."""
    if row.tolerance is None:
        return 1e-4
    if row.tolerance == 0.0:
        return ROUNDING
    return max(ROUNDING, 10.0 ** (math.floor(math.log10(row.tolerance)) - 2))


def _bounded(row: Row) -> bool:
    """Whether a number is to be small, and nothing else is asked of it."""
    small = row.tolerance is not None and row.tolerance <= 1e-3
    if row.tolerance == 0.0:
        return False
    return row.reference == 0.0 and not row.relative and abs(row.ours) < 1.0 and (small or row.kind == "condition")


def _below(value: float) -> str:
    """Return the power of ten that a number stays below."""
    return f"< {10.0 ** (math.floor(math.log10(max(value, ROUNDING / 10.0) * 1.001)) + 1):.0e}"


def alike(old: str, new: str, steady: float = 0.0) -> bool:
    """Whether two texts are the same but for one in the last digit of their numbers, or for a part of these; bounds,
    for one power of ten."""
    parts = [_NUMBER.split(text)[::5] for text in (old, new)]
    if parts[0] != parts[1]:
        return False
    pairs = zip(_NUMBER.finditer(old), _NUMBER.finditer(new), strict=True)
    return all(_near(*pair, steady) for pair in pairs)


def _near(old: re.Match[str], new: re.Match[str], steady: float) -> bool:
    if old[1] and new[1]:
        return steady == math.inf or 0.09 < float(old[2]) / float(new[2]) < 11.0
    # What is below a bound is between nothing and one of its last digits.
    a, b = (0.0 if number[1] else float(number[2]) for number in (old, new))
    unit = max(10.0 ** (int(number[4] or 0) - len(number[3] or "")) for number in (old, new))
    # A deviation in per cent moves by what the number moves.
    whole = 100.0 if old.string[old.end() :].startswith(" %") else max(abs(a), abs(b))
    return abs(b - a) <= 1.01 * unit or abs(b - a) <= steady * whole
