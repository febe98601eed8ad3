"""Marks of a dam's periods on an axis of periods, with their names above it, where no curve is."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes

# Two names nearer to each other than this part of the width of the axis stand one above the other.
_APART = 0.07
_ROWS = 3


def mark_periods(axes: Axes, periods: Sequence[float], colour: str) -> None:
    """Draw a line for each period [s] within the limits of a logarithmic axis, counted from the longest."""
    low, high = (math.log(limit) for limit in axes.get_xlim())
    row, before = 0, math.inf
    for number, period in enumerate(periods, 1):
        place = (math.log(period) - low) / (high - low)
        if not 0.0 < place < 1.0:
            continue
        row = (row + 1) % _ROWS if before - place < _APART else 0
        before = place
        axes.axvline(period, color=colour, linewidth=0.9, linestyle=(0, (4, 2)), zorder=1.6)
        axes.annotate(
            f"T{number}",
            (period, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 2 + 8 * row),
            textcoords="offset points",
            ha="center",
            fontsize=7,
            color=colour,
        )
