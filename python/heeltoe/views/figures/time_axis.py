"""The axis of time, as long as something happens; where silence follows, with the end of the ground motion."""

from __future__ import annotations

import math

from matplotlib.axes import Axes

from heeltoe.motion.measures import husid_time
from heeltoe.result.response import Response
from heeltoe.result.rest import motion_end, rests_from
from heeltoe.views.figures.panels import pieces
from heeltoe.views.figures.style import fit_time_label

# Up to where the ground shakes strongly: this share of its Arias intensity has come in (as in D5-75).
_SHAKEN = 0.75
# Between these its strong part lies: a little more than in D5-95.
_BEGUN, _OVER = 0.02, 0.98
# What follows is left out where the axis gets shorter than this part of the run.
_SHORTER = 0.85
# Beyond what happens, a part of it.
_ROOM = 0.04
# A run that ends this near to a round number of seconds is drawn to that.
_NEARLY = 1.005


def time_axis(axes: Axes, *responses: Response) -> None:
    """Label the axis of time, from zero to the end of the longest of these runs."""
    end = max(float(response.histories.time_s[-1]) for response in responses if response.histories)
    shown = max(shown_until(response) for response in responses if response.histories)
    # The last frame of 30 s may stand at 29.99 s.
    round_end = float(f"{end:.2g}")
    end = round_end if end < round_end < end * _NEARLY else end
    label = "time [s]"
    cut = shown < _SHORTER * end
    axes.set_xlim(0.0, shown if cut else end)
    silent = [motion_end(response) for response in responses if response.histories and response.silence_s]
    if silent and max(silent) < axes.get_xlim()[1]:
        _mark(axes, max(silent))
        label += f"; ground motion until {max(silent):.4g} s (dotted)"
    for moment in begins(*responses):
        _mark(axes, moment)
        label = label if "motions" in label else f"{label}; further motions begin at the dotted lines"
    if cut:
        label += f"; at rest from here to the end at {end:.4g} s"
    axes.set_xlabel(label)
    fit_time_label(axes)


def strong_part(axes: Axes, response: Response) -> None:
    """Label the axis of time, which has the strong part of the shaking alone: what single nodes do in a hundredth of a
    second is no more than stripes over the whole run."""
    time_axis(axes, response)
    motion = response.motion
    if motion.parts or not motion.pga:
        return
    start, end = axes.get_xlim()
    low, high = math.floor(husid_time(motion, _BEGUN)), math.ceil(husid_time(motion, _OVER))
    if high - low < _SHORTER * (end - start):
        axes.set_xlim(max(low, start), min(high, end))
        axes.set_xlabel(f"time [s]; the strong part of {end:.4g} s")


def begins(*responses: Response) -> list[float]:
    """Return when the motions of a sequence begin [s], but the first."""
    return sorted({part.begins for response in responses for part in response.motion.parts[1:]})


def _mark(axes: Axes, end: float) -> None:
    """Draw a line where the ground motion ends or another begins, in all panels over the same time."""
    for panel in axes.get_shared_x_axes().get_siblings(axes):
        panel.axvline(end, color="#777777", linestyle=":", linewidth=1.0, zorder=0.5)


def shown_until(response: Response) -> float:
    """Return up to when [s] a run is worth drawing: until the strong shaking is over and the dam is at rest."""
    end = float(response.histories.time_s[-1])
    happens = max((stop for kind, _, stop in pieces(response) if kind != "rest"), default=0.0)
    # The crack may have closed while an elastic dam still swings, a kinked one on two of its pieces; and while one of
    # several cracks is still the dam moves at another.
    happens = max(happens, min(rests_from(response), end))
    for motion in (response.motion, response.vertical):
        if motion is not None and motion.pga > 0.0:
            happens = max(happens, husid_time(motion, _SHAKEN))
    if happens == 0.0:
        return end
    happens *= 1.0 + _ROOM
    # A round number of seconds, or of tenths in a short run.
    step = 10.0 ** math.floor(math.log10(happens)) / 10.0
    return min(end, step * math.ceil(happens / step - 1e-9))
