"""Eight-node quadrilaterals: their geometry, the boundary of a mesh, and the ways in which a mesh can be unfit.

Node order of an element: four corners counter-clockwise, then the midside nodes between corners 1-2, 2-3, 3-4
and 4-1. Local coordinates run from -1 to 1."""

from __future__ import annotations

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.errors.error import InputError

CORNERS = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
"""Local coordinates of the corners."""
MIDDLES = np.array([(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)])
"""Local coordinates of the midside nodes."""

_GAUSS = np.array([(x, y) for y in (-1.0, 0.0, 1.0) for x in (-1.0, 0.0, 1.0)]) * np.sqrt(0.6)
_SIDES = np.array([(0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)])
# Determinants below this part of the element's size squared count as zero.
_FLAT = 1e-6


def shape_gradients(points: Floats) -> Floats:
    """Return the derivatives of the serendipity shape functions (Zienkiewicz and Taylor, The Finite Element
    Method, volume 1).

    Parameters
    ----------
    points
        Local coordinates, shape (k, 2).

    Returns
    -------
    ndarray, shape (k, 8, 2)
        By the first and by the second local coordinate.
    """
    x, y = points[:, :1], points[:, 1:]
    a, b = CORNERS.T
    corners = [a * (1 + b * y) * (2 * a * x + b * y) / 4, b * (1 + a * x) * (2 * b * y + a * x) / 4]
    a, b = MIDDLES.T
    flat = b != 0.0
    middles = [
        np.where(flat, -x * (1 + b * y), a * (1 - y * y) / 2),
        np.where(flat, b * (1 - x * x) / 2, -y * (1 + a * x)),
    ]
    return np.concatenate([np.stack(corners, axis=-1), np.stack(middles, axis=-1)], axis=1)


def jacobians(nodes: Floats, elements: Integers, points: Floats) -> Floats:
    """Return the derivatives of x and z by the local coordinates, shape (elements, points, 2, 2) [m].

    Parameters
    ----------
    nodes, elements
        As in :class:`heeltoe.models.flexible.mesh.dam.BodyMesh`.
    points
        Local coordinates, shape (k, 2).
    """
    product: Floats = np.einsum("eni,pnj->epij", nodes[elements], shape_gradients(points), optimize=True)
    return product


def boundary_edges(elements: Integers) -> Integers:
    """Return the edges that belong to one element alone, with the body on their left.

    Returns
    -------
    ndarray, shape (k, 3)
        First corner, midside node, second corner.
    """
    edges, place, counts = _edges(elements)
    alone: Integers = edges[counts[place] == 1]
    return alone


def check_elements(nodes: Floats, elements: Integers, name: str) -> None:
    """Refuse elements that run clockwise or are folded over, at their corners or at a Gauss point.

    Parameters
    ----------
    nodes, elements
        As in :class:`heeltoe.models.flexible.mesh.dam.BodyMesh`.
    name
        What the mesh is called in the error.

    Raises
    ------
    InputError
        With the number of the first such element, counted from 1.
    """
    determinants = np.linalg.det(jacobians(nodes, elements, np.vstack([CORNERS, _GAUSS])))
    flat = _FLAT * np.ptp(nodes[elements], axis=1).max(axis=1, keepdims=True) ** 2
    clockwise = np.all(determinants < -flat, axis=1)
    if clockwise.any():
        raise InputError("mesh-clockwise", name, f"{np.argmax(clockwise) + 1}", count=int(clockwise.sum()))
    folded = np.any(determinants <= flat, axis=1)
    if folded.any():
        raise InputError("mesh-inverted", name, f"{np.argmax(folded) + 1}", count=int(folded.sum()))


def check_pieces(nodes: Floats, elements: Integers, name: str) -> None:
    """Refuse a mesh that does not hang together: nodes in the same place, sides that do not fit, several pieces.

    Raises
    ------
    InputError
        With nodes by their numbers, counted from 1.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    same = cKDTree(nodes).query_pairs(1e-6 * np.ptp(nodes[elements], axis=1).min())
    if same:
        raise InputError("mesh-double", name, f"{len(same)}", first=" and ".join(str(i + 1) for i in min(same)))
    edges, place, counts = _edges(elements)
    order = np.argsort(place, kind="stable")
    owner, middle = order // 4, edges[order, 1]
    shared = np.flatnonzero(np.diff(place[order]) == 0)
    # Elements side by side run along their common side in opposite directions, over the same node.
    unlike = (middle[shared] != middle[shared + 1]) | (edges[order[shared], 0] == edges[order[shared + 1], 0])
    twice = np.bincount(boundary_edges(elements)[:, 0], minlength=1)
    if np.any(counts > 2) or unlike.any() or np.any(twice > 1):
        where = edges[order[shared[unlike]], 0] if unlike.any() else np.flatnonzero(twice > 1)
        where = where if where.size else edges[np.flatnonzero(counts[place] > 2), 0]
        raise InputError("mesh-sides", name, f"{int(where[0]) + 1}")
    links = coo_array((np.ones(shared.size), (owner[shared], owner[shared + 1])), shape=(len(elements),) * 2)
    pieces, _ = connected_components(links, directed=False)
    if pieces > 1:
        raise InputError("mesh-pieces", name, f"{pieces}")


def _edges(elements: Integers) -> tuple[Integers, Integers, Integers]:
    """Return the four edges of each element, for each the number of its pair of corners, and how often that is."""
    edges = elements[:, _SIDES].reshape(-1, 3)
    _, place, counts = np.unique(np.sort(edges[:, ::2], axis=1), axis=0, return_inverse=True, return_counts=True)
    return edges, place.reshape(-1), counts
