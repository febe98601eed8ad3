"""Whether a dam has stopped sliding and rocking when its run ends, and since when."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.result.contract import JOINT_METER_M, OPENINGS
from heeltoe.result.record import ResponseData

# Whether a dam that vibrates is still on its way is seen over this time [s].
LAST_S = 1.0


class LastChange(NamedTuple):
    """Quantity that moves most in the last second of a run, by how much [m], and how long that second is [s]."""

    seconds: float
    what: str
    change_m: float

    @property
    def rest(self) -> bool:
        """Whether the change is too small to be measured."""
        return self.change_m < JOINT_METER_M


def last_change(time: Floats, slip: Floats, gap_heel: Floats, gap_toe: Floats) -> LastChange:
    """Return what of slip and openings at either face varies most in the last second of a run, half of a shorter one.

    A part that turns opens and closes one of its faces, so that no motion of it is missed.
    """
    since = max(time[-1] - LAST_S, time[-1] / 2.0)
    moved = {"slip": slip, **dict(zip((item.label for item in OPENINGS), (gap_heel, gap_toe), strict=True))}
    changes = {name: float(np.ptp(values[time >= since])) for name, values in moved.items()}
    what = max(changes, key=lambda name: changes[name])
    return LastChange(float(time[-1] - since), what, changes[what])


def still_since(time: Floats, *moved: Floats) -> float:
    """Return the time after which each of these lengths changes by less than a joint meter shows [s]."""
    late = [
        np.maximum.accumulate(values[::-1]) - np.minimum.accumulate(values[::-1]) < JOINT_METER_M for values in moved
    ]
    # Backwards from the end, where there is one moment of rest at least.
    return float(time[-int(np.logical_and.reduce(late).sum())])


def last_of(response: ResponseData) -> LastChange:
    """Return what of an elastic dam moves most in the last second of its run."""
    return max((last_change(*history) for history in _moved(response)), key=lambda last: last.change_m)


def comes_to_rest(response: ResponseData) -> bool:
    """Whether the dam has stopped sliding and rocking when the run ends.

    A rigid block says so itself. An elastic dam is never quite still, and where its crack stays open in part it is not
    in the state of rest: it has stopped where its slip and its openings change by nothing measurable any more.
    """
    return last_of(response).rest if response.elastic else all(crack.final_mode == "rest" for crack in response.cracks)


def rests_from(response: ResponseData) -> float:
    """Return the time at which the dam comes to rest [s]; infinite where it still moves when the run ends."""
    if not comes_to_rest(response):
        return math.inf
    if response.elastic:
        return max(still_since(*history) for history in _moved(response))
    return max(float(max(crack.event_log.time_s, default=0.0)) for crack in response.cracks)


def motion_end(response: ResponseData) -> float:
    """Return when the ground motion of a run ends [s]; what goes on after its run has no part in it."""
    motions = [motion for motion in (response.motion, response.vertical, response.cross) if motion is not None]
    return min(response.end_time_s - response.silence_s, max(motion.duration for motion in motions))


def _moved(response: ResponseData) -> list[tuple[Floats, Floats, Floats, Floats]]:
    histories = [crack.histories for crack in response.cracks]
    return [(h.time_s, h.slip_m, h.gap_heel_m, h.gap_toe_m) for h in histories]
