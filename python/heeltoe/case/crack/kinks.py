"""A crack that is not straight: what is wrong with its kinks."""

from __future__ import annotations

import math
from itertools import pairwise

import shapely

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError, shown
from heeltoe.geometry.section import CutSection, on_line

Kinks = tuple[tuple[float, float], ...]

# Of a piece of the line, to the straight line from heel to toe and to the horizontal [rad]: on a steeper one a node
# has no place that is told by its distance from the heel.
_STEEPEST = math.radians(60.0)


def kinks_misfit(
    kinks: Kinks, section: CutSection, outline: shapely.Polygon, line: Floats, field: str
) -> InputError | None:
    """Return what is wrong with the kinks of a crack.

    Parameters
    ----------
    kinks
        Along and above the straight line from heel to toe [m].
    section
        The part above that line.
    outline
        The whole section [m].
    line
        Corners of the crack from heel to toe (x, z), shape (k, 2) [m].
    field
        Path of the kinks, for the error.
    """
    distances = [distance for distance, _ in kinks]
    if distances[0] <= 0.0 or any(a >= b for a, b in pairwise(distances)):
        return InputError(
            "not-ascending",
            field,
            shown(distances),
            what="the distances",
            remedy="the kinks from heel to toe",
        )
    if distances[-1] >= section.crack_width:
        return InputError(
            "out-of-range",
            field,
            f"{distances[-1]:g} m",
            bound=f"below {section.crack_width:g} m, the crack's width",
        )
    for (start, low), (end, high) in pairwise(corners(section, kinks)):
        angle = math.atan2(high - low, end - start)
        steepest = max(abs(angle), abs(angle + section.inclination))
        if steepest > _STEEPEST:
            limit = f"{math.degrees(_STEEPEST):g} deg"
            return InputError(
                "kinks-steep", field, f"{math.degrees(steepest):.3g} deg", start=f"{start:g} m", most=limit
            )
    if outline.area - section.area <= 1e-9 * section.area:
        return InputError("kinks-base", field)
    if not outline.buffer(on_line(outline)).covers(shapely.LineString(line)):
        return InputError("kinks-leave", field, shown([list(kink) for kink in kinks]))
    return None


def climbs(kinks: Kinks) -> bool:
    """Whether a crack with these kinks leaves the straight line from heel to toe."""
    return any(height for _, height in kinks)


def corners(section: CutSection, kinks: Kinks) -> list[tuple[float, float]]:
    """Return the corners of a crack from heel to toe, along and above the straight line between them [m]."""
    return [(0.0, 0.0), *kinks, (section.crack_width, 0.0)]
