"""The closed polyline of a section in a drawing (DXF)."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import plain

Corners = list[tuple[float, float]]

# What $INSUNITS of a drawing says.
_UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 10: "yd", 14: "dm", 21: "survey_foot"}
_MOST_NAMES = 8
# Lines that may be the outline of a dam, or a part of one; texts, dimensions and hatches are not.
_LINES = "LINE LWPOLYLINE POLYLINE ARC CIRCLE ELLIPSE SPLINE INSERT"


def corners_of_drawing(path: Path, layer: str | None) -> tuple[Corners, str]:
    """Return the corners of the closed polyline of a drawing as they stand, and the unit that it states; empty where
    it states none.

    Parameters
    ----------
    path
        Of the file.
    layer
        Where the polyline is; needed where there are several.

    Raises
    ------
    InputError
        Where it is no drawing, or has no closed polyline, several, or one with arcs; without a layer, also where the
        only one is hidden, or stands beside other lines, of which the dam may be drawn.
    """
    drawing, closed = _read(path)
    on_layers = Counter(line.dxf.layer for line in closed)
    # Names of layers are the same in large and small letters.
    mine = [line for line in closed if layer is None or line.dxf.layer.lower() == layer.lower()]
    known = ", ".join(f"{shown(name)} ({count})" for name, count in on_layers.most_common(_MOST_NAMES)) or "none"
    if not mine and layer is not None:
        raise InputError("drawing-layer", "section.layer", shown(layer), layers=known)
    if not mine:
        raise InputError("drawing-empty", "section.file")
    if len(mine) > 1:
        raise InputError("drawing-several", "section.file" if layer else "section.layer", len(mine), layers=known)
    if layer is None and (beside := _beside(drawing, mine[0])):
        raise InputError("drawing-beside", "section.layer", shown(mine[0].dxf.layer), beside=beside)
    if mine[0].has_arc:
        raise InputError("drawing-arcs", "section.file", shown(mine[0].dxf.layer))
    lightweight = mine[0].dxftype() == "LWPOLYLINE"
    points = mine[0].vertices_in_wcs() if lightweight else mine[0].points_in_wcs()
    return [(float(point.x), float(point.y)) for point in points], _UNITS.get(drawing.units, "")


def _read(path: Path) -> tuple[Any, list[Any]]:
    """Return a drawing, and its closed polylines."""
    try:
        from ezdxf.filemanagement import readfile
    except ImportError:
        raise InputError("drawing-package", "section.file", "ezdxf") from None
    # It would tell on standard error what it makes of a broken file.
    logging.getLogger("ezdxf").setLevel(logging.CRITICAL)
    try:
        drawing = readfile(path)
        return drawing, list(_closed(drawing))
    except Exception as error:  # ezdxf passes on whatever a broken file leads to
        reason = plain(str(error)) or type(error).__name__
        raise InputError("drawing-unreadable", "section.file", reason=reason) from None


def _closed(drawing: Any) -> Iterator[Any]:
    """Walk the closed polylines of the plane."""
    for line in drawing.modelspace().query("LWPOLYLINE POLYLINE"):
        if line.dxftype() == "LWPOLYLINE":
            points = [(x, y) for x, y, *_ in line.get_points()]
        elif line.is_2d_polyline:
            points = [(point.x, point.y) for point in line.points()]
        else:
            continue
        if len(points) > 2 and (line.is_closed or points[0] == points[-1]):
            yield line


def _beside(drawing: Any, line: Any) -> str:
    """Return in words why a closed polyline may not be the dam; nothing where it is the only line that is shown."""
    layer = drawing.layers.get(line.dxf.layer) if line.dxf.layer in drawing.layers else None
    if layer is not None and (layer.is_frozen() or layer.is_off()):
        return "is hidden"
    others = Counter(other.dxf.layer for other in drawing.modelspace().query(_LINES) if other is not line)
    names = ", ".join(f"{count} on {shown(name)}" for name, count in others.most_common(_MOST_NAMES))
    return f"stands beside other lines: {names}" if names else ""
