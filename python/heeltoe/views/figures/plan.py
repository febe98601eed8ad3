"""The path of the slip in the plan of the crack, of a block that the ground shakes across the valley, too."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import largest
from heeltoe.views.figures.style import COLOURS, WIDTH, describe, styled

# A path flatter than this would be a line with equal scales.
_FLAT = 0.2
# Neighbours farther than this part of the width of the path from it are not drawn.
_NEAR = 0.25


@styled
def plan_figure(response: Response, units: str = "si", side_gap: tuple[float, float] | None = None) -> Figure:
    """Draw where the block goes on its crack: along the stream to the right, to the left bank upwards.

    Parameters
    ----------
    response
        Of a block that the ground shakes across the valley.
    units
        ``"si"`` or ``"us"``.
    side_gap
        Joints to the left and the right neighbour [m]; None without neighbours.
    """
    along, across = response.histories.slip_m, response.histories.slip_cross_m
    scale = unit_system(units).scale("displacement", largest(along, across))
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots()
    extents = float(np.ptp(along)), float(np.ptp(across))
    equal = min(extents) >= _FLAT * max(extents)
    describe(figure, response, "" if equal else "the two axes have different scales")
    axes.plot(scale(along), scale(across), color=COLOURS["slip"], linewidth=1.0, label="slip")
    axes.plot(scale(along[:1]), scale(across[:1]), "o", color="#000000", markersize=5, fillstyle="none", label="start")
    axes.plot(scale(along[-1:]), scale(across[-1:]), "x", color="#000000", markersize=6, label="end")
    if equal:
        axes.set_aspect("equal", adjustable="datalim")
    else:
        axes.margins(y=0.12)
    for side, way, gap in zip(("left", "right"), (1.0, -1.0), side_gap or (), strict=False):
        if gap > max(way * across) + _NEAR * extents[1]:
            continue
        level, over = float(scale(way * gap)), axes.get_yaxis_transform()
        axes.plot([0.0, 1.0], [level, level], color=COLOURS["limit"], linestyle="--", linewidth=1.0, transform=over)
        axes.annotate(
            f"{side} neighbour",
            (0.5, level),
            (0.0, 2.0 * way),
            xycoords=over,
            textcoords="offset points",
            ha="center",
            va="bottom" if way > 0.0 else "top",
        )
    axes.set_xlabel(f"slip along the stream [{scale.unit}], + downstream")
    axes.set_ylabel(f"across the valley [{scale.unit}]\n+ to the left bank")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
