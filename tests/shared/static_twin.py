"""A second program for the static checks of a dam with a level crack: strips, Gauss's quadrature, and a slow search.

It shares nothing with heeltoe but the definitions of docs/statics.md. Forces per metre of dam [N/m], H downstream, V
up, moments counter-clockwise about the heel: ``M = x V - z H``.
"""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Force = tuple[float, float, float]
Pressure = Callable[[float], float]
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(6)
#: Lengths of opening that the search looks at, one after the other.
TRIALS = 600


@dataclass(frozen=True)
class Wall:
    """A dam of straight faces: their corners (z, x) from below, z from the crack, x from the heel [m]."""

    upstream: tuple[tuple[float, float], ...]
    downstream: tuple[tuple[float, float], ...]
    density: float
    gravity: float

    @property
    def base(self) -> float:
        return self.downstream[0][1]

    @property
    def top(self) -> float:
        return self.upstream[-1][0]

    def weight(self) -> tuple[float, float, float]:
        """Return the weight and its centroid x, z, by strips between all corners."""
        levels = sorted({z for z, _ in (*self.upstream, *self.downstream)})
        area = at_x = at_z = 0.0
        for low, high in itertools.pairwise(levels):
            for z, width in _gauss(low, high):
                left, right = _on(self.upstream, z), _on(self.downstream, z)
                area += width * (right - left)
                at_x += width * (right**2 - left**2) / 2.0
                at_z += width * z * (right - left)
        return self.density * self.gravity * area, at_x / area, at_z / area

    def pressed(self, face: tuple[tuple[float, float], ...], pressure: Pressure, surface: float, way: float) -> Force:
        """Return the force of water on a face, `way` 1 from upstream and -1 from downstream."""
        total = np.zeros(3)
        for (low, x0), (high, x1) in itertools.pairwise(face):
            if high <= low or surface <= low:
                continue
            slope = (x1 - x0) / (high - low)
            for z, width in _gauss(low, min(high, surface)):
                along, up = way * pressure(z) * width, -way * pressure(z) * slope * width
                x = x0 + slope * (z - low)
                total += (along, up, x * up - z * along)
        return tuple(total.tolist())


def _gauss(low: float, high: float) -> list[tuple[float, float]]:
    half = (high - low) / 2.0
    return [(low + half * (1.0 + node), half * weight) for node, weight in zip(_NODES, _WEIGHTS, strict=True)]


def _on(face: tuple[tuple[float, float], ...], z: float) -> float:
    """Return x on a face."""
    heights = [height for height, _ in face]
    place = min(max(bisect.bisect_right(heights, z), 1), len(face) - 1)
    (low, x0), (high, x1) = face[place - 1], face[place]
    return x0 + (x1 - x0) * (z - low) / (high - low)


@dataclass(frozen=True)
class Water:
    """Water in the crack: pressures at heel and toe [Pa], and the pattern, as in [uplift] of a case."""

    heel: float
    toe: float
    uplift: dict[str, Any]
    base: float
    unit: float

    def points(self) -> list[tuple[float, float]]:
        """Return the pattern while the crack is closed: distance from the heel, and pressure."""
        factor, pattern = self.uplift.get("intensity", 1.0), self.uplift["pattern"]
        if pattern == "profile":
            return [(share * self.base, factor * self.unit * head) for share, head in self.uplift["heads"]]
        if pattern == "none":
            return [(0.0, 0.0), (self.base, 0.0)]
        between = {
            "uniform": [],
            "triangular": [],
            "cut-off": [(self.uplift.get("extent"), self.toe)],
            "drained": [
                (
                    self.uplift.get("drain_position"),
                    self.toe + (1.0 - self.uplift.get("drain_efficiency", 0.0)) * (self.heel - self.toe),
                )
            ],
        }[pattern]
        end = self.heel if pattern == "uniform" else self.toe
        inner = [(share * self.base, factor * pressure) for share, pressure in between if share < 1.0]
        return [(0.0, factor * self.heel), *inner, (self.base, factor * end)]

    def open(self, from_heel: float, from_toe: float) -> list[tuple[float, float]]:
        """Return the pressures with the crack open over lengths from heel and toe."""
        pattern, points = self.uplift["pattern"], self.points()
        if pattern == "none":
            return points
        tip, back = from_heel, self.base - from_toe
        factor = self.uplift.get("intensity", 1.0)
        first = [(0.0, self.heel), (tip, self.heel)] if from_heel else []
        last = [(back, self.toe), (self.base, self.toe)] if from_toe else []
        if tip >= back:
            return [*first, *last]
        if pattern == "profile":
            rest = [
                (tip, _at(points, tip, 1)),
                *(p for p in points if tip < p[0] < back),
                (back, _at(points, back, -1)),
            ]
            return [*first, *rest, *last]
        start = factor * self.heel if from_heel else points[0][1]
        end = factor * self.toe if from_toe and pattern != "uniform" else points[-1][1]
        return [*first, (tip, start), *(p for p in points if tip < p[0] < back), (back, end), *last]


def _at(points: list[tuple[float, float]], x: float, side: int) -> float:
    """Return the pressure just beyond (1) or before (-1) a place."""
    pairs = list(itertools.pairwise(points))
    for (x0, p0), (x1, p1) in pairs if side > 0 else reversed(pairs):
        if x1 > x0 and (x0 <= x < x1 if side > 0 else x0 < x <= x1):
            return p0 + (p1 - p0) * (x - x0) / (x1 - x0)
    return points[-1][1] if side > 0 else points[0][1]


def uplift_force(points: list[tuple[float, float]]) -> tuple[float, float]:
    """Return the force of pressures in the crack, up, and its moment about the heel."""
    force = moment = 0.0
    for (x0, p0), (x1, p1) in itertools.pairwise(points):
        if x1 > x0:
            for x, width in _gauss(x0, x1):
                pressure = p0 + (p1 - p0) * (x - x0) / (x1 - x0)
                force += width * pressure
                moment += width * pressure * x
    return force, moment


@dataclass(frozen=True)
class Stand:
    """How a block stands: outcome, openings from heel and toe [m], normal force [N/m], resultant from the heel [m],
    stresses at the ends of what is closed [Pa]."""

    outcome: str
    from_heel: float
    from_toe: float
    normal: float
    position: float
    heel_stress: float
    toe_stress: float


StudyResults = Callable[[float, float], list[tuple[float, float]]]


def stand(base: float, loads: Force, opened: StudyResults, bends: list[float]) -> Stand:
    """Open the crack bit by bit until its tip is not in tension."""
    _, up, turning = loads
    rounding = 1e-12 * abs(up) / base

    def at(from_heel: float, from_toe: float) -> Stand:
        force, moment = uplift_force(opened(from_heel, from_toe))
        normal, length = -up - force, base - from_heel - from_toe
        position = -(turning + moment) / normal if normal > 0.0 else math.nan
        if length <= 0.0:
            return Stand("", from_heel, from_toe, normal, position, -math.inf, -math.inf)
        middle = from_heel + length / 2.0
        bending = 6.0 * (-(turning + moment) - normal * middle) / length**2
        mean = normal / length
        return Stand("", from_heel, from_toe, normal, position, mean - bending, mean + bending)

    def ending(outcome: str, state: Stand) -> Stand:
        return Stand(outcome, *(getattr(state, name) for name in list(Stand.__dataclass_fields__)[1:]))

    closed = at(0.0, 0.0)
    if min(closed.heel_stress, closed.toe_stress) >= -rounding:
        return ending("stands", closed)
    if closed.normal <= 0.0:
        return ending("floats", closed)
    heel = closed.heel_stress < closed.toe_stress

    def opening(length: float) -> Stand:
        return at(length, 0.0) if heel else at(0.0, length)

    def tip(length: float) -> float:
        state = opening(length)
        return state.heel_stress if heel else state.toe_stress

    # Little may be left to stand on.
    near = base * (1.0 - np.logspace(-2.5, -8.5, TRIALS // 6))
    trials = [*np.linspace(0.0, base, TRIALS + 1).tolist(), *near.tolist()]
    lengths = sorted({*trials, *(x if heel else base - x for x in bends)})
    lengths = [length for length in lengths if 0.0 <= length < base * (1.0 - 1e-9)]
    # Where the pressure jumps, both sides of the place count.
    lengths = sorted(
        {
            *lengths,
            *(length * (1.0 - 1e-13) for length in lengths),
            *(min(base * (1.0 - 1e-9), length + 1e-13 * base) for length in lengths),
        }
    )
    for low, high in itertools.pairwise(lengths):
        if tip(high) < 0.0:
            continue
        for _ in range(100):
            middle = (low + high) / 2.0
            low, high = (low, middle) if tip(middle) >= 0.0 else (middle, high)
        state = opening(high)
        far = state.toe_stress if heel else state.heel_stress
        if far >= -rounding:
            return ending("stands", state)
        break
    through = opening(base)
    return ending("cracks through" if through.normal > 0.0 else "floats", through)
