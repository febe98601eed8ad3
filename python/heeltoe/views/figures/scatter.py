"""How far single runs slide with the shaking varied, where they scatter."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.units.systems import unit_system
from heeltoe.units.write import length
from heeltoe.views.figures.panels import largest
from heeltoe.views.figures.style import COLOURS, WIDTH, describe, styled

# Fewer bars than runs say where they lie.
_BARS = 16
# Where a note stands, and where its arrow ends, across the axes.
_EDGES = {"left": (0.12, 0.0), "right": (0.88, 1.0)}


@styled
def scatter_figure(response: FlexibleResponse, units: str = "si") -> Figure:
    """Draw how many runs with the shaking varied slide how far, with their mean, their 16 and 84 % fractiles, and the
    limit of the slip."""
    evidence = response.evidence
    assert evidence is not None
    worth = evidence.residual_slip_m
    assert worth.distribution is not None
    slips = np.array([slip for slip in evidence.residual_slips_m if slip is not None])
    limits = [check.allowed for check in response.limits if check.name == "residual_slip"]
    scale = unit_system(units).scale("displacement", largest(slips))
    figure = Figure(figsize=(WIDTH, 3.2), layout="constrained")
    axes = figure.subplots()
    describe(figure, response, f"{len(evidence.scales)} runs with the shaking scaled by 0.99 to 1.01")
    axes.hist(scale(slips), bins=_BARS, color=COLOURS["slip"], alpha=0.45, edgecolor="white", linewidth=0.5)
    lines = [
        (worth.value, "-", "mean"),
        (worth.distribution.fractile_16, ":", "16 % of the runs keep to"),
        (worth.distribution.fractile_84, "--", "84 % of the runs keep to"),
    ]
    for slip, dash, label in lines:
        if slip is not None:
            axes.axvline(float(scale(slip)), color="#000000", linestyle=dash, linewidth=1.4, label=label)
    way = np.sign(worth.value)
    for allowed in limits:
        # A limit far from all runs would make their bars a sliver.
        beyond = max(slips.min() - way * allowed, way * allowed - slips.max())
        if beyond <= np.ptp(slips):
            axes.axvline(float(scale(way * allowed)), color=COLOURS["crack"], linewidth=1.4, label="limit")
        else:
            _point_to(axes, f"limit {length(allowed, units)}", "right" if way * allowed > slips.max() else "left")
    axes.set_xlabel(f"{RESIDUAL_SLIP.label} [{scale.unit}], + downstream")
    axes.set_ylabel("runs")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _point_to(axes: Axes, words: str, side: str) -> None:
    """Write at an edge of the axes what lies beyond it."""
    note, tip = _EDGES[side]
    axes.annotate(
        f"{words},\nto the {side}",
        (tip, 0.9),
        (note, 0.9),
        xycoords="axes fraction",
        color=COLOURS["crack"],
        ha=side,
        va="center",
        arrowprops={"arrowstyle": "->", "color": COLOURS["crack"]},
    )
