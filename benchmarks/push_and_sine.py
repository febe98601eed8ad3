"""The problem that rigid-body engines can solve too: a block under a constant push on a base that moves by a sine.

A block 4 m wide, 1 m high, 1 m deep, of 1000 kg, friction 0.3; the push is 0.15 of its weight, the base moves with
0.6 g at 2 Hz for 5 s. It slips both ways, mostly downstream, and slips still when time is up. All work in the frame of
the base: the ground enters as the force of inertia on the centre of mass.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from exact import slip_push_and_sine
from measure import NothingMeasured, Timing, repeat, require, seconds, timed, times
from problems import Floats, rectangle

from heeltoe.kernel.block import BlockRun, run_block
from heeltoe.kernel.shaking import Shaking

GRAVITY, WIDTH, HEIGHT, DEPTH, MASS, FRICTION = 9.81, 4.0, 1.0, 1.0, 1000.0, 0.3
PUSH, AMPLITUDE, FREQUENCY, DURATION = 0.15 * GRAVITY, 0.6 * GRAVITY, 2.0, 5.0
#: Moments at which all slips are compared; a lucky end is not accuracy.
INTERVAL = 0.1
MOMENTS = np.arange(1, round(DURATION / INTERVAL) + 1) * INTERVAL
#: Time steps of the engines, and ours to sample the sine with.
STEPS = (1e-2, 1e-3, 1e-4)
OUR_STEPS = (1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5)

EXACT = slip_push_and_sine(PUSH, AMPLITUDE, FREQUENCY, FRICTION * GRAVITY, MOMENTS)


@dataclass(frozen=True)
class Attempt:
    """One way to solve the problem: with what, how wrong [m], how long."""

    program: str
    settings: str
    step: float
    error: float
    timing: Timing


def force(step: float) -> Floats:
    """Force on the block along the base in the middle of every step, which serves engines best [N]."""
    middle = (np.arange(round(DURATION / step)) + 0.5) * step
    return MASS * (PUSH - AMPLITUDE * np.sin(2.0 * np.pi * FREQUENCY * middle))


def error(slip: Floats) -> float:
    """Largest deviation from the exact slip at the common moments [m].

    Raises
    ------
    NothingMeasured
        Where the block went nowhere.
    """
    require(slip.shape == EXACT.shape and bool(np.isfinite(slip).all()), "the slips are not there")
    require(slip[-1] > 0.1 * EXACT[-1], "the block did not slip")
    return float(np.abs(slip - EXACT).max())


def ours(step: float) -> Attempt:
    """Solve with the sine sampled every `step`; between the samples the kernel is exact for straight lines."""
    block = rectangle(WIDTH, HEIGHT, MASS / (WIDTH * HEIGHT), FRICTION, PUSH, GRAVITY)
    time = np.arange(round(DURATION / step) + 1) * step
    ground = AMPLITUDE * np.sin(2.0 * np.pi * FREQUENCY * time)

    def solve() -> BlockRun:
        return run_block(block, Shaking(time, ground), MOMENTS)

    run = solve()
    end = run.summary
    if end.slip_stops == 0 or abs(end.slip_sliding - end.slip) > 1e-12 * abs(end.slip):
        raise NothingMeasured("the block did not slide and stop")
    return Attempt("heeltoe", "sine sampled", step, error(run.histories.slip), repeat(solve))


def rows(our_attempts: list[Attempt], attempts: list[Attempt]) -> list[list[str]]:
    """Rows of the table: each attempt beside our quickest that is no less exact."""
    result = []
    for attempt in our_attempts + attempts:
        match = [a for a in our_attempts if a.error <= attempt.error]
        ratio = "no run of ours is as exact"
        if attempt.program == "heeltoe":
            ratio = ""
        elif match:
            quickest = min(match, key=lambda a: a.timing.median)
            longer = times(attempt.timing.median / quickest.timing.median)
            measured = f"{seconds(quickest.timing.median)} at {quickest.step:g} s, {1e3 * quickest.error:.2g} mm"
            ratio = f"{longer} ({measured})"
        result.append(
            [
                attempt.program,
                attempt.settings,
                f"{attempt.step:g} s",
                f"{1e3 * attempt.error:.2g} mm",
                f"{attempt.error / EXACT[-1]:.1e}",
                timed(attempt.timing),
                ratio,
            ]
        )
    return result
