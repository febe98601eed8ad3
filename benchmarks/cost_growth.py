"""How cost grows with the length of the record, the mesh and the number of runs, with the error beside the time."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import numpy as np
from crack_dam import BASE_STEP, DAM, EXAMPLES, least
from measure import heading, repeat, require, seconds, table
from problems import LIMITS, STEP, G, dam, el_centro, typical_dams

from heeltoe import GroundMotion, build_block, build_flexible_dam, read_case, rigid_many
from heeltoe.kernel.build import PROFILE
from heeltoe.models.flexible.body import bonded, reduced
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.motion.earthquake import Earthquake

LENGTHS = (5.0, 10.0, 20.0, 30.0, 60.0, 120.0)
COUNTS = (100, 1000, 10_000, 100_000)
ACROSS = (4, 8, 16, 32, 64)
SOME, FLEXIBLE_COUNTS = (5.0, 10.0, 20.0), (1, 4, 16)
#: Of the runs that lengths are compared with.
BLOCKS = 500


def _shaken_for(length: float) -> GroundMotion:
    """Return El Centro again and again at 0.4 g, for so long [s]: that anyone can have."""
    once = el_centro()[0].scaled_to(0.4 * G)
    count = round(length / STEP) + 1
    ground = np.resize(once.acceleration[:-1], count)
    return GroundMotion.from_points(np.arange(count) * STEP, ground, name="El Centro 180, again and again")


def _power(places: Sequence[float], times: Sequence[float]) -> str:
    """Return the power of the size that the time goes with, over the upper half of the sizes."""
    half = len(places) // 2
    return f"{np.polyfit(np.log(places[half - 1 :]), np.log(times[half - 1 :]), 1)[0]:.2f}"


def rigid_lengths() -> tuple[list[list[str]], str]:
    """Time a rigid dam, of many, by the length of the record."""
    blocks = np.tile(build_block(dam(100.0)).parameters(), (BLOCKS, 1))
    lines, times = [], []
    for length in LENGTHS:
        motion = _shaken_for(length)
        batch = rigid_many(blocks, [motion], limits=LIMITS, threads=1)
        require(bool(batch["slip"].min() > 0.0), "the dam did not slide")
        times.append(least(repeat(lambda motion=motion: rigid_many(blocks, [motion], limits=LIMITS, threads=1), 3)))
        lines.append(
            [
                f"{length:g} s",
                seconds(times[-1] / BLOCKS),
                f"{batch['events'][0]:.0f}",
                f"{batch['energy_residual'].max():.0e}",
            ]
        )
    return lines, _power(LENGTHS, times)


def rigid_counts() -> tuple[list[list[str]], str]:
    """Time rigid dams by their number."""
    lines, times = [], []
    for count in COUNTS:
        ensemble = typical_dams("dam", count, el_centro()[0])
        times.append(least(repeat(lambda ensemble=ensemble: ensemble.run(1), 3)))
        lines.append([f"{count:,}", seconds(times[-1]), seconds(times[-1] / count)])
    return lines, _power(COUNTS, times)


def meshes(finest: int) -> tuple[list[list[str]], str]:
    """Time the elastic dam by its mesh, and how far its slip is from that of the finest."""
    motion, result = _shaken_for(20.0), []
    across = [item for item in ACROSS if item <= finest]
    for elements in across:
        case = read_case(EXAMPLES / "thesis/typical-base.toml", (*DAM, f"flexible.elements_across={elements}"))
        setup = repeat(lambda case=case: reduced._build(case), 3, bonded._KEPT.clear)
        shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(motion, None, motion.duration).shaking)
        slip = shaken.run(BASE_STEP).summary.slip
        require(slip > 1e-3, "the dam did not slide")
        result.append((elements, least(setup), least(repeat(lambda shaken=shaken: shaken.run(BASE_STEP), 3)), slip))
    end = result[-1][3]
    steps = motion.duration / BASE_STEP
    lines = [
        [
            f"{elements} across",
            seconds(ready),
            seconds(taken),
            seconds(taken / steps),
            f"{1e3 * slip:.1f} mm",
            f"{abs(slip / end - 1.0):.1%}",
        ]
        for elements, ready, taken, slip in result
    ]
    return lines, _power(across, [taken for _, _, taken, _ in result])


def flexible_lengths_and_counts() -> tuple[list[list[str]], list[list[str]]]:
    """Time the elastic dam by the length of the record, and many of it by their number."""
    case = read_case(EXAMPLES / "thesis/typical-base.toml", DAM)
    parts = build_flexible_dam(case)
    lines, many = [], []
    for length in SOME:
        motion = _shaken_for(length)
        shaken = ShakenDam(case, parts, Earthquake(motion, None, motion.duration).shaking)
        lines.append([f"{length:g} s", seconds(least(repeat(lambda shaken=shaken: shaken.run(BASE_STEP), 3)))])
    for count in FLEXIBLE_COUNTS:
        scales = np.linspace(0.98, 1.02, count) if count > 1 else np.ones(1)
        taken = least(repeat(lambda scales=scales: shaken.run_scaled(BASE_STEP, scales, threads=1), 3))
        many.append([str(count), seconds(taken), seconds(taken / count)])
    return lines, many


def report(finest: int = ACROSS[-1]) -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    lengths, by_length = rigid_lengths()
    counts, by_count = rigid_counts()
    mesh, by_mesh = meshes(finest)
    some, many = flexible_lengths_and_counts()
    return "\n\n".join(
        [
            heading("How cost grows", ["heeltoe", "numpy", "scipy"]),
            "The typical dam under El Centro 1940, again and again, at 0.4 g; least processor time of three, on one "
            f"core. Rigid, by the length of the record: with the power {by_length} of it. The error is that of the "
            "energy ledger.",
            table(["record", "a run", "events", "largest error"], lengths),
            f"Rigid, by the number of runs, each with its own dam: with the power {by_count}; nothing is kept of a run "
            "but its numbers.",
            table(["runs", "all", "each"], counts),
            f"Elastic with a crack at its base, 20 s, by the elements along the crack: with the power {by_mesh}. The "
            "error is that of the slip, from the finest.",
            table(["mesh", "set-up", "20 s", "a step", "slip", "error"], mesh),
            "Elastic, 8 across, by the length of the record, and 20 s by the number of runs one after the other.",
            table(["record", "a run"], some),
            table(["runs", "all", "each"], many),
            "With the number of cracks: see `crack_dam`.",
        ]
    )


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--finest", type=int, default=ACROSS[-1], help="elements along the crack at the most")
    print(report(arguments.parse_args().finest))
