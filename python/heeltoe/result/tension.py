"""The largest tension of a run in words, and what it means where the concrete does not bear it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from heeltoe.units.sentences import written

# What parts are called where there are several cracks.
_SAID = {
    "uppermost": "the part above all cracks",
    "between": "the part between two cracks",
    "lowest": "the part below all cracks",
}


def place_said(found: Mapping[str, Any]) -> str:
    """Say where a largest stress is, its height apart."""
    part = _SAID.get(found["part"], f"the part {found['part']} the crack")
    place = found["place"]
    return f"inside {part}" if place == "inside" else f"at the {place}{'' if place == 'base' else ' face'} of {part}"


def cracks_said(found: Mapping[str, Any] | None, units: str) -> str:
    """Say that the concrete does not bear its largest tension; nothing where it does, or where nobody knows."""
    strength = None if found is None else found["strength"]
    if found is None or strength is None or not strength["exceeds"]:
        return ""
    return written(
        "Its tension of {stress_pa:.3g MPa} {where}, {z_m:.3g m} up, at {time_s:.2f s} is more than the "
        "{dynamic_pa:.3g MPa} that the concrete bears: that nothing else cracks does not hold.",
        units,
        stress_pa=found["stress_pa"],
        where=place_said(found),
        z_m=found["z_m"],
        time_s=found["time_s"],
        dynamic_pa=strength["dynamic_pa"],
    )
