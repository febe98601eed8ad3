"""Gather the runs of run_dams.py in one table, a row for each dam in its motion.

    python examples/studies/rigid-or-flexible/gather_dams.py OUT

writes runs.parquet beside this file: what was varied, what the dam and the motion are like, and how far each model
slides. No record is in it, only numbers that were computed from them.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from heeltoe import open_study
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.beam import swing_of
from heeltoe.mechanics.block import build_block, static_state
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import mean_period, significant_duration
from heeltoe.study.plan.file import read_study
from heeltoe.study.plan.plan import plan_of

HERE = Path(__file__).parent
MODELS = ("rigid", "decoupled", "flexible")


def rows_of(directory: Path) -> Iterator[dict[str, Any]]:
    """Walk the dams of one study."""
    half, name = directory.parent.name, directory.name
    dam, _, place = name.rpartition(", ")
    plan = plan_of(read_study(directory / "study.toml"))
    motions = {(shake.name, shake.turned): shake.horizontal for shake in plan.shakes}
    runs: dict[int, dict[str, dict[str, Any]]] = {}
    for run in open_study(directory / "runs").to_table().to_pylist():
        runs.setdefault(run["sample"], {})[run["model"]] = run
    for sample, by_model in runs.items():
        run = by_model["rigid"]
        changes: dict[str, Any] = {}
        for axis in plan.axes:
            changes |= axis.changes(run[axis.path])
        case = plan.case.with_(changes)
        motion = motions[run["motion"], run["reversed"]]
        answer = {"half": half, "dam": dam, "crack": place, "sample": sample}
        answer |= _told(case, motion, run["factor"])
        answer |= {"event": run["event"], "motion": run["motion"], "reversed": run["reversed"]}
        for model in MODELS:
            answer |= _found(model, by_model.get(model, {}))
        yield answer


def _told(case: Case, motion: GroundMotion, factor: float) -> dict[str, Any]:
    """Return what a dam and its motion are like."""
    assert case.concrete.modulus is not None
    assert case.reservoir is not None
    swing = swing_of(case, motion, (case.concrete.modulus,))
    assert swing is not None
    block = build_block(case)
    critical = static_state(block)["critical_acceleration_g"]
    corners = [z for _, z in case.section.vertices()]
    return {
        "height_m": max(corners) - min(corners),
        "crack_elevation_m": case.crack.elevation,
        "crack_width_m": block.width,
        "modulus_pa": case.concrete.modulus,
        "damping": case.concrete.damping,
        "friction": case.crack.mu_static,
        "restitution": case.crack.restitution,
        "reservoir_depth_m": case.reservoir.depth,
        "uplift_intensity": case.uplift.intensity,
        "pga_m_s2": motion.pga * factor,
        "pgv_m_s": motion.pgv * factor,
        "mean_period_s": mean_period(motion),
        "significant_duration_s": significant_duration(motion),
        "critical_sliding_m_s2": critical["sliding"] * case.gravity,
        "critical_rocking_m_s2": critical["rocking"] * case.gravity,
        "first_period_s": float(swing.periods[0]),
        "spectral_acceleration_m_s2": float(swing.accelerations[0]) * factor,
        "crack_acceleration_m_s2": float(swing.at_crack[0]) * factor,
    }


def _found(model: str, run: dict[str, Any]) -> dict[str, Any]:
    """Return what a model found, if it was asked."""
    turned = [run.get(f"rocking_{way}_rad") for way in ("downstream", "upstream")]
    return {
        f"{model}_outcome": run.get("outcome"),
        f"{model}_slip_m": run.get("residual_slip_m"),
        f"{model}_rotation_rad": max((item for item in turned if item is not None), default=None),
    }


def main(out: Path) -> None:
    """Gather all studies that are complete."""
    rows: list[dict[str, Any]] = []
    for directory in sorted(path.parent for path in out.glob("*/*/runs")):
        try:
            rows += rows_of(directory)
        except InputError as error:
            print(f"left out: {directory.name}: {error}")
    table = pa.Table.from_pylist(rows)
    pq.write_table(table, HERE / "runs.parquet", compression="zstd")
    print(f"{table.num_rows} dams")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
