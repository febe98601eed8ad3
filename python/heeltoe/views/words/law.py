"""What a friction law has come to, in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from heeltoe.units.sentences import written


def law_line(found: Mapping[str, Any], units: str) -> str:
    """Say how far the crack has slipped, and what its friction was before and is after."""
    text = (
        "{name}; after {slip_path_m:.4g mm} of slip, to and fro, the apparent friction is "
        "{apparent_friction_after:.4g}, before {apparent_friction_before:.4g}, under {normal_stress_pa:.3g MPa}"
    )
    if found["cohesion_left_pa"] is not None:
        text += "; {cohesion_left_pa:.3g MPa} of cohesion is left"
    return written(text, units, **found)
