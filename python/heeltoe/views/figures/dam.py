"""The elastic dam: its meshes, and the shapes in which it vibrates while its crack is bonded."""

from __future__ import annotations

import math
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.body.elastic import tied
from heeltoe.models.flexible.body.modes import lowest
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.models.flexible.mesh.checks import boundary_edges
from heeltoe.models.flexible.mesh.dam import BodyMesh
from heeltoe.units.systems import Scale, unit_system
from heeltoe.units.write import number
from heeltoe.views.figures.style import COLOURS, WIDTH, heading, styled

_SHAPES = 4
# The largest displacement of a shape as it is drawn, over the size of the dam.
_DRAWN = 0.09
# Around an element, corners and midsides in turn.
_AROUND = [0, 4, 1, 5, 2, 6, 3, 7, 0]


@styled
def mesh_figure(dam: FlexibleDam, units: str = "si") -> Figure:
    """Draw the meshes of both parts, the nodes of the crack and their base."""
    scale = unit_system(units).scale("length")
    bodies = [body.mesh for body in dam.bodies]
    low, high = extent(dam)
    wide, tall = high - low
    small = dam.section.crack_width < 0.4 * wide
    figure = Figure(
        figsize=(WIDTH, float(np.clip((4.0 if small else 4.8) * tall / wide + 1.2, 3.0, 7.5))), layout="constrained"
    )
    elements, nodes = sum(len(mesh.elements) for mesh in bodies), sum(len(mesh.nodes) for mesh in bodies)
    on = (
        len(bodies[0].crack) if dam.free == 1 else " and ".join(str(len(mesh.faces[-1])) for mesh in bodies[: dam.free])
    )
    cracks = "the crack" if dam.free == 1 else "the cracks"
    heading(figure, f"{elements} elements of eight nodes, {nodes} nodes, {on} of them on {cracks}")
    axes: list[Axes] = list(
        figure.subplots(1, 2 if small else 1, width_ratios=[1.4, 1.0] if small else None, squeeze=False)[0]
    )
    for panel in axes:
        for mesh, colour in zip(bodies, cycle(("#333333", "#888888")), strict=False):
            panel.add_collection(LineCollection(list(edges(mesh, scale(mesh.nodes))), colors=colour, linewidths=0.5))
            points = scale(mesh.nodes[mesh.crack])
            panel.plot(*points.T, "o", color=COLOURS["crack"], markersize=2.5, zorder=3)
        grounded = len(bodies) == dam.free
        held = bodies[-1].faces[-1] if grounded else bodies[-1].fixed
        _hold(panel, scale(bodies[-1].nodes[held]), rigid=grounded)
        dam_axes(panel, scale)
    _frame(axes[0], scale, low, high)
    if small:
        upper = bodies[0].nodes
        _frame(axes[1], scale, upper.min(axis=0), upper.max(axis=0))
        axes[1].set_title("above the crack", fontsize=9)
    rocky = dam.rock_error > 0.0
    base = "base, on rock" if rocky else "base, held"
    if grounded:
        base = f"{'rock' if rocky else 'rigid plane'} below the crack"
    handles = [
        Line2D([], [], color=COLOURS["crack"], marker="o", markersize=3, linestyle="", label="nodes of the crack"),
        Patch(facecolor="white", edgecolor="#555555", hatch="////", linewidth=0.0, label=base)
        if len(bodies) == 1
        else Line2D([], [], color="#000000", marker="^", fillstyle="none", markersize=5, linestyle="", label=base),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    return figure


@styled
def modes_figure(dam: FlexibleDam, units: str = "si") -> Figure:
    """Draw the first four shapes in which the dam vibrates, crack bonded and water included, with their periods."""
    scale = unit_system(units).scale("length")
    periods, shapes = intact_shapes(dam, _SHAPES)
    bodies = [body.mesh for body in dam.bodies]
    low, high = extent(dam)
    wide, tall = high - low
    size = max(wide, tall)
    height = float(np.clip(0.85 * WIDTH / len(periods) * (tall + 0.2 * size) / (wide + 0.2 * size) + 1.3, 2.6, 6.5))
    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    heading(figure, "Shapes of vibration of the intact dam, water included; displacements exaggerated, scale free")
    axes: list[Axes] = list(figure.subplots(1, len(periods), sharex=True, sharey=True, squeeze=False)[0])
    for place, (panel, period, shape) in enumerate(zip(axes, periods, shapes, strict=True), start=1):
        largest = max(float(np.hypot(*part.T).max()) for part in shape)
        for mesh, part in zip(bodies, shape, strict=True):
            still = scale(mesh.nodes)
            outline = boundary_edges(mesh.elements)
            panel.add_collection(
                LineCollection(list(still[outline]), colors="#777777", linewidths=0.8, linestyles="--")
            )
            moved = scale(mesh.nodes + part * (_DRAWN * size / largest))
            panel.add_collection(LineCollection(list(edges(mesh, moved)), colors=COLOURS["slip"], linewidths=0.4))
            panel.add_collection(LineCollection(list(moved[outline]), colors="#000000", linewidths=1.0))
        panel.set_title(f"T{place} = {number(period)} s\n({number(1.0 / period)} Hz)")
        dam_axes(panel, scale)
        panel.set_xlabel(f"x [{scale.unit}]")
        panel.label_outer()
    _frame(axes[0], scale, low, high, room=0.13)
    handles = [
        Line2D([], [], color="#777777", linestyle="--", linewidth=0.8, label="at rest"),
        Line2D([], [], color="#000000", linewidth=1.0, label="vibrating"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, borderpad=0.1)
    return figure


def intact_shapes(dam: FlexibleDam, count: int) -> tuple[Floats, list[tuple[Floats, ...]]]:
    """Return the longest periods [s] of the dam with its crack bonded, and for each the displacements (n, 2) of both
    parts; their largest component downstream is positive."""
    squares, vectors = lowest(tied(dam, "stiffness"), tied(dam, "mass"), min(count, dam.tie.shape[1]), 0.0)
    shapes = []
    for vector in vectors.T:
        moved = (dam.tie @ vector).reshape(-1, 2)
        moved *= np.sign(moved[np.argmax(np.abs(moved[:, 0])), 0])
        ends = np.cumsum([len(body.mesh.nodes) for body in dam.bodies])[:-1]
        shapes.append(tuple(np.split(moved, ends)))
    return 2.0 * math.pi / np.sqrt(squares), shapes


def edges(mesh: BodyMesh, places: Floats) -> Floats:
    """Return the outlines of all elements, shape (m, 9, 2), with the nodes at these places."""
    return places[mesh.elements[:, _AROUND]]


def extent(dam: FlexibleDam) -> tuple[Floats, Floats]:
    """Return the lower left and the upper right corner of both parts [m]."""
    nodes = np.vstack([body.mesh.nodes for body in dam.bodies])
    return nodes.min(axis=0), nodes.max(axis=0)


def dam_axes(axes: Axes, scale: Scale) -> None:
    """Label axes that show the section, at the same scale both ways."""
    axes.set_aspect("equal")
    axes.set_xlabel(f"x, downstream [{scale.unit}]")
    axes.set_ylabel(f"z, up [{scale.unit}]")


def _frame(axes: Axes, scale: Scale, low: Floats, high: Floats, room: float = 0.06) -> None:
    """Show what is between two corners, with a margin that is a part of the larger side."""
    (left, bottom), (right, top) = low, high
    margin = room * max(right - left, top - bottom)
    axes.set_xlim(scale(left - margin), scale(right + margin))
    axes.set_ylim(scale(bottom - margin), scale(top + margin))


def _hold(axes: Axes, points: Floats, *, rigid: bool) -> None:
    """Draw what does not move: triangles below the nodes of a base that is held, hatching below a crack at the base."""
    size = max(float(np.ptp(points, axis=0).max()), 1e-9)
    if rigid:
        normal = np.array([points[-1, 1] - points[0, 1], points[0, 0] - points[-1, 0]]) / size
        ring = np.vstack([points[[0, -1]], points[[-1, 0]] + 0.03 * size * normal])
        axes.fill(*ring.T, facecolor="none", edgecolor="#555555", hatch="////", linewidth=0.0)
        return
    axes.plot(*(points - [0.0, 0.015 * size]).T, "^", color="#000000", fillstyle="none", markersize=5)
