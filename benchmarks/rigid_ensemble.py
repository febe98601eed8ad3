"""Time, memory and cost by part of many rigid runs: 30 s of shaking, sampled at 0.01 s, for every block."""

from __future__ import annotations

import argparse

import numpy as np
from measure import forget_peak, heading, memory, repeat, require, table, timed
from problems import DURATION, STEP, Ensemble, Floats, G, dam, el_centro, slender_blocks, taft, typical_dams

from heeltoe import build_block, rigid
from heeltoe.kernel.block import OUTCOMES
from heeltoe.kernel.build import PROFILE
from heeltoe.mechanics.many import block_columns

MODES = ("rest", "sliding", "rocking", "slide_rocking", "drifting")
REPETITIONS = 3
#: Runs of the whole ensemble between which memory must not grow.
ROUNDS = 6


def ensembles(count: int) -> list[Ensemble]:
    """Those that are measured. The slender blocks meet many times more events, hence fewer of them."""
    one, two = taft(), el_centro()
    return [
        typical_dams(f"dam, {one.name}", count, one),
        typical_dams(f"dam, {two[0].name} and vertical", count, two),
        slender_blocks(f"slender, {one.name}", max(count // 10, 100), one),
    ]


def check(ensemble: Ensemble, result: dict[str, Floats]) -> list[str]:
    """Return what happened in the runs, as a row of a table.

    Raises
    ------
    NothingMeasured
        Where runs ended early or nothing moved: such runs cost nothing, and their time says nothing.
    """
    count = result["outcome"].size
    ended = result["outcome"] == OUTCOMES.index("ok")
    require(ended.mean() > 0.999, f"{ensemble.name}: {count - ended.sum()} of {count} runs ended early")
    moved = result["events"] > 0
    require(moved.mean() > 0.5, f"{ensemble.name}: only {moved.mean():.0%} of the blocks moved")
    shares = [result[f"time_{mode}"].mean() / DURATION for mode in MODES]
    return [
        ensemble.name,
        f"{moved.mean():.0%}",
        *(f"{share:.2%}" for share in shares),
        f"{result['events'].mean():.0f}",
        f"{np.quantile(result['events'], 0.99):.0f}",
        f"{result['events'].max():.0f}",
        f"{result['impacts'].mean():.0f}",
        str(int(count - ended.sum())),
        f"{result['energy_residual'].max():.0e}",
    ]


def times(ensemble: Ensemble, threads: int) -> tuple[list[str], dict[str, Floats]]:
    """Time the whole ensemble; a row of a table, and the results."""
    result: dict[str, Floats] = {}
    timing = repeat(lambda: result.update(ensemble.run(threads)), REPETITIONS)
    count = len(ensemble.blocks)
    samples = count * DURATION / STEP
    row = [
        ensemble.name,
        f"{count:,}",
        str(threads),
        timed(timing),
        f"{1e6 * timing.median / count:.1f} µs",
        f"{1e6 * timing.cpu_median / count:.1f} µs",
        f"{1e9 * timing.cpu_median / samples:.1f} ns",
        f"{1e9 * timing.cpu_median / result['events'].sum():.0f} ns",
    ]
    return row, result


def costs(ensemble: Ensemble, result: dict[str, Floats]) -> list[str]:
    """Take the time apart into samples at rest, samples in motion and events, by least squares.

    The runs are put into parcels of like numbers of events, the processor time of each is taken, and the three unit
    costs are fitted to the parcels, each weighted by its own time so that the quick ones count as much as the slow.
    """
    parcels = np.array_split(np.argsort(result["events"], kind="stable"), 24)
    parts, taken = [], []
    for parcel in parcels:
        rest = result["time_rest"][parcel].sum() / STEP
        parts.append([rest, parcel.size * DURATION / STEP - rest, result["events"][parcel].sum()])
        taken.append(repeat(lambda parcel=parcel: ensemble.run(1, parcel), 3).cpu_median)
    matrix, time = np.array(parts), np.array(taken)
    unit = np.linalg.lstsq(matrix / time[:, None], np.ones(time.size), rcond=None)[0]
    error = np.abs(matrix @ unit / time - 1.0)
    return [ensemble.name, *(f"{1e9 * item:.1f} ns" for item in unit), f"{np.median(error):.0%}", f"{error.max():.0%}"]


def flatness(ensemble: Ensemble) -> list[str]:
    """Resident memory before and after runs, and at its peak; more runs must not add to it."""
    ensemble.run(0)
    forget_peak()
    before = memory()
    sizes = []
    for _ in range(ROUNDS):
        result = ensemble.run(0)
        sizes.append(sum(column.nbytes for column in result.values()) / 2**20)
        del result
    return [
        ensemble.name,
        f"{len(ensemble.blocks):,}",
        f"{before:.0f} MB",
        f"{memory():.0f} MB",
        f"{memory(peak=True):.0f} MB",
        f"{max(sizes):.0f} MB",
    ]


def single() -> str:
    """Time one analysis as a user calls it, from the case to the response with histories, events and warnings."""
    case, motion = dam(100.0), taft().scaled_to(0.4 * G)
    response = rigid(case, motion)
    require(response.outcome == "ok" and response.residual_slip_m > 0.0, "the single dam did not slide")
    timing = repeat(lambda: rigid(case, motion))
    return (
        f"A single dam through `heeltoe.rigid`, from the case to the response with histories at every sample: "
        f"{timed(timing)}."
    )


def blocks(count: int = 1_000_000, piece: int = 25_000) -> str:
    """Time making blocks from columns of numbers, piece by piece, on one core."""
    rng = np.random.default_rng(3)
    drains = {"uplift.pattern": "drained", "uplift.drain_position": 0.1, "uplift.drain_efficiency": 0.0}
    case = dam(100.0).with_(drains)
    ends = {
        "crack.friction": (0.7, 1.4),
        "crack.restitution": (0.0, 0.9),
        "reservoir.depth": (85.0, 100.0),
        "uplift.drain_efficiency": (0.0, 1.0),
    }
    columns = {path: rng.uniform(*each, count) for path, each in ends.items()}

    def make(columns: dict[str, Floats]) -> None:
        for start in range(0, count, piece):
            block_columns(case, {path: column[start : start + piece] for path, column in columns.items()})

    timing = repeat(lambda: make(columns), REPETITIONS)
    cracked = repeat(lambda: make(columns | {"crack.elevation": rng.uniform(0.0, 80.0, count)}), REPETITIONS)
    one = repeat(lambda: build_block(case))
    return (
        f"The numbers of {count:,} blocks from columns of friction, restitution, water depth and efficiency of drains, "
        f"in pieces of {piece:,}: {timed(timing)}; with an elevation of the crack for each: {timed(cracked)}. A block "
        f"by itself: {timed(one)}."
    )


def report(count: int = 100_000) -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    timings, happenings, parts, memories = [], [], [], []
    for ensemble in ensembles(count):
        alone, result = times(ensemble, 1)
        both, again = times(ensemble, 2)
        equal = all(np.array_equal(result[name], again[name]) for name in result)
        require(equal, f"{ensemble.name}: one thread and two gave different results")
        timings += [alone, both]
        happenings.append(check(ensemble, result))
        parts.append(costs(ensemble, result))
        memories.append(flatness(ensemble))
    return "\n\n".join(
        [
            heading("Rigid ensemble", ["heeltoe", "numpy"]),
            f"Each run is {DURATION:g} s of shaking in {DURATION / STEP:.0f} intervals. Median of {REPETITIONS} "
            "repetitions; in brackets the distance between their quartiles. Processor time counts both threads.",
            table(
                [
                    "ensemble",
                    "runs",
                    "threads",
                    "elapsed",
                    "elapsed per run",
                    "processor per run",
                    "per interval",
                    "per event",
                ],
                timings,
            ),
            "The runs on average. `ended early` counts runs whose outcome is not `ok`; the last "
            "column is the largest relative gap in any energy balance.",
            table(
                [
                    "ensemble",
                    "moved",
                    *(mode.replace("_", "-") for mode in MODES),
                    "events",
                    "99th percentile",
                    "most",
                    "impacts",
                    "ended early",
                    "energy",
                ],
                happenings,
            ),
            "Where the time goes: unit costs fitted to 24 parcels of the ensemble, and how far the fit is off.",
            table(
                ["ensemble", "interval at rest", "interval in motion", "event", "median misfit", "largest misfit"],
                parts,
            ),
            f"Resident memory of the process around {ROUNDS} runs of the whole ensemble; the peak contains the result.",
            table(["ensemble", "runs", "before", "after", "peak", "result"], memories),
            single(),
            blocks(),
        ]
    )


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--runs", type=int, default=100_000, help="blocks in the large ensembles")
    print(report(arguments.parse_args().runs))
