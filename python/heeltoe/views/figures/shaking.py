"""Panels of the motion that shakes a dam: horizontal with the accelerations at which a block starts to move, vertical
where there is one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from heeltoe.base.arrays import Floats
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.histories import AT_CRACK, AT_CRACK_UP, GROUND_UP
from heeltoe.result.response import Response
from heeltoe.views.figures.panels import beside
from heeltoe.views.figures.style import COLOURS
from heeltoe.views.words.starts import Start, first_starts, first_starts_in_words

# Height of the panel of the vertical motion, over that of the horizontal one.
_LOWER = 0.7


def shaking_heights(response: Response) -> list[float]:
    """Return the heights of the panels that :func:`draw_shaking` fills."""
    return [1.0] + ([_LOWER] if response.vertical is not None else [])


def draw_shaking(axes: Sequence[Axes], response: Response) -> None:
    """Draw what shakes the crack: horizontally and, where the case has it, vertically.

    Where the part below the crack changes the motion, that of the crack is drawn, with the ground's own behind it. The
    accelerations at which a block starts to move stand where they are near, and vary with the vertical motion.
    """
    draw_horizontal(axes[0], response)
    if response.vertical is not None:
        _draw(axes[1], response, response.vertical, AT_CRACK_UP, "vertical\n(+ up) [g]")


def draw_horizontal(axes: Axes, response: Response) -> None:
    """Draw the panel of the horizontal motion alone."""
    chained = AT_CRACK in response.histories
    name = "horizontal\n[g]" if response.vertical is not None else "shaking [g]" if chained else "ground [g]"
    _draw(axes, response, response.motion, AT_CRACK, name)
    low, high = axes.get_ylim()
    for start in first_starts(response):
        limit = float(start.of_the_ground())
        if low <= limit <= high:
            time, values = _limit(start, response)
            # Dashes would drown in a curve of many samples.
            dash, width = ("--", 1.0) if time.size == 2 else ("-", 0.6)
            axes.plot(time, values, color=COLOURS["limit"], linewidth=width, linestyle=dash, zorder=1.7)
            low = min(low, limit - 0.1 * (high - low))
            high = max(high, limit + 0.1 * (high - low))
    axes.set_ylim(low, high)
    # Above the panel, where no label can cover a curve.
    beside(axes, first_starts_in_words(response), colour="#444444")


def _draw(axes: Axes, response: Response, motion: GroundMotion, at_crack: str, label: str) -> None:
    h, g = response.histories, response.gravity
    # The motion itself, which may jump between two moments of the histories.
    time, ground = until(motion, float(h.time_s[-1]))
    axes.set_ylabel(label)
    crack = h.get(at_crack)
    if crack is None:
        axes.plot(time, ground / g, color=COLOURS["ground"], linewidth=0.7)
        return
    axes.plot(h.time_s, crack / g, color=COLOURS["slip"], linewidth=0.7, label="at the crack")
    axes.plot(time, ground / g, color="#999999", linewidth=0.7, linestyle="--", label="ground", zorder=1.8)
    axes.legend(loc="lower left", ncols=2, fontsize=7, bbox_to_anchor=(0.0, 1.0), borderaxespad=0.0)


def _limit(start: Start, response: Response) -> tuple[Floats, Floats]:
    """Return moments [s] and the acceleration of the ground [g] at which the block starts to move then."""
    time, up = response.histories.time_s, response.histories.get(GROUND_UP)
    if start.vertical is None or up is None:
        return time[[0, -1]], np.full(2, start.of_the_ground())
    return time, start.of_the_ground(up / response.gravity)


def until(motion: GroundMotion, end: float) -> tuple[Floats, Floats]:
    """Return moments [s] and accelerations [m/s2] of the ground up to an end [s]; after a record it stands still."""
    time, ground = motion.time, motion.acceleration
    if time[-1] < end:
        return np.append(time, [time[-1], end]), np.append(ground, [0.0, 0.0])
    before = time <= end
    last = float(np.interp(end, time, ground))
    return np.append(time[before], end), np.append(ground[before], ground[before][-1] if end in time else last)
