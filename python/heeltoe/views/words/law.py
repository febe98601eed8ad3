"""What a friction law or a rough crack has come to, in words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from heeltoe.result.response import Response
from heeltoe.units.sentences import written


def law_lines(response: Response, units: str) -> list[tuple[str, str]]:
    """Return what friction laws and a rough crack have come to: labels, which tell several cracks apart, and words."""
    cracks = [crack for crack in response.cracks if response.several and crack.friction_law is not None]
    own, rough = (response.summary.get(name) for name in ("friction_law", "roughness"))
    lines = [
        (
            written("friction law at {at_m:g m}", units, at_m=crack.elevation),
            law_line(crack.friction_law or {}, units),
        )
        for crack in cracks
    ]
    if not cracks and own is not None:
        lines = [("friction law", law_line(own, units))]
    return lines if rough is None else [*lines, ("rough crack", roughness_line(rough, units))]


def roughness_line(quantities: Mapping[str, Any], units: str) -> str:
    """Say how far a rough crack has dilated, how worn it is, and what its friction was before and is after."""
    text = (
        "dilated by {peak_dilation_m:.3g mm} at most, {residual_dilation_m:.3g mm} in the end; the flanks wore from "
        f"{math.degrees(quantities['asperity_angle_before_rad']):.3g} to "
        f"{math.degrees(quantities['asperity_angle_after_rad']):.3g} degrees; the apparent friction is "
        "{apparent_friction_after:.4g}, before {apparent_friction_before:.4g}"
    )
    return written(text, units, **quantities)


def law_line(quantities: Mapping[str, Any], units: str) -> str:
    """Say how far the crack has slipped, and what its friction was before and is after."""
    text = (
        "{name}; after {slip_path_m:.4g mm} of slip, to and fro, the apparent friction is "
        "{apparent_friction_after:.4g}, before {apparent_friction_before:.4g}, under {normal_stress_pa:.3g MPa}"
    )
    if quantities["cohesion_left_pa"] is not None:
        text += "; {cohesion_left_pa:.3g MPa} of cohesion is left"
    if "slip_path_range_m" in quantities:
        names = ("slip_path_range_m", "apparent_friction_before_range", "apparent_friction_after_range")
        ends = {f"{name}_{k}": quantities[name][k] for name in names for k in (0, 1)}
        text += (
            "; along the crack {slip_path_range_m_0:.4g mm} to {slip_path_range_m_1:.4g mm} of slip, friction "
            "{apparent_friction_before_range_0:.3g} to {apparent_friction_before_range_1:.3g} before, "
            "{apparent_friction_after_range_0:.3g} to {apparent_friction_after_range_1:.3g} after"
        )
        quantities = {**quantities, **ends}
    return written(text, units, **quantities)
