"""A dam as other programs take it: nodes, elements, sets, masses, static loads, contact pairs and ground motion.

The mesh, the elasticity and the nodal loads are those of the flexible model. A deck has what most programs have:
masses on nodes, cracks whose faces touch node by node, constant friction, damping by the stiffness, a rigid plane below
and water as a mass. Whatever the case has beyond that is named in `Deck.notes`, or refused where the answer would be
that of another dam."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.models.flexible.body.bonded import elastic_dam
from heeltoe.models.flexible.body.elastic import Body, Dam, factor, tied
from heeltoe.models.flexible.body.modes import SHOWN_MODES, intact_modes, lowest
from heeltoe.models.flexible.mesh.checks import CORNERS, MIDDLES, jacobians
from heeltoe.models.flexible.mesh.dam import BodyMesh
from heeltoe.motion.earthquake import Earthquake

# Faces touch where their nodes are this close, as a part of the width of the crack.
_TOUCH = 1e-6
# Simpson's shares of an edge of three nodes.
_SHARES = (1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0)
# Water that moves along two axes at once has such a part of its mass between them, at least.
_COUPLED = 1e-9
# Three Gauss points each way, with their weights.
_ABSCISSAS, _PARTS = np.polynomial.legendre.leggauss(3)
_GAUSS = np.array([(x, y) for y in _ABSCISSAS for x in _ABSCISSAS])
_WEIGHTS = np.outer(_PARTS, _PARTS).reshape(-1)


@dataclass(frozen=True, eq=False)
class DeckPart:
    """A part of the dam.

    Attributes
    ----------
    name
        ``part_1`` is the uppermost.
    elements
        Nodes of its eight-node quadrilaterals (m, 8): corners counter-clockwise, then midside nodes.
    upstream, downstream
        Nodes of its faces from bottom to top.
    """

    name: str
    elements: Integers
    upstream: Integers
    downstream: Integers


@dataclass(frozen=True, eq=False)
class DeckCrack:
    """A crack whose two faces touch node by node.

    Attributes
    ----------
    name
        ``crack_1`` is the uppermost.
    upper, lower
        (k,) nodes of its faces from the heel to the toe, midside nodes included; the lower are of the part below, or of
        the rigid ground.
    lengths
        (k,) length of the crack that each node stands for [m].
    normal
        Unit vector from the lower into the upper part.
    friction
        Coefficient of friction while it slides.
    """

    name: str
    upper: Integers
    lower: Integers
    lengths: Floats
    normal: tuple[float, float]
    friction: float

    @property
    def along(self) -> tuple[float, float]:
        """Unit vector downstream along the crack."""
        return self.normal[1], -self.normal[0]


@dataclass(frozen=True, eq=False)
class Deck:
    """A dam for another program, in SI units per metre of dam, x downstream and y up.

    Attributes
    ----------
    title
        Of the case.
    notes
        How it differs from the case, or from the flexible model, one sentence each.
    nodes
        (n, 2) places [m]; those of the ground come last.
    parts, cracks
        From the crest down.
    held
        Nodes that do not move: the ground below a crack on a rigid plane, or the base of the part below all cracks.
    plane
        ``stress`` or ``strain``.
    modulus, poisson, density
        Of the concrete [Pa], [], [kg/m3].
    gravity
        [m/s2].
    concrete_masses, water_masses
        (n, 2) on the nodes along x and y [kg].
    loads
        Static forces on the nodes by name (n, 2) [N].
    along_x, along_y
        (n, 2) forces on the nodes by an acceleration of the ground of 1 m/s2 downstream, and upward [N], as motion
        relative to the ground has them.
    stiffness_damping
        Damping over stiffness [s].
    damping
        Share of critical damping that this gives the first mode of the intact dam.
    periods
        The longest of the intact dam with these masses [s].
    own_periods
        Those of the flexible model, whose masses are consistent [s].
    motion
        Of the ground [m/s2] to its end; None where the case has none.
    """

    title: str
    notes: tuple[str, ...]
    nodes: Floats
    parts: tuple[DeckPart, ...]
    cracks: tuple[DeckCrack, ...]
    held: Integers
    plane: str
    modulus: float
    poisson: float
    density: float
    gravity: float
    concrete_masses: Floats
    water_masses: Floats
    loads: dict[str, Floats]
    along_x: Floats
    along_y: Floats
    stiffness_damping: float
    damping: float
    periods: Floats
    own_periods: Floats
    motion: Earthquake | None

    @property
    def masses(self) -> Floats:
        """Concrete and water (n, 2) [kg]."""
        return self.concrete_masses + self.water_masses

    @property
    def ground(self) -> Integers:
        """Nodes of the rigid ground, which no element has."""
        used = np.concatenate([part.elements.reshape(-1) for part in self.parts])
        return np.setdiff1d(np.arange(len(self.nodes)), used)

    @property
    def resultant(self) -> tuple[float, float]:
        """Sum of the static loads, x and y [N]."""
        x, y = sum(load.sum(axis=0) for load in self.loads.values())
        return float(x), float(y)


def build_deck(case: Case, motion: Earthquake | None) -> Deck:
    """Return the dam of a case for other programs, with the motion that shakes it.

    Raises
    ------
    InputError
        Where the case has no modulus, a crack has kinks, a bond, asperities or a friction law, or the faces of a crack
        do not meet node by node.
    """
    _check_contact(case)
    notes = list(_notes(case))
    case = case.on_rigid_plane()
    dam = elastic_dam(case, opens=True)
    starts = np.cumsum([0, *(len(body.mesh.nodes) for body in dam.bodies)])
    cracks, ground = _cracks(case, dam, starts)
    nodes = np.vstack([*(body.mesh.nodes for body in dam.bodies), *ground])
    last = dam.bodies[-1].mesh
    grounded = np.arange(starts[-1], len(nodes))
    held = grounded if grounded.size else starts[-2] + last.fixed
    concrete = _over(nodes, [_lumped(body.mesh, case.concrete.density) for body in dam.bodies])
    waters = [_water(body) for body in dam.bodies]
    water = _over(nodes, [masses for masses, _ in waters])
    if any(coupled for _, coupled in waters):
        notes.append("Water before a sloping face is a mass along x and along y; what couples the two is left out.")
    along_x, along_y = (_over(nodes, [_inertia(body, axis) for body in dam.bodies]) for axis in (0, 1))
    names = dict.fromkeys(name for body in dam.bodies for name, load in body.loads.items() if load.any())
    loads = {
        name: _over(nodes, [body.loads.get(name, np.zeros(body.load.size)) for body in dam.bodies]) for name in names
    }
    stiffness = tied(dam, "stiffness")
    own = intact_modes(dam, SHOWN_MODES, stiffness, factor(stiffness)).omega
    ratio = case.concrete.damping
    assert case.concrete.modulus is not None  # elastic_dam has refused a case without
    return Deck(
        title=case.title,
        notes=tuple(notes),
        nodes=nodes,
        parts=tuple(
            DeckPart(
                f"part_{place}",
                start + body.mesh.elements,
                start + body.mesh.upstream,
                start + body.mesh.downstream,
            )
            for place, (body, start) in enumerate(zip(dam.bodies, starts, strict=False), start=1)
        ),
        cracks=cracks,
        held=held,
        plane=case.flexible.plane,
        modulus=case.concrete.modulus,
        poisson=case.concrete.poisson,
        density=case.concrete.density,
        gravity=case.gravity,
        concrete_masses=concrete,
        water_masses=water,
        loads=loads,
        along_x=along_x,
        along_y=along_y,
        stiffness_damping=2.0 * ratio / float(own[0]),
        damping=ratio,
        periods=_periods(dam, (concrete + water)[: starts[-1]], len(own)),
        own_periods=2.0 * math.pi / own,
        motion=motion,
    )


def _check_contact(case: Case) -> None:
    """Refuse cracks whose contact has no like in the programs."""
    for alone, path in zip(case.single_crack_cases, case.crack_paths, strict=True):
        crack = alone.crack
        for name in ("kinks", "bond", "law", "roughness"):
            if getattr(crack, name, None):
                owner = "an exported crack, which is straight, open and of constant friction"
                raise InputError("option-foreign", f"{path}.{name}", owner=owner, remedy="")


def _notes(case: Case) -> Iterator[str]:
    """Say how a deck differs from its case and from the flexible model."""
    rock = case.foundation
    if rock is not None:
        kind = "assumed rock" if case.surroundings.assumed else "rock"
        yield f"The case stands on {kind} of {rock.modulus / 1e9:g} GPa; here it stands on a rigid plane."
    if case.has_compressible_water:
        yield "Sound travels in the water of the case; here it is a mass that moves with the faces (Westergaard)."
    yield "Masses are on the nodes (HRZ lumping); the flexible model has consistent ones."
    if case.flexible.damping != "stiffness":
        yield (
            f'The case has damping "{case.flexible.damping}"; here damping is in proportion to the stiffness alone, '
            'as with flexible.damping = "stiffness", since a mass term would brake the slide.'
        )
    if any(alone.crack.mu_static != alone.crack.mu_kinetic for alone in case.single_crack_cases):
        yield "Friction at rest and in motion differ in the case; here both are the friction in motion."
    if case.uplift.during_shaking != "constant":
        yield f'Uplift is "{case.uplift.during_shaking}" in the earthquake of the case; here it stays as it is at rest.'
    if any(anchor.yields for anchor in case.anchors):
        yield "Anchors of the case have a stiffness; here they are their prestress alone."
    if case.motion is not None and case.motion.cross_valley is not None:
        yield "The ground of the case shakes across the valley, too; here it shakes along the stream alone."
    if case.crack.band is not None:
        yield "The case has a band of frictions; here is its best estimate alone."
    if case.motions:
        yield "The case has a suite of records; here is no ground motion. Name one, as by --set motion.file=NAME."
    if case.aftershocks:
        yield "The case has further earthquakes; here is the first alone."
    if case.motion is not None and not case.motion.has_sign:
        yield "The ground moves as recorded; heeltoe runs the reversed motion, too."


def _cracks(case: Case, dam: Dam, starts: Integers) -> tuple[tuple[DeckCrack, ...], list[Floats]]:
    """Return the cracks, and the nodes of the rigid ground below the lowest where nothing else is below it."""
    result, ground = [], []
    for place, alone in enumerate(case.single_crack_cases):
        faces, section = dam.faces(place), alone.cut
        upper, points = faces[0].crack, faces[0].nodes[faces[0].crack]
        if len(faces) == 1:
            ground.append(points)
            lower = starts[-1] + np.arange(upper.size)
        else:
            lower, below = faces[1].crack, faces[1].nodes[faces[1].crack]
            if lower.size != upper.size or np.abs(points - below).max() > _TOUCH * section.crack_width:
                raise InputError(
                    "another-kind",
                    "flexible.mesh_below" if case.flexible.mesh_below else "flexible.elements_across_below",
                    f"{lower.size} nodes at other places than the {upper.size} above",
                    wanted="a face that meets the other one node by node",
                    remedy="give both parts the same elements along the crack",
                )
            lower = starts[place + 1] + lower
        lengths = np.zeros(upper.size)
        pieces = np.hypot(*(points[2::2] - points[:-2:2]).T)
        for offset, share in enumerate(_SHARES):
            lengths[offset : upper.size - 2 + offset : 2] += share * pieces
        normal = section.from_crack_frame(0.0, 1.0)
        friction = alone.crack.mu_kinetic
        result.append(DeckCrack(f"crack_{place + 1}", starts[place] + upper, lower, lengths, normal, friction))
    return tuple(result), ground


def _over(nodes: Floats, pieces: list[Floats]) -> Floats:
    """Return values of the nodes of all parts, with zeros on the ground."""
    values = np.concatenate(pieces).reshape(-1, 2)
    return np.vstack([values, np.zeros((len(nodes) - len(values), 2))])


def _lumped(mesh: BodyMesh, density: float) -> Floats:
    """Return the concrete on the nodes, along x and y in turn (2 n,) [kg]: element by element in proportion to the
    diagonal of its consistent mass (Hinton, Rock and Zienkiewicz 1976), which leaves no node without mass."""
    x, y = _GAUSS.T[:, :, None]
    (a, b), (c, d) = CORNERS.T[:, None], MIDDLES.T[:, None]
    corners = (1.0 + a * x) * (1.0 + b * y) * (a * x + b * y - 1.0) / 4.0
    middles = np.where(c == 0.0, (1.0 - x * x) * (1.0 + d * y), (1.0 + c * x) * (1.0 - y * y)) / 2.0
    shapes = np.hstack([corners, middles])
    areas = _WEIGHTS * np.linalg.det(jacobians(mesh.nodes, mesh.elements, _GAUSS))
    squares = areas @ shapes**2
    shares = squares * (areas.sum(axis=1) / squares.sum(axis=1))[:, None]
    masses = density * np.bincount(mesh.elements.reshape(-1), shares.reshape(-1), len(mesh.nodes))
    return np.repeat(masses, 2)


def _water(body: Body) -> tuple[Floats, bool]:
    """Return the water on the nodes, along x and y in turn (2 n,) [kg], with the total and the centre of the consistent
    mass, and whether that couples the two axes."""
    water = (body.mass - body.mass_concrete).tocsr()
    along = np.zeros(body.load.size)
    for axis in (0, 1):
        along[axis::2] = water[axis::2, axis::2].sum(axis=1)
    coupling = abs(water[::2, 1::2]).sum()
    return along, bool(coupling > _COUPLED * along.sum())


def _inertia(body: Body, axis: int) -> Floats:
    """Return the forces (2 n,) [N] of a ground that is accelerated by 1 m/s2 along x or up."""
    ones = np.zeros(body.load.size)
    ones[axis::2] = 1.0
    pushed: Floats = -(body.mass @ ones)
    return pushed + body.load_per_vertical if axis else pushed


def _periods(dam: Dam, masses: Floats, count: int) -> Floats:
    """Return the longest periods of the intact dam with masses on its nodes [s]."""
    mass = (dam.tie.T @ sparse.diags_array(masses.reshape(-1)) @ dam.tie).tocsc()
    squares, _ = lowest(tied(dam, "stiffness"), mass, count, 0.0)
    periods: Floats = 2.0 * math.pi / np.sqrt(squares)
    return periods
