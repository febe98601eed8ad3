"""Many rigid runs side by side on all cores."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import monotonic

import numpy as np
from rich.console import Console
from rich.progress import Progress

from heeltoe.arrays import Floats, Integers
from heeltoe.kernel.block import BLOCK, USUAL, Limits, run_blocks
from heeltoe.mechanics.block import Block
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion

# Large enough to keep all cores busy, small enough for a progress bar to move.
_CHUNK = 4096


def rigid_many(
    blocks: Sequence[Block] | Floats,
    motions: Sequence[GroundMotion | tuple[GroundMotion, GroundMotion]],
    *,
    motion_of: Sequence[int] | Integers | None = None,
    scales: Sequence[float] | Floats | None = None,
    limits: Limits = USUAL,
    threads: int = 0,
    progress: bool = False,
) -> dict[str, Floats]:
    """Run the rigid model on many blocks; a run that cannot continue is a value, never an exception.

    Parameters
    ----------
    blocks
        Blocks, or their parameters in the order of :data:`heeltoe.kernel.BLOCK`, shape (n, 21).
    motions
        Ground motions, each horizontal or a pair (horizontal, vertical) [m/s2].
    motion_of
        (n,) which motion each block meets; the first where it is not given.
    scales
        (n,) factor on both directions of the motion, or (n, 2) one each; 1 where it is not given.
    limits
        What ends bouncing and runs, see :class:`heeltoe.kernel.Limits`.
    threads
        0 for all cores. The results are the same bits for any number.
    progress
        Show a bar on standard error once it lasts longer than a second.

    Returns
    -------
    dict
        (n,) arrays by name (:data:`heeltoe.kernel.SUMMARY`, SI); ``outcome`` counts :data:`heeltoe.kernel.OUTCOMES`,
        ``final_mode`` counts :data:`heeltoe.kernel.MODES`. All-zero motion numbers go with the outcome "unstable".

    Raises
    ------
    ValueError
        Where the lengths do not agree.
    """
    parameters = (
        np.ascontiguousarray(blocks, dtype=np.float64)
        if isinstance(blocks, np.ndarray)
        else np.array([block.parameters() for block in blocks]).reshape(-1, len(BLOCK))
    )
    n = len(parameters)
    which = np.zeros(n, dtype=np.int64) if motion_of is None else np.asarray(motion_of, dtype=np.int64)
    factors = np.ones((n, 2)) if scales is None else np.asarray(scales, dtype=np.float64)
    if factors.ndim == 1:
        factors = np.column_stack([factors, factors])
    factors = np.ascontiguousarray(factors)
    pairs = [motion if isinstance(motion, tuple) else (motion, None) for motion in motions]
    shakings = [Earthquake(across, up, across.duration).shaking for across, up in pairs]

    def run(part: slice) -> dict[str, Floats]:
        return run_blocks(parameters[part], shakings, which[part], factors[part], limits, threads)

    return _in_parts(run, n) if progress else run(slice(None))


def _in_parts(run: Callable[[slice], dict[str, Floats]], n: int) -> dict[str, Floats]:
    """Run part by part, with a bar on standard error."""
    parts = []
    began = monotonic()
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("rigid runs", total=n, visible=False)
        for start in range(0, max(n, 1), _CHUNK):
            part = slice(start, min(n, start + _CHUNK))
            parts.append(run(part))
            bar.update(task, completed=part.stop, visible=monotonic() - began > 1.0)
    return {name: np.concatenate([each[name] for each in parts]) for name in parts[0]}
