"""Sequences of motions: the effect of each motion on a dam, and the state that it leaves to the next one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from heeltoe.motion.ground_motion import Part
from heeltoe.result.contract import JOINT_METER_M, LEAST_M
from heeltoe.result.numbers import Stage
from heeltoe.result.record import ResponseData
from heeltoe.result.rest import comes_to_rest
from heeltoe.units.sentences import listed
from heeltoe.units.write import length

# What moves less in the last bit of a pause [s] has come to rest in it.
_LAST_S = 0.5


def stages(response: ResponseData, parts: Sequence[Part]) -> Iterator[Stage]:
    """Walk what each motion does in a run; one that the run has not reached is left out."""
    histories = response.histories
    time, slip = histories.time_s, histories.slip_m
    before, smallest = 0.0, JOINT_METER_M if response.elastic else LEAST_M
    for part, after in zip(parts, [*(part.begins for part in parts[1:]), response.end_time_s], strict=True):
        if part.begins > response.end_time_s or time[-1] < part.begins:
            return
        within = (time >= part.begins) & (time <= after)
        last = within & (time >= max(min(after, response.end_time_s) - _LAST_S, part.begins))
        moved = [column[last] for column in (slip, histories.gap_heel_m, histories.gap_toe_m)]
        # The run itself knows what it ends with.
        final = after >= response.end_time_s
        left = response.residual_slip_m if final else float(slip[within][-1])
        turned = histories.rotation_rad[within]
        yield Stage(
            name=part.name,
            pga_g=part.pga / response.gravity,
            begins_s=part.begins,
            ends_s=part.ends,
            slip_m=left - before,
            residual_slip_m=left,
            peak_slip_downstream_m=float(max(slip[within].max(), left, 0.0)),
            peak_slip_upstream_m=float(min(slip[within].min(), left, 0.0)),
            opening_upstream_m=float(max(histories.gap_heel_m[within].max(), 0.0)),
            opening_downstream_m=float(max(histories.gap_toe_m[within].max(), 0.0)),
            rotation_downstream_rad=float(max(-turned.min(), 0.0)),
            rotation_upstream_rad=float(max(turned.max(), 0.0)),
            at_rest=comes_to_rest(response) if final else all(np.ptp(values) < smallest for values in moved),
        )
        before = left


def sequence_sentence(stages: Sequence[Stage], units: str) -> str:
    """Say which motion of a sequence moves the dam by how much."""
    smallest = LEAST_M
    texts = [
        f"{length(abs(stage.slip_m), units)} {'downstream' if stage.slip_m > 0.0 else 'upstream'} in motion {number}"
        if abs(stage.slip_m) >= smallest
        else f"nothing in motion {number}"
        for number, stage in enumerate(stages, 1)
    ]
    return f"Motion by motion it slides {listed(texts)}." if len(texts) > 1 else ""
