"""Types of the compiled kernels. SI units, per metre of dam."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

VERSION: Final[str]
PROFILE: Final[str]
BLOCK_FIELDS: Final[list[str]]
SUMMARY_FIELDS: Final[list[str]]
HISTORY_FIELDS: Final[list[str]]
EVENT_FIELDS: Final[list[str]]
MODES: Final[list[str]]
EVENT_KINDS: Final[list[str]]
OUTCOMES: Final[list[str]]

Floats = NDArray[np.float64]

def run_rigid(
    block: Floats,
    time: Floats,
    horizontal: Floats,
    vertical: Floats | None,
    output_times: Floats,
    start: Sequence[Sequence[float]] | None,
    settle: float,
    event_limit: int,
    jam: bool,
) -> tuple[Floats, Floats, NDArray[np.uint8], Floats]:
    """Run one block through one motion.

    Parameters
    ----------
    block
        (18,) numbers in the order of ``BLOCK_FIELDS``.
    time, horizontal, vertical
        (n,) moments in s, not decreasing, and ground accelerations in m/s2 (downstream, upward); linear between the
        moments, a repeated moment is a jump.
    output_times
        (k,) ascending moments at which the state is wanted; at an event the state after it.
    start
        (slip, heel gap, toe gap) in m and their velocities in m/s at the first moment. Without it the block stands
        still, and must be able to under its static loads.
    settle
        Bounces slower than ``settle * sqrt(g' B)`` end the bouncing, g' the effective weight per mass, B the width.
    event_limit
        Most events before the run stops with that outcome.
    jam
        Resolve a Painlevé paradox by a tangential impact instead of stopping there.

    Returns
    -------
    summary, histories, modes, events
        (len(SUMMARY_FIELDS),); (k', len(HISTORY_FIELDS)) and (k',), where k' < k if the run stopped early;
        (m, len(EVENT_FIELDS)).
    """

def run_rigid_many(
    blocks: Floats,
    motions: Sequence[tuple[Floats, Floats, Floats | None]],
    motion_of: NDArray[np.int64],
    scales: Floats,
    settle: float,
    event_limit: int,
    jam: bool,
    threads: int,
) -> Floats:
    """Run (n, 18) blocks, each through the motion ``motion_of`` names with the accelerations times ``scales`` (n, 2).

    ``threads`` of 0 means all cores. Returns (n, len(SUMMARY_FIELDS)), the same bits for any number of threads.
    """

def spectrum(time: Floats, ground: Floats, periods: Floats, damping: float) -> Floats:
    """Return (k, 2): largest relative displacement [m] and total acceleration [m/s2] of oscillators.

    ``periods`` (k,) in s, zero for the ground itself; ``damping`` in [0, 1). Exact for ground accelerations (n,) that
    are linear between the moments ``time`` (n,).
    """
