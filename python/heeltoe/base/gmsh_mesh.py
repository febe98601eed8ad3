"""Plane elements of a mesh file of Gmsh (.msh, ASCII, format 2.2 or 4.1), with their physical groups."""

from __future__ import annotations

from collections.abc import Iterator

from heeltoe.base.plane_mesh import PlaneMesh, Points, ring

# Gmsh's types of elements: nodes of the plane ones that are read; points and lines, which are left out.
_PLANE = {2: 3, 3: 4, 9: 6, 16: 8, 10: 9}
_LINES = {1, 8, 15, 26, 27, 28}


def is_gmsh(content: bytes) -> bool:
    """Whether a file opens as Gmsh's do."""
    return content.lstrip().startswith(b"$MeshFormat")


def read_gmsh(text: str) -> PlaneMesh:
    """Return the plane elements of a file.

    Raises
    ------
    ValueError
        With what is wrong: another version, binary, elements that are not plane, text cut short.
    """
    sections = dict(_sections(text))
    version, binary = sections["MeshFormat"][0].split()[:2]
    if binary != "0":
        raise ValueError("it is binary: save it as ASCII")
    names = {}
    for line in sections.get("PhysicalNames", [])[1:]:
        dimension, tag, name = line.split(maxsplit=2)
        if dimension == "2":
            names[int(tag)] = name.strip('"')
    try:
        if version == "2.2":
            return PlaneMesh(_nodes_2(sections["Nodes"]), list(_elements_2(sections["Elements"], names)))
        if version == "4.1":
            groups = _groups_4(sections.get("Entities", []), names)
            return PlaneMesh(_nodes_4(sections["Nodes"]), list(_elements_4(sections["Elements"], groups)))
    except (IndexError, StopIteration, RuntimeError):
        raise ValueError("it ends before all of its nodes and elements") from None
    except KeyError as error:
        raise ValueError(f"it has no section {error}") from None
    raise ValueError(f"it has the format {version[:10]}: save it as 2.2 or 4.1")


def _sections(text: str) -> Iterator[tuple[str, list[str]]]:
    name, lines = "", list[str]()
    for line in text.splitlines():
        bare = line.strip()
        if bare.startswith("$End"):
            yield name, lines
            name, lines = "", []
        elif bare.startswith("$"):
            name, lines = bare[1:], []
        elif bare and name:
            lines.append(bare)
    if name:
        raise ValueError(f"its section {name[:20]} does not end")


def _nodes_2(lines: list[str]) -> Points:
    points: Points = {}
    for place in range(1, int(lines[0]) + 1):
        node, *xyz = lines[place].split()
        x, y, z = map(float, xyz[:3])
        points[node] = x, y, z
    return points


def _elements_2(lines: list[str], names: dict[int, str]) -> Iterator[tuple[list[str], set[str]]]:
    for place in range(1, int(lines[0]) + 1):
        _, kind, count, *rest = lines[place].split()
        if (nodes := _count(int(kind))) is not None:
            tag = int(rest[0]) if int(count) else 0
            own = rest[int(count) :]
            if len(own) != nodes:
                raise ValueError(f"an element has not {nodes} nodes")
            yield ring(own), {names.get(tag, str(tag))} if tag else set()


def _groups_4(lines: list[str], names: dict[int, str]) -> dict[int, set[str]]:
    """Return the names of the physical groups of each surface."""
    if not lines:
        return {}
    points, curves, surfaces, _ = map(int, lines[0].split())
    groups = {}
    for line in lines[1 + points + curves : 1 + points + curves + surfaces]:
        # The tag, a box of six numbers, and the groups.
        cells = line.split()
        tags = [abs(int(cell)) for cell in cells[8 : 8 + int(cells[7])]]
        groups[int(cells[0])] = {names.get(tag, str(tag)) for tag in tags}
    return groups


def _nodes_4(lines: list[str]) -> Points:
    points: Points = {}
    rows = iter(lines)
    for _ in range(int(next(rows).split()[0])):
        count = int(next(rows).split()[3])
        nodes = [next(rows) for _ in range(count)]
        for node in nodes:
            x, y, z = map(float, next(rows).split()[:3])
            points[node] = x, y, z
    return points


def _elements_4(lines: list[str], groups: dict[int, set[str]]) -> Iterator[tuple[list[str], set[str]]]:
    rows = iter(lines)
    for _ in range(int(next(rows).split()[0])):
        _, tag, kind, count = map(int, next(rows).split())
        nodes = _count(kind)
        for _ in range(count):
            own = next(rows).split()[1:]
            if nodes is not None:
                if len(own) != nodes:
                    raise ValueError(f"an element has not {nodes} nodes")
                yield ring(own), set(groups.get(tag, ()))


def _count(kind: int) -> int | None:
    """Return how many nodes a plane element has; None of points and lines."""
    if kind in _LINES:
        return None
    if kind not in _PLANE:
        raise ValueError(f"its elements of Gmsh's type {kind} are not plane, or of a higher order")
    return _PLANE[kind]
