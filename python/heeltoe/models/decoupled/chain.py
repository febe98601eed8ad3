"""The motion of the crack: the part below it, elastic, carries the part above as a rigid body that does not slip.

What the part above does when it slides and rocks does not act back on the part below; that is the price of the
decoupled chain, and what the flexible model is for (docs/decoupled.md)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sparse

from heeltoe.base.arrays import Floats
from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.flexible.body.bonded import elastic_dam, fingerprints
from heeltoe.models.flexible.body.cost import Part, building, check_cost, parts_of
from heeltoe.models.flexible.body.elastic import Sparse, dofs, rigid_motions, side_by_side
from heeltoe.models.flexible.body.modes import lowest
from heeltoe.models.flexible.mesh.dam import BodyMesh
from heeltoe.models.flexible.surroundings.edges import edge_shapes

#: Modes that are kept: the lowest, up to so many, and none with a shorter period [s]. Nothing in an accelerogram is as
#: fast; faster modes move with the ground, as all that is left out does.
MOST_MODES, SHORTEST_PERIOD = 60, 0.005
_LEAST_DAMPING = 1e-6


@dataclass(frozen=True, eq=False)
class Chain:
    """An elastic body on the ground in its m kept modes, and how its crack moves in them.

    Attributes
    ----------
    omega
        (m,) circular frequencies, ascending [1/s].
    participation
        (m, 2) share of each mode in the ground's horizontal and vertical motion [kg^(1/2)].
    shapes
        (3, m) motion of the crack in each mode: downstream and upward [kg^(-1/2)], counter-clockwise [1/m kg^(-1/2)].
    damping
        Damping ratio of every mode.
    """

    omega: Floats
    participation: Floats
    shapes: Floats
    damping: float

    @property
    def periods(self) -> Floats:
        """Periods of the modes, longest first [s]."""
        return 2.0 * math.pi / self.omega

    def slower_half(self) -> Chain:
        """Return the same with the slower half of its modes alone."""
        half = self.omega.size // 2
        return Chain(self.omega[:half], self.participation[:half], self.shapes[:, :half], self.damping)

    def transfer(self, periods: Floats) -> Floats:
        """Return the amplitude of the crack's horizontal acceleration under a horizontal ground motion that is a
        steady vibration of amplitude 1, by its period [s].

        Without damping it has no bound at a period of its own, and is told as with next to none.
        """
        w = 2.0 * math.pi / periods[:, None]
        swing = w**2 / (self.omega**2 - w**2 + 2j * max(self.damping, _LEAST_DAMPING) * self.omega * w)
        total: Floats = np.abs(1.0 + swing @ (self.shapes[0] * self.participation[:, 0]))
        return total


def chain(case: Case) -> Chain:
    """Return the part below the crack with the part above attached; the last few are kept.

    Every mode has the damping ratio of the concrete: its damping is one of material, which hardly depends on
    frequency, while the mass-proportional part of Rayleigh's damping has no counterpart in a dam on rock.

    Raises
    ------
    InputError
        Where the crack is at the base, or the case has no modulus or no mesh.
    """
    # Its few modes cost less than those of parts that a crack divides.
    check_cost(case, building([Part(part.freedoms, 0, MOST_MODES) for part in parts_of(case)]))
    return _kept(case, _chain)


def bonded_chain(case: Case) -> Chain:
    """Return the whole dam, both parts elastic and the crack bonded, the reference for the motion at the crack.

    Raises
    ------
    InputError
        As :func:`chain`.
    """
    return _kept(case, _bonded)


_KEPT: Kept[Chain] = Kept(8)


def _kept(case: Case, build: Callable[[Case], Chain]) -> Chain:
    """Build a chain, or return the cached one with the same inputs."""
    # Its modes are real, and so without waves in the water.
    case = case.with_water_as_mass()
    fields: Any = dict.fromkeys(("section", "concrete", "reservoir", "tailwater", "flexible", "gravity"), True)
    fields["crack"] = {"elevation", "inclination"}
    fields["decoupled"] = {"upper_part"}
    # Files may change under their name.
    key = (build.__name__, case.model_dump_json(include=fields), *fingerprints(case))
    return _KEPT.get(key, lambda: build(case))


def _chain(case: Case) -> Chain:
    block = build_block(case)
    section = block.section
    if section.crack_elevation == section.base_elevation:
        raise InputError("crack-at-base", "crack.elevation", f"{case.crack.elevation:g} m")
    body = elastic_dam(case).lower
    assert body is not None
    plane = plane_fit(body.mesh)
    mass = body.mass + _attached(case, block, body.mesh, plane)
    free = np.setdiff1d(np.arange(body.mesh.nodes.size), dofs(body.mesh.fixed))
    hold = sparse.eye_array(body.mesh.nodes.size, format="csr")[:, free]
    return _in_modes(body.stiffness, mass, plane, hold, case.concrete.damping)


def _bonded(case: Case) -> Chain:
    whole = elastic_dam(case)
    if whole.lower is None:
        raise InputError("crack-at-base", "crack.elevation", f"{case.crack.elevation:g} m")
    above = sparse.csr_array((3, whole.upper.load.size))
    plane = sparse.hstack([above, plane_fit(whole.lower.mesh)], format="csr")
    matrices = side_by_side(whole, "stiffness"), side_by_side(whole, "mass")
    return _in_modes(*matrices, plane, whole.tie, case.concrete.damping)


def _in_modes(stiffness: Sparse, mass: Sparse, plane: Sparse, hold: Sparse, damping: float) -> Chain:
    """Return what stands on the ground in its modes; all displacements are ``hold @ free``, x and z in turn, `plane`
    takes them to the motion of the crack."""
    count = min(MOST_MODES, hold.shape[1])
    squares, shapes = lowest((hold.T @ stiffness @ hold).tocsc(), (hold.T @ mass @ hold).tocsc(), count, 0.0)
    omega = np.sqrt(squares)
    kept = omega <= 2.0 * math.pi / SHORTEST_PERIOD
    everywhere = hold @ shapes[:, kept]
    moved = np.tile(np.eye(2), (hold.shape[0] // 2, 1))
    return Chain(omega[kept], everywhere.T @ (mass @ moved), plane @ everywhere, damping)


def plane_fit(mesh: BodyMesh) -> Sparse:
    """Return the motion (downstream, upward, counter-clockwise) of the plane that fits the crack face best.

    Least squares over the length of the crack, by Simpson's rule; moments are about the middle of the crack.

    Returns
    -------
    sparse array, shape (3, 2 n)
        It takes a rigid motion of the whole face for what it is.
    """
    points = mesh.nodes[mesh.crack]
    spans = np.hypot(*(points[2::2] - points[:-2:2]).T)
    weights = np.zeros(len(points))
    for offset, share in enumerate((1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0)):
        weights[offset : len(points) - 2 + offset : 2] += share * spans
    rigid = rigid_motions(points - (points[0] + points[-1]) / 2.0)
    weighted = np.repeat(weights, 2)[:, None] * rigid
    fit = np.linalg.solve(rigid.T @ weighted, weighted.T)
    places = dofs(mesh.crack)
    rows = np.repeat(np.arange(3), places.size)
    return sparse.csr_array((fit.reshape(-1), (rows, np.tile(places, 3))), (3, mesh.nodes.size))


def _attached(case: Case, block: Block, mesh: BodyMesh, plane: Sparse) -> Sparse:
    """Return what the part above the crack adds to the mass of the part below."""
    if case.decoupled.upper_part == "rigid body":
        # It moves as the fitted plane does.
        return plane.T @ sparse.csr_array(attached_mass(case, block)) @ plane
    # The mass of the upper portion, as Zhu (2004) says: the virtual water before it is none of it.
    concrete = case.concrete.density * block.section.area
    places = dofs(mesh.crack)
    shares = sparse.kron(face_shares(mesh), concrete * np.eye(2)).tocoo()
    size = mesh.nodes.size
    return sparse.csr_array((shares.data, (places[shares.row], places[shares.col])), (size, size))


def face_shares(mesh: BodyMesh) -> Floats:
    """Return how a mass spread evenly along the crack, 1 in all, works on its k nodes: consistently, shape (k, k)."""
    points = mesh.nodes[mesh.crack]
    s, weights = np.polynomial.legendre.leggauss(4)
    shapes = edge_shapes(s)
    shares = np.zeros((len(points), len(points)))
    for first in range(0, len(points) - 2, 2):
        edge = slice(first, first + 3)
        speed = np.hypot(*(np.stack([s - 0.5, -2.0 * s, s + 0.5], axis=-1) @ points[edge]).T)
        shares[edge, edge] += shapes.T @ ((weights * speed)[:, None] * shapes)
    even: Floats = shares / shares.sum()
    return even


def attached_mass(case: Case, block: Block) -> Floats:
    """Return the mass matrix of the part above the crack about the middle of the crack, (3, 3): downstream, upward,
    counter-clockwise [kg, kg m, kg m2 per m]. Its virtual water moves horizontally alone, as that of the block does."""
    section = block.section
    middle = (np.array(section.heel) + section.toe) / 2.0
    concrete = case.concrete.density * section.area
    x, z = np.array(section.centroid) - middle
    water, height = block.water.mass, section.heel[1] + block.water.height - middle[1]
    inertia = case.concrete.density * section.polar_inertia + concrete * (x * x + z * z) + water * height**2
    inertia += block.water.inertia
    tilt = -(concrete * z + water * height)
    return np.array([[concrete + water, 0.0, tilt], [0.0, concrete, concrete * x], [tilt, concrete * x, inertia]])
