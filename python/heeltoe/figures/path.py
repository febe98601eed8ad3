"""The path of the base: how far each end of it and its middle are from where they stood."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heeltoe.figures.panels import Floats, kind_of, largest, shown_rotation
from heeltoe.figures.style import MODE_COLOURS, WIDTH, describe, styled
from heeltoe.figures.units import Scale, unit_system
from heeltoe.response import Response

# In black and white width and dashes tell what colours tell otherwise.
_LINES = {"rest": (1.2, "-"), "slide": (2.4, "-"), "rock": (0.9, "-"), "slide-rock": (1.4, "--"), "drift": (1.2, ":")}


@styled
def path_figure(response: Response, units: str = "si") -> Figure:
    """Draw the paths that heel, middle and toe of the base take: slip sideways, lift-off upwards, coloured by mode.

    Only of a response that lifts off; on the crack all three paths are the same straight line.
    """
    h = response.histories
    system = unit_system(units)
    cut = shown_rotation(response)
    heel, toe = h["gap_heel_m"], h["gap_toe_m"]
    lift = largest(heel, toe) if cut is None else min(largest(heel, toe), cut * response.crack_width_m)
    across, up = system.scale("displacement", largest(h["slip_m"])), system.scale("displacement", lift)
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots(1, 3, sharex=True, sharey=True)
    describe(figure, response)
    kinds = [kind_of(mode) for mode in response.mode]
    for panel, values, name in zip(
        axes, (heel, (heel + toe) / 2.0, toe), ("heel (upstream)", "middle", "toe (downstream)"), strict=True
    ):
        _draw(panel, across(h["slip_m"]), up(values), kinds)
        panel.plot(across(h["slip_m"][0]), up(values[0]), "o", color="#000000", markersize=5, fillstyle="none")
        if cut is None:
            panel.plot(across(h["slip_m"][-1]), up(values[-1]), "x", color="#000000", markersize=6)
        panel.set_xlabel(f"slip [{across.unit}]")
        panel.set_title(name, fontsize=9)
    _limits(axes[0], h["slip_m"], across, up(lift))
    axes[0].set_ylabel(f"lift-off [{up.unit}]")
    figure.legend(handles=_handles(kinds, ends=cut is None), loc="outside lower center", ncols=7)
    return figure


def _draw(axes: Axes, along: Floats, across: Floats, kinds: list[str]) -> None:
    """Draw the pieces of a path, each as its mode; a piece belongs to the mode in which it ends."""
    points = np.column_stack([along, across])
    for kind, (width, dash) in _LINES.items():
        lines: list[Floats] = []
        for place in range(1, len(points)):
            if kinds[place] != kind:
                continue
            if lines and place > 1 and kinds[place - 1] == kind:
                lines[-1].append(points[place])  # type: ignore[attr-defined]
            else:
                lines.append([points[place - 1], points[place]])  # type: ignore[arg-type]
        axes.add_collection(
            LineCollection(lines, colors=MODE_COLOURS[kind], linewidths=width, linestyles=dash), autolim=False
        )


def _limits(axes: Axes, slip: Floats, across: Scale, top: float) -> None:
    low, high = across(float(slip.min())), across(float(slip.max()))
    room = 0.06 * (high - low) or 1.0
    axes.set_xlim(low - room, high + room)
    axes.set_ylim(-0.05 * top, 1.08 * top)


def _handles(kinds: list[str], *, ends: bool) -> list[Line2D]:
    lines = [
        Line2D([], [], color=MODE_COLOURS[kind], linewidth=width, linestyle=dash, label=kind)
        for kind, (width, dash) in _LINES.items()
        if kind in kinds
    ]
    lines.append(Line2D([], [], color="#000000", marker="o", fillstyle="none", linestyle="", label="start"))
    if ends:
        lines.append(Line2D([], [], color="#000000", marker="x", linestyle="", label="end"))
    return lines
