"""Water, silt, ice and anchors on a meshed body: nodal forces.

Pressure acts on the face as it lies in the mesh. An edge of three nodes is cut where the water surface or a corner
of the pressure lies on it and integrated on the pieces, so that the nodal forces of a mesh that follows the section
have the resultants of :mod:`heeltoe.mechanics.loads`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.geometry.axes import places
from heeltoe.geometry.section import CutSection
from heeltoe.mechanics.loads import nappe_heads, uplift_profile, water_above_crack
from heeltoe.models.flexible.mesh.checks import boundary_edges
from heeltoe.models.flexible.mesh.dam import BodyMesh
from heeltoe.models.flexible.surroundings.edges import edge_shapes

# Exact to degree 5: quadratic shape function, quadratic pressure and linear normal on an edge.
_THREE = np.polynomial.legendre.leggauss(3)
# An edge that rises by less than this part of the crest's width belongs to the crest.
_LEVEL = 1e-6


def water_forces(mesh: BodyMesh, case: Case, *, upstream: bool) -> Floats:
    """Return the forces of reservoir or tailwater on a body, shape (2 n,) [N/m], x and z of node after node."""
    water = case.reservoir if upstream else case.tailwater
    if water is None:
        return np.zeros(mesh.nodes.size)
    surface = case.cut.base_elevation + water.depth
    return _fluid(mesh, surface, case.gravity, (water.density, water.density), upstream=upstream)


def silt_forces(mesh: BodyMesh, case: Case) -> Floats:
    """Return the forces of the silt on a body, shape (2 n,) [N/m]: those of a fluid that is heavier downwards."""
    silt = case.silt
    if silt is None:
        return np.zeros(mesh.nodes.size)
    surface = case.cut.base_elevation + silt.depth
    return _fluid(mesh, surface, case.gravity, (silt.horizontal_density, silt.vertical_density), upstream=True)


def nappe_forces(mesh: BodyMesh, case: Case) -> Floats:
    """Return the forces on the crest of the water above it, shape (2 n,) [N/m]."""
    forces = np.zeros(mesh.nodes.size)
    if case.reservoir is None:
        return forces
    unit, (h0, h1) = case.gravity * case.reservoir.density, nappe_heads(case)
    x0, x1 = (float(mesh.nodes[path[-1], 0]) for path in (mesh.upstream, mesh.downstream))
    crest = mesh.nodes[:, 1].max()
    for edge in boundary_edges(mesh.elements):
        corners = mesh.nodes[edge]
        if x1 > x0 and np.all(np.abs(corners[:, 1] - crest) <= _LEVEL * (x1 - x0)):
            s, weights = _gauss(-1.0, 1.0)
            head = h0 + (h1 - h0) * (edge_shapes(s) @ corners[:, 0] - x0) / (x1 - x0)
            # With the body on the left, the crest runs upstream and the water is on its right.
            _press(forces, edge, corners, s, -unit * head * weights)
    return forces


def ice_forces(mesh: BodyMesh, case: Case, *, above: bool) -> Floats:
    """Return the push of the ice on the edge of a body that is at its height, shape (2 n,) [N/m]."""
    forces = np.zeros(mesh.nodes.size)
    if case.ice is None or case.reservoir is None:
        return forces
    section = case.cut
    level = section.base_elevation + case.reservoir.depth - case.ice.depth
    if (level >= section.crack_elevation) != above:
        return forces
    for edge in edges(mesh.upstream):
        heights = mesh.nodes[edge, 1]
        if min(heights[0], heights[2]) <= level <= max(heights[0], heights[2]):
            s = np.clip(piece_place(heights, np.array([level]), -1.0, 1.0), -1.0, 1.0)
            forces[2 * edge] = case.ice.force * edge_shapes(s)[0]
            break
    return forces


def uplift_forces(mesh: BodyMesh, case: Case, *, above: bool, profile: Floats | None = None) -> Floats:
    """Return the forces of the water in the crack on a body, shape (2 n,) [N/m]: apart from the other one.

    `profile` has distances from the heel [m] and pressures [Pa], shape (k, 2); without it it is that of the case.
    """
    forces = np.zeros(mesh.nodes.size)
    points = uplift_profile(case) if profile is None else profile
    if not points[:, 1].any():
        return forces
    # Going downstream, the upper part is on the left hand.
    side = -1.0 if above else 1.0
    for edge in edges(mesh.crack):
        corners = mesh.nodes[edge]
        along = places(corners, case.cut)[:, 0]
        for (x0, p0), (x1, p1) in pairwise(points):
            if x1 <= x0:
                continue
            for start, end in pieces(along, x0, x1):
                s, weights = _gauss(start, end)
                pressure = p0 + (p1 - p0) * (edge_shapes(s) @ along - x0) / (x1 - x0)
                _press(forces, edge, corners, s, side * pressure * weights)
    return forces


def full_head_profile(case: Case) -> Floats:
    """Return the pressure of the reservoir at the heel over the whole crack, as :func:`uplift_profile` does."""
    head = water_above_crack(case, case.reservoir)
    density = case.reservoir.density if case.reservoir else 0.0
    return np.array([(0.0, 1.0), (case.cut.crack_width, 1.0)]) * [1.0, density * case.gravity * head]


def crack_point(mesh: BodyMesh, section: CutSection, distance: float) -> tuple[Integers, Floats]:
    """Return the three nodes of the crack edge at a distance from the heel, counted along the crack from 0, and their
    shares in the motion of that point."""
    along = places(mesh.nodes[mesh.crack], section)[:, 0]
    edge = 2 * int(np.clip(np.searchsorted(along[2:-1:2], distance), 0, (len(along) - 3) // 2))
    s = np.clip(piece_place(along[edge : edge + 3], np.array([distance]), -1.0, 1.0), -1.0, 1.0)
    return edge + np.arange(3), edge_shapes(s)[0]


def anchor_forces(mesh: BodyMesh, case: Case, *, above: bool) -> Floats:
    """Return the prestress of all anchors on the crack face of a body, shape (2 n,) [N/m]: towards the other one."""
    forces = np.zeros(mesh.nodes.size)
    for anchor in case.anchors_at_crack:
        result, shares = crack_point(mesh, case.cut, anchor.distance)
        down, up = case.cut.from_crack_frame(-math.sin(anchor.inclination), -math.cos(anchor.inclination))
        pull = anchor.prestress if above else -anchor.prestress
        nodes = mesh.crack[result]
        forces[2 * nodes] += pull * down * shares
        forces[2 * nodes + 1] += pull * up * shares
    return forces


def _fluid(mesh: BodyMesh, surface: float, gravity: float, densities: tuple[float, float], *, upstream: bool) -> Floats:
    """Return the forces on a face of a fluid with one density sideways and one in its weight, below a surface."""
    forces = np.zeros(mesh.nodes.size)
    sideways, downwards = (gravity * density for density in densities)
    # Going up the upstream face, the concrete is on the right hand.
    path, side = (mesh.upstream, 1.0) if upstream else (mesh.downstream, -1.0)
    for edge in edges(path):
        corners = mesh.nodes[edge]
        for start, end in pieces(corners[:, 1], -math.inf, surface):
            s, weights = _gauss(start, end)
            depth = surface - edge_shapes(s) @ corners[:, 1]
            _press(forces, edge, corners, s, side * (sideways * depth) * weights, side * (downwards * depth) * weights)
    return forces


def edges(path: Integers) -> Iterator[Integers]:
    for start in range(0, len(path) - 2, 2):
        yield path[start : start + 3]


def _gauss(start: float, end: float) -> tuple[Floats, Floats]:
    """Return three Gauss points and weights between two places of an edge."""
    half = (end - start) / 2.0
    return (start + end) / 2.0 + half * _THREE[0], half * _THREE[1]


def _press(
    forces: Floats,
    edge: Integers,
    corners: Floats,
    s: Floats,
    pressure: Floats,
    vertical: Floats | None = None,
) -> None:
    """Add weighted pressures at the places `s` of an edge, positive towards the right hand; `vertical` where that of
    the horizontal planes is another."""
    along = np.stack([s - 0.5, -2.0 * s, s + 0.5], axis=-1) @ corners
    shapes = edge_shapes(s)
    forces[2 * edge] += shapes.T @ (pressure * along[:, 1])
    forces[2 * edge + 1] -= shapes.T @ ((pressure if vertical is None else vertical) * along[:, 0])


def pieces(values: Floats, low: float, high: float) -> list[tuple[float, float]]:
    """Return the parts of an edge, as intervals of s, where a coordinate with these nodal values is between two."""
    square, slope = (values[0] - 2.0 * values[1] + values[2]) / 2.0, (values[2] - values[0]) / 2.0
    marks = [-1.0, 1.0]
    for bound in (low, high):
        if math.isfinite(bound):
            marks += [root for root in _roots(square, slope, values[1] - bound) if -1.0 < root < 1.0]
    marks.sort()
    result = []
    for start, end in pairwise(marks):
        middle = (start + end) / 2.0
        if end > start and low < square * middle * middle + slope * middle + values[1] < high:
            result.append((start, end))
    return result


def _roots(a: float, b: float, c: float) -> list[float]:
    """Return the real roots of a s^2 + b s + c without cancellation; a, b or both may be zero."""
    inside = b * b - 4.0 * a * c
    if inside < 0.0:
        return []
    q = -(b + math.copysign(math.sqrt(inside), b)) / 2.0
    return [root for top, bottom in ((q, a), (c, q)) if bottom != 0.0 and abs(root := top / bottom) < 1e6]


def piece_place(values: Floats, wanted: Floats, start: float, end: float) -> Floats:
    """Return where on a monotonic piece of an edge a coordinate has the values wanted."""
    square, slope = (values[0] - 2.0 * values[1] + values[2]) / 2.0, (values[2] - values[0]) / 2.0
    middle = (start + end) / 2.0
    return np.array(
        [
            min(_roots(square, slope, values[1] - value) or [middle], key=lambda root: abs(root - middle))
            for value in wanted
        ]
    )
