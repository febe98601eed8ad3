"""The section of the dam and its part above the crack."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely

from heeltoe.base.arrays import Floats, number, ratio
from heeltoe.base.frozen import ReadOnlyArrays
from heeltoe.errors.error import InputError, shown

ON_LINE = 1e-9
"""What is so close to a line, as a part of the section's size, is on it: far above rounding, far below any drawing."""
# A section outside these [m] has a wrong unit; far outside, areas and inertias overflow.
_SMALLEST, _LARGEST = 1e-3, 1e4


class Edge(NamedTuple):
    """A piece of a face, on the way up: from (x0, z0) to (x1, z1), both counted from the heel [m], and how far it goes
    downstream for each metre of its rise; zero of a level one."""

    x0: float
    z0: float
    x1: float
    z1: float
    slope: float


@dataclass(frozen=True, eq=False)
class CutSection(ReadOnlyArrays):
    """The part of the section above the crack, x downstream and z up, in the coordinates of the case.

    Parameters
    ----------
    polygon
        Corners, counter-clockwise from the heel, shape (n, 2), not closed [m].
    area
        Area [m^2].
    centroid
        Centroid (x, z) [m].
    polar_inertia
        Polar second moment of area about the centroid [m^4].
    heel, toe
        Upstream and downstream end (x, z) of the crack [m].
    upstream_face
        From the heel up to the crest, shape (k, 2) [m].
    downstream_face
        From the toe up to the crest, shape (k, 2) [m].
    base_elevation, crest_elevation
        z of the lowest and of the highest point of the whole section [m].
    inclination
        Angle of the crack to the horizontal, positive where it rises downstream [rad].
    """

    polygon: Floats
    area: float
    centroid: tuple[float, float]
    polar_inertia: float
    heel: tuple[float, float]
    toe: tuple[float, float]
    upstream_face: Floats
    downstream_face: Floats
    base_elevation: float
    crest_elevation: float
    inclination: float

    @cached_property
    def crack_width(self) -> float:
        """Distance from heel to toe [m]."""
        return number(np.hypot(self.toe[0] - self.heel[0], self.toe[1] - self.heel[1]))

    @property
    def crack_elevation(self) -> float:
        """z of the heel [m]; the case counts it from the lowest point instead."""
        return self.heel[1]

    @cached_property
    def upstream_edges(self) -> tuple[Edge, ...]:
        """The pieces of the upstream face."""
        return self._edges(self.upstream_face)

    @cached_property
    def downstream_edges(self) -> tuple[Edge, ...]:
        """The pieces of the downstream face."""
        return self._edges(self.downstream_face)

    def _edges(self, face: Floats) -> tuple[Edge, ...]:
        points = face.tolist() if face.ndim == 2 else face
        corners = [(x - self.heel[0], z - self.heel[1]) for x, z in points]
        return tuple(Edge(x0, z0, x1, z1, ratio(x1 - x0, z1 - z0)) for (x0, z0), (x1, z1) in pairwise(corners))

    @cached_property
    def level(self) -> bool:
        """Whether the crack is."""
        return not np.any(self.inclination)

    @cached_property
    def _along(self) -> tuple[float, float]:
        """x and z of the unit vector along the crack."""
        return number(np.cos(self.inclination)), number(np.sin(self.inclination))

    @property
    def centroid_from_heel(self) -> tuple[float, float]:
        """The centroid (x, z), seen from the heel [m]."""
        return self.centroid[0] - self.heel[0], self.centroid[1] - self.heel[1]

    def in_crack_frame(self, x: float, z: float) -> tuple[float, float]:
        """Return the components of a vector (x, z) along the crack, downstream, and across it, upwards."""
        if self.level:
            return x, z
        down, up = self._along
        return down * x + up * z, down * z - up * x

    @property
    def height(self) -> float:
        """From the crack to the crest [m]."""
        return self.crest_elevation - self.crack_elevation

    def from_crack_frame(self, along: float, across: float) -> tuple[float, float]:
        """Return (x, z) of a vector with components along and across the crack."""
        if self.level:
            return along, across
        down, up = self._along
        return down * along - up * across, up * along + down * across


def outline(corners: Sequence[tuple[float, float]], field: str = "section.polygon") -> shapely.Polygon:
    """Return a whole section, counter-clockwise [m].

    Parameters
    ----------
    corners
        (x, z) around the section, either way [m].
    field
        What the user gave them by, for the error.

    Raises
    ------
    InputError
        Where the corners are too few, or the outline crosses or touches itself.
    """
    if len(set(corners)) < 3:
        raise InputError("too-few", field, f"{len(set(corners))} different corners", least="3")
    spread = max(max(axis) - min(axis) for axis in zip(*corners, strict=True))
    farthest = max(max(map(abs, corner)) for corner in corners)
    if not _SMALLEST <= spread <= _LARGEST or farthest > 1e3 * _LARGEST:
        raise InputError("out-of-range", field, f"{spread:g} m", bound="from 1 mm to 10 km, the size of a dam")
    whole = shapely.Polygon(corners)
    if not whole.is_valid or whole.area <= ON_LINE * whole.length**2:
        raise InputError("polygon-crossing", field, shown([list(corner) for corner in corners]))
    return shapely.geometry.polygon.orient(whole)


def cut(whole: shapely.Polygon, elevation: float, inclination: float = 0.0) -> CutSection:
    """Return the part of a section above a crack.

    Parameters
    ----------
    whole
        The section, from :func:`outline` [m].
    elevation
        Height of the crack at the upstream face above the lowest point of the section [m].
    inclination
        Angle of the crack to the horizontal, positive where it rises downstream [rad].

    Raises
    ------
    InputError
        Where the crack does not cut the section in two along one line.
    """
    _, base, _, crest = whole.bounds
    slack = on_line(whole)
    elevation = elevation if elevation > slack else 0.0
    if outside(whole, elevation):
        raise InputError(
            "out-of-range",
            "crack.elevation",
            f"{elevation:g} m",
            bound=f"from 0 m to below the crest at {crest - base:g} m",
        )
    level = base + elevation
    if inclination:
        corners = _cut_inclined(whole, level, inclination, slack)
    else:
        corners = _cut_level(whole, level, slack, elevation)
    return _measured(corners, base, crest)


def outside(whole: shapely.Polygon, elevation: float) -> bool:
    """Whether an elevation above the lowest point of a section [m] has nothing of it above; row by row of columns."""
    _, base, _, crest = whole.bounds
    none: bool = elevation >= crest - base - on_line(whole)
    return none


def on_line(whole: shapely.Polygon) -> float:
    """Return how close to a line of a section something is on it [m]."""
    left, base, right, crest = whole.bounds
    slack: float = ON_LINE * max(right - left, crest - base)
    return slack


def _cut_inclined(whole: shapely.Polygon, level: float, inclination: float, slack: float) -> Floats:
    """Return the corners above a crack that starts at `level` on the upstream face: turned until it is level, cut as
    a level one and turned back."""
    left, _, right, _ = whole.bounds
    line = shapely.LineString([(left - 1.0, level), (right + 1.0, level)])
    heel = np.array([shapely.intersection(whole, line).bounds[0], level])
    down, up = math.cos(inclination), math.sin(inclination)
    turn = np.array([[down, up], [-up, down]])
    turned = shapely.transform(whole, lambda corners: (corners - heel) @ turn.T)
    if inclination < 0.0 and level == whole.bounds[1]:
        raise InputError("crack-leaves-base", "crack.elevation", f"{math.degrees(-inclination):.3g} degrees")
    corners = _cut_level(turned, 0.0, slack, level - whole.bounds[1])
    if abs(corners[0, 0]) > slack:
        # Under an overhang the line is in concrete on either side of the heel.
        raise InputError("crack-overhang", "crack.inclination", f"{math.degrees(inclination):g} deg")
    back: Floats = corners @ turn + heel
    # The crest, whose corners tell the two faces apart, must be level again to the last bit.
    for corner in shapely.get_coordinates(whole):
        back[np.all(np.abs(back - corner) <= slack, axis=1)] = corner
    return back


def _cut_level(whole: shapely.Polygon, level: float, slack: float, elevation: float) -> Floats:
    """Return the corners of the part above a level crack, from the heel round; `elevation` is that of the case."""
    left, base, right, crest = whole.bounds
    size = max(right - left, crest - base)
    whole = _snapped(whole, level, slack)
    above = shapely.box(left - size, level, right + size, crest + size)
    below = shapely.box(left - size, base - size, right + size, level)
    upper = _snapped(_solid(shapely.intersection(whole, above)), level, slack)
    # At the base the block stands on all of its lower edge; higher up, on what both parts share (a ledge
    # sticks out of one of them).
    lower = _snapped(_solid(shapely.intersection(whole, below)), level, slack)
    contact = shapely.intersection(upper, lower)
    if upper.geom_type == "Polygon" and contact.geom_type == "Point":
        raise InputError("crack-no-width", "crack.elevation", f"{elevation:g} m")
    crack = shapely.line_merge(contact) if contact.geom_type == "MultiLineString" else contact
    if upper.geom_type != "Polygon" or crack.geom_type != "LineString":
        raise InputError("crack-pieces", "crack.elevation", f"{elevation:g} m")
    start, _, end, _ = crack.bounds
    return _ring(upper, start, end, level, slack)


def _solid(shape: shapely.Geometry) -> shapely.Geometry:
    """Drop the edges of the other part that lie on the crack line."""
    if shape.geom_type != "GeometryCollection":
        return shape
    return shapely.union_all([part for part in shape.geoms if part.area > 0.0])


def _snapped(shape: shapely.Geometry, level: float, slack: float) -> shapely.Geometry:
    """Put corners that are within `slack` of the crack line onto it, so that rounding cuts off no sliver."""

    def snap(corners: Floats) -> Floats:
        z = corners[:, 1]
        return np.column_stack([corners[:, 0], np.where(np.abs(z - level) <= slack, level, z)])

    return shapely.transform(shape, snap)


def _ring(upper: shapely.Polygon, start: float, end: float, level: float, slack: float) -> Floats:
    """Return the corners of the upper part: heel, toe, up the downstream face, down the upstream face."""
    corners = shapely.get_coordinates(shapely.geometry.polygon.orient(upper).exterior)[:-1]
    x, z = corners.T
    # What lies on the crack line from heel to toe goes; the two ends come instead, also where an overhang
    # reaches past them.
    inside = (z == level) & (x >= start - slack) & (x <= end + slack)
    following = np.roll(corners, -1, axis=0)
    on_line = (z == level) & (following[:, 1] == level)
    covering = on_line & (x <= start + slack) & (following[:, 0] > start + slack)
    first = int(np.flatnonzero(covering)[0])
    rolled = np.roll(np.column_stack([corners, inside]), -first - 1, axis=0)
    rest = rolled[rolled[:, 2] == 0.0, :2]
    return np.vstack([[start, level], [end, level], rest])


def _measured(corners: Floats, base: float, crest: float) -> CutSection:
    """Measure the upper part; its corners start with heel and toe."""
    top = np.flatnonzero(corners[:, 1] == crest)
    upstream = np.vstack([corners[:1], corners[: top[-1] - 1 : -1]])
    downstream = corners[1 : top[0] + 1]
    return measured(corners, (upstream, downstream), (base, crest))


def measured(corners: Floats, faces: tuple[Floats, Floats], ends: tuple[float, float]) -> CutSection:
    """Measure the part above a crack, or above many.

    Parameters
    ----------
    corners
        From the heel and the toe round, (m, 2), or (m, 2, n) of n cracks [m].
    faces
        The upstream and the downstream one, from the crack up.
    ends
        z of the lowest and of the highest point of the whole section [m].
    """
    area, centroid, inertia = _moments(corners)
    for array in (corners, *faces):
        array.flags.writeable = False
    return CutSection(
        polygon=corners,
        area=area,
        centroid=centroid,
        polar_inertia=inertia,
        heel=(number(corners[0, 0]), number(corners[0, 1])),
        toe=(number(corners[1, 0]), number(corners[1, 1])),
        upstream_face=faces[0],
        downstream_face=faces[1],
        base_elevation=ends[0],
        crest_elevation=ends[1],
        inclination=number(np.arctan2(*(corners[1] - corners[0])[::-1])),
    )


def above_line(section: CutSection, line: Floats) -> CutSection:
    """Return a part above a crack that is not straight: measured above its corners from heel to toe, shape (k, 2), with
    the straight line between them as its crack."""
    corners = np.vstack([line, section.polygon[2:]])
    corners.flags.writeable = False
    area, centroid, inertia = _moments(corners)
    return replace(section, polygon=corners, area=area, centroid=centroid, polar_inertia=inertia)


def _moments(corners: Floats) -> tuple[float, tuple[float, float], float]:
    """Return area, centroid and polar second moment about it."""
    # Green's theorem, edge by edge and in that order, so that no row depends on the others; the inertia about the
    # centroid, where nothing cancels.
    x, z, cross = _around(corners, corners[0])
    area = sum(cross) / 2.0
    centroid = np.array([sum(cross * sums) for sums in (x[0] + x[1], z[0] + z[1])]) / (6.0 * area) + corners[0]
    x, z, cross = _around(corners, centroid)
    squares = x[0] * x[0] + x[0] * x[1] + x[1] * x[1] + z[0] * z[0] + z[0] * z[1] + z[1] * z[1]
    return number(area), (number(centroid[0]), number(centroid[1])), number(sum(cross * squares) / 12.0)


def _around(corners: Floats, centre: Floats) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats], Floats]:
    """Return x and z of both ends of all edges from a point, and twice the areas of the triangles there."""
    x, z = (corners - centre).swapaxes(0, 1)
    following = np.roll(x, -1, axis=0), np.roll(z, -1, axis=0)
    return (x, following[0]), (z, following[1]), x * following[1] - following[0] * z
