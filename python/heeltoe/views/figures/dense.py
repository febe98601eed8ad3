"""Histories of a rigid block with moments far apart, filled in for drawing."""

from __future__ import annotations

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.result.histories import SLIP
from heeltoe.result.response import Response

# A picture shows about so many moments; more need no filling in.
_ENOUGH = 400


def filled_in(response: Response) -> Response:
    """Return the response with more moments in its histories, where there are few.

    Between two moments, events among them, the slip of a rigid block is the cubic with its values and velocities at
    both ends, exactly so on a straight piece of the motion. The ground moves as its motion says; all else is joined by
    straight lines.
    """
    h, log = response.histories, response.event_log
    if not 2 <= len(h.time_s) < _ENOUGH or not log:
        return response
    time = np.unique(np.concatenate([h.time_s, log.time_s, np.linspace(0.0, h.time_s[-1], _ENOUGH)]))
    time = time[time <= h.time_s[-1]]
    # Forces and accelerations jump at events; in an interval with one they keep the value of its start.
    place = np.clip(np.searchsorted(h.time_s, time, side="right") - 1, 0, len(h.time_s) - 2)
    events = np.searchsorted(log.time_s, h.time_s, side="right")
    broken = (events[place + 1] > events[place]) & (time < h.time_s[place + 1])
    histories = {}
    for name, values in h.items():
        straight = np.interp(time, h.time_s, values)
        jumps = name.endswith(("_n", "_acceleration_m_s2")) and not name.startswith("ground")
        histories[name] = np.where(broken, values[place], straight) if jumps else straight
    histories |= {"time_s": time, SLIP: _slip(response, time)}
    # The ground may jump between two moments; after a record it stands still.
    for name, motion in (("", response.motion), ("vertical_", response.vertical)):
        if motion is not None:
            ground = np.interp(time, motion.time, motion.acceleration, right=0.0)
            histories[f"{name}ground_acceleration_m_s2"] = ground
    modes = np.array(["rest", *log.mode_after])
    mode = modes[np.searchsorted(log.time_s, time, side="right")]
    return response.with_crack(histories=histories, mode=tuple(mode.tolist()))


def _slip(response: Response, time: Floats) -> Floats:
    h, log = response.histories, response.event_log
    at = np.concatenate([h.time_s, log.time_s])
    # Of what happens at one moment, the sample comes first and the last event last.
    order = np.argsort(at, kind="stable")
    at = at[order]
    slip = np.concatenate([h.slip_m, log.slip_m])[order]
    after = np.concatenate([h.slip_velocity_m_s, log.slip_velocity_m_s])[order]
    before = np.concatenate([h.slip_velocity_m_s, log.approach_slip_velocity_m_s])[order]
    # An event at a moment of the histories: they have the state after it.
    start = np.clip(np.searchsorted(at, time, side="right") - 1, 0, at.size - 2)
    last = at[start] == at[-1]
    end = np.minimum(np.searchsorted(at, at[start], side="right"), at.size - 1)
    long = np.where(last, 1.0, at[end] - at[start])
    s = np.where(last, 0.0, (time - at[start]) / long)
    left, right = slip[start], slip[end]
    rise, fall = after[start] * long, before[end] * long
    points: Floats = (
        left * (1.0 + 2.0 * s) * (1.0 - s) ** 2
        + right * s**2 * (3.0 - 2.0 * s)
        + rise * s * (1.0 - s) ** 2
        - fall * s**2 * (1.0 - s)
    )
    return points
