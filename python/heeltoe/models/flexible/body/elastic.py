"""Elastic bodies: stiffness, mass, static loads, the bonded dam and stresses.

Linear elasticity on eight-node serendipity quadrilaterals with 3 x 3 Gauss points and consistent mass (Zienkiewicz
and Taylor, The Finite Element Method, volume 1), per metre of dam. Degree of freedom 2 i is the displacement of node
i downstream, 2 i + 1 that upwards."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sparse

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.loads import nappe_heads
from heeltoe.models.flexible.body.loads import (
    anchor_forces,
    ice_forces,
    nappe_forces,
    silt_forces,
    uplift_forces,
    water_forces,
)
from heeltoe.models.flexible.body.virtual_water import virtual_masses
from heeltoe.models.flexible.mesh.checks import CORNERS, MIDDLES, jacobians, shape_gradients
from heeltoe.models.flexible.mesh.dam import BodyMesh, DamMesh
from heeltoe.models.flexible.surroundings.edges import edge_shapes

Sparse = Any
"""A matrix of scipy.sparse, which has no types of its own."""
Solve = Callable[[Floats], Floats]
"""Takes forces (n,) or (n, k) to displacements."""

# Young's modulus [Pa]: below the first not even a soil, above the second nothing that could not be called rigid.
_SOFTEST, _STIFFEST = 1e6, 1e16


@dataclass(frozen=True, eq=False)
class Body:
    """One elastic part of the dam.

    Parameters
    ----------
    mesh
        Its mesh of n nodes.
    stiffness
        Symmetric, shape (2 n, 2 n) [N/m per m].
    mass
        Consistent mass of concrete and virtual water, shape (2 n, 2 n) [kg per m].
    mass_concrete
        That of the concrete alone.
    load
        Sum of the static loads, shape (2 n,) [N per m], x downstream and z up.
    loads
        The static loads by name: weight, reservoir, tailwater, uplift; ice, silt and anchors (their prestress) where
        there are any.
    load_per_vertical
        Loads per unit of upward ground acceleration beside inertia, of water that follows it, shape (2 n,) [kg per m].
    elasticity
        Stresses (xx, zz, xz) of the strains (xx, zz, 2 xz), shape (3, 3) [Pa].
    """

    mesh: BodyMesh
    stiffness: Sparse
    mass: Sparse
    mass_concrete: Sparse
    load: Floats
    loads: dict[str, Floats]
    load_per_vertical: Floats
    elasticity: Floats


@dataclass(frozen=True, eq=False)
class Dam:
    """The parts of a dam, and how they hang together while its cracks are bonded.

    Attributes
    ----------
    bodies
        The parts above a crack, free, from the crest down, and, if the foundation is no rigid plane, the part below all
        cracks. Crack k is between bodies k and k + 1, or below the last.
    tie
        Displacements of one part after the other are ``tie @ free``, with the cracks bonded and the base held. Where
        the nodes of the two faces of a crack do not match, those of the upper follow the lower face.
    """

    bodies: tuple[Body, ...]
    tie: Sparse

    @property
    def upper(self) -> Body:
        """The part above the crack."""
        return self.bodies[0]

    @property
    def lower(self) -> Body | None:
        """The part below the first crack; None where that is on a rigid plane."""
        return self.bodies[1] if len(self.bodies) > 1 else None

    @property
    def free(self) -> int:
        """How many parts are free, which is how many cracks there are."""
        return len(self.bodies) - bool(self.bodies[-1].mesh.fixed.size)

    def below(self, crack: int) -> Body | None:
        """The part below a crack, None where that is on a rigid plane."""
        return self.bodies[crack + 1] if crack + 1 < len(self.bodies) else None

    def faces(self, crack: int) -> tuple[BodyMesh, ...]:
        """The meshes above and, if there is one, below a crack, with its face alone."""
        above, below = self.bodies[crack].mesh.facing(-1), self.below(crack)
        return (above,) if below is None else (above, below.mesh.facing(0))


def dam(case: Case, mesh: DamMesh) -> Dam:
    """Return the elastic bodies of a dam.

    Parameters
    ----------
    case
        Concrete, water, uplift, and the block `flexible`.
    mesh
        From :func:`heeltoe.models.flexible.mesh.dam.dam_mesh`.

    Raises
    ------
    InputError
        Where the case has no Young's modulus, or one that is no solid's.
    """
    return Dam(tuple(_body(case, part, place) for place, part in enumerate(mesh.parts)), _tie(mesh))


def bonded_state(dam: Dam, solve: Solve | None = None) -> tuple[tuple[Floats, ...], tuple[Floats, ...]]:
    """Return the static equilibrium under all static loads with the cracks bonded; `solve` has the factors of their
    stiffness, where they are known.

    Returns
    -------
    displacements : tuple of ndarray
        Of each part, shape (2 n,) [m].
    crack_forces : tuple of ndarray, shape (2 k,)
        For each crack forces of what is below it on the nodes of its upper face [N per m], x downstream and z up in
        turn.
    """
    load = np.concatenate([body.load for body in dam.bodies])
    solve = solve or factor(tied(dam, "stiffness"))
    return crack_forces(dam, dam.tie @ solve(dam.tie.T @ load))


def crack_forces(dam: Dam, displacements: Floats) -> tuple[tuple[Floats, ...], tuple[Floats, ...]]:
    """Return what :func:`bonded_state` does, of the displacements of one part after the other."""
    moved = np.split(displacements, np.cumsum([body.load.size for body in dam.bodies])[:-1])
    forces = [
        (body.stiffness @ displacement - body.load)[dofs(body.mesh.faces[-1])]
        for body, displacement in zip(dam.bodies[: dam.free], moved, strict=False)
    ]
    return tuple(moved), tuple(forces)


def base_shapes(dam: Dam, held: Integers) -> Floats:
    """Return the static shapes of the dam with its cracks bonded for a unit displacement of each of k degrees of
    freedom of its base, (2 n, k) of one part after the other."""
    moved = side_by_side(dam, "stiffness")[:, held].toarray()
    shapes: Floats = -(dam.tie @ factor(tied(dam, "stiffness"))(dam.tie.T @ moved))
    shapes[held, np.arange(held.size)] += 1.0
    return shapes


def side_by_side(dam: Dam, name: str) -> Sparse:
    """Return a matrix of all parts, upper first and unconnected; `name` is that of a field of :class:`Body`."""
    return sparse.block_diag([getattr(body, name) for body in dam.bodies], format="csc")


def tied(dam: Dam, name: str) -> Sparse:
    """Return the named matrix on the unknowns that are free while the cracks are bonded."""
    return (dam.tie.T @ side_by_side(dam, name) @ dam.tie).tocsc()


def factor(operator: Sparse) -> Solve:
    """Return the function that solves a symmetric positive definite system."""
    solve: Solve = factored(operator).solve
    return solve


def factored(operator: Sparse, permc_spec: str = "MMD_AT_PLUS_A", **options: Any) -> Any:
    """Return the factors of one, as those of scipy.sparse.linalg.splu."""
    from scipy.sparse.linalg import splu

    return splu(operator.tocsc(), permc_spec=permc_spec, options={"SymmetricMode": True}, **options)


def dofs(nodes: Integers) -> Integers:
    """Return the degrees of freedom of nodes, x and z in turn, shape (2 k,)."""
    return np.stack([2 * nodes, 2 * nodes + 1], axis=1).reshape(-1)


def rigid_motions(points: Floats) -> Floats:
    """Return two displacements and a rotation of points (k, 2) about the origin, x and z in turn, shape (2 k, 3)."""
    motions = np.zeros((2 * len(points), 3))
    motions[::2, 0] = motions[1::2, 1] = 1.0
    motions[::2, 2], motions[1::2, 2] = -points[:, 1], points[:, 0]
    return motions


def stresses(body: Body, displacements: Floats) -> Floats:
    """Return the stresses at the nodes.

    They are taken at the 2 x 2 Gauss points, where they are most accurate (Barlow 1976), go from there straight to
    the nodes of the element, and are averaged over the elements of a node.

    Parameters
    ----------
    body
        A body of n nodes.
    displacements
        Shape (2 n,) or (2 n, steps) [m].

    Returns
    -------
    ndarray, shape (n, 3) or (n, 3, steps)
        Normal stresses in x and z, shear stress [Pa]; tension positive.
    """
    nodes = len(body.mesh.nodes)
    result: Floats = stress_rows(body, np.arange(nodes)) @ displacements
    return result.reshape(nodes, 3, *displacements.shape[1:])


def stress_rows(body: Body, nodes: Integers) -> Sparse:
    """Return the matrix (3 k, 2 n) that takes displacements to the stresses of :func:`stresses` at some nodes (k,)."""
    mesh, points = body.mesh, CORNERS / np.sqrt(3.0)
    inverse = np.linalg.inv(jacobians(mesh.nodes, mesh.elements, points))
    gradients = np.einsum("pnk,epkj->epnj", shape_gradients(points), inverse)
    # Strains (xx, zz, 2 xz) at the Gauss points by the displacements of the nodes.
    strain = np.zeros((*gradients.shape[:3], 3, 2))
    strain[..., 0, 0] = strain[..., 2, 1] = gradients[..., 0]
    strain[..., 1, 1] = strain[..., 2, 0] = gradients[..., 1]
    # The bilinear function with given values at the Gauss points, at the nodes.
    places = np.sqrt(3.0) * np.vstack([CORNERS, MIDDLES])
    spread = np.prod(1.0 + CORNERS[None] * places[:, None], axis=2) / 4.0
    counts = np.bincount(mesh.elements.reshape(-1), minlength=len(mesh.nodes))
    row = np.full(len(mesh.nodes), -1)
    row[nodes] = np.arange(len(nodes))
    element, place = np.nonzero(row[mesh.elements] >= 0)
    at = mesh.elements[element, place]
    values = np.einsum("kp,ij,kpnjd->kind", spread[place], body.elasticity, strain[element], optimize=True)
    values /= counts[at][:, None, None, None]
    rows = np.broadcast_to((3 * row[at][:, None] + np.arange(3))[:, :, None, None], values.shape)
    moved = 2 * mesh.elements[element][:, None, :, None] + np.arange(2)
    columns = np.broadcast_to(moved, values.shape)
    entries = values.reshape(-1), (rows.reshape(-1), columns.reshape(-1))
    return sparse.csr_array(entries, (3 * len(nodes), mesh.nodes.size))


def principal(
    stress: Floats,
) -> tuple[Floats, Floats, Floats]:
    """Return the principal stresses of the components that :func:`stresses` returns.

    Returns
    -------
    major, minor : ndarray, shape (n,) or (n, steps)
        In the plane [Pa], tension positive, ``major >= minor``.
    angle : ndarray
        Direction of the major one, from x downstream towards z up [rad], from -pi/2 to pi/2.
    """
    xx, zz, xz = np.moveaxis(stress, 1, 0)
    centre, radius = (xx + zz) / 2.0, np.hypot((xx - zz) / 2.0, xz)
    return centre + radius, centre - radius, np.arctan2(2.0 * xz, xx - zz) / 2.0


def _body(case: Case, mesh: BodyMesh, place: int) -> Body:
    above = place == 0
    elasticity = _elasticity(case)
    stiffness, mass, lift = _matrices(mesh, elasticity)
    concrete = case.concrete.density * mass
    loads = {
        "weight": -case.concrete.density * case.gravity * lift,
        "reservoir": water_forces(mesh, case, upstream=True),
        "tailwater": water_forces(mesh, case, upstream=False),
        "uplift": np.sum(
            [uplift_forces(face, alone, above=up) for face, alone, up in _at_cracks(case, mesh, place)], axis=0
        ),
    }
    if above and any(nappe_heads(case)):
        loads["nappe"] = nappe_forces(mesh, case)
    if case.ice:
        loads["ice"] = _ice(case, mesh, place)
    if case.silt:
        loads["silt"] = silt_forces(mesh, case)
    if case.anchors:
        pulls = [anchor_forces(face, alone, above=up) for face, alone, up in _at_cracks(case, mesh, place)]
        loads["anchors"] = np.sum(pulls, axis=0)
    following = np.zeros(mesh.nodes.size)
    for name, side in (("reservoir", case.reservoir), ("tailwater", case.tailwater), ("nappe", case.reservoir)):
        if name in loads and side is not None and side.follows_vertical_motion:
            following += loads[name] / case.gravity
    water = virtual_masses(mesh, case, above=above)
    load = np.sum(list(loads.values()), axis=0)
    return Body(mesh, stiffness, (concrete + water).tocsc(), concrete, load, loads, following, elasticity)


def _at_cracks(case: Case, mesh: BodyMesh, place: int) -> list[tuple[BodyMesh, Case, bool]]:
    """Return a part with each of its crack faces alone, the case with that crack alone, and whether it is above it."""
    result = [] if place == 0 else [(mesh.facing(0), case.single_crack_cases[place - 1], False)]
    if place < len(case.single_crack_cases):
        result.append((mesh.facing(-1), case.single_crack_cases[place], True))
    return result


def _ice(case: Case, mesh: BodyMesh, place: int) -> Floats:
    """Return the push of the ice on a part, which has it where no other one has."""
    pushes = [ice_forces(face, alone, above=up) for face, alone, up in _at_cracks(case, mesh, place)]
    return pushes[0] if all(push.any() for push in pushes) else np.zeros_like(pushes[0])


def _elasticity(case: Case) -> Floats:
    modulus, poisson = case.concrete.modulus, case.concrete.poisson
    if modulus is None:
        raise InputError(
            "missing",
            "concrete.modulus",
            remedy='the flexible model needs it, for example modulus = "20 GPa" under [concrete]',
        )
    if not _SOFTEST <= modulus <= _STIFFEST:
        raise InputError("out-of-range", "concrete.modulus", f"{modulus:g} Pa", bound="from 1 MPa to 1e7 GPa")
    if case.flexible.plane == "strain":
        modulus, poisson = modulus / (1.0 - poisson**2), poisson / (1.0 - poisson)
    shear = (1.0 - poisson) / 2.0
    return modulus / (1.0 - poisson**2) * np.array([[1.0, poisson, 0.0], [poisson, 1.0, 0.0], [0.0, 0.0, shear]])


def _matrices(mesh: BodyMesh, elasticity: Floats) -> tuple[Sparse, Sparse, Floats]:
    """Return stiffness, mass at unit density, and the nodal forces of a unit upward force per area."""
    import skfem
    from skfem.helpers import dot

    quads, vertices, facets = _skfem_mesh(mesh)
    basis = skfem.Basis(quads, skfem.ElementVector(skfem.ElementQuadS2()), intorder=5)
    (normal, cross, _), (_, _, _), (_, _, shear) = elasticity

    def energy(u: Any, v: Any, _: Any) -> Any:
        (xx, xz), (zx, zz) = u.grad
        (vxx, vxz), (vzx, vzz) = v.grad
        return vxx * (normal * xx + cross * zz) + vzz * (cross * xx + normal * zz) + shear * (vxz + vzx) * (xz + zx)

    def inertia(u: Any, v: Any, _: Any) -> Any:
        return dot(u, v)

    def lift(v: Any, _: Any) -> Any:
        return v[1]

    order = np.empty(mesh.nodes.size, dtype=np.int64)
    for axis in (0, 1):
        order[2 * vertices + axis] = basis.nodal_dofs[axis]
        order[2 * facets + axis] = basis.facet_dofs[axis]
    return (
        sparse.csc_array(skfem.BilinearForm(energy).assemble(basis)[order][:, order]),
        sparse.csc_array(skfem.BilinearForm(inertia).assemble(basis)[order][:, order]),
        skfem.LinearForm(lift).assemble(basis)[order],
    )


def scalar_matrices(case: Case, mesh: BodyMesh) -> tuple[Sparse, Sparse]:
    """Return stiffness [N/m per m] and mass [kg per m] of antiplane shear, (n, n): one displacement of each node at
    right angles to the section."""
    import skfem
    from skfem.helpers import dot, grad

    quads, vertices, facets = _skfem_mesh(mesh)
    basis = skfem.Basis(quads, skfem.ElementQuadS2(), intorder=5)

    def energy(u: Any, v: Any, _: Any) -> Any:
        return dot(grad(u), grad(v))

    def inertia(u: Any, v: Any, _: Any) -> Any:
        return u * v

    order = np.empty(len(mesh.nodes), dtype=np.int64)
    order[vertices], order[facets] = basis.nodal_dofs[0], basis.facet_dofs[0]
    shear = (case.concrete.modulus or 0.0) / (2.0 * (1.0 + case.concrete.poisson))
    stiffness, mass = (skfem.BilinearForm(form).assemble(basis)[order][:, order] for form in (energy, inertia))
    return (shear * stiffness).tocsc(), (case.concrete.density * mass).tocsc()


def _skfem_mesh(mesh: BodyMesh) -> tuple[Any, Integers, Integers]:
    """Return the mesh for scikit-fem and, for its vertices and its facets, the numbers of our nodes."""
    import skfem

    vertices, places = np.unique(mesh.elements[:, :4], return_inverse=True)
    corners = np.ascontiguousarray(mesh.nodes[vertices].T)
    linear = skfem.MeshQuad1(corners, np.ascontiguousarray(places.reshape(-1, 4).T))
    facets = np.empty(linear.facets.shape[1], dtype=np.int64)
    facets[linear.t2f] = mesh.elements[:, 4:].T
    # Its quadratic geometry has nine nodes; with the centre where the eight put it, it is ours.
    centres = np.einsum("n,eni->ie", [-0.25] * 4 + [0.5] * 4, mesh.nodes[mesh.elements])
    quads = skfem.MeshQuad2.from_mesh(linear)
    points = quads.doflocs.copy()
    points[:, quads.dofs.facet_dofs[0]] = mesh.nodes[facets].T
    points[:, quads.dofs.interior_dofs[0]] = centres
    return skfem.MeshQuad2(points, quads.t), vertices, facets


def _tie(mesh: DamMesh) -> Sparse:
    """Eliminate what is held or follows."""
    parts = mesh.parts
    starts = np.cumsum([0, *(part.nodes.size for part in parts)])
    rows, columns, values = [], [], []
    # The column of each displacement that is free.
    column = np.full(starts[-1], -1)
    count = 0
    for part, start in zip(parts, starts, strict=False):
        held = dofs(part.fixed if part.fixed.size else part.faces[-1])
        free = start + np.setdiff1d(np.arange(part.nodes.size), held)
        column[free] = count + np.arange(free.size)
        count += free.size
        rows.append(free)
        columns.append(column[free])
        values.append(np.ones(free.size))
    for upper, lower, high, low in zip(parts, parts[1:], starts, starts[1:], strict=False):
        leaders, shares = _led(upper, lower)
        followers = np.repeat(upper.faces[-1], 3)
        for axis in (0, 1):
            rows.append(high + 2 * followers + axis)
            columns.append(column[low + 2 * leaders + axis])
            values.append(shares)
    row, place, value = (np.concatenate(item) for item in (rows, columns, values))
    entries = (place >= 0) & (value != 0.0)
    return sparse.csr_array((value[entries], (row[entries], place[entries])), (starts[-1], count))


def held_alone(body: Body) -> Sparse:
    """Return the tie of a part by itself, its base held."""
    free = np.setdiff1d(np.arange(body.load.size), dofs(body.mesh.fixed))
    return sparse.csr_array((np.ones(free.size), (free, np.arange(free.size))), (body.load.size, free.size))


def _led(upper: BodyMesh, lower: BodyMesh) -> tuple[Integers, Floats]:
    """Return for each crack node of the upper part three nodes of the lower face and their shares in it, flat."""
    # Along a straight crack that is not upright, x tells the places as well as the distance does.
    x, face = upper.nodes[upper.faces[-1], 0], lower.nodes[lower.faces[0], 0]
    edge = 2 * np.searchsorted(face[2:-1:2], x)
    start, middle, end = face[edge], face[edge + 1], face[edge + 2]
    bend, slope = start - 2.0 * middle + end, (end - start) / 2.0
    # x = middle + slope s + bend s^2 / 2 rises along the edge: the root that remains where there is no bend.
    s = 2.0 * (x - middle) / (slope + np.sqrt(slope**2 + 2.0 * bend * (x - middle)))
    shares = edge_shapes(np.clip(s, -1.0, 1.0))
    shares[np.abs(shares) < 1e-12] = 0.0
    return lower.faces[0][edge[:, None] + [0, 1, 2]].reshape(-1), shares.reshape(-1)
