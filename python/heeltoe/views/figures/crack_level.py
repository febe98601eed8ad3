"""Motion of the decoupled chain at the level of the crack."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter
from matplotlib.transforms import ScaledTranslation

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.result.histories import AT_CRACK, GROUND
from heeltoe.views.figures.spectrum import mark_periods
from heeltoe.views.figures.style import COLOURS, WIDTH, heading, styled
from heeltoe.views.figures.time_axis import time_axis

# The crack's motion has the colour that it has in all figures.
_CRACK = COLOURS["slip"]
_MARKED = 3
# Height of ticks and label of the axis above the legend [pt].
_BELOW = 27.0


@styled
def crack_level_figure(response: DecoupledResponse) -> Figure:
    """Draw the acceleration of ground and crack over time, their response spectra and the transfer function."""
    h, level, g = response.histories, response.crack_level, response.gravity
    spectrum = level.spectrum
    figure = Figure(figsize=(WIDTH, 6.2), layout="constrained")
    parts: Any = figure.subfigures(2, 1, height_ratios=[1.0, 1.1])
    top, bottom = parts
    factor = level.amplification
    share = "" if factor is None else f", {factor:.3g} times the peak of the ground"
    peak = f"{level.peak_horizontal_g:.3g} g at the crack{share}"
    heading(figure, response.title or "Untitled case", f"{response.motion.name}: {peak}")
    histories = top.subplots(2, 1, sharex=True, sharey=True)
    for axes, key, colour, label in (
        (histories[0], GROUND, COLOURS["ground"], "ground"),
        (histories[1], AT_CRACK, _CRACK, "crack"),
    ):
        axes.plot(h.time_s, h[key] / g, color=colour, linewidth=0.6)
        axes.set_ylabel(f"{label} [g]")
    time_axis(histories[1], response)
    spectra, transfer = bottom.subplots(1, 2)
    periods = np.array(spectrum.periods_s)
    spectra.plot(periods, spectrum.ground_g, color=COLOURS["ground"], linewidth=1.2, label="ground")
    spectra.plot(periods, spectrum.crack_g, color=_CRACK, linewidth=1.4, linestyle="--", label="crack")
    spectra.set_ylabel(f"pseudo-acceleration [g]\n{100.0 * spectrum.damping_ratio:g} % damping")
    transfer.plot(periods, spectrum.transfer, color=_CRACK, linewidth=1.4, linestyle="--", label="rigid part above")
    bonded = spectrum.bonded_transfer
    transfer.plot(periods, bonded, color=COLOURS["rotation"], linewidth=1.2, label="all elastic, no crack")
    transfer.set_ylabel("amplification [-]")
    for axes in (spectra, transfer):
        _period_axis(axes)
        mark_periods(axes, level.periods_s[:_MARKED], "#555555")
        axes.set_ylim(0.0, None)
        # Below the label of the axis, however high the panel is.
        below = axes.transAxes + ScaledTranslation(0.0, -_BELOW / 72.0, figure.dpi_scale_trans)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=below, ncols=2, handlelength=1.8)
    return figure


def _period_axis(axes: Axes) -> None:
    axes.set_xscale("log")
    axes.set_xlabel("period [s]")
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlim(0.02, 4.0)
