"""Newmark's block, which slides one way, under a record: time and error of ours and of others.

It is the same problem as a block of ours that never slides upstream. With friction mu, weight m g and a constant push P
downstream, slip starts downstream where the ground accelerates upstream beyond ``mu g - P / m``, and upstream beyond
``mu g + P / m``. While the block slides downstream its relative acceleration is that of the ground less
``mu g - P / m``: Newmark's law with the yield acceleration ``k_y g = mu g - P / m``. So k_y, and an upstream limit of
twice the record's peak, give mu and P. The block is so flat that it cannot rock. Our downstream slip answers ground
that accelerates upstream, that of the others the opposite, hence the sign.
"""

from __future__ import annotations

from functools import partial
from importlib import import_module
from typing import NamedTuple

import numpy as np
import peer_newmark
from exact import slip_one_way
from measure import Timing, repeat, require, seconds, table, timed, times
from problems import DURATION, LIMITS, STEP, Floats, G, rectangle, taft

from heeltoe import GroundMotion, rigid_many
from heeltoe.kernel.block import BlockRun, run_block
from heeltoe.kernel.shaking import Shaking

PEAK = 0.4 * G
YIELD = (0.05, 0.1, 0.2)
#: Steps of the others, and the blocks of an ensemble of theirs; the record is straight between its samples, so that the
#: problem stays the same.
STEPS = {1e-2: 2000, 1e-3: 200, 1e-4: 20}
#: Blocks of an ensemble of ours.
COUNT = 2000
COLUMNS = [
    "k_y",
    "slip",
    "program",
    "step",
    "largest error",
    "relative",
    "time per run",
    "in an ensemble",
    "times ours at no larger error",
    "in an ensemble, times ours",
]


class Tried(NamedTuple):
    """A program at a step: its largest error [m], the time of a call with the slip at every sample, and that of a block
    among many with its slip at the end [s]; None where it has no such call."""

    program: str
    step: float
    error: float
    alone: Timing
    together: float | None


def block(yield_g: float) -> Floats:
    """Return the numbers of our block that yields at so many g."""
    downstream, upstream = yield_g * G, 2.0 * PEAK
    friction, push = (upstream + downstream) / (2.0 * G), (upstream - downstream) / 2.0
    return rectangle(100.0, 1.0, 2400.0, friction, push)


def our_slip(motion: GroundMotion, yield_g: float) -> Floats:
    """Return our slip at every sample of a record [m]."""
    return run_block(block(yield_g), Shaking(motion.time, -motion.acceleration), motion.time).histories.slip


def ours(motion: GroundMotion, yield_g: float, exact: Floats) -> Tried:
    """Slide our block; every run is exact."""
    numbers, time, ground = block(yield_g), motion.time, -motion.acceleration

    def solve() -> BlockRun:
        return run_block(numbers, Shaking(time, ground), time)

    blocks, reverse = np.tile(numbers, (COUNT, 1)), [motion.reversed()]
    run = solve()
    end = run.summary
    sliding = abs(end.slip_sliding - end.slip) <= 1e-12 * end.slip
    require(end.slip_stops > 0 and end.slip_min == 0.0 and sliding, "no one-way slip")
    many = repeat(lambda: rigid_many(blocks, reverse, limits=LIMITS, threads=1))
    return Tried("heeltoe", STEP, _error(run.histories.slip, exact), repeat(solve), many.median / COUNT)


def newmark(motion: GroundMotion, yield_g: float, exact: Floats) -> list[Tried]:
    """Slide it by steps, as a user of C and of numba does."""
    tried = []
    for program in peer_newmark.programs()[0]:
        for step, count in STEPS.items():
            drive, ones = motion.resampled(step).acceleration, np.ones(count)
            down, up = yield_g * G, np.inf
            slip = program.one(drive, step, down, up)[:: round(STEP / step)]
            alone = repeat(partial(program.one, drive, step, down, up), 5)
            together = repeat(partial(program.many, drive, step, ones, down * ones, up * ones), 5)
            tried.append(Tried(program.name, step, _error(slip, exact), alone, together.median / count))
    return tried


def pyslammer(motion: GroundMotion, yield_g: float, exact: Floats) -> list[Tried]:
    """Slide it by pySLAMMER's rigid analysis."""
    peer = import_module("peer_pyslammer")
    tried = []
    for step in STEPS:
        record = peer.record(motion, step)
        slip = peer.slip(record, yield_g)[:: round(STEP / step)]
        alone = repeat(partial(peer.slip, record, yield_g), 5)
        tried.append(Tried("pySLAMMER", step, _error(slip, exact), alone, None))
    return tried


def _error(slip: Floats, exact: Floats) -> float:
    require(slip.size == exact.size and slip[-1] > 0.0, "the block did not slip")
    return float(np.abs(slip - exact).max())


def _row(tried: Tried, own: Tried, yield_g: float, slip: float) -> list[str]:
    ratios = ["", ""]
    if tried is not own:
        require(own.error <= tried.error, f"{tried.program} is more exact than ours")
        ratios[0] = times(tried.alone.median / own.alone.median)
        ratios[1] = "" if tried.together is None else times(tried.together / own.together)
    return [
        f"{yield_g:g}",
        f"{1e3 * slip:.2f} mm",
        tried.program,
        f"{tried.step:g} s",
        f"{1e3 * tried.error:.2g} mm",
        f"{tried.error / slip:.1e}",
        timed(tried.alone),
        "" if tried.together is None else seconds(tried.together),
        *ratios,
    ]


def report() -> str:
    """Measure and return Markdown."""
    motion, rows = taft().scaled_to(PEAK), []
    _, missing = peer_newmark.programs()
    for yield_g in YIELD:
        exact = slip_one_way(motion.acceleration, STEP, yield_g * G)
        own = ours(motion, yield_g, exact)
        tried = [own, *newmark(motion, yield_g, exact)]
        try:
            tried += pyslammer(motion, yield_g, exact)
        except ImportError as reason:
            missing.append(f"Not measured: pySLAMMER ({reason}).")
        rows += [_row(item, own, yield_g, exact[-1]) for item in tried]
    text = (
        f"One-way sliding under {motion.name} at {PEAK / G:g} g, {DURATION:g} s. Errors are the largest at any sample "
        "of the record, against the exact solution in wider numbers; relative to the slip in the end. A run is one "
        "call, with the slip at every sample; in an ensemble of blocks one call has the slip at the end of each, ours "
        "also its energies, its slip by modes and its events."
    )
    return "\n\n".join([text, table(COLUMNS, rows), *dict.fromkeys(missing)])
