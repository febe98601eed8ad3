"""Sensitivity of the results: Sobol's indices, and one field at a time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, TypedDict

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number

#: Resamples behind the intervals, and the probability that they mean.
_RESAMPLES, CONFIDENCE = 500, 0.9
#: Pairs of dams that say anything about a variance.
_LEAST = 4


class SobolIndex(Block):
    """Sobol's indices of a field."""

    name: Annotated[str, Number("The field, or `motion` or `strength`.")]
    first: Annotated[float, Number("Share of the variance that it makes by itself.")]
    first_interval: Annotated[list[float], Number("Bounds of that index.")]
    total: Annotated[float, Number("Share of the variance that it makes together with all others.")]
    total_interval: Annotated[list[float], Number("Bounds of that index.")]


class Sobol(Block):
    """Sobol's indices of a number, of one model."""

    rows: Annotated[int, Number("How many rows are behind the indices.")]
    left_out: Annotated[int, Number("How many rows are left out, as a run of theirs has no result.")]
    confidence: Annotated[float, Number("Probability that the intervals mean.")]
    indices: Annotated[list[SobolIndex], Number("The indices, the largest total first; none where nothing varies.")]


class FieldValue(TypedDict):
    """A value of a field as people write it, and the mean of the number with it."""

    value: str
    demand: float


class FieldEffect(TypedDict):
    """Effect of the values of one field, and how far they and the base case are apart."""

    name: str
    span: float
    values: list[FieldValue]


class Tornado(TypedDict):
    """Effect of each field alone, largest span first, with the number of motions behind it, others being left out;
    without any there is no mean of the base case."""

    motions: int
    left_out: int
    base: float | None
    fields: list[FieldEffect]


def sobol_indices(values: Floats, names: Sequence[str], seed: int = 0) -> Sobol:
    """Return Sobol's first and total indices.

    The first is estimated as of Saltelli et al. (2010), the total as of Jansen (1999); what they lie within is that of
    a bootstrap over the rows.

    Parameters
    ----------
    values
        (n, d + 2) of a number: of the point A, of B, and of A with each of its d coordinates in turn from B. Rows in
        which any is not a number are left out whole.
    names
        Of the d dimensions.
    seed
        Of the bootstrap.
    """
    whole = np.isfinite(values).all(axis=1)
    rows = values[whole]
    none = Sobol(rows=len(rows), left_out=len(values) - len(rows), confidence=CONFIDENCE, indices=[])
    if len(rows) < _LEAST or np.ptp(rows) == 0.0:
        return none
    # About the mean: the estimators lose fewer digits there.
    rows = rows - rows[:, :2].mean()
    one, other, exchanged = rows[:, :1], rows[:, 1:2], rows[:, 2:]
    parts = np.hstack([other * (exchanged - one), (one - exchanged) ** 2 / 2.0, (one + other) / 2.0, one**2, other**2])
    first, total = _indices(parts.mean(axis=0)[None, :], len(names))
    random = np.random.default_rng(seed)
    drawn = np.empty((_RESAMPLES, parts.shape[1]))
    for mean in drawn:
        mean[:] = np.bincount(random.integers(len(rows), size=len(rows)), minlength=len(rows)) @ parts / len(rows)
    shares = [(1.0 - CONFIDENCE) / 2.0, (1.0 + CONFIDENCE) / 2.0]
    low_high = [np.nanquantile(draws, shares, axis=0) for draws in _indices(drawn, len(names))]
    indices = [
        SobolIndex(
            name=name,
            first=float(first[0, place]),
            first_interval=low_high[0][:, place].tolist(),
            total=float(total[0, place]),
            total_interval=low_high[1][:, place].tolist(),
        )
        for place, name in enumerate(names)
    ]
    return replace(none, indices=sorted(indices, key=lambda index: -index.total))


def _indices(means: Floats, count: int) -> tuple[Floats, Floats]:
    middle, squares = means[:, -3], (means[:, -2] + means[:, -1]) / 2.0
    # A resample of one row many times over does not vary.
    variance = np.where(squares - middle**2 > 0.0, squares - middle**2, np.nan)[:, None]
    return means[:, :count] / variance, means[:, count : 2 * count] / variance


def tornado(values: Floats, fields: Sequence[tuple[str, Sequence[str]]]) -> Tornado:
    """Return what each field does by itself.

    Parameters
    ----------
    values
        (dams, m) of a number: of the base case, then of each value of each field, in m motions at their strengths.
        Motions in which any dam has no result are left out for all of them, so that like is held against like.
    fields
        Each with its values as people write them, in the order of the dams.
    """
    whole = np.isfinite(values).all(axis=0)
    none: Tornado = {"motions": int(whole.sum()), "left_out": int((~whole).sum()), "base": None, "fields": []}
    if not whole.any():
        return none
    means = values[:, whole].mean(axis=1).tolist()
    bars, start = list[FieldEffect](), 1
    for name, written in fields:
        here = means[start : start + len(written)]
        start += len(written)
        span = max(*here, means[0]) - min(*here, means[0])
        pairs: list[FieldValue] = [{"value": text, "demand": mean} for text, mean in zip(written, here, strict=True)]
        bars.append({"name": name, "span": span, "values": pairs})
    return {**none, "base": means[0], "fields": sorted(bars, key=lambda row: -row["span"])}
