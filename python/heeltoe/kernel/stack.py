"""Two rigid blocks, one on the other: where they stand, how they are run, what they did."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heeltoe import _kernel
from heeltoe.arrays import Floats
from heeltoe.kernel.block import USUAL, BlockRun, Limits
from heeltoe.kernel.shaking import Shaking

#: Names of the numbers of a place, in the order of the kernel.
PLACE = tuple(_kernel.PLACE_FIELDS)


@dataclass(frozen=True, eq=False)
class StackRun:
    """What two blocks did.

    Attributes
    ----------
    cracks
        At the lower and at the upper crack, where the upper block moves relative to the lower one; energies are
        those of both together.
    tilts
        (2, 2) least and largest rotation of the lower and of the upper block from the ground [rad].
    lost
        (2, 2) lost to friction and to impacts in the lower and in the upper crack [J/m].
    """

    cracks: tuple[BlockRun, BlockRun]
    tilts: Floats
    lost: Floats


def run_stack(
    blocks: tuple[Floats, Floats], place: Floats, shaking: Shaking, moments: Floats, limits: Limits = USUAL
) -> StackRun:
    """Run two blocks, exactly from event to event.

    Parameters
    ----------
    blocks
        (21,) numbers in the order of :data:`heeltoe.kernel.block.BLOCK`: all above the lower crack as one block, and
        what is above the upper one.
    place
        (3,) numbers in the order of :data:`PLACE`.
    shaking, moments, limits
        As of :func:`heeltoe.kernel.block.run_block`.
    """
    time, horizontal, up = shaking.time, shaking.horizontal, shaking.up
    settle, most, jam = limits.settle, limits.event_limit, limits.jam
    below, above, tilts, lost = _kernel.run_rigid_stack(
        *blocks, place, time, horizontal, up, moments, settle, most, jam
    )
    return StackRun((BlockRun.of(*below), BlockRun.of(*above)), np.asarray(tilts), np.asarray(lost))
