"""The response spectrum of what shakes the dam, with the dam's own periods."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.spectrum import PERIODS, response_spectrum
from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.units.write import number
from heeltoe.views.figures.panels import BEHIND_TEXT
from heeltoe.views.figures.style import COLOURS, WIDTH, describe, styled

_MARKED = 4
# Two periods nearer to each other than this ratio have no room for a text between them.
_CLOSE = 1.25


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
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
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
    limits = response.static["critical_acceleration_g"]
    limit, kind = min((limits[kind], kind) for kind in ("sliding", "rocking"))
    top = axes.get_ylim()[1]
    if 0.0 < limit < 4.0 * top:
        axes.axhline(limit, color=COLOURS["rotation"], linestyle="-.", linewidth=1.1)
        axes.annotate(
            f"{kind} of a rigid block starts at {number(limit, 2)} g",
            (0.0, limit),
            xycoords=("axes fraction", "data"),
            xytext=(4, 3),
            textcoords="offset points",
            ha="left",
            fontsize=8,
            color=COLOURS["rotation"],
            bbox=BEHIND_TEXT,
        )
    periods = response.summary.get("periods_s", ()) if periods_s is None else periods_s
    # The names of the periods stand above the curve.
    room = 1.4 if len(periods) else 1.1
    axes.set_ylim(0.0, room * max(top, limit if limit < 4.0 * top else 0.0))
    _mark(axes, periods)
    axes.set_xlim(ground.period[0], ground.period[-1])
    axes.set_xlabel("period [s]")
    axes.set_ylabel("pseudo-acceleration [g]")
    axes.xaxis.set_major_formatter(lambda value, _: np.format_float_positional(value, trim="-"))
    axes.grid(visible=True, which="minor", axis="x", color="#F2F2F2", linewidth=0.4)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _mark(axes: Axes, periods: Sequence[float]) -> None:
    """Mark the longest periods, counted from the longest."""
    left, top = PERIODS[0], axes.get_ylim()[1]
    marked = [period for period in list(periods)[:_MARKED] if period > left]
    for place, period in enumerate(marked, start=1):
        # The text stands before its line, or after it where the next shorter period is close.
        crowded = place < len(marked) and period < _CLOSE * marked[place]
        axes.axvline(period, color=COLOURS["toe"], linewidth=1.0, linestyle=(0, (4, 2)))
        axes.text(
            period,
            0.98 * top,
            f"T{place} = {number(period, 3)} s ",
            rotation=90,
            ha="left" if crowded else "right",
            va="top",
            fontsize=7,
            color="#006B4E",
            bbox=BEHIND_TEXT,
        )
    if marked:
        axes.plot([], [], color=COLOURS["toe"], linestyle=(0, (4, 2)), linewidth=1.0, label="periods of the intact dam")


def _crack_motion(response: Response) -> GroundMotion | None:
    """Return the motion at the crack of a decoupled model, as the histories have it."""
    values = response.histories.get("crack_acceleration_m_s2")
    if values is None:
        return None
    return GroundMotion("at the crack", response.histories["time_s"], values)
