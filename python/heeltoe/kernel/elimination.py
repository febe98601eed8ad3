"""Factors of large sparse symmetric matrices with complex entries, as kernels make them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.kernel import _kernel

Complexes = NDArray[np.complex128]


class Pattern:
    """The pattern of a symmetric matrix, in the order in which it is eliminated.

    Parameters
    ----------
    matrix
        In columns (CSC), both sides of the diagonal.
    order
        (N,) its unknowns in that order.
    """

    def __init__(self, matrix: Any, order: Integers) -> None:
        columns = (np.ascontiguousarray(part, dtype=np.int32) for part in (matrix.indptr, matrix.indices, order))
        self._pattern = _kernel.SymmetricPattern(*columns)

    def factors(self, entries: Complexes) -> Factors:
        """Return the factors of the matrix that has these entries in its pattern."""
        return Factors(self._pattern.factors(np.ascontiguousarray(entries).view(np.float64)))


class Factors:
    """Factors of a matrix, made by :meth:`Pattern.factors`."""

    def __init__(self, factors: _kernel.SymmetricFactors) -> None:
        self._factors = factors

    def solve(self, sides: Floats | Complexes) -> Complexes:
        """Return the solutions (N, k) for right sides (N, k)."""
        numbers = np.array(sides, dtype=np.complex128, order="C")
        solved = self._factors.solve(numbers.reshape(-1).view(np.float64), numbers.shape[1])
        result: Complexes = solved.view(np.complex128).reshape(numbers.shape)
        return result
