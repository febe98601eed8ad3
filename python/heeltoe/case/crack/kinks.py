"""A crack that is not straight: what is wrong with its kinks, and what they do not go with."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

import shapely

from heeltoe.errors import InputError, shown
from heeltoe.geometry.section import CutSection, on_line

if TYPE_CHECKING:
    from heeltoe.case.model import Case

# Of a piece of the line, to the straight line from heel to toe and to the horizontal [rad]: on a steeper one a node
# has no place that is told by its distance from the heel.
_STEEPEST = math.radians(60.0)


def kinks_alone(case: Case) -> Iterator[InputError]:
    """Walk what of a case does not go with a crack that is not straight."""
    if not any_kinks(case):
        return
    if case.crack.roughness is not None:
        yield InputError("kinks-beside", "crack.roughness")
    if case.uplift.during_shaking != "constant":
        yield InputError("kinks-value", "uplift.during_shaking", shown(case.uplift.during_shaking))
    if case.flexible.contact == "idce":
        yield InputError("kinks-value", "flexible.contact", shown("idce"))
    for name in ("mesh_above", "mesh_below", "elements_across_below"):
        if getattr(case.flexible, name) is not None:
            yield InputError("kinks-beside", f"flexible.{name}")


def any_kinks(case: Case) -> bool:
    """Whether a crack of a case is not straight."""
    return bool(case.crack.kinks or any(crack.kinks for crack in case.further_cracks))


def kinks_misfit(alone: Case, crack: str) -> InputError | None:
    """Return what is wrong with the kinks of a crack in its section, of the case with it `alone`."""
    section, kinks, field = alone.cut, alone.crack.kinks, f"{crack}.kinks"
    if not kinks:
        return None
    distances = [distance for distance, _ in kinks]
    if distances[0] <= 0.0 or any(a >= b for a, b in pairwise(distances)):
        return InputError("kinks-order", field, shown(distances))
    if distances[-1] >= section.crack_width:
        return InputError("kinks-outside", field, f"{distances[-1]:g} m", width=f"{section.crack_width:g} m")
    for (start, low), (end, high) in pairwise(corners(section, kinks)):
        angle = math.atan2(high - low, end - start)
        steepest = max(abs(angle), abs(angle + section.inclination))
        if steepest > _STEEPEST:
            most = f"{math.degrees(_STEEPEST):g} deg"
            return InputError(
                "kinks-steep", field, f"{math.degrees(steepest):.3g} deg", start=f"{start:g} m", most=most
            )
    if alone.outline.area - section.area <= 1e-9 * section.area:
        return InputError("kinks-base", field)
    if not alone.outline.buffer(on_line(alone.outline)).covers(shapely.LineString(alone.crack_line)):
        return InputError("kinks-leave", field, shown([list(kink) for kink in kinks]))
    return None


def climbs(kinks: tuple[tuple[float, float], ...]) -> bool:
    """Whether a crack with these kinks leaves the straight line from heel to toe."""
    return any(height for _, height in kinks)


def corners(section: CutSection, kinks: tuple[tuple[float, float], ...]) -> list[tuple[float, float]]:
    """Return the corners of a crack from heel to toe, along and above the straight line between them [m]."""
    return [(0.0, 0.0), *kinks, (section.crack_width, 0.0)]


def straight_crack(case: Case, model: str) -> None:
    """Refuse a case whose crack is not straight for what knows straight ones alone.

    Raises
    ------
    InputError
        Then.
    """
    kinks = {"crack": case.crack.kinks}
    kinks |= {f"further_cracks[{place}]": crack.kinks for place, crack in enumerate(case.further_cracks)}
    for crack, found in kinks.items():
        if found:
            raise InputError("kinks-straight", f"{crack}.kinks", model=model)
