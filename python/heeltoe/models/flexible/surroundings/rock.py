"""The rock below the dam, with waves: a half-plane at rest (free-field formulation), in few unknowns.

Displacements are relative to the free field, the motion that the level surface of the rock would have without dam and
water. For waves from straight below that is the record, the same at all places, so the rock has mass, stiffness and
losses but no earthquake load: it is moved by the dam alone (Fenves and Chopra 1984, EAGD-84). Plane strain,

    M u'' + C u' + K u = T^T f,    C = 2 xi / omega_r K + integral sigma(r) B^T D B,

on biquadratic elements. Around a block below the base lie rings that are all alike but for their size, out to many
widths of the base, where springs and dashpots hold the last one (normal ``rho c_p v + G u / r``, along it ``rho c_s v +
G u / (2 r)``). Waves leave because the rings damp more and more, sigma rising with the distance r: every wave meets the
same layer in wavelengths, and has gone where the elements grow too large for it. In shapes normalised by the mass,

    x'' + C x' + Omega^2 x = S^T f,    u_base = S x,

symmetric and passive. The shapes are static ones for a force on every node of the base and those of smooth tractions at
frequencies from the lowest mode of all these elements, near ``c_s`` over the distance of the last ring, to the highest
frequency. Even steps of the root of the frequency lie close together down there, where an earthquake still moves a dam
far below all modes of its own."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from heeltoe.base.arrays import Floats, Integers
from heeltoe.models.flexible.surroundings.edges import (
    GAUSS_POINTS,
    GAUSS_WEIGHTS,
    edge_shapes,
    edge_shares,
    smooth_patterns,
)
from heeltoe.models.flexible.surroundings.reduction import (
    Complexes,
    LinearBody,
    Rates,
    Sparse,
    congruent,
    norm_of,
    reduced_modes,
)

#: Distance of the last ring in half widths of the base.
EXTENT = 100.0
# Signs of the components of a motion in a mirror at the middle of the base: x and z, and that at right angles to both.
_IN_PLANE, _ACROSS_VALLEY = (-1.0, 1.0), (1.0,)
#: The level surface goes on beyond heel and toe by so many edges of the mesh, on which a dam that slides stands.
BEYOND = 1
# Elements across the base at least, and over the shortest shear wave.
_ACROSS, _PER_WAVE = 8, 5.0
# Next to heel and toe, where the stresses are steep, elements are halved down to such a part of the base.
_FINEST = 64
# sigma = _GRADIENT r / c_s, from a gentle start of so many half widths of the base on.
_GRADIENT, _START = 0.05, 4.0
# Patterns of tractions along the base, polynomials of rising degree, whose answers are kept.
_PATTERNS = 4
# What is far counts less in the choice of shapes: weights fall with this power of the distance.
_FADING = 0.5
# Sampled frequencies at least; some, and more for each time that half the base is as long as the shortest wave over 2
# pi; terms of each beyond the answer, and the growth of the motions over their frequency.
_LEAST, _SAMPLED, _BY_WAVES, _MOMENTS, _GROWTH = 5, 3, 0.65, 4, 0.5
# Frequencies for each of these at which shapes are chosen, up to which part of the highest, and the growth where they
# are chosen and checked: with more of it the peaks between them are flat, and their error is not seen. Shapes at most
# beside the static ones.
_CHOSEN, _ABOVE, _LITTLE_GROWTH, _MOST = 6, 1.05, 0.01, 200
# Of nodes that are as far on the other side but for such a part of half a base the rock is the same on both sides.
_SAME = 1e-7
# Singular values below this part of the largest are what both sides differ by in rounding.
_NOTHING = 1e-5
# Mass of rock that has none, as a part of its own: far too little for any wave.
_MASSLESS = 1e-6
#: The relative error of the answers to smooth tractions that a reduction may leave.
ENOUGH = 0.01


@dataclass(frozen=True)
class RockMaterial:
    """Rock, linear elastic in plane strain.

    Attributes
    ----------
    modulus
        Young's modulus [Pa].
    poisson
        Poisson's ratio.
    density
        [kg/m3].
    damping
        Ratio of the material's own damping at `damping_frequency` [Hz], in proportion to the stiffness.
    radiation
        Whether waves leave: without it springs alone hold the last ring, and nothing but the material damps.
    massless
        Whether it has no mass, and so no waves.
    """

    modulus: float
    poisson: float
    density: float
    damping: float = 0.0
    damping_frequency: float = 5.0
    radiation: bool = True
    massless: bool = False

    @property
    def shear(self) -> float:
        """Shear modulus [Pa]."""
        return self.modulus / (2.0 * (1.0 + self.poisson))

    @property
    def shear_speed(self) -> float:
        """Speed of shear waves [m/s]."""
        return float(np.sqrt(self.shear / self.density))

    @property
    def pressure_speed(self) -> float:
        """Speed of pressure waves [m/s]."""
        return self.shear_speed * float(np.sqrt(2.0 * (1.0 - self.poisson) / (1.0 - 2.0 * self.poisson)))


@dataclass(frozen=True, eq=False)
class FullRock:
    """Rock in all its finite elements; N unknowns, of which those of the base come first, x and z of its nodes in turn,
    or one at right angles to the section for each.

    Attributes
    ----------
    mass, stiffness
        (N, N) [kg per m], [N/m per m].
    damping_material, damping_radiation
        What the material takes and what leaves as waves, (N, N) [N s/m per m].
    base
        (c n,) unknowns of the nodes of the base, c components of each: 0 to c n - 1.
    points, axis
        Where the unknowns are, x from the middle of the base and z [m], (N, 2), and whether they move along x, 0, or
        along z, 1, (N,); 0 where there is but one component.
    mirror
        (c,) sign of each component in a mirror at the middle of the base.
    """

    mass: Sparse
    stiffness: Sparse
    damping_material: Sparse
    damping_radiation: Sparse
    base: Integers
    points: Floats
    axis: Integers
    mirror: tuple[float, ...] = _IN_PLANE

    @cached_property
    def body(self) -> LinearBody:
        """Mass, damping, stiffness."""
        return LinearBody(self.mass, self.damping_material + self.damping_radiation, self.stiffness)


@dataclass(frozen=True, eq=False)
class ReducedRock:
    """Rock in m shapes x normalised by the mass: ``x'' + C x' + Omega^2 x = S^T f``, ``u_base = S x``.

    Attributes
    ----------
    omega_squared
        (m,) squared circular frequencies [1/s2].
    damping
        (m, m) symmetric, positive semidefinite [1/s]: ``damping_material + damping_radiation``.
    damping_material, damping_radiation
        What the material takes and what leaves as waves: the power is ``x'^T C x'`` of each [W per m].
    shapes
        (2 n, m) rows S: x and z in turn of the n nodes of the base.
    highest
        Frequency [Hz] up to which it answers well.
    error
        Largest relative error of the answers to smooth tractions up to there that the reduction has left.
    halves
        How many of the shapes are the same on both sides of the middle of the base, and how many opposite, where the
        rock is the same there and nothing couples them; elsewhere how many there are.
    mirror
        (c,) sign of each of the components of a node in a mirror at the middle of the base.
    """

    omega_squared: Floats
    damping: Floats
    damping_material: Floats
    damping_radiation: Floats
    shapes: Floats
    highest: float
    error: float
    halves: tuple[int, ...]
    mirror: tuple[float, ...] = _IN_PLANE

    def compliance(self, omega: float, forces: Complexes) -> Complexes:
        """Return the displacements of the base under forces (2 n, k) on it, both like exp(i omega t)."""
        operator = np.diag(self.omega_squared - omega**2 + 0j) + 1j * omega * self.damping
        return self.shapes @ np.linalg.solve(operator, self.shapes.T @ forces + 0j)

    def stiffer(self, factor: float) -> ReducedRock:
        """Return the same rock with its modulus multiplied by `factor`: its waves are faster by the root of that, the
        energy that leaves grows by it, so does the loss of the material with the stiffness, and the shapes remain. The
        error remains too, up to a frequency that is higher by that root.
        """
        root = math.sqrt(factor)
        own, leaving = factor * self.damping_material, root * self.damping_radiation
        return replace(
            self,
            omega_squared=factor * self.omega_squared,
            damping=own + leaving,
            damping_material=own,
            damping_radiation=leaving,
            highest=root * self.highest,
        )

    def followed(self, base: Floats, fewer: Floats) -> ReducedRock:
        """Return the rock below a base (n, 2) whose nodes follow those (k, 2) of longer quadratic edges."""
        nodes, shares = edge_shares(fewer[:, 0], base[:, 0])
        share = np.zeros((len(base), len(fewer)))
        share[np.arange(len(base))[:, None], nodes] = shares
        tie = np.kron(share, np.eye(len(self.mirror)))
        # What of the motion of the base is none of these edges: all motions but those of it remain.
        off = scipy.linalg.null_space(tie.T).T @ self.shapes
        squares, shapes, own, leaving = [], [], [], []
        ends = np.cumsum(self.halves)
        for half, part in enumerate(slice(end - count, end) for count, end in zip(self.halves, ends, strict=True)):
            free = scipy.linalg.null_space(off[:, part], rcond=_NOTHING)
            square, mixed = scipy.linalg.eigh(free.T @ (self.omega_squared[part, None] * free))
            kept = free @ mixed
            squares.append(np.maximum(square, 0.0))
            tied = np.linalg.lstsq(tie, self.shapes[:, part] @ kept, rcond=None)[0]
            shapes.append(tied if len(self.halves) == 1 else _same_sides(tied, self.mirror, opposite=half == 1))
            own.append(congruent(self.damping_material[part, part], kept))
            leaving.append(congruent(self.damping_radiation[part, part], kept))
        return _joined(squares, shapes, own, leaving, (self.highest, self.error), self.mirror)


def _same_sides(shapes: Floats, mirror: tuple[float, ...], *, opposite: bool) -> Floats:
    """Return shapes (c n, m) at the base that are the same on both sides of the middle, or opposite, but for rounding,
    without rounding: the kernel sees by that which nodes move alike."""
    sides = shapes.reshape(-1, len(mirror), shapes.shape[1])
    mirrored = sides[::-1] * np.array(mirror)[:, None]
    exact: Floats = (sides - mirrored if opposite else sides + mirrored) / 2.0
    return exact.reshape(shapes.shape)


def _joined(
    squares: list[Floats],
    shapes: list[Floats],
    own: list[Floats],
    leaving: list[Floats],
    worth: tuple[float, float],
    mirror: tuple[float, ...],
) -> ReducedRock:
    """Return rock of halves that do not move each other, with their shapes at the base; `worth` has the highest
    frequency and the error."""
    taken_own, taken_leaving = scipy.linalg.block_diag(*own), scipy.linalg.block_diag(*leaving)
    return ReducedRock(
        np.concatenate(squares),
        taken_own + taken_leaving,
        taken_own,
        taken_leaving,
        np.hstack(shapes),
        *worth,
        tuple(square.size for square in squares),
        mirror,
    )


def reduced_rock(
    base: Floats,
    material: RockMaterial,
    *,
    highest: float = 15.0,
    extent: float = EXTENT,
    enough: float = ENOUGH,
    across: bool = False,
) -> ReducedRock:
    """Return the rock below a base in few unknowns.

    Parameters
    ----------
    base
        Nodes (x, z) of the base from heel to toe, with those in the middle of the quadratic edges, (n, 2) [m].
    material
        What the rock is.
    highest
        Frequency [Hz] up to which the answer is to be good.
    extent
        Distance of the last ring in half widths of the base.
    enough
        Relative error that the reduction may leave.
    across
        Whether it moves at right angles to the section, by antiplane shear, and not in the section.
    """
    half = float(np.ptp(base[:, 0])) / 2.0
    full = full_rock(base, material, highest=highest, extent=extent, across=across)
    return _reduced(full, base, material, _rates(material, extent * half, half, highest), highest, enough)


def full_rock(
    base: Floats, material: RockMaterial, *, highest: float = 15.0, extent: float = EXTENT, across: bool = False
) -> FullRock:
    """Return the rock below a base in all its finite elements; parameters as in :func:`reduced_rock`."""
    import skfem

    count = base_elements(len(base) // 2, float(np.ptp(base[:, 0])), material, highest)
    refined = _refined(base[:, 0], count)
    middle, half = (base[0, 0] + base[-1, 0]) / 2.0, (base[-1, 0] - base[0, 0]) / 2.0
    points, elements = _rings(refined - middle, count, half, extent)
    mesh = skfem.MeshQuad(points.T.copy(), elements.T.copy())
    element = skfem.ElementQuad2() if across else skfem.ElementVector(skfem.ElementQuad2())
    mirror = _ACROSS_VALLEY if across else _IN_PLANE
    basis = skfem.Basis(mesh, element, intorder=4)
    shear = material.shear
    distance = np.maximum(np.hypot(*basis.global_coordinates()) - half, 0.0)
    rise = _GRADIENT / material.shear_speed * distance**2 / (distance + _START * half)

    far = skfem.FacetBasis(
        mesh,
        element,
        facets=_last_ring(mesh, extent * half),
        intorder=4,
    )

    tie, places, axis = _tie(basis, base, middle, half, len(mirror))

    def tied(matrix: Any) -> Sparse:
        return sparse.csc_matrix(tie.T @ matrix @ tie)

    none = sparse.csc_matrix((tie.shape[1], tie.shape[1]))
    strains = _shears(basis, material) if across else _strains(basis, material)
    moved = _motions(basis, len(mirror))
    stiffness = tied(_products(basis, strains, basis.dx))
    mass = tied(_products(basis, (moved, moved), material.density * basis.dx))
    at_end, away = _end_motions(far, len(mirror)), np.hypot(*far.global_coordinates())
    # The springs stand for rock, too.
    stiffness = stiffness + tied(_products(far, (at_end, shear / 2.0 * at_end), far.dx / away))
    own = material.damping / (np.pi * material.damping_frequency) * stiffness
    leaving = none
    if material.radiation and not material.massless:
        speeds = np.full(at_end.shape[2], material.shear_speed)
        speeds[len(mirror) :] = material.pressure_speed - material.shear_speed
        taken = _products(far, (at_end, material.density * speeds[:, None] * at_end), far.dx)
        leaving = tied(_products(basis, strains, rise * basis.dx) + taken)
    return FullRock(
        (_MASSLESS if material.massless else 1.0) * mass,
        stiffness,
        own,
        leaving,
        np.arange(len(mirror) * len(base)),
        places,
        axis,
        mirror,
    )


def _strains(basis: Any, material: RockMaterial) -> tuple[Floats, Floats]:
    """Return the strains xx, zz and xz of each shape of the elements (e, q, 3, s) at their points of integration, and
    the stresses that go with them in plane strain [Pa]."""
    gradient = np.stack([field[0].grad for field in basis.basis])
    strain = np.stack([gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]])
    shear, poisson = material.shear, material.poisson
    along, aside = (2.0 * shear * share / (1.0 - 2.0 * poisson) for share in (1.0 - poisson, poisson))
    law = np.array([[along, aside, 0.0], [aside, along, 0.0], [0.0, 0.0, shear]])
    strain = np.ascontiguousarray(strain.transpose(2, 3, 0, 1))
    return strain, law @ strain


def _shears(basis: Any, material: RockMaterial) -> tuple[Floats, Floats]:
    """Return what :func:`_strains` does of antiplane shear: the strains xy and zy, (e, q, 2, s), and their stresses."""
    gradient = np.stack([field[0].grad for field in basis.basis])
    strain = np.ascontiguousarray(gradient.transpose(2, 3, 1, 0))
    return strain, material.shear * strain


def _motions(basis: Any, components: int) -> Floats:
    """Return the motion in x and z of each shape of the elements at their points of integration, (e, q, 2, s), or that
    of its only component."""
    shape = (components, *basis.dx.shape)
    values = np.stack([np.broadcast_to(np.asarray(field[0]), shape) for field in basis.basis])
    return np.ascontiguousarray(values.transpose(2, 3, 1, 0))


def _end_motions(basis: Any, components: int) -> Floats:
    """Return the motion of each shape along the last ring, as :func:`_motions` does, and in the section that at right
    angles to the ring beside x and z, (e, q, 3, s)."""
    moved = _motions(basis, components)
    if components == 1:
        return moved
    normal = np.einsum("ceq,eqcs->eqs", basis.normals, moved)
    return np.concatenate([moved, normal[:, :, None]], axis=2)


def _products(basis: Any, fields: tuple[Floats, Floats], weights: Floats) -> Sparse:
    """Return the integrals of the products of two fields (e, q, c, s) of the shapes with weights (e, q), assembled."""
    first, second = fields
    count, _, _, shapes = first.shape
    own = first.reshape(count, -1, shapes)
    heavy = (weights[:, :, None, None] * second).reshape(count, -1, shapes)
    entries = own.swapaxes(1, 2) @ heavy
    places = basis.element_dofs.T
    rows, columns = np.repeat(places, shapes, axis=1), np.tile(places, (1, shapes))
    return sparse.csr_matrix((entries.reshape(-1), (rows.reshape(-1), columns.reshape(-1))), (basis.N, basis.N))


def halvings(edges: int) -> int:
    """Return how often the edges along a base are halved until rock of the coarsest elements has one for each."""
    return max(0, math.ceil(math.log2(_ACROSS / edges)))


def base_elements(edges: int, width: float, material: RockMaterial, highest: float) -> int:
    """Return the number of elements along a base with given edges and width [m], before the outer ones are halved: each
    edge is cut into as many as the shortest wave needs."""
    return edges * math.ceil(max(_ACROSS, _PER_WAVE * width * highest / material.shear_speed) / edges)


def _refined(x: Floats, count: int) -> Floats:
    """Return corners of `count` elements along the base, of which the outer ones are halved."""
    corners = x[::2]
    pieces = count // (corners.size - 1)
    parts = [np.linspace(low, high, pieces + 1)[1:] for low, high in pairwise(corners)]
    even = np.concatenate([corners[:1], *parts])
    near = _halved(even.size - 1)
    first, last = even[0] + near * (even[1] - even[0]), even[-1] - near[::-1] * (even[-1] - even[-2])
    return np.concatenate([even[:1], first, even[1:-1], last, even[-1:]])


def _halved(count: int) -> Floats:
    """Return where the first of `count` elements along the base is cut, as parts of it."""
    parts: Floats = 0.5 ** np.arange(max(0, round(np.log2(_FINEST / count))), 0, -1)
    return parts


def _rings(across: Floats, count: int, half: float, extent: float) -> tuple[Floats, Integers]:
    """Return corners and elements of a block below the base and of rings around it, about the middle of the base, which
    had `count` elements before the outer ones were halved."""
    columns, near = across.size, _halved(count)
    even = max(4, count // 2)
    depths = -half / even * np.concatenate([[0.0], near, np.arange(1, even + 1)])
    rows = depths.size - 1
    block = np.stack(np.meshgrid(across, depths, indexing="ij"), axis=-1).reshape(-1, 2)

    def number(column: Any, row: Any) -> Any:
        return column * (rows + 1) + row

    elements = [
        (number(i, j + 1), number(i + 1, j + 1), number(i + 1, j), number(i, j))
        for i in range(columns - 1)
        for j in range(rows)
    ]
    # From the surface upstream down, along below and up again.
    path = np.concatenate(
        [
            number(0, np.arange(rows)),
            number(np.arange(columns - 1), rows),
            number(columns - 1, np.arange(rows, -1, -1)),
        ]
    )
    rings = int(np.ceil(np.log(extent) / np.log1p(1.0 / even)))
    factors = extent ** (np.concatenate([near, np.arange(1, rings + 1)]) / rings)
    points = [block, *(factor * block[path] for factor in factors)]
    inner = path
    for ring in range(factors.size):
        outer = len(block) + ring * path.size + np.arange(path.size)
        elements += [(outer[i], outer[i + 1], inner[i + 1], inner[i]) for i in range(path.size - 1)]
        inner = outer
    return np.vstack(points), np.array(elements, dtype=np.int64)


def _last_ring(mesh: Any, distance: float) -> Integers:
    """Return the facets of the last ring."""
    facets: Integers = mesh.facets_satisfying(
        lambda x: np.maximum(np.abs(x[0]), -x[1]) > distance * (1.0 - 1e-6), boundaries_only=True
    )
    return facets


def _tie(basis: Any, base: Floats, middle: float, half: float, components: int) -> tuple[Sparse, Floats, Integers]:
    """Return all displacements by the unknowns, which follow the nodes of the base where the dam stands, and of the
    unknowns the places and axes."""
    places = basis.doflocs
    under = (np.abs(places[1]) < 1e-9 * half) & (np.abs(places[0]) < half * (1.0 + 1e-9))
    axis = np.empty(places.shape[1], dtype=np.int64)
    for number in range(components):
        for dofs in (basis.nodal_dofs, basis.facet_dofs, basis.interior_dofs):
            axis[dofs[number]] = number
    led, free = np.flatnonzero(under), np.flatnonzero(~under)
    nodes, shares = edge_shares(base[:, 0] - middle, places[0, led])
    first = components * len(base)
    rows = np.concatenate([np.repeat(led, 3), free])
    columns = np.concatenate([(components * nodes + axis[led][:, None]).reshape(-1), first + np.arange(free.size)])
    values = np.concatenate([shares.reshape(-1), np.ones(free.size)])
    shape = (places.shape[1], first + free.size)
    nodes_of_base = np.repeat(base - [middle, base[0, 1]], components, axis=0)
    return (
        sparse.csr_matrix((values, (rows, columns)), shape),
        np.vstack([nodes_of_base, places[:, free].T]),
        np.concatenate([np.tile(np.arange(components), len(base)), axis[free]]),
    )


def _reduced(
    full: FullRock, base: Floats, material: RockMaterial, rates: Rates, highest: float, enough: float
) -> ReducedRock:
    # The norm of the shapes weighs mass and stiffness where a wave is as long as the base is wide.
    half = np.ptp(base[:, 0]) / 2.0
    weight = (1.0 + np.hypot(*full.points.T) / half) ** -_FADING
    weight[full.base] = 1.0
    norm = norm_of(full.body, np.pi / 2.0 * material.shear_speed / half, weight)
    tractions = smooth_tractions(base) if full.mirror == _IN_PLANE else smooth_tractions(base)[::2, ::2]
    pushed = np.zeros((full.mass.shape[0], tractions.shape[1]))
    pushed[full.base] = tractions
    halves = _halves(full, half)
    parts = [_part(full, spread, pushed, norm, rates, _MOST // len(halves), enough) for spread in halves]
    own, leaving = (
        [congruent(matrix, shapes) for _, shapes, _ in parts]
        for matrix in (full.damping_material, full.damping_radiation)
    )
    shapes = [shapes[full.base] for _, shapes, _ in parts]
    worth = (highest, max(part[2] for part in parts))
    return _joined([squares for squares, _, _ in parts], shapes, own, leaving, worth, full.mirror)


def _part(
    full: FullRock, spread: Sparse, pushed: Floats, norm: Sparse, rates: Rates, most: int, enough: float
) -> tuple[Floats, Floats, float]:
    """Return frequencies, shapes and error of the motions that `spread` makes of some unknowns."""
    mass, damping, stiffness = (spread.T @ matrix @ spread for matrix in (full.mass, full.body.damping, full.stiffness))
    body = LinearBody(mass, damping, stiffness)
    inputs = spread.T @ pushed
    inputs = inputs[:, np.abs(inputs).max(axis=0) > 1e-9 * np.abs(pushed).max(axis=0)]
    base = np.unique(spread.tocsr()[full.base].nonzero()[1])
    unit = np.zeros((mass.shape[0], base.size))
    unit[base, np.arange(base.size)] = 1.0
    modes, error = reduced_modes(body, inputs, spread.T @ norm @ spread, rates, most, enough, body.at_rest(unit))
    squares, shapes = modes
    return squares, spread @ shapes, error


def _rates(material: RockMaterial, reach: float, half: float, highest: float) -> Rates:
    """Return the rates at which rock out to a last ring [m] below half a base [m] is looked at."""
    if material.massless:
        return Rates([], [], [], 0)
    limit = 2.0 * np.pi * highest
    lowest = material.shear_speed / reach

    def rates(growth: float, above: float, count: int) -> list[complex]:
        roots = np.linspace(math.sqrt(lowest), math.sqrt(above * limit), count)
        return [complex(growth, 1.0) * omega for omega in roots**2]

    count = max(_LEAST, _SAMPLED + math.ceil(_BY_WAVES * limit * half / material.shear_speed))
    # Every second of those that lie between the sampled ones, beginning with the lowest.
    checked = rates(_LITTLE_GROWTH, 1.0, 2 * count - 1)[1::4]
    return Rates(rates(_GROWTH, 1.0, count), rates(_LITTLE_GROWTH, _ABOVE, _CHOSEN * count), checked, _MOMENTS)


def _halves(full: FullRock, half: float) -> list[Sparse]:
    """Return all motions, (N, n), as those that are the same on both sides of the middle and those that are opposite,
    where the rock is the same on both sides and neither moves the other; elsewhere all together."""
    count = full.points.shape[0]
    everything = [sparse.identity(count, format="csr")]
    twin = _twins(full, _SAME * half)
    away = full.points[twin] - full.points * [-1.0, 1.0]
    if np.hypot(*away.T).max() > _SAME * half:
        return everything
    # Downstream is upstream in a mirror.
    turned = np.array(full.mirror)[full.axis]
    halves = []
    for sign in (1.0, -1.0):
        first = np.flatnonzero((np.arange(count) < twin) | ((np.arange(count) == twin) & (turned == sign)))
        other = twin[first]
        values = np.where(first == other, 0.5, np.sqrt(0.5))
        rows = np.concatenate([first, other])
        columns = np.tile(np.arange(first.size), 2)
        halves.append(
            sparse.csr_matrix(
                (np.concatenate([values, sign * turned[first] * values]), (rows, columns)), (count, first.size)
            )
        )
    return halves


def _twins(full: FullRock, same: float) -> Integers:
    """Return of each unknown (N,) the one as far on the other side of the middle, where the rock is the same there but
    for lengths of rounding."""

    def places(values: Floats) -> Integers:
        ascending = np.argsort(values)
        result = np.empty(values.size, dtype=np.int64)
        result[ascending] = np.cumsum(np.diff(values[ascending], prepend=values[ascending[0]]) > same)
        return result

    x, z = full.points.T
    here, there = (np.lexsort([places(along), places(z), full.axis]) for along in (x, -x))
    twin = np.empty(x.size, dtype=np.int64)
    twin[there] = here
    return twin


def smooth_tractions(base: Floats) -> Floats:
    """Return forces on the nodes of the base of tractions that are polynomials along it, in x and in z, (2 n, 2 k)."""
    x = base[:, 0]
    shapes = edge_shapes(GAUSS_POINTS)
    forces = np.zeros((len(x), 2, _PATTERNS, 2))
    for edge in range(0, len(x) - 2, 2):
        low, high = x[edge], x[edge + 2]
        at = (low + high) / 2.0 + (high - low) / 2.0 * GAUSS_POINTS
        patterns = smooth_patterns(at, x[0], x[-1], _PATTERNS)
        share = np.einsum("pi,pk,p->ik", shapes, patterns, GAUSS_WEIGHTS / 2.0) * (high - low) / (x[-1] - x[0])
        for axis in (0, 1):
            forces[edge : edge + 3, axis, :, axis] += share
    scaled: Floats = (forces / (1.0 + np.arange(_PATTERNS))[:, None]).reshape(2 * len(x), 2 * _PATTERNS)
    return scaled
