"""How the crack is pressed at heel and toe over time."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from scipy.ndimage import uniform_filter1d

from heeltoe.base.arrays import Floats
from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import beside, is_elastic, panels
from heeltoe.views.figures.style import COLOURS, describe, styled
from heeltoe.views.figures.time_axis import time_axis

# Blows of single nodes of an elastic dam would hide what bears it: the figure has the mean over so long [s].
_MEAN_S = 0.1
# Single blows leave the axes, which end beyond this share of all values on each side [%].
_SHOWN = 99.5


def edge_stresses(response: Response) -> tuple[Floats, Floats, Floats]:
    """Return moments (n,) [s] and the normal stress at heel and toe (n,) [Pa], compression positive.

    As in static checks it is N/B -+ 6 M/B^2, straight over the width B of the crack, with the normal force N and its
    moment M about the middle; a negative one means that the crack does not bear over all its width. Of an elastic dam N
    and M are those of the nodes, mean since the frame before.
    """
    width, h = response.crack_width_m, response.histories
    if is_elastic(response):
        history = response.crack
        across = history.forces()[1:, 1]
        arm = history.upper_position[1:, 0] - history.upper_position[0, 0].mean()
        time, normal, moment = history.time[1:], across.sum(axis=1), (across * arm).sum(axis=1)
    else:
        heel, toe = h["normal_force_heel_n"], h["normal_force_toe_n"]
        time, normal, moment = h["time_s"], heel + toe, (toe - heel) * width / 2.0
    bending = 6.0 * moment / width**2
    return time, normal / width - bending, normal / width + bending


@styled
def bearing_figure(response: Response, units: str = "si") -> Figure:
    """Draw the normal stress at heel and toe over time, straight over the crack as in static checks."""
    time, heel, toe = edge_stresses(response)
    elastic = is_elastic(response)
    if elastic:
        heel, toe = (_running_mean(time, stress) for stress in (heel, toe))
    both = np.concatenate([heel, toe])
    low, high = (float(np.percentile(both, share)) for share in (100.0 - _SHOWN, _SHOWN))
    scale = unit_system(units).scale("pressure", max(abs(low), abs(high), 1.0))
    figure, (axes,) = panels([1.6], 1.55)
    describe(figure, response)
    for name, stress, dash in (("heel", heel, "-"), ("toe", toe, "--")):
        axes.plot(time, scale(stress), color=COLOURS[name], linewidth=0.8, linestyle=dash, label=name)
    axes.axhline(0.0, color="#000000", linewidth=0.6)
    room = 0.1 * max(high - low, 1.0)
    axes.set_ylim(scale(min(low, 0.0) - room), scale(max(high, 0.0) + room))
    axes.set_ylabel(f"normal stress [{scale.unit}]\n(+ compression)")
    if elastic:
        beside(axes, f"mean over {_MEAN_S:g} s")
    time_axis(axes, response)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


def _running_mean(time: Floats, values: Floats) -> Floats:
    """Return the mean of values (n,) around each moment (n,) [s]."""
    several = max(1, round(_MEAN_S / float(np.median(np.diff(time)))))
    return np.asarray(uniform_filter1d(values, several, mode="nearest"), dtype=np.float64)
