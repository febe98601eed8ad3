"""The two elastic parts of a case in their modes, ready for the kernel: shapes at the crack, loads, damping."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.errors import expect
from heeltoe.geometry.axes import along_and_across, places
from heeltoe.geometry.section import CutSection
from heeltoe.kept import Kept
from heeltoe.kernel.dam import CrackedDam
from heeltoe.models.flexible.bonded import NOT_OF_DAM, BondedDam, bonded_dam, told
from heeltoe.models.flexible.damping import Damping, damping_of
from heeltoe.models.flexible.elastic import Body
from heeltoe.models.flexible.inside import CrackAnchor, FollowingWater, crack_anchors, following_water
from heeltoe.models.flexible.modes import Modes
from heeltoe.models.flexible.stance import elastic_give


@dataclass(frozen=True, eq=False)
class ReducedBody:
    """A body in its modes, as the kernel takes it; m modes, k nodes on the crack.

    Attributes
    ----------
    omega_squared, damping_sticking, damping_free, load, participation_horizontal, participation_vertical, start
        (m,) each: squared circular frequency [1/s2]; damping [1/s] while some crack node sticks and while none does;
        static load; share in the ground's motions; state at the start.
    shapes
        (m, 2 k) motion of the crack nodes, all along the crack, then all across it.
    position
        (2 k,) where they stand at the start, from the heel and from the crack [m].
    dampers
        (d, m) rows of the dashpots that couple the modes; as many on the other body.
    damper_signs
        (d,) 1 for those that take energy, -1 for those that give back what others take too much.
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


@dataclass(frozen=True)
class Start:
    """How a dam stands before the earthquake, its crack let go.

    Attributes
    ----------
    stands
        Whether friction and what else acts hold it; if not, it starts from the state with its crack bonded, as the
        penalty method always does.
    slip
        By how much the crack slips on the way there, positive downstream [m].
    open_contacts
        How many of the watched nodes are open then.
    """

    stands: bool
    slip: float
    open_contacts: int


@dataclass(frozen=True, eq=False, kw_only=True)
class FlexibleDam(BondedDam):
    """A dam ready to be shaken: its elastic bodies in their modes.

    Attributes
    ----------
    section
        The part above the crack.
    reduced
        The bodies in their modes, as the kernel takes them.
    kernel
        The kernel's own copy.
    start
        The state before the earthquake.
    static
        (2 n,) displacements in it of each body [m].
    crack_force
        (2, k) forces on the upper body's crack nodes in it, along and across the crack [N].
    damping
        That of the concrete, with the periods of the intact dam.
    water, anchors
        What acts in the crack beside contact: water whose pressure changes, anchors with stiffness.
    give
        See :func:`heeltoe.models.flexible.stance.elastic_give`.
    """

    section: CutSection
    reduced: tuple[ReducedBody, ...]
    kernel: CrackedDam
    start: Start
    static: tuple[Floats, ...]
    crack_force: Floats
    damping: Damping
    water: FollowingWater | None
    anchors: tuple[CrackAnchor, ...]
    give: tuple[float, float]

    def __repr__(self) -> str:
        parts = zip(self.bodies, self.modes, strict=True)
        counts = " and ".join(f"{len(body.mesh.nodes)} nodes in {modes.shapes.shape[1]} modes" for body, modes in parts)
        return f"<FlexibleDam: {counts}; first period {self.periods[0]:.4g} s>"

    @property
    def periods(self) -> Floats:
        """Longest periods of the intact dam, water included [s]."""
        return self.damping.periods


_KEPT: Kept[FlexibleDam] = Kept(4)


def build_flexible_dam(case: Case) -> FlexibleDam:
    """Mesh, assemble and reduce both parts of a case; the last few are kept, by all that they depend on.

    Raises
    ------
    InputError
        Where the case has no modulus, or a mesh cannot be made or used.
    """
    expect(case, Case, "not-a-case", "case")
    return _KEPT.get(told(case, NOT_OF_DAM), lambda: _build(case))


def _build(case: Case) -> FlexibleDam:
    bonded = bonded_dam(case)
    bodies, modes = bonded.bodies, bonded.modes
    damping = damping_of(case, bonded, modes)
    reduced = tuple(
        _reduced(body, basis, still, damping, place, case.cut)
        for place, (body, basis, still) in enumerate(zip(bodies, modes, bonded.bent, strict=True))
    )
    water, anchors = following_water(case, bodies), crack_anchors(case, bodies)
    give = elastic_give(case, case.cut, bonded.bonded_force)
    kernel = _cracked(case, reduced, water, anchors, give)
    # The penalty method begins with its crack bonded and its springs unloaded.
    exact = case.flexible.contact == "coulomb"
    static, start = bonded.bent, Start(not exact, 0.0, 0)
    force = along_and_across(bonded.bonded_force.reshape(-1, 2), case.cut).T
    rest = kernel.still() if exact else None
    if rest is not None:
        start = Start(True, rest.slip, rest.open_contacts)
        static = tuple(basis.shapes @ q for basis, q in zip(modes, rest.modes, strict=False))
        force = rest.force
    return FlexibleDam(
        **vars(bonded),
        section=case.cut,
        reduced=reduced,
        kernel=kernel,
        start=start,
        static=static,
        crack_force=force,
        damping=damping,
        water=water,
        anchors=anchors,
        give=give,
    )


def _cracked(
    case: Case,
    reduced: tuple[ReducedBody, ...],
    water: FollowingWater | None,
    anchors: tuple[CrackAnchor, ...],
    give: tuple[float, float],
) -> CrackedDam:
    friction = (case.crack.mu_static, case.crack.mu_kinetic)
    lower = reduced[1] if len(reduced) > 1 else None
    return CrackedDam(reduced[0], lower, friction, case.flexible.contactors, water, anchors, give)


def damped(case: Case, dam: FlexibleDam, factor: float) -> FlexibleDam:
    """Return the same dam with so many times its damping."""
    damping = dam.damping.scaled(factor)
    reduced = tuple(
        replace(part, damping_sticking=sticking, damping_free=free, dampers=rows)
        for part, sticking, free, rows in zip(
            dam.reduced, damping.sticking, damping.free, damping.dashpots, strict=True
        )
    )
    kernel = _cracked(case, reduced, dam.water, dam.anchors, dam.give)
    return replace(dam, reduced=reduced, damping=damping, kernel=kernel)


def _reduced(
    body: Body, modes: Modes, static: Floats, damping: Damping, place: int, section: CutSection
) -> ReducedBody:
    crack = body.mesh.crack
    horizontal = np.zeros(static.size)
    horizontal[::2] = 1.0
    at = places(body.mesh.nodes[crack], section).T.reshape(-1)
    moved = along_and_across(static.reshape(-1, 2)[crack], section).T.reshape(-1)
    shapes = along_and_across(modes.shapes.T.reshape(modes.omega_squared.size, -1, 2)[:, crack], section)
    pushed = body.mass @ (1.0 - horizontal) - body.load_per_vertical
    return ReducedBody(
        omega_squared=np.ascontiguousarray(modes.omega_squared),
        damping_sticking=np.ascontiguousarray(damping.sticking[place]),
        damping_free=np.ascontiguousarray(damping.free[place]),
        load=modes.shapes.T @ body.load,
        participation_horizontal=modes.shapes.T @ (body.mass @ horizontal),
        participation_vertical=modes.shapes.T @ pushed,
        start=modes.shapes.T @ (body.mass @ static),
        shapes=np.ascontiguousarray(shapes.swapaxes(1, 2).reshape(modes.omega_squared.size, -1)),
        position=at + moved,
        dampers=np.ascontiguousarray(damping.dashpots[place]),
        damper_signs=damping.signs,
    )
