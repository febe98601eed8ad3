"""How results are written: tables, strict JSON, and what it says of motion and build."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from heeltoe.base.blocks import Block, Number
from heeltoe.mechanics.block import StaticState
from heeltoe.motion.ground_motion import GroundMotion, Part
from heeltoe.motion.measures import measures

if TYPE_CHECKING:
    import pyarrow as pa

# How a formula of a spreadsheet begins; a sign before a number does not make one.
_FORMULA = r"^(?:[=@\t\r]|[+-][^\d.\s])"


class MotionPart(Block):
    """One motion of a sequence."""

    name: Annotated[str, Number("Name of the record.")]
    pga_g: Annotated[float, Number("Its peak acceleration.", "g")]
    begins_s: Annotated[float, Number("When it begins, in the time of the whole run.", "s")]
    ends_s: Annotated[float, Number("When it ends.", "s")]
    processing: Annotated[list[str], Number("Processing of the record, in order.")]


class MotionNumbers(Block):
    """A ground motion, as used."""

    name: Annotated[str, Number("Name of the record.")]
    pga_g: Annotated[float, Number("Peak acceleration, without sign.", "g")]
    pgv_m_s: Annotated[float, Number("Peak velocity.", "m/s")]
    pgd_m: Annotated[float, Number("Peak displacement, by integration from rest.", "m")]
    dt_s: Annotated[float, Number("Time between samples.", "s")]
    duration_s: Annotated[float, Number("Length of the motion.", "s")]
    samples: Annotated[int, Number("How many samples it has.")]
    arias_intensity_m_s: Annotated[float | None, Number("Arias intensity.", "m/s", optional=True)] = None
    cav_m_s: Annotated[float | None, Number("Cumulative absolute velocity.", "m/s", optional=True)] = None
    significant_duration_s: Annotated[
        float | None, Number("Time in which 5 to 95 % of the Arias intensity come in.", "s", optional=True)
    ] = None
    mean_period_s: Annotated[float | None, Number("Mean period of the Fourier amplitudes.", "s", optional=True)] = None
    end_velocity_m_s: Annotated[
        float | None, Number("Velocity at the end: what a sound record leaves is small.", "m/s", optional=True)
    ] = None
    source: Annotated[str, Number("File and version that the record was read from.")]
    processing: Annotated[list[str], Number("Processing of the record, in order.")]
    parts: Annotated[list[MotionPart] | None, Number("Motions of a sequence, in order.", optional=True)] = None


def write_json(data: Mapping[str, object], path: Path) -> None:
    """Write the JSON of a result to `path`."""
    path.write_text(json_text(data) + "\n", encoding="utf-8")


def write_table(table: pa.Table, path: Path) -> None:
    """Write a table to `path`: CSV if it ends so, else Parquet."""
    import pyarrow.csv
    import pyarrow.parquet

    # StudyResults here: Arrow would take a directory with a colon in its name for an address.
    with path.open("wb") as file:
        if path.suffix == ".csv":
            pyarrow.csv.write_csv(_without_formulas(table), file)
        else:
            pyarrow.parquet.write_table(table, file)


def _without_formulas(table: pa.Table) -> pa.Table:
    """Return a table whose texts no spreadsheet takes for a formula: an apostrophe precedes those that begin so."""
    import pyarrow as pa
    import pyarrow.compute as compute

    columns = [
        compute.replace_substring_regex(column, _FORMULA, r"'\0")
        if pa.types.is_string(column.type) or pa.types.is_large_string(column.type)
        else column
        for column in table.columns
    ]
    return pa.Table.from_arrays(columns, schema=table.schema)


def json_text(data: Mapping[str, object]) -> str:
    """Return strict JSON: what is not finite, as only a run without a result leaves it, is null."""
    return json.dumps(_finite(data), indent=2, ensure_ascii=False, allow_nan=False)


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: _finite(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


# Why a number of the static state is not there.
_NO_ACCELERATION = "no horizontal acceleration of the ground does that"
_LEFT_OUT = {
    "sliding_safety_factor": "no force acts along the crack",
    "resultant_from_heel_m": "no force presses on the crack",
}


def critical_json(critical: Mapping[str, float]) -> tuple[dict[str, float], dict[str, str]]:
    """Return the accelerations at which something starts, and by their path why the others are no number."""
    finite = {name: value for name, value in critical.items() if math.isfinite(value)}
    return finite, {f"critical_acceleration_g.{name}": _NO_ACCELERATION for name in critical if name not in finite}


def static_json(state: StaticState) -> dict[str, object]:
    """Return what the contract says about the static state: what is no number is left out, and why stands beside it."""
    static = state.to_json()
    critical, left_out = critical_json(state.critical_acceleration_g)
    others = {name: value for name, value in static.items() if name != "critical_acceleration_g"}
    left_out |= {f"static.{name}": _LEFT_OUT[name] for name, value in others.items() if value is None}
    stated = {name: value for name, value in others.items() if value is not None}
    return {"critical_acceleration_g": critical, "static": stated, "left_out": left_out}


def motion_json(motion: GroundMotion, gravity: float) -> dict[str, object]:
    """Return what the contract says about a ground motion; `gravity` is one g [m/s2]."""
    numbers = measures(motion, gravity)
    return MotionNumbers(
        name=motion.name,
        pga_g=motion.pga / gravity,
        dt_s=motion.dt,
        samples=int(motion.time.size),
        **{name: numbers[name] for name in MotionNumbers.names() if name in numbers},
        source=motion.source,
        processing=list(motion.processing),
        parts=[_part(part, gravity) for part in motion.parts] or None,
    ).to_json()


def _part(part: Part, gravity: float) -> MotionPart:
    return MotionPart(
        name=part.name,
        pga_g=part.pga / gravity,
        begins_s=part.begins,
        ends_s=part.ends,
        processing=list(part.processing),
    )
