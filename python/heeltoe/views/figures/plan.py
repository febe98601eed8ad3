"""The path of the slip in the plan of the crack, of a block that the ground shakes across the valley, too."""

from __future__ import annotations

from matplotlib.figure import Figure

from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import largest
from heeltoe.views.figures.style import COLOURS, WIDTH, describe, styled


@styled
def plan_figure(response: Response, units: str = "si") -> Figure:
    """Draw where the block goes on its crack: along the stream to the right, to the left bank upwards."""
    along, across = response.histories.slip_m, response.histories.slip_cross_m
    scale = unit_system(units).scale("displacement", largest(along, across))
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots()
    describe(figure, response)
    axes.plot(scale(along), scale(across), color=COLOURS["slip"], linewidth=1.0, label="slip")
    axes.plot(scale(along[:1]), scale(across[:1]), "o", color="#000000", markersize=5, fillstyle="none", label="start")
    axes.plot(scale(along[-1:]), scale(across[-1:]), "x", color="#000000", markersize=6, label="end")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"slip along the stream [{scale.unit}], + downstream")
    axes.set_ylabel(f"across the valley [{scale.unit}]\n+ to the left bank")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
