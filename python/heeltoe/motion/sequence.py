"""One motion after the other: a mainshock and its aftershocks, with the ground at rest in between, as one motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.motion.ground_motion import GroundMotion, Part

#: Ground motions of one earthquake: horizontal, vertical and across the valley.
Components = tuple[GroundMotion, GroundMotion | None, GroundMotion | None]


@dataclass(frozen=True, eq=False)
class _Placed:
    motion: GroundMotion
    begins: float
    lasts: float


def joined(earthquakes: Sequence[Components], lengths: Sequence[float], pauses: Sequence[float]) -> Components:
    """Join motions, each straight between the moments that it had.

    Parameters
    ----------
    earthquakes
        In their order.
    lengths
        How long each lasts [s].
    pauses
        How long the ground stands still before each but the first [s].

    Returns
    -------
    horizontal, vertical, cross
        From the beginning of the first to the end of the last, each with its own `parts`; the others are None where no
        earthquake has any, and at rest through those that have none.
    """
    begins = [0.0]
    for lasts, pause in zip(lengths, pauses, strict=False):
        begins.append(begins[-1] + lasts + pause)
    end = begins[-1] + lengths[-1]

    def placed(component: int) -> list[_Placed]:
        places = zip((earthquake[component] for earthquake in earthquakes), begins, lengths, strict=True)
        return [_Placed(motion, begin, lasts) for motion, begin, lasts in places if motion is not None]

    horizontal, *others = (placed(component) for component in range(3))
    vertical, cross = (_whole(motions, end) if motions else None for motions in others)
    return _whole(horizontal, end), vertical, cross


def _whole(placed: Sequence[_Placed], end: float) -> GroundMotion:
    time, values = [np.zeros(1)], [np.zeros(1)]
    for placement in placed:
        moments, acceleration = _between_rests(placement.motion.cut(placement.lasts))
        time.append(placement.begins + moments)
        values.append(acceleration)
    if time[-1][-1] < end:
        time.append(np.array([end]))
        values.append(np.zeros(1))
    moments, acceleration = np.concatenate(time), np.concatenate(values)
    # What is at rest on both sides of a moment needs that moment once.
    twice = np.append(False, (np.diff(moments) == 0.0) & (np.diff(acceleration) == 0.0))
    first, *others = (placement.motion for placement in placed)
    name = f"{first.name} and {len(others)} aftershock{'s' if len(others) > 1 else ''}" if others else first.name
    warnings = tuple(dict.fromkeys(notice for placement in placed for notice in placement.motion.warnings))
    return GroundMotion(
        name,
        moments[~twice],
        acceleration[~twice],
        format="sequence",
        source="; ".join(placement.motion.source for placement in placed),
        warnings=warnings,
        parts=tuple(
            Part(
                placement.motion.name,
                placement.begins,
                placement.begins + placement.lasts,
                placement.motion.pga,
                placement.motion.processing,
            )
            for placement in placed
        ),
    )


def _between_rests(motion: GroundMotion) -> tuple[Floats, Floats]:
    """Return a motion that begins and ends at rest, by a jump where it does not do so by itself."""
    time, values = motion.time, motion.acceleration
    first, last = [0.0] if values[0] != 0.0 else [], [0.0] if values[-1] != 0.0 else []
    return (
        np.concatenate([time[:1] if first else [], time, time[-1:] if last else []]),
        np.concatenate([first, values, last]),
    )
