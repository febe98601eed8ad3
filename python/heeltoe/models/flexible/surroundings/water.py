"""The water before a face of the dam, with sound: few unknowns that answer the motion of the face.

The water has a velocity potential, ``v = grad phi``, and the pressure ``p = -rho phi'`` beyond that at rest. With M, K
the integrals of N N / c^2 and of grad N grad N, Q those of N times the normal out of the water times the shapes of
the face, and C what floor and far field take,

    rho M phi'' + rho C phi' + rho K phi = rho Q^T (v_face + iota v_ground) + rho R v_ground.

Over the surface phi = 0 (no waves on it); at the floor ``dphi/dn = n v - q phi'`` with ``q = (1 - alpha) / (c (1 +
alpha))`` (Hall and Chopra 1982; Fenves and Chopra 1984). Near the face quadratic elements, beyond them
:mod:`heeltoe.models.flexible.surroundings.far_field`. In a few shapes, normalised by the mass,

    x'' + C x' + Omega^2 x = L v_face + G v_ground,    f_face = -L^T x',

which is symmetric and passive: the water takes from the dam ``v_face^T L^T x'`` and loses ``x'^T C x' >= 0``."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import scipy.sparse as sparse

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.cache import Kept
from heeltoe.models.flexible.surroundings.edges import (
    GAUSS_POINTS,
    GAUSS_WEIGHTS,
    edge_shapes,
    edge_shares,
    smooth_patterns,
)
from heeltoe.models.flexible.surroundings.far_field import Channel, channel
from heeltoe.models.flexible.surroundings.reduction import (
    Complexes,
    LinearBody,
    Rates,
    Sparse,
    congruent,
    norm_of,
    reduced_modes,
)

#: The near field goes on beyond the foot of the face by so many depths.
NEAR = 0.5
# Elements over the shortest wave, and over the depth at least.
_PER_WAVE, _ROWS = 4.0, 10
# Patterns of the face's motion over the depth, polynomials of rising degree, whose answers are kept.
_PATTERNS = 9
# Rate [first frequency of the water] at which the motions grow whose answers are kept; how many of these at most.
_GROWTH, _MOST = 0.01, 240
# What is far counts less in the choice of shapes: weights fall with this power of the distance.
_FADING = 1.0
# Rates of growth [highest circular frequency] of sudden motions, which tell what the water does before waves are back.
_SUDDEN = (0.5, 1.0, 2.0)
# Even frequencies at which the water is sampled, and from which few of its shapes are chosen.
_SAMPLED, _CHOSEN = 13, 25
#: The relative error of the answers to smooth motions that a reduction may leave.
ENOUGH = 0.005


@dataclass(frozen=True, eq=False)
class ReducedWater:
    """Water in m shapes x normalised by the mass: ``x'' + C x' + Omega^2 x = L v_face + G v_ground``.

    All velocities are in x downstream and z up [m/s]. ``v_face`` is that of the nodes of the face *relative to the
    ground*, as the unknowns of the dam are. ``v_ground`` is that of the ground, the same at all places: its column x
    moves the whole face, its column z the face and the floor of the reservoir. The forces on the dam's nodes are
    ``-L^T x'`` [N per m], beyond those of the water at rest; the density is in them.

    Attributes
    ----------
    omega_squared
        (m,) squared circular frequencies [1/s2].
    damping
        (m, m) symmetric, positive semidefinite [1/s]: ``damping_floor + damping_far``.
    damping_floor, damping_far
        What the floor takes and what leaves along the reservoir: the power is ``x'^T C x'`` of each [W per m].
    coupling
        (m, 2 n) rows L; columns x and z in turn of the n nodes of the face, zero where it is dry.
    ground
        (m, 2) for the velocity of the ground in x and z.
    pressure
        (n, m): pressure at the nodes of the face is ``pressure @ x'`` [Pa], zero at dry nodes.
    highest
        Frequency [Hz] up to which it answers well.
    error
        Largest relative error of the answers to smooth motions up to there that the reduction has left.
    """

    omega_squared: Floats
    damping: Floats
    damping_floor: Floats
    damping_far: Floats
    coupling: Floats
    ground: Floats
    pressure: Floats
    highest: float
    error: float

    def amplitudes(self, omega: float, velocities: Complexes) -> Complexes:
        """Return x' for the drive of the water, ``L v + G v`` (m, ...), both like exp(i omega t)."""
        operator = np.diag(self.omega_squared - omega**2 + 0j) + 1j * omega * self.damping
        return 1j * omega * np.linalg.solve(operator, velocities)


@dataclass(frozen=True, eq=False)
class FullWater:
    """Water before all shapes but those of the finite elements are left out; N unknowns.

    Attributes
    ----------
    mass, stiffness, damping_floor, damping_far
        (N, N), the density in them.
    coupling, ground
        (N, 2 n) and (N, 2), as in :class:`ReducedWater`.
    pressure
        (n, N), as there.
    patterns
        (N, k) flows through the face of smooth motions, each of about unit velocity.
    first
        First circular frequency of the water in the channel [1/s].
    distance
        (N,) of the unknowns from where the far field begins, zero in the near field [depths].
    """

    mass: Sparse
    stiffness: Sparse
    damping_floor: Sparse
    damping_far: Sparse
    coupling: Sparse
    ground: Floats
    pressure: Sparse
    patterns: Floats
    first: float
    distance: Floats

    @property
    def body(self) -> LinearBody:
        """Mass, damping, stiffness."""
        return LinearBody(self.mass, self.damping_floor + self.damping_far, self.stiffness)


def floor_admittance(wave_speed: float, reflection: float) -> float:
    """Return q of a floor [s/m], ``dphi/dn = -q phi'``, that reflects a part alpha of a wave from above.

    Fenves and Chopra 1984; alpha = 1 is a rigid floor, q = 0, and alpha = 0 takes all.
    """
    return (1.0 - reflection) / (wave_speed * (1.0 + reflection))


def floor_reflection(density: float, wave_speed: float, rock_density: float, rock_wave_speed: float) -> float:
    """Return alpha of a floor of rock: ``(1 - k) / (1 + k)``, k the impedance of the water over that of the rock."""
    ratio = density * wave_speed / (rock_density * rock_wave_speed)
    return (1.0 - ratio) / (1.0 + ratio)


def reduced_water(
    faces: Floats | Sequence[Floats],
    depth: float,
    *,
    wave_speed: float,
    reflection: float,
    density: float = 1000.0,
    highest: float = 15.0,
    floor: float | None = None,
    upstream: bool = True,
    near: float = NEAR,
    enough: float = ENOUGH,
) -> ReducedWater:
    """Return the water before a face in few unknowns.

    Parameters
    ----------
    faces
        Nodes (x, z) of the face from the floor upwards, shape (n, 2) [m], with those in the middle of the quadratic
        edges, so n is odd; or several of them, from below, of parts of the dam one above the other.
    depth
        Of the water above the floor [m].
    wave_speed
        Of sound in water, c [m/s].
    reflection
        alpha of the floor, from 0 to 1.
    density
        Of the water [kg/m3].
    highest
        Frequency [Hz] up to which the answer is to be good.
    floor
        Its elevation [m]; that of the lowest node without it. Between both the wall is a vertical one of the ground.
    upstream
        Whether the water is at the upstream face; else at the downstream one, and reaches downstream.
    near
        Length of the near field beyond the face, in depths.
    enough
        Relative error that the reduction may leave.
    """
    paths = [faces] if isinstance(faces, np.ndarray) else list(faces)
    full = full_water(
        paths, depth, wave_speed=wave_speed, reflection=reflection, density=density, highest=highest, floor=floor,
        upstream=upstream, near=near,
    )  # fmt: skip
    return _reduced(full, highest, enough)


def full_water(
    paths: Sequence[Floats],
    depth: float,
    *,
    wave_speed: float,
    reflection: float,
    density: float,
    highest: float,
    floor: float | None,
    upstream: bool,
    near: float,
) -> FullWater:
    """Return the water in all its finite elements; parameters as in :func:`reduced_water`."""
    side = 1.0 if upstream else -1.0
    # Downstream is upstream in a mirror.
    turned = [path * [side, 1.0] for path in paths]
    bottom = float(turned[0][0, 1]) if floor is None else floor
    surface = bottom + depth
    longest = wave_speed / highest / _PER_WAVE
    line = _wet_line(turned, bottom, surface, min(longest, depth / _ROWS))
    admittance = floor_admittance(wave_speed, reflection)

    def fluid() -> _Fluid:
        mesh = _near_mesh(line, bottom, depth, longest, near)
        far = channel(mesh.heights, wave_speed, admittance, 2.0 * np.pi * highest)
        return _fluid(mesh, far, (wave_speed, density, admittance), surface, side)

    key = (line.tobytes(), bottom, depth, wave_speed, reflection, density, highest, near, side)
    return _before(turned, _FLUIDS.get(key, fluid), density, surface, side)


@dataclass(frozen=True, eq=False)
class _Near:
    """The near field: its matrices, without the density, and its nodes along face, far end and floor from below or from
    afar; the nodes of the surface are left out."""

    mass: Sparse
    stiffness: Sparse
    floor_mass: Sparse
    lift: Floats
    face: Integers
    face_points: Floats
    end: Integers
    heights: Floats
    wet: Integers


def _wet_line(paths: Sequence[Floats], bottom: float, surface: float, longest: float) -> Floats:
    """Return the corners (x, z) of the elements along the wet face, from floor to surface."""
    nodes = np.vstack([paths[0][:1] * [1.0, 0.0] + [0.0, bottom], *paths])
    nodes = nodes[np.concatenate([[True], np.diff(nodes[:, 1]) > 0.0])]
    slopes = np.diff(nodes[:, 0]) / np.diff(nodes[:, 1])
    bends = nodes[1:-1, 1][np.abs(np.diff(slopes)) > 1e-9]
    marks = np.array([bottom, *(z for z in bends if bottom + 1e-6 < z < surface - 1e-6), surface])
    # The nodes between the bends are the dam's, which has other ones in another mesh.
    straight = np.concatenate([[True], np.abs(np.diff(slopes)) > 1e-9, [True]])
    nodes = nodes[straight]
    rows = [bottom]
    for low, high in pairwise(marks):
        count = max(1, int(np.ceil((high - low) / longest)))
        rows += list(np.linspace(low, high, count + 1)[1:])
    return np.column_stack([np.interp(rows, nodes[:, 1], nodes[:, 0]), rows])


def _near_mesh(line: Floats, bottom: float, depth: float, longest: float, near: float) -> _Near:
    import skfem
    from skfem.helpers import dot, grad

    start = line[:, 0].min() - near * depth
    columns = max(3, int(np.ceil((line[:, 0].mean() - start) / min(longest, depth / _ROWS))))
    square = skfem.MeshQuad.init_tensor(np.linspace(0.0, 1.0, columns + 1), line[:, 1])
    along, up = square.p
    mapped = np.vstack([start + along * (np.interp(up, line[:, 1], line[:, 0]) - start), up])
    quads = skfem.MeshQuad(mapped, square.t)
    element = skfem.ElementQuad2()
    plain, basis = skfem.Basis(square, element), skfem.Basis(quads, element, intorder=5)
    (along, up), points = plain.doflocs, basis.doflocs.T

    def product(u: Any, v: Any, _: Any) -> Any:
        return u * v

    def slopes(u: Any, v: Any, _: Any) -> Any:
        return dot(grad(u), grad(v))

    def flow(v: Any, _: Any) -> Any:
        return 1.0 * v

    # scikit-fem 12 looks for points of a facet in its element to an absolute tolerance, which rounding of coordinates
    # far from zero exceeds where the water is a few centimetres deep.
    at_floor = skfem.FacetBasis(
        quads.translated((-start, -bottom)),
        element,
        facets=square.facets_satisfying(lambda x: np.abs(x[1] - bottom) < 1e-9 * depth),
        intorder=5,
    )
    slack = 1e-9
    face, end = np.flatnonzero(along > 1.0 - slack), np.flatnonzero(along < slack)
    face, end = face[np.argsort(up[face])], end[np.argsort(up[end])]
    wet = np.flatnonzero(up < bottom + depth * (1.0 - slack))
    return _Near(
        sparse.csr_matrix(skfem.BilinearForm(product).assemble(basis)),
        sparse.csr_matrix(skfem.BilinearForm(slopes).assemble(basis)),
        sparse.csr_matrix(skfem.BilinearForm(product).assemble(at_floor)),
        skfem.LinearForm(flow).assemble(at_floor),
        face,
        points[face],
        end,
        up[end],
        wet,
    )


@dataclass(frozen=True, eq=False)
class _Fluid:
    """Water without a dam: as :class:`FullWater`, with the near field and its nodes by the unknowns."""

    near: _Near
    tie: Sparse
    mass: Sparse
    stiffness: Sparse
    damping_floor: Sparse
    damping_far: Sparse
    ground: Floats
    patterns: Floats
    first: float
    distance: Floats


# All meshes of a dam have the same water before them, and its evidence a larger one.
_FLUIDS: Kept[_Fluid] = Kept(2)


def _fluid(near: _Near, far: Channel, constants: tuple[float, float, float], surface: float, side: float) -> _Fluid:
    wave_speed, density, admittance = constants
    depth = float(near.heights[-1] - near.heights[0])
    tie, beyond = _tie(near, far)

    def joined(matrix: Sparse, other: Sparse | None) -> Sparse:
        total = tie.T @ matrix @ tie
        if other is not None:
            total = total + beyond @ other @ beyond.T
        # In order, so that no later use puts it in order, and all of them see the same.
        result = density * sparse.csc_matrix(total)
        result.sort_indices()
        return result

    # All of the wall moves with the ground, also what is below the lowest node.
    wall = _wall(near)
    # Out of the water is down: a floor that rises pushes the other way.
    ground = np.column_stack([wall[:, 0], wall[:, 1] - near.lift])
    ground = density * (tie.T @ ground)
    ground[:, 1] -= density * (beyond @ far.lift)
    return _Fluid(
        near,
        tie,
        joined(near.mass / wave_speed**2, far.mass),
        joined(near.stiffness, far.stiffness),
        joined(admittance * near.floor_mass, far.damping_floor),
        joined(sparse.csr_matrix(near.mass.shape), far.damping_far),
        ground * [side, 1.0],
        density * (tie.T @ _patterns(near, surface)),
        np.pi * wave_speed / (2.0 * depth),
        np.concatenate([np.zeros(tie.shape[1] - far.lift.size), far.distance / depth]),
    )


def _before(paths: Sequence[Floats], fluid: _Fluid, density: float, surface: float, side: float) -> FullWater:
    """Return water before the faces of a dam."""
    flow, interpolated = _face_matrices(paths, fluid.near, surface)
    mirror = sparse.diags(np.tile([side, 1.0], flow.shape[1] // 2))
    return FullWater(
        fluid.mass,
        fluid.stiffness,
        fluid.damping_floor,
        fluid.damping_far,
        density * sparse.csr_matrix(fluid.tie.T @ flow) @ mirror,
        fluid.ground,
        -density * (interpolated @ fluid.tie),
        fluid.patterns,
        fluid.first,
        fluid.distance,
    )


def _tie(near: _Near, far: Channel) -> tuple[Sparse, Sparse]:
    """Return the nodes of the near field by the unknowns, and the unknowns by those of the far field.

    Unknowns are wet nodes of the near field but those of its far end, then all amplitudes of the far field, of which
    the first ones are that end."""
    size = near.mass.shape[0]
    inner = np.setdiff1d(near.wet, near.end)
    shapes, count = far.depth_shapes, far.mass.shape[0]
    rows = np.concatenate([inner, np.repeat(near.end, shapes.shape[1])])
    columns = np.concatenate([np.arange(inner.size), np.tile(inner.size + np.arange(shapes.shape[1]), near.end.size)])
    values = np.concatenate([np.ones(inner.size), shapes.reshape(-1)])
    total = inner.size + count
    tie = sparse.csr_matrix((values, (rows, columns)), (size, total))
    beyond = sparse.csr_matrix((np.ones(count), (inner.size + np.arange(count), np.arange(count))), (total, count))
    return tie, beyond


def _face_matrices(paths: Sequence[Floats], near: _Near, surface: float) -> tuple[Sparse, Sparse]:
    """Return Q^T, the flow through the face into the near field's nodes of each velocity of the nodes of the paths, and
    the potential at these nodes of those of the near field."""
    heights = near.face_points[:, 1]
    count = sum(len(path) for path in paths)
    rows, columns, values = [], [], []
    first = 0
    for path in paths:
        for edge in range(0, len(path) - 2, 2):
            corners = path[edge : edge + 3]
            marks = heights[::2][(heights[::2] > corners[0, 1]) & (heights[::2] < min(corners[2, 1], surface))]
            ends = np.array([corners[0, 1], *marks, min(corners[2, 1], surface)])
            for low, high in pairwise(ends):
                if high <= low:
                    continue
                z = (low + high) / 2.0 + (high - low) / 2.0 * GAUSS_POINTS
                # Edges are straight, or so nearly that the height tells the place.
                place = 2.0 * (z - corners[0, 1]) / (corners[2, 1] - corners[0, 1]) - 1.0
                own = edge_shapes(place)
                nodes, shares = edge_shares(heights, z)
                slope = (corners[2, 0] - corners[0, 0]) / (corners[2, 1] - corners[0, 1])
                # The normal out of the water times the length: (1, -slope) dz.
                for axis, normal in ((0, 1.0), (1, -slope)):
                    entry = np.einsum("pi,pj,p->pij", shares, own, GAUSS_WEIGHTS * (high - low) / 2.0 * normal)
                    rows.append(np.broadcast_to(near.face[nodes][:, :, None], entry.shape).reshape(-1))
                    column = 2 * (first + edge + np.arange(3)) + axis
                    columns.append(np.broadcast_to(column, entry.shape).reshape(-1))
                    values.append(entry.reshape(-1))
        first += len(path)
    row, column, value = (np.concatenate(parts) for parts in (rows, columns, values))
    flow = sparse.csr_matrix((value, (row, column)), (near.mass.shape[0], 2 * count))
    z = np.concatenate([path[:, 1] for path in paths])
    under = np.flatnonzero(z < surface)
    nodes, shares = edge_shares(heights, z[under])
    interpolated = sparse.csr_matrix(
        (shares.reshape(-1), (np.repeat(under, 3), near.face[nodes].reshape(-1))), (count, near.mass.shape[0])
    )
    return flow, interpolated


def _wall(near: _Near) -> Floats:
    """Return the flow through the whole face of unit velocities in x and z."""
    edges = near.face_points[2::2] - near.face_points[:-2:2]
    sums = np.zeros((near.mass.shape[0], 2))
    for edge, (across, up) in enumerate(edges):
        nodes = near.face[2 * edge : 2 * edge + 3]
        sums[nodes] += np.array([1.0, 4.0, 1.0])[:, None] / 6.0 * [up, -across]
    return sums


def _patterns(near: _Near, surface: float) -> Floats:
    """Return the flow of normal velocities that are polynomials over the depth, the higher the smaller."""
    heights = near.face_points[:, 1]
    flow = np.zeros((near.mass.shape[0], _PATTERNS))
    for edge, (low, high) in enumerate(pairwise(heights[::2])):
        z = (low + high) / 2.0 + (high - low) / 2.0 * GAUSS_POINTS
        patterns = smooth_patterns(z, heights[0], surface, _PATTERNS)
        nodes = near.face[2 * edge : 2 * edge + 3]
        flow[nodes] += np.einsum("pi,pk,p->ik", edge_shapes(GAUSS_POINTS), patterns, GAUSS_WEIGHTS * (high - low) / 2.0)
    scaled: Floats = flow / (1.0 + np.arange(_PATTERNS))
    return scaled


@dataclass(frozen=True, eq=False)
class _Few:
    """Squared frequencies (m,), shapes (N, m), what floor and far field take (m, m), and the error that they leave."""

    squares: Floats
    shapes: Floats
    taken_floor: Floats
    taken_far: Floats
    error: float


# The same water lies before dams whose meshes differ: those of the evidence of a run.
_KEPT: Kept[_Few] = Kept(8)


def _reduced(full: FullWater, highest: float, enough: float) -> ReducedWater:
    matrices = (full.mass, full.stiffness, full.damping_floor, full.damping_far)
    content = hashlib.sha256()
    sparse = (part for matrix in matrices for part in (matrix.data, matrix.indices, matrix.indptr))
    for part in (*sparse, full.ground, full.patterns, full.distance):
        content.update(part.tobytes())
    key = (content.digest(), full.first, highest, enough)
    few = _KEPT.get(key, lambda: _few(full, highest, enough))
    return ReducedWater(
        few.squares,
        few.taken_floor + few.taken_far,
        few.taken_floor,
        few.taken_far,
        np.ascontiguousarray((full.coupling.T @ few.shapes).T),
        few.shapes.T @ full.ground,
        np.ascontiguousarray(full.pressure @ few.shapes),
        highest,
        few.error,
    )


def _few(full: FullWater, highest: float, enough: float) -> _Few:
    inputs = np.column_stack([full.ground, full.patterns])
    norm = norm_of(full.body, full.first, (1.0 + full.distance) ** -_FADING)
    modes, error = reduced_modes(full.body, inputs, norm, _rates(full.first, 2.0 * np.pi * highest), _MOST, enough)
    squares, shapes = modes
    return _Few(squares, shapes, congruent(full.damping_floor, shapes), congruent(full.damping_far, shapes), error)


def _rates(first: float, limit: float) -> Rates:
    sampled, chosen = (_motions(first, limit, count) for count in (_SAMPLED, _CHOSEN))
    sudden = [complex(factor * limit) for factor in _SUDDEN]
    checked = [(low + high) / 2.0 for low, high in pairwise(chosen[::2])][::2]
    return Rates(sampled + sudden, chosen + sudden, checked + [1.2 * rate for rate in sudden], 0)


def _motions(first: float, limit: float, count: int) -> list[complex]:
    """Return rates at even circular frequencies up to a limit, and at some about the cut-offs of the channel."""
    cut = first * np.arange(1, limit / first + 1.0, 2.0)
    about = np.outer(cut, [0.9, 0.97, 1.0, 1.03, 1.1]).reshape(-1)
    even = np.linspace(0.0, limit, count)
    # A little growth keeps the resonances of a channel without losses finite, as any shaking does that has an end.
    return [complex(_GROWTH * first, omega) for omega in sorted({*even, *about}) if omega <= limit]
