"""pySLAMMER's rigid analysis beside ours: Newmark's block, which slides one way, on a record.

The two are the same problem for a block of ours that never slides upstream. With friction mu, weight m g and a constant
push P downstream, slip starts downstream where the ground accelerates upstream beyond ``mu g - P / m``, and upstream
beyond ``mu g + P / m``. While the block slides downstream its relative acceleration is that of the ground less
``mu g - P / m``: Newmark's law with the yield acceleration ``k_y g = mu g - P / m``. So k_y, and an upstream limit of
twice the record's peak, give mu and P. The block is so flat that it cannot rock. Our downstream slip answers ground
that accelerates upstream, pySLAMMER's the opposite, hence the sign.
"""

from __future__ import annotations

import numpy as np
import pyslammer
from exact import slip_one_way
from measure import repeat, require, seconds, table, timed
from problems import DURATION, LIMITS, STEP, Floats, G, rectangle, taft

from heeltoe import GroundMotion, rigid_many
from heeltoe.kernel.block import BlockRun, run_block
from heeltoe.kernel.shaking import Shaking

PEAK = 0.4 * G
YIELD = (0.05, 0.1, 0.2)
#: Steps that pySLAMMER is given; the record is straight between its samples, so that the problem stays the same.
STEPS = (1e-2, 1e-3, 1e-4)
#: Runs of ours in the ensemble.
COUNT = 2000


def _block(yield_g: float) -> Floats:
    downstream, upstream = yield_g * G, 2.0 * PEAK
    friction, push = (upstream + downstream) / (2.0 * G), (upstream - downstream) / 2.0
    return rectangle(100.0, 1.0, 2400.0, friction, push)


def our_slip(motion: GroundMotion, yield_g: float) -> Floats:
    """Return our slip at every sample of a record [m]."""
    return run_block(_block(yield_g), Shaking(motion.time, -motion.acceleration), motion.time).histories.slip


def _ours(motion: GroundMotion, yield_g: float, exact: Floats) -> tuple[list[list[str]], float, float]:
    """Rows of the table, and the time of one call and of one run in an ensemble [s]."""
    block, time, ground = _block(yield_g), motion.time, -motion.acceleration

    def solve() -> BlockRun:
        return run_block(block, Shaking(time, ground), time)

    blocks = np.tile(block, (COUNT, 1))
    reverse = [motion.reversed()]
    run = solve()
    end = run.summary
    require(end.slip_stops > 0 and end.slip_min == 0.0 and end.slip_sliding == end.slip, "no one-way slip")
    wrong = float(np.abs(run.histories.slip - exact).max())
    alone = repeat(solve)
    many = repeat(lambda: rigid_many(blocks, reverse, limits=LIMITS, threads=1))
    start = [f"{yield_g:g}", f"{1e3 * exact[-1]:.2f} mm", "heeltoe", f"{STEP:g} s", f"{1e3 * wrong:.1g} mm"]
    share = f"{wrong / exact[-1]:.0e}"
    together = f"{seconds(many.median / COUNT)} ({many.spread:.0%})"
    return (
        [
            [*start, share, f"{timed(alone)} one call with history", ""],
            [*start, share, f"{together} in an ensemble", ""],
        ],
        alone.median,
        many.median / COUNT,
    )


def _theirs(motion: GroundMotion, yield_g: float, step: float, exact: Floats, alone: float, many: float) -> list[str]:
    fine = motion.resampled(step)
    record = pyslammer.GroundMotion(fine.acceleration / G, step)
    slip = pyslammer.RigidAnalysis(yield_g, record).sliding_disp[:: round(STEP / step)]
    require(slip.size == exact.size and slip[-1] > 0.0, "pySLAMMER's block did not slip")
    wrong = float(np.abs(slip - exact).max())
    timing = repeat(lambda: pyslammer.RigidAnalysis(yield_g, record), 5)
    return [
        f"{yield_g:g}",
        f"{1e3 * exact[-1]:.2f} mm",
        "pySLAMMER",
        f"{step:g} s",
        f"{1e3 * wrong:.2g} mm",
        f"{wrong / exact[-1]:.1e}",
        timed(timing),
        f"{timing.median / alone:,.0f} (one call), {timing.median / many:,.0f} (ensemble)",
    ]


def report() -> str:
    """Measure and return Markdown."""
    require(pyslammer.constants.G_EARTH == G, "pySLAMMER has another g")
    motion = taft().scaled_to(PEAK)
    rows = []
    for yield_g in YIELD:
        exact = slip_one_way(motion.acceleration, STEP, yield_g * G)
        own, alone, many = _ours(motion, yield_g, exact)
        rows += own
        rows += [_theirs(motion, yield_g, step, exact, alone, many) for step in STEPS]
    columns = ["k_y", "slip", "program", "step", "largest error", "relative", "time per run", "times ours"]
    return (
        f"One-way sliding under {motion.name} at {PEAK / G:g} g, {DURATION:g} s. Errors are the largest at any "
        "sample of the record, against the exact solution in wider numbers; relative to the slip in the end.\n\n"
        + table(columns, rows)
    )
