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
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import scipy.linalg
import scipy.sparse as sparse
from scipy.linalg import block_diag
from scipy.sparse.linalg import splu

from heeltoe.base.arrays import Floats, Integers

Sparse = Any
"""A matrix of scipy.sparse, which has no types of its own."""
Complexes = Any
"""A complex array."""

# Each has factors of its own in memory.
_THREADS = 4
# Directions with less than this part of the energy of others are rounding.
_NOTHING = 1e-12


@dataclass(frozen=True, eq=False)
class LinearBody:
    """Symmetric matrices of a body of N unknowns: mass, damping and stiffness."""

    mass: Sparse
    damping: Sparse
    stiffness: Sparse

    def response(self, rate: complex, forces: Floats) -> Complexes:
        """Return the amplitudes (N, k) under forces (N, k) that go like exp(rate t), mostly of rate i omega."""
        return self.moments(rate, forces, 0)[0]

    def moments(self, rate: complex, forces: Floats, count: int) -> list[Complexes]:
        """Return the response at a rate and `count` further terms of its series in powers of the distance from that
        rate: they cost no further factors (Bai and Su, SIAM Journal on Matrix Analysis 2005)."""
        factors = _factors(self.operator(rate), diag_pivot_thresh=0.01)
        terms = [factors.solve(forces.astype(complex))]
        if not count:
            return terms
        slope = self.damping + 2.0 * rate * self.mass
        for place in range(count):
            pushed = slope @ terms[-1] + (self.mass @ terms[-2] if place else 0.0)
            terms.append(factors.solve(-pushed))
        return terms

    def at_rest(self, forces: Floats) -> Floats:
        """Return the amplitudes (N, k) under forces (N, k) that do not change."""
        amplitudes: Floats = _factors(sparse.csc_matrix(self.stiffness)).solve(forces)
        return amplitudes

    def operator(self, rate: complex) -> Sparse:
        """Return ``K + s C + s^2 M`` at a rate s."""
        together, (stiffness, damping, mass) = self._entries
        result = together.astype(complex)
        result.data = stiffness + rate * damping + rate**2 * mass
        return result

    @cached_property
    def _entries(self) -> tuple[Sparse, tuple[Floats, ...]]:
        """A matrix with an entry wherever stiffness, damping or mass has one, and the entries there of each: sums of
        sparse matrices take half as long as factors."""
        matrices = [sparse.csc_matrix(matrix) for matrix in (self.stiffness, self.damping, self.mass)]
        # A sum leaves out what is zero in all of them.
        together = abs(matrices[0]) + abs(matrices[1]) + abs(matrices[2])
        together.sort_indices()

        def order(matrix: Sparse) -> Integers:
            columns = np.repeat(np.arange(matrix.shape[1]), np.diff(matrix.indptr))
            places: Integers = columns * matrix.shape[0] + matrix.indices
            return places

        every = order(together)

        def entries(matrix: Sparse) -> Floats:
            some, values = matrix.data != 0.0, np.zeros(every.size)
            values[np.searchsorted(every, order(matrix)[some])] = matrix.data[some]
            return values

        return together, tuple(map(entries, matrices))


def _factors(matrix: Sparse, **options: float) -> Any:
    return splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}, **options)


@dataclass(frozen=True)
class Rates:
    """At which rates a body is looked at.

    Attributes
    ----------
    sampled
        Of the answers that its shapes come from, and of which as many further `moments` are used.
    chosen
        At which the main directions of these shapes, and as few of them as leave a small error, are found.
    checked
        At which the error is measured against all unknowns.
    """

    sampled: Sequence[complex]
    chosen: Sequence[complex]
    checked: Sequence[complex]
    moments: int


def reduced_modes(
    body: LinearBody,
    inputs: Floats,
    norm: Sparse,
    rates: Rates,
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
    rates
        Of the answers.
    most
        How many shapes there may be beside the static ones.
    enough
        Relative error that may remain.
    static
        Shapes (N, j) that are kept whatever the answers are.
    """
    # Side by side: factorising lets go of the interpreter, and each answer is the same on however many threads.
    with ThreadPoolExecutor(min(_THREADS, os.cpu_count() or 1)) as pool:
        answers = pool.map(lambda rate: body.moments(rate, inputs, rates.moments), rates.sampled)
        seen = pool.map(lambda rate: inputs.T @ body.response(rate, inputs), rates.checked)
        first = np.empty((inputs.shape[0], 0)) if static is None else static
        together = np.column_stack(
            [first, *(part for terms in answers for one in terms for part in (one.real, one.imag))]
        )
        exact = dict(zip(rates.checked, seen, strict=True))
    shapes = spanning_shapes(norm, together, first.shape[1])
    # From here on in combinations of these shapes.
    rich = replace(Projected.of(body, shapes), shapes=np.eye(shapes.shape[1]))
    driven = shapes.T @ inputs
    answered = [rich.response(rate, driven) for rate in rates.chosen]
    seen_in_rich = [driven.T @ answer for answer in answered]
    columns = [real_columns(answer / sizes(own)) for answer, own in zip(answered, seen_in_rich, strict=True)]
    ordered = rich.within(main_directions(np.column_stack([driven[:, :0], *columns]), first.shape[1], most))
    exact |= dict(zip(rates.chosen, seen_in_rich, strict=True))
    kept, error = enough_shapes(ordered, driven, exact, enough, max(first.shape[1], 1))
    squares, mixed = kept.modes()
    return (squares, shapes @ mixed), error


def spanning_shapes(norm: Sparse, columns: Floats, first: int) -> Floats:
    """Return directions, orthonormal in a norm, that span the `first` columns (N, k), and then what else there is of
    the others."""
    gram = columns.T @ (norm @ columns)
    some = np.flatnonzero(np.diag(gram) > 0.0)
    lengths = np.sqrt(np.diag(gram)[some])
    gram = gram[np.ix_(some, some)] / np.outer(lengths, lengths)
    count = int(np.searchsorted(some, first))
    head, rest = slice(0, count), slice(count, None)
    own = _directions(gram[head, head], 1e-15)
    shared = own @ (own.T @ gram[head, rest])
    left = _directions(gram[rest, rest] - gram[rest, head] @ shared, _NOTHING)
    mixed = np.zeros((columns.shape[1], own.shape[1] + left.shape[1]))
    mixed[some[head], : own.shape[1]], mixed[some[head], own.shape[1] :] = own, -shared @ left
    mixed[some[rest], own.shape[1] :] = left
    mixed[some] /= lengths[:, None]
    spanning: Floats = columns @ mixed
    return spanning


def main_directions(columns: Floats, first: int, most: int) -> Floats:
    """Return an order of orthonormal shapes, (m, n): the first ones stay, then come at most `most` main directions of
    columns (m, k) in the others."""
    directions, _, _ = np.linalg.svd(columns[first:], full_matrices=False)
    order: Floats = block_diag(np.eye(first), directions[:, :most])
    return order


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

    def within(self, mixed: Floats) -> Projected:
        """Return it in combinations (m, n) of its shapes."""
        matrices = (mixed.T @ matrix @ mixed for matrix in (self.mass, self.damping, self.stiffness))
        return Projected(self.shapes @ mixed, *((matrix + matrix.T) / 2.0 for matrix in matrices))

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
    scales = {rate: np.outer(sizes(answer), sizes(answer)) for rate, answer in exact.items()}
    # The fastest first, which most often need the most.
    rates = sorted(exact, key=abs, reverse=True)

    def error_at(rate: complex, count: int) -> float:
        pushed = driven[:count]
        off = pushed.T @ projected.first(count).response(rate, pushed) - exact[rate]
        return float(np.max(np.abs(off) / scales[rate]))

    # More shapes leave a smaller error at each rate, so that as many as one needs are tried at the others.
    high, most, errors = least, projected.shapes.shape[1], dict[complex, float]()
    while untried := [rate for rate in rates if rate not in errors]:
        rate = untried[0]
        error = error_at(rate, high)
        if error <= enough or high == most:
            errors[rate] = error
            continue
        low, high, errors = high + 1, most, {}
        while low < high:
            count = (low + high) // 2
            error = error_at(rate, count)
            low, high, errors = (low, count, {rate: error}) if error <= enough else (count + 1, high, errors)
    return projected.first(high), max(errors.values(), default=0.0)


def sizes(answers: Complexes) -> Floats:
    """Return the scales of answers (k, k): the root of the answer of each input to itself."""
    roots: Floats = np.sqrt(np.abs(np.diag(answers)))
    return roots


def congruent(matrix: Sparse, shapes: Floats) -> Floats:
    """Return ``V^T A V`` of a symmetric matrix, symmetric to the last bit."""
    product = shapes.T @ (matrix @ shapes)
    result: Floats = (product + product.T) / 2.0
    return result


def real_columns(answers: Complexes) -> Floats:
    """Return real and imaginary parts side by side, (N, k) to (N, 2 k)."""
    columns: Floats = np.column_stack([answers.real, answers.imag])
    return columns


def _directions(gram: Floats, nothing: float) -> Floats:
    """Return combinations of shapes of which these are the products, orthonormal, the largest first."""
    energies, mixed = scipy.linalg.eigh((gram + gram.T) / 2.0)
    kept = energies > nothing * max(energies, default=0.0)
    directions: Floats = (mixed[:, kept] / np.sqrt(energies[kept]))[:, ::-1]
    return directions
