"""Shaking of a dam in one run: its ground motions, up to when, and how long the ground stands still after them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.kernel.shaking import Shaking
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import on_same_moments


@dataclass(frozen=True, eq=False)
class Earthquake:
    """Ground motions of one run, for dams and blocks alike.

    Attributes
    ----------
    motion
        Downstream [m/s2].
    vertical
        Upward [m/s2]; None where there is none.
    end
        Of the shaking [s]; where a record has ended before, the ground stands still, and where it goes on, it is cut.
    rotation
        About the middle of the crack, counter-clockwise [rad/s2]; None where there is none. Only blocks feel one.
    silence
        How long the run goes on after that, the ground standing still [s].
    cross
        Across the valley, to the left bank [m/s2]; None where there is none. Only blocks feel one.
    drainage
        What the slip of a run has left of the drains of an elastic dam, see :class:`heeltoe.kernel.shaking.Shaking`.
    """

    motion: GroundMotion
    vertical: GroundMotion | None
    end: float
    rotation: GroundMotion | None = None
    silence: float = 0.0
    drainage: tuple[tuple[float, float, float], ...] = ()
    cross: GroundMotion | None = None

    @property
    def run_end(self) -> float:
        """End of the run [s]."""
        return self.end + self.silence

    def silent(self, seconds: float) -> Earthquake:
        """Return the same shaking followed by a silence [s]."""
        return self if seconds == self.silence else replace(self, silence=seconds)

    def reversed(self) -> Earthquake:
        """Return the same with the other sign of its horizontal motion, and of its rotation; that of the motion across
        the valley mirrors the motion that way and changes nothing else."""
        rotation = None if self.rotation is None else self.rotation.reversed()
        return replace(self, motion=self.motion.reversed(), rotation=rotation)

    def scaled(self, factor: float) -> Earthquake:
        """Return the same, weaker or stronger in all its directions."""
        if factor == 1.0:
            return self
        vertical, rotation, cross = (
            None if motion is None else motion.scaled(factor) for motion in (self.vertical, self.rotation, self.cross)
        )
        return replace(self, motion=self.motion.scaled(factor), vertical=vertical, rotation=rotation, cross=cross)

    @cached_property
    def shaking(self) -> Shaking:
        """The same on common moments, from zero to the end of the run, as the kernels take it."""
        components = [motion for motion in (self.vertical, self.rotation, self.cross) if motion is not None]
        if not components and self.motion.duration == self.end:
            time, horizontal, others = self.motion.time, self.motion.acceleration, []
        else:
            time, horizontal, *others = on_same_moments([self.motion, *components], self.end)
        before = None
        if self.silence:
            before = replace(self, silence=0.0).shaking
            time, (horizontal, *others) = _and_silence(time, [horizontal, *others], self.run_end)
        up = None if self.vertical is None else others.pop(0)
        turning = None if self.rotation is None else others.pop(0)
        cross = None if self.cross is None else others.pop(0)
        begins = tuple(part.begins for part in self.motion.parts[1:] if part.begins < self.end)
        return Shaking(time, horizontal, up, turning, cross, begins=begins, drainage=self.drainage, before=before)


def _and_silence(time: Floats, series: list[Floats], end: float) -> tuple[Floats, list[Floats]]:
    """Return moments and accelerations with zeros up to `end` after them; where a motion ends with another value, it
    jumps."""
    if time.size > 1 and time[-1] == time[-2]:
        # It jumps there already, to what is cut off.
        time, series = time[:-1], [values[:-1] for values in series]
    after = [end] if all(values[-1] == 0.0 for values in series) else [time[-1], end]
    return np.append(time, after), [np.append(values, np.zeros(len(after))) for values in series]
