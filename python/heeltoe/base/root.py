"""A root between two numbers, by Brent (1973), Algorithms for minimization without derivatives, chapter 4.

The steps are those of ``scipy.optimize.brentq``. That package takes longer to load than the checks that look for roots.
"""

from __future__ import annotations

import math
from collections.abc import Callable

_MOST_STEPS = 100


def find_root(
    function: Callable[[float], float], low: float, high: float, *, xtol: float, rtol: float
) -> tuple[float, int]:
    """Return a root of a function, and the steps of the search.

    Parameters
    ----------
    function
        Has values of different signs at both ends.
    low, high
        Ends of the range.
    xtol, rtol
        Largest error of the root, the latter as a part of its size; both are added.

    Raises
    ------
    ValueError
        Where the values at both ends have one sign.
    RuntimeError
        Where the search does not end.
    """
    # The root lies between `here`, the best point, and `there`; `before` is the one before `here`.
    before, here, there = float(low), float(high), 0.0
    at_before, at_here, at_there = float(function(before)), float(function(here)), 0.0
    if at_before == 0.0:
        return before, 0
    if at_here == 0.0:
        return here, 0
    if _same_sign(at_before, at_here):
        raise ValueError(f"the values at {low} and {high} have one sign")
    step = last_step = 0.0
    for count in range(1, _MOST_STEPS + 1):
        if not _same_sign(at_before, at_here):
            there, at_there = before, at_before
            step = last_step = here - before
        if abs(at_there) < abs(at_here):
            before, here, there = here, there, here
            at_before, at_here, at_there = at_here, at_there, at_here
        least = (xtol + rtol * abs(here)) / 2.0
        half = (there - here) / 2.0
        if at_here == 0.0 or abs(half) < least:
            return here, count
        tried = math.inf
        if abs(last_step) > least and abs(at_here) < abs(at_before):
            tried = _interpolated((before, at_before), (here, at_here), (there, at_there))
        if 2.0 * abs(tried) < min(abs(last_step), 3.0 * abs(half) - least):
            last_step, step = step, tried
        else:
            last_step = step = half
        before, at_before = here, at_here
        here += step if abs(step) > least else math.copysign(least, half)
        at_here = float(function(here))
    raise RuntimeError(f"no root between {low} and {high} after {_MOST_STEPS} steps")


def _same_sign(one: float, other: float) -> bool:
    return math.copysign(1.0, one) == math.copysign(1.0, other)


def _interpolated(before: tuple[float, float], here: tuple[float, float], there: tuple[float, float]) -> float:
    """Return the step to the root of a line through two points, of an inverse parabola through three."""
    (a, at_a), (b, at_b), (c, at_c) = before, here, there
    if a == c:
        return -at_b * (b - a) / (at_b - at_a)
    to_a, to_c = (at_a - at_b) / (a - b), (at_c - at_b) / (c - b)
    return -at_b * (at_c * to_c - at_a * to_a) / (to_c * to_a * (at_c - at_a))
