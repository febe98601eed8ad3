"""The dam as the page moves it: its two parts, and how the upper one lies at the moments that matter."""

from __future__ import annotations

from typing import Any

import numpy as np

from heeltoe.app.thinned import thinned
from heeltoe.case.model import Case
from heeltoe.result.response import Response
from heeltoe.views.animation.page import packed

_BINS = 200
_COLUMNS = ("slip_m", "rotation_rad", "gap_heel_m", "gap_toe_m")


def dam(case: Case, response: Response) -> dict[str, Any] | None:
    """Return what the page draws of a dam in motion; None where it does not get that far.

    The part above the crack moves by ``along * e + across * n + shrink * arm + turn * (arm turned by 90 degrees)``,
    where `arm` reaches from the heel to the point."""
    from heeltoe.views.animation.bodies import Moments, rigid_parts
    from heeltoe.views.animation.frames import automatic

    histories = response.histories
    if not response.summary or not histories:
        return None
    kept = thinned([histories[name] for name in _COLUMNS], _BINS)
    times = histories["time_s"][kept]
    upper, *lower = rigid_parts(case, histories, Moments.of(histories["time_s"], times))
    section = case.cut
    base = section.base_elevation
    largest = float(np.abs(upper.displacements(upper.outline)).max())
    overturned = response.outcome == "overturned"
    return {
        "upper": np.round(upper.points, 4).tolist(),
        "lower": np.round(lower[0].points[lower[0].outline], 4).tolist() if lower else [],
        "heel": list(section.heel),
        "toe": list(section.toe),
        "e": list(section.from_crack_frame(1.0, 0.0)),
        "n": list(section.from_crack_frame(0.0, 1.0)),
        "base": base,
        "water": None if case.reservoir is None else base + case.reservoir.depth,
        "tailwater": None if case.tailwater is None else base + case.tailwater.depth,
        "exaggeration": 1.0 if overturned else automatic(largest, section),
        "time": packed(times, "float32"),
        "motion": packed(upper.amplitudes, "float32"),
    }
