"""Zangar's pressure of the water that moves with a dam, on a face of one slope; per metre of dam.

With the greatest depth h of the water, the depth y below its surface and the acceleration a of the face,

    p = C rho a h,    C = C_m / 2 (y/h (2 - y/h) + sqrt(y/h (2 - y/h)))

(Zangar, USBR Engineering Monograph 11, 1952, by electric analogy: incompressible water, a rigid dam, a reservoir
without end). It acts along the normal of the face, so that a slope feels a vertical part of it too. C_m belongs to the
angle of the face to the vertical, from 0 to 90 degrees; an overhang has that of a vertical face.

A face with a vertical part at its top has one slope by the rule of USBR, Design of Small Dams (1987): it counts as
vertical throughout where that part is at least half the height of the dam; else it is the straight line from the foot
of the face to where the surface meets it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import larger, number, smaller, where
from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.geometry.section import Edge, cut

# C_m by the angle to the vertical [degrees], read off Zangar's curve by a public program to about 0.01; at 0 the 0.735
# that is printed, as in Punmia's example 8.1, and at 90 nothing.
_ANGLES = (0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0)
_C_M = (0.735, 0.67, 0.62, 0.55, 0.48, 0.40, 0.31, 0.225, 0.125, 0.0)
_UPRIGHT = 1e-9


@dataclass(frozen=True)
class Zangar:
    """Sums over a face above the crack of the mass m that moves with each metre of its height.

    Attributes
    ----------
    mass, first, second
        Of m, and of m times the height above the heel and its square [kg/m, kg, kg m].
    lift, turning
        Of m times the slope, and of that times the distance from the heel [kg/m, kg].
    """

    mass: float
    first: float
    second: float
    lift: float
    turning: float


def coefficient(batter: float) -> float:
    """Return C_m of a face.

    Parameters
    ----------
    batter
        Tangent of the angle by which it leans back from the water; negative where it hangs over.
    """
    angle = np.degrees(np.arctan(larger(batter, 0.0)))
    return number(np.interp(angle, _ANGLES, _C_M))


def zangar(case: Case, water: Water, *, upstream: bool) -> Zangar:
    """Return the sums over the upstream or the downstream face; zeros without any water above the crack."""
    section = case.cut
    surface = section.base_elevation + water.depth - section.crack_elevation
    unit = water.density * water.depth * coefficient(_batter(case, water, upstream=upstream))
    depth = where(water.depth > 0.0, water.depth, 1.0)
    mass = first = second = lift = turning = 0.0
    for edge in section.upstream_edges if upstream else section.downstream_edges:
        low, high = (_moments(smaller(1.0, larger(surface - z, 0.0) / depth)) for z in (edge.z0, edge.z1))
        # Of C over the depth below the surface, and of its products with that depth and its square.
        zero, one, two = (unit / 2.0 * depth ** (n + 1) * (low[n] - high[n]) for n in range(3))
        by_height = surface * zero - one
        mass += zero
        first += by_height
        second += surface * surface * zero - 2.0 * surface * one + two
        lift += edge.slope * zero
        turning += edge.slope * ((edge.x0 - edge.slope * edge.z0) * zero + edge.slope * by_height)
    return Zangar(*map(number, (mass, first, second, lift, turning)))


def _moments(t: float) -> tuple[float, float, float]:
    """Return the integrals from 0 to t of ``t (2 - t) + sqrt(t (2 - t))`` and of its products with t and its square."""
    s = 1.0 - t
    w = np.sqrt(larger(t * (2.0 - t), 0.0))
    whole = (math.pi / 2.0 - np.arcsin(s) - s * w) / 2.0
    squares = (math.pi / 2.0 - np.arcsin(s) + s * w * (1.0 - 2.0 * s * s)) / 8.0
    return (
        t**2 - t**3 / 3.0 + whole,
        2.0 * t**3 / 3.0 - t**4 / 4.0 + whole - w**3 / 3.0,
        t**4 / 2.0 - t**5 / 5.0 + whole - 2.0 * w**3 / 3.0 + squares,
    )


def _batter(case: Case, water: Water, *, upstream: bool) -> float:
    """Return the tangent of the one slope that a face counts with."""
    whole = cut(case.outline, 0.0)
    edges = whole.upstream_edges if upstream else whole.downstream_edges
    if _vertical_at_top(edges) >= 0.5 * whole.height:
        return 0.0
    height = smaller(water.depth, whole.height)
    place = _at(edges, height) - edges[0].x0
    return (1.0 if upstream else -1.0) * where(height > 0.0, place / where(height > 0.0, height, 1.0), 0.0)


def _vertical_at_top(edges: Sequence[Edge]) -> float:
    """Return the height of the vertical part at the top of a face [m]."""
    height = 0.0
    for edge in reversed(edges):
        if abs(edge.slope) > _UPRIGHT or edge.z1 == edge.z0:
            break
        height += edge.z1 - edge.z0
    return height


def _at(edges: Sequence[Edge], height: float) -> float:
    """Return where a face is at a height above its foot, downstream of the heel [m]."""
    place = edges[0].x0
    for edge in edges:
        rises = edge.slope * (larger(smaller(height, edge.z1), edge.z0) - edge.z0)
        place = place + where(height >= edge.z1, edge.x1 - edge.x0, rises)
    return place
