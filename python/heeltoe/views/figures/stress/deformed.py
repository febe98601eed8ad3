"""The deformed dam with its principal stresses, tension and compression apart."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation, TriContourSet

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.body.elastic import principal
from heeltoe.models.flexible.mesh.checks import boundary_edges
from heeltoe.models.flexible.result.history import CrackHistory
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.units.systems import Scale, unit_system
from heeltoe.units.write import scaled
from heeltoe.views.figures.dam import dam_axes, extent
from heeltoe.views.figures.style import WIDTH, describe, styled

# The largest displacement as it is drawn, over the size of the dam.
_DRAWN = 0.06
# The triangles of an element of eight nodes: its corners cut off, the rest in two.
_TRIANGLES = [(0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 7), (5, 6, 7)]
# Frames among which the one with the largest tension is looked for.
_LOOKED_AT = 100
# A crack that slips by less [m] does not slide; its dam is then shown at its largest tension.
_SLIDES = 1e-4
# Stresses at the ends of the crack are singular; the colours end at what nearly all nodes are below.
_SHOWN = 99.0
_LEVELS = 8
# Of a colour map, and from which ratio on the largest value is far above nearly all others.
_COLOURS, _FAR = 256, 1.5


@styled
def deformed_figure(response: FlexibleResponse, time: float | None = None, units: str = "si") -> Figure:
    """Draw the deformed dam with its principal stresses, on the left those in tension, on the right in compression.

    Short lines show their directions. Colours go up to the largest value of all; where that is far above what 99 of 100
    nodes have, each is twice or two and a half times the one before.

    Parameters
    ----------
    response
        Of the flexible model.
    time
        Moment [s]; that of the largest tension of the run where not given, or where that was not read, of the fastest
        slip.
    units
        ``"si"`` or ``"us"``.
    """
    history = response.crack
    system = unit_system(units)
    frame, why = _chosen(response, history) if time is None else (history.frame_at(time), "")
    moved = history.displacements(frame)
    major, minor, angle = zip(*(principal(stress_field) for stress_field in history.stresses(frame)), strict=True)
    low, high = extent(history.dam)
    exaggeration = _round(
        _DRAWN * max(high - low) / max(float(np.hypot(*displacement.T).max()) for displacement in moved)
    )
    length = system.scale("length")
    places = [
        length(body.mesh.nodes + exaggeration * displacement)
        for body, displacement in zip(history.dam.bodies, moved, strict=True)
    ]
    ratio = (high - low)[1] / (high - low)[0]
    figure = Figure(figsize=(WIDTH, float(np.clip(2.9 * ratio + 1.7, 3.2, 7.5))), layout="constrained")
    describe(figure, response)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    turned = tuple(direction + math.pi / 2.0 for direction in angle)
    both = (
        (major, angle, "Oranges", "tension"),
        (tuple(-principal_stress for principal_stress in minor), turned, "Blues", "compression"),
    )
    tops = [max(float(np.percentile(np.concatenate(values), _SHOWN)), 1e-9) for values, *_ in both]
    stress = system.scale("pressure", max(tops))
    for axes, most, (values, direction, colours, name) in zip(panels, tops, both, strict=True):
        image = _stress_map(axes, history, places, tuple(stress(value) for value in values), stress(most), colours)
        _crosses(axes, history, places, values, direction, 0.1 * most)
        _outlines(axes, history, places, length)
        bar = figure.colorbar(image, ax=axes, location="bottom", aspect=30, pad=0.02)
        bar.set_label(f"{name} [{stress.unit}]\nlargest {scaled(max(float(value.max()) for value in values), stress)}")
        # Beside each other in a report, with room for a few numbers.
        levels = list(image.levels)
        bar.set_ticks(levels[:: 1 + (len(levels) - 1) // 5])
        bar.ax.xaxis.set_major_formatter("{x:g}")
        bar.ax.tick_params(labelsize=7)
        dam_axes(axes, length)
    panels[1].set_ylabel("")
    moment = f"t = {history.time[frame]:.2f} s{why}; displacements exaggerated {exaggeration:g} times"
    key = "short lines: direction of the stress; dashed line: where it is zero; dotted outline: undeformed"
    figure.supxlabel(f"{moment}\n{key}", fontsize=8)
    return figure


def _chosen(response: FlexibleResponse, history: CrackHistory) -> tuple[int, str]:
    h = response.histories
    if response.tension is not None:
        return history.frame_at(response.tension.time_s), ", the largest tension of the run"
    if float(np.ptp(h.slip_m)) > _SLIDES:
        return int(np.argmax(np.abs(h.slip_velocity_m_s))), ", the fastest slip"
    frames = np.unique(np.linspace(0, len(history.time) - 1, _LOOKED_AT).astype(int))
    tension = [
        max(float(principal(stress_field)[0].max()) for stress_field in history.stresses(int(frame)))
        for frame in frames
    ]
    return int(frames[int(np.argmax(tension))]), ", the largest tension"


def _round(value: float) -> float:
    """Return the next lower of 1, 2, 5, 10, 20 and so on."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * max(step for step in (1.0, 2.0, 5.0) if step * power <= value * (1.0 + 1e-12))


def _stress_map(
    axes: Axes, history: CrackHistory, places: list[Floats], values: tuple[Floats, ...], most: float, colours: str
) -> TriContourSet:
    """Fill contours of the positive part; what is not positive stays white."""
    levels = _levels(most, max(float(value.max()) for value in values))
    for body, place, value in zip(history.dam.bodies, places, values, strict=True):
        triangles = np.vstack([body.mesh.elements[:, corners] for corners in _TRIANGLES])
        net = Triangulation(place[:, 0], place[:, 1], triangles)
        image = axes.tricontourf(
            net, np.maximum(value, -1e-12), levels=levels, cmap=colours, norm=BoundaryNorm(levels, _COLOURS)
        )
        axes.tricontour(net, value, levels=[0.0], colors="#555555", linewidths=0.7, linestyles="--")
    return image


def _levels(most: float, largest: float) -> Floats:
    """Return round levels from zero to above the largest value: evenly, or where that is far above `most`, what nearly
    all nodes stay below, each twice or two and a half times the one before."""
    largest = max(largest, most)
    if largest <= _FAR * most:
        return np.asarray(MaxNLocator(_LEVELS, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, largest), dtype=np.float64)
    power = 10.0 ** np.arange(math.floor(math.log10(most)) - 1, math.ceil(math.log10(largest)) + 1)
    series = (power[:, None] * np.array([1.0, 2.0, 5.0])).ravel()
    last = int(np.argmax(series >= largest * (1.0 - 1e-12)))
    return np.concatenate([[0.0], series[max(0, last - _LEVELS) : last + 1]])


def _crosses(
    axes: Axes,
    history: CrackHistory,
    places: list[Floats],
    values: tuple[Floats, ...],
    direction: tuple[Floats, ...],
    least: float,
) -> None:
    """Draw the direction of the stress in each element where it is more than next to nothing."""
    for body, place, value, angle in zip(history.dam.bodies, places, values, direction, strict=True):
        elements = body.mesh.elements
        # Directions are averaged by the double angle, since they have no sense.
        turn = np.arctan2(np.sin(2.0 * angle)[elements].mean(axis=1), np.cos(2.0 * angle)[elements].mean(axis=1)) / 2.0
        centre = place[elements[:, 4:]].mean(axis=1)
        sides = place[elements[:, [5, 6]]] - place[elements[:, [7, 4]]]
        size = 0.3 * np.hypot(sides[..., 0], sides[..., 1]).min(axis=1)
        shown = value[elements].mean(axis=1) > least
        step = (np.column_stack([np.cos(turn), np.sin(turn)]) * size[:, None])[shown]
        lines = np.stack([centre[shown] - step, centre[shown] + step], axis=1)
        axes.add_collection(LineCollection(list(lines), colors="#000000", linewidths=0.6), autolim=False)


def _outlines(axes: Axes, history: CrackHistory, places: list[Floats], length: Scale) -> None:
    for body, place in zip(history.dam.bodies, places, strict=True):
        outline = boundary_edges(body.mesh.elements)
        still = length(body.mesh.nodes)[outline]
        axes.add_collection(LineCollection(list(still), colors="#777777", linewidths=0.6, linestyles=":"))
        axes.add_collection(LineCollection(list(place[outline]), colors="#000000", linewidths=1.0))
    corners = np.vstack([*places, *(length(body.mesh.nodes) for body in history.dam.bodies)])
    room = 0.03 * np.ptp(corners, axis=0).max()
    axes.set_xlim(corners[:, 0].min() - room, corners[:, 0].max() + room)
    axes.set_ylim(corners[:, 1].min() - room, corners[:, 1].max() + room)
