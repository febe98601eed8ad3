"""What is allowed in a case but seldom meant."""

from __future__ import annotations

from heeltoe.case.model import Case


def case_warnings(case: Case) -> tuple[str, ...]:
    """Return what is allowed in a case but seldom meant, a sentence each."""
    warnings = []
    if case.crack.mu_static > 2.0:
        warnings.append(
            f"crack: a coefficient of friction of {case.crack.mu_static:g} is higher than concrete has shown"
        )
    if case.uplift.intensity > 1.0:
        warnings.append(f"uplift.intensity: {case.uplift.intensity:g} means more pressure than the pattern gives")
    if not 1800.0 <= case.concrete.density <= 3200.0:
        warnings.append(f"concrete.density: {case.concrete.density:g} kg/m^3 is unusual for concrete")
    upstream = case.reservoir.depth if case.reservoir else 0.0
    if case.reservoir and 0.0 < upstream <= case.crack.elevation:
        warnings.append(
            "reservoir: it ends below the crack, so that no water presses on the part above or in the crack"
        )
    if case.ice and upstream - case.ice.depth < case.crack.elevation:
        warnings.append("ice: it acts below the crack, so that nothing of it is on the part above")
    if case.silt and case.silt.depth <= case.crack.elevation:
        warnings.append("silt: it ends below the crack, so that nothing of it is on the part above")
    if case.silt and case.silt.depth > upstream:
        warnings.append("silt.depth: the silt is higher than the water, though its densities are of silt under water")
    if case.silt and (case.silt.horizontal_density > 1000.0 or case.silt.vertical_density > 1300.0):
        warnings.append(
            f"silt: {case.silt.horizontal_density:g} and {case.silt.vertical_density:g} kg/m^3 look as if the water "
            "were in them; it is counted by itself"
        )
    if case.tailwater and case.tailwater.depth > upstream:
        warnings.append("tailwater.depth: the water is deeper downstream than upstream")
    return tuple(warnings)
