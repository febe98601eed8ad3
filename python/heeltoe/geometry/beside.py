"""Bodies beside a section up to a level: water, silt."""

from __future__ import annotations

import shapely


def beside(whole: shapely.Polygon, level: float, far: float, side: str) -> shapely.Geometry:
    """Return what is beside a section, up to a level.

    Parameters
    ----------
    whole
        The section [m].
    level
        Of the surface [m].
    far
        How far it reaches from the section [m].
    side
        ``"left"`` or ``"right"``.
    """
    left, base, right, top = whole.bounds
    around = shapely.box(left - far, base, right + far, level)
    if level > top:
        # What stands above the crest ends at its far edge.
        crest = [x for x, z in shapely.get_coordinates(whole).tolist() if z == top]
        start, end = (max(crest), right + far) if side == "left" else (left - far, min(crest))
        around -= shapely.box(start, base, end, level)
    edge = shapely.box(left - 2.0 * far, base, left - 0.5 * far, level)
    if side == "right":
        edge = shapely.box(right + 0.5 * far, base, right + 2.0 * far, level)
    parts = [part for part in shapely.get_parts(around - whole) if part.intersects(edge)]
    return shapely.union_all(parts)
