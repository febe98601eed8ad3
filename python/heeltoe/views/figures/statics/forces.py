"""One load case of the static checks: all forces with their arms, the water pressures, the stress on the closed
part."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from matplotlib.figure import Figure

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.geometry.section import CutSection
from heeltoe.models.statics.cases import flooded
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.models.statics.sheet import ForceLine
from heeltoe.units.sentences import quantity
from heeltoe.units.systems import Units, unit_system
from heeltoe.units.write import number, scaled
from heeltoe.views.figures.canvas import Canvas
from heeltoe.views.figures.section import draw_bodies
from heeltoe.views.figures.section_forces import FORCE_COLOURS, WATER, draw_crack_pressure
from heeltoe.views.figures.statics.stresses import draw_stresses
from heeltoe.views.figures.style import COLOURS, WIDTH, heading, styled

_HEIGHT, _PANEL = 7.2, 1.55
# Of the size of what is shown: the longest arrow, the deepest pressure, the step between dimension lines.
_LONGEST, _DEEPEST, _STEP = 0.30, 0.13, 0.075
# Height of a letter of an arm that is written along it, with room [pt].
_ROOMY = 5.5
# A force of less than this part of the largest is no arrow that anyone could see; its line of the sheet has it.
_LITTLE = 1e-3
_ARM = {
    "arrowstyle": "<|-|>",
    "color": "#555555",
    "linewidth": 0.8,
    "mutation_scale": 6.0,
    "shrinkA": 0.0,
    "shrinkB": 0.0,
}
_BODY = ("weight", "inertia")
_UPSTREAM = ("reservoir", "ice", "silt", "hydrodynamic")
_EARTHQUAKE = "#D55E00"

# Where an arrow has its point [m], what it brings there [N/m], how far from the heel that acts [m], and whose it is.
_Arrow = tuple[Floats, Floats, float, ForceLine]


@styled
def forces_figure(case: Case, load_case: LoadCase, units: str = "si") -> Figure:
    """Draw the forces of a load case to one scale, each with its arm from the heel, the pressures of the water, the
    resultant, and below the stress on the part of the crack that is closed.

    Parameters
    ----------
    case
        The dam with its crack.
    load_case
        A load case of its checks.
    units
        ``"si"`` or ``"us"``.
    """
    system = unit_system(units)
    drawn, section = flooded(case) if load_case.name == "flood" else case, case.above
    figure = Figure(figsize=(WIDTH, _HEIGHT))
    heading(figure, case.title or "Untitled case", f"{load_case.name}, crack at {_at(case, system)}")
    panel = _PANEL / _HEIGHT
    axes = figure.add_axes((0.0, panel + 0.075, 1.0, 1.0 - panel - 0.075 - 0.55 / _HEIGHT))
    size = max(section.crack_width, section.height)
    canvas = Canvas(axes, system.scale("length"), size)
    arrows = list(_arrows(load_case, section))
    heights, widths = _arms(arrows, up=False), _arms(arrows, up=True)
    low, high = section.polygon.min(axis=0), section.polygon.max(axis=0)
    high[1] = max(high[1], section.base_elevation + (drawn.reservoir.depth if drawn.reservoir else 0.0))
    left = 0.52 + _STEP * len(heights)
    below = 0.10 + _DEEPEST + _STEP * len(widths)
    canvas.look_at(low - np.array([left, below]) * size, high + np.array([0.42, 0.1]) * size)
    axes.set_axis_off()
    draw_bodies(canvas, drawn)
    _draw_arms(canvas, section, (heights, widths), system)
    _draw_pressures(canvas, drawn, load_case, system)
    _draw_crack(canvas, case, load_case)
    _draw_arrows(canvas, section, load_case, arrows, system)
    stress = figure.add_axes((0.1, 0.42 / _HEIGHT, 0.87, panel - 0.05))
    draw_stresses(stress, load_case, system)
    return figure


def _at(case: Case, units: Units) -> str:
    return quantity(case.crack.elevation, ".5g m", units.name)


def _arrows(load_case: LoadCase, section: CutSection) -> Iterator[_Arrow]:
    """Return the horizontal and the vertical part of each force that can be seen, where they act."""
    sheet = load_case.sheet()
    size = max(abs(component) for line in sheet.lines for component in (line.horizontal_n, line.vertical_n))
    for line in sheet.lines:
        # From the heel of the crack; the sheet counts from that of the contact.
        if line.height_m is not None and abs(line.horizontal_n) > _LITTLE * size:
            z = line.height_m + sheet.point_m[1]
            yield _on(line, section, z, up=False), np.array([line.horizontal_n, 0.0]), line.height_m, line
        if line.distance_m is not None and abs(line.vertical_n) > _LITTLE * size:
            x = line.distance_m + sheet.point_m[0]
            yield _on(line, section, x, up=True), np.array([0.0, line.vertical_n]), line.distance_m, line


def _on(line: ForceLine, section: CutSection, place: float, *, up: bool) -> Floats:
    """Return where a force meets what it acts on [m]: a face, the crack, or the middle of the body."""
    heel = np.array(section.heel)
    name = line.name.split(" ")[0]
    if name in _BODY:
        return np.array([heel[0] + place, section.centroid[1]] if up else [section.centroid[0], heel[1] + place])
    faces = {**dict.fromkeys(_UPSTREAM, section.upstream_face), "tailwater": section.downstream_face}
    if name not in faces and not up:
        # Along the crack a force acts anywhere: beside what it does across.
        x = section.crack_width / 2.0 if line.distance_m is None else line.distance_m
        return np.array([heel[0] + x, heel[1] + place])
    if name == "nappe":
        return np.array([heel[0] + place, section.crest_elevation])
    face = faces.get(name, np.array([section.heel, section.toe])) - heel
    along, across = (0, 1) if up else (1, 0)
    order = np.argsort(face[:, along], kind="stable")
    other = float(np.interp(place, face[order, along], face[order, across]))
    result: Floats = heel + (np.array([place, other]) if up else np.array([other, place]))
    return result


def _arms(arrows: list[_Arrow], *, up: bool) -> list[tuple[float, str]]:
    """Return the arms of the vertical or of the horizontal parts with whose they are, those alike in one."""
    by_arm: dict[float, list[str]] = {}
    for _, force, arm, line in arrows:
        if bool(force[1]) == up and arm:
            known = next((item for item in by_arm if math.isclose(item, arm, rel_tol=1e-6)), arm)
            by_arm.setdefault(known, []).append(line.name)
    return [(arm, ", ".join(names)) for arm, names in sorted(by_arm.items(), key=lambda item: abs(item[0]))]


def _colour(name: str) -> str:
    first = name.split(" ")[0]
    return _EARTHQUAKE if first in ("inertia", "hydrodynamic") else FORCE_COLOURS.get(first, WATER)


def _draw_crack(canvas: Canvas, case: Case, load_case: LoadCase) -> None:
    """Draw the crack, what of it is open in thick red, on the straight line, and the ends of the contact."""
    section = case.cut
    heel, along = np.array(section.heel), np.array(section.from_crack_frame(1.0, 0.0))
    start, end, open_ = load_case.contact_from_m, load_case.contact_to_m, load_case.cracked_length_m
    canvas.line(case.crack_line, keep_off=True, color="#000000", linewidth=1.4, zorder=4.6)
    gone = (start, start + open_) if load_case.cracked_from == "heel" else (end - open_, end)
    if open_:
        canvas.line([heel + distance * along for distance in gone], color=COLOURS["crack"], linewidth=3.5, zorder=4.7)
        middle = heel + sum(gone) / 2.0 * along
        canvas.label("open", middle, COLOURS["crack"], first=(0, 1))
    canvas.label("heel", heel + start * along, first=(-1, -1))
    canvas.label("toe", heel + end * along, first=(1, -1))


def _draw_pressures(canvas: Canvas, case: Case, load_case: LoadCase, units: Units) -> None:
    """Draw the pressure of the water on both faces and in the crack to one scale."""
    section, points = case.cut, np.array(load_case.pressures)
    faces = []
    for water, face, side in (
        (case.reservoir, section.upstream_face, -1.0),
        (case.tailwater, section.downstream_face, 1.0),
    ):
        if water is not None:
            wet = _wet(face, section.base_elevation + water.depth)
            faces.append((wet, water.density * case.gravity * (section.base_elevation + water.depth - wet[:, 1]), side))
    most = max([float(points[:, 1].max()), *(float(p.max(initial=0.0)) for _, p, _ in faces)])
    if most <= 0.0:
        return
    per, scale = _DEEPEST * canvas.size / most, units.scale("pressure", most)
    look = {"facecolor": "none", "edgecolor": WATER, "linewidth": 0.7, "zorder": 2.5}
    for wet, pressure, side in faces:
        if pressure.size > 1 and pressure.max() > 0.0:
            outer = wet + np.outer(side * per * pressure, [1.0, 0.0])
            canvas.fill(np.vstack([wet, outer[::-1]]), hatch="---", alpha=0.8, **look)
            low = int(np.argmax(pressure))
            canvas.label(scaled(float(pressure[low]), scale), outer[low], WATER, first=(int(side), 1))
    if points[:, 1].max() > 0.0:
        draw_crack_pressure(canvas, section, points, (most, per * most), units, look=look, width=0.8)


def _wet(face: Floats, level: float) -> Floats:
    """Return the corners of a face below a level, from below, with the place where the water ends [m]."""
    points = [face[0]]
    for start, end in pairwise(face):
        if end[1] > level:
            if start[1] < level:
                points.append(start + (end - start) * (level - start[1]) / (end[1] - start[1]))
            break
        points.append(end)
    return np.array([point for point in points if point[1] <= level + 1e-9] or [face[0]])


def _draw_arms(canvas: Canvas, section: CutSection, arms: tuple[list[tuple[float, str]], ...], units: Units) -> None:
    """Draw the arms of the horizontal forces at the left, those of the vertical ones below."""
    heights, widths = arms
    heel, size, length = np.array(section.heel), canvas.size, units.scale("length")
    for place, (arm, names) in enumerate(heights, start=1):
        away = np.array([-(0.46 + _STEP * place) * size, 0.0])
        _dimension(canvas, heel + away, np.array([0.0, arm]), f"{names} {number(length(arm), 4)} {length.unit}")
    lowest = (_DEEPEST + 0.05) * size + max(0.0, heel[1] - section.polygon[:, 1].min())
    for place, (arm, names) in enumerate(widths, start=1):
        away = np.array([0.0, -(lowest + _STEP * place * size)])
        _dimension(canvas, heel + away, np.array([arm, 0.0]), f"{names} {number(length(arm), 4)} {length.unit}")


def _dimension(canvas: Canvas, start: Floats, arm: Floats, text: str) -> None:
    """Draw an arm as a line with its length beyond its far end, however short it is; on a high one, as nothing may
    stand above it, beside its middle."""
    ends = canvas.points(np.stack([start, start + arm]))
    canvas.axes.annotate("", ends[1], ends[0], arrowprops=_ARM, zorder=6)
    canvas.keep_off(np.stack([start, start + arm]))
    upright = bool(arm[1])
    last = ends[int(np.argmax(ends[:, 1 if upright else 0]))]
    figure = canvas.axes.figure
    high = 72.0 / figure.dpi * abs(float(np.diff(canvas.axes.transData.transform(ends)[:, 1])[0]))
    inside = upright and high > _ROOMY * len(text)
    drawn = canvas.axes.annotate(
        text,
        ends.mean(axis=0) if inside else last,
        xytext=(0.0, 0.0) if inside else (0.0, 4.0) if upright else (4.0, 0.0),
        textcoords="offset points",
        rotation=90.0 if upright else 0.0,
        ha="center" if upright else "left",
        va="bottom" if upright and not inside else "center",
        fontsize=7.5,
        color="#222222",
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.4},
        zorder=7,
    )
    canvas.keep_off_text(drawn)


def _draw_arrows(canvas: Canvas, section: CutSection, load_case: LoadCase, arrows: list[_Arrow], units: Units) -> None:
    """Draw the forces and their resultant with their sizes."""
    total = np.array([load_case.sheet().sum.horizontal_n, load_case.sheet().sum.vertical_n])
    most = max([float(np.abs(force).max()) for _, force, _, _ in arrows] + [float(np.hypot(*total))])
    per, scale = _LONGEST * canvas.size / most, units.scale("force", most)
    ends = []
    for point, force, _, line in arrows:
        vector, colour = force * per, _colour(line.name)
        tail, tip = (point, point + vector) if line.name in _BODY else (point - vector, point)
        canvas.arrow(tail, tip, colour)
        ends.append((line, force, tip if line.name in _BODY else tail, vector if line.name in _BODY else -vector))
    if load_case.resultant_from_heel_m is not None:
        tip = np.array(section.heel) + load_case.resultant_from_heel_m * np.array(section.from_crack_frame(1.0, 0.0))
        canvas.arrow(tip - total * per, tip, "#6A4C93", width=3.0)
        canvas.label(f"R {scaled(float(np.hypot(*total)), scale)}", tip - total * per, "#6A4C93", first=(-1, 1))
    for line, force, end, away in ends:
        across = 1 if abs(away[0]) < abs(away[1]) else 0
        first = (across, int(np.sign(away[1])) if across else 1)
        canvas.label(f"{line.name} {scaled(float(np.abs(force).max()), scale)}", end, _colour(line.name), first=first)
