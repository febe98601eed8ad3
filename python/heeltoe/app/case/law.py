"""The curve of the friction law of a case, as the page draws it."""

from __future__ import annotations

from typing import Any

from heeltoe.case.crack.law import Law
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.law_curve import SAMPLES, LawCurve, curve_of
from heeltoe.units.sentences import written
from heeltoe.units.systems import unit_system

# Of its points so many are one that is drawn.
_EVERY = 4
_KINDS = {"slip path": "displacement", "slip speed": "velocity", "normal stress": "pressure"}


def law(case: Case, units: str) -> dict[str, Any] | None:
    """Return the curve of the law of a case under its static loads; None where it has no law, or no curve."""
    if case.crack.law is None:
        return None
    try:
        return _drawn(curve_of(case), units, _samples(case.crack.law))
    except InputError:
        return None


def _drawn(curve: LawCurve, units: str, samples: list[str]) -> dict[str, Any]:
    scale = unit_system(units).scale(_KINDS[curve.over], float(curve.at[-1]))
    kept = [*range(0, len(curve.at) - 1, _EVERY), len(curve.at) - 1]
    stress = written("{stress_pa:.3g MPa}", units, stress_pa=curve.normal_stress_pa)
    sentence = f"The dot: before any slip {curve.at_rest:.3g}, under {stress} from the static loads."
    if samples:
        sentence += f" Sample numbers, those of no dam: {', '.join(samples)}. Give your own."
    return {
        "over": f"{curve.over} [{scale.unit}]",
        "at": [float(f"{value:.5g}") for value in scale(curve.at[kept])],
        "friction": [float(f"{value:.5g}") for value in curve.friction[kept]],
        "dot": [float(scale(curve.normal_stress_pa)) if curve.over == "normal stress" else 0.0, curve.at_rest],
        "sentence": sentence,
    }


def _samples(law: Law) -> list[str]:
    """Return what of a law stands as it begins with."""
    begins = Law(name=law.name, **SAMPLES[law.name])
    return [
        name.replace("_", " ")
        for name in SAMPLES[law.name]
        # The peak is that of the coefficient before.
        if name != "peak_friction" and getattr(law, name) == getattr(begins, name)
    ]
