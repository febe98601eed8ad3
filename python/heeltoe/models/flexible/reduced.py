"""The two elastic parts of a case in their modes, ready for the kernel: shapes at the crack, loads, damping."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.geometry.axes import along_and_across, places
from heeltoe.geometry.section import CutSection
from heeltoe.kept import Kept
from heeltoe.kernel import CrackedDam
from heeltoe.models.flexible.elastic import Body, Dam, bonded_state, dam
from heeltoe.models.flexible.inside import CrackAnchor, FollowingWater, crack_anchors, following_water
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.models.flexible.modes import Modes, intact_periods, part_periods, rayleigh, reduce, residual_error


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


@dataclass(frozen=True, eq=False, kw_only=True)
class FlexibleDam(Dam):
    """A dam ready to be shaken: its elastic bodies in their modes.

    Attributes
    ----------
    section
        The part above the crack.
    modes
        Of each body.
    reduced
        The bodies in their modes, as the kernel takes them.
    kernel
        The kernel's own copy.
    static
        (2 n,) displacements before the earthquake of each body [m].
    crack_force
        (2 k,) forces on the upper body's crack nodes before the earthquake, x and z in turn [N].
    periods
        Longest periods of the intact dam, water included [s].
    coefficients
        Rayleigh coefficients of mass [1/s] and stiffness [s]; None with `modal` damping.
    basis_error
        Largest error of the crack's flexibility by the modes left out, over the range of those kept; 0 where none is.
    water, anchors
        What acts in the crack beside contact: water whose pressure changes, anchors with stiffness.
    """

    section: CutSection
    modes: tuple[Modes, ...]
    reduced: tuple[ReducedBody, ...]
    kernel: CrackedDam
    static: tuple[Floats, ...]
    crack_force: Floats
    periods: Floats
    coefficients: tuple[float, float] | None
    basis_error: float
    water: FollowingWater | None
    anchors: tuple[CrackAnchor, ...]


_KEPT: Kept[FlexibleDam] = Kept(4)


def build_flexible_dam(case: Case) -> FlexibleDam:
    """Mesh, assemble and reduce both parts of a case; the last few are kept, by all that they depend on.

    Raises
    ------
    InputError
        Where the case has no modulus, or a mesh cannot be made or used.
    """
    # The earthquake plays no part, and files may change under their name.
    key = (case.model_dump_json(exclude={"motion", "title", "analysis"}), *fingerprints(case))
    return _KEPT.get(key, lambda: _build(case))


def fingerprints(case: Case) -> list[str]:
    """Return what the mesh files contain, as a hash; a missing one is the reader's to complain about."""
    found = []
    for name in (case.flexible.mesh_above, case.flexible.mesh_below):
        path = case.base_directory / name if name else None
        found.append(sha256(path.read_bytes()).hexdigest() if path and path.is_file() else "")
    return found


def _build(case: Case) -> FlexibleDam:
    bonded = dam(case, dam_mesh(case))
    bodies = bonded.bodies
    *static, crack_force = bonded_state(bonded)
    static = static[: len(bodies)]
    periods = intact_periods(bonded, 5)
    modes = tuple(reduce(body, case.flexible.modes) for body in bodies)
    coefficients = None
    if case.flexible.damping != "modal":
        coefficients = rayleigh(periods[0], periods[2], case.concrete.damping)
    reduced = []
    for place, (body, basis, still) in enumerate(zip(bodies, modes, static, strict=True)):
        damping = _damping(case, basis, coefficients, above=place == 0)
        reduced.append(_reduced(body, basis, still, damping, case.cut))
    friction = (case.crack.mu_static, case.crack.mu_kinetic)
    water, anchors = following_water(case, bodies), crack_anchors(case, bodies)
    upper, lower = (*reduced, None)[:2]
    assert upper is not None
    errors = [residual_error(body, basis) for body, basis in zip(bodies, modes, strict=True) if basis.truncated]
    return FlexibleDam(
        bodies=bodies,
        tie=bonded.tie,
        section=case.cut,
        modes=modes,
        reduced=tuple(reduced),
        kernel=CrackedDam(upper, lower, friction, case.flexible.contactors, water, anchors),
        static=tuple(static),
        crack_force=crack_force,
        periods=periods,
        coefficients=coefficients,
        basis_error=max(errors, default=0.0),
        water=water,
        anchors=anchors,
    )


def _damping(
    case: Case, modes: Modes, coefficients: tuple[float, float] | None, *, above: bool
) -> tuple[Floats, Floats]:
    """Return the damping coefficients [1/s] of the modes while some node sticks, and while none does.

    ``thesis`` is that of Zhu (2004), section 7.4.1: Rayleigh on all motion, rigid-body motion included, while any
    node sticks; when none does, on the lower part alone, with coefficients of its own periods.
    """
    omega_squared = modes.omega_squared
    if coefficients is None:
        modal = 2.0 * case.concrete.damping * np.sqrt(omega_squared)
        return modal, modal
    everywhere = coefficients[0] + coefficients[1] * omega_squared
    if case.flexible.damping == "deformation":
        everywhere[: modes.rigid] = 0.0
        return everywhere, everywhere
    if above:
        return everywhere, np.zeros_like(everywhere)
    own = part_periods(modes, 3)
    mass, stiffness = rayleigh(own[0], own[2], case.concrete.damping)
    return everywhere, mass + stiffness * omega_squared


def _reduced(
    body: Body, modes: Modes, static: Floats, damping: tuple[Floats, Floats], section: CutSection
) -> ReducedBody:
    crack = body.mesh.crack
    horizontal = np.zeros(static.size)
    horizontal[::2] = 1.0
    place = places(body.mesh.nodes[crack], section).T.reshape(-1)
    moved = along_and_across(static.reshape(-1, 2)[crack], section).T.reshape(-1)
    shapes = along_and_across(modes.shapes.T.reshape(modes.omega_squared.size, -1, 2)[:, crack], section)
    pushed = body.mass @ (1.0 - horizontal) - body.load_per_vertical
    return ReducedBody(
        omega_squared=np.ascontiguousarray(modes.omega_squared),
        damping_sticking=np.ascontiguousarray(damping[0]),
        damping_free=np.ascontiguousarray(damping[1]),
        load=modes.shapes.T @ body.load,
        participation_horizontal=modes.shapes.T @ (body.mass @ horizontal),
        participation_vertical=modes.shapes.T @ pushed,
        start=modes.shapes.T @ (body.mass @ static),
        shapes=np.ascontiguousarray(shapes.swapaxes(1, 2).reshape(modes.omega_squared.size, -1)),
        position=place + moved,
    )
