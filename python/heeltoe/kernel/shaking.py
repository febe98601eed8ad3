"""The ground's motion as kernels take it, and oscillators shaken by it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.kernel import _kernel


@dataclass(frozen=True, eq=False)
class Shaking:
    """The ground's motion for a kernel: (n,) each, or None without it.

    Attributes
    ----------
    time
        Moments from zero to the end of the run [s], not decreasing; at a jump the moment is there twice.
    horizontal, up
        Accelerations downstream and upward [m/s2], straight between the moments.
    turning
        Rotational acceleration about the middle of the crack, counter-clockwise [rad/s2].
    cross
        Acceleration across the valley, to the left bank [m/s2].
    begins
        When the motions of a sequence but the first begin [s].
    drainage
        Between which moments the drainage changes [s], and how much of it is left then; what an elastic dam is told.
    before
        The same without the silence at its end; None where there is none.
    """

    time: Floats
    horizontal: Floats
    up: Floats | None = None
    turning: Floats | None = None
    cross: Floats | None = None
    begins: tuple[float, ...] = ()
    drainage: tuple[tuple[float, float, float], ...] = ()
    before: Shaking | None = None

    @property
    def end(self) -> float:
        """Duration of the run [s]."""
        return float(self.time[-1])

    def along_stream(self) -> Shaking:
        """Return the same motion without that across the valley."""
        return replace(self, cross=None, before=None if self.before is None else self.before.along_stream())

    def scaled(self, factor: float) -> Shaking:
        """Return the same motion, weaker or stronger."""
        up, turning, cross = (
            None if component is None else factor * component for component in (self.up, self.turning, self.cross)
        )
        before = None if self.before is None else self.before.scaled(factor)
        horizontal = factor * self.horizontal
        return replace(self, horizontal=horizontal, up=up, turning=turning, cross=cross, before=before)


def peak_responses(time: Floats, ground: Floats, periods: Floats, damping: float) -> tuple[Floats, Floats]:
    """Return largest relative displacement [m] and total acceleration [m/s2] of oscillators, (k,) each.

    `periods` (k,) in s, zero for the ground itself; `damping` in [0, 1). Exact for ground accelerations (n,) that are
    linear between the moments `time` (n,).
    """
    displacement, total = np.ascontiguousarray(_kernel.spectrum(time, ground, periods, damping).T)
    return displacement, total
