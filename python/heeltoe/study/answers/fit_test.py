"""Whether a lognormal curve fits the shares of the runs that exceed a limit.

Pearson's chi-square of those shares, held against that of studies which the curve itself made: as many runs of as many
events, each event with a median of its own, fitted again. Runs of one event are not independent, so that no table of
chi-square has the answer.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.blocks import Block, Number
from heeltoe.base.distributions import ndtr
from heeltoe.study.answers.likelihood import SAME, Witnesses, greatest

#: Studies that are made, and the probability below which a curve does not fit.
_MADE, _RARE = 199, 0.05
#: Groups of runs that stand for the strengths where these are more than twice as many.
_GROUPS = 12
#: A dispersion less than this part of the whole is a step.
_STEP = 1e-3


class FitTest(Block):
    """A test of fit."""

    chi_square: Annotated[float, Number("Pearson's chi-square of the shares about the curve.")]
    p: Annotated[
        float, Number("Probability of one as large where the curve is right, from studies that the curve made.")
    ]
    fits: Annotated[bool, Number("Whether that is 5 % or more.")]
    strength: Annotated[float, Number("Strength at which the curve misses by most, relative to chance, in SI.")]
    share: Annotated[float, Number("Share of the runs that exceed there.")]
    fitted: Annotated[float, Number("The same by the curve.")]


@dataclass(frozen=True, eq=False)
class Groups:
    """Runs of one strength each, or of about the same strength where there are many.

    Attributes
    ----------
    place
        (k,) the group of each witness.
    logarithm
        (g,) mean of the strength.
    runs, exceeding
        (g,) how many there are.
    """

    place: Integers
    logarithm: Floats
    runs: Floats
    exceeding: Floats


def groups_of(seen: Witnesses) -> Groups:
    """Return the groups of runs by their strength, the weakest first."""
    levels, place = np.unique(np.rint(seen.logarithm / SAME), return_inverse=True)
    if levels.size > 2 * _GROUPS:
        order = np.argsort(seen.logarithm)
        before = np.empty(order.size)
        before[order] = np.cumsum(seen.runs[order]) - seen.runs[order]
        parts = np.minimum((before * _GROUPS / seen.runs.sum()).astype(np.int64), _GROUPS - 1)
        _, place = np.unique(parts, return_inverse=True)
    runs = _summed(place, seen.runs)
    return Groups(place, _summed(place, seen.logarithm * seen.runs) / runs, runs, _summed(place, seen.exceeding))


def _summed(place: Integers, values: Floats) -> Floats:
    return np.asarray(np.bincount(place, values), dtype=np.float64)


def fit_test(seen: Witnesses, median: float, dispersion: float, record: float | None, other: float | None) -> FitTest:
    """Test a curve.

    Parameters
    ----------
    seen
        Runs and their results.
    median, dispersion
        Median and dispersion of the curve; the median as its logarithm.
    record, other
        Parts of the dispersion, as :class:`heeltoe.study.answers.fragility.Curve` has them.
    """
    group = groups_of(seen)
    expected = _summed(group.place, seen.runs * ndtr((seen.logarithm - median) / dispersion))
    off = _off(group.exceeding, expected, group.runs)
    chi_square = float(np.sum(off**2))
    made = _made(seen, group, median, record or 0.0, dispersion if other is None else other, dispersion)
    p = (1.0 + np.count_nonzero(made >= chi_square * (1.0 - 1e-9))) / (1.0 + _MADE)
    worst = int(np.abs(off).argmax())
    share, fitted = group.exceeding[worst] / group.runs[worst], expected[worst] / group.runs[worst]
    strength = float(np.exp(group.logarithm[worst]))
    return FitTest(
        chi_square=chi_square,
        p=float(p),
        fits=bool(p >= _RARE),
        strength=strength,
        share=float(share),
        fitted=float(fitted),
    )


def _off(exceeding: Floats, expected: Floats, runs: Floats) -> Floats:
    """Return how many standard deviations more runs exceed than a curve has it."""
    share = np.clip(expected / runs, 1e-9, 1.0 - 1e-9)
    return np.asarray((exceeding - runs * share) / np.sqrt(runs * share * (1.0 - share)))


def _made(seen: Witnesses, group: Groups, median: float, record: float, other: float, dispersion: float) -> Floats:
    """Return the chi-squares of studies that the curve made."""
    random = np.random.default_rng(0)
    offset = median + record * random.standard_normal((_MADE, seen.events))
    # Runs of one event in a group count together.
    key, cell = np.unique(group.place * seen.events + seen.event, return_inverse=True)
    place, event = np.divmod(key, seen.events)
    runs = _summed(cell, seen.runs)
    logarithm = _summed(cell, seen.logarithm * seen.runs) / runs
    square = _summed(cell, seen.logarithm**2 * seen.runs) / runs - logarithm**2
    # Strengths of a group differ: as if the dispersion were larger.
    width = np.sqrt(max(other, _STEP * dispersion) ** 2 + np.maximum(square, 0.0))
    chance = ndtr((logarithm - offset[:, event]) / width)
    hits = random.binomial(np.rint(runs).astype(np.int64), chance).astype(np.float64)
    exceeding = np.array([np.bincount(place, row, group.runs.size) for row in hits], dtype=np.float64)
    scale = max(float(group.logarithm.std()), 1e-9)
    z = (group.logarithm - group.logarithm.mean()) / scale
    at = greatest(z, exceeding, group.runs - exceeding, scale)
    expected = group.runs * ndtr(at[:, :1] + at[:, 1:] * z)
    return np.asarray(np.sum(_off(exceeding, expected, group.runs) ** 2, axis=1), dtype=np.float64)
