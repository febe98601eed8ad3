"""Force in the anchors across the crack over time."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.base.arrays import Floats
from heeltoe.case.at_crack import AnchorAtCrack
from heeltoe.case.model import Case
from heeltoe.mechanics.anchors import anchor_force
from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import is_elastic, largest, panels
from heeltoe.views.figures.style import COLOURS, LOOKS, describe, styled
from heeltoe.views.figures.time_axis import time_axis


def moving_anchors(case: Case) -> list[tuple[int, AnchorAtCrack]]:
    """Return number and place of the anchors that cross the crack and whose force changes as it moves."""
    return [(number, anchor) for number, anchor in enumerate(case.anchors_at_crack, 1) if anchor.yields]


@styled
def anchor_figure(case: Case, response: Response, units: str = "si") -> Figure:
    """Draw the force in each anchor over time, tension and resistance to slip together, and what it is good for.

    Of an elastic dam the curves are those of the frames, between which the largest force of a step may lie.
    """
    time = response.histories.time_s
    anchors = moving_anchors(case)
    forces = [anchor_force(anchor, *_moved(response, anchor.distance)) for _, anchor in anchors]
    capacities = [anchor.capacity for _, anchor in anchors if anchor.capacity is not None]
    scale = unit_system(units).scale("force", largest(*forces, capacities))
    figure, (axes,) = panels([1.6], 1.55)
    describe(figure, response)
    for place, ((number, anchor), force) in enumerate(zip(anchors, forces, strict=True)):
        colour, dash = LOOKS[place % len(LOOKS)]
        axes.plot(time, scale(force), color=COLOURS[colour], linestyle=dash, linewidth=1.1, label=f"anchor {number}")
        if anchor.capacity is not None:
            axes.axhline(
                scale(anchor.capacity),
                color=COLOURS[colour],
                linestyle=(0, (6, 2)),
                linewidth=0.9,
                label=f"capacity of anchor {number}",
            )
    axes.set_ylim(0.0, 1.08 * scale(largest(*forces, capacities)))
    axes.set_ylabel(f"force in the\nanchor [{scale.unit}]")
    time_axis(axes, response)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _moved(response: Response, distance: float) -> tuple[Floats, Floats]:
    """Return how far the crack has moved along and across at a distance from the heel [m], at each moment."""
    if is_elastic(response):
        upper, lower = response.crack.upper_position, response.crack.lower_position
        apart = _at(upper, distance) - (0.0 if lower is None else _at(lower, distance))
        moved = apart - apart[0]
        return moved[:, 0], moved[:, 1]
    h = response.histories
    share = distance / response.crack_width_m
    return h.slip_m, (1.0 - share) * h.gap_heel_m + share * h.gap_toe_m


def _at(face: Floats, distance: float) -> Floats:
    """Return where the point of a face is (f, 2) [m] that was at a distance from the heel."""
    along = face[0, 0]
    after = int(np.clip(np.searchsorted(along, distance), 1, along.size - 1))
    share = (distance - along[after - 1]) / (along[after] - along[after - 1])
    return np.asarray((1.0 - share) * face[:, :, after - 1] + share * face[:, :, after], dtype=np.float64)
