"""Two elastic bodies: stiffness, mass, static loads, the bonded dam and stresses.

Linear elasticity on eight-node serendipity quadrilaterals with 3 x 3 Gauss points and consistent mass (Zienkiewicz
and Taylor, The Finite Element Method, volume 1), per metre of dam. Degree of freedom 2 i is the displacement of node
i downstream, 2 i + 1 that upwards."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sparse

from heeltoe.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.mechanics.loads import nappe_heads
from heeltoe.models.flexible.loads import (
    anchor_forces,
    edge_shapes,
    ice_forces,
    nappe_forces,
    silt_forces,
    uplift_forces,
    water_forces,
)
from heeltoe.models.flexible.mesh.checks import CORNERS, MIDDLES, jacobians, shape_gradients
from heeltoe.models.flexible.mesh.dam import BodyMesh, DamMesh
from heeltoe.models.flexible.virtual_water import virtual_masses

Sparse = Any
"""A matrix of scipy.sparse, which has no types of its own."""

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
    """The parts of a dam, and how they hang together while the crack is bonded.

    Attributes
    ----------
    bodies
        The part above the crack, free, and, if the foundation is no rigid plane, the part below it.
    tie
        Displacements of the upper, then of the lower part are ``tie @ free``, with the crack bonded and the base
        held. Where the nodes of the two faces do not match, those of the upper follow the lower face.
    """

    bodies: tuple[Body, ...]
    tie: Sparse

    @property
    def upper(self) -> Body:
        """The part above the crack."""
        return self.bodies[0]

    @property
    def lower(self) -> Body | None:
        """The part below it; None where the foundation is a rigid plane."""
        return self.bodies[1] if len(self.bodies) > 1 else None


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
    return Dam(tuple(_body(case, each, above=each is mesh.upper) for each in mesh.parts), _tie(mesh))


def bonded_state(dam: Dam) -> tuple[Floats, Floats, Floats]:
    """Return the static equilibrium under all static loads with the crack bonded.

    Returns
    -------
    upper, lower : ndarray
        Displacements of the two parts, shape (2 n,) each [m]; empty where there is no lower part.
    crack_force : ndarray, shape (2 k,)
        Forces of the lower part, or of the foundation, on the crack nodes of the upper [N per m], x downstream and z
        up in turn.
    """
    from scipy.sparse.linalg import splu

    load = np.concatenate([body.load for body in dam.bodies])
    stiffness = (dam.tie.T @ side_by_side(dam, "stiffness") @ dam.tie).tocsc()
    displacements = dam.tie @ splu(stiffness).solve(dam.tie.T @ load)
    upper, lower = np.split(displacements, [dam.upper.load.size])
    return upper, lower, (dam.upper.stiffness @ upper - dam.upper.load)[dofs(dam.upper.mesh.crack)]


def side_by_side(dam: Dam, name: str) -> Sparse:
    """Return a matrix of both parts, upper first and unconnected; `name` is that of a field of :class:`Body`."""
    return sparse.block_diag([getattr(body, name) for body in dam.bodies], format="csc")


def dofs(nodes: Integers) -> Integers:
    """Return the degrees of freedom of nodes, x and z in turn, shape (2 k,)."""
    return np.stack([2 * nodes, 2 * nodes + 1], axis=1).reshape(-1)


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
    nodes, elements = body.mesh.nodes, body.mesh.elements
    moved = displacements.reshape(len(nodes), 2, -1)[elements]
    points = CORNERS / np.sqrt(3.0)
    inverse = np.linalg.inv(jacobians(nodes, elements, points))
    # Displacement gradients du_i/dx_j at the Gauss points.
    gradients = np.einsum("pnk,epkj->epnj", shape_gradients(points), inverse)
    slope = np.einsum("epnj,enis->epijs", gradients, moved, optimize=True)
    strain = np.stack([slope[:, :, 0, 0], slope[:, :, 1, 1], slope[:, :, 0, 1] + slope[:, :, 1, 0]], axis=2)
    # The bilinear function with given values at the Gauss points, at the nodes.
    places = np.sqrt(3.0) * np.vstack([CORNERS, MIDDLES])
    spread = np.prod(1.0 + CORNERS[None] * places[:, None], axis=2) / 4.0
    at_nodes = np.einsum("np,ij,epjs->enis", spread, body.elasticity, strain, optimize=True)
    total = np.zeros((len(nodes), 3, at_nodes.shape[-1]))
    np.add.at(total, elements, at_nodes)
    average = total / np.bincount(elements.reshape(-1), minlength=len(nodes))[:, None, None]
    return average.reshape(len(nodes), 3, *displacements.shape[1:])


def principal(
    stress: Floats,
) -> tuple[Floats, Floats, Floats]:
    """Return the principal stresses of what :func:`stresses` returns.

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


def _body(case: Case, mesh: BodyMesh, *, above: bool) -> Body:
    elasticity = _elasticity(case)
    stiffness, mass, lift = _matrices(mesh, elasticity)
    concrete = case.concrete.density * mass
    loads = {
        "weight": -case.concrete.density * case.gravity * lift,
        "reservoir": water_forces(mesh, case, upstream=True),
        "tailwater": water_forces(mesh, case, upstream=False),
        "uplift": uplift_forces(mesh, case, above=above),
    }
    if above and any(nappe_heads(case)):
        loads["nappe"] = nappe_forces(mesh, case)
    if case.ice:
        loads["ice"] = ice_forces(mesh, case, above=above)
    if case.silt:
        loads["silt"] = silt_forces(mesh, case)
    if case.anchors:
        loads["anchors"] = anchor_forces(mesh, case, above=above)
    following = np.zeros(mesh.nodes.size)
    for name, side in (("reservoir", case.reservoir), ("tailwater", case.tailwater), ("nappe", case.reservoir)):
        if name in loads and side is not None and side.follows_vertical_motion:
            following += loads[name] / case.gravity
    water = virtual_masses(mesh, case, above=above)
    load = np.sum(list(loads.values()), axis=0)
    return Body(mesh, stiffness, (concrete + water).tocsc(), concrete, load, loads, following, elasticity)


def _elasticity(case: Case) -> Floats:
    modulus, poisson = case.concrete.modulus, case.concrete.poisson
    if modulus is None:
        raise InputError("modulus-missing", "concrete.modulus")
    if not _SOFTEST <= modulus <= _STIFFEST:
        raise InputError("modulus-range", "concrete.modulus", f"{modulus:g} Pa")
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
    upper, lower = mesh.upper, mesh.lower
    size = upper.nodes.size
    loose = np.setdiff1d(np.arange(size), dofs(upper.crack))
    if lower is None:
        return sparse.csr_array((np.ones(loose.size), (loose, np.arange(loose.size))), (size, loose.size))
    free = np.setdiff1d(np.arange(lower.nodes.size), dofs(lower.fixed))
    column = np.full(lower.nodes.size, -1)
    column[free] = loose.size + np.arange(free.size)
    leaders, shares = _led(upper, lower)
    followers = np.repeat(upper.crack, 3)
    rows = np.concatenate([loose, size + free, 2 * followers, 2 * followers + 1])
    columns = np.concatenate([np.arange(loose.size), column[free], column[2 * leaders], column[2 * leaders + 1]])
    values = np.concatenate([np.ones(loose.size + free.size), shares, shares])
    there = (columns >= 0) & (values != 0.0)
    shape = (size + lower.nodes.size, loose.size + free.size)
    return sparse.csr_array((values[there], (rows[there], columns[there])), shape)


def _led(upper: BodyMesh, lower: BodyMesh) -> tuple[Integers, Floats]:
    """Return for each crack node of the upper part three nodes of the lower face and their shares in it, flat."""
    # Along a straight crack that is not upright, x tells the places as well as the distance does.
    x, face = upper.nodes[upper.crack, 0], lower.nodes[lower.crack, 0]
    edge = 2 * np.searchsorted(face[2:-1:2], x)
    start, middle, end = face[edge], face[edge + 1], face[edge + 2]
    bend, slope = start - 2.0 * middle + end, (end - start) / 2.0
    # x = middle + slope s + bend s^2 / 2 rises along the edge: the root that remains where there is no bend.
    s = 2.0 * (x - middle) / (slope + np.sqrt(slope**2 + 2.0 * bend * (x - middle)))
    shares = edge_shapes(np.clip(s, -1.0, 1.0))
    shares[np.abs(shares) < 1e-12] = 0.0
    return lower.crack[edge[:, None] + [0, 1, 2]].reshape(-1), shares.reshape(-1)
