"""The lines of a drawing (DXF): where each is, on which layer, whether it is shown, and how they join."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import shapely

from heeltoe.errors.error import InputError

Point = tuple[float, float]

# Texts and signs beside lines. Whatever else a drawing has may be a part of the dam.
_TEXTS = frozenset(
    {
        *("TEXT", "MTEXT", "RTEXT", "ARCALIGNEDTEXT", "ATTDEF", "ATTRIB", "LEADER", "MULTILEADER", "TOLERANCE"),
        *("DIMENSION", "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION", "ACAD_TABLE"),
        *("POINT", "VIEWPORT", "LIGHT", "SUN", "CAMERA", "SECTIONOBJECT", "SEQEND"),
    }
)
_CURVES = frozenset({"ARC", "CIRCLE", "ELLIPSE", "SPLINE"})
_MOST_LINES, _MOST_BLOCKS = 50_000, 1_000
_DEEPEST = 16
# Curves are first read coarsely: as a part of their own size, and of the radius.
_COARSE, _COARSE_ARC = 1e-3, 0.05
# Pieces between two knots of a spline, and around an ellipse, before any of them is halved: a bend in an S has its
# middle on its chord.
_LEAST_PIECES = 16
# Share of a tolerance that halving may use; the rest goes to leaving out points.
_HALVED = 0.1
# Vertices of a polyline that are no corners, but control its curve.
_SPLINE_FIT = 4


@dataclass(frozen=True, eq=False)
class Line:
    """A line of a drawing.

    Attributes
    ----------
    layer
        Where it is.
    is_hidden
        Whether its layer is frozen or off, or it is invisible itself.
    kind
        Its name in DXF.
    points
        From one end to the other, curves coarsely; none where it cannot be read.
    is_read
        Whether it may be of an outline; hatches and what cannot be read are not.
    is_closed
        Whether it ends where it begins.
    within
        Returns its points, with curves as close to straight pieces as is asked for.
    """

    layer: str
    is_hidden: bool
    kind: str
    points: list[Point]
    is_read: bool
    is_closed: bool
    within: Callable[[float | None], list[Point]]


def lines_of(drawing: Any) -> Iterator[Line]:
    """Walk the lines of the model of a drawing, those of blocks where these are inserted.

    Parameters
    ----------
    drawing
        As ezdxf has read it.

    Raises
    ------
    InputError
        Where there are too many.
    """
    for entity, layer, frozen in _entities(drawing.modelspace(), None, False, _Walk(drawing)):
        hidden = frozen or bool(entity.dxf.get("invisible", 0)) or _is_hidden(drawing, layer)
        yield from _lines(entity, layer, hidden)


class _Walk:
    """A walk through a drawing: how many lines and blocks it has met."""

    def __init__(self, drawing: Any) -> None:
        self.drawing = drawing
        self._met = {"lines": 0, "blocks": 0}

    def meet(self, what: str, most: int) -> None:
        """Count a thing, and end where there are too many."""
        self._met[what] += 1
        if self._met[what] > most:
            raise InputError(
                "too-large", "section.file", f"{most:,} {what}", expected="the outline of the section alone"
            )


def _entities(
    entities: Iterable[Any], inserted_on: str | None, frozen: bool, walk: _Walk, depth: int = 0
) -> Iterator[tuple[Any, str, bool]]:
    """Walk what is drawn with its layer, and whether a block that holds it is hidden; texts are left out."""
    for entity in entities:
        walk.meet("lines", _MOST_LINES)
        layer = entity.dxf.get("layer", "0")
        if layer == "0" and inserted_on is not None:
            layer = inserted_on
        kind = entity.dxftype()
        if kind in _TEXTS:
            continue
        if kind != "INSERT":
            yield entity, layer, frozen
            continue
        inner = frozen or bool(entity.dxf.get("invisible", 0)) or _is_frozen(walk.drawing, layer)
        block = entity.block()
        if block is None or block.block.is_xref or depth >= _DEEPEST:
            # Its lines are elsewhere.
            yield entity, layer, inner
            continue
        for one in entity.multi_insert() if entity.mcount > 1 else (entity,):
            walk.meet("blocks", _MOST_BLOCKS)
            yield from _entities(one.virtual_entities(), layer, inner, walk, depth + 1)


def _is_frozen(drawing: Any, layer: str) -> bool:
    return layer in drawing.layers and bool(drawing.layers.get(layer).is_frozen())


def _is_hidden(drawing: Any, layer: str) -> bool:
    return _is_frozen(drawing, layer) or (layer in drawing.layers and bool(drawing.layers.get(layer).is_off()))


def _lines(entity: Any, layer: str, hidden: bool) -> Iterator[Line]:
    kind = entity.dxftype()
    if kind == "HATCH":
        for edge in _boundaries(entity):
            yield Line(layer, hidden, kind, edge, False, False, lambda _: [])
        return
    if not _is_read(entity):
        yield Line(layer, hidden, kind, [], False, False, lambda _: [])
        return

    def within(tolerance: float | None) -> list[Point]:
        return _points(entity, tolerance)

    points = within(_COARSE * extent(within(None)))
    # A point that is drawn as a line is none.
    if extent(points) > 0.0:
        yield Line(layer, hidden, kind, points, True, len(points) > 3 and points[0] == points[-1], within)


def _is_read(entity: Any) -> bool:
    kind = entity.dxftype()
    if kind == "POLYLINE":
        return bool(entity.is_2d_polyline or entity.is_3d_polyline) and not entity.dxf.flags & _SPLINE_FIT
    return kind in {"LINE", "LWPOLYLINE"} or kind in _CURVES


def _boundaries(hatch: Any) -> Iterator[list[Point]]:
    """Walk the boundaries of a hatch, coarsely."""
    from ezdxf.path import from_hatch

    for path in from_hatch(hatch):
        size = extent((point.x, point.y) for point in path.control_vertices())
        if size > 0.0:
            yield [(point.x, point.y) for point in path.flattening(_COARSE * size)]


def _points(entity: Any, tolerance: float | None) -> list[Point]:
    """Return the points of a line in the plane of the drawing, of a curve within a tolerance."""
    kind = entity.dxftype()
    if kind == "LINE":
        found = [entity.dxf.start, entity.dxf.end]
    elif kind in {"LWPOLYLINE", "POLYLINE"}:
        return _polyline(entity, tolerance)
    elif kind in {"ARC", "CIRCLE"}:
        found = entity.flattening(_COARSE_ARC * abs(entity.dxf.radius) if tolerance is None else tolerance)
    else:
        # Halving pieces makes more of them than are needed.
        share = float("inf") if tolerance is None else _HALVED * tolerance
        fine = [(float(point.x), float(point.y)) for point in entity.flattening(share, _LEAST_PIECES)]
        if tolerance is None or len(fine) < 3:
            return fine
        left = shapely.simplify(shapely.LineString(fine), (1.0 - _HALVED) * tolerance)
        return [(x, y) for x, y in shapely.get_coordinates(left).tolist()]
    points = [(float(point.x), float(point.y)) for point in found]
    if kind == "CIRCLE" and points:
        points[-1] = points[0]
    return points


def _polyline(entity: Any, tolerance: float | None) -> list[Point]:
    """Return the points of a polyline: its corners to the last bit, and its arcs within a tolerance."""
    from ezdxf.math import ConstructionArc, Vec3, bulge_to_arc

    if entity.dxftype() == "LWPOLYLINE":
        corners, up = entity.get_points("xyb"), float(entity.dxf.elevation)
    else:
        bulged = bool(entity.is_2d_polyline)
        up = float(Vec3(entity.dxf.get("elevation", (0.0, 0.0, 0.0))).z) if bulged else 0.0
        at = [(vertex.dxf.location, vertex.dxf.bulge if bulged else 0.0) for vertex in entity.vertices]
        corners = [(place.x, place.y, bulge) for place, bulge in at]
    if entity.is_closed and corners:
        corners = [*corners, corners[0]]
    points = [(float(x), float(y)) for x, y, _ in corners[:1]]
    for (x0, y0, bulge), (x1, y1, _) in pairwise(corners):
        if bulge and (x0, y0) != (x1, y1):
            centre, start, end, radius = bulge_to_arc((x0, y0), (x1, y1), bulge)
            arc = ConstructionArc(centre, radius, math.degrees(start), math.degrees(end))
            around = list(arc.flattening(_COARSE_ARC * radius if tolerance is None else tolerance))[1:-1]
            # Arcs run anticlockwise, and one with a negative bulge is run through the other way.
            points += [(point.x, point.y) for point in (around if bulge > 0.0 else around[::-1])]
        points.append((float(x1), float(y1)))
    system = entity.ocs()
    if system.transform:
        points = [(point.x, point.y) for point in system.points_to_wcs([Vec3(x, y, up) for x, y in points])]
    return points


def extent(points: Iterable[Point]) -> float:
    """Return the larger side of the box around points; zero of none."""
    found = list(points)
    return max((max(axis) - min(axis) for axis in zip(*found, strict=True)), default=0.0)


def joined(lines: Sequence[Line], near: float) -> tuple[list[tuple[Line, ...]], list[Line]]:
    """Return the closed outlines that lines make end to end, and the lines that belong to none.

    Parameters
    ----------
    lines
        Open ones.
    near
        How far apart ends are that join.
    """
    lines = [line for line in lines if extent(line.points) > near]
    nodes, at = _nodes(lines, near)
    loops, met = list[tuple[Line, ...]](), set[int]()
    for first in range(len(lines)):
        if first in met:
            continue
        start, node = nodes[first]
        loop, current = [first], first
        while node != start and len(at[node]) == 2:
            current = next(other for other in at[node] if other != current)
            loop.append(current)
            node = next((other for other in nodes[current] if other != node), node)
        if node == start and len(at[start]) == 2:
            loops.append(tuple(lines[place] for place in loop))
        # Lines of a chain that does not close begin no other one.
        met.update(loop)
    used = {line for loop in loops for line in loop}
    return loops, [line for line in lines if line not in used]


def loose_end(lines: Sequence[Line], near: float) -> Point | None:
    """Return where a line ends alone; None where none does."""
    lines = [line for line in lines if line.is_read and not line.is_closed]
    nodes, at = _nodes(lines, near)
    for line, ends in zip(lines, nodes, strict=True):
        for node, point in zip(ends, (line.points[0], line.points[-1]), strict=True):
            if len(at[node]) == 1:
                return point
    return None


def _nodes(lines: Sequence[Line], near: float) -> tuple[list[tuple[int, int]], dict[int, list[int]]]:
    """Return the places where lines begin and end, by numbers, and the lines of each place."""
    # By cells of a grid: many lines may meet in one place.
    places, numbers = dict[tuple[int, int], list[int]](), list[Point]()
    at = defaultdict[int, list[int]](list)

    def number_of(point: Point) -> int:
        column, row = (math.floor(value / near) for value in point)
        around = ((column + right, row + up) for right in (0, -1, 1) for up in (0, -1, 1))
        known = (number for cell in around for number in places.get(cell, ()))
        for number in known:
            if math.dist(numbers[number], point) <= near:
                return number
        places.setdefault((column, row), []).append(len(numbers))
        numbers.append(point)
        return len(numbers) - 1

    nodes = list[tuple[int, int]]()
    for place, line in enumerate(lines):
        nodes.append((number_of(line.points[0]), number_of(line.points[-1])))
        for node in nodes[-1]:
            at[node].append(place)
    return nodes, at
