"""Ground motion as the kernels take it: both directions on the same moments, up to the end of the run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, among, distinct
from heeltoe.kernel.shaking import Shaking
from heeltoe.motion.ground_motion import GroundMotion


def on_same_moments(series: Sequence[GroundMotion], end: float) -> list[Floats]:
    """Return common moments from zero to `end`, and the values of each motion at them, (n,) each."""
    moments = distinct(np.concatenate([s.time for s in series] + [np.array([end])]))
    moments = moments[moments <= end]
    sides = [_both_sides(s, moments) for s in series]
    jumps = np.any([left != right for left, right in sides], axis=0)
    time = np.repeat(moments, 1 + jumps)
    after = np.zeros(time.size, dtype=bool)
    after[np.flatnonzero(np.diff(time) == 0.0) + 1] = True
    repeated = [(np.repeat(left, 1 + jumps), np.repeat(right, 1 + jumps)) for left, right in sides]
    return [time, *(np.where(after, right, left) for left, right in repeated)]


def step_means(shaking: Shaking, count: int) -> Floats:
    """Return the mean acceleration of each of `count` equal steps from zero to the end, exact for straight pieces.

    Returns
    -------
    ndarray, shape (count, 2)
        Horizontal and vertical [m/s2].
    """
    return _means(shaking, (shaking.horizontal, shaking.up), count)


def cross_means(shaking: Shaking, count: int) -> Floats:
    """Return the same across the valley, (count,) [m/s2]."""
    return _means(shaking, (shaking.cross,), count)[:, 0]


def _means(shaking: Shaking, components: Sequence[Floats | None], count: int) -> Floats:
    time, end = shaking.time, shaking.end
    means = np.zeros((count, len(components)))
    moments = np.linspace(0.0, end, count + 1)
    piece = np.clip(np.searchsorted(time, moments, side="right") - 1, 0, time.size - 2)
    since = moments - time[piece]
    length = time[piece + 1] - time[piece]
    for column, series in enumerate(components):
        if series is None:
            continue
        velocity = np.concatenate([[0.0], np.cumsum(np.diff(time) * (series[1:] + series[:-1]) / 2.0)])
        rise = np.divide(series[piece + 1] - series[piece], length, out=np.zeros(piece.size), where=length > 0.0)
        at = velocity[piece] + since * (series[piece] + rise * since / 2.0)
        means[:, column] = np.diff(at) * (count / end)
    return means


def step_ends(shaking: Shaking, count: int) -> Floats:
    """Return the acceleration at both ends of each of `count` equal steps, (count + 1, 2) [m/s2]; at a jump the mean
    of both sides."""
    time = shaking.time
    moments = np.linspace(0.0, shaking.end, count + 1)
    ends = np.zeros((count + 1, 2))
    for column, series in enumerate((shaking.horizontal, shaking.up)):
        if series is not None:
            left = series[np.clip(np.searchsorted(time, moments, side="left"), 0, time.size - 1)]
            right = series[np.clip(np.searchsorted(time, moments, side="right") - 1, 0, time.size - 1)]
            at_sample = among(moments, time)
            ends[:, column] = np.where(at_sample, (left + right) / 2.0, np.interp(moments, time, series))
    return ends


def _both_sides(motion: GroundMotion, moments: Floats) -> tuple[Floats, Floats]:
    """Return the acceleration right before and right after each moment; outside the record it is zero."""
    t, a = motion.time, motion.acceleration
    before, after = np.zeros(moments.size), np.zeros(moments.size)
    upper = np.searchsorted(t, moments, side="left")
    inside = (upper > 0) & (upper < t.size)
    before[inside] = _between(t, a, upper[inside] - 1, moments[inside])
    lower = np.searchsorted(t, moments, side="right") - 1
    inside = (lower >= 0) & (lower < t.size - 1)
    after[inside] = _between(t, a, lower[inside], moments[inside])
    # The first sample has no past: the record starts there at its own value, without a jump from zero.
    before[moments == t[0]] = a[0] if t.size < 2 or t[1] > t[0] else after[moments == t[0]]
    return before, after


def _between(t: Floats, a: Floats, k: NDArray[np.intp], moments: Floats) -> Floats:
    share = (moments - t[k]) / (t[k + 1] - t[k])
    # Exact at both ends, so that a sample stays the number that was read.
    result: Floats = np.where(share == 1.0, a[k + 1], a[k] + share * (a[k + 1] - a[k]))
    return result
