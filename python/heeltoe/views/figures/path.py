"""The path of the base: how far each end of it and its middle are from where they stood."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heeltoe.base.arrays import Floats
from heeltoe.result.response import Response
from heeltoe.units.systems import Scale, unit_system
from heeltoe.views.figures.panels import kind_of, largest, shown_rotation
from heeltoe.views.figures.style import MODE_COLOURS, WIDTH, describe, styled

# In black and white width and dashes tell what colours tell otherwise.
_LINES: dict[str, tuple[float, Any]] = {
    "rest": (1.2, "-"),
    "slide": (2.4, "-"),
    "rock": (0.9, "-"),
    "slide-rock": (1.4, "--"),
    "drift": (1.2, ":"),
}


@styled
def path_figure(response: Response, units: str = "si") -> Figure:
    """Draw the paths that heel, middle and toe of the base take: slip sideways, lift-off upwards, coloured by mode.

    Only of a response that lifts off; on the crack all three paths are the same straight line.
    """
    h = response.histories
    system = unit_system(units)
    cut = shown_rotation(response)
    heel, toe = h.gap_heel_m, h.gap_toe_m
    lift = largest(heel, toe) if cut is None else min(largest(heel, toe), cut * response.crack_width_m)
    across, up = system.scale("displacement", largest(h.slip_m)), system.scale("displacement", lift)
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots(1, 3, sharex=True, sharey=True)
    describe(figure, response)
    kinds = [kind_of(mode) for mode in response.mode]
    for panel, values, name in zip(
        axes, (heel, (heel + toe) / 2.0, toe), ("heel (upstream)", "middle", "toe (downstream)"), strict=True
    ):
        draw_pieces(panel, across(h.slip_m), up(values), kinds)
        panel.plot(across(h.slip_m[0]), up(values[0]), "o", color="#000000", markersize=5, fillstyle="none")
        if cut is None:
            panel.plot(across(h.slip_m[-1]), up(values[-1]), "x", color="#000000", markersize=6)
        panel.set_xlabel(f"slip [{across.unit}]")
        panel.set_title(name, fontsize=9)
    _limits(axes[0], h.slip_m, across, up(lift))
    axes[0].set_ylabel(f"lift-off [{up.unit}]")
    marks = {"start": "o"} if cut is not None else {"start": "o", "end": "x"}
    handles = piece_handles(kinds) + [
        Line2D([], [], color="#000000", marker=marker, fillstyle="none", linestyle="", label=name)
        for name, marker in marks.items()
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def draw_pieces(axes: Axes, along: Floats, across: Floats, kinds: list[str]) -> None:
    """Draw the pieces of a curve, each as its kind of motion looks; a piece belongs to the kind in which it ends."""
    points = np.column_stack([along, across])
    for kind, (width, dash) in _LINES.items():
        inside = np.concatenate([[False], [item == kind for item in kinds[1:]], [False]])
        change = np.diff(inside.astype(int))
        # From the point before the first of a run to its last.
        runs = zip(np.flatnonzero(change == 1), np.flatnonzero(change == -1), strict=True)
        lines = [points[start : end + 1] for start, end in runs]
        axes.add_collection(
            LineCollection(lines, colors=MODE_COLOURS[kind], linewidths=width, linestyles=dash), autolim=False
        )


def _limits(axes: Axes, slip: Floats, across: Scale, top: float) -> None:
    low, high = across(float(slip.min())), across(float(slip.max()))
    room = 0.06 * (high - low) or 1.0
    axes.set_xlim(low - room, high + room)
    axes.set_ylim(-0.05 * top, 1.08 * top)


def piece_handles(kinds: list[str]) -> list[Line2D]:
    """Return what the legend of such a curve shows."""
    return [
        Line2D([], [], color=MODE_COLOURS[kind], linewidth=width, linestyle=dash, label=kind)
        for kind, (width, dash) in _LINES.items()
        if kind in kinds
    ]
