"""What each motion of a sequence does to a dam, and what it leaves to the next one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from heeltoe.result.contract import JOINT_METER_M, LEAST_M
from heeltoe.result.rest import comes_to_rest
from heeltoe.units.write import length

# Not at run time: a response has them.
if TYPE_CHECKING:
    from heeltoe.motion.ground_motion import Part
    from heeltoe.result.response import Response

# What moves less in the last bit of a pause [s] has come to rest in it.
_LAST_S = 0.5


@dataclass(frozen=True)
class Stage:
    """A motion of a sequence, as the histories of its run have it.

    Attributes
    ----------
    name, pga_g, begins_s, ends_s
        Of the motion, in the time of the whole run.
    slip_m
        What it adds, positive downstream.
    residual_slip_m
        Where it leaves the dam, since before the first one.
    peak_slip_downstream_m, peak_slip_upstream_m
        Largest and least slip on its way, since before the first one.
    opening_upstream_m, opening_downstream_m
        Largest opening of the crack at either face.
    rotation_downstream_rad, rotation_upstream_rad
        Largest rotations, none negative.
    at_rest
        Whether the dam has come to rest before the next one begins, or before the run ends.
    static
        What the static checks say of the dam that it leaves: ``ok``, ``missed`` in words and the drainage that is left.
    """

    name: str
    pga_g: float
    begins_s: float
    ends_s: float
    slip_m: float
    residual_slip_m: float
    peak_slip_downstream_m: float
    peak_slip_upstream_m: float
    opening_upstream_m: float
    opening_downstream_m: float
    rotation_downstream_rad: float
    rotation_upstream_rad: float
    at_rest: bool
    static: Mapping[str, Any] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Return a dictionary of plain numbers, strings and lists."""
        return asdict(self)


def stages(response: Response, parts: Sequence[Part]) -> Iterator[Stage]:
    """Walk what each motion does in a run; one that the run has not reached is left out."""
    histories = response.histories
    time, slip = histories["time_s"], histories["slip_m"]
    before, least = 0.0, JOINT_METER_M if response.elastic else LEAST_M
    for part, after in zip(parts, [*(each.begins for each in parts[1:]), response.end_time_s], strict=True):
        if part.begins > response.end_time_s or time[-1] < part.begins:
            return
        there = (time >= part.begins) & (time <= after)
        last = there & (time >= max(min(after, response.end_time_s) - _LAST_S, part.begins))
        moved = [histories[name][last] for name in ("slip_m", "gap_heel_m", "gap_toe_m")]
        # The run itself knows what it ends with.
        final = after >= response.end_time_s
        left = response.residual_slip_m if final else float(slip[there][-1])
        turned = histories["rotation_rad"][there]
        yield Stage(
            name=part.name,
            pga_g=part.pga / response.gravity,
            begins_s=part.begins,
            ends_s=part.ends,
            slip_m=left - before,
            residual_slip_m=left,
            peak_slip_downstream_m=float(max(slip[there].max(), left)),
            peak_slip_upstream_m=float(min(slip[there].min(), left)),
            opening_upstream_m=float(max(histories["gap_heel_m"][there].max(), 0.0)),
            opening_downstream_m=float(max(histories["gap_toe_m"][there].max(), 0.0)),
            rotation_downstream_rad=float(max(-turned.min(), 0.0)),
            rotation_upstream_rad=float(max(turned.max(), 0.0)),
            at_rest=comes_to_rest(response) if final else all(np.ptp(each) < least for each in moved),
        )
        before = left


def sequence_said(found: Sequence[Stage], units: str) -> str:
    """Say which motion of a sequence moves the dam by how much."""
    least = LEAST_M
    told = [
        f"{length(abs(each.slip_m), units)} {'downstream' if each.slip_m > 0.0 else 'upstream'} in motion {number}"
        if abs(each.slip_m) >= least
        else f"nothing in motion {number}"
        for number, each in enumerate(found, 1)
    ]
    return f"Motion by motion it slides {', '.join(told[:-1])} and {told[-1]}." if len(told) > 1 else ""
