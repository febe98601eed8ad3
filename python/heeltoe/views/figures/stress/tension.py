"""The largest tension at every place of an elastic dam over the whole run."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation, TriContourSet

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.mesh.checks import boundary_edges
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.units.systems import Scale, unit_system
from heeltoe.views.figures.dam import dam_axes, extent
from heeltoe.views.figures.style import COLOURS, WIDTH, describe, styled
from heeltoe.views.words.response import tension_line

_LEVELS = 8
_UNREAD = "#E4E4E4"


@styled
def tension_figure(response: FlexibleResponse, units: str = "si") -> Figure:
    """Draw the envelope of the largest principal tension over a run, with the place of the largest of all marked.

    Parameters
    ----------
    response
        Of the flexible model, with a tension to tell.
    units
        ``"si"`` or ``"us"``.
    """
    system = unit_system(units)
    tension = response.tension
    assert tension is not None
    dam = response.crack.dam
    low, high = extent(dam)
    wide, tall = high - low
    figure = Figure(figsize=(WIDTH, float(np.clip(5.0 * tall / wide + 1.6, 3.4, 7.5))), layout="constrained")
    describe(figure, response, f"Largest: {tension_line(tension, units)}")
    axes = figure.subplots()
    length, stress = system.scale("length"), system.scale("pressure", max(tension.stress_pa, 1.0))
    image = _tensions(axes, response, length, stress)
    bar = figure.colorbar(image, ax=axes, location="right", aspect=30, pad=0.02)
    if tension.strength is not None:
        # Beside the colours, so that one sees what there is over what the concrete bears.
        bar.ax.axhline(stress(tension.strength.dynamic_pa), color=COLOURS["slip"], linewidth=1.8)
    bar.set_label(f"largest tension [{stress.unit}]")
    for body in dam.bodies:
        outline = boundary_edges(body.mesh.elements)
        axes.add_collection(LineCollection(list(length(body.mesh.nodes)[outline]), colors="#000000", linewidths=1.0))
    for body in dam.bodies[: dam.free]:
        axes.plot(*length(body.mesh.nodes[body.mesh.faces[-1]]).T, color=COLOURS["crack"], linewidth=1.6)
    place = length(np.array([tension.x_m, tension.z_m]))
    axes.plot(*place, "o", markersize=9, markerfacecolor="none", markeredgecolor="#000000", markeredgewidth=1.6)
    across = tension.direction_rad + np.pi / 2.0
    reach = 0.06 * length(max(wide, tall)) * np.array([np.cos(across), np.sin(across)])
    axes.plot(*np.column_stack([place - reach, place + reach]), color="#000000", linewidth=1.6)
    room = 0.05 * length(max(wide, tall))
    axes.set_xlim(length(low[0]) - room, length(high[0]) + room)
    axes.set_ylim(length(low[1]) - room, length(high[1]) + room)
    dam_axes(axes, length)
    figure.legend(handles=_key(response), loc="outside lower center", ncols=2)
    return figure


def _tensions(axes: Axes, response: FlexibleResponse, length: Scale, stress: Scale) -> TriContourSet:
    """Fill contours of the tension where it has a bound, and grey elsewhere; draw the line of the strength."""
    tension = response.tension
    assert tension is not None
    most = stress(max(tension.stress_pa, 1.0))
    levels = MaxNLocator(_LEVELS, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, most)
    for body, part in zip(response.crack.dam.bodies, response.envelope, strict=True):
        places = length(body.mesh.nodes[part.nodes])
        corners = np.searchsorted(part.nodes, body.mesh.elements[:, :4])
        triangles = np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
        values = np.maximum(stress(part.tension), 0.0)
        unread = ~part.bounded[triangles].all(axis=1)
        for triangle in places[triangles[unread]]:
            axes.fill(*triangle.T, facecolor=_UNREAD, edgecolor=_UNREAD, linewidth=0.3)
        if unread.all():
            continue
        net = Triangulation(places[:, 0], places[:, 1], triangles, mask=unread)
        image = axes.tricontourf(net, values, levels=levels, cmap="Oranges")
        if tension.strength is not None and _crosses(values[part.bounded], stress(tension.strength.dynamic_pa)):
            beyond = [stress(tension.strength.dynamic_pa)]
            axes.tricontour(net, values, levels=beyond, colors=COLOURS["slip"], linewidths=1.6)
    return image


def _crosses(values: Floats, level: float) -> bool:
    return bool(values.size) and bool(values.min() < level < values.max())


def _key(response: FlexibleResponse) -> list[Line2D | Patch]:
    tension = response.tension
    assert tension is not None
    handles: list[Line2D | Patch] = [
        Line2D(
            [], [], color="#000000", marker="o", fillstyle="none", markersize=8, label="largest; a crack would run so"
        ),
        Patch(facecolor=_UNREAD, label="not read: no bound"),
        Line2D([], [], color=COLOURS["crack"], linewidth=1.6, label="the crack"),
    ]
    if tension.strength is not None:
        handles.append(Line2D([], [], color=COLOURS["slip"], linewidth=1.6, label="what the concrete bears"))
    return handles
