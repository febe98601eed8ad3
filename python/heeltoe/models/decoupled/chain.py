"""The motion of the crack: the part below it, elastic, carries the part above as a rigid body that does not slip.

What the part above does when it slides and rocks does not act back on the part below; that is the price of the
decoupled chain, and what the flexible model is for (docs/koyna.md)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.geometry.section import cut
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.flexible.elastic import Sparse, dam, dofs, side_by_side
from heeltoe.models.flexible.mesh.dam import BodyMesh, dam_mesh
from heeltoe.models.flexible.modes import lowest
from heeltoe.models.flexible.reduced import fingerprints
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground

Floats = NDArray[np.float64]

#: Modes that are kept: the lowest, up to so many, and none with a shorter period [s]. Nothing in an accelerogram is as
#: fast; faster modes move with the ground, as all that is left out does.
MOST_MODES, SHORTEST_PERIOD = 60, 0.005
#: The first step of the motion at the crack [s]; it is halved until straight lines between the samples are within
#: this part of the peak, or up to so often.
FIRST_STEP, STRAIGHT, HALVINGS = 1e-3, 2e-3, 4


@dataclass(frozen=True, eq=False)
class CrackMotion:
    """The motion of the crack, as motions that can shake a block.

    Attributes
    ----------
    horizontal, vertical, rotation
        Total acceleration at the middle of the crack: downstream, upward [m/s2], counter-clockwise [rad/s2].
    step
        Longest step between samples [s].
    """

    horizontal: GroundMotion
    vertical: GroundMotion
    rotation: GroundMotion
    step: float


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
        steady vibration of amplitude 1, by its period [s]."""
        w = 2.0 * math.pi / periods[:, None]
        swing = w**2 / (self.omega**2 - w**2 + 2j * self.damping * self.omega * w)
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
    return _kept(case, _chain)


def bonded_chain(case: Case) -> Chain:
    """Return the whole dam, both parts elastic and the crack bonded, as what the motion at the crack is compared with.

    Raises
    ------
    InputError
        As :func:`chain`.
    """
    return _kept(case, _bonded)


# Chains built before, newest last: a table of runs shakes the same one again and again.
_BUILT: dict[tuple[str, ...], Chain] = {}
_MOST_KEPT = 8


def _kept(case: Case, build: Callable[[Case], Chain]) -> Chain:
    """Build a chain, or find it by all that it depends on."""
    fields: Any = dict.fromkeys(("section", "concrete", "reservoir", "flexible", "gravity"), True)
    fields["crack"] = {"elevation", "inclination"}
    # Files may change under their name.
    key = (build.__name__, case.model_dump_json(include=fields), *fingerprints(case))
    if key not in _BUILT:
        built = build(case)
        while len(_BUILT) >= _MOST_KEPT:
            _BUILT.pop(next(iter(_BUILT)), None)
        _BUILT[key] = built
    return _BUILT[key]


def _chain(case: Case) -> Chain:
    block = build_block(case)
    section = block.section
    if section.crack_elevation == section.base_elevation:
        raise InputError("crack-at-base", "crack.elevation", f"{case.crack.elevation:g} m")
    body = dam(case, section, dam_mesh(case, section, case.base_directory)).lower
    assert body is not None
    plane = plane_fit(body.mesh)
    # What is attached moves as the fitted plane does.
    mass = body.mass + plane.T @ sparse.csr_array(attached_mass(case, block)) @ plane
    free = np.setdiff1d(np.arange(body.mesh.nodes.size), dofs(body.mesh.fixed))
    hold = sparse.eye_array(body.mesh.nodes.size, format="csr")[:, free]
    return _in_modes(body.stiffness, mass, plane, hold, case.concrete.damping)


def _bonded(case: Case) -> Chain:
    section = cut(case)
    whole = dam(case, section, dam_mesh(case, section, case.base_directory))
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
    x, z = (points - (points[0] + points[-1]) / 2.0).T
    rigid = np.zeros((2 * len(points), 3))
    rigid[::2, 0] = rigid[1::2, 1] = 1.0
    rigid[::2, 2], rigid[1::2, 2] = -z, x
    weighted = np.repeat(weights, 2)[:, None] * rigid
    fit = np.linalg.solve(rigid.T @ weighted, weighted.T)
    places = dofs(mesh.crack)
    rows = np.repeat(np.arange(3), places.size)
    return sparse.csr_array((fit.reshape(-1), (rows, np.tile(places, 3))), (3, mesh.nodes.size))


def attached_mass(case: Case, block: Block) -> Floats:
    """Return the mass matrix of the part above the crack about the middle of the crack, (3, 3): downstream, upward,
    counter-clockwise [kg, kg m, kg m2 per m]. Its virtual water moves horizontally alone, at the height of its
    centre, as that of the block does."""
    section = block.section
    middle = (np.array(section.heel) + section.toe) / 2.0
    concrete = case.concrete.density * section.area
    x, z = np.array(section.centroid) - middle
    water, height = block.water.mass, section.heel[1] + block.water.height - middle[1]
    inertia = case.concrete.density * section.polar_inertia + concrete * (x * x + z * z) + water * height**2
    tilt = -(concrete * z + water * height)
    return np.array([[concrete + water, 0.0, tilt], [0.0, concrete, concrete * x], [tilt, concrete * x, inertia]])


def crack_motion(
    chain: Chain, motion: GroundMotion, vertical: GroundMotion | None, end: float
) -> tuple[CrackMotion, float]:
    """Return the motion of the crack, sampled so that straight lines between the samples are good enough.

    Parameters
    ----------
    chain
        What the ground shakes.
    motion, vertical
        The ground's motion, downstream and upward.
    end
        Length of the run [s]; where a record has ended the ground stands still.

    Returns
    -------
    found : CrackMotion
    straightness : float
        What straight lines between samples twice as far apart miss of the horizontal and the vertical motion, over the
        horizontal peak; between these samples it is a quarter of that.
    """
    series = ground(motion, vertical, end)
    step = FIRST_STEP
    coarse, rough, _ = shaken(chain, *series, step)
    for _ in range(HALVINGS):
        step /= 2.0
        time, crack, _ = shaken(chain, *series, step)
        # The ground's own moments are samples of both; among them are the jumps, which have two values.
        between = ~np.isin(time, series[0])
        straight = np.array([np.interp(time[between], coarse, row) for row in rough[:2]])
        straightness = relative(straight, crack[:2, between], crack)
        if straightness <= STRAIGHT:
            break
        coarse, rough = time, crack
    return _named(chain, motion, time, crack), straightness


def crack_motion_at(
    chain: Chain, motion: GroundMotion, vertical: GroundMotion | None, end: float, step: float
) -> CrackMotion:
    """Return the motion of the crack with samples no more than `step` [s] apart."""
    time, crack, _ = shaken(chain, *ground(motion, vertical, end), step)
    return _named(chain, motion, time, crack)


def relative(found: Floats, exact: Floats, crack: Floats) -> float:
    """Return the largest difference over the peak of the crack's horizontal acceleration; 0 where nothing moves."""
    peak = float(np.abs(crack[0]).max())
    return float(np.abs(found - exact).max(initial=0.0)) / peak if peak else 0.0


def _named(chain: Chain, motion: GroundMotion, time: Floats, crack: Floats) -> CrackMotion:
    horizontal, vertical, rotation = (
        GroundMotion(
            name=f"{motion.name}, {what}",
            time=time,
            acceleration=values,
            source=motion.source,
            processing=(*motion.processing, f"through the part of the dam below the crack, {chain.omega.size} modes"),
            warnings=motion.warnings,
        )
        for what, values in zip(("at the crack", "at the crack, upward", "rotation of the crack"), crack, strict=True)
    )
    # Without what the rounding of the moments adds.
    return CrackMotion(horizontal, vertical, rotation, round(float(np.diff(time).max()), 9))


def shaken(
    chain: Chain, time: Floats, horizontal: Floats, up: Floats | None, step: float
) -> tuple[Floats, Floats, Floats]:
    """Return the acceleration of the crack under a ground acceleration that is straight between its moments.

    On a piece of length h with the load p0 + p1 s of a mode, q = (p0 + p1 s)/w^2 - 2 d p1/w^3 + Re(c exp(l s)) with
    l = -d w + i w sqrt(1 - d^2), so that the state is exact from moment to moment and the acceleration of the mode is
    Re(c l^2 exp(l s)) anywhere between them; there is no time step (docs/koyna.md, equations 4 to 6).

    Parameters
    ----------
    chain
        What is shaken, at rest at the start.
    time, horizontal, up
        (n,) each, from :func:`heeltoe.motion.moments.ground` [s, m/s2].
    step
        Each piece of the ground's motion is divided into equal parts of up to this length [s].

    Returns
    -------
    time : ndarray, shape (k,)
        Jumps of the ground stay [s].
    crack : ndarray, shape (3, k)
        Total acceleration of the crack, downstream, upward [m/s2] and counter-clockwise [rad/s2].
    ground : ndarray, shape (2, k)
        The ground's, on the same moments.
    """
    pieces = np.diff(time)
    base = np.stack([horizontal, np.zeros_like(horizontal) if up is None else up])
    load = -(chain.participation @ base)
    root = 1j * math.sqrt(1.0 - chain.damping**2)
    w = chain.omega
    eigen = (w * (root - chain.damping)).astype(np.complex128)
    constants = _states(pieces, load, w, chain.damping, eigen)
    response = chain.shapes * eigen**2
    count = np.maximum(1, np.ceil(pieces / step * (1.0 - 1e-9))).astype(np.int64)
    count[pieces == 0.0] = 0
    starts = np.concatenate([[0], np.cumsum(count + 1)])
    crack, moments = np.empty((3, starts[-1])), np.empty(starts[-1])
    grounds = np.empty((2, starts[-1]))
    # Pieces of one length and one division at a time: what happens within them is one product of matrices.
    kinds, member = np.unique(np.column_stack([pieces.round(12), count]), axis=0, return_inverse=True)
    for kind, (_, parts) in enumerate(kinds):
        chosen = np.flatnonzero(member.reshape(-1) == kind)
        share = np.linspace(0.0, 1.0, int(parts) + 1)
        factor = np.exp(np.multiply.outer(share * pieces[chosen[0]], eigen))
        places = starts[chosen][:, None] + np.arange(share.size)
        # Written so that both ends are exact.
        grounds[:, places] = base[:, chosen, None] * (1.0 - share) + base[:, chosen + 1, None] * share
        moments[places] = time[chosen, None] * (1.0 - share) + time[chosen + 1, None] * share
        for row in range(3):
            crack[row, places] = ((constants[chosen] * response[row]) @ factor.T).real
    crack[:2] += grounds
    # The end of a piece is the start of the next, and said once, but where the ground's acceleration jumps.
    keep = np.ones(starts[-1], dtype=bool)
    joints = starts[1:-1]
    keep[joints] = np.any(grounds[:, joints] != grounds[:, joints - 1], axis=0)
    return moments[keep], crack[:, keep], grounds[:, keep]


def _states(
    pieces: Floats, load: Floats, w: Floats, damping: float, eigen: NDArray[np.complex128]
) -> NDArray[np.complex128]:
    """Return the constants c of :func:`shaken` of every piece and mode, (n - 1, m)."""
    constants = np.empty((pieces.size, w.size), dtype=np.complex128)
    place, velocity = np.zeros(w.size), np.zeros(w.size)
    swing = eigen.imag
    lengths: dict[float, NDArray[np.complex128]] = {}
    for k, h in enumerate(pieces):
        p0 = load[:, k]
        p1 = (load[:, k + 1] - p0) / h if h > 0.0 else np.zeros(w.size)
        steady = p0 / w**2 - 2.0 * damping * p1 / w**3
        lag, rate = place - steady, velocity - p1 / w**2
        c = lag - 1j * (rate + damping * w * lag) / swing
        constants[k] = c
        if h not in lengths:
            lengths[h] = np.exp(eigen * h)
        after = c * lengths[h]
        place = after.real + steady + p1 * h / w**2
        velocity = (after * eigen).real + p1 / w**2
    return constants
