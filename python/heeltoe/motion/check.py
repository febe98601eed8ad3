"""What is suspicious about a ground motion before anyone shakes a dam with it."""

from __future__ import annotations

import numpy as np

from heeltoe.errors import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.warnings import Notice


def check(
    motion: GroundMotion, gravity: float, *, allow_zero: bool = False, field: str = "motion"
) -> tuple[Notice, ...]:
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
            return (Notice("motion-still", field=field, name=motion.name),)
        raise InputError("motion-zero", field, motion.name)
    if peak > 10.0:
        raise InputError("motion-peak", field, f"{peak:.4g} g", name=motion.name)
    said = []

    def say(code: str, **quantities: float) -> None:
        said.append(Notice(code, field=field, name=motion.name, **quantities))

    if peak > 3.0:
        say("motion-strong", peak_g=peak)
    if peak < 1e-3:
        say("motion-weak", peak_g=peak)
    if motion.format != "points" and motion.pgv > 0.0 and abs(motion.end_velocity) > 0.2 * motion.pgv:
        say("motion-drifts", end_velocity_m_s=motion.end_velocity, share=abs(motion.end_velocity) / motion.pgv)
    steps = np.diff(motion.time)
    if (steps > 5.0 * motion.dt).any() and motion.time.size > 20:
        gap = int(steps.argmax())
        say("motion-gap", gap_s=float(steps[gap]), time_s=float(motion.time[gap]))
    top = np.abs(motion.acceleration) >= motion.pga * (1.0 - 1e-12)
    run = top[:-3] & top[1:-2] & top[2:-1] & top[3:]
    if motion.time.size > 20 and run.any():
        say("motion-clipped")
    return tuple(said)
