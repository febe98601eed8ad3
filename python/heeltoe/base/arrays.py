"""Kinds of arrays, and what one number and a column of them need alike.

The mechanics of one dam are those of many: where its numbers are columns, (n,) arrays that stand in for floats, the
same sums and products give columns. The functions here do so for what an array has no operator for.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Bools = NDArray[np.bool_]


def finite(value: float) -> float | None:
    """Return a number; None for one that is not a number, or infinite."""
    return value if math.isfinite(value) else None


def median(values: Floats) -> float:
    """Return the median of one number at least; NumPy's own loads masked arrays, which takes longer than a short run.
    With one that is no number the median is none."""
    # Those stand last.
    ordered, half = np.sort(values), values.size // 2
    if np.isnan(ordered[-1]):
        return math.nan
    return float(ordered[half] if values.size % 2 else (ordered[half - 1] + ordered[half]) / 2.0)


def distinct(values: Floats) -> Floats:
    """Return the different ones of some numbers, the smallest first; NumPy's own function loads masked arrays."""
    ordered = np.sort(values)
    first = np.ones(ordered.size, dtype=bool)
    first[1:] = ordered[1:] != ordered[:-1]
    return ordered[first]


def among(values: Floats, others: Floats) -> Bools:
    """Return which of some numbers are among others, of which there is one at least."""
    ordered = np.sort(others)
    place = np.minimum(np.searchsorted(ordered, values), ordered.size - 1)
    found: Bools = ordered[place] == values
    return found


def number(value: object) -> float:
    """Return a sum over an array as the number that it is, or as the column."""
    result: float = value if np.ndim(value) else float(value)  # type: ignore[arg-type, assignment]
    return result


def larger(one: float, other: float) -> float:
    """Return the larger of two numbers, row by row of columns."""
    if isinstance(one, float) and isinstance(other, float):
        return max(one, other)
    result: float = np.maximum(one, other)
    return result


def smaller(one: float, other: float) -> float:
    """Return the smaller of two numbers, row by row of columns."""
    if isinstance(one, float) and isinstance(other, float):
        return min(one, other)
    result: float = np.minimum(one, other)
    return result


def where(holds: bool, this: float, that: float) -> float:
    """Return `this` where something holds, else `that`, row by row of columns."""
    if isinstance(holds, bool | np.bool_):
        return this if holds else that
    result: float = np.where(holds, this, that)
    return result


def ratio(this: float, that: float) -> float:
    """Return the quotient of two numbers, row by row of columns; zero where the divisor is zero."""
    if isinstance(this, float) and isinstance(that, float):
        return this / that if that else 0.0
    shape = np.broadcast_shapes(np.shape(this), np.shape(that))
    result: float = np.divide(this, that, out=np.zeros(shape), where=np.not_equal(that, 0.0))
    return result


def arctan(slope: float) -> float:
    """Return the angle of a slope, row by row of columns [rad]."""
    result: float = math.atan(slope) if isinstance(slope, float) else np.arctan(slope)
    return result
