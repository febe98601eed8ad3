"""How far single runs slide with the shaking varied, where they scatter."""

from __future__ import annotations

import numpy as np
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
        elif way * allowed < slips.min():
            axes.set_title(f"← limit {length(allowed, units)}, to the left", color=COLOURS["crack"], loc="left")
        else:
            axes.set_title(f"limit {length(allowed, units)}, to the right →", color=COLOURS["crack"], loc="right")
    axes.set_xlabel(f"{RESIDUAL_SLIP.label} [{scale.unit}], + downstream")
    axes.set_ylabel("runs")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure
