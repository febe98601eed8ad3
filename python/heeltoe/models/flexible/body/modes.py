"""Vibration modes of the parts of a cracked dam, and periods of the intact one.

A body whose modes are all known steps through time at the cost of its modes and crack nodes, whatever its mesh. Where
modes are left out, the crack must keep its static flexibility: without it the nodes of the crack are too stiff
towards each other, and slip comes out wrong by a factor."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.body.elastic import Body, Dam, Sparse, dofs, side_by_side

#: Modes kept at first; they are doubled until so much of the crack's compliance at most is lost.
FIRST_KEPT = 50
ENOUGH = 0.03
# The frequency of that compliance over the first one of the intact dam.
_RANGE = 15.0
# Combinations of static shapes with less than this part of the energy of others hold nothing new.
_NOTHING = 1e-12


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


def reduce(body: Body, keep: int | None = None) -> Modes:
    """Return the modes of a body.

    Where modes are left out, the static shapes of unit forces on the crack nodes, of the static loads and, on a body
    that is held, of unit accelerations are added and made one set with the kept modes by Rayleigh and Ritz: residual
    attachment modes (Craig, Coupling of Substructures for Dynamic Analyses, AIAA 2000-1573). Those of a free body
    belong to K + s M, regular with an s far below its squared frequencies.

    Parameters
    ----------
    body
        Free, or held at its base.
    keep
        Number of vibration modes; all where it is not given.

    Returns
    -------
    Modes
        All of them where `keep` and the static shapes together would be as many.
    """
    size = body.mesh.nodes.size
    free = np.setdiff1d(np.arange(size), dofs(body.mesh.fixed))
    rigid = _rigid_shapes(body) if free.size == size else np.empty((size, 0))
    if keep is None:
        keep = free.size
    stiffness, mass = body.stiffness[free][:, free], body.mass[free][:, free]
    following = [body.load_per_vertical] if body.load_per_vertical.any() else []
    forces = np.column_stack([_unit_forces(body), body.load, *following])[free]
    if not rigid.size:
        forces = np.column_stack([forces, (body.mass @ np.tile(np.eye(2), (size // 2, 1)))[free]])
    truncated = keep + rigid.shape[1] + forces.shape[1] < free.size
    if truncated:
        squares, vectors = _truncated(stiffness, mass, forces, rigid[free], keep)
    else:
        squares, vectors = _all(stiffness, mass, rigid[free])
    shapes = np.zeros((size, squares.size))
    shapes[free] = vectors
    kept = rigid.shape[1] + keep if truncated else free.size
    return Modes(squares, shapes, rigid.shape[1], kept, free.size, truncated)


def enough_modes(body: Body, dam: Dam) -> tuple[Modes, float]:
    """Return as many of the lowest modes of a body, with its static shapes, as its crack needs, and their error."""
    circular = error_frequency(dam)
    keep = FIRST_KEPT
    while True:
        modes = reduce(body, keep)
        error = residual_error(body, modes, circular)
        if error <= ENOUGH or not modes.truncated:
            return modes, error
        keep *= 2


def error_frequency(dam: Dam) -> float:
    """Return the circular frequency [1/s] up to which the crack's compliance matters: 15 times the first of the intact
    dam. The slip of the typical dam changes by 0.5 % with 12 modes, which leave an error of 16 % there, and by 0.02 %
    with 50, which leave 1 to 2 %."""
    return _RANGE * 2.0 * math.pi / float(intact_periods(dam, 1)[0])


def residual_error(body: Body, modes: Modes, circular: float) -> float:
    """Return the relative error of the crack's compliance that is due to the modes left out.

    The compliance under forces that grow like exp(s t), ``E^T (K + s^2 M)^-1 E`` with unit forces E on the crack nodes,
    has no resonances. It is compared with a direct solution, pattern of forces by pattern of forces. A measure at a
    frequency that follows the modes kept would not see how few they are.

    Parameters
    ----------
    body, modes
        A body, and the modes in question.
    circular
        s [1/s].

    Returns
    -------
    float
        For the pattern of forces with the largest error, from 0 (none but rounding) to 1 (nothing of it is left).
    """
    import scipy.linalg

    free = np.setdiff1d(np.arange(body.mesh.nodes.size), dofs(body.mesh.fixed))
    if not modes.truncated:
        return 0.0
    square = circular**2
    unit = _unit_forces(body)
    crack = unit.T @ modes.shapes
    reduced = crack @ (crack / (modes.omega_squared + square)).T
    operator = body.stiffness[free][:, free] + square * body.mass[free][:, free]
    direct = unit[free].T @ _factor(operator)(unit[free])
    # A smaller space is never more compliant.
    return float(scipy.linalg.eigvalsh(direct - reduced, direct)[-1])


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
    tie = dam.tie
    stiffness = tie.T @ side_by_side(dam, "stiffness") @ tie
    mass = tie.T @ side_by_side(dam, "mass" if water else "mass_concrete") @ tie
    squares, _ = lowest(stiffness, mass, min(count, tie.shape[1]), 0.0)
    return 2.0 * math.pi / np.sqrt(squares)


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
    x, z = (body.mesh.nodes - body.mesh.nodes.mean(axis=0)).T
    shapes = np.zeros((2 * len(x), 3))
    shapes[::2, 0] = shapes[1::2, 1] = 1.0
    shapes[::2, 2], shapes[1::2, 2] = -z, x
    for i in range(3):
        shapes[:, i] -= _projected(shapes[:, i], shapes[:, :i], body.mass)
        shapes[:, i] /= math.sqrt(shapes[:, i] @ (body.mass @ shapes[:, i]))
    return shapes


def _unit_forces(body: Body) -> Floats:
    places = dofs(body.mesh.crack)
    forces = np.zeros((body.mesh.nodes.size, places.size))
    forces[places, np.arange(places.size)] = 1.0
    return forces


def _all(stiffness: Sparse, mass: Sparse, rigid: Floats) -> tuple[Floats, Floats]:
    import scipy.linalg

    squares, shapes = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), overwrite_a=True, overwrite_b=True)
    return _with_rigid(squares, shapes, mass, rigid)


def _truncated(stiffness: Sparse, mass: Sparse, forces: Floats, rigid: Floats, keep: int) -> tuple[Floats, Floats]:
    import scipy.linalg

    count = rigid.shape[1]
    shift = _small_shift(stiffness, mass, rigid) if count else 0.0
    squares, shapes = _with_rigid(*lowest(stiffness, mass, keep + count, shift), mass, rigid)
    static = _factor(stiffness + shift * mass)(forces)
    for _ in range(2):  # the second time takes away what rounding has left
        static -= _projected(static, shapes, mass)
        static /= np.sqrt(np.sum(static * (stiffness @ static), axis=0))
        energy, mixed = scipy.linalg.eigh(static.T @ (stiffness @ static))
        new = energy > _NOTHING * energy[-1]
        static = static @ (mixed[:, new] / np.sqrt(energy[new]))
    # Orthonormal in the stiffness now; in these the mass has the inverse squared frequencies.
    inverse, mixed = scipy.linalg.eigh(static.T @ (mass @ static))
    pseudo = static @ (mixed / np.sqrt(inverse))
    return np.concatenate([squares, 1.0 / inverse[::-1]]), np.column_stack([shapes, pseudo[:, ::-1]])


def _with_rigid(squares: Floats, shapes: Floats, mass: Sparse, rigid: Floats) -> tuple[Floats, Floats]:
    """Put exact rigid-body modes in the place of those that rounding has made."""
    count = rigid.shape[1]
    squares, shapes = squares[count:], shapes[:, count:]
    shapes = shapes - _projected(shapes, rigid, mass)
    return np.concatenate([np.zeros(count), squares]), np.column_stack([rigid, shapes])


def _projected(shapes: Floats, onto: Floats, mass: Sparse) -> Floats:
    part: Floats = onto @ (onto.T @ (mass @ shapes))
    return part


def _small_shift(stiffness: Sparse, mass: Sparse, rigid: Floats) -> float:
    """Return a millionth of a Rayleigh quotient, which bounds the lowest squared frequency of a free body."""
    shape = rigid[:, 2] ** 2
    shape -= _projected(shape, rigid, mass)
    return 1e-6 * float(shape @ (stiffness @ shape) / (shape @ (mass @ shape)))


def _factor(operator: Sparse) -> Any:
    """Return the function that solves a symmetric positive definite system."""
    from scipy.sparse.linalg import splu

    return splu(operator.tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve


def lowest(stiffness: Sparse, mass: Sparse, count: int, shift: float) -> tuple[Floats, Floats]:
    """Return the lowest squared frequencies, ascending, and their shapes, orthonormal in the mass;
    ``stiffness + shift mass`` must be regular."""
    import scipy.linalg
    from scipy.sparse.linalg import LinearOperator, eigsh

    size = stiffness.shape[0]
    if 3 * count >= size:
        squares, shapes = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), subset_by_index=(0, count - 1))
        return squares, shapes
    solve = LinearOperator((size, size), _factor(stiffness + shift * mass))
    # A start of our own makes the result the same every time.
    start = np.random.default_rng(0).standard_normal(size)
    squares, shapes = eigsh(stiffness, count, mass, sigma=-shift, OPinv=solve, v0=start)
    order = np.argsort(squares)
    return squares[order], shapes[:, order]
