"""Rotations of any size: the walk by integration beside SciPy's integrator, both of order 8 and with located impacts.

The block is Housner's, 1 m wide and 4 m high, which does not slide and whose impacts take what Housner says:

    I θ" = -sign(θ) W R sin(α - |θ|) - W R cos(α - |θ|) a / g,    θ' after = (1 - 3/2 sin² α) θ' before
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from measure import heading, repeat, require, table, timed
from numpy.typing import NDArray
from scipy.integrate import quad, solve_ivp

from heeltoe import Case, read_case, read_record
from heeltoe.kernel.block import BlockRun, Varying, run_block
from heeltoe.kernel.build import PROFILE
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.rigid.varying import varying
from heeltoe.models.rigid.walk import walk
from heeltoe.models.run import earthquake
from heeltoe.motion.records.catalog import find

Floats = NDArray[np.float64]
Solve = Callable[[], tuple[float, ...]]

EXAMPLES = Path(__file__).parent.parent / "examples"
GRAVITY = 9.81
WIDTH, HEIGHT = 1.0, 4.0
SLENDERNESS = math.atan2(WIDTH, HEIGHT)
RATE_SQUARED = 0.75 * GRAVITY / (0.5 * math.hypot(WIDTH, HEIGHT))
KEPT = 1.0 - 1.5 * math.sin(SLENDERNESS) ** 2
FREE_END, RECORD_END = 4.4, 30.0
# It stands this one with many impacts in between.
PEAK = 0.6 * GRAVITY
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


def block_case() -> Case:
    """Return the block as a case."""
    corners = [[0.0, 0.0], [WIDTH, 0.0], [WIDTH, HEIGHT], [0.0, HEIGHT]]
    return read_case(
        {
            "gravity": f"{GRAVITY} m/s^2",
            "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
            "crack": {"friction": 10.0, "restitution": 0.0},
            "analysis": {"rotation": "finite"},
        }
    )


def exact_impacts() -> tuple[float, ...]:
    """Return the moments of the first impacts after the block is let go at half its slenderness, from its energy.

    With cos(α - θ) - cos(α - θ0) = 2 sin(α - (θ + θ0) / 2) sin((θ - θ0) / -2) the quarter of a swing from θ0 is an
    integral whose end, where the block is at rest, goes away with θ = θ0 - s².
    """

    def quarter(start: float) -> float:
        def slowness(s: float) -> float:
            fallen = s * s
            sine = math.sin(fallen / 2.0) / fallen if fallen else 0.5
            return 1.0 / math.sqrt(RATE_SQUARED * math.sin(SLENDERNESS - start + fallen / 2.0) * sine)

        return float(quad(slowness, 0.0, math.sqrt(start), epsabs=1e-14, epsrel=1e-13)[0])

    moments, amplitude, now = [], 0.5 * SLENDERNESS, 0.0
    while True:
        now += quarter(amplitude)
        if now > FREE_END:
            return tuple(moments)
        moments.append(now)
        left = KEPT**2 * (math.cos(SLENDERNESS - amplitude) - math.cos(SLENDERNESS))
        amplitude = SLENDERNESS - math.acos(math.cos(SLENDERNESS) + left)
        now += quarter(amplitude)


def scipy_impacts(tolerance: float) -> tuple[float, ...]:
    """Return the moments of impact by SciPy."""
    now, state, moments = 0.0, np.array([0.5 * SLENDERNESS, 0.0]), []
    while True:
        result = _swing((0.0, 0.0, 0.0), now, FREE_END, state, tolerance)
        if result.status != 1:
            return tuple(moments)
        now, state = _struck(result)
        moments.append(now)


def scipy_peak(time: Floats, ground: Floats, tolerance: float) -> tuple[float, ...]:
    """Return the largest rotation [rad] by SciPy, sample by sample, as the motion has a corner at each of them."""
    state, largest = np.zeros(2), 0.0
    for start, end, first, last in zip(time[:-1], time[1:], ground[:-1], ground[1:], strict=True):
        slope = (last - first) / (end - start)
        now = float(start)
        while now < end:
            value = first + slope * (now - start)
            if not state.any():
                if max(abs(value), abs(last)) <= GRAVITY * math.tan(SLENDERNESS):
                    break
                # At rest until the ground pushes enough.
                need = math.copysign(GRAVITY * math.tan(SLENDERNESS), last if abs(last) > abs(value) else value)
                now = max(now, float(start + (need - first) / slope)) if abs(value) <= abs(need) else now
                state = np.array([-math.copysign(1e-14, need), 0.0])
            result = _swing((float(first), float(slope), float(start)), now, float(end), state, tolerance)
            largest = max([largest, *(abs(float(y[0])) for y in result.y_events[1])])
            if result.status != 1:
                state = result.y[:, -1]
                break
            now, state = _struck(result)
            if abs(state[1]) < 1e-9:
                state = np.zeros(2)
    return (largest,)


def _swing(ground: tuple[float, float, float], start: float, end: float, state: Floats, tolerance: float) -> Any:
    """Integrate until the block strikes; `ground` is the acceleration at a moment, how it grows, and that moment."""
    side = math.copysign(1.0, state[0] if state[0] else state[1])
    radius_share = RATE_SQUARED / GRAVITY

    def rates(t: float, y: Floats) -> tuple[float, float]:
        lever = SLENDERNESS - side * y[0]
        pull = side * GRAVITY * math.sin(lever) + (ground[0] + ground[1] * (t - ground[2])) * math.cos(lever)
        return y[1], -radius_share * pull

    def closed(t: float, y: Floats) -> float:
        return float(side * y[0])

    def turns(t: float, y: Floats) -> float:
        return float(y[1])

    closed.terminal, closed.direction = True, -1.0  # type: ignore[attr-defined]
    near = 1e-2 * tolerance * SLENDERNESS
    return solve_ivp(rates, (start, end), state, "DOP853", events=(closed, turns), rtol=tolerance, atol=near)


def _struck(found: Any) -> tuple[float, Floats]:
    speed = KEPT * float(found.y_events[0][0][1])
    return float(found.t_events[0][0]), np.array([math.copysign(1e-300, speed), speed])


def ours_impacts(block: Block, what: Varying) -> tuple[float, ...]:
    """Return the moments of impact by the kernel."""
    lifted = [[0.0, 0.0, WIDTH * math.sin(0.5 * SLENDERNESS)], [0.0, 0.0, 0.0]]
    shaking = Shaking(np.array([0.0, FREE_END]), np.zeros(2))
    run = run_block(block.parameters(), shaking, np.empty(0), start=lifted, varying=what)
    return tuple(run.times_of("heel strikes", "toe strikes"))


def ours_peak(case: Case, block: Block, time: Floats, ground: Floats) -> tuple[float, ...]:
    """Return the largest rotation [rad] by the kernel."""
    run = walk(case, block, Shaking(time, ground))
    summary = run.summary
    require(run.outcome == "ok", "the block did not stand")
    require(summary.impacts > 10, "the block hardly rocked")
    return (math.asin(max(summary.largest_gap_heel, summary.largest_gap_toe) / WIDTH),)


def rows(reference: tuple[float, ...], ours: Solve, theirs: Callable[[float], tuple[float, ...]]) -> list[list[str]]:
    """Measure one problem: ours once, SciPy at every tolerance."""

    def error(found: tuple[float, ...]) -> float:
        require(len(found) == len(reference), "another number of impacts")
        return max(abs(a / b - 1.0) for a, b in zip(found, reference, strict=True))

    mine = repeat(ours)
    lines = [["heeltoe", "1e-12", f"{error(ours()):.1e}", timed(mine), ""]]
    for tolerance in TOLERANCES:
        time = repeat(lambda tolerance=tolerance: theirs(tolerance), 3)  # type: ignore[misc]
        ratio = f"{time.median / mine.median:,.0f}"
        lines.append(["SciPy DOP853", f"{tolerance:.0e}", f"{error(theirs(tolerance)):.1e}", timed(time), ratio])
    return lines


def walks() -> list[list[str]]:
    """Measure dams by the exact walk, and by the integrated one that rotations of any size need."""
    lines = []
    for name in ("typical-base", "triangular", "koyna-top"):
        times, slips = [], []
        for rotation in ("small", "finite"):
            case = read_case(EXAMPLES / f"{name}.toml", [f"analysis.rotation={rotation}"])
            block, shaking = build_block(case), earthquake(case).shaking

            def run(case: Case = case, block: Block = block, shaking: Shaking = shaking) -> BlockRun:
                return walk(case, block, shaking)

            slips.append(run().summary.slip)
            times.append(repeat(run))
        require(slips[0] > 1e-3, "the dam did not slide")
        ratio = f"{times[1].median / times[0].median:.0f}"
        lines.append([name, *(timed(time) for time in times), ratio, *(f"{1e3 * slip:.3f} mm" for slip in slips)])
    return lines


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    case = block_case()
    block = build_block(case)
    what = varying(case, block)
    record = read_record(find("elcentro-1940-180-nga", Path.cwd())).cut(RECORD_END)
    time, ground = record.time, record.acceleration * (PEAK / np.abs(record.acceleration).max())
    columns = ["program", "tolerance", "largest relative error", "time per run", "times ours"]
    finest = scipy_peak(time, ground, 1e-13)
    parts = [
        heading("Rotations of any size", ["heeltoe", "scipy", "numpy"]),
        f"Block of {WIDTH:g} m by {HEIGHT:g} m let go at half its slenderness, {FREE_END:g} s. Errors are those of the "
        "moments of impact, against an integral of its energy.",
        table(columns, rows(exact_impacts(), lambda: ours_impacts(block, what), scipy_impacts)),
        f"The same block through {RECORD_END:g} s of El Centro 1940 at {PEAK / GRAVITY:g} g. Errors are those of the "
        "largest rotation, against SciPy with a tolerance of 1e-13.",
        table(
            columns,
            rows(finest, lambda: ours_peak(case, block, time, ground), lambda rough: scipy_peak(time, ground, rough)),
        ),
        "The examples by the exact walk and, with rotations of any size, by the integrated one.",
        table(["dam", "exact", "integrated", "ratio", "slip, small rotations", "slip, any"], walks()),
    ]
    return "\n\n".join(parts)


if __name__ == "__main__":
    print(report())
