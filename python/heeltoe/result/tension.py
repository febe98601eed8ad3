"""The largest tension of a run in words, and what it means where the concrete does not bear it."""

from __future__ import annotations

from heeltoe.result.numbers import StressPlace, Tension
from heeltoe.units.sentences import written

# What parts are called where there are several cracks.
_PART_NAMES = {
    "uppermost": "the part above all cracks",
    "between": "the part between two cracks",
    "lowest": "the part below all cracks",
}


def place_phrase(stress: StressPlace) -> str:
    """Say where a largest stress is, its height apart."""
    part = _PART_NAMES.get(stress.part, f"the part {stress.part} the crack")
    face = "" if stress.place == "base" else " face"
    return f"inside {part}" if stress.place == "inside" else f"at the {stress.place}{face} of {part}"


def tension_sentence(tension: Tension | None, units: str) -> str:
    """Say that the largest tension exceeds the strength of the concrete; empty where it does not, or where it is not
    known."""
    strength = None if tension is None else tension.strength
    if tension is None or strength is None or not strength.exceeds:
        return ""
    return written(
        "Its tension of {stress_pa:.3g MPa} {where}, {z_m:.3g m} up, at {time_s:.2f s} is more than the "
        "{dynamic_pa:.3g MPa} that the concrete bears, so the assumption of no further cracking is not valid.",
        units,
        stress_pa=tension.stress_pa,
        where=place_phrase(tension),
        z_m=tension.z_m,
        time_s=tension.time_s,
        dynamic_pa=strength.dynamic_pa,
    )
