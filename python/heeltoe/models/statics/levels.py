"""How high the reservoir may stand until the usual loads become critical."""

from __future__ import annotations

from collections.abc import Callable

from heeltoe.case.model import Case
from heeltoe.models.statics.cases import at_depth, bond_of, usual
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.models.statics.own_criteria import criteria_of

# Depths that the search for a critical water level looks at: a sign that changes twice between two of them is no level
# that anyone could keep to.
_LEVELS = 60


def highest_level(case: Case) -> float:
    """Return how deep the reservoir is looked at [m]: to the crest, or to its flood where that is above."""
    section, water = case.cut, case.reservoir
    depths = (case.statics.flood_depth, water.depth if water else None)
    return max(section.crest_elevation - section.base_elevation, *(depth for depth in depths if depth is not None), 0.0)


def critical_water_levels(case: Case) -> dict[str, float | None]:
    """Return the depths of the reservoir at which the usual loads become critical; None where none is.

    What each means stands with :class:`heeltoe.models.statics.model.Statics`.

    The depth rises from the heel, or from the lowest point of the section where that is higher, to
    :func:`highest_level`; the tailwater stays, and so does the ice, pushed up with the surface.
    """
    section = case.cut
    highest = highest_level(case)
    lowest = section.heel[1] - section.base_elevation
    if case.ice is not None:
        lowest = max(lowest, case.ice.depth)
    bond = bond_of(case)
    counted = bond.cohesion > 0.0 and bond.start < section.crack_width
    rows = criteria_of(case, "usual", cohesion=counted)
    # Criteria of a user's own may ask for none.
    required = next((row.required for row in rows if row.check == "sliding"), None)
    known: dict[float, LoadCase] = {}

    def state(depth: float) -> LoadCase:
        if depth not in known:
            known[depth] = usual(at_depth(case, depth)).load_case
        return known[depth]

    def sliding(factor: float) -> Callable[[float], float]:
        def margin(depth: float) -> float:
            result = state(depth)
            strength = result.cohesive_force_n + result.friction * max(0.0, result.normal_force_n)
            if result.sliding_factor is not None and result.pieces_bear == "less":
                strength = result.sliding_factor * abs(result.shear_force_n)
            return strength - factor * max(0.0, result.shear_force_n)

        return margin

    def overturning(depth: float) -> float:
        # A crack that goes through has no resultant to follow: the change of sign is a jump. What an empty reservoir
        # lets fall upstream is not overturned by water.
        result = state(depth)
        return 1.0 if result.outcome == "stands" or result.cracked_from == "toe" else -1.0

    margins: dict[str, Callable[[float], float]] = {
        "sliding": sliding(1.0),
        "sliding_required": sliding(0.0 if required is None else required),
        "overturning": overturning,
        "flotation": lambda depth: state(depth).normal_force_n,
    }
    depths = [lowest + (highest - lowest) * step / _LEVELS for step in range(_LEVELS + 1)]
    return {name: _first_zero(margin, depths) for name, margin in margins.items()}


def _first_zero(margin: Callable[[float], float], depths: list[float]) -> float | None:
    """Return the first depth at which a margin falls below zero; the lowest where it starts there."""
    from scipy.optimize import brentq

    for low, high in zip([depths[0], *depths[:-1]], depths, strict=True):
        if margin(high) < 0.0:
            return high if low == high else float(brentq(margin, low, high, xtol=1e-9, rtol=1e-12))
    return None
