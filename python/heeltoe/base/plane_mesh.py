"""Plane elements of a mesh file, whatever its format: their corners around, and the sets that they belong to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

#: Places (x, y, z) of nodes by their names.
Points = dict[str, tuple[float, float, float]]
#: Nodes around each element, midside nodes among its corners, and the names of its sets.
Elements = list[tuple[list[str], set[str]]]


@dataclass(frozen=True, eq=False)
class PlaneMesh:
    """Nodes and plane elements of a file.

    Attributes
    ----------
    points
        Places of the nodes, in the unit of the file.
    elements
        Nodes around each, and its sets.
    """

    points: Points
    elements: Elements


def ring(nodes: Sequence[str]) -> list[str]:
    """Return the nodes around an element: those of three, four, six, eight or nine nodes list their corners first.

    Raises
    ------
    ValueError
        Where there is no such element.
    """
    count = len(nodes)
    if count not in (3, 4, 6, 8, 9):
        raise ValueError(f"it has plane elements of {count} nodes")
    corners = 3 if count in (3, 6) else 4
    if count == corners:
        return list(nodes)
    return [node for place in range(corners) for node in (nodes[place], nodes[corners + place])]
