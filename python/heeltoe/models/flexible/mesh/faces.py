"""The two faces of a part of the dam as rows of elements follow them: no finer than the rows are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.mesh.rows import ROWS

# As a part of the height of a face: a crest that is uneven by less is level.
_LEVEL = 1e-4
# As a part of the width of an element: so closely rows follow a face with more kinks than they can have; twice as far
# off, and so on, where that leaves too many, but no farther than that.
_CLOSE, _FAR = 0.005, 0.16
# Kinks of a face for each row that a part would have without them, and how many are followed on any mesh.
_KINKS, _FEW = 2.0, 20.0


@dataclass(frozen=True, eq=False)
class Faces:
    """Faces that a mesh follows.

    Attributes
    ----------
    upstream, downstream
        From bottom to top (x, z) [m].
    missed
        How far corners of the section are from them at most [m].
    """

    upstream: Floats
    downstream: Floats
    missed: float


def followed(upstream: Floats, downstream: Floats, across: int, *, above: bool) -> Faces:
    """Return the faces of a part with no more kinks than rows of `across` elements can have; `above` the crack with a
    level crest."""
    faces = upstream, downstream
    if above:
        crest = max(face[-1, 1] for face in faces)
        slack = _LEVEL * (crest - min(face[0, 1] for face in faces))
        faces = _levelled(upstream, crest, slack), _levelled(downstream, crest, slack)
    width = abs(downstream[0, 0] - upstream[0, 0]) / across
    result = [_simpler(face, width, max(_FEW, _KINKS * ROWS * across)) for face in faces]
    return Faces(result[0][0], result[1][0], max(missed for _, missed in result))


def _levelled(face: Floats, crest: float, slack: float) -> Floats:
    """Return a face that ends where it comes to the crest."""
    below = np.flatnonzero(face[:, 1] < crest - slack)
    if below.size == 0 or below[-1] + 1 >= len(face) or np.all(face[below[-1] + 1 :, 1] == crest):
        return face
    level = face[: below[-1] + 2].copy()
    level[-1, 1] = crest
    return level


def _simpler(face: Floats, width: float, most: float) -> tuple[Floats, float]:
    """Return a face with few enough kinks, and what it misses."""
    if len(face) <= most:
        return face, 0.0
    line = simpler = shapely.LineString(face)
    tolerance = _CLOSE * width
    while len(simpler.coords) > most and tolerance <= _FAR * width:
        simpler = shapely.simplify(line, tolerance, preserve_topology=False)
        tolerance *= 2.0
    return np.array(simpler.coords), float(shapely.distance(simpler, shapely.points(face)).max())
