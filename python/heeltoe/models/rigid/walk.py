"""The way of a block from the case to the kernel: its ground motion, and which kernel walks it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.model import Case
from heeltoe.mechanics.block import Block
from heeltoe.models.rigid.varying import varies, varying
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground, on_same_moments

Floats = NDArray[np.float64]

#: Bounces slower than this times sqrt(g' B) end the bouncing, g' the effective weight per mass and B the width of the
#: crack: some 1e-6 m/s for a dam, whose further bounces would stay below 1e-13 m.
SETTLE = 1e-7


@dataclass(frozen=True, eq=False)
class GroundSeries:
    """The ground's motion on common moments, as the kernels take it: (n,) each, or None where there is none."""

    time: Floats
    horizontal: Floats
    up: Floats | None
    turning: Floats | None

    @classmethod
    def of(
        cls, motion: GroundMotion, vertical: GroundMotion | None, rotation: GroundMotion | None, end: float
    ) -> GroundSeries:
        """Put the motions on the same moments, from zero to `end`."""
        if rotation is None:
            return cls(*ground(motion, vertical, end), None)
        series = [motion, rotation] if vertical is None else [motion, rotation, vertical]
        time, horizontal, turning, *rest = on_same_moments(series, end)
        return cls(time, horizontal, rest[0] if rest else None, turning)

    def scaled(self, factor: float) -> GroundSeries:
        """Return the same motion, weaker or stronger."""
        up, turning = (None if each is None else factor * each for each in (self.up, self.turning))
        return GroundSeries(self.time, factor * self.horizontal, up, turning)


_Raw = tuple[Floats, Floats, NDArray[np.uint8], Floats, Floats]


def run_block(case: Case, block: Block, shaking: GroundSeries, moments: Floats) -> _Raw:
    """Run the kernel that the case needs; the last array is the largest tension of each anchor [N/m]."""
    jam = case.analysis.paradox == "tangential impact"
    limits = (SETTLE, case.analysis.event_limit, jam)
    if not varies(case) and shaking.turning is None:
        found = _kernel.run_rigid(
            block.parameters(), shaking.time, shaking.horizontal, shaking.up, moments, None, *limits
        )
        return *found, np.array([anchor.prestress for anchor in case.anchors])
    what = varying(case, block)
    return _kernel.run_rigid_varying(
        block.parameters(),
        what.numbers,
        what.rotation,
        what.rule,
        what.pressure,
        what.anchors,
        shaking.time,
        shaking.horizontal,
        shaking.up,
        shaking.turning,
        moments,
        None,
        *limits,
    )
