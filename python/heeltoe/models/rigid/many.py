"""Many rigid runs side by side on all cores."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from time import monotonic

import numpy as np
from rich.console import Console
from rich.progress import Progress

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.kernel.block import CREST, MODES, OUTCOMES, SUMMARY, USUAL, Limits, run_blocks
from heeltoe.mechanics.block import Block
from heeltoe.mechanics.drains import close_by_slip
from heeltoe.models.rigid.rows import Rows, check_limits, rows_of
from heeltoe.models.rigid.tables import crest_looks, crest_of_run
from heeltoe.models.rigid.varying import varies
from heeltoe.models.rigid.walk import limits_of, walk
from heeltoe.models.runner import largest_rotation, rows_until_rest
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.crest import LOOKS_S, band_weights
from heeltoe.result.outcome import LARGEST_ROTATION, Outcome

# What ends blocks that run together, whether they are walked exactly, and whether rotations may be of any size.
_Kind = tuple[Limits, bool, bool]
_OK, _REST = OUTCOMES.index(Outcome.OK), MODES.index("rest")
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
        it is not given. Blocks that still move when their motion ends go on in silence.
    threads
        0 for all cores. The results are the same bits for any number.
    progress
        Show a bar on standard error once it lasts longer than a second.

    Returns
    -------
    dict
        (n,) arrays by name (:data:`heeltoe.kernel.block.SUMMARY`, SI); ``outcome`` counts
        :data:`heeltoe.kernel.block.OUTCOMES`, ``keeps_sliding`` is 1 of a block that does not slow down after its
        motion, ``final_mode`` counts :data:`heeltoe.kernel.block.MODES`. All-zero motion
        numbers go with the outcome "unstable".

    Raises
    ------
    InputError
        Naming field, row and value, where the numbers are those of no block, motions, factors or limits cannot be used,
        or lengths do not agree.
    """
    if isinstance(threads, bool) or not isinstance(threads, int) or threads < 0:
        raise InputError("out-of-range", "threads", threads, bound="of 0 for all cores, or more")
    rows = rows_of(blocks, motions, motion_of, scales)
    pairs = [motion if isinstance(motion, tuple) else (motion, None) for motion in motions]
    earthquakes = [Earthquake(across, up, across.duration) for across, up in pairs]
    with Progress(console=Console(stderr=True), transient=True, disable=not progress) as bar:
        task, began = bar.add_task("rigid runs", total=len(rows.numbers), visible=False), monotonic()

        def advance(done: int) -> None:
            bar.update(task, advance=done, visible=monotonic() - began > 1.0)

        return run_rows(rows, earthquakes, limits, threads, advance if progress else None)


def run_rows(
    rows: Rows,
    earthquakes: Sequence[Earthquake],
    limits: Limits | None = None,
    threads: int = 0,
    progress: Callable[[int], None] | None = None,
) -> dict[str, Floats]:
    """Run blocks that have been checked; what `rows.which` counts are `earthquakes`. `progress` gets the number of
    finished ones. Otherwise as :func:`rigid_many`; where the rows ask for the crest with :data:`CREST`, as single runs
    have it."""
    table = {name: np.zeros(len(rows.numbers)) for name in (*_names(rows), "keeps_sliding")}
    follow = any(earthquake.motion.parts for earthquake in earthquakes)
    across = any(earthquake.cross is not None for earthquake in earthquakes)
    most = _CHUNK if progress else len(rows.numbers)
    for part, kind in _parts(rows, limits, most, sequences=follow, across=across):
        run = _runner(rows, earthquakes, kind, threads)
        for some, columns in rows_until_rest(run, _reach(finite=kind[2]), part, kind[0].silence):
            for name, values in columns.items():
                table[name][some] = values
        if progress is not None:
            progress(part.size)
    return table


def _names(rows: Rows) -> tuple[str, ...]:
    return SUMMARY if rows.crest is None else (*SUMMARY, *CREST)


def _parts(
    rows: Rows, limits: Limits | None, most: int, *, sequences: bool, across: bool
) -> Iterator[tuple[Integers, _Kind]]:
    """Yield rows that go together, up to a number; in `sequences` of motions drains may close, and where the ground
    shakes `across` the valley each row runs by itself."""
    kinds: dict[_Kind, list[int]] = {}
    for row, block in enumerate(rows.blocks):
        exact = not across and not varies(block.case) and not (sequences and close_by_slip(block.case))
        finite = block.case.analysis.rotation == "finite"
        kinds.setdefault((limits or limits_of(block.case), exact, finite), []).append(row)
    together = {kind: np.array(alike) for kind, alike in kinds.items()}
    if not rows.blocks:
        together[limits or USUAL, True, False] = np.arange(len(rows.numbers))
    for kind, alike in together.items():
        check_limits(kind[0])
        for start in range(0, alike.size, max(most, 1)):
            yield alike[start : start + most], kind


def _runner(
    rows: Rows, earthquakes: Sequence[Earthquake], kind: _Kind, threads: int
) -> Callable[[Integers, float], dict[str, Floats]]:
    """Return what runs some of the rows with some silence after their motions."""
    limits, exact, _ = kind

    def run(some: Integers, silence: float) -> dict[str, Floats]:
        used, place = np.unique(rows.which[some], return_inverse=True)
        which = place.astype(np.int64)
        through = [earthquakes[motion].silent(silence) for motion in used.tolist()]
        if not exact:
            return _integrated(rows, some, which, through, limits, threads)
        crest = None
        if rows.crest is not None:
            looks = [crest_looks(shaken.shaking.time[-1]) for shaken in through]
            crest = (rows.crest[some], looks, band_weights(LOOKS_S))
        shakings = [shaken.shaking for shaken in through]
        return run_blocks(rows.numbers[some], shakings, which, rows.scales[some], limits, threads, crest)

    return run


def _reach(*, finite: bool) -> Callable[[dict[str, Floats]], Floats]:
    """Return what says of blocks whether they are at rest, see :func:`rows_until_rest`."""

    def reach(table: dict[str, Floats]) -> Floats:
        far = (largest_rotation(table) > LARGEST_ROTATION) & (not finite)
        moves = np.where(table["final_mode"] != _REST, np.inf, 0.0)
        return np.where((table["outcome"] == _OK) & ~far, moves, -np.inf)

    return reach


def _integrated(
    rows: Rows, part: Integers, which: Integers, earthquakes: Sequence[Earthquake], limits: Limits, threads: int
) -> dict[str, Floats]:
    """Run blocks of which something changes as they move, or between motions; the kernel leaves Python to others."""

    wanted = [None if rows.crest is None else crest_looks(ground.shaking.time[-1]) for ground in earthquakes]

    def run(place: int) -> list[float]:
        row, shaking, moments = part[place], earthquakes[which[place]].shaking, wanted[which[place]]
        block, (across, up) = rows.blocks[row], rows.scales[row]
        vertical = None if shaking.up is None else up * shaking.up
        cross = None if shaking.cross is None else across * shaking.cross
        shaken = replace(shaking, horizontal=across * shaking.horizontal, up=vertical, cross=cross)
        # No more than the place is wanted of any.
        whole = None if moments is None else np.zeros(moments.size, dtype=bool)
        walked = walk(block.case, block, shaken, moments, limits, whole)
        crest = () if moments is None else crest_of_run(block, shaken, walked)
        return [*walked.summary.by_name().values(), *crest]

    with ThreadPoolExecutor(threads or None) as pool:
        summaries = np.array(list(pool.map(run, range(part.size))))
    return dict(zip(_names(rows), summaries.T, strict=True))
