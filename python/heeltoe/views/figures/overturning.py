"""Which pulses overturn a block, as a map."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from heeltoe.study.small.overturning import ENDS, OverturningMap
from heeltoe.views.figures.style import heading, styled

# In the order of ENDS; they differ in lightness, too.
_COLOURS = ("#FFFFFF", "#D9E8F5", "#E69F00", "#8C2D04", "#999999")


@styled
def overturning_figure(overturning: OverturningMap) -> Figure:
    """Draw what each pulse does over its frequency and amplitude."""
    figure = Figure(figsize=(7.0, 5.0), layout="constrained")
    axes = figure.subplots()
    axes.pcolormesh(
        overturning.frequency_hz,
        overturning.amplitude_g,
        overturning.end.T,
        cmap=ListedColormap(_COLOURS),
        norm=BoundaryNorm(np.arange(len(ENDS) + 1) - 0.5, len(ENDS)),
        shading="nearest",
        rasterized=True,
    )
    axes.grid(visible=False)
    axes.set_xlabel("frequency of the pulse [Hz]")
    axes.set_ylabel("amplitude of the pulse [g]")
    one = 2.0 * math.pi / overturning.frequency_parameter_1_s
    ratio: Any = (lambda hertz: one * hertz, lambda over: over / one)
    above = axes.secondary_xaxis("top", functions=ratio)
    above.set_xlabel(f"circular frequency over p, p = {overturning.frequency_parameter_1_s:.3g} 1/s")
    seen = [k for k in range(len(ENDS)) if (overturning.end == k).any()]
    axes.legend(
        handles=[Patch(facecolor=_COLOURS[k], edgecolor="#888888", label=ENDS[k]) for k in seen],
        loc="upper center",
        bbox_to_anchor=(0.5, -0.13),
        ncols=2,
    )
    heading(figure, overturning.title or "Untitled case", f"one {overturning.pulse} pulse")
    return figure
