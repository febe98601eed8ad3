"""A dam as a mesh of Gmsh, format 4.1 in ASCII: physical groups for its sets, masses and loads as data of its nodes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.models.flexible.deck import Deck
from heeltoe.views.files.programs.remarks import remarks

#: Files that are written.
FILES = ("dam.msh",)
# Types of elements: eight-node quadrilateral, line of three nodes.
_QUAD, _LINE = 16, 8


def write_gmsh(deck: Deck, directory: Path) -> None:
    """Write a deck as ``dam.msh`` into an empty directory.

    Physical surfaces are the parts; physical lines the two faces of each crack, the faces that water may press, and the
    base that is held. Node data are the masses [kg] and the static loads [N] per metre of dam.
    """
    (directory / "dam.msh").write_text("".join(_lines(deck)), encoding="utf-8")


def _lines(deck: Deck) -> Iterator[str]:
    groups = list(_groups(deck))
    yield "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\n"
    yield from (f"{line.replace('$', '')}\n" for line in remarks(deck))
    yield f"$EndComments\n$PhysicalNames\n{len(groups)}\n"
    yield from (f'{dimension} {tag} "{name}"\n' for tag, (name, dimension, _) in enumerate(groups, 1))
    yield "$EndPhysicalNames\n$Entities\n"
    counts = [sum(dimension == wanted for _, dimension, _ in groups) for wanted in (0, 1, 2)]
    yield f"{counts[0]} {counts[1]} {counts[2]} 0\n"
    for wanted in (1, 2):
        for tag, (_, dimension, elements) in enumerate(groups, 1):
            if dimension == wanted:
                places = deck.nodes[elements.reshape(-1)]
                (x0, y0), (x1, y1) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
                yield f"{tag} {x0!r} {y0!r} 0 {x1!r} {y1!r} 0 1 {tag} 0\n"
    yield "$EndEntities\n"
    yield from _nodes(deck, groups)
    yield from _elements(groups)
    for name, values in (("mass", deck.masses), *deck.loads.items()):
        yield from _data(name, values[: deck.ground.min(initial=len(values))])


def _groups(deck: Deck) -> Iterator[tuple[str, int, Integers]]:
    """Yield name, dimension and elements (m, 8) or (m, 3) of each set; the ground is no part of the mesh."""
    ground = set(deck.ground.tolist())
    for part in deck.parts:
        yield part.name, 2, part.elements
    for part in deck.parts:
        yield f"{part.name}_upstream", 1, _edges(part.upstream)
        yield f"{part.name}_downstream", 1, _edges(part.downstream)
    for crack in deck.cracks:
        yield f"{crack.name}_upper", 1, _edges(crack.upper)
        if not ground.intersection(crack.lower.tolist()):
            yield f"{crack.name}_lower", 1, _edges(crack.lower)
    if not ground:
        yield "base", 1, _edges(deck.held)


def _edges(path: Integers) -> Integers:
    """Return the edges along a path of nodes as Gmsh has them: both ends, then the middle."""
    return np.column_stack([path[:-2:2], path[2::2], path[1:-1:2]])


def _nodes(deck: Deck, groups: list[tuple[str, int, Integers]]) -> Iterator[str]:
    """Yield the nodes, each with the part that it belongs to."""
    owners = [(tag, np.unique(elements)) for tag, (_, dimension, elements) in enumerate(groups, 1) if dimension == 2]
    count = sum(own.size for _, own in owners)
    yield f"$Nodes\n{len(owners)} {count} 1 {count}\n"
    for tag, own in owners:
        yield f"2 {tag} 0 {own.size}\n"
        yield from (f"{node + 1}\n" for node in own.tolist())
        yield from (f"{x!r} {y!r} 0\n" for x, y in deck.nodes[own].tolist())
    yield "$EndNodes\n"


def _elements(groups: list[tuple[str, int, Integers]]) -> Iterator[str]:
    count = sum(len(elements) for _, _, elements in groups)
    yield f"$Elements\n{len(groups)} {count} 1 {count}\n"
    number = 0
    for tag, (_, dimension, elements) in enumerate(groups, 1):
        yield f"{dimension} {tag} {_QUAD if dimension == 2 else _LINE} {len(elements)}\n"
        for nodes in (elements + 1).tolist():
            number += 1
            yield f"{number} {' '.join(map(str, nodes))}\n"
    yield "$EndElements\n"


def _data(name: str, values: Floats) -> Iterator[str]:
    # Some readers want a value for every node.
    yield f'$NodeData\n1\n"{name}"\n1\n0.0\n3\n0\n3\n{len(values)}\n'
    yield from (f"{node} {x!r} {y!r} 0\n" for node, (x, y) in enumerate(values.tolist(), 1))
    yield "$EndNodeData\n"
