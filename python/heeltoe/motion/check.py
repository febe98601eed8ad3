"""What is suspicious about a ground motion before anyone shakes a dam with it."""

from __future__ import annotations

import numpy as np

from heeltoe.errors import InputError
from heeltoe.motion.ground_motion import GroundMotion


def check(motion: GroundMotion, gravity: float, *, allow_zero: bool = False, field: str = "motion") -> tuple[str, ...]:
    """Return what is suspicious about a motion.

    Parameters
    ----------
    motion
        The motion as it goes into the analysis.
    gravity
        One g [m/s2].
    allow_zero
        Accept a motion that is zero throughout.
    field
        Where it stands in the case, for errors.

    Raises
    ------
    InputError
        Where it is zero, or peaks beyond anything an earthquake does.
    """
    peak = motion.pga / gravity
    if peak == 0.0:
        if allow_zero:
            return (f"{motion.name} is zero throughout: in this direction the ground does not move",)
        raise InputError("motion-zero", field, motion.name)
    if peak > 10.0:
        raise InputError("motion-peak", field, f"{peak:.4g} g", name=motion.name)
    said = []
    if peak > 3.0:
        said.append(f"{motion.name} peaks at {peak:.3g} g, more than any ground has been seen to do: check its unit")
    if peak < 1e-3:
        said.append(f"{motion.name} peaks at {peak:.2g} g only: check its unit, or scale it by motion.pga")
    if motion.format != "points" and motion.pgv > 0.0 and abs(motion.end_velocity) > 0.2 * motion.pgv:
        said.append(
            f"{motion.name} ends at {motion.end_velocity:.3g} m/s, {abs(motion.end_velocity) / motion.pgv:.0%} of its "
            "largest velocity: its baseline drifts, or it was cut"
        )
    steps = np.diff(motion.time)
    if (steps > 5.0 * motion.dt).any() and motion.time.size > 20:
        gap = int(steps.argmax())
        said.append(f"{motion.name} has a gap of {steps[gap]:.3g} s at {motion.time[gap]:.4g} s")
    top = np.abs(motion.acceleration) >= motion.pga * (1.0 - 1e-12)
    run = top[:-3] & top[1:-2] & top[2:-1] & top[3:]
    if motion.time.size > 20 and run.any():
        said.append(f"{motion.name} stays at its peak for four samples or more: it may be clipped")
    return tuple(said)
