"""Many rigid runs side by side on all cores."""

from __future__ import annotations

from collections.abc import Sequence
from time import monotonic

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import Progress

from heeltoe import _kernel
from heeltoe.mechanics.block import Block
from heeltoe.models.rigid.walk import SETTLE
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground

Floats = NDArray[np.float64]

# Large enough to keep all cores busy, small enough for a progress bar to move.
_CHUNK = 4096


def rigid_many(
    blocks: Sequence[Block] | Floats,
    motions: Sequence[GroundMotion | tuple[GroundMotion, GroundMotion]],
    *,
    motion_of: Sequence[int] | NDArray[np.int64] | None = None,
    scales: Sequence[float] | Floats | None = None,
    event_limit: int = 1_000_000,
    jam: bool = False,
    threads: int = 0,
    progress: bool = False,
) -> dict[str, NDArray[np.float64]]:
    """Run the rigid model on many blocks; a run that cannot continue is a value, never an exception.

    Parameters
    ----------
    blocks
        Blocks, or their parameters in the order of ``_kernel.BLOCK_FIELDS``, shape (n, 21).
    motions
        Ground motions, each horizontal or a pair (horizontal, vertical) [m/s2].
    motion_of
        (n,) which motion each block meets; the first where it is not given.
    scales
        (n,) factor on both directions of the motion, or (n, 2) one each; 1 where it is not given.
    event_limit
        Most events of one run.
    jam
        Resolve a Painlevé paradox by a tangential impact instead of stopping that run.
    threads
        0 for all cores. The results are the same bits for any number.
    progress
        Show a bar on standard error once it lasts longer than a second.

    Returns
    -------
    dict
        (n,) arrays by name (``_kernel.SUMMARY_FIELDS``, SI); ``outcome`` counts ``_kernel.OUTCOMES``,
        ``final_mode`` counts ``_kernel.MODES``. All-zero motion numbers go with the outcome "unstable".

    Raises
    ------
    ValueError
        Where the lengths do not agree.
    """
    parameters = (
        np.ascontiguousarray(blocks, dtype=np.float64)
        if isinstance(blocks, np.ndarray)
        else np.array([block.parameters() for block in blocks]).reshape(-1, len(_kernel.BLOCK_FIELDS))
    )
    n = len(parameters)
    which = np.zeros(n, dtype=np.int64) if motion_of is None else np.asarray(motion_of, dtype=np.int64)
    factors = np.ones((n, 2)) if scales is None else np.asarray(scales, dtype=np.float64)
    if factors.ndim == 1:
        factors = np.column_stack([factors, factors])
    factors = np.ascontiguousarray(factors)
    series = []
    for motion in motions:
        pair = motion if isinstance(motion, tuple) else (motion, None)
        series.append(ground(pair[0], pair[1], pair[0].duration))

    def run(part: slice) -> Floats:
        return _kernel.run_rigid_many(
            parameters[part], series, which[part], factors[part], SETTLE, event_limit, jam, threads
        )

    if not progress:
        table = run(slice(None))
    else:
        table = np.empty((n, len(_kernel.SUMMARY_FIELDS)))
        began = monotonic()
        with Progress(console=Console(stderr=True), transient=True) as bar:
            task = bar.add_task("rigid runs", total=n, visible=False)
            for start in range(0, n, _CHUNK):
                part = slice(start, min(n, start + _CHUNK))
                table[part] = run(part)
                bar.update(task, completed=part.stop, visible=monotonic() - began > 1.0)
    return {name: np.ascontiguousarray(table[:, k]) for k, name in enumerate(_kernel.SUMMARY_FIELDS)}
