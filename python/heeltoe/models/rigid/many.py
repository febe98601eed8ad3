"""Many rigid runs side by side on all cores."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from time import monotonic

import numpy as np
from rich.console import Console
from rich.progress import Progress

from heeltoe.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.kernel.block import SUMMARY, USUAL, Limits, run_block, run_blocks
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block
from heeltoe.models.rigid.rows import Rows, check_limits, rows_of
from heeltoe.models.rigid.varying import varies, varying
from heeltoe.models.rigid.walk import limits_of
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion

# Large enough to keep all cores busy, small enough for a progress bar to move.
_CHUNK = 4096


def rigid_many(
    blocks: Sequence[Block | Case] | Floats,
    motions: Sequence[GroundMotion | tuple[GroundMotion, GroundMotion]],
    *,
    motion_of: Sequence[int] | Integers | None = None,
    scales: Sequence[float] | Floats | None = None,
    limits: Limits | None = None,
    threads: int = 0,
    progress: bool = False,
) -> dict[str, Floats]:
    """Run the rigid model on many blocks; a run that cannot continue is a value, never an exception.

    Parameters
    ----------
    blocks
        Blocks or cases, run as their case asks: exactly, or by integration where rotation, uplift or anchors change
        something as they move; or numbers in the order of :data:`heeltoe.kernel.block.BLOCK`, shape (n, 21), of blocks
        of which nothing changes.
    motions
        Ground motions, each horizontal or a pair (horizontal, vertical) [m/s2].
    motion_of
        (n,) which motion each block meets; the first where it is not given.
    scales
        (n,) factor on both directions of the motion, or (n, 2) one each; 1 where it is not given.
    limits
        What ends bouncing and runs, see :class:`heeltoe.kernel.block.Limits`; what the cases say, or the usual, where
        it is not given.
    threads
        0 for all cores. The results are the same bits for any number.
    progress
        Show a bar on standard error once it lasts longer than a second.

    Returns
    -------
    dict
        (n,) arrays by name (:data:`heeltoe.kernel.block.SUMMARY`, SI); ``outcome`` counts
        :data:`heeltoe.kernel.block.OUTCOMES`, ``final_mode`` counts :data:`heeltoe.kernel.block.MODES`. All-zero motion
        numbers go with the outcome "unstable".

    Raises
    ------
    InputError
        Naming field, row and value, where the numbers are those of no block, motions, factors or limits cannot be used,
        or lengths do not agree.
    """
    rows = rows_of(blocks, motions, motion_of, scales)
    pairs = [motion if isinstance(motion, tuple) else (motion, None) for motion in motions]
    shakings = [Earthquake(across, up, across.duration).shaking for across, up in pairs]
    table = {name: np.zeros(len(rows.numbers)) for name in SUMMARY}
    with Progress(console=Console(stderr=True), transient=True, disable=not progress) as bar:
        task, began = bar.add_task("rigid runs", total=len(rows.numbers), visible=False), monotonic()
        for part, given, exact in _parts(rows, limits, _CHUNK if progress else len(rows.numbers)):
            if exact:
                which, scale = rows.which[part], rows.scales[part]
                found = run_blocks(rows.numbers[part], shakings, which, scale, given, threads)
            else:
                found = _integrated(rows, part, shakings, given, threads)
            for name, values in found.items():
                table[name][part] = values
            bar.update(task, advance=part.size, visible=monotonic() - began > 1.0)
    return table


def _parts(rows: Rows, limits: Limits | None, most: int) -> Iterator[tuple[Integers, Limits, bool]]:
    """Yield rows that go together, up to so many, with what ends them and whether they are walked exactly."""
    kinds: dict[tuple[Limits, bool], list[int]] = {}
    for row, block in enumerate(rows.blocks):
        kinds.setdefault((limits or limits_of(block.case), not varies(block.case)), []).append(row)
    together = {kind: np.array(alike) for kind, alike in kinds.items()}
    if not rows.blocks:
        together[limits or USUAL, True] = np.arange(len(rows.numbers))
    for (given, exact), alike in together.items():
        check_limits(given)
        for start in range(0, alike.size, max(most, 1)):
            yield alike[start : start + most], given, exact


def _integrated(
    rows: Rows, part: Integers, shakings: Sequence[Shaking], limits: Limits, threads: int
) -> dict[str, Floats]:
    """Run blocks of which something changes as they move; the kernel leaves Python to the others meanwhile."""

    def run(row: int) -> list[float]:
        block, shaking, (across, up) = rows.blocks[row], shakings[rows.which[row]], rows.scales[row]
        vertical = None if shaking.up is None else up * shaking.up
        shaken = Shaking(shaking.time, across * shaking.horizontal, vertical)
        what = varying(block.case, block)
        return list(run_block(rows.numbers[row], shaken, np.empty(0), limits, varying=what).summary.values())

    with ThreadPoolExecutor(threads or None) as pool:
        summaries = np.array(list(pool.map(run, part.tolist())))
    return dict(zip(SUMMARY, summaries.T, strict=True))
