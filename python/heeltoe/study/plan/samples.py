"""The dams of a study, by their number: any stretch of them can be had without those before."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.study.plan.axes import Axis

#: A Latin hypercube of more dams than this is several of this size, one after the other, so that a million million need
#: no more memory than these.
BLOCK = 65536
#: Sobol's sequence has no more points.
MOST_SOBOL = 2**30

Columns = dict[str, NDArray[Any]]


class Samples:
    """Values of all that varies, for dams that are numbered from zero.

    Parameters
    ----------
    axes
        What varies.
    method, count, seed
        Of the study, or ``"table"`` where each axis has a value for every dam; `count` where it draws.
    base
        The value of each axis in the base case, for `one at a time`; None where the case has none.
    correlation
        Pairs of paths with their rank correlation.
    more
        How many shares from 0 to 1 are drawn beside: what the motions need.
    """

    def __init__(
        self,
        axes: Sequence[Axis],
        method: str,
        count: int | None,
        seed: int,
        base: Mapping[str, object] | None = None,
        correlation: Sequence[tuple[str, str, float]] = (),
        more: int = 0,
    ) -> None:
        self._axes, self._method, self._seed, self._more = tuple(axes), method, seed, more
        self._base = base or {}
        self._drawn = count
        self._mixing = _mixing([axis.path for axis in axes], correlation)

    @property
    def count(self) -> int:
        """How many dams."""
        if self._method == "table":
            return len(self._axes[0].values)
        if self._method == "grid":
            return int(np.prod([len(axis.values) for axis in self._axes], dtype=object))
        if self._method == "one at a time":
            return 1 + sum(len(axis.values) for axis in self._axes)
        assert self._drawn is not None
        return self._drawn * (self._dimensions + 2 if self._method == "sensitivity" else 1)

    @property
    def _dimensions(self) -> int:
        return len(self._axes) + self._more

    def at(self, number: NDArray[np.int64]) -> tuple[Columns, Floats]:
        """Return the values of some dams by path, and the shares that are drawn beside, shape (n, more)."""
        if self._method == "table":
            return {axis.path: axis.at(number) for axis in self._axes}, np.zeros((number.size, 0))
        if self._method == "grid":
            return self._grid(number), np.zeros((number.size, 0))
        if self._method == "one at a time":
            return self._one_by_one(number), np.zeros((number.size, 0))
        shares = self._shares(number)
        values = {axis.path: axis.drawn(column) for axis, column in zip(self._axes, shares.T, strict=False)}
        return values, shares[:, len(self._axes) :]

    def _grid(self, number: NDArray[np.int64]) -> Columns:
        sizes = [len(axis.values) for axis in self._axes]
        # The last varies fastest.
        places = np.unravel_index(number, sizes) if sizes else ()
        return {axis.path: axis.at(place) for axis, place in zip(self._axes, places, strict=True)}

    def _one_by_one(self, number: NDArray[np.int64]) -> Columns:
        columns: Columns = {}
        start = 1
        for axis in self._axes:
            place = number - start
            mine = (place >= 0) & (place < len(axis.values))
            values = axis.at(np.where(mine, place, 0))
            columns[axis.path] = np.where(mine, values, np.full(number.size, self._base[axis.path], dtype=values.dtype))
            start += len(axis.values)
        return columns

    def _shares(self, number: NDArray[np.int64]) -> Floats:
        """Return shares from 0 to 1, one column for each axis and for other draws."""
        if not self._dimensions:
            return np.zeros((number.size, 0))
        if self._method == "sensitivity":
            return self._saltelli(number)
        blocks = number // BLOCK
        shares = np.empty((number.size, self._dimensions))
        for block in np.unique(blocks).tolist():
            here = blocks == block
            shares[here] = self._block(block)[number[here] - block * BLOCK]
        return shares if self._mixing is None else self._mixed(shares)

    def _block(self, block: int) -> Floats:
        assert self._drawn is not None
        size = min(BLOCK, self._drawn - block * BLOCK)
        return _block(self._method, self._dimensions, size, self._seed, block)

    def _saltelli(self, number: NDArray[np.int64]) -> Floats:
        """Return rows of the scheme of Saltelli et al. (2010): of each pair of points A and B first A, then B, then A
        with each of its coordinates in turn from B."""
        dimensions = self._dimensions
        assert self._drawn is not None
        pair, which = np.divmod(number, dimensions + 2)
        first = int(pair.min()) if pair.size else 0
        count = int(pair.max()) - first + 1 if pair.size else 0
        rows = _sobol(2 * dimensions, self._seed, first, count)[pair - first]
        one, other = rows[:, :dimensions], rows[:, dimensions:]
        exchanged = (which[:, None] - 2 == np.arange(dimensions)) | (which == 1)[:, None]
        return np.asarray(np.where(exchanged, other, one), dtype=np.float64)

    def _mixed(self, shares: Floats) -> Floats:
        """Correlate columns through normal ones: by the matrix, each column keeping its distribution."""
        from scipy import stats

        assert self._mixing is not None
        size = len(self._mixing)
        normal = stats.norm.ppf(np.clip(shares[:, :size], 1e-12, 1.0 - 1e-12)) @ self._mixing.T
        return np.hstack([stats.norm.cdf(normal), shares[:, size:]])


def _sobol(dimensions: int, seed: int, first: int, count: int) -> Floats:
    """Return points of Sobol's sequence from `first` on."""
    from scipy.stats import qmc

    sequence = qmc.Sobol(dimensions, rng=np.random.default_rng([seed, 0]))
    if first:
        return np.asarray(sequence.fast_forward(first).random(count), dtype=np.float64)
    # From its beginning it gives whole powers of two.
    return np.asarray(sequence.random(1 << max(0, count - 1).bit_length()), dtype=np.float64)[:count]


@lru_cache(maxsize=2)
def _block(method: str, dimensions: int, size: int, seed: int, block: int) -> Floats:
    from scipy.stats import qmc

    if method == "sobol":
        return _sobol(dimensions, seed, block * BLOCK, size)
    cube = qmc.LatinHypercube(dimensions, rng=np.random.default_rng([seed, block]))
    return np.asarray(cube.random(size), dtype=np.float64)


def _mixing(paths: Sequence[str], correlation: Sequence[tuple[str, str, float]]) -> Floats | None:
    """Return what makes independent normal numbers correlated; None where they stay independent.

    Normal numbers with the correlation 2 sin(pi r / 6) have the rank correlation r (Pearson 1907).

    Raises
    ------
    InputError
        Where the correlations contradict each other.
    """
    if not correlation:
        return None
    matrix = np.eye(len(paths))
    for first, second, value in correlation:
        i, j = paths.index(first), paths.index(second)
        matrix[i, j] = matrix[j, i] = 2.0 * np.sin(np.pi * value / 6.0)
    try:
        return np.asarray(np.linalg.cholesky(matrix), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise InputError("study-correlations", "correlation", len(correlation)) from None
