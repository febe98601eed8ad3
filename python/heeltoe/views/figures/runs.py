"""A table of runs as curves."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.study.small.run_table import SmallStudy
from heeltoe.units.systems import unit_system
from heeltoe.units.write import length
from heeltoe.views.figures.crack_level import crack_level_figure
from heeltoe.views.figures.panels import largest
from heeltoe.views.figures.style import heading, styled
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
# So many panels stand below each other, more in two columns.
_ONE_COLUMN = 3


def small_figures(grid: SmallStudy, units: str = "si") -> dict[str, Figure]:
    """Return the figure ``slips`` of a table of runs, and ``crack-level`` of its first run that has one."""
    figures = {}
    if any(response.histories for response in grid.responses):
        figures["slips"] = slips_figure(grid, units)
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
    slips = [response.histories["slip_m"] for response in grid.responses if response.histories]
    scale = unit_system(units).scale("displacement", largest(*slips))
    panels = list(dict.fromkeys(cell[1:] for cell in grid.cells))
    columns = 1 if len(panels) <= _ONE_COLUMN else 2
    rows = math.ceil(len(panels) / columns)
    figure = Figure(figsize=(7.5, 0.9 + 2.4 * rows), layout="constrained")
    axes = np.atleast_1d(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)).reshape(-1)
    heading(figure, grid.title or "Untitled case", f"{_shaken_by(grid)}; {grid.model} model")
    for place, (panel, values) in enumerate(zip(axes, panels, strict=False)):
        names = (f"{other.path} {value}" for other, value in zip(others, values, strict=True))
        panel.set_title(", ".join(names), fontsize=9, loc="left")
        for cell, response in zip(grid.cells, grid.responses, strict=True):
            if cell[1:] != values:
                continue
            colour, dash = _line(first.values.index(cell[0]))
            label = f"{cell[0]}: {length(response.residual_slip_m, units) if response.ok else response.outcome}"
            h = response.histories
            time, slip = (h["time_s"], scale(h["slip_m"])) if h else ([], [])
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
