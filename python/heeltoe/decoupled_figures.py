"""Figures of the decoupled chain and of tables of runs (matplotlib)."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from heeltoe.figures import COLOURS, STYLE
from heeltoe.response import Response
from heeltoe.variations import Grid
from heeltoe.verdicts import length

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
_CRACK = COLOURS["rotation"]


def write_crack_level_figure(response: Response, directory: Path) -> list[Path]:
    """Write the figure ``crack-level`` into `directory` as PNG and SVG and return the paths."""
    return _write(crack_level_figure, response, directory / "crack-level") if response.summary else []


def write_grid_figures(grid: Grid, directory: Path) -> list[Path]:
    """Write the figure ``slips`` of a table of runs, and ``crack-level`` of its first run that has one."""
    written = _write(slips_figure, grid, directory / "slips") if any(each.histories for each in grid.responses) else []
    for response in grid.responses:
        if response.model == "decoupled" and response.summary:
            return written + write_crack_level_figure(response, directory)
    return written


def crack_level_figure(response: Response) -> Figure:
    """Draw the acceleration of ground and crack over time, their response spectra and the transfer function."""
    h, level, g = response.histories, response.crack_level, response.gravity
    spectrum = level["spectrum"]
    figure = Figure(figsize=(7.5, 6.6), layout="constrained")
    parts: Any = figure.subfigures(2, 1, height_ratios=[1.0, 1.1])
    top, bottom = parts
    factor = level["amplification"]
    said = "" if factor is None else f", {factor:.3g} times the peak of the ground"
    figure.suptitle(
        f"{response.title or 'Untitled case'}\n{response.motion.name}: {level['peak_horizontal_g']:.3g} g at the crack"
        f"{said}",
        fontsize=10,
        x=0.01,
        ha="left",
    )
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
    transfer.set_ylabel("|crack / ground|")
    for axes in (spectra, transfer):
        _mark_periods(axes, level["periods_s"])
        # Above the highest peak there is room for the legend.
        axes.set_ylim(0.0, 1.2 * axes.get_ylim()[1])
        axes.legend(loc="upper right", fontsize=8, ncols=2, columnspacing=1.0, handlelength=1.6)
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


def slips_figure(grid: Grid) -> Figure:
    """Draw the slip of every run over time: a line for each value of the first varied field, a panel for each
    combination of the others."""
    first, *others = grid.variations
    panels = list(dict.fromkeys(cell[1:] for cell in grid.cells))
    columns = min(2, len(panels))
    rows = math.ceil(len(panels) / columns)
    figure = Figure(figsize=(7.5, 0.9 + 2.4 * rows), layout="constrained")
    axes = np.atleast_1d(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)).reshape(-1)
    motion = grid.responses[0].motion
    figure.suptitle(
        f"{grid.title or 'Untitled case'}\n{motion.name}, peak {motion.pga / grid.responses[0].gravity:.3g} g; "
        f"{grid.model} model",
        fontsize=10,
        x=0.01,
        ha="left",
    )
    for place, (panel, values) in enumerate(zip(axes, panels, strict=False)):
        names = (f"{each.path} {value}" for each, value in zip(others, values, strict=True))
        panel.set_title(", ".join(names), fontsize=9, loc="left")
        for cell, response in zip(grid.cells, grid.responses, strict=True):
            if cell[1:] != values:
                continue
            colour, dash = _line(first.values.index(cell[0]))
            label = f"{cell[0]}: {length(response.residual_slip_m) if response.ok else response.outcome}"
            h = response.histories
            time, slip = (h["time_s"], 1e3 * h["slip_m"]) if h else ([], [])
            panel.plot(time, slip, color=colour, linestyle=dash, linewidth=1.2, label=label)
        panel.legend(title=first.path, fontsize=8, title_fontsize=8, loc="best")
        if place % columns == 0:
            panel.set_ylabel("slip [mm]\n(+ downstream)")
        if place + columns >= len(panels):
            panel.set_xlabel("time [s]")
    for unused in axes[len(panels) :]:
        unused.set_visible(False)
    return figure


def _line(number: int) -> tuple[str, str]:
    """Return colour and dash of a line; with the colours used up, the same with other dashes."""
    turn, place = divmod(number, len(_LINES))
    return _LINES[place][0], _LINES[(place + turn) % len(_LINES)][1]


def _write(draw: Callable[[Any], Figure], result: Response | Grid, path: Path) -> list[Path]:
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        figure = draw(result)
        written = [path.with_suffix(suffix) for suffix in (".png", ".svg")]
        for each in written:
            figure.savefig(each, dpi=150)
    return written
