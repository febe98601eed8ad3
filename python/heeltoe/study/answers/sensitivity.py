"""What the results depend on: Sobol's indices, and one field at a time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats

#: Resamples behind the intervals, and the probability that they mean.
_RESAMPLES, CONFIDENCE = 500, 0.9
#: Pairs of dams that say anything about a variance.
_LEAST = 4


def sobol_indices(values: Floats, names: Sequence[str], seed: int = 0) -> dict[str, Any]:
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

    Returns
    -------
    dict
        How many ``rows`` are behind it and how many are ``left_out``; ``indices``, the largest total first: none where
        the number does not vary.
    """
    whole = np.isfinite(values).all(axis=1)
    rows = values[whole]
    result: dict[str, Any] = {"rows": len(rows), "left_out": len(values) - len(rows), "confidence": CONFIDENCE}
    if len(rows) < _LEAST or np.ptp(rows) == 0.0:
        return {**result, "indices": []}
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
        {
            "name": name,
            "first": float(first[0, place]),
            "first_interval": low_high[0][:, place].tolist(),
            "total": float(total[0, place]),
            "total_interval": low_high[1][:, place].tolist(),
        }
        for place, name in enumerate(names)
    ]
    return {**result, "indices": sorted(indices, key=lambda index: -float(str(index["total"])))}


def _indices(means: Floats, count: int) -> tuple[Floats, Floats]:
    middle, squares = means[:, -3], (means[:, -2] + means[:, -1]) / 2.0
    # A resample of one row many times over does not vary.
    variance = np.where(squares - middle**2 > 0.0, squares - middle**2, np.nan)[:, None]
    return means[:, :count] / variance, means[:, count : 2 * count] / variance


def tornado(values: Floats, fields: Sequence[tuple[str, Sequence[str]]]) -> dict[str, Any]:
    """Return what each field does by itself.

    Parameters
    ----------
    values
        (dams, m) of a number: of the base case, then of each value of each field, in m motions at their strengths.
        Motions in which any dam has no result are left out for all of them, so that like is held against like.
    fields
        Each with its values as people write them, in the order of the dams.

    Returns
    -------
    dict
        ``motions`` behind it and ``left_out``; the mean of the ``base`` case; ``fields``, that of the largest span
        first, each with the mean at its ``values``.
    """
    whole = np.isfinite(values).all(axis=0)
    result: dict[str, Any] = {"motions": int(whole.sum()), "left_out": int((~whole).sum())}
    if not whole.any():
        return {**result, "base": None, "fields": []}
    means = values[:, whole].mean(axis=1).tolist()
    bars, start = [], 1
    for name, written in fields:
        here = means[start : start + len(written)]
        start += len(written)
        span = max(*here, means[0]) - min(*here, means[0])
        pairs = [{"value": text, "demand": mean} for text, mean in zip(written, here, strict=True)]
        bars.append({"name": name, "span": span, "values": pairs})
    return {**result, "base": means[0], "fields": sorted(bars, key=lambda row: -float(str(row["span"])))}
