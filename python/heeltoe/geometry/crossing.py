"""Where straight lines through a dam, anchors and drains, cross its crack, and where they end in its faces."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from heeltoe.base.arrays import Floats
from heeltoe.geometry.section import ON_LINE, CutSection

Place = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Crossing:
    """Where a line crosses a crack, or the cracks of columns.

    Attributes
    ----------
    crossed
        Whether it does, with an end on either side.
    distance
        From the heel along the crack [m].
    inclination
        Of the line to the normal of the crack, positive where its upper end leans downstream [rad].
    """

    crossed: Any
    distance: Any
    inclination: Any


def crossing(section: CutSection, one: Place, other: Place) -> Crossing:
    """Return where the line between two places (x, z) [m] crosses the crack of a section."""
    heel = section.heel
    along, low = section.in_crack_frame(one[0] - heel[0], one[1] - heel[1])
    # Not from the difference of two such, so that a level crack's angle is the same wherever it is.
    ahead, rise = section.in_crack_frame(other[0] - one[0], other[1] - one[1])
    high = low + rise
    slack = ON_LINE * section.crack_width
    apart = ((low < -slack) & (high > slack)) | ((high < -slack) & (low > slack))
    distance = along - low / np.where(apart, rise, 1.0) * ahead
    crossed = apart & (distance >= -slack) & (distance <= section.crack_width + slack)
    up = np.where(np.asarray(rise) >= 0.0, 1.0, -1.0)
    inclination = np.arctan2(up * ahead, np.abs(rise))
    return Crossing(crossed, np.clip(distance, 0.0, section.crack_width), inclination)


def head(section: CutSection, distance: float, inclination: float) -> Place:
    """Return where a line that crosses the crack leaves the part above it (x, z) [m].

    Parameters
    ----------
    section
        With one crack.
    distance, inclination
        Where the line crosses, as :class:`Crossing` has them.
    """
    start = np.array(section.heel) + section.from_crack_frame(distance, 0.0)
    axis = np.array(section.from_crack_frame(math.sin(inclination), math.cos(inclination)))
    reach = 4.0 * (section.crest_elevation - section.base_elevation + section.crack_width)
    inside = shapely.intersection(shapely.Polygon(section.polygon), shapely.LineString([start, start + reach * axis]))
    ends: Floats = shapely.get_coordinates(inside)
    if not len(ends):
        return float(start[0]), float(start[1])
    x, z = ends[np.argmax((ends - start) @ axis)]
    return float(x), float(z)


def on_face(face: Floats, place: Place, slack: float) -> bool:
    """Whether a place is on a face, its corners (k, 2), to within `slack` [m]."""
    return bool(shapely.distance(shapely.LineString(face), shapely.Point(place)) <= slack)
