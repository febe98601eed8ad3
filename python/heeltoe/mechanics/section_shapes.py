"""Shapes of a drawing of a section from the back to the front: water, silt, ice, ground, dam."""

from __future__ import annotations

from collections.abc import Iterator

import shapely

from heeltoe.case.model import Case
from heeltoe.geometry.beside import beside

# How far water, silt, ice and ground reach, and how thin an ice cover can be and still be seen: parts of the size.
_FAR, _THINNEST = 10.0, 0.008


def section_shapes(case: Case) -> Iterator[tuple[str, shapely.Geometry]]:
    """Walk the shapes of a section [m] by kind: "water", "silt", "ice", "ground", and the dam "below" the crack, behind
    its part "above" it."""
    left, base, right, crest = case.outline.bounds
    size = max(right - left, crest - base)
    far = _FAR * size
    for water, side in ((case.reservoir, "left"), (case.tailwater, "right")):
        if water is not None and water.depth:
            yield "water", beside(case.outline, base + water.depth, far, side)
    if case.silt is not None and case.silt.depth:
        yield "silt", beside(case.outline, base + case.silt.depth, far, "left")
    if case.ice is not None and case.reservoir is not None:
        level = base + case.reservoir.depth
        bottom = level - max(2.0 * case.ice.depth, _THINNEST * size)
        open_water = shapely.box(left - 3.0 * far, base - far, right + far, bottom)
        yield "ice", beside(case.outline, level, far, "left") - open_water
    yield "ground", shapely.box(left - far, base - size, right + far, base)
    yield "below", case.outline
    yield "above", shapely.Polygon(case.above.polygon)
