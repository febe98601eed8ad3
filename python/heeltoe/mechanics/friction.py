"""The friction law of a crack as the kernels know it, and what it comes to: peak, residual and apparent friction."""

from __future__ import annotations

import math
from collections.abc import Callable

from heeltoe.case.crack.crack import Crack
from heeltoe.case.crack.law import Law
from heeltoe.kernel.friction import FrictionLaw, friction_law, shear_stress
from heeltoe.mechanics.references import cited

# Less pressed than this, a crack has the friction of this normal stress [Pa].
_LEAST_STRESS = 1.0
#: A way and a speed by which every law has lost all that it can.
FAR, FAST = 1e9, 1e9


def law_of(law: Law) -> FrictionLaw:
    """Return a law of a case for the kernels."""
    peak, residual = law.peak_friction or 0.0, law.residual_friction or 0.0
    slip = law.slip or 0.0
    if law.name == "slip weakening":
        return friction_law(f"{law.form} slip weakening", {"peak": peak, "residual": residual, "scale": slip})
    if law.name == "speed weakening":
        return friction_law(law.name, {"peak": peak, "residual": residual, "scale": law.speed or 0.0})
    if law.name == "cohesion":
        numbers = {"peak": residual, "residual": residual, "cohesion": law.cohesion or 0.0, "loss": slip}
        return friction_law("constant", numbers)
    if law.name == "barton-bandis":
        angle = law.residual_angle or 0.0
        return friction_law(
            law.name, {"roughness": law.jrc or 0.0, "wall_strength": law.jcs or 0.0, "residual_angle": angle}
        )
    return friction_law(law.name, {"residual": law.basic_friction or 0.0}, law.roughness_friction or ())


def constant_law(crack: Crack) -> FrictionLaw:
    """Return the law of constant coefficients of a crack that has no other."""
    return friction_law("constant", {"peak": crack.mu_static, "residual": crack.mu_kinetic})


def crack_law(crack: Crack) -> FrictionLaw:
    """Return the law of a crack, whichever it is."""
    return constant_law(crack) if crack.law is None else law_of(crack.law)


#: At rest and sliding; or a coefficient of friction and a cohesion [Pa].
Pair = tuple[float, float]


def coefficients(law: FrictionLaw, stress: float, path: float = 0.0, speed: float = 0.0, bond: float = 0.0) -> Pair:
    """Return the shear stress borne at rest and sliding over the normal stress [Pa]; with its bond where that is 1."""
    pressed = max(stress, _LEAST_STRESS)
    at_rest, sliding = shear_stress(law, pressed, path, speed, bond) / pressed
    return float(at_rest), float(sliding)


def friction_of(crack: Crack, normal_force: float, width: float) -> Pair:
    """Return the friction of a crack under its static loads: at rest before any slip, with its bond, and sliding after
    all of it; by a law, those of the mean normal stress."""
    if crack.law is None:
        return crack.apparent_friction, crack.mu_kinetic
    law, stress = law_of(crack.law), normal_force / width
    at_rest, _ = coefficients(law, stress, bond=1.0)
    _, sliding = coefficients(law, stress, FAR, FAST)
    return at_rest, min(sliding, at_rest)


def peak_of(crack: Crack) -> Callable[[float], Pair] | None:
    """Return what gives the coefficient of friction and the cohesion [Pa] before any slip by the normal stress [Pa];
    None where the coefficients are constant."""
    return _borne(crack, 0.0, 1.0)


def residual_of(crack: Crack) -> Callable[[float], Pair] | None:
    """The same after all slip, at rest again: nothing is left of a bond, and of the friction what slip leaves."""
    return _borne(crack, FAR, 0.0)


def _borne(crack: Crack, path: float, bond: float) -> Callable[[float], Pair] | None:
    if crack.law is None:
        return None
    law, cohesion = law_of(crack.law), bond * (crack.law.cohesion or 0.0)
    return lambda stress: (coefficients(law, stress, path)[0], cohesion)


def references_of_law(law: Law) -> tuple[str, ...]:
    """Return the sources of a law."""
    return cited(f"law: {law.name}")


def range_of(law: Law, stress: float) -> str | None:
    """Say in what a mean normal stress [Pa] is outside the range for which a law is valid; None where it is not."""
    if law.name == "barton-bandis" and law.jcs is not None and law.jrc:
        added = law.jrc * math.log10(law.jcs / max(stress, _LEAST_STRESS))
        if added < 0.0:
            return "more than the strength of the walls: nothing is left of their roughness"
        if math.degrees(law.residual_angle or 0.0) + added > 70.0:
            return "so little that the angle of friction would exceed 70 degrees, at which it is held"
    points = law.roughness_friction
    if points and not points[0][0] <= stress <= points[-1][0]:
        return "beyond the points of roughness_friction, of which the last one is kept"
    return None
