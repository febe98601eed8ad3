"""The elastic parts of a case in their modes, ready for the kernel: shapes at the crack, loads, damping."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import block_diag

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.errors.error import expect
from heeltoe.geometry.axes import along_and_across, places
from heeltoe.geometry.section import CutSection
from heeltoe.kernel.dam import CrackedDam, CrackLine
from heeltoe.mechanics.friction import law_of
from heeltoe.models.flexible.body.bond import kernel_bond
from heeltoe.models.flexible.body.bonded import NOT_OF_DAM, BondedDam, bonded_dam, case_key
from heeltoe.models.flexible.body.damping import Damping, damping_of
from heeltoe.models.flexible.body.elastic import Body, crack_forces
from heeltoe.models.flexible.body.inside import CrackAnchor, FollowingWater, crack_anchors, following_water
from heeltoe.models.flexible.body.modes import Modes
from heeltoe.models.flexible.body.reservoir import WaterBody, water_body
from heeltoe.models.flexible.body.rock import RockBody, founded, rock_body
from heeltoe.models.flexible.body.rocking_thresholds import elastic_give
from heeltoe.models.flexible.body.stress_places import stress_places
from heeltoe.models.flexible.mesh.kinks import angles


@dataclass(frozen=True, eq=False)
class ReducedBody:
    """A body in its modes, as the kernel takes it; m modes, k nodes on its cracks, the upper crack first.

    Attributes
    ----------
    omega_squared, damping_sticking, damping_free, load, participation_horizontal, participation_vertical, start
        (m,) each: squared circular frequency [1/s2]; damping [1/s] while some crack node sticks and while none does;
        static load; share in the ground's motions; state at the start.
    shapes
        (m, 2 k) motion of the crack nodes, all along their crack, then all across it.
    position
        (2 k,) where they stand at the start, from the heel and from the crack [m].
    dampers
        (d, m) rows of the dashpots that couple the modes; as many on the other body.
    damper_signs
        (d,) 1 for those that take energy, -1 for those that give back what others take too much.
    wet
        (w, m) rows of the modes of the water with sound, see
        :class:`heeltoe.models.flexible.surroundings.water.ReducedWater`; as many on the other body.
    boundary
        (m, m) damping of the boundary of the rock [1/s], of a part that is one body with the rock with what of its own
        couples modes; (0, 0) where there is none.
    """

    omega_squared: Floats
    damping_sticking: Floats
    damping_free: Floats
    load: Floats
    participation_horizontal: Floats
    participation_vertical: Floats
    start: Floats
    shapes: Floats
    position: Floats
    dampers: Floats
    damper_signs: Floats
    wet: Floats
    boundary: Floats


@dataclass(frozen=True)
class Start:
    """How a dam stands before the earthquake, its cracks let go.

    Attributes
    ----------
    stands
        Whether friction and what else acts hold it; if not, it starts from the state with its crack bonded, as the
        penalty method always does.
    slips
        By how much each crack slips on the way there, positive downstream [m].
    open_contacts
        How many of the watched nodes of each are open then.
    """

    stands: bool
    slips: tuple[float, ...]
    open_contacts: tuple[int, ...]


@dataclass(frozen=True, eq=False, kw_only=True)
class FlexibleDam(BondedDam):
    """A dam ready to be shaken: its elastic bodies in their modes.

    Attributes
    ----------
    section
        What is above the crack that the case asks of first.
    sections
        What is above each crack, from the crest down.
    asked
        Which of them is that of ``[crack]``.
    reduced
        The bodies in their modes, as the kernel takes them.
    kernel
        The kernel's own copy.
    start
        The state before the earthquake.
    static
        (2 n,) displacements in it of each body [m].
    crack_forces
        (2, k) forces on the nodes of each crack's upper face in it, along and across the crack [N].
    damping
        That of the concrete, with the periods of the intact dam.
    water, anchors
        What acts in the crack beside contact: water whose pressure changes, anchors with stiffness.
    lines
        The cracks as the kernel takes them.
    reservoir
        The compressible water before it, if there is any.
    rock
        The rock below the crack at its base, if it is elastic.
    rock_error
        Largest relative error of the answers of elastic rock; none on a rigid plane.
    """

    section: CutSection
    sections: tuple[CutSection, ...]
    asked: int
    reduced: tuple[ReducedBody, ...]
    kernel: CrackedDam
    start: Start
    static: tuple[Floats, ...]
    crack_forces: tuple[Floats, ...]
    damping: Damping
    water: FollowingWater | None
    anchors: tuple[CrackAnchor, ...]
    lines: tuple[CrackLine, ...]
    reservoir: WaterBody | None
    rock: RockBody | None
    rock_error: float

    def __repr__(self) -> str:
        parts = zip(self.bodies, self.modes, strict=True)
        counts = " and ".join(f"{len(body.mesh.nodes)} nodes in {modes.shapes.shape[1]} modes" for body, modes in parts)
        return f"<FlexibleDam: {counts}; first period {self.periods[0]:.4g} s>"

    @property
    def give(self) -> tuple[float, float]:
        """That of the crack asked of, see :func:`heeltoe.models.flexible.body.rocking_thresholds.elastic_give`."""
        return self.lines[self.asked].give

    @property
    def parts(self) -> tuple[ReducedBody, ...]:
        """The bodies in their modes, from the crest down to the rock below the crack at the base."""
        if self.rock is None:
            return self.reduced
        return (*self.reduced, _reduced_rock(self.rock, self.sections[-1], self.reduced[0]))

    @property
    def periods(self) -> Floats:
        """Longest periods of the intact dam, water included [s]."""
        return self.damping.periods


_KEPT: Kept[FlexibleDam] = Kept(4)


@one_blas_thread()
def build_flexible_dam(case: Case, larger: float = 1.0) -> FlexibleDam:
    """Mesh, assemble and reduce both parts of a case; the last few are kept, by all that they depend on. Rock and water
    with sound reach so many times `larger` as far as they need.

    Raises
    ------
    InputError
        Where the case has no modulus, or a mesh cannot be made or used.
    """
    expect(case, Case, "not-a-case", "case")
    return _KEPT.get((larger, case_key(case, NOT_OF_DAM)), lambda: _build(case, larger))


def _build(case: Case, larger: float = 1.0) -> FlexibleDam:
    bonded = bonded_dam(case)
    bodies, modes = bonded.bodies, bonded.modes
    sections = tuple(single_crack_case.cut for single_crack_case in case.single_crack_cases)
    damping = damping_of(case, bonded)
    reservoir = water_body(case, bodies, longer=larger)
    whole = founded(case, bonded, larger=larger)
    if whole is not None:
        damping = damping.founded(whole.held, whole.bent)
        modes = (*modes[:-1], whole.modes)
        seen = (*bonded.stress_places[:-1], stress_places(bodies[-1], whole.modes))
        bent, forces = crack_forces(bonded, whole.displacements)
        bonded = replace(bonded, modes=modes, stress_places=seen, bent=bent, bonded_forces=forces)
    reduced = tuple(
        _reduced(body, basis, still, damping, place, sections, reservoir)
        for place, (body, basis, still) in enumerate(zip(bodies, modes, bonded.bent, strict=True))
    )
    if whole is not None:
        part = reduced[-1]
        part = replace(part, boundary=whole.rock + damping.between, start=part.start + whole.settled)
        reduced = (*reduced[:-1], part)
    rock = rock_body(case, bodies[-1], larger=larger)
    water, anchors = following_water(case, bodies, rock), crack_anchors(case, bodies, rock)
    lines = _lines(case, bonded, rock)
    kernel = _cracked(case, reduced, water, anchors, lines, reservoir, rock)
    # The penalty method begins with its crack bonded and its springs unloaded.
    exact = case.flexible.contact == "coulomb"
    static, start = bonded.bent, Start(not exact, (0.0,) * len(lines), (0,) * len(lines))
    forces = tuple(
        along_and_across(force.reshape(-1, 2), section).T
        for force, section in zip(bonded.bonded_forces, sections, strict=True)
    )
    rest = kernel.still() if exact else None
    if rest is not None:
        start = Start(True, rest.slips, rest.open_contacts)
        amplitudes = apart(rest.modes, modes)
        static = tuple(basis.shapes @ q for basis, q in zip(modes, amplitudes, strict=True))
        forces = tuple(
            rest.forces[place % 2][:, first : first + count]
            for place, (first, count) in enumerate(line.upper for line in lines)
        )
    return FlexibleDam(
        **vars(bonded),
        section=case.cut,
        sections=sections,
        asked=case.asked,
        reduced=reduced,
        kernel=kernel,
        start=start,
        static=static,
        crack_forces=forces,
        damping=damping,
        water=water,
        anchors=anchors,
        lines=lines,
        reservoir=reservoir,
        rock=rock,
        rock_error=max((part.error for part in (whole, rock) if part is not None), default=0.0),
    )


def _cracked(
    case: Case,
    reduced: tuple[ReducedBody, ...],
    water: FollowingWater | None,
    anchors: tuple[CrackAnchor, ...],
    lines: tuple[CrackLine, ...],
    reservoir: WaterBody | None,
    rock: RockBody | None,
) -> CrackedDam:
    if rock is not None:
        reduced = (*reduced, _reduced_rock(rock, case.cut, reduced[0]))
    upper, *lower = (side_by_side_in(reduced[first::2]) for first in range(min(2, len(reduced))))
    contactors = case.flexible.contactors
    return CrackedDam(
        upper, lower[0] if lower else None, lines, contactors, water, anchors, reservoir, asked=case.asked
    )


def _lines(case: Case, bonded: BondedDam, rock: RockBody | None) -> tuple[CrackLine, ...]:
    """Return the cracks of a case, with where their faces are among the nodes of the kernel's two bodies."""
    # Parts that make up one body stand side by side in it, from the crest down.
    sizes = [body.mesh.crack.size for body in bonded.bodies] + ([] if rock is None else [len(rock.points)])
    firsts = [sum(sizes[place % 2 : place : 2]) for place in range(len(sizes))]
    result = []
    for place, (alone, force) in enumerate(zip(case.single_crack_cases, bonded.bonded_forces, strict=True)):
        above, below = bonded.bodies[place].mesh, bonded.below(place)
        upper = firsts[place] + above.top, above.crack.size - above.top
        lower = (0, 0) if below is None else (firsts[place + 1], below.mesh.faces[0].size)
        if rock is not None and below is None:
            lower = firsts[place + 1], len(rock.points)
        friction, law = (alone.crack.mu_static, alone.crack.mu_kinetic), alone.crack.law
        give = elastic_give(alone, alone.cut, force)
        turned = (
            angles(above, above.faces[-1], alone),
            [] if below is None else angles(below.mesh, below.mesh.faces[0], alone),
        )
        along = along_crack(bonded.bodies[place], alone.cut)
        bond = kernel_bond(alone, along)
        result.append(CrackLine(upper, lower, friction, give, None if law is None else law_of(law), turned, bond))
    return tuple(result)


def side_by_side_in(parts: tuple[ReducedBody, ...]) -> ReducedBody:
    """Return parts of a dam that do not touch as one body of the kernel."""
    if len(parts) == 1:
        return parts[0]
    ground = ("participation_horizontal", "participation_vertical")
    names = ("omega_squared", "damping_sticking", "damping_free", "load", *ground, "start")
    # Along the crack first, then across it.
    along, across = (
        block_diag(*(part.shapes.reshape(len(part.shapes), 2, -1)[:, axis] for part in parts)) for axis in (0, 1)
    )
    return ReducedBody(
        **{name: np.concatenate([getattr(part, name) for part in parts]) for name in names},
        shapes=np.hstack([along, across]),
        position=np.concatenate([part.position.reshape(2, -1) for part in parts], axis=1).reshape(-1),
        dampers=np.hstack([part.dampers for part in parts]),
        damper_signs=parts[0].damper_signs,
        wet=np.hstack([part.wet for part in parts]),
        boundary=block_diag(*(_square(part) for part in parts))
        if any(part.boundary.size for part in parts)
        else parts[0].boundary,
    )


def _square(part: ReducedBody) -> Floats:
    """Return the damping of its boundary over all of its modes."""
    count = part.omega_squared.size
    return part.boundary if part.boundary.size else np.zeros((count, count))


def along_crack(above: Body, section: CutSection) -> Floats:
    """Return where the nodes of the part above a crack are along it (k,) [m]."""
    along: Floats = places(above.mesh.nodes[above.mesh.faces[-1]], section)[:, 0]
    return along


def apart(of_bodies: Sequence[Floats], modes: tuple[Modes, ...]) -> tuple[Floats, ...]:
    """Return what the kernel says of the modes of its two bodies, last axis, part by part from the crest down."""
    result = [np.empty(0)] * len(modes)
    for side in range(min(2, len(modes))):
        sizes = [basis.omega_squared.size for basis in modes[side::2]]
        # What comes after them is the rock.
        result[side::2] = np.split(of_bodies[side], np.cumsum(sizes), axis=-1)[: len(sizes)]
    return tuple(result)


def damped(case: Case, dam: FlexibleDam, factor: float) -> FlexibleDam:
    """Return the same dam with so many times its damping."""
    damping = dam.damping.scaled(factor)
    reduced = tuple(
        replace(part, damping_sticking=sticking, damping_free=free, dampers=rows)
        for part, sticking, free, rows in zip(
            dam.reduced, damping.sticking, damping.free, damping.dashpots, strict=True
        )
    )
    if damping.between.size:
        boundary = reduced[-1].boundary + (damping.between - dam.damping.between)
        reduced = (*reduced[:-1], replace(reduced[-1], boundary=boundary))
    kernel = _cracked(case, reduced, dam.water, dam.anchors, dam.lines, dam.reservoir, dam.rock)
    return replace(dam, reduced=reduced, damping=damping, kernel=kernel)


def _reduced_rock(rock: RockBody, section: CutSection, part: ReducedBody) -> ReducedBody:
    """Return the rock as a body of the kernel: nobody shakes it, and it has settled under its own weight. Its dashpots
    and its share in the water are as many as those of a `part` of the dam, and none."""
    none, size = np.zeros(rock.omega_squared.size), rock.omega_squared.size
    return ReducedBody(
        omega_squared=rock.omega_squared,
        damping_sticking=none,
        damping_free=none,
        load=none,
        participation_horizontal=none,
        participation_vertical=none,
        start=none,
        shapes=rock.shapes,
        position=places(rock.points, section).T.reshape(-1),
        dampers=np.zeros((len(part.dampers), size)),
        damper_signs=part.damper_signs,
        wet=np.zeros((len(part.wet), size)),
        boundary=rock.damping,
    )


def _reduced(
    body: Body,
    modes: Modes,
    static: Floats,
    damping: Damping,
    place: int,
    sections: tuple[CutSection, ...],
    reservoir: WaterBody | None,
) -> ReducedBody:
    horizontal = np.zeros(static.size)
    horizontal[::2] = 1.0
    met = sections[max(place - 1, 0) : place + 1]
    at, moved, shapes = [], [], []
    for crack, section in zip(body.mesh.faces, met, strict=True):
        at.append(places(body.mesh.nodes[crack], section))
        moved.append(along_and_across(static.reshape(-1, 2)[crack], section))
        shapes.append(along_and_across(modes.shapes.T.reshape(modes.omega_squared.size, -1, 2)[:, crack], section))
    pushed = body.mass @ (1.0 - horizontal) - body.load_per_vertical
    return ReducedBody(
        omega_squared=np.ascontiguousarray(modes.omega_squared),
        damping_sticking=np.ascontiguousarray(damping.sticking[place]),
        damping_free=np.ascontiguousarray(damping.free[place]),
        load=modes.shapes.T @ body.load,
        participation_horizontal=modes.shapes.T @ (body.mass @ horizontal),
        participation_vertical=modes.shapes.T @ pushed,
        start=modes.shapes.T @ (body.mass @ static),
        shapes=np.ascontiguousarray(
            np.concatenate(shapes, axis=1).swapaxes(1, 2).reshape(modes.omega_squared.size, -1)
        ),
        position=(np.concatenate(at) + np.concatenate(moved)).T.reshape(-1),
        dampers=np.ascontiguousarray(damping.dashpots[place]),
        damper_signs=damping.signs,
        wet=np.empty((0, modes.omega_squared.size)) if reservoir is None else reservoir.rows(place, modes),
        boundary=np.empty((0, 0)),
    )
