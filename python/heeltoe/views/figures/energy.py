"""Where the energy goes that water, weight and ground put into the dam."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.base.arrays import Floats
from heeltoe.result.numbers import Energy
from heeltoe.result.response import Response
from heeltoe.units.systems import Scale, unit_system
from heeltoe.units.write import number
from heeltoe.views.figures.panels import kind_of, largest
from heeltoe.views.figures.style import WIDTH, describe, styled
from heeltoe.views.figures.time_axis import time_axis


@dataclass(frozen=True)
class _Entry:
    """How an entry of the ledger looks."""

    label: str
    colour: str
    dash: str
    hatch: str


_INPUT = _Entry("put in", "#000000", "-", "")
_FRICTION = _Entry("friction", "#0072B2", "--", "///")
_DAMPING = _Entry("damping", "#009E73", "-.", "...")
_IMPACT = _Entry("impacts", "#D55E00", ":", "xxx")
_FRACTURE = _Entry("fracture", "#E69F00", (0, (1, 1)), "///\\\\\\")  # type: ignore[arg-type]
_ROCK = _Entry("the rock", "#8C6D31", (0, (4, 1, 1, 1)), "xx")  # type: ignore[arg-type]
_WATER = _Entry("the reservoir", "#56B4E9", (0, (3, 2)), "oo")  # type: ignore[arg-type]
_STORED = _Entry("stored since the start", "#CC79A7", (0, (5, 1, 1, 1, 1, 1)), "\\\\\\")  # type: ignore[arg-type]
_NUMERICAL = _Entry("time stepping", "#999999", "-", "")
# Of what is put in, an entry below this share is not worth a bar, except the three that everyone asks for.
_SLIGHT = 1e-3


@styled
def energy_figure(response: Response, units: str = "si") -> Figure:
    """Draw the energy ledger: what was put in, and where it has gone, over time and in the end.

    Of a rigid block the curves are the losses in friction, from the forces at the moments of the histories, and in
    impacts, which events know exactly; the bars are the ledger's own.
    """
    ledger = response.energy
    assert ledger is not None
    curves = _elastic_curves(response) if "input_energy_j" in response.histories else _rigid_curves(response)
    bars = _bars(ledger)
    system = unit_system(units)
    # What a falling block is given is much more than it loses on the way: each panel has its own unit.
    scale = system.scale("energy", largest(*(values for _, values in curves)))
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    over_time, in_the_end = figure.subplots(1, 2, width_ratios=[2.0, 1.4])
    describe(figure, response)
    time = response.histories.time_s
    for entry, values in curves:
        over_time.plot(time, scale(values), color=entry.colour, linestyle=entry.dash, linewidth=1.2, label=entry.label)
    over_time.set_ylabel(f"energy [{scale.unit}]")
    time_axis(over_time, response)
    _waterfall(in_the_end, bars, system.scale("energy", largest(*(value for _, value in bars))))
    figure.legend(*over_time.get_legend_handles_labels(), loc="outside lower center", ncols=len(curves))
    return figure


def _elastic_curves(response: Response) -> list[tuple[_Entry, Floats]]:
    h = response.histories
    return [
        (_INPUT, h.input_energy_j),
        (_FRICTION, h.friction_energy_j),
        (_DAMPING, h.damping_energy_j),
        (_IMPACT, h.impact_energy_j),
        (_STORED, h.stored_energy_j - h.stored_energy_j[0]),
    ]


def _rigid_curves(response: Response) -> list[tuple[_Entry, Floats]]:
    curves = [(_FRICTION, friction_loss(response))]
    if "energy_lost_j" in response.event_log:
        log = response.event_log
        lost = np.concatenate([[0.0], np.cumsum(log.energy_lost_j)])
        if lost[-1]:
            curves.append((_IMPACT, lost[np.searchsorted(log.time_s, response.histories.time_s, side="right")]))
    return curves


def friction_loss(response: Response) -> Floats:
    """Return the work lost in friction up to each moment of the histories [J/m], force times slip from one moment to
    the next; the force is that of the ends of the interval at which the block slides. On a rough crack part of that
    work lifts the block: what is lost is the plastic work of its flanks."""
    h = response.histories
    if "plastic_work_j_m2" in h:
        return np.asarray(h.plastic_work_j_m2 * response.crack_width_m, dtype=np.float64)
    slides = np.array([kind_of(mode) in ("slide", "slide-rock") for mode in response.mode])
    force = np.where(slides, np.abs(h.friction_force_n), 0.0)
    ends = slides[1:].astype(float) + slides[:-1]
    mean = (force[1:] + force[:-1]) / np.maximum(ends, 1.0)
    return np.concatenate([[0.0], np.cumsum(mean * np.abs(np.diff(h.slip_m)))])


def _bars(ledger: Energy) -> list[tuple[_Entry, float]]:
    entries = [
        (_INPUT, ledger.input_j),
        (_FRICTION, ledger.friction_j),
        (_DAMPING, ledger.damping_j),
        (_IMPACT, ledger.impact_j),
        (_FRACTURE, ledger.fracture_j),
        (_ROCK, ledger.rock_j),
        (_WATER, ledger.floor_j + ledger.far_end_j),
        (_STORED, ledger.left_j),
        (_NUMERICAL, ledger.numerical_j),
    ]
    least = _SLIGHT * abs(ledger.input_j)
    always = (_INPUT, _FRICTION, _IMPACT)
    return [(entry, value) for entry, value in entries if entry in always or abs(value) > least]


def _waterfall(axes: Axes, bars: list[tuple[_Entry, float]], scale: Scale) -> None:
    """Draw what was put in, and each loss beginning where what is left ends; every bar has a row with its value."""
    left = scale(bars[0][1])
    names = []
    for row, (entry, value) in enumerate(bars):
        drawn = scale(value)
        start = 0.0 if row == 0 else left - drawn
        axes.barh(
            row,
            drawn,
            left=start,
            height=0.7,
            facecolor=entry.colour if row == 0 else "white",
            edgecolor=entry.colour,
            hatch=entry.hatch,
            linewidth=1.0,
        )
        if row:
            axes.plot([left, left], [row - 1.35, row + 0.35], color="#888888", linewidth=0.6)
            left -= drawn
        written = number(drawn, 3 if abs(drawn) > 0.1 * scale(bars[0][1]) else 2)
        names.append(f"{entry.label.removesuffix(' since the start')}  {written}")
    axes.axvline(0.0, color="#000000", linewidth=0.6)
    axes.set_yticks(range(len(bars)), names)
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    axes.set_xlabel(f"in the end [{scale.unit}]")
    axes.grid(visible=False, axis="y")
    axes.margins(x=0.05)
