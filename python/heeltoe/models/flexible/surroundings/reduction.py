"""Few unknowns for a large linear body: the shapes it takes at chosen frequencies, and the error that they leave.

A body ``M x'' + C x' + K x = B u`` with symmetric matrices, M and K positive definite and C positive semidefinite,
that is seen through ``B^T x`` alone is projected on a few real shapes V:

    V^T M V,    V^T C V,    V^T K V.

They stay symmetric and positive, so what is reduced takes energy as the body does, never gives any (passivity by
congruence), and as inputs and outputs are the same the error of the answer is of second order in what V lacks. V are
the main directions of real and imaginary parts of answers at chosen frequencies (proper orthogonal decomposition of a
rational Krylov space; Antoulas, Approximation of Large-Scale Dynamical Systems, SIAM 2005)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from heeltoe.base.arrays import Floats

Sparse = Any
"""A matrix of scipy.sparse, which has no types of its own."""
Complexes = Any
"""A complex array."""

# Each has factors of its own in memory.
_THREADS = 4
# Directions with less than this part of the energy of others are rounding.
_NOTHING = 1e-13


@dataclass(frozen=True, eq=False)
class LinearBody:
    """Symmetric matrices of a body of N unknowns: mass, damping and stiffness."""

    mass: Sparse
    damping: Sparse
    stiffness: Sparse

    def response(self, rate: complex, forces: Floats) -> Complexes:
        """Return the amplitudes (N, k) under forces (N, k) that go like exp(rate t), mostly of rate i omega."""
        operator = self.stiffness + rate * self.damping + rate**2 * self.mass
        options = {"SymmetricMode": True}
        factors = splu(sparse.csc_matrix(operator), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options=options)
        return factors.solve(forces.astype(complex))


def reduced_modes(
    body: LinearBody,
    inputs: Floats,
    norm: Sparse,
    sampled: Sequence[complex],
    between: Sequence[complex],
    most: int,
    enough: float,
    static: Floats | None = None,
) -> tuple[tuple[Floats, Floats], float]:
    """Return a body in few of its shapes, as :meth:`Projected.modes` gives them, and the error that these leave.

    Parameters
    ----------
    body
        Of N unknowns.
    inputs
        B, (N, k).
    norm
        From :func:`norm_of`.
    sampled, between
        Rates of the answers that the shapes are made of, and those at which the error is measured.
    most
        How many shapes there may be beside the static ones.
    enough
        Relative error that may remain.
    static
        Shapes (N, j) that are kept whatever the answers are.
    """
    # Side by side: factorising lets go of the interpreter, and each answer is the same on however many threads.
    with ThreadPoolExecutor(min(_THREADS, os.cpu_count() or 1)) as pool:
        answers = list(pool.map(lambda rate: body.response(rate, inputs), sampled))
        seen = list(pool.map(lambda rate: inputs.T @ body.response(rate, inputs), between))
    columns = [real_columns(answer / size_of(answer, norm)) for answer in answers]
    snapshots = np.column_stack(columns) if columns else np.empty((inputs.shape[0], 0))
    first, least = (0, inputs.shape[1]) if static is None else (static.shape[1], static.shape[1])
    projected = Projected.of(body, main_shapes(norm, snapshots, static)[:, : first + most])
    kept, error = enough_shapes(projected, inputs, dict(zip(between, seen, strict=True)), enough, least)
    return kept.modes(), error


def main_shapes(norm: Sparse, snapshots: Floats, first: Floats | None = None) -> Floats:
    """Return the main directions of answers of a body, most important first.

    Parameters
    ----------
    norm
        Positive definite (N, N), in which the directions are orthonormal; from :func:`norm_of`.
    snapshots
        Real answers (N, k).
    first
        Shapes (N, j) that are kept whatever the snapshots are; they come first.
    """
    head = np.empty((snapshots.shape[0], 0))
    if first is not None:
        head = _directions(norm, first, 0.0)
        for _ in range(2):
            snapshots = snapshots - head @ (head.T @ (norm @ snapshots))
    return np.column_stack([head, _directions(norm, snapshots, _NOTHING)]) if snapshots.size else head


def norm_of(body: LinearBody, omega: float, weight: Floats) -> Sparse:
    """Return the norm ``w (K + omega^2 M) w`` in which answers are compared; weights w (N,) fall with the distance from
    where the answer is seen."""
    scale = sparse.diags(weight)
    return sparse.csr_matrix(scale @ (body.stiffness + omega**2 * body.mass) @ scale)


@dataclass(frozen=True, eq=False)
class Projected:
    """A body in shapes (N, m): its matrices of mass, damping and stiffness there, (m, m)."""

    shapes: Floats
    mass: Floats
    damping: Floats
    stiffness: Floats

    @classmethod
    def of(cls, body: LinearBody, shapes: Floats) -> Projected:
        """Return a body in shapes."""
        return cls(shapes, *(congruent(matrix, shapes) for matrix in (body.mass, body.damping, body.stiffness)))

    def first(self, count: int) -> Projected:
        """Return it in its first shapes alone."""
        some = slice(0, count)
        return Projected(
            self.shapes[:, some], self.mass[some, some], self.damping[some, some], self.stiffness[some, some]
        )

    def response(self, rate: complex, forces: Complexes) -> Complexes:
        """Return the amplitudes (m, k) of the shapes under forces on them that go like exp(rate t)."""
        return np.linalg.solve(self.stiffness + rate * self.damping + rate**2 * self.mass, forces.astype(complex))

    def modes(self) -> tuple[Floats, Floats]:
        """Return the squared frequencies (m,) without damping and the mass-normalised shapes (N, m)."""
        squares, mixed = scipy.linalg.eigh(self.stiffness, self.mass)
        return np.maximum(squares, 0.0), self.shapes @ mixed


def enough_shapes(
    projected: Projected, inputs: Floats, exact: dict[complex, Complexes], enough: float, least: int
) -> tuple[Projected, float]:
    """Return a body in as few of its first shapes as leave a small error, and that error.

    The error is that of the answers ``B^T x`` to inputs B, each compared with its own size and that of the input it is
    seen through: the largest of all pairs of inputs at all rates.

    Parameters
    ----------
    projected
        In as many shapes as there may be.
    inputs
        B, (N, k).
    exact
        Answers (k, k) of the whole body by rate.
    enough
        The error that may remain.
    least
        How many shapes stay at least.
    """
    driven = projected.shapes.T @ inputs

    def error(count: int) -> float:
        fewer, pushed = projected.first(count), driven[:count]
        worst = 0.0
        for rate, answer in exact.items():
            off = pushed.T @ fewer.response(rate, pushed) - answer
            size = np.sqrt(np.abs(np.diag(answer)))
            worst = max(worst, float(np.max(np.abs(off) / np.outer(size, size))))
        return worst

    low, high = least, projected.shapes.shape[1]
    while low < high:
        count = (low + high) // 2
        low, high = (low, count) if error(count) <= enough else (count + 1, high)
    return projected.first(high), error(high)


def size_of(answer: Complexes, norm: Sparse) -> float:
    """Return the size of answers (N, k), all together, in a norm."""
    return float(np.sqrt(np.sum(answer.conj() * (norm @ answer)).real))


def congruent(matrix: Sparse, shapes: Floats) -> Floats:
    """Return ``V^T A V`` of a symmetric matrix, symmetric to the last bit."""
    product = shapes.T @ (matrix @ shapes)
    result: Floats = (product + product.T) / 2.0
    return result


def real_columns(answers: Complexes) -> Floats:
    """Return real and imaginary parts side by side, (N, k) to (N, 2 k)."""
    columns: Floats = np.column_stack([answers.real, answers.imag])
    return columns


def _directions(norm: Sparse, columns: Floats, nothing: float) -> Floats:
    gram = columns.T @ (norm @ columns)
    sizes, mixed = scipy.linalg.eigh((gram + gram.T) / 2.0)
    kept = sizes > max(nothing, 1e-15) * sizes[-1]
    directions: Floats = columns @ (mixed[:, kept] / np.sqrt(sizes[kept]))[:, ::-1]
    return directions
