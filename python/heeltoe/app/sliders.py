"""The sliders of the answer: which fields of a case they move, from where to where, and where they stand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from heeltoe.base.payload import Json
from heeltoe.case.model import Case
from heeltoe.units.parse import Acceleration, InSI
from heeltoe.units.sentences import quantity
from heeltoe.units.systems import FOOT, unit_system

# Where drains are put that the case does not have: a part of the width of the crack.
_DRAINS_AT = 0.1
# Of joints, and twice that of their shear [Pa].
_MOST_TENSION, _MOST_COHESION = 3e6, 6e6
# The end of a line, less what rounding takes.
_WITHIN = 1.0 - 1e-9
_FEET, _METRES = (FOOT, "ft"), (1.0, "m")


@dataclass(frozen=True)
class Slider:
    """One slider.

    Attributes
    ----------
    path
        The field of the case.
    label
        What people call it.
    least, most, step, value
        In `unit`.
    unit, si
        Empty where it has none, and how much of SI one of it is.
    off
        Why it cannot be moved; empty where it can.
    """

    path: str
    label: str
    least: float
    most: float
    step: float
    value: float
    unit: str = ""
    off: str = ""
    si: float = 1.0


def sliders(case: Case, units: str) -> list[Slider]:
    """Return the sliders of a case, each where the case is."""
    crack, which = case.crack, _which(case, units)
    pga = None if case.motion is None or case.motion.pga is None else case.motion.pga.si(case.gravity) / case.gravity
    efficiency = case.uplift.drain_efficiency
    no_water = "" if case.reservoir else "The case has no reservoir."
    of_crack = [
        _friction(case),
        _with(Slider("crack.restitution", "Restitution", 0.0, 1.0, 0.01, crack.restitution)),
        *_strengths(case, units),
    ]
    friction, *others = (replace(slider, label=slider.label + which) for slider in of_crack)
    return [
        friction,
        _with(_water(case, units)),
        *others,
        _with(Slider("motion.pga", "Peak acceleration", 0.02, 1.0, 0.01, pga or 0.4, "g")),
        Slider("uplift.drain_efficiency", "Drain efficiency", 0.0, 1.0, 0.01, efficiency or 0.0, off=no_water),
    ]


def _which(case: Case, units: str) -> str:
    """Say which of several cracks a slider is of."""
    if not case.further_cracks:
        return ""
    kind = "crack" if case.crack.bond is None else "joint"
    return f", {kind} at {quantity(case.crack.elevation, '.4g m', units)}"


def _friction(case: Case) -> Slider:
    """Return the slider of the coefficient, which a friction law has no place for."""
    crack = case.crack
    if crack.law is not None:
        reason = f"The law {crack.law.name} gives the friction of the crack."
        return Slider("crack.friction", "Friction coefficient", 0.3, 2.0, 0.01, 1.0, off=reason)
    # The line of a joint's shear strength ends at its tensile strength.
    most = 2.0 if crack.bond is None else min(2.0, _WITHIN * crack.bond.cohesion / crack.bond.tensile_strength)
    return _with(Slider("crack.friction", "Friction coefficient", min(0.3, most), most, 0.01, crack.mu_static))


def _strengths(case: Case, units: str) -> Iterator[Slider]:
    """Return the sliders of the strengths of a bonded joint; neither leaves the line of the shear strength, which ends
    at the tensile strength."""
    bond, friction = case.crack.bond, max(case.crack.mu_static, case.crack.mu_kinetic)
    if bond is None:
        return
    scale = unit_system(units).scale("pressure")
    si = 1.0 / scale.factor
    tension, cohesion = scale(bond.tensile_strength), scale(bond.cohesion)
    step = 0.01 if units == "si" else 1.0
    most = min(scale(_MOST_TENSION), _WITHIN * cohesion / friction if friction else cohesion)
    yield _with(Slider("crack.bond.tensile_strength", "Tensile strength", step, most, step, tension, scale.unit, si=si))
    least, most = max(step, friction * tension / _WITHIN), scale(_MOST_COHESION)
    yield _with(Slider("crack.bond.cohesion", "Cohesion", least, most, step, cohesion, scale.unit, si=si))


def _water(case: Case, units: str) -> Slider:
    metres, unit = _FEET if units == "us" else _METRES
    height = (case.cut.crest_elevation - case.cut.base_elevation) / metres
    step = 10.0 ** max(-3, len(str(int(height))) - 4)
    depth = 0.0 if case.reservoir is None else case.reservoir.depth / metres
    # Rounding up would put the surface above the crest.
    return Slider("reservoir.depth", "Water level", 0.0, int(height / step + 1e-9) * step, step, depth, unit, si=metres)


def _with(slider: Slider) -> Slider:
    """Return a slider that reaches as far as the value that the case has."""
    low, high = min(slider.least, slider.value), max(slider.most, slider.value)
    return replace(slider, least=low, most=high)


def change(slider: Slider, value: float, case: Case) -> Json:
    """Return what a slider at `value` changes in a case, in SI by the paths of :meth:`heeltoe.Case.with_numbers`."""
    if slider.path == "uplift.drain_efficiency" and case.uplift.pattern != "drained":
        return {"uplift.pattern": "drained", "uplift.drain_position": _DRAINS_AT, slider.path: value}
    if slider.unit == "g":
        return {slider.path: Acceleration(value, in_g=True)}
    return {slider.path: InSI(value * slider.si, f"{value:.10g} {slider.unit}") if slider.unit else value}
