"""The decoupled chain for someone who waits: the same slips and rotations, without the evidence at its crack.

What most changes of a case leave alone is kept: the motion of the crack, which grows as the ground's does."""

from __future__ import annotations

import hashlib
from dataclasses import replace

import numpy as np

from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.models.decoupled.chain import Chain, chain
from heeltoe.models.decoupled.crack_motion import CrackMotion, crack_motion
from heeltoe.models.decoupled.model import of_the_chain, step_of
from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.rigid.model import run_rigid
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion

# Digits of the ground's motion, over its peak, by which it is known again at another strength.
_DIGITS = 9
_KEPT: Kept[tuple[CrackMotion, float]] = Kept(12)


def run_live(case: Case, earthquake: Earthquake) -> DecoupledResponse:
    """Run the decoupled chain without its evidence; histories are as :func:`run_decoupled` has them.

    Raises
    ------
    InputError
        As :func:`run_decoupled`.
    """
    at_crack = _at_crack(chain(case), earthquake)
    # Where the crest is relative to the ground depends on the part below, too.
    response = run_rigid(case, at_crack.felt(case, earthquake), step_of(earthquake), crest=False)
    return of_the_chain(response, earthquake)


def _at_crack(part: Chain, earthquake: Earthquake) -> CrackMotion:
    peak = earthquake.motion.pga
    if peak == 0.0:
        return crack_motion(part, earthquake)[0]
    # A chain is kept itself, so that the same one comes back; it is part of what is kept here, and so stays the same.
    key = (_digest(part), _shape(earthquake, peak))
    level_motion, of = _KEPT.get(key, lambda: (crack_motion(part, earthquake)[0], peak))
    if of == peak:
        return level_motion
    factor = peak / of
    return replace(
        level_motion,
        horizontal=_scaled(level_motion.horizontal, factor),
        vertical=_scaled(level_motion.vertical, factor),
        rotation=_scaled(level_motion.rotation, factor),
    )


def _scaled(motion: GroundMotion, factor: float) -> GroundMotion:
    values = motion.acceleration * factor
    values.flags.writeable = False
    return replace(motion, acceleration=values)


def _digest(part: Chain) -> bytes:
    digest = hashlib.sha256()
    for array in (part.omega, part.participation, part.shapes):
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.digest() + str(part.damping).encode()


def _shape(earthquake: Earthquake, peak: float) -> bytes:
    """Return what is the same of an earthquake at any strength."""
    shaking = earthquake.shaking
    digest = hashlib.sha256(shaking.time.tobytes())
    for component in (shaking.horizontal, shaking.up):
        if component is not None:
            digest.update(np.round(component / peak, _DIGITS).tobytes())
    return digest.digest()
