"""What shakes a dam in one run: its ground motions, and up to when."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

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
        Of the run [s]; where a record has ended the ground stands still.
    rotation
        About the middle of the crack, counter-clockwise [rad/s2]; None where there is none. Only blocks feel one.
    """

    motion: GroundMotion
    vertical: GroundMotion | None
    end: float
    rotation: GroundMotion | None = None

    @cached_property
    def shaking(self) -> Shaking:
        """The same on common moments, from zero to the end, as the kernels take it."""
        given = [each for each in (self.vertical, self.rotation) if each is not None]
        if not given and self.motion.duration == self.end:
            return Shaking(self.motion.time, self.motion.acceleration)
        time, horizontal, *others = on_same_moments([self.motion, *given], self.end)
        up = None if self.vertical is None else others.pop(0)
        return Shaking(time, horizontal, up, others[0] if others else None)
