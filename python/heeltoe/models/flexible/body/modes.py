"""Vibration modes of the parts of a cracked dam, and periods of the intact one.

A body whose modes are all known steps through time at the cost of its modes and crack nodes, whatever its mesh. Where
modes are left out, the crack must keep its static flexibility: without it the nodes of the crack are too stiff
towards each other, and slip comes out wrong by a factor."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.models.flexible.body.elastic import (
    Body,
    Dam,
    Solve,
    Sparse,
    dofs,
    factor,
    factored,
    rigid_motions,
    side_by_side,
    tied,
)

#: Modes kept at first; they are doubled until so much of the crack's compliance at most is lost.
FIRST_KEPT = 50
ENOUGH = 0.03
# The frequency of that compliance over the first one of the intact dam.
_RANGE = 15.0
# Combinations of static shapes with less than this part of the energy of others hold nothing new.
_NOTHING = 1e-12
#: Of so many modes of the intact dam the damping ratios are shown.
SHOWN_MODES = 5


@dataclass(frozen=True, eq=False)
class Modes:
    """A body in modal coordinates.

    Parameters
    ----------
    omega_squared
        Squared circular frequencies, ascending, exactly zero for rigid-body modes, shape (m,) [1/s^2].
    shapes
        Shapes, shape (2 n, m), normalised by the mass with the virtual water [kg^(-1/2)].
    rigid
        Number of rigid-body modes, which come first: 3 of a free body, 0 of one that is held.
    kept
        Number of rigid-body and true vibration modes; what follows are pseudo-modes, the rest of the static shapes.
    total
        Number of free degrees of freedom, that is of all modes there are.
    truncated
        Whether modes were left out.
    """

    omega_squared: Floats
    shapes: Floats
    rigid: int
    kept: int
    total: int
    truncated: bool


class Basis:
    """The modes of a body and its static shapes, its factors made once however many modes are kept.

    Where modes are left out, the static shapes of unit forces on the crack nodes, of the static loads and, on a body
    that is held, of unit accelerations are added and made one set with the kept modes by Rayleigh and Ritz: residual
    attachment modes (Craig, Coupling of Substructures for Dynamic Analyses, AIAA 2000-1573). Those of a free body
    belong to K + s M, regular with an s far below its squared frequencies.

    Parameters
    ----------
    stiffness, mass
        Of a body that is free, or held somewhere, (n, n).
    rigid
        (n, r) its rigid motions, orthonormal in the mass; none where it is held.
    held, crack
        Which of its n unknowns are held, and which those of its crack.
    loads
        (n, l) forces whose static shapes are wanted.
    bent
        (n,) any motion of a free body that is not rigid.
    """

    def __init__(
        self,
        stiffness: Sparse,
        mass: Sparse,
        *,
        rigid: Floats,
        held: Integers,
        crack: Integers,
        loads: Floats,
        bent: Floats,
    ) -> None:
        size = mass.shape[0]
        self._size, self._free = size, np.setdiff1d(np.arange(size), held)
        self._stiffness, self._mass = (
            matrix[self._free][:, self._free] if held.size else matrix for matrix in (stiffness, mass)
        )
        self._rigid, self._bent = rigid[self._free], bent[self._free]
        self._crack, self._loads = np.searchsorted(self._free, crack), loads[self._free]

    @classmethod
    def of(cls, body: Body) -> Basis:
        """Return that of a body in the plane of the section."""
        size, held = body.mesh.nodes.size, body.mesh.fixed.size
        following = [body.load_per_vertical] if body.load_per_vertical.any() else []
        moved = [body.mass @ np.tile(np.eye(2), (size // 2, 1))] if held else []
        rigid = np.empty((size, 0)) if held else _rigid_shapes(body)
        return cls(
            body.stiffness,
            body.mass,
            rigid=rigid,
            held=dofs(body.mesh.fixed),
            crack=dofs(body.mesh.crack),
            loads=np.column_stack([body.load, *following, *moved]),
            bent=np.zeros(size) if held else rigid[:, 2] ** 2,
        )

    def modes(self, keep: int | None = None) -> Modes:
        """Return as many vibration modes, all where no number is given or the static shapes make it as many."""
        rigid = self._rigid.shape[1]
        truncated = keep is not None and keep + rigid + self._crack.size + self._loads.shape[1] < self._free.size
        if keep is None or not truncated:
            kept = self._free.size
            squares, vectors = self._all()
        else:
            kept = rigid + keep
            squares, vectors = self._truncated(keep)
        shapes = vectors
        if self._free.size < self._size:
            shapes = np.zeros((self._size, squares.size))
            shapes[self._free] = vectors
        return Modes(squares, shapes, rigid, kept, self._free.size, truncated)

    def error(self, modes: Modes, circular: float) -> float:
        """Return the relative error of the crack's compliance that is due to the modes left out, growing at s [1/s].

        The compliance under forces that grow like exp(s t), ``E^T (K + s^2 M)^-1 E`` with unit forces E on the crack
        nodes, has no resonances. It is compared with a direct solution, pattern of forces by pattern of forces; the
        pattern with the largest error counts, from 0 (none but rounding) to 1 (nothing of it is left). A measure at a
        frequency that follows the modes kept would not see how few they are.
        """
        import scipy.linalg

        if not modes.truncated:
            return 0.0
        square = circular**2
        order, direct = self._compliance(square)
        crack = modes.shapes[self._free[order]]
        reduced = crack @ (crack / (modes.omega_squared + square)).T
        # A smaller space is never more compliant.
        return float(scipy.linalg.eigvalsh(direct - reduced, direct)[-1])

    @cached_property
    def _shift(self) -> float:
        """A millionth of a Rayleigh quotient, which bounds the lowest squared frequency of a free body."""
        if not self._rigid.size:
            return 0.0
        shape = self._bent - _projected(self._bent, self._rigid, self._mass)
        return 1e-6 * float(shape @ (self._stiffness @ shape) / (shape @ (self._mass @ shape)))

    def _compliance(self, square: float) -> tuple[Integers, Floats]:
        """Return the crack's unknowns (k,) in an order of their own, and their compliance (k, k) with `square` times
        the mass.

        Where the crack is eliminated last, its part of the factors is that of the inverse.
        """
        operator, count = (self._stiffness + square * self._mass).tocsr(), self._crack.size
        place = self._factors.perm_c.copy()
        place[self._crack] += self._free.size
        order = np.argsort(place)
        factors = factored(operator[order][:, order], permc_spec="NATURAL", diag_pivot_thresh=0.0)
        schur = factors.L[-count:, -count:] @ factors.U[-count:, -count:]
        return order[np.argsort(factors.perm_c)[-count:]], np.linalg.inv(schur.toarray())

    @cached_property
    def _factors(self) -> Any:
        return factored(self._stiffness + self._shift * self._mass)

    @cached_property
    def _static(self) -> Floats:
        """Static shapes of unit forces on the crack and of the loads (n, f), the rigid motion taken out."""
        count = self._crack.size
        forces = np.zeros((self._free.size, count + self._loads.shape[1]), order="F")
        forces[self._crack, np.arange(count)] = 1.0
        forces[:, count:] = self._loads
        static: Floats = self._factors.solve(forces)
        static -= _projected(static, self._rigid, self._mass)
        return static

    def _all(self) -> tuple[Floats, Floats]:
        import scipy.linalg

        return self._with_rigid(
            *scipy.linalg.eigh(self._stiffness.toarray(), self._mass.toarray(), overwrite_a=True, overwrite_b=True)
        )

    def _with_rigid(self, squares: Floats, shapes: Floats) -> tuple[Floats, Floats]:
        """Put exact rigid-body modes in the place of those that rounding has made."""
        count = self._rigid.shape[1]
        squares, shapes = squares[count:], shapes[:, count:]
        shapes = shapes - _projected(shapes, self._rigid, self._mass)
        return np.concatenate([np.zeros(count), squares]), np.column_stack([self._rigid, shapes])

    def _truncated(self, keep: int) -> tuple[Floats, Floats]:
        import scipy.linalg

        eigenpairs = lowest(self._stiffness, self._mass, keep + self._rigid.shape[1], self._shift, self._factors.solve)
        squares, shapes = self._with_rigid(*eigenpairs)
        static = self._static
        for _ in range(2):  # the second time takes away what rounding has left
            static = static - _projected(static, shapes, self._mass)
            products = static.T @ (self._stiffness @ static)
            size = np.sqrt(products.diagonal())
            energy, mixed = scipy.linalg.eigh(products / size / size[:, None])
            new = energy > _NOTHING * energy[-1]
            static = static @ (mixed[:, new] / np.sqrt(energy[new]) / size[:, None])
        # Orthonormal in the stiffness now; in these the mass has the inverse squared frequencies.
        inverse, mixed = scipy.linalg.eigh(static.T @ (self._mass @ static))
        pseudo = static @ (mixed / np.sqrt(inverse))
        return np.concatenate([squares, 1.0 / inverse[::-1]]), np.column_stack([shapes, pseudo[:, ::-1]])


def reduce(body: Body, keep: int | None = None) -> Modes:
    """Return the modes of a body, see :class:`Basis`: all of them by default."""
    return Basis.of(body).modes(keep)


def enough_modes(basis: Basis, circular: float) -> tuple[Modes, float]:
    """Return as many of the lowest modes of a body, with its static shapes, as its crack needs, and their error."""
    keep = FIRST_KEPT
    while True:
        modes = basis.modes(keep)
        error = basis.error(modes, circular)
        if error <= ENOUGH or not modes.truncated:
            return modes, error
        keep *= 2


def error_frequency(first: float) -> float:
    """Return the circular frequency [1/s] up to which the crack's compliance matters: 15 times the `first` of the
    intact dam. The slip of the typical dam changes by 0.5 % with 12 modes, which leave an error of 16 % there, and by
    0.02 % with 50, which leave 1 to 2 %."""
    return _RANGE * first


def part_periods(modes: Modes, count: int = 5) -> Floats:
    """Return the longest periods of a part by itself, rigid-body modes left out, up to `count` of them [s]."""
    squares = modes.omega_squared[modes.rigid : min(modes.rigid + count, modes.kept)]
    return 2.0 * math.pi / np.sqrt(squares)


def intact_periods(dam: Dam, count: int = 5, *, water: bool = True) -> Floats:
    """Return the longest periods of the dam with its crack bonded.

    Parameters
    ----------
    dam
        Both parts and their tie.
    count
        How many; fewer where the mesh has no more.
    water
        Whether the virtual water vibrates with the dam.
    """
    mass = tied(dam, "mass" if water else "mass_concrete")
    squares, _ = lowest(tied(dam, "stiffness"), mass, min(count, dam.tie.shape[1]), 0.0)
    return 2.0 * math.pi / np.sqrt(squares)


@dataclass(frozen=True, eq=False)
class Intact:
    """The lowest modes of a dam with its cracks bonded.

    Attributes
    ----------
    omega
        (j,) circular frequencies [1/s].
    momenta
        (2 n, j) of each mode at unit speed, one part after the other [kg^(1/2)].
    """

    omega: Floats
    momenta: Floats


def intact_modes(dam: Dam, count: int, stiffness: Sparse, solve: Solve) -> Intact:
    """Return the lowest `count` modes, or all where there are fewer, by the factors of the tied `stiffness`."""
    mass = tied(dam, "mass")
    squares, shapes = lowest(stiffness, mass, min(count, dam.tie.shape[1]), 0.0, solve)
    return Intact(np.sqrt(squares), side_by_side(dam, "mass") @ (dam.tie @ shapes))


def rayleigh(period_a: float, period_b: float, ratio: float) -> tuple[float, float]:
    """Return the Rayleigh coefficients with which two periods have the same damping ratio.

    ``2 ratio omega = a0 + a1 omega^2`` at both circular frequencies; Clough and Penzien, Dynamics of Structures.

    Parameters
    ----------
    period_a, period_b
        Periods [s].
    ratio
        Damping ratio.

    Returns
    -------
    mass, stiffness : float
        a0 [1/s] and a1 [s].
    """
    a, b = 2.0 * math.pi / period_a, 2.0 * math.pi / period_b
    return 2.0 * ratio * a * b / (a + b), 2.0 * ratio / (a + b)


def _rigid_shapes(body: Body) -> Floats:
    """Return translations and rotation, orthonormal in the mass, which water makes larger in x; shape (2 n, 3)."""
    shapes = rigid_motions(body.mesh.nodes - body.mesh.nodes.mean(axis=0))
    for i in range(3):
        shapes[:, i] -= _projected(shapes[:, i], shapes[:, :i], body.mass)
        shapes[:, i] /= math.sqrt(shapes[:, i] @ (body.mass @ shapes[:, i]))
    return shapes


def _projected(shapes: Floats, onto: Floats, mass: Sparse) -> Floats:
    part: Floats = onto @ (onto.T @ (mass @ shapes))
    return part


def lowest(
    stiffness: Sparse, mass: Sparse, count: int, shift: float, solve: Solve | None = None
) -> tuple[Floats, Floats]:
    """Return the lowest squared frequencies, ascending, and their shapes, orthonormal in the mass;
    ``stiffness + shift mass``, whose factors `solve` has where they are known, must be regular."""
    import scipy.linalg
    from scipy.sparse.linalg import LinearOperator, eigsh

    size = stiffness.shape[0]
    if 3 * count >= size:
        squares, shapes = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), subset_by_index=(0, count - 1))
        return squares, shapes
    inverse = LinearOperator((size, size), solve or factor(stiffness + shift * mass))
    # A start of our own makes the result the same every time.
    start = np.random.default_rng(0).standard_normal(size)
    squares, shapes = eigsh(stiffness, count, mass, sigma=-shift, OPinv=inverse, v0=start)
    order = np.argsort(squares)
    return squares[order], shapes[:, order]
