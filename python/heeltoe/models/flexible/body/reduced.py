"""The elastic parts of a case in their modes, ready for the kernel: shapes at the crack, loads, damping."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.beside import beside
from heeltoe.base.blas import one_blas_thread
from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.errors.error import expect
from heeltoe.geometry.axes import along_and_across, places
from heeltoe.geometry.section import CutSection
from heeltoe.kernel.dam import CrackAnchor, CrackedDam, CrackLine
from heeltoe.mechanics.beam import band_of
from heeltoe.mechanics.friction import law_of
from heeltoe.models.flexible.body.bond import kernel_bond
from heeltoe.models.flexible.body.bonded import NOT_OF_DAM, BondedDam, bonded_dam, case_key
from heeltoe.models.flexible.body.damping import Damping, damping_of
from heeltoe.models.flexible.body.elastic import Body, crack_forces
from heeltoe.models.flexible.body.modes import Modes
from heeltoe.models.flexible.body.reservoir import WaterBody, water_body
from heeltoe.models.flexible.body.rock import RockBody, founded, rock_body
from heeltoe.models.flexible.body.rocking_thresholds import elastic_give
from heeltoe.models.flexible.body.stress_places import stress_places
from heeltoe.models.flexible.body.uplift_and_anchors import crack_anchors, following_water, water_on_rock
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
    unrest
        Why no state is known in which it stands, see ``CrackedDam.unrest``; None where one is, or none was sought.
    """

    stands: bool
    slips: tuple[float, ...]
    open_contacts: tuple[int, ...]
    unrest: str | None = None


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
    contactors
        Contactors on each element of a crack.
    start
        The state before the earthquake.
    static
        (2 n,) displacements in it of each body [m].
    crack_forces
        (2, k) forces on the nodes of each crack's upper face in it, along and across the crack [N].
    damping
        That of the concrete, with the periods of the intact dam.
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
    contactors: int
    start: Start
    static: tuple[Floats, ...]
    crack_forces: tuple[Floats, ...]
    damping: Damping
    lines: tuple[CrackLine, ...]
    reservoir: WaterBody | None
    rock: RockBody | None
    rock_error: float

    def __repr__(self) -> str:
        parts = zip(self.bodies, self.modes, strict=True)
        counts = " and ".join(f"{len(body.mesh.nodes)} nodes in {modes.shapes.shape[1]} modes" for body, modes in parts)
        return f"<FlexibleDam: {counts}; first period {self.periods[0]:.4g} s>"

    def __getstate__(self) -> dict[str, object]:
        """Return what is kept of a dam: the kernel's own copy can be made again."""
        return {name: value for name, value in vars(self).items() if name != "kernel"}

    @cached_property
    def kernel(self) -> CrackedDam:
        """The kernel's own copy."""
        return _cracked(self.contactors, self.sections, self.asked, self.reduced, self.lines, self.reservoir, self.rock)

    @property
    def give(self) -> tuple[float, float]:
        """Give of the governing crack, see :func:`heeltoe.models.flexible.body.rocking_thresholds.elastic_give`."""
        return self.lines[self.asked].give

    @property
    def anchors(self) -> tuple[CrackAnchor, ...]:
        """Those with stiffness, crack by crack."""
        return tuple(anchor for line in self.lines for anchor in line.anchors)

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
def build_flexible_dam(case: Case, larger: float = 1.0, shapes_of: float | None = None) -> FlexibleDam:
    """Mesh, assemble and reduce the parts of a case; the last few are kept, by all that they depend on. Rock and water
    with sound reach `larger` times as far as they need, and answer well up to `larger` times the frequency of
    :func:`heeltoe.mechanics.beam.band_of`. The rock may take its shapes from rock of another modulus [Pa].

    Raises
    ------
    InputError
        Where the case has no modulus, or a mesh cannot be made or used.
    """
    expect(case, Case, "a case", "case")
    key = (larger, shapes_of, case_key(case, NOT_OF_DAM))
    return _KEPT.get(key, lambda: _build(case, larger, shapes_of))


def _build(case: Case, larger: float = 1.0, shapes_of: float | None = None) -> FlexibleDam:
    bonded = bonded_dam(case)
    bodies, modes = bonded.bodies, bonded.modes
    sections = tuple(single_crack_case.cut for single_crack_case in case.single_crack_cases)
    damping = damping_of(case, bonded)
    band = larger * band_of(case if shapes_of is None else case.on_rock(shapes_of))
    with beside(lambda: water_body(case, bodies, band, longer=larger)) as water:
        whole = founded(case, bonded, larger=larger, shapes_of=shapes_of)
        rock = rock_body(case, bodies[-1], larger=larger, shapes_of=shapes_of)
    reservoir = water.result()
    if rock is not None and case.foundation is not None and case.foundation.bears_uplift:
        last = len(sections) - 1
        rock = replace(rock, pressed=water_on_rock(case.single_crack_cases[last], bonded.faces(last), rock))
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
    lines = _lines(case, bonded, rock)
    contactors = case.flexible.contactors
    kernel = _cracked(contactors, sections, case.asked, reduced, lines, reservoir, rock)
    # The penalty method begins with its crack bonded and its springs unloaded.
    exact = case.flexible.contact == "coulomb"
    static, start = bonded.bent, Start(not exact, (0.0,) * len(lines), (0,) * len(lines))
    forces = tuple(
        along_and_across(force.reshape(-1, 2), section).T
        for force, section in zip(bonded.bonded_forces, sections, strict=True)
    )
    rest = kernel.still() if exact else None
    if exact:
        start = replace(start, unrest=kernel.unrest())
    if rest is not None:
        start = Start(True, rest.slips, rest.open_contacts)
        # Behind those of the dam are the modes of the rock.
        static = tuple(basis.shapes @ q for basis, q in zip(modes, rest.modes, strict=False))
        forces = rest.forces
    dam = FlexibleDam(
        **vars(bonded),
        section=case.cut,
        sections=sections,
        asked=case.asked,
        reduced=reduced,
        contactors=contactors,
        start=start,
        static=static,
        crack_forces=forces,
        damping=damping,
        lines=lines,
        reservoir=reservoir,
        rock=rock,
        rock_error=max((part.error for part in (whole, rock) if part is not None), default=0.0),
    )
    vars(dam)["kernel"] = kernel
    return dam


def _cracked(
    contactors: int,
    sections: tuple[CutSection, ...],
    asked: int,
    reduced: tuple[ReducedBody, ...],
    lines: tuple[CrackLine, ...],
    reservoir: WaterBody | None,
    rock: RockBody | None,
) -> CrackedDam:
    parts = reduced if rock is None else (*reduced, _reduced_rock(rock, sections[-1], reduced[0]))
    return CrackedDam(parts, lines, contactors, reservoir, asked=asked)


def _lines(case: Case, bonded: BondedDam, rock: RockBody | None) -> tuple[CrackLine, ...]:
    """Return the cracks of a case, with where their faces are among the nodes of the parts above and below them."""
    result = []
    for place, (alone, force) in enumerate(zip(case.single_crack_cases, bonded.bonded_forces, strict=True)):
        above, faces = bonded.bodies[place].mesh, bonded.faces(place)
        on_rock = rock if len(faces) == 1 else None
        below = faces[1].crack.size if on_rock is None and len(faces) > 1 else 0
        law = alone.crack.law
        result.append(
            CrackLine(
                upper=(above.top, faces[0].crack.size),
                lower=(0, len(on_rock.points) if on_rock is not None else below),
                friction=(alone.crack.mu_static, alone.crack.mu_kinetic),
                give=elastic_give(alone, alone.cut, force),
                law=None if law is None else law_of(law),
                angles=(
                    angles(above, faces[0].crack, alone),
                    [] if len(faces) == 1 else angles(faces[1], faces[1].crack, alone),
                ),
                bond=kernel_bond(alone, along_crack(bonded.bodies[place], alone.cut)),
                water=following_water(alone, faces, on_rock),
                anchors=crack_anchors(alone, faces, on_rock),
            )
        )
    return tuple(result)


def along_crack(above: Body, section: CutSection) -> Floats:
    """Return where the nodes of the part above a crack are along it (k,) [m]."""
    along: Floats = places(above.mesh.nodes[above.mesh.faces[-1]], section)[:, 0]
    return along


def damped(dam: FlexibleDam, factor: float) -> FlexibleDam:
    """Return the same dam with its damping multiplied by `factor`."""
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
    return replace(dam, reduced=reduced, damping=damping)


def _reduced_rock(rock: RockBody, section: CutSection, part: ReducedBody) -> ReducedBody:
    """Return the rock as a body of the kernel: no ground shakes it, and it has settled under its own weight. Its
    dashpots and its share in the water are as many as those of a `part` of the dam, and none."""
    none, size = np.zeros(rock.omega_squared.size), rock.omega_squared.size
    return ReducedBody(
        omega_squared=rock.omega_squared,
        damping_sticking=none,
        damping_free=none,
        load=rock.pressed,
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
