"""Figures of small studies: of a table of runs, of a field that was solved for, of which pulses overturn a block."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.judge import LIMITS
from heeltoe.study.small.overturning import ENDS, OverturningMap
from heeltoe.study.small.run_table import SmallStudy
from heeltoe.study.small.solved import Solved
from heeltoe.units.systems import Scale, unit_system
from heeltoe.units.write import length
from heeltoe.views.figures.crack_level import crack_level_figure
from heeltoe.views.figures.panels import largest
from heeltoe.views.figures.style import COLOURS, WIDTH, heading, styled
from heeltoe.views.figures.time_axis import time_axis

# Okabe and Ito's colours with dashes beside them, so that lines differ in print as well.
_LINES = (
    ("#0072B2", "-"),
    ("#D55E00", "--"),
    ("#009E73", "-."),
    ("#CC79A7", ":"),
    ("#E69F00", "-"),
    ("#56B4E9", "--"),
    ("#000000", "-."),
    ("#999999", ":"),
)
# A value of a field: a number, and its unit.
_NUMBER = re.compile(r"([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*([^\d\s].*)?")
# So many panels stand below each other, more in two columns.
_ONE_COLUMN = 3


def small_figures(grid: SmallStudy, units: str = "si") -> dict[str, Figure]:
    """Return the figures ``slips`` and ``residual-slip`` of a table of runs, and ``crack-level`` of its first run that
    has one."""
    figures = {}
    if any(response.histories for response in grid.responses):
        figures["slips"] = slips_figure(grid, units)
    if _numbers(grid) is not None and sum(response.ok for response in grid.responses) > 1:
        figures["residual-slip"] = residual_slip_figure(grid, units)
    for response in grid.responses:
        if isinstance(response, DecoupledResponse) and response.summary:
            figures["crack-level"] = crack_level_figure(response)
            break
    return figures


@styled
def slips_figure(grid: SmallStudy, units: str = "si") -> Figure:
    """Draw the slip of every run over time: a line for each value of the first varied field, a panel for each
    combination of the others."""
    first, *others = grid.axes
    slips = [response.histories.slip_m for response in grid.responses if response.histories]
    scale = unit_system(units).scale("displacement", largest(*slips))
    panels = list(dict.fromkeys(cell[1:] for cell in grid.cells))
    columns = 1 if len(panels) <= _ONE_COLUMN else 2
    rows = math.ceil(len(panels) / columns)
    figure = Figure(figsize=(WIDTH, 0.9 + 2.4 * rows), layout="constrained")
    axes = np.atleast_1d(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)).reshape(-1)
    heading(figure, grid.title or "Untitled case", f"{_shaken_by(grid)}; {grid.model} model")
    for place, (panel, values) in enumerate(zip(axes, panels, strict=False)):
        names = (f"{other.path} {value}" for other, value in zip(others, values, strict=True))
        panel.set_title(", ".join(names), fontsize=9, loc="left")
        for cell, response in zip(grid.cells, grid.responses, strict=True):
            if cell[1:] != values:
                continue
            colour, dash = _line(first.values.index(cell[0]))
            label = f"{cell[0]}: {length(RESIDUAL_SLIP.of(response), units) if response.ok else response.outcome}"
            h = response.histories
            time, slip = (h.time_s, scale(h.slip_m)) if h else ([], [])
            panel.plot(time, slip, color=colour, linestyle=dash, linewidth=1.2, label=label)
        # Beside the curves, none of which it can cover there.
        panel.legend(
            title=first.path,
            fontsize=8,
            title_fontsize=8,
            alignment="left",
            loc="upper left",
            bbox_to_anchor=(1.0, 1.0),
            handlelength=1.6,
        )
        if place % columns == 0:
            panel.set_ylabel(f"slip [{scale.unit}]\n(+ downstream)")
        if place + columns >= len(panels):
            time_axis(panel, *(response for response in grid.responses if response.histories))
    for unused in axes[len(panels) :]:
        unused.set_visible(False)
    return figure


def _numbers(grid: SmallStudy) -> tuple[list[float], str] | None:
    """Return the values of the first varied field as numbers, and their unit; None where they are no numbers of one
    unit, or where there is a single one."""
    values = grid.axes[0].values
    parts = [_NUMBER.fullmatch(str(value).strip()) for value in values]
    if len(values) == 1 or not all(parts) or len({part[2] for part in parts if part}) > 1:
        return None
    return [float(part[1]) for part in parts if part], next(part[2] for part in parts if part)


@styled
def residual_slip_figure(grid: SmallStudy, units: str = "si") -> Figure:
    """Draw the residual slip over the first varied field: a line for each combination of the others, and the limit of
    the case."""
    first, *others = grid.axes
    varied = _numbers(grid)
    assert varied is not None
    numbers, unit = varied
    limits = {
        check.allowed for response in grid.responses for check in response.limits if check.name == "residual_slip"
    }
    slips = [RESIDUAL_SLIP.of(response) for response in grid.responses if response.ok]
    scale = unit_system(units).scale("displacement", largest(slips, list(limits)))
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots()
    heading(figure, grid.title or "Untitled case", f"{_shaken_by(grid)}; {grid.model} model")
    for place, combination in enumerate(dict.fromkeys(cell[1:] for cell in grid.cells)):
        points = sorted(
            (numbers[first.values.index(cell[0])], float(scale(RESIDUAL_SLIP.of(response))))
            for cell, response in zip(grid.cells, grid.responses, strict=True)
            if cell[1:] == combination and response.ok
        )
        colour, dash = _line(place)
        names = (f"{other.path} {value}" for other, value in zip(others, combination, strict=True))
        if points:
            axes.plot(*zip(*points, strict=True), color=colour, linestyle=dash, marker="o", label=", ".join(names))
    for limit in limits:
        axes.axhline(
            scale(limit), color=COLOURS["crack"], linewidth=0.9, linestyle=(0, (6, 2)), label="residual slip allowed"
        )
    axes.axhline(0.0, color="#000000", linewidth=0.6)
    axes.set_xlabel(f"{first.path} [{unit}]" if unit else first.path)
    axes.set_ylabel(f"residual slip [{scale.unit}]\n(+ downstream)")
    handles, labels = axes.get_legend_handles_labels()
    if any(labels):
        named = [(handle, label) for handle, label in zip(handles, labels, strict=True) if label]
        figure.legend(*zip(*named, strict=True), loc="outside lower center", ncols=2)
    return figure


def _shaken_by(grid: SmallStudy) -> str:
    """Say what shakes the dams, and how strongly: the runs may differ in that."""
    names = dict.fromkeys(response.motion.name for response in grid.responses)
    peaks = [response.motion.pga / response.gravity for response in grid.responses]
    low, high = (f"{peak:.3g}" for peak in (min(peaks), max(peaks)))
    peak = f"peak {low} g" if low == high else f"peaks {low} to {high} g"
    text = f"{' or '.join(names)}, {peak}"
    vertical = any(response.vertical is not None for response in grid.responses)
    return f"{text}, with vertical motion" if vertical else text


def _line(number: int) -> tuple[str, str]:
    """Return colour and dash of a line; with the colours used up, the same with other dashes."""
    turn, place = divmod(number, len(_LINES))
    return _LINES[place][0], _LINES[(place + turn) % len(_LINES)][1]


# What lies this far above the limit does not decide how high the figure is.
_HIGHEST = 5.0


@styled
def solve_figure(solved: Solved, scale: Scale, units: str = "si") -> Figure:
    """Draw the result by the worse sign over the field, the limit, and the crossings; `scale` is that of the field."""
    figure = Figure(figsize=(WIDTH, 4.0), layout="constrained")
    axes = figure.subplots()
    known = [point for point in solved.points if point.result_m is not None]
    results = np.array([point.result_m for point in known], dtype=np.float64)
    high = min(float(results.max(initial=0.0)), _HIGHEST * solved.allowed_m)
    metres = unit_system(units).scale("displacement", largest(np.array([high, solved.allowed_m])))
    values = scale(np.array([point.value for point in known]))
    axes.plot(values, metres(results), color=COLOURS["slip"], marker="o", markersize=3.5, label="worse sign")
    top = 1.12 * float(metres(max(high, solved.allowed_m)))
    beyond = [float(scale(point.value)) for point in solved.points if point.result_m is None]
    if beyond:
        label = "fails, or has no result"
        axes.plot(beyond, np.full(len(beyond), 0.96 * top), "x", color=COLOURS["crack"], label=label, markersize=6)
    axes.axhline(metres(solved.allowed_m), color=COLOURS["crack"], linewidth=1.3, label="allowed")
    for place, crossing in enumerate(solved.crossings):
        at, give = float(scale(crossing.value)), float(scale(crossing.give_or_take or 0.0))
        axes.axvspan(at - give, at + give, color="#BBBBBB", alpha=0.6, linewidth=0.0)
        label = f"just met at {at:.4g} {scale.unit}".rstrip()
        axes.axvline(at, color="#444444", linestyle=("--", ":", "-.")[place % 3], linewidth=1.2, label=label)
    axes.set_ylim(0.0, top)
    axes.set_xlabel(f"{solved.field} [{scale.unit}]" if scale.unit else solved.field)
    axes.set_ylabel(f"{LIMITS[solved.limit].label}, either way [{metres.unit}]")
    axes.legend(loc="best", fontsize=8)
    one_way = "" if solved.one_way else "; not one way"
    heading(figure, solved.title or "Untitled case", f"{solved.model} model, {len(solved.points)} values{one_way}")
    return figure


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
