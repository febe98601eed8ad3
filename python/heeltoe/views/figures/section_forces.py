"""Uplift diagram and forces on the part above the crack, to scale."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.geometry.section import CutSection
from heeltoe.mechanics.loads import Resultant, static_forces, uplift_profile
from heeltoe.units.systems import Units
from heeltoe.units.write import number, scaled
from heeltoe.views.figures.canvas import Canvas

WATER = "#0072B2"
FORCE_COLOURS = {
    "weight": "#000000",
    **dict.fromkeys(("reservoir", "tailwater", "uplift", "nappe"), WATER),
    "ice": "#6A4C93",
    "silt": "#8A6D1B",
    "anchors": "#B22222",
}
# Of the size of what is shown: the longest arrow, the deepest uplift diagram.
_LONGEST, _DEEPEST = 0.28, 0.15
# A force of less than this part of the largest is no arrow that anyone could see; it is listed all the same.
_LITTLE = 1e-9


def draw_uplift(canvas: Canvas, case: Case, units: Units) -> float:
    """Draw the pressure in the crack, downwards from it; return how deep the diagram is [m]."""
    profile = uplift_profile(case)
    most = float(profile[:, 1].max())
    if most <= 0.0:
        return 0.0
    depth = _DEEPEST * canvas.size
    look = {"facecolor": "#E8F3FB", "edgecolor": WATER, "linewidth": 0.9, "zorder": 3}
    draw_crack_pressure(canvas, case.cut, profile, (most, depth), units, look=look, width=1.0, word="pressure ")
    return depth


def draw_crack_pressure(
    canvas: Canvas,
    section: CutSection,
    profile: Floats,
    deepest: tuple[float, float],
    units: Units,
    *,
    look: Mapping[str, Any],
    width: float,
    word: str = "",
) -> None:
    """Draw the pressure in a crack downwards from it, with its values: of a profile (k, 2) of distances from the heel
    [m] and pressures [Pa], to the scale of the `deepest`, a pressure [Pa] and its depth in the drawing [m]."""
    heel = np.array(section.heel)
    along, down = np.array(section.from_crack_frame(1.0, 0.0)), np.array(section.from_crack_frame(0.0, -1.0))
    most, depth = deepest
    top = heel + np.outer(profile[:, 0], along)
    bottom = top + np.outer(depth * profile[:, 1] / most, down)
    canvas.fill(np.vstack([top[[0, -1]], bottom[::-1]]), hatch="|||", **look)
    canvas.line(bottom, keep_off=True, color=WATER, linewidth=width, zorder=3.1)
    scale = units.scale("pressure", most)
    labelled: set[tuple[float, float]] = set()
    for (place, value), end in zip(profile.tolist(), bottom, strict=True):
        key = (round(place, 6), round(value, 3))
        if value > 1e-6 * most and key not in labelled:
            text = scaled(value, scale) if labelled else f"{word}{scaled(value, scale)}"
            labelled.add(key)
            canvas.label(text, end, WATER, first=(-1 if place <= 0.0 else 1, -1))


def draw_forces(canvas: Canvas, case: Case, units: Units) -> None:
    """Draw weight, water, uplift and the rest as arrows to one scale, with their values, and the scale."""
    forces = static_forces(case)
    sizes = [math.hypot(force.horizontal, force.vertical) for force in forces]
    most = max(sizes)
    scale = units.scale("force", most)
    per_force = _LONGEST * canvas.size / most
    section = case.above
    # The weight's arrow, which starts at the centroid, ends above the crack.
    _, above = section.in_crack_frame(*np.subtract(section.centroid, section.heel))
    per_force = min(per_force, 0.8 * above / sizes[0])
    shown = [
        (force, size, *_ends(force, section, per_force))
        for force, size in zip(forces, sizes, strict=True)
        if size > _LITTLE * most
    ]
    for force, _, tail, tip in shown:
        canvas.arrow(tail, tip, FORCE_COLOURS[force.name])
    _draw_scale(canvas, per_force, most, scale.factor, scale.unit)
    # Those on the faces first: beside them is less room.
    for force, size, tail, tip in sorted(shown, key=lambda arrow: abs(arrow[0].horizontal) < abs(arrow[0].vertical)):
        # Next to the end that stands free.
        place, towards = (tip, tip - tail) if force.name == "weight" else (tail, tail - tip)
        across = 1 if abs(towards[0]) < 0.5 * abs(towards[1]) else 0
        first = (across, int(np.sign(towards[1])) if across else 1)
        canvas.label(f"{force.name} {scaled(size, scale)}", place, FORCE_COLOURS[force.name], first=first)


def _ends(force: Resultant, section: CutSection, per_force: float) -> tuple[Floats, Floats]:
    """Return tail and tip of an arrow on the line along which a force acts [m]."""
    vector = np.array([force.horizontal, force.vertical]) * per_force
    if force.name == "weight":
        tail = np.array(section.centroid)
        return tail, tail + vector
    tip = _meets(force, section)
    return tip - vector, tip


def _meets(force: Resultant, section: CutSection) -> Floats:
    """Return where the line along which a force acts meets the face, or the crack, that it acts on [m]."""
    heel = np.array(section.heel)
    faces = {"reservoir": section.upstream_face, "ice": section.upstream_face, "silt": section.upstream_face}
    crest = np.array([section.upstream_face[-1], section.downstream_face[-1]])
    crack = crest if force.name == "nappe" else np.array([section.heel, section.toe])
    face = faces.get(force.name, section.downstream_face if force.name == "tailwater" else crack) - heel
    # On the line x v - z h = moment about the heel.
    off = face @ np.array([force.vertical, -force.horizontal]) - force.moment
    for start, end, a, b in zip(face[:-1], face[1:], off[:-1], off[1:], strict=True):
        if a != b and a * b <= 0.0:
            point: Floats = heel + start + (end - start) * (a / (a - b))
            return point
    # A line that misses its face passes somewhere near it.
    square = force.horizontal**2 + force.vertical**2
    nearest: Floats = heel + np.array([force.vertical, -force.horizontal]) * (force.moment / square)
    return nearest


def _draw_scale(canvas: Canvas, per_force: float, most: float, factor: float, unit: str) -> None:
    """Draw an arrow of a round force in the lower left corner."""
    size = 0.6 * most * factor
    power = 10.0 ** math.floor(math.log10(size))
    value = power * max(step for step in (1.0, 2.0, 5.0) if step * power <= size * (1.0 + 1e-9))
    (left, right), (bottom, top) = canvas.axes.get_xlim(), canvas.axes.get_ylim()
    corner = np.array([left + 0.03 * (right - left), bottom + 0.035 * (top - bottom)]) / canvas.length.factor
    end = corner + np.array([value / factor * per_force, 0.0])
    canvas.arrow(corner, end, "#444444", width=1.4)
    canvas.label(f"{number(value, 1)} {unit}", end, "#444444", first=(1, 0))
