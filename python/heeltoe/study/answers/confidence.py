"""How well a share and a fragility curve are known.

A share of runs has the exact bounds of Clopper and Pearson (1934, Biometrika 26). A curve has the region of profile
likelihood: all curves whose logarithm of likelihood lies so little below the greatest that chance makes such a
difference. Runs of one event are no independent witnesses, so the likelihood is made flatter by as much as the curve
differs from event to event (Chandler and Bate 2007, Biometrika 94), which a jackknife over events tells, and the limit
is Student's for the number of events. It is never taken for steeper than independent runs make it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.distributions import betaincinv, stdtrit
from heeltoe.study.answers.likelihood import Witnesses, fit, likelihood, rise

#: Directions in which the edge of a region is looked for, and halvings until it is found.
_RAYS, _HALVINGS = 96, 30
#: Where there are more strengths, those within this part of each other are one.
_MANY, _ALIKE = 500, 0.01
#: Largest variance over that of independent runs, where one event has all that is known.
_WIDEST = 1e6

#: Events that are left out side by side; a dispersion less than this part of the strengths' is a step.
_TOGETHER, _STEP = 64, 0.01
#: Logarithms of strengths beyond this, either way, are no end.
_ENDLESS = 100.0

#: Two ends, None where there is none.
Ends = tuple[float | None, float | None]


def exact_bounds(count: float, of: float, confidence: float) -> tuple[float, float]:
    """Return what a share lies within by Clopper and Pearson, for independent trials.

    Parameters
    ----------
    count, of
        How many of how many.
    confidence
        Probability of the interval, half of the rest on either side.
    """
    tail = (1.0 - confidence) / 2.0
    low = float(betaincinv(count, of - count + 1.0, tail)) if count > 0.0 else 0.0
    high = float(betaincinv(count + 1.0, of - count, 1.0 - tail)) if count < of else 1.0
    return low, high


@dataclass(frozen=True, eq=False)
class Knowledge:
    """Likelihood of a curve ``P = Phi(a + b z)``, z = (ln x - middle) / scale.

    Attributes
    ----------
    middle, scale
        Middle and scale of the logarithm of the strength.
    z, exceeding, under
        (k,) runs at each strength.
    estimate
        (2,) a and b of greatest likelihood.
    information
        (2, 2) of independent runs.
    rays
        (2, 2) columns that span the covariance from event to event.
    events
        How many there are.
    """

    middle: float
    scale: float
    z: Floats
    exceeding: Floats
    under: Floats
    estimate: Floats
    information: Floats
    rays: Floats
    events: int
    _known: dict[float, Floats] = field(default_factory=dict, init=False)

    def region(self, confidence: float) -> Floats:
        """Return the edge of the region that holds the curve with some probability for any one number of it.

        Returns
        -------
        ndarray, shape (n, 2)
            Intercept and slope over the logarithm of the strength. The slope is not negative; where it is zero, the
            runs do not say that stronger motions exceed more often.
        """
        if confidence not in self._known:
            self._known[confidence] = self._edge(confidence)
        return self._known[confidence]

    def _edge(self, confidence: float) -> Floats:
        limit = float(stdtrit(self.events - 1, 0.5 + confidence / 2.0)) ** 2
        angle = np.linspace(0.0, 2.0 * np.pi, _RAYS, endpoint=False)
        ray = np.column_stack([np.cos(angle), np.sin(angle)]) @ self.rays.T
        flatter = 1.0 / np.einsum("ij,jk,ik->i", ray, self.information, ray)
        top = self._likelihood(self.estimate[None])

        def inside(length: Floats) -> Floats:
            return np.asarray(2.0 * flatter * (top - self._likelihood(self.estimate + length[:, None] * ray)) < limit)

        near, far = np.zeros(_RAYS), np.full(_RAYS, math.sqrt(limit))
        for _ in range(_HALVINGS):
            within = inside(far)
            if not within.any():
                break
            far = np.where(within, 2.0 * far, far)
        for _ in range(_HALVINGS):
            half = (near + far) / 2.0
            within = inside(half)
            near, far = np.where(within, half, near), np.where(within, far, half)
        edge = self.estimate + far[:, None] * ray
        # Stronger motions do not exceed less often.
        falling = edge[:, 1] < 0.0
        part = np.ones(_RAYS)
        part[falling] = self.estimate[1] / (self.estimate[1] - edge[falling, 1])
        edge = self.estimate + (part * far)[:, None] * ray
        slope = np.where(falling, 0.0, edge[:, 1] / self.scale)
        return np.column_stack([edge[:, 0] - slope * self.middle, slope])

    def _likelihood(self, at: Floats) -> Floats:
        return likelihood(at, self.z, self.exceeding, self.under)


def knowledge_of(seen: Witnesses, median: float, dispersion: float) -> Knowledge | None:
    """Return what is known of the curve of greatest likelihood; None of a single event.

    Parameters
    ----------
    seen
        Runs and their results.
    median, dispersion
        Median and dispersion of the curve; the median as its logarithm.
    """
    if seen.events < 2:
        return None
    labels, level = np.unique(seen.logarithm, return_inverse=True)
    if labels.size > _MANY:
        labels, level = np.unique(np.rint(seen.logarithm / _ALIKE), return_inverse=True)

    def summed(values: Floats) -> Floats:
        return np.asarray(np.bincount(level, values, labels.size), dtype=np.float64)

    logarithm = summed(seen.runs * seen.logarithm) / summed(seen.runs)
    middle, scale = float(np.average(seen.logarithm, weights=seen.runs)), float(seen.logarithm.std())
    z = (logarithm - middle) / scale
    estimate = np.array([(middle - median) / dispersion, scale / dispersion])
    first, second = rise(estimate[0] + estimate[1] * z[level], seen.exceeding, seen.runs - seen.exceeding)
    of_event = _information(seen, z[level], second)
    information = of_event.sum(axis=0)
    moved = _left_out(seen, middle, scale)
    if moved is None:
        # Without some event there is no curve: one step of Newton's towards it.
        score = np.column_stack([_by_event(seen, first), _by_event(seen, first * z[level])])
        left = (1.0 + 1e-9) * information - of_event
        moved = estimate + np.linalg.solve(left, -score[:, :, None])[:, :, 0]
    rays = _rays(information, moved - estimate)
    exceeding = summed(seen.exceeding)
    return Knowledge(
        *(middle, scale, z, exceeding, summed(seen.runs) - exceeding, estimate, information, rays, seen.events)
    )


def _by_event(seen: Witnesses, values: Floats) -> Floats:
    return np.asarray(np.bincount(seen.event, values, seen.events), dtype=np.float64)


def _information(seen: Witnesses, z: Floats, bend: Floats) -> Floats:
    """Return the information of the runs of each event, (e, 2, 2)."""
    sums = [_by_event(seen, bend * z**power) for power in range(3)]
    return np.stack([sums[0], sums[1], sums[1], sums[2]], axis=1).reshape(-1, 2, 2)


def _left_out(seen: Witnesses, middle: float, scale: float) -> Floats | None:
    """Return a and b with each event left out in turn, (e, 2); None where one of them decides whether there is a
    curve."""
    fits = [
        fit(seen, (np.arange(start, min(start + _TOGETHER, seen.events))[:, None] != seen.event).astype(np.float64))
        for start in range(0, seen.events, _TOGETHER)
    ]
    median, dispersion = np.concatenate(fits).T
    if not np.isfinite(dispersion).all() or (dispersion < _STEP * scale).any():
        return None
    return np.column_stack([(middle - median) / dispersion, scale / dispersion])


def _rays(information: Floats, moved: Floats) -> Floats:
    """Return what spans the covariance from event to event, from how far the curve moves as each event is left out: in
    no direction less than independent runs make it."""
    covariance = (len(moved) - 1.0) / len(moved) * moved.T @ moved
    root = np.linalg.cholesky(information)
    size, direction = np.linalg.eigh(root.T @ covariance @ root)
    return np.asarray(np.linalg.solve(root.T, direction * np.sqrt(np.clip(size, 1.0, _WIDEST))))


def median_ends(region: Floats) -> Ends:
    """Return between which medians a region lies; None where a side has no end."""
    intercept, slope = region.T
    flat = slope <= 0.0
    logarithm = -intercept[~flat] / slope[~flat]
    low, high = float(logarithm.min(initial=np.inf)), float(logarithm.max(initial=-np.inf))
    return (
        None if (intercept[flat] > 0.0).any() or low < -_ENDLESS else math.exp(low),
        None if (intercept[flat] < 0.0).any() or high > _ENDLESS else math.exp(high),
    )


def dispersion_ends(region: Floats) -> Ends:
    """Return between which dispersions a region lies; None where there is no largest one."""
    slope = region[:, 1]
    return float(1.0 / slope.max()), None if slope.min() <= 0.0 else float(1.0 / slope.min())
