"""What the decoupled chain makes of the ground's motion at the level of the crack."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.views.figures.style import COLOURS, heading, styled

_CRACK = COLOURS["rotation"]


@styled
def crack_level_figure(response: DecoupledResponse) -> Figure:
    """Draw the acceleration of ground and crack over time, their response spectra and the transfer function."""
    h, level, g = response.histories, response.crack_level, response.gravity
    spectrum = level["spectrum"]
    figure = Figure(figsize=(7.5, 6.6), layout="constrained")
    parts: Any = figure.subfigures(2, 1, height_ratios=[1.0, 1.1])
    top, bottom = parts
    factor = level["amplification"]
    said = "" if factor is None else f", {factor:.3g} times the peak of the ground"
    peak = f"{level['peak_horizontal_g']:.3g} g at the crack{said}"
    heading(figure, response.title or "Untitled case", f"{response.motion.name}: {peak}")
    histories = top.subplots(2, 1, sharex=True, sharey=True)
    for axes, key, colour, label in (
        (histories[0], "ground_acceleration_m_s2", COLOURS["ground"], "ground"),
        (histories[1], "crack_acceleration_m_s2", _CRACK, "crack"),
    ):
        axes.plot(h["time_s"], h[key] / g, color=colour, linewidth=0.6)
        axes.set_ylabel(f"{label}\nacceleration [g]")
    histories[1].set_xlabel("time [s]")
    histories[1].set_xlim(h["time_s"][0], h["time_s"][-1])
    spectra, transfer = bottom.subplots(1, 2)
    periods = np.array(spectrum["periods_s"])
    spectra.plot(periods, spectrum["ground_g"], color=COLOURS["ground"], linewidth=1.2, label="ground")
    spectra.plot(periods, spectrum["crack_g"], color=_CRACK, linewidth=1.4, linestyle="--", label="crack")
    spectra.set_ylabel(f"pseudo-acceleration [g]\n{100.0 * spectrum['damping_ratio']:g} % damping")
    transfer.plot(periods, spectrum["transfer"], color=_CRACK, linewidth=1.4, linestyle="--", label="rigid part above")
    bonded = spectrum["bonded_transfer"]
    transfer.plot(periods, bonded, color=COLOURS["slip"], linewidth=1.2, label="all elastic, no crack")
    transfer.set_ylabel("crack over ground [-]")
    for axes in (spectra, transfer):
        _mark_periods(axes, level["periods_s"])
        axes.set_ylim(0.0, None)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), fontsize=8, ncols=2, handlelength=1.8)
    return figure


def _mark_periods(axes: Axes, periods: list[float]) -> None:
    axes.set_xscale("log")
    axes.set_xlabel("period [s]")
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlim(0.02, 4.0)
    for number, period in enumerate(periods[:3], 1):
        axes.axvline(period, color=COLOURS["limit"], linewidth=0.8, linestyle=":")
        axes.annotate(
            f"T{number}",
            (period, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 2),
            textcoords="offset points",
            ha="center",
            fontsize=7,
            color="#555555",
        )
