"""How results are written: tables, strict JSON, and what it says of motion and build."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from heeltoe.kernel.build import PROFILE, VERSION
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import measures

_MEASURES = ("arias_intensity_m_s", "cav_m_s", "significant_duration_s", "mean_period_s", "end_velocity_m_s")


def write_table(table: pa.Table, path: Path) -> None:
    """Write a table to `path`: CSV if it ends so, else Parquet."""
    # Opened here: Arrow would take a directory with a colon in its name for an address.
    with path.open("wb") as file:
        if path.suffix == ".csv":
            pa.csv.write_csv(table, file)
        else:
            pa.parquet.write_table(table, file)


def json_text(data: Mapping[str, Any]) -> str:
    """Return strict JSON: what is not finite, as only a run without a result leaves it, is null."""
    return json.dumps(_finite(data), indent=2, ensure_ascii=False, allow_nan=False)


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: _finite(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def motion_json(motion: GroundMotion, gravity: float) -> dict[str, Any]:
    """Return what the contract says about a ground motion; `gravity` is one g [m/s2]."""
    found = measures(motion, gravity)
    return {
        "name": motion.name,
        "pga_g": motion.pga / gravity,
        "pgv_m_s": motion.pgv,
        "pgd_m": motion.pgd,
        "dt_s": motion.dt,
        "duration_s": motion.duration,
        "samples": int(motion.time.size),
        **{name: found[name] for name in _MEASURES if name in found},
        "source": motion.source,
        "processing": list(motion.processing),
    }


def build_info() -> dict[str, str]:
    """Return which build made a result."""
    return {"heeltoe": VERSION, "kernel": PROFILE, "numpy": np.__version__}
