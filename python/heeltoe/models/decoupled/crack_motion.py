"""The motion of the crack under that of the ground, exact from moment to moment."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.decoupled.chain import Chain
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion

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
    asked
        Longest step that was allowed [s]; the same one gives the same moments, the one that came of it may not.
    """

    horizontal: GroundMotion
    vertical: GroundMotion
    rotation: GroundMotion
    step: float
    asked: float

    def felt(self, case: Case, ground: Earthquake) -> Earthquake:
        """Return what of it the block of a case feels; the crack swings on while the ground is silent.

        A vertical ground motion that is given must not be lost on the way; what the crack adds to it belongs to it.
        """
        upward = case.decoupled.vertical or ground.vertical is not None
        return Earthquake(
            # The motions of a sequence begin at the crack when they do below it.
            replace(self.horizontal, parts=ground.motion.parts),
            self.vertical if upward else None,
            ground.run_end,
            self.rotation if case.decoupled.rotation else None,
        )


# The same motion of the same crack is asked for again: by a block without restitution, and by a longer run's first try.
_KEPT: Kept[tuple[Floats, Floats, Floats]] = Kept(16)


def crack_motion(chain: Chain, ground: Earthquake) -> tuple[CrackMotion, float]:
    """Return the motion of the crack, sampled so that straight lines between the samples are good enough.

    Parameters
    ----------
    chain
        What the ground shakes.
    ground
        What shakes it; its rotation plays no part.

    Returns
    -------
    found : CrackMotion
    straightness : float
        What straight lines between samples twice as far apart miss of the horizontal and the vertical motion, over the
        horizontal peak; between these samples it is a quarter of that.
    """
    shaking = ground.shaking
    step = FIRST_STEP
    coarse, rough, _ = accelerations(chain, shaking, step)
    for _ in range(HALVINGS):
        step /= 2.0
        time, crack, _ = accelerations(chain, shaking, step)
        # The ground's own moments are samples of both; among them are the jumps, which have two values.
        between = ~np.isin(time, shaking.time)
        straight = np.array([np.interp(time[between], coarse, row) for row in rough[:2]])
        straightness = relative(straight, crack[:2, between], crack)
        if straightness <= STRAIGHT:
            break
        coarse, rough = time, crack
    return _named(chain, ground.motion, time, crack, step), straightness


def crack_motion_at(chain: Chain, ground: Earthquake, step: float) -> CrackMotion:
    """Return the motion of the crack with samples no more than `step` [s] apart."""
    time, crack, _ = accelerations(chain, ground.shaking, step)
    return _named(chain, ground.motion, time, crack, step)


def relative(approximate: Floats, exact: Floats, crack: Floats) -> float:
    """Return the largest difference over the peak of the crack's horizontal acceleration; 0 where nothing moves."""
    peak = float(np.abs(crack[0]).max())
    return float(np.abs(approximate - exact).max(initial=0.0)) / peak if peak else 0.0


def _named(chain: Chain, motion: GroundMotion, time: Floats, crack: Floats, asked: float) -> CrackMotion:
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
    return CrackMotion(horizontal, vertical, rotation, round(float(np.diff(time).max()), 9), asked)


def accelerations(chain: Chain, shaking: Shaking, step: float) -> tuple[Floats, Floats, Floats]:
    """Return the acceleration of the crack under a ground acceleration that is straight between its moments.

    On a piece of length h with the load p0 + p1 s of a mode, q = (p0 + p1 s)/w^2 - 2 d p1/w^3 + Re(c exp(l s)) with
    l = -d w + i w sqrt(1 - d^2), so that the state is exact from moment to moment and the acceleration of the mode is
    Re(c l^2 exp(l s)) anywhere between them; there is no time step (docs/decoupled.md, equations 4 to 6).

    Parameters
    ----------
    chain
        What is shaken, at rest at the start.
    shaking
        By what; its rotation plays no part.
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
    moved = [None if row is None else row.tobytes() for row in (shaking.time, shaking.horizontal, shaking.up)]
    return _KEPT.get((chain, step, *moved), lambda: _accelerations(chain, shaking, step))


def _accelerations(chain: Chain, shaking: Shaking, step: float) -> tuple[Floats, Floats, Floats]:
    """Compute what :func:`accelerations` returns."""
    time, up = shaking.time, shaking.up
    pieces = np.diff(time)
    base = np.stack([shaking.horizontal, np.zeros_like(time) if up is None else up])
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
    """Return the constants c of :func:`accelerations` of every piece and mode, (n - 1, m)."""
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
