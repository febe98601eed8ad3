"""The lognormal curve of greatest likelihood through runs that exceed a limit, or do not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.distributions import log_ndtr, ndtri

#: Strengths that differ by rounding are one.
SAME = 1e-9
# Strengths within this part of each other are one for the fit.
_ALIKE = 0.002
#: More than this many different strengths are put together.
_MANY = 20_000
# A dispersion below the first is a step, one beyond the second no curve.
_LEAST, _MOST = 1e-3, 20.0
_ITERATIONS, _CLOSE = 60, 1e-10
# Of an integral over the median of an event.
_NODES = 21


@dataclass(frozen=True)
class Witnesses:
    """Which of the runs of each event exceed a limit at each strength; what is alike is counted together.

    Attributes
    ----------
    logarithm
        (k,) of the strength.
    event
        (k,) place of the event.
    runs, exceeding
        (k,) how many there are, and how many of them exceed.
    """

    logarithm: Floats
    event: Integers
    runs: Floats
    exceeding: Floats

    @property
    def events(self) -> int:
        """How many events."""
        return int(self.event.max()) + 1 if self.event.size else 0


class Tally:
    """Counts part by part which runs exceed a limit; what is alike is counted together, so that it stays small."""

    def __init__(self) -> None:
        self.unknown = 0
        self.lowest, self.highest = np.inf, -np.inf
        self._coarse = False
        self._label, self._logarithm, self._runs, self._exceeding = (np.zeros(0) for _ in range(4))
        self._event = np.zeros(0, dtype=np.int64)

    def add(self, strength: Floats, exceeds: Floats, event: Integers) -> None:
        """Count some runs: strength of the motion, whether they exceed (not a number: not known), event."""
        known = np.isfinite(exceeds)
        self.unknown += int((~known).sum())
        if not known.any():
            return
        strength = strength[known]
        self.lowest, self.highest = min(self.lowest, strength.min()), max(self.highest, strength.max())
        logarithm = np.log(strength)
        label = np.rint(logarithm / _ALIKE) if self._coarse else logarithm
        self._event = np.concatenate([self._event, event[known]])
        self._label = np.concatenate([self._label, label])
        self._logarithm = np.concatenate([self._logarithm, logarithm])
        self._runs = np.concatenate([self._runs, np.ones(label.size)])
        self._exceeding = np.concatenate([self._exceeding, exceeds[known]])
        levels = self._together()
        if levels > _MANY and not self._coarse:
            self._coarse = True
            # Each that has been counted has one strength so far.
            self._label = np.rint(self._logarithm / self._runs / _ALIKE)
            self._together()

    def _together(self) -> int:
        """Count together what has the same label and event, and return how many labels there are."""
        labels, place = np.unique(self._label, return_inverse=True)
        events = int(self._event.max()) + 1
        key, which = np.unique(place * events + self._event, return_inverse=True)
        self._label, self._event = labels[key // events], key % events
        for name in ("_logarithm", "_runs", "_exceeding"):
            setattr(self, name, np.bincount(which, getattr(self, name)))
        return labels.size

    @property
    def runs(self) -> int:
        """How many runs of which it is known."""
        return int(self._runs.sum())

    @property
    def exceeding(self) -> int:
        """How many of them exceed."""
        return int(self._exceeding.sum())

    @property
    def events(self) -> list[int]:
        """Which events its witnesses are of, in the order of their places there."""
        known: list[int] = np.unique(self._event).tolist()
        return known

    @property
    def witnesses(self) -> Witnesses:
        """Known outcomes of the runs."""
        _, event = np.unique(self._event, return_inverse=True)
        return Witnesses(self._logarithm / self._runs, event, self._runs, self._exceeding)


def witnesses(strength: Floats, exceeds: NDArray[np.bool_], event: Integers) -> Witnesses:
    """Count the runs of each event at each strength."""
    tally = Tally()
    tally.add(strength, exceeds.astype(np.float64), event)
    return tally.witnesses


def fit(seen: Witnesses, weight: Floats) -> Floats:
    """Return the logarithm of the median and the dispersion of greatest likelihood.

    Parameters
    ----------
    seen
        What is known.
    weight
        (r, k) how often each of it counts, in r fits side by side.

    Returns
    -------
    ndarray, shape (r, 2)
        Not a number where a fit has none, as strength does not help to exceed the limit.
    """
    # P = Phi(a + b z) with a standard variable z; the likelihood is concave in a and b: Newton's steps, halved as long
    # as they go down. Events at one strength count together, at about one strength where there are many.
    many = seen.logarithm.size > _MANY
    labels, level = np.unique(np.rint(seen.logarithm / _ALIKE) if many else seen.logarithm, return_inverse=True)

    def at_levels(counts: Floats) -> Floats:
        return np.array([np.bincount(level, row, labels.size) for row in weight * counts])

    def summed(values: Floats) -> Floats:
        return np.asarray(np.bincount(level, values, labels.size), dtype=np.float64)

    logarithm = summed(seen.runs * seen.logarithm) / summed(seen.runs)
    middle, scale = np.average(seen.logarithm, weights=seen.runs), max(float(seen.logarithm.std()), 1e-9)
    at = greatest((logarithm - middle) / scale, at_levels(seen.exceeding), at_levels(seen.runs - seen.exceeding), scale)
    slope = np.where(at[:, 1] > scale / _MOST, at[:, 1], np.nan)
    return np.column_stack([middle - scale * at[:, 0] / slope, scale / slope])


def greatest(z: Floats, exceeding: Floats, under: Floats, scale: float) -> Floats:
    """Return a and b of the curves ``P = Phi(a + b z)`` of greatest likelihood, (r, 2).

    Parameters
    ----------
    z
        (k,) standard variable of the strength.
    exceeding, under
        (r, k) how many runs exceed there, and how many do not, in r fits side by side.
    scale
        Scale of the logarithm of the strength over z, by which b has its limits.
    """
    share = exceeding.sum(axis=1) / (exceeding + under).sum(axis=1)
    at = np.column_stack([ndtri(np.clip(share, 1e-3, 1.0 - 1e-3)), np.ones(len(share))])
    value = likelihood(at, z, exceeding, under)
    for _ in range(_ITERATIONS):
        step = _newton(at, z, exceeding, under)
        length = np.ones(len(at))
        for _ in range(30):
            tried = at + length[:, None] * step
            new = likelihood(tried, z, exceeding, under)
            worse = ~(new >= value - 1e-9 * np.abs(value))
            if not worse.any():
                break
            length[worse] /= 2.0
        at, value = tried, new
        # A perfect step goes on for ever: it is one long before.
        if (np.abs(length[:, None] * step).max(axis=1) < _CLOSE * (1.0 + np.abs(at).max(axis=1))).all():
            break
        at[:, 1] = np.clip(at[:, 1], -scale / _LEAST, scale / _LEAST)
    return at


def likelihood(at: Floats, z: Floats, exceeding: Floats, under: Floats) -> Floats:
    """Return the logarithm of the likelihood of curves ``P = Phi(a + b z)``, (r,); `at` is (r, 2)."""
    linear = at[:, :1] + at[:, 1:] * z
    return np.asarray(np.sum(exceeding * log_ndtr(linear) + under * log_ndtr(-linear), axis=1))


def rise(linear: Floats, exceeding: Floats, under: Floats) -> tuple[Floats, Floats]:
    """Return how the logarithm of the likelihood of some runs rises with the argument of their normal distribution, and
    how that falls."""
    density = -0.5 * linear**2 - 0.5 * np.log(2.0 * np.pi)
    up, down = np.exp(density - log_ndtr(linear)), np.exp(density - log_ndtr(-linear))
    return exceeding * up - under * down, exceeding * up * (up + linear) + under * down * (down - linear)


def _newton(at: Floats, z: Floats, exceeding: Floats, under: Floats) -> Floats:
    first, second = rise(at[:, :1] + at[:, 1:] * z, exceeding, under)
    gradient = np.column_stack([first.sum(axis=1), (first * z).sum(axis=1)])
    s0, s1, s2 = (np.sum(second * z**power, axis=1) for power in range(3))
    # A trace of the diagonal keeps a flat likelihood from steps without end.
    s0, s2 = s0 + 1e-9 * (1.0 + s0), s2 + 1e-9 * (1.0 + s2)
    determinant = np.maximum(s0 * s2 - s1**2, 1e-300)
    return np.column_stack(
        [
            (s2 * gradient[:, 0] - s1 * gradient[:, 1]) / determinant,
            (s0 * gradient[:, 1] - s1 * gradient[:, 0]) / determinant,
        ]
    )


def overlap(seen: Witnesses) -> bool:
    """Return whether some run exceeds at less than a strength at which another does not.

    Without that every curve has a steeper one that is as likely or more: the dispersion of greatest likelihood is
    zero (Albert and Anderson 1984, Biometrika 71)."""
    over, under = seen.exceeding > 0.0, seen.exceeding < seen.runs
    highest = float(seen.logarithm[under].max(initial=-np.inf))
    return bool(seen.logarithm[over].min(initial=np.inf) < highest - SAME)


def within(seen: Witnesses, dispersion: float) -> float:
    """Return the dispersion that is left where each event has a median of its own, up to `dispersion` of all.

    Events of which all runs exceed, or none, say nothing of it. It comes out too small where an event has few runs.
    """
    from scipy.optimize import minimize_scalar

    total, hits = (np.bincount(seen.event, counts, seen.events) for counts in (seen.runs, seen.exceeding))
    telling = ((hits > 0.0) & (hits < total))[seen.event]
    if not telling.any():
        return 0.0
    _, event = np.unique(seen.event[telling], return_inverse=True)
    x, runs, exceeding = seen.logarithm[telling], seen.runs[telling], seen.exceeding[telling]
    middles = np.bincount(event, x * runs) / np.bincount(event, runs)
    highest, lowest = np.full(middles.size, -np.inf), np.full(middles.size, np.inf)
    np.maximum.at(highest, event[exceeding < runs], x[exceeding < runs])
    np.minimum.at(lowest, event[exceeding > 0.0], x[exceeding > 0.0])
    if (highest < lowest).all():
        return 0.0  # each event is a step

    def unlikely(logarithm: float) -> float:
        width = float(np.exp(logarithm))
        middle = _middles(middles, width, x, event, runs, exceeding)
        linear = (x - middle[event]) / width
        return -float(np.sum(exceeding * log_ndtr(linear) + (runs - exceeding) * log_ndtr(-linear)))

    limits = (np.log(_LEAST), np.log(max(dispersion, 2.0 * _LEAST)))
    return float(np.exp(minimize_scalar(unlikely, bounds=limits, method="bounded").x))


def _middles(start: Floats, width: float, x: Floats, event: Integers, runs: Floats, exceeding: Floats) -> Floats:
    """Return the median of each event that is most likely where its dispersion is `width`."""
    middle = start.copy()
    for _ in range(_ITERATIONS):
        slope, bend = rise((x - middle[event]) / width, exceeding, runs - exceeding)
        first, second = np.bincount(event, slope), np.bincount(event, bend)
        step = -np.clip(first / np.maximum(second, 1e-12), -1.0, 1.0) * width
        middle += step
        if np.abs(step).max() < 1e-9:
            break
    return middle


def offsets(seen: Witnesses, median: float, record: float, other: float) -> tuple[Floats, Floats]:
    """Return how far the logarithm of the median of each event may lie from that of all, (events, nodes), and how
    probable that is by its runs: normal with the deviation `record` before them, each run exceeding with the dispersion
    `other`.

    The nodes are those of Gauss and Hermite about the most probable offset (Liu and Pierce 1994, Biometrika 81).
    """
    z = seen.logarithm - np.log(median)
    under = seen.runs - seen.exceeding

    def counted(values: Floats) -> Floats:
        return np.asarray(np.bincount(seen.event, values, seen.events), dtype=np.float64)

    offset, width = np.zeros(seen.events), np.zeros(seen.events)
    for _ in range(_ITERATIONS):
        first, second = rise((z - offset[seen.event]) / other, seen.exceeding, under)
        slope = -counted(first) / other - offset / record**2
        bend = counted(second) / other**2 + record**-2
        width = bend**-0.5
        step = np.clip(slope / bend, -record, record)
        offset += step
        if np.abs(step).max() < _CLOSE:
            break
    node, weight = np.polynomial.hermite_e.hermegauss(_NODES)
    places = offset[:, None] + width[:, None] * node
    logarithm = np.empty_like(places)
    for k in range(_NODES):
        linear = (z - places[seen.event, k]) / other
        logarithm[:, k] = counted(seen.exceeding * log_ndtr(linear) + under * log_ndtr(-linear))
    logarithm += np.log(weight) + 0.5 * node**2 - 0.5 * (places / record) ** 2
    chance = np.exp(logarithm - logarithm.max(axis=1, keepdims=True))
    return places, chance / chance.sum(axis=1, keepdims=True)
