"""The section with its crack, water, silt, ice, anchors, uplift and forces."""

from __future__ import annotations

import numpy as np
import shapely
from matplotlib.figure import Figure

from heeltoe.base.arrays import Floats
from heeltoe.case.at_crack import anchor_line
from heeltoe.case.model import Case
from heeltoe.mechanics.loads import uplift_profile
from heeltoe.mechanics.section_shapes import section_shapes
from heeltoe.units.systems import Scale, unit_system
from heeltoe.views.figures.canvas import Canvas
from heeltoe.views.figures.section_forces import draw_forces, draw_uplift
from heeltoe.views.figures.style import COLOURS, WIDTH, styled

# A part above the crack that is lower than this part of the dam gets a panel of its own.
_LOW = 0.55
# Margins of the picture [in].
_LEFT, _BOTTOM, _EDGE = 0.62, 0.5, 0.18
_TALLEST = 4.1
_OUTLINE = {"edgecolor": "#222222", "linewidth": 1.1, "zorder": 2}
_LOOKS: dict[str, dict[str, object]] = {
    "water": {"facecolor": COLOURS["water"], "linewidth": 0.0, "zorder": 1},
    "silt": {"facecolor": COLOURS["silt"], "edgecolor": "#8A6D1B", "hatch": "...", "linewidth": 0.5, "zorder": 1.2},
    "ice": {"facecolor": "white", "edgecolor": "#6A4C93", "hatch": "xxxx", "linewidth": 0.5, "zorder": 1.3},
    "ground": {"facecolor": "white", "edgecolor": "#777777", "hatch": "////", "linewidth": 0.0, "zorder": 1},
    "below": {"facecolor": COLOURS["concrete below"], **_OUTLINE},
    "above": {"facecolor": COLOURS["concrete"], **_OUTLINE},
}


@styled
def section_figure(case: Case, units: str = "si") -> Figure:
    """Draw the section of a dam with both parts, crack, water, silt, ice and anchors, the uplift diagram below the
    crack, and the static forces on the part above it as arrows to scale.

    Where the crack is near the crest, the part above it is shown once more, larger, and the forces there.

    Raises
    ------
    InputError
        Where the crack does not cut the section in two, or the units are unknown.
    """
    system = unit_system(units)
    section, whole = case.cut, case.outline
    left, base, right, crest = whole.bounds
    size = max(right - left, crest - base)
    one = section.height > _LOW * (crest - base)
    pressed = one and section.crack_elevation == base and float(uplift_profile(case)[:, 1].max()) > 0.0
    low, high = corners(case, size, below=0.34 if pressed else 0.22 if one else 0.16)
    views = [(low, high)]
    widths = [WIDTH - _LEFT - _EDGE]
    if not one:
        near = max(section.crack_width, section.height)
        bottom, top = section.polygon.min(axis=0), section.polygon.max(axis=0)
        views.append((bottom - np.array([1.2, 0.55]) * near, top + np.array([0.5, 0.12]) * near))
        widths = [2.6, WIDTH - 2.6 - 2.0 * _LEFT - _EDGE]
    asked = max(w * (top[1] - low[1]) / (top[0] - low[0]) for w, (low, top) in zip(widths, views, strict=True))
    tall = float(np.clip(asked, 2.5, _TALLEST))
    figure = Figure(figsize=(WIDTH, tall + _BOTTOM + _EDGE))
    height = tall + _BOTTOM + _EDGE
    length = system.scale("length")
    canvases = []
    for place, (wide, view) in enumerate(zip(widths, views, strict=True)):
        start = _LEFT + place * (widths[0] + _LEFT)
        axes = figure.add_axes((start / WIDTH, _BOTTOM / height, wide / WIDTH, tall / height))
        canvases.append(Canvas(axes, length, size if place == 0 else near))
        canvases[-1].look_at(*view)
    for canvas in canvases:
        draw_bodies(canvas, case)
        canvas.axes.set_xlabel(f"x, downstream [{length.unit}]")
        canvas.axes.set_ylabel(f"z, up [{length.unit}]", labelpad=2)
        canvas.axes.grid(visible=False)
    # Before all labels, which keep off them.
    anchored = draw_anchors(canvases[-1], case)
    depth = draw_uplift(canvases[-1], case, system)
    draw_dimensions(canvases[0], case, depth if one else 0.0)
    draw_crack(canvases[-1], case, small=False)
    if not one:
        draw_crack(canvases[0], case, small=True)
    draw_further(canvases[0], case)
    if anchored is not None:
        canvases[-1].label("anchors" if len(case.anchors) > 1 else "anchor", anchored, "#B22222", first=(1, 1))
    draw_forces(canvases[-1], case, system)
    return figure


def corners(case: Case, size: float, *, below: float) -> tuple[Floats, Floats]:
    """Return the corners of the first panel [m]."""
    left, base, right, crest = case.outline.bounds
    upstream = 0.54 if case.reservoir else 0.16
    downstream = 0.46 if case.tailwater else 0.24
    return (
        np.array([left - upstream * size, base - below * size]),
        np.array([right + downstream * size, crest + 0.155 * size]),
    )


def draw_bodies(canvas: Canvas, case: Case) -> None:
    """Draw water, silt, ice and both parts of the dam on the ground."""
    whole = case.outline
    left, base, _, _ = whole.bounds
    for kind, shape in section_shapes(case):
        if kind == "ground":
            start, _, end, _ = shape.bounds
            shape = shapely.box(start, base - 0.03 * canvas.size, end, base)
            canvas.line([[start, base], [end, base]], color="#555555", linewidth=0.8, zorder=1.5)
        canvas.fill(shape, **_LOOKS[kind])
        if kind in ("below", "above"):
            canvas.keep_off(shapely.get_coordinates(shape))
    for water, side in ((case.reservoir, "left"), (case.tailwater, "right")):
        if water is not None and water.depth:
            _draw_surface(canvas, whole, base + water.depth, side)
    deep = 0.0 if case.silt is None else case.silt.depth
    if deep and canvas.length(base + 0.5 * deep) > canvas.axes.get_ylim()[0]:
        canvas.label("silt", [left - 0.3 * canvas.size, base + 0.2 * deep], "#6B5310", first=(0, 0))


def _draw_surface(canvas: Canvas, whole: shapely.Polygon, level: float, side: str) -> None:
    """Draw the surface of water with the triangle that marks it."""
    left, _, right, _ = whole.bounds
    low, high = (edge / canvas.length.factor for edge in canvas.axes.get_xlim())
    if canvas.length(level) <= canvas.axes.get_ylim()[0]:
        return
    # Within the water that is seen, beside its dimension.
    at = low + 0.45 * (left - low) if side == "left" else high - 0.12 * (high - right)
    size = 0.022 * canvas.size
    canvas.fill(
        [[at, level], [at - size, level + 1.7 * size], [at + size, level + 1.7 * size]],
        facecolor="white",
        edgecolor="#0072B2",
        linewidth=0.9,
        zorder=4,
    )
    canvas.keep_off([[at - size, level - size], [at + size, level + 1.7 * size]])
    canvas.keep_off([[at - size, level + 1.7 * size], [at + size, level - size]])
    for step, part in ((0.6, 0.9), (1.2, 0.5)):
        z = level - step * size
        canvas.line([[at - part * size, z], [at + part * size, z]], color="#0072B2", linewidth=0.8, zorder=4)


def draw_crack(canvas: Canvas, case: Case, *, small: bool) -> None:
    """Draw the crack, its two ends and the centroid of the part above it."""
    section, line = case.above, case.crack_line
    canvas.line(line, keep_off=True, color="white", linewidth=3.6, zorder=4.5)
    canvas.line(line, color=COLOURS["crack"], linewidth=2.0, zorder=4.6)
    if small:
        canvas.label(crack_name(case, case, canvas.length), section.toe, COLOURS["crack"])
        return
    canvas.label("heel", section.heel, first=(-1, -1))
    canvas.label("toe", section.toe, first=(1, -1))
    canvas.line([section.centroid], color="#000000", marker="o", markersize=7, markerfacecolor="white", zorder=6.5)
    canvas.line([section.centroid], color="#000000", marker="+", markersize=7, zorder=6.6)
    canvas.label("centroid", section.centroid, first=(-1, 1))


def draw_further(canvas: Canvas, case: Case) -> None:
    """Draw the cracks beside that of ``[crack]``."""
    for place, alone in enumerate(case.single_crack_cases):
        if place != case.asked:
            ends = [alone.cut.heel, alone.cut.toe]
            canvas.line(ends, keep_off=True, color="white", linewidth=3.6, zorder=4.5)
            canvas.line(ends, color=COLOURS["crack"], linewidth=1.4, linestyle=(0, (4, 1.5)), zorder=4.6)
            canvas.label(crack_name(case, alone, canvas.length), alone.cut.toe, COLOURS["crack"])


def crack_name(case: Case, alone: Case, length: Scale) -> str:
    """Return what one of the cracks of a case is called in a drawing: by its level, where the dam has several."""
    name = "crack" if alone.crack.bond is None else "joint"
    if not case.further_cracks:
        return name
    return f"{name} at {length(alone.crack.elevation):.4g} {length.unit}"


def draw_drains(canvas: Canvas, case: Case) -> None:
    """Draw where drains lower the pressure in the crack."""
    share, section = case.uplift.drain_position, case.above
    if case.uplift.pattern != "drained" or share is None:
        return
    place = (1.0 - share) * np.array(section.heel) + share * np.array(section.toe)
    ends = place + np.array([[0.0, -0.05], [0.0, 0.05]]) * canvas.size
    canvas.line(ends, keep_off=True, color="#0072B2", linewidth=2.0, zorder=4.8)
    canvas.label("drains", ends[1], "#0072B2")


def draw_anchors(canvas: Canvas, case: Case) -> Floats | None:
    """Draw the anchors across the crack, up to where they leave the section; return the upper end of the first [m]."""
    ends = []
    for anchor in case.anchors:
        end, deep = map(np.array, anchor_line(anchor, case.cut, 0.22 * canvas.size))
        canvas.line([deep, end], keep_off=True, color="#B22222", linewidth=1.2, linestyle="-.", zorder=5)
        canvas.line([end], color="#B22222", marker="s", markersize=4, zorder=5)
        canvas.line([deep], color="#B22222", marker="v", markersize=4, zorder=5)
        ends.append(end)
    return ends[0] if ends else None


def draw_dimensions(canvas: Canvas, case: Case, below: float, *, small: bool = False) -> None:
    """Draw heights, widths and depths of water; `below` is how deep the uplift diagram is [m]. A small drawing has no
    room for those of crack and tailwater."""
    section, whole, size = case.cut, case.outline, canvas.size
    left, base, right, crest = whole.bounds
    corners = shapely.get_coordinates(whole.exterior)[:-1]
    top, foot = (corners[corners[:, 1] == level, 0] for level in (crest, base))
    canvas.dimension([top.max(), crest], [top.max(), base], [right - top.max() + 0.16 * size, 0.0])
    if np.ptp(top) > 0.0:
        canvas.dimension([top.min(), crest], [top.max(), crest], [0.0, 0.07 * size])
    if np.ptp(foot) > 0.0:
        # Below the uplift diagram, as far as that comes out of the dam.
        lowest = min(section.heel[1], section.toe[1]) - base
        drop = -(0.1 * size + max(0.0, below - lowest))
        canvas.dimension([foot.min(), base], [foot.max(), base], [0.0, drop])
    if section.crack_elevation > base and not small:
        canvas.dimension([section.toe[0], base], section.toe, [right - section.toe[0] + 0.07 * size, 0.0])
    if case.reservoir is not None and case.reservoir.depth:
        at = left - 0.45 * size
        canvas.dimension([at, base], [at, base + case.reservoir.depth])
    if case.tailwater is not None and case.tailwater.depth and not small:
        at = right + 0.28 * size
        canvas.dimension([at, base], [at, base + case.tailwater.depth])
