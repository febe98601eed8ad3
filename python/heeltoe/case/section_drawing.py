"""The closed outline of a section in a drawing (DXF): polylines, or lines and curves that join."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import shapely

from heeltoe.case.drawing_lines import Line, Point, extent, joined, lines_of, loose_end
from heeltoe.errors.error import InputError, package, shown
from heeltoe.errors.sanitize import plain

Corners = list[tuple[float, float]]

#: How far a straight piece in place of a curve is from it at most, and how far apart ends are that join, as a part of
#: the larger side of the outline.
TOLERANCE = 1e-4
# What $INSUNITS of a drawing says.
_UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 10: "yd", 14: "dm", 21: "survey_foot"}
_MOST_NAMES = 8

# Lines that make a closed outline.
_Outline = tuple[Line, ...]


def corners_of_drawing(path: Path, layer: str | None) -> tuple[Corners, str, str]:
    """Return the corners of the closed outline of a drawing as they stand, the unit that it states (empty where it
    states none) and the layer of the outline.

    Parameters
    ----------
    path
        Of the file.
    layer
        Where the outline is; needed where there are several, or other lines.

    Raises
    ------
    InputError
        Where it is no drawing, or has no closed outline, or several; without a layer, also where the only one is
        hidden, or is not alone, so that the dam may be drawn beside it; with one, where other lines are on it, too.
    """
    lines, unit = _read(path)
    # Names of layers are the same in large and small letters.
    mine = [line for line in lines if layer is None or line.layer.lower() == layer.lower()]
    outlines, rest = _outlines(mine)
    if layer is None and not outlines:
        # Only a drawing of one dam and nothing else has its lines on several layers.
        outlines, rest = _joined(mine)
    if len(outlines) != 1:
        raise _none_or_several(lines, mine, outlines, layer)
    (outline,) = outlines
    name = outline[0].layer
    if beside := _doubt(outline, rest):
        raise InputError("drawing-mixed" if layer else "drawing-beside", "section.layer", shown(name), beside=beside)
    if layer is None and any(line.is_hidden for line in outline):
        raise InputError("drawing-beside", "section.layer", shown(name), beside="is hidden")
    size = extent(point for line in outline for point in line.points)
    return _around([line.within(TOLERANCE * size) for line in outline]), unit, name


def _read(path: Path) -> tuple[list[Line], str]:
    """Return the lines of a drawing, and its unit."""
    with package("section.file", "ezdxf"):
        from ezdxf.filemanagement import readfile
    # It would tell on standard error what it makes of a broken file.
    logging.getLogger("ezdxf").setLevel(logging.CRITICAL)
    try:
        drawing: Any = readfile(path)
        return list(lines_of(drawing)), _UNITS.get(drawing.units, "")
    except InputError:
        raise
    except Exception as error:  # ezdxf passes on whatever a broken file leads to
        reason = plain(str(error)) or type(error).__name__
        raise InputError(
            "source-unreadable", "section.file", reason=reason, expected="a DXF file, best of the release 2010"
        ) from None


def _outlines(lines: Sequence[Line]) -> tuple[list[_Outline], list[Line]]:
    """Return the closed outlines, each of lines of one layer, and the lines that belong to none."""
    by_layer: dict[str, list[Line]] = {}
    for line in lines:
        by_layer.setdefault(line.layer, []).append(line)
    found = [_joined(own) for own in by_layer.values()]
    return [outline for outlines, _ in found for outline in outlines], [line for _, rest in found for line in rest]


def _joined(lines: Sequence[Line]) -> tuple[list[_Outline], list[Line]]:
    """Return the closed outlines of lines, and those that belong to none."""
    closed = [line for line in lines if line.is_closed]
    ends = [line for line in lines if line.is_read and not line.is_closed]
    loops, rest = joined(ends, TOLERANCE * extent(point for line in ends for point in line.points))
    return [*((line,) for line in closed), *loops], [*rest, *(line for line in lines if not line.is_read)]


def _none_or_several(
    lines: Sequence[Line], mine: Sequence[Line], outlines: Sequence[_Outline], layer: str | None
) -> InputError:
    on_layers = Counter(_name(outline[0]) for outline in _outlines(lines)[0])
    known = ", ".join(f"{name} ({count})" for name, count in on_layers.most_common(_MOST_NAMES)) or "none"
    if outlines:
        field = "section.file" if layer else "section.layer"
        return InputError("drawing-several", field, len(outlines), layers=known)
    end = loose_end(mine, TOLERANCE * extent(point for line in mine for point in line.points))
    why = f"; a line ends alone at ({end[0]:.6g}, {end[1]:.6g})" if end is not None else ""
    if layer is not None:
        return InputError("drawing-layer", "section.layer", shown(layer), layers=known, why=why)
    return InputError("drawing-empty", "section.file", why=why)


def _name(line: Line) -> str:
    return f"{shown(line.layer)}{', hidden' if line.is_hidden else ''}"


def _doubt(outline: _Outline, rest: Sequence[Line]) -> str:
    """Return in words why a closed outline may not be the dam; nothing where there is nothing beside it."""
    points = _around([line.points for line in outline])
    near = TOLERANCE * extent(points)
    area = shapely.make_valid(shapely.Polygon(points))
    rest = [line for line in rest if not _fills(line, area)]
    chords = [line for line in rest if _replaces_an_edge(line, points, near)]
    if chords:
        return f"has a straight edge where another line has the same two ends: {_counted(chords)}"
    inside = [line for line in rest if line.points and area.buffer(-near).intersects(_shape(line.points))]
    if inside:
        return f"has other lines inside: {_counted(inside)}"
    return f"stands beside other lines: {_counted(rest)}" if rest else ""


def _shape(points: Sequence[Point]) -> shapely.Geometry:
    return shapely.LineString(points) if len(points) > 1 else shapely.Point(points[0])


def _counted(lines: Iterable[Line]) -> str:
    on_layers = Counter(f"{line.kind} on {_name(line)}" for line in lines)
    return ", ".join(f"{count} {name}" for name, count in on_layers.most_common(_MOST_NAMES))


def _fills(line: Line, area: shapely.Geometry) -> bool:
    """Whether it is the hatch of an outline."""
    if line.kind != "HATCH" or len(line.points) < 3:
        return False
    hatch = shapely.make_valid(shapely.Polygon(line.points))
    return bool(shapely.symmetric_difference(area, hatch).area <= 10.0 * TOLERANCE * area.area)


def _replaces_an_edge(line: Line, points: Sequence[Point], near: float) -> bool:
    """Whether a line runs between the ends of one edge of an outline, on another way."""
    if line.is_closed or len(line.points) < 3:
        return False
    ends = line.points[0], line.points[-1]
    for edge in pairwise([*points, points[0]]):
        for first, last in (edge, edge[::-1]):
            if _far(ends[0], first) <= near and _far(ends[1], last) <= near:
                return not shapely.LineString(edge).buffer(near).contains(shapely.LineString(line.points))
    return False


def _far(one: Point, other: Point) -> float:
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]))


def _around(pieces: Sequence[Sequence[Point]]) -> Corners:
    """Return the corners of lines that follow each other around an outline, each of which may run either way."""
    corners = list(pieces[0])
    if len(pieces) > 1 and _gap(corners[0], pieces[1]) < _gap(corners[-1], pieces[1]):
        corners.reverse()
    for piece in pieces[1:]:
        turned = _far(corners[-1], piece[-1]) < _far(corners[-1], piece[0])
        corners += (piece[::-1] if turned else piece)[1:]
    # The last is where the first is.
    corners.pop()
    return [corner for before, corner in pairwise([None, *corners]) if corner is not None and corner != before]


def _gap(point: Point, piece: Sequence[Point]) -> float:
    return min(_far(point, piece[0]), _far(point, piece[-1]))
