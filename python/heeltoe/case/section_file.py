"""The corners of a section from a file: a drawing in DXF, a mesh, or a table in CSV, recognised by its content."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from heeltoe.base.input_files import read_bounded
from heeltoe.case.section_mesh import corners_of_mesh, is_mesh
from heeltoe.errors.error import InputError, shown
from heeltoe.units.parse import parse

Corners = list[tuple[float, float]]

_no_section = partial(
    InputError,
    "source-unreadable",
    "section.file",
    reason="it is neither a drawing in DXF nor a mesh nor a table of numbers",
    expected="one of them",
)
_EXPECTED = "a drawing in DXF, a mesh (.msh, .inp) or a table in CSV"
#: What is read of a section's block where that names a file.
FILE_FIELDS = ("file", "layer", "unit")
# Heights of dams [m], beyond which a drawing is not believed in its unit.
_LOWEST, _HIGHEST = 1.0, 350.0
_LARGEST, _MOST_CORNERS = 10_000_000, 10_000
# Every DXF begins with a group code, 0 or that of a comment, or says that it is binary.
_DXF = re.compile(rb"(?:\xef\xbb\xbf)?\s*(?:0\s*\r?\n\s*SECTION|999\s*\r?\n)|AutoCAD Binary DXF", re.IGNORECASE)
# Bounded: a line of brackets alone would be searched from each of them to its end.
_UNIT = re.compile(r"[\[(]([^\][()]{1,30})[\])]|_(m|mm|cm|ft|in)$")
_UP = ("z", "y", "elevation", "level", "height")


def with_section_read(fields: Mapping[str, object], directory: Path | None) -> Mapping[str, object]:
    """Return the fields of a case with the corners in the place of the file that its section names, if it names one.

    Parameters
    ----------
    fields
        As a case file has them.
    directory
        Where the path of the file starts; None where none is to be read.

    Raises
    ------
    InputError
        Where the file gives no corners, or other fields of a section stand beside it.
    """
    section = fields.get("section")
    if not isinstance(section, Mapping) or not isinstance(section.get("file"), str) or not section["file"]:
        return fields
    beside = [str(name) for name in section if name not in FILE_FIELDS and section[name] is not None]
    if beside:
        first, *others = (InputError("fields-conflict", f"section.{name}", other="file") for name in beside)
        raise first.with_others(others)
    layer, unit = section.get("layer"), section.get("unit")
    for name, value in (("layer", layer), ("unit", unit)):
        if value is not None and not (isinstance(value, str) and value):
            raise InputError("wrong-type", f"section.{name}", shown(value), expected="a text in quotes")
    if directory is None:
        raise InputError("section-file-unread", "section.file", shown(section["file"]))
    corners, drawn_on = read_corners(directory / os.path.expanduser(section["file"]), layer, unit)
    read: dict[str, object] = {"polygon": [[f"{x!r} m", f"{z!r} m"] for x, z in corners]}
    return {**fields, "section": {**read, "layer": drawn_on} if drawn_on else read}


def read_corners(path: Path, layer: str | None = None, unit: str | None = None) -> tuple[Corners, str]:
    """Return the corners (x, z) of a section in a file [m], and the layer or sets that they are on.

    Parameters
    ----------
    path
        Of the file.
    layer
        Layer of a drawing with its closed outline, or sets of elements of a mesh; needed where there are several, or
        other lines.
    unit
        Of the numbers, in place of the one that the file states.

    Raises
    ------
    InputError
        Where it cannot be read, is not bounded, or does not say one section.
    """
    try:
        content = read_bounded(path, _LARGEST)
    except FileNotFoundError:
        raise InputError(
            "file-missing", "section.file", path, expected="an outline, relative to the case file"
        ) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError("file-unreadable", "section.file", path, reason=reason, expected=_EXPECTED) from None
    if len(content) > _LARGEST:
        raise InputError(
            "too-large", "section.file", f"{_LARGEST // 10**6} MB", expected="the outline of the section alone"
        )
    meshed = is_mesh(content)
    if _DXF.match(content):
        # It is read once more, which a pipe does not bear.
        if not path.is_file():
            raise InputError("file-unreadable", "section.file", path, reason="it is not a file", expected=_EXPECTED)
        from heeltoe.case.section_drawing import corners_of_drawing

        corners, stated, drawn_on = corners_of_drawing(path, layer)
    elif meshed:
        corners, stated, drawn_on = corners_of_mesh(content, layer), "", layer or ""
    else:
        if layer is not None:
            raise InputError("needs-other", "section.layer", other="a drawing (DXF) or a mesh")
        (corners, stated), drawn_on = _corners_of_table(content), ""
    if len(corners) > 1 and corners[0] == corners[-1]:
        corners = corners[:-1]
    if len(corners) > _MOST_CORNERS:
        raise InputError(
            "too-large", "section.file", f"{_MOST_CORNERS} corners", expected="the outline of the section alone"
        )
    if len(corners) < 3:
        raise InputError("too-few", "section.file", f"{len(corners)} different corners", least="3")
    if unit is None and not stated:
        raise InputError(
            "missing", "section.unit", remedy='the file does not state it: add for example unit = "m" under [section]'
        )
    one = parse(f"1 {unit or stated}", "length", "section.unit" if unit else "section.file")
    levels = [z * one for _, z in corners]
    height = max(levels) - min(levels)
    # Programs write the unit of their template, often millimetres, whatever the drawing is in.
    # A mesh states none, and is seldom in another unit than metres or millimetres.
    if (meshed or (drawn_on and unit is None)) and not _LOWEST <= height <= _HIGHEST:
        raise InputError("drawing-height", "section.unit", f"{height:.4g} m", unit=unit or stated)
    return [(x * one, z * one) for x, z in corners], drawn_on


def _corners_of_table(content: bytes) -> tuple[Corners, str]:
    """Return the numbers of a table as they stand, and the unit that its head states."""
    try:
        lines = content.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise _no_section() from None
    rows = [(number, line) for number, line in enumerate(lines, start=1) if line.split("#")[0].strip()]
    if not rows:
        raise _no_section()
    cells = [(number, _cells(line.split("#")[0])) for number, line in rows]
    columns, stated, width = (0, 1), "", 2
    if any(_number(cell) is None for cell in cells[0][1]):
        columns, stated = _head(cells[0][1])
        width, cells = len(cells[0][1]), cells[1:]
    corners: Corners = []
    for number, row in cells:
        x, z = (_number(row[place]) if len(row) == width else None for place in columns)
        if x is None or z is None:
            raise InputError("section-row", "section.file", shown(" ".join(row)), number=number)
        corners.append((x, z))
    return corners, stated


def _cells(line: str) -> list[str]:
    """Return the cells of a row; where these are divided by semicolons, a comma is one of decimals."""
    if ";" in line:
        return [cell.strip().replace(",", ".") for cell in line.split(";")]
    return [cell.strip() for cell in line.split(",")] if "," in line else line.split()


def _number(cell: str) -> float | None:
    try:
        value = float(cell)
    except ValueError:
        return None
    return value if math.isfinite(value) and "_" not in cell else None


def _head(cells: Sequence[str]) -> tuple[tuple[int, int], str]:
    """Return the columns of x and z, and the unit that both state."""
    units = {(match[1] or match[2]).strip() for cell in cells if (match := _UNIT.search(cell))}
    names = [_UNIT.sub("", cell).strip().lower() for cell in cells]
    if len(units) > 1:
        raise InputError("section-head", "section.file", shown(", ".join(cells)))
    up = next((names.index(name) for name in _UP if name in names), None)
    if "x" in names and up is not None:
        return (names.index("x"), up), next(iter(units), "")
    if len(cells) != 2:
        raise InputError("section-head", "section.file", shown(", ".join(cells)))
    return (0, 1), next(iter(units), "")
