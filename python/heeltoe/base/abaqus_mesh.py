"""Plane elements of an input file of Abaqus or CalculiX (.inp), with the sets that they belong to."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from heeltoe.base.plane_mesh import Elements, PlaneMesh, Points, ring

# Shells, membranes and solids of the plane; the digits are their nodes.
_PLANE = re.compile(r"(?:CPS|CPE|CPEG|CAX|M3D|S|STRI|R3D|SFM3D|DC2D|AC2D)(\d+)(?:R|RS|H|I|RH|IH|M|HT|T|S|5)*$")
_SOLID = re.compile(r"(?:C3D|DC3D|AC3D|CC3D|SC|CIN3D)\d")
# Lines, points and what joins them are no part of an outline.
_LINES = re.compile(r"(?:T2D|T3D|B2|B3|PIPE|SPRING|DASHPOT|MASS|ROTARYI|CONN|GAP|R2D|RB2D|DCOUP|D$|U1)")
_TURNED = "its nodes are in a system of coordinates of their own"
_REFUSED = {
    "INCLUDE": "it includes another file",
    "NGEN": "it generates its nodes",
    "NFILL": "it generates its nodes",
    "SYSTEM": _TURNED,
}
_GENERATED = {"ELGEN": "it generates its elements", "NCOPY": "it copies its nodes", "ELCOPY": "it copies its elements"}

_Block = tuple[str, dict[str, str], list[list[str]]]


def is_abaqus(content: bytes) -> bool:
    """Whether a file opens as such: with a keyword or a comment."""
    return re.match(rb"(?:\xef\xbb\xbf)?\s*\*[A-Za-z*]", content) is not None


def read_abaqus(text: str) -> PlaneMesh:
    """Return the plane elements of a file.

    Raises
    ------
    ValueError
        With what is wrong: other files, generated nodes, elements that are not plane or not known.
    """
    points: Points = {}
    elements: Elements = []
    numbers: dict[tuple[str, int], int] = {}
    part = ""
    for keyword, options, rows in _blocks(text):
        if reason := (_REFUSED | _GENERATED).get(keyword):
            raise ValueError(reason)
        if keyword in ("PART", "END PART"):
            part = options.get("NAME", "")
        elif keyword == "INSTANCE" and rows:
            raise ValueError("it moves an instance of a part")
        elif keyword == "NODE":
            if options.get("SYSTEM", "R").upper() != "R":
                raise ValueError(_TURNED)
            for row in rows:
                x, y, z = ([float(cell) if cell else 0.0 for cell in row[1:4]] + [0.0] * 3)[:3]
                points[f"{part} {int(row[0])}"] = x, y, z
        elif keyword == "ELEMENT":
            _add(elements, numbers, part, options, rows)
        elif keyword == "ELSET":
            _name(elements, numbers, part, options, rows)
    return PlaneMesh(points, elements)


def _add(
    elements: Elements,
    numbers: dict[tuple[str, int], int],
    part: str,
    options: dict[str, str],
    rows: Sequence[Sequence[str]],
) -> None:
    kind = options.get("TYPE", "").upper()
    if _LINES.match(kind):
        return
    plane = _PLANE.match(kind)
    if _SOLID.match(kind) or plane is None:
        raise ValueError(f"its elements of type {kind[:20] or 'none'} are not plane")
    count = int(plane[1])
    cells = [cell for row in rows for cell in row if cell]
    for start in range(0, len(cells) - count, count + 1):
        number, *nodes = map(int, cells[start : start + count + 1])
        numbers[part, number] = len(elements)
        named = {options["ELSET"].upper()} if "ELSET" in options else set()
        elements.append((ring([f"{part} {node}" for node in nodes]), named))
    if len(cells) % (count + 1):
        raise ValueError(f"an element of type {kind} has not {count} nodes")


def _name(
    elements: Elements,
    numbers: dict[tuple[str, int], int],
    part: str,
    options: dict[str, str],
    rows: Sequence[Sequence[str]],
) -> None:
    """Note which elements a set has; sets of sets are those of their elements."""
    name = options.get("ELSET", "").upper()
    for row in rows:
        cells = [cell for cell in row if cell]
        if "GENERATE" in options:
            first, last, step = ([int(cell) for cell in cells] + [1])[:3]
            found: Sequence[int | str] = range(first, last + 1, step)
        else:
            found = [int(cell) if cell.isdigit() else cell.upper() for cell in cells]
        for item in found:
            for place in [numbers.get((part, item), -1)] if isinstance(item, int) else range(len(elements)):
                if place >= 0 and (isinstance(item, int) or item in elements[place][1]):
                    elements[place][1].add(name)


def _blocks(text: str) -> Iterator[_Block]:
    """Yield keywords with their options and rows."""
    block: _Block | None = None
    joined = ""
    for line in text.splitlines():
        bare = line.strip()
        if not bare or bare.startswith("**"):
            continue
        if not (bare.startswith("*") or joined.startswith("*")):
            if block is not None:
                block[2].append([cell.strip() for cell in bare.split(",")])
            continue
        joined += bare
        if bare.endswith(","):
            continue
        if block is not None:
            yield block
        keyword, *options = (cell.strip() for cell in joined[1:].split(","))
        pairs = (option.partition("=") for option in options if option)
        named = {name.strip().upper(): value.strip().strip('"') for name, _, value in pairs}
        block, joined = (" ".join(keyword.upper().split()), named, []), ""
    if block is not None:
        yield block
