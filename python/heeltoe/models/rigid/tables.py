"""What the rigid kernels found, by the names of the contract."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.model import Case
from heeltoe.mechanics.block import Block
from heeltoe.models.rigid.walk import GroundSeries
from heeltoe.result.response import Energy

Floats = NDArray[np.float64]


def summary_of(case: Case, raw: dict[str, float], block: Block, tension: Floats) -> dict[str, Any]:
    downstream, upstream = -raw["rotation_min"], raw["rotation_max"]
    overturned = _kernel.OUTCOMES[int(raw["outcome"])] == "overturned"
    finite = case.analysis.rotation == "finite"

    def opening(rotation: float) -> float:
        return block.width * (math.sin(min(rotation, math.pi / 2.0)) if finite else rotation)

    return {
        "residual_slip_m": raw["slip"],
        "peak_slip_downstream_m": raw["slip_max"],
        "peak_slip_upstream_m": raw["slip_min"],
        "rocking_downstream_rad": abs(downstream),
        "rocking_upstream_rad": abs(upstream),
        # Rocking downstream, about the toe, opens the crack at the upstream face.
        "opening_upstream_m": opening(abs(downstream)),
        "opening_downstream_m": opening(abs(upstream)),
        "largest_gap_heel_m": raw["largest_gap_heel"],
        "largest_gap_toe_m": raw["largest_gap_toe"],
        "slip_by_mode_m": {
            "sliding": raw["slip_sliding"],
            "slide_rocking": raw["slip_slide_rocking"],
            "drifting": raw["slip_drifting"],
        },
        "time_by_mode_s": {
            "rest": raw["time_rest"],
            "sliding": raw["time_sliding"],
            "rocking": raw["time_rocking"],
            "slide_rocking": raw["time_slide_rocking"],
            "drifting": raw["time_drifting"],
        },
        "impacts": int(raw["impacts"]),
        "largest_impact_velocity_m_s": raw["largest_impact_velocity"],
        "events": int(raw["events"]),
        "final_mode": _kernel.MODES[int(raw["final_mode"])],
        "final_slip_velocity_m_s": raw["slip_velocity"],
        "end_time_s": raw["end_time"],
        "crack_width_m": block.width,
        "rotation": case.analysis.rotation,
        "uplift_during_shaking": case.uplift.during_shaking,
        "overturned_about": ("toe" if downstream > upstream else "heel") if overturned else None,
        "anchors": [
            {"distance_m": anchor.distance, "peak_tension_n": float(peak), "capacity_n": anchor.capacity}
            for anchor, peak in zip(case.anchors, tension, strict=True)
        ],
    }


def energy_of(raw: dict[str, float]) -> Energy:
    return Energy(
        input_j=raw["energy_input"],
        friction_j=raw["energy_friction"],
        impact_j=raw["energy_impact"],
        kinetic_j=raw["energy_kinetic"],
        residual=raw["energy_residual"],
    )


def histories_of(
    case: Case, moments: Floats, history: Floats, shaking: GroundSeries, block: Block
) -> dict[str, Floats]:
    column = {name: np.ascontiguousarray(history[:, k]) for k, name in enumerate(_kernel.HISTORY_FIELDS)}
    time = shaking.time
    result = {"time_s": moments, "ground_acceleration_m_s2": np.interp(moments, time, shaking.horizontal)}
    if shaking.up is not None:
        result["vertical_ground_acceleration_m_s2"] = np.interp(moments, time, shaking.up)
    if shaking.turning is not None:
        result["ground_rotation_rad_s2"] = np.interp(moments, time, shaking.turning)
    rotation = (column["gap_toe"] - column["gap_heel"]) / block.width
    rate = (column["gap_velocity_toe"] - column["gap_velocity_heel"]) / block.width
    if case.analysis.rotation == "finite":
        # The gaps go with its sine.
        rotation = np.arcsin(np.clip(rotation, -1.0, 1.0))
        rate = rate / np.maximum(np.cos(rotation), 1e-9)
    result |= {
        "slip_m": column["slip"],
        "slip_velocity_m_s": column["slip_velocity"],
        "slip_acceleration_m_s2": column["slip_acceleration"],
        "gap_heel_m": column["gap_heel"],
        "gap_toe_m": column["gap_toe"],
        "rotation_rad": rotation,
        "rotation_velocity_rad_s": rate,
        "friction_force_n": column["friction_force"],
        "normal_force_heel_n": column["normal_force_heel"],
        "normal_force_toe_n": column["normal_force_toe"],
    }
    return result


def events_of(rows: Floats) -> dict[str, Any]:
    column = {name: np.ascontiguousarray(rows[:, k]) for k, name in enumerate(_kernel.EVENT_FIELDS)}

    def named(field: str, names: list[str]) -> list[str]:
        return [names[int(k)] for k in column[field]]

    return {
        "time_s": column["time"],
        "kind": named("kind", _kernel.EVENT_KINDS),
        "mode_before": named("mode_before", _kernel.MODES),
        "mode_after": named("mode_after", _kernel.MODES),
        "slip_m": column["slip"],
        "gap_heel_m": column["gap_heel"],
        "gap_toe_m": column["gap_toe"],
        "slip_velocity_m_s": column["slip_velocity"],
        "gap_velocity_heel_m_s": column["gap_velocity_heel"],
        "gap_velocity_toe_m_s": column["gap_velocity_toe"],
        "approach_slip_velocity_m_s": column["approach_slip_velocity"],
        "approach_velocity_heel_m_s": column["approach_velocity_heel"],
        "approach_velocity_toe_m_s": column["approach_velocity_toe"],
        "friction_impulse_n_s": column["impulse_friction"],
        "heel_impulse_n_s": column["impulse_heel"],
        "toe_impulse_n_s": column["impulse_toe"],
        "energy_lost_j": column["energy_lost"],
    }
