"""Two rigid blocks, one on the other: where they stand, how they are run, what they did."""

from __future__ import annotations

from heeltoe.base.arrays import Floats
from heeltoe.kernel import _kernel
from heeltoe.kernel.block import USUAL, Limits
from heeltoe.kernel.shaking import Shaking

#: What a run returns.
StackRun = _kernel.StackRun
#: Names of the numbers of a place, in the order of the kernel.
PLACE = tuple(_kernel.PLACE_FIELDS)


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
    return _kernel.run_rigid_stack(*blocks, place, time, horizontal, up, moments, settle, most, jam)
