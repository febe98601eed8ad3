"""The water that moves with a meshed body, as mass on its faces.

Only the motion along the normal of a face moves water. With the batter b of an edge of the face, the tangent of its
angle from the vertical, and the mass m per unit height that a horizontal motion meets, it is

    m [[1, -b], [-b, b^2]],      m = 7/8 rho sqrt(D (D - eta)) r(b)

on the displacements in x and z, with r from :mod:`heeltoe.mechanics.virtual_water`; a vertical edge has m alone.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array

from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.mechanics.loads import water_above_crack
from heeltoe.mechanics.virtual_water import slope_factor
from heeltoe.models.flexible.body.loads import edges, piece_place, pieces
from heeltoe.models.flexible.mesh.dam import BodyMesh
from heeltoe.models.flexible.surroundings.edges import edge_shapes

# Exact to degree 11: with depth = t^2, two shape functions are of degree 8, sqrt(depth) of 1, the change of variable
# of 1.
_SIX = np.polynomial.legendre.leggauss(6)
#: Edges that lean by less than this are vertical; level ones, that rise by less than it, move none.
_STRAIGHT = 1e-9


def virtual_masses(mesh: BodyMesh, case: Case, *, above: bool) -> Any:
    """Return the consistent mass of the water that moves with both faces of a body.

    With `virtual_mass` = "thesis" (Zhu 2004) it is that of the reservoir alone, moves horizontally whatever the slope,
    counts its depth from the crack, and the part below has none.

    Returns
    -------
    scipy.sparse.coo_array, shape (2 n, 2 n)
        On the displacements in x and z of node after node [kg per m].
    """
    result = _Entries(mesh)
    thesis = case.flexible.virtual_mass == "thesis"
    if thesis:
        if case.reservoir is not None and above:
            depth = water_above_crack(case, case.reservoir)
            result.add(mesh.upstream, case.reservoir, depth, _surface(case, case.reservoir), None)
    else:
        upstream, downstream = ("reservoir", mesh.upstream, 1.0), ("tailwater", mesh.downstream, -1.0)
        for name, path, side in (upstream, downstream):
            water: Water | None = getattr(case, name)
            # Compressible water is no mass, see heeltoe.models.flexible.body.reservoir.
            if water is not None and not case.has_sound(name):
                result.add(path, water, water.depth, _surface(case, water), side)
    return result.matrix()


def _surface(case: Case, water: Water) -> float:
    return case.cut.base_elevation + water.depth


class _Entries:
    """Entries of the matrix, edge by edge."""

    def __init__(self, mesh: BodyMesh) -> None:
        self._nodes = mesh.nodes
        self._rows, self._columns = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
        self._values = [np.empty(0)]

    def add(self, path: NDArray[np.int64], water: Water, depth: float, surface: float, side: float | None) -> None:
        """Add the water before a face; `side` is 1 with the concrete on the right of the way up, -1 on the left, None
        where only horizontal motion counts."""
        factor = 7.0 / 8.0 * water.density * math.sqrt(depth)
        for edge in edges(path):
            corners = self._nodes[edge]
            dx, dz = (corners[2] - corners[0]).tolist()
            for start, end in pieces(corners[:, 1], -math.inf, surface):
                if side is None or abs(dx) <= _STRAIGHT * abs(dz):
                    self._put(edge, 0, 0, factor * _moving(corners[:, 1], start, end, surface))
                elif abs(dz) > _STRAIGHT * abs(dx):
                    batter = dx / dz
                    mass = factor * slope_factor(side * batter) * _moving(corners[:, 1], start, end, surface)
                    for row, column, share in ((0, 0, 1.0), (0, 1, -batter), (1, 0, -batter), (1, 1, batter**2)):
                        self._put(edge, row, column, share * mass)

    def _put(self, edge: NDArray[np.int64], row: int, column: int, values: NDArray[np.float64]) -> None:
        self._rows.append(np.repeat(2 * edge + row, 3))
        self._columns.append(np.tile(2 * edge + column, 3))
        self._values.append(values.reshape(-1))

    def matrix(self) -> Any:
        places = np.concatenate(self._rows), np.concatenate(self._columns)
        return coo_array((np.concatenate(self._values), places), (self._nodes.size, self._nodes.size))


def _moving(heights: NDArray[np.float64], start: float, end: float, surface: float) -> NDArray[np.float64]:
    """Integrate the products of shape functions times sqrt(depth) over the height of a piece of an edge, (3, 3)."""
    # In t = sqrt(depth) the integrand is smooth up to the surface.
    deep, shallow = np.sqrt(np.maximum(0.0, surface - edge_shapes(np.array([start, end])) @ heights))
    half = (deep - shallow) / 2.0
    t = (deep + shallow) / 2.0 + half * _SIX[0]
    shapes = edge_shapes(piece_place(heights, surface - t * t, start, end))
    weights = 2.0 * abs(half) * _SIX[1] * t * t
    matrix: NDArray[np.float64] = shapes.T @ (weights[:, None] * shapes)
    return matrix
