"""The response spectrum of the motion, with the dam's own periods."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.result.histories import AT_CRACK
from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.units.write import number
from heeltoe.views.figures.style import COLOURS, WIDTH, describe, styled
from heeltoe.views.words.starts import starts

_MARKED = 4
_PERIODS = "#006B4E"
# Two names nearer to each other than this part of the width of the axis stand one above the other.
_APART = 0.07
_ROWS = 3


@styled
def spectrum_figure(response: Response, units: str = "si", periods_s: Sequence[float] | None = None) -> Figure:
    """Draw the 5 % response spectrum of the motion used, the dam's longest periods, and the acceleration at which a
    rigid block starts to move.

    Parameters
    ----------
    response
        Of any model. Behind the motion at the crack of a decoupled one stands the ground's.
    units
        ``"si"`` or ``"us"``; accelerations are in g in both.
    periods_s
        Periods to mark [s]; those of the response where not given, if it has any.
    """
    unit_system(units)
    figure = Figure(figsize=(WIDTH, 4.4), layout="constrained")
    axes = figure.subplots()
    describe(figure, response)
    g = response.gravity
    ground = response_spectrum(response.motion)
    crack = _crack_motion(response)
    if crack is None:
        axes.semilogx(
            ground.period, ground.pseudo_acceleration / g, color=COLOURS["ground"], label="ground motion, 5 % damping"
        )
    else:
        above = response_spectrum(crack)
        axes.semilogx(
            above.period, above.pseudo_acceleration / g, color=COLOURS["slip"], label="at the crack, 5 % damping"
        )
        axes.semilogx(
            ground.period, ground.pseudo_acceleration / g, color="#999999", linestyle="--", label="ground, 5 % damping"
        )
    if response.vertical is not None:
        up = response_spectrum(response.vertical)
        axes.semilogx(
            up.period,
            up.pseudo_acceleration / g,
            color=COLOURS["toe"],
            linestyle=":",
            label="vertical ground motion, 5 % damping",
        )
    start = min(starts(response).values(), key=lambda start: start.value)
    top = axes.get_ylim()[1]
    if 0.0 < start.value < 4.0 * top:
        top = max(top, 1.1 * start.value)
        text = f"{start.kind} {start.way} of a rigid block starts at {start}"
        text += ", without vertical motion" if response.vertical is not None else ""
        axes.axhline(start.value, color=COLOURS["rotation"], linestyle="-.", linewidth=1.1, label=text)
    axes.set_ylim(0.0, top)
    axes.set_xlim(ground.period[0], ground.period[-1])
    periods = list(response.summary.get("periods_s", ()) if periods_s is None else periods_s)[:_MARKED]
    mark_periods(axes, periods, _PERIODS)
    if periods:
        named = ", ".join(f"T{place} {number(period, 3)} s" for place, period in enumerate(periods, 1))
        axes.plot([], [], color=_PERIODS, linestyle=(0, (4, 2)), linewidth=0.9, label=f"intact dam: {named}")
    axes.set_xlabel("period [s]")
    axes.set_ylabel("pseudo-acceleration [g]")
    axes.xaxis.set_major_formatter(lambda value, _: np.format_float_positional(value, trim="-"))
    axes.grid(visible=True, which="minor", axis="x", color="#F2F2F2", linewidth=0.4)
    # One below the other: what they say has numbers in it.
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=1)
    return figure


def mark_periods(axes: Axes, periods: Sequence[float], colour: str) -> None:
    """Draw a line for each period [s] within the limits of a logarithmic axis, counted from the longest."""
    low, high = (math.log(limit) for limit in axes.get_xlim())
    row, before = 0, math.inf
    for count, period in enumerate(periods, 1):
        place = (math.log(period) - low) / (high - low)
        if not 0.0 < place < 1.0:
            continue
        row = (row + 1) % _ROWS if before - place < _APART else 0
        before = place
        axes.axvline(period, color=colour, linewidth=0.9, linestyle=(0, (4, 2)), zorder=1.6)
        axes.annotate(
            f"T{count}",
            (period, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 2 + 8 * row),
            textcoords="offset points",
            ha="center",
            fontsize=7,
            color=colour,
        )


def _crack_motion(response: Response) -> GroundMotion | None:
    """Return the motion at the crack of a decoupled model, as the histories have it."""
    values = response.histories.get(AT_CRACK)
    if values is None:
        return None
    return GroundMotion("at the crack", response.histories.time_s, values)
