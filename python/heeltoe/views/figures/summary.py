"""The picture of page one: the section beside its motion and its slip."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.case.model import Case
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from heeltoe.units.systems import Units, unit_system
from heeltoe.views.figures.canvas import Canvas
from heeltoe.views.figures.panels import beside, draw_rotation, largest, slip_in_the_end
from heeltoe.views.figures.section import (
    corners,
    draw_anchors,
    draw_bodies,
    draw_crack,
    draw_dimensions,
    draw_drains,
    draw_further,
)
from heeltoe.views.figures.shaking import draw_horizontal
from heeltoe.views.figures.style import COLOURS, LOOKS, WIDTH, styled
from heeltoe.views.figures.time_axis import time_axis

_HEIGHT = 2.8
# Shares of the width: the section, and from where on the histories are.
_SECTION, _HISTORIES = 0.41, 0.55


@styled
def summary_figure(case: Case, shown: tuple[Response, ...], units: str = "si") -> Figure:
    """Draw the section without its forces, and beside it the acceleration of the ground and the slip; of a
    block that overturns its rotation.

    Parameters
    ----------
    case
        The dam.
    shown
        The runs that have histories, the one that is judged first; without any there is the section alone.
    units
        ``"si"`` or ``"us"``.
    """
    system = unit_system(units)
    figure = Figure(figsize=(WIDTH, _HEIGHT))
    _draw_section(figure.add_axes((0.005, 0.01, _SECTION if shown else 0.99, 0.98)), case, system)
    if shown:
        # Room for half of the last label of the time axis.
        width = 0.97 - _HISTORIES
        ground = figure.add_axes((_HISTORIES, 0.60, width, 0.31))
        slip = figure.add_axes((_HISTORIES, 0.15, width, 0.34), sharex=ground)
        draw_horizontal(ground, shown[0])
        ground.set_title("")
        ground.set_ylabel("ground [g]")
        ground.tick_params(labelbottom=False)
        if shown[0].outcome == Outcome.OVERTURNED:
            draw_rotation(slip, shown[0], system)
            time_axis(slip, shown[0])
            slip.set_xlabel("time [s]")
        else:
            _draw_slips(slip, shown, system)
        for axes in (ground, slip):
            axes.yaxis.set_label_coords(-0.165, 0.5)
    return figure


def _draw_section(axes: Axes, case: Case, units: Units) -> None:
    left, base, right, crest = case.outline.bounds
    canvas = Canvas(axes, units.scale("length"), max(right - left, crest - base))
    canvas.look_at(*corners(case, canvas.size, below=0.18))
    draw_bodies(canvas, case)
    anchored = draw_anchors(canvas, case)
    draw_dimensions(canvas, case, 0.0, small=True)
    draw_crack(canvas, case, small=True)
    draw_further(canvas, case)
    draw_drains(canvas, case)
    if anchored is not None:
        canvas.label("anchors" if len(case.anchors) > 1 else "anchor", anchored, COLOURS["crack"])
    axes.set_axis_off()


def _draw_slips(axes: Axes, shown: tuple[Response, ...], units: Units) -> None:
    """Draw the slip of each run, of several cracks those at each, and say what remains of the first."""
    curves = _of_cracks(shown[0], units) or [(f"{item.model} model", item) for item in shown]
    scale = units.scale("displacement", largest(*(response.histories.slip_m for _, response in curves)))
    for (label, response), (colour, dash) in zip(curves, LOOKS, strict=False):
        time, slip = response.histories.time_s, scale(response.histories.slip_m)
        axes.plot(time, slip, color=COLOURS[colour], linestyle=dash, linewidth=1.2, label=label)
    if not any(response.histories.slip_m.any() for _, response in curves):
        axes.set_ylim(-1.0, 1.0)
    axes.set_ylabel(f"slip [{scale.unit}]\n(+ downstream)")
    time_axis(axes, *shown)
    axes.set_xlabel("time [s]")
    text = slip_in_the_end(shown[0], scale).replace(" (dotted)", "")
    beside(axes, text, colour=COLOURS["slip"])
    if len(curves) > 1:
        axes.legend(loc="best", fontsize=7, handlelength=2.2)


def _of_cracks(response: Response, units: Units) -> list[tuple[str, Response]]:
    """Return what happens at each of several cracks, the one that leads first, with where it is; none of one crack."""
    if not response.several:
        return []
    length = units.scale("length")
    places = sorted(range(len(response.cracks)), key=lambda place: place != response.governing_crack)
    return [
        (f"crack at {length(response.cracks[place].elevation):.4g} {length.unit}", response.at_crack(place))
        for place in places
    ]
