"""The dam as the page moves it: its two parts, and how the upper one lies at the moments that matter."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from heeltoe.app.thinned import thinned
from heeltoe.case.model import Case
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.models.rigid.stack.response import StackResponse
from heeltoe.result.response import Response
from heeltoe.views.animation.page import packed

_BINS = 200
_COLUMNS = ("slip_m", "rotation_rad", "gap_heel_m", "gap_toe_m")


def dam(case: Case, response: Response) -> dict[str, Any] | None:
    """Return what the page draws of a dam in motion; None where it does not get that far.

    The part above a crack moves on the one below it by ``along * e + across * n + shrink * arm + turn * (arm turned by
    90 degrees)``, where `arm` reaches from the heel to the point; parts stand from the crest down."""
    from heeltoe.views.animation.bodies import Moments, rigid_parts
    from heeltoe.views.animation.frames import automatic

    if not response.summary or not response.histories:
        return None
    several = isinstance(response, FlexibleResponse | StackResponse)
    cracks = response.histories_of_cracks if several else (response.histories,)
    if len(cracks) != len(case.cracks):
        return None
    kept = thinned([each[name] for each in cracks for name in _COLUMNS], _BINS)
    times = response.histories["time_s"][kept]
    moments = Moments.of(response.histories["time_s"], times)
    blocks: list[dict[str, Any]] = []
    largest, above = 0.0, shapely.Polygon()
    for each, histories in zip(case.cracks, cracks, strict=True):
        upper, *lower = rigid_parts(each, histories, moments)
        section, whole = each.cut, shapely.Polygon(upper.points)
        blocks.append(
            {
                "points": _outline(whole, above) if blocks else np.round(upper.points, 4).tolist(),
                "heel": list(section.heel),
                "toe": list(section.toe),
                "e": list(section.from_crack_frame(1.0, 0.0)),
                "n": list(section.from_crack_frame(0.0, 1.0)),
                "motion": packed(upper.amplitudes, "float32"),
            }
        )
        above = whole
        largest += float(np.abs(upper.displacements(upper.outline)).max())
    base = case.cut.base_elevation
    overturned = response.outcome == "overturned"
    return {
        "blocks": blocks,
        "lower": np.round(lower[0].points[lower[0].outline], 4).tolist() if lower else [],
        "base": base,
        "water": None if case.reservoir is None else base + case.reservoir.depth,
        "tailwater": None if case.tailwater is None else base + case.tailwater.depth,
        "exaggeration": 1.0 if overturned else automatic(largest, case.cut),
        "time": packed(times, "float32"),
    }


def _outline(whole: shapely.Polygon, above: shapely.Polygon) -> list[list[float]]:
    """Return the part that stands below another one, of the whole above a crack."""
    part = max(shapely.get_parts(shapely.difference(whole, above)), key=shapely.area)
    found: list[list[float]] = np.round(shapely.get_coordinates(part.exterior)[:-1], 4).tolist()
    return found
