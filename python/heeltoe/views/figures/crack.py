"""State of each node of an elastic dam's crack over time, its bond, and the pressure between the faces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.kernel.dam import CONTACT_STATUSES
from heeltoe.models.flexible.result.history import LEAST_DAMAGE, CrackHistory, node_lengths
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.result.contract import CRACKED
from heeltoe.units.systems import Scale, unit_system
from heeltoe.views.figures.panels import panels
from heeltoe.views.figures.style import COLOURS, align_labels, describe, styled
from heeltoe.views.figures.time_axis import strong_part, time_axis

# From light to dark in black and white: nothing, open, stick, slip one way, slip the other way.
STATUS_COLOURS = {
    "absent": "#FFFFFF",
    "open": "#F7EE90",
    "stick": "#B8B8B8",
    "slip downstream": "#0072B2",
    "slip upstream": "#4A1500",
}
# Of a joint, from whole to broken; what is broken and closed is as dark as it moves.
_JOINT_COLOURS = {
    "intact": "#FFFFFF",
    "softening": "#E69F00",
    "broken, open": STATUS_COLOURS["open"],
    "broken, sticks": STATUS_COLOURS["stick"],
    "broken, slips downstream": STATUS_COLOURS["slip downstream"],
    "broken, slips upstream": STATUS_COLOURS["slip upstream"],
}
# What a broken node does, of the statuses of contact; one with nothing opposite is open.
_BROKEN = {"absent": 2, "open": 2, "stick": 3, "slip downstream": 4, "slip upstream": 5}
# The largest pressures are blows of single nodes; the colours end before them, at this share of all [%].
_SHOWN = 98.0
_COLUMNS = 1500


@styled
def crack_figure(response: FlexibleResponse, units: str = "si") -> Figure:
    """Draw which part of an elastic dam's crack sticks, slips and opens over time."""
    history = response.crack
    figure, (crack,) = panels([1.6], 1.55)
    describe(figure, response)
    along, status = _whole_face(history)
    colours = {"nothing opposite" if name == "absent" else name: STATUS_COLOURS[name] for name in CONTACT_STATUSES}
    handles = _draw_states(crack, history.time, along, status, colours, unit_system(units).scale("length"))
    strong_part(crack, response)
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def _draw_states(
    axes: Axes, time: Floats, along: Floats, states: NDArray[Any], colours: Mapping[str, str], scale: Scale
) -> list[Patch]:
    """Colour every node (k,) of a face at every moment (f,) by its state (f, k), which counts `colours`; return the
    legend of the states that occur."""
    axes.pcolormesh(
        borders(time),
        scale(borders(along)),
        states.T,
        cmap=ListedColormap(list(colours.values())),
        norm=BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours)),
        # Hundreds of thousands of rectangles would make a drawing of many megabytes.
        rasterized=True,
    )
    _label_crack(axes, scale)
    return [
        Patch(facecolor=colour, edgecolor="#888888", label=name, linewidth=0.5)
        for k, (name, colour) in enumerate(colours.items())
        if (states == k).any()
    ]


def _whole_face(history: CrackHistory) -> tuple[Floats, NDArray[np.uint8]]:
    """Return places (k,) and statuses (f, k) of the watched nodes of the face that is watched as a whole."""
    along = history.upper_position[0, 0]
    # They come first; those of the ends of the other face that follow say nothing new.
    status = history.status[:, : along.size]
    if status.shape[1] < along.size:
        assert history.lower_position is not None
        along = history.lower_position[0, 0, : status.shape[1]]
    return along, status


@styled
def joint_figure(response: FlexibleResponse, units: str = "si") -> Figure:
    """Draw where the bond of a joint is intact, softens and is broken over time, with the cracked length above it."""
    history, h = response.crack, response.histories
    scale = unit_system(units).scale("length", response.crack_width_m)
    figure, (lengths, joint) = panels([1.0, 1.8], 1.55)
    describe(figure, response)
    for key, label, colour, dash in (
        (CRACKED, "in all", "#000000", "-"),
        ("cracked_upstream_m", "from the upstream face", COLOURS["slip"], "--"),
        ("cracked_downstream_m", "from the downstream face", COLOURS["rotation"], ":"),
    ):
        lengths.plot(h.time_s, scale(h[key]), color=colour, linestyle=dash, linewidth=1.4, label=label)
    lengths.set_ylabel(f"cracked length [{scale.unit}]")
    lengths.set_ylim(0.0, 1.05 * scale(response.crack_width_m))
    lengths.legend(loc="best")
    along, states = joint_states(history)
    handles = _draw_states(joint, history.time, along, states, _JOINT_COLOURS, scale)
    time_axis(joint, response)
    figure.legend(handles=handles, loc="outside lower center", ncols=min(3, len(handles)))
    align_labels([lengths, joint])
    return figure


@styled
def joints_figure(response: FlexibleResponse, units: str = "si") -> Figure:
    """Draw how much of each of several joints is cracked over time, by their heights; marks where each begins to crack
    and where it is cracked through."""
    joints = [crack for crack in response.cracks if crack.joint is not None]
    levels = np.array([crack.elevation for crack in joints])
    scale = unit_system(units).scale("length", max(float(levels.max()), 1.0))
    half = 0.35 * float(np.diff(np.sort(levels)).min())
    figure, (axes,) = panels([2.6], 1.55)
    describe(figure, response)
    norm = Normalize(0.0, 100.0)
    for crack, level in zip(joints, levels, strict=True):
        h, bond = crack.histories, crack.joint
        assert bond is not None
        share = 100.0 * h.cracked_length_m / crack.crack_width_m
        edges = scale(np.array([level - half, level + half]))
        axes.pcolormesh(borders(h.time_s), edges, share[None, :], cmap="Greys", norm=norm, rasterized=True)
        axes.axhline(scale(level), color="#BBBBBB", linewidth=0.4, zorder=0.5)
        for moment, mark, colour in (
            (bond.first_cracking_s, "o", COLOURS["slip"]),
            (bond.cracked_through_s, "X", COLOURS["rotation"]),
        ):
            if moment is not None:
                axes.plot([moment], [scale(level)], mark, color=colour, markersize=7, markeredgecolor="white")
    axes.set_ylim(scale(levels.min() - 2.0 * half), scale(levels.max() + 2.0 * half))
    axes.set_ylabel(f"height of the joint [{scale.unit}]")
    axes.grid(visible=False)
    bar = figure.colorbar(ScalarMappable(norm, "Greys"), ax=axes, pad=0.01, aspect=18)
    bar.set_label("cracked part [%]")
    time_axis(axes, response)
    handles = [
        Line2D([], [], marker=mark, color=colour, markeredgecolor="white", markersize=7, linestyle="", label=label)
        for mark, colour, label in (
            ("o", COLOURS["slip"], "begins to crack"),
            ("X", COLOURS["rotation"], "is cracked through"),
        )
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    return figure


def joint_states(history: CrackHistory) -> tuple[Floats, NDArray[np.int8]]:
    """Return the places (k,) [m] of the nodes of a joint, and what each does at every moment (f, k).

    0 is intact, 1 softening; from 2 on the bond is broken, and the node open, sticking, slipping downstream, slipping
    upstream.
    """
    assert history.damage is not None
    along, status = _whole_face(history)
    damage = history.damage[:, : along.size]
    contact = np.array([_BROKEN[name] for name in CONTACT_STATUSES], dtype=np.int8)[status]
    states = np.where(damage >= 1.0, contact, np.where(damage > LEAST_DAMAGE, 1, 0)).astype(np.int8)
    return along, states


@styled
def pressure_figure(response: FlexibleResponse, units: str = "si") -> Figure:
    """Draw the contact pressure along an elastic dam's crack while it shakes strongly; where nothing presses it is
    white, hatched.

    Pressures are the nodes' forces over the lengths that belong to them, mean from frame to frame. Single blows may
    lie beyond the end of the colours.
    """
    history = response.crack
    system = unit_system(units)
    time, pressure = contact_pressure(history)
    length = system.scale("length")
    figure, (crack,) = panels([1.6], 1.55)
    describe(figure, response)
    pressed = pressure > 0.0
    # Both ends are corners, under which the concrete's stress has no bound.
    inner = pressure[:, 1:-1][pressed[:, 1:-1]]
    most = float(np.percentile(inner, _SHOWN)) if inner.size else 1.0
    scale = system.scale("pressure", most)
    crack.set_facecolor("white")
    heel, toe = length(borders(history.upper_position[0, 0])[[0, -1]])
    # Behind the map, which leaves out what does not press.
    crack.fill_between(
        [0.0, float(time[-1])], heel, toe, facecolor="white", edgecolor="#999999", hatch="////", linewidth=0.0
    )
    image = crack.pcolormesh(
        borders(time),
        length(borders(history.upper_position[0, 0])),
        np.ma.masked_where(~pressed, scale(pressure)).T,
        cmap="YlGnBu",
        vmin=0.0,
        vmax=scale(most),
        rasterized=True,
    )
    beyond = "max" if pressure.max() > most else "neither"
    bar = figure.colorbar(image, ax=crack, extend=beyond, pad=0.01, aspect=18)
    bar.set_label(f"pressure [{scale.unit}]")
    _label_crack(crack, length)
    strong_part(crack, response)
    handle = Patch(facecolor="white", edgecolor="#999999", hatch="////", label="open: no contact pressure")
    figure.legend(handles=[handle], loc="outside lower center")
    return figure


def contact_pressure(history: CrackHistory) -> tuple[Floats, Floats]:
    """Return moments (f,) [s] and the pressure (f, k) [Pa] on the nodes of the upper face, compression positive; where
    there are more frames than a picture shows, the means of neighbours."""
    pressure = history.forces()[:, 1] / node_lengths(history.upper_position[0, 0])
    several = -(-len(history.time) // _COLUMNS)
    if several == 1:
        return history.time, pressure
    starts = np.arange(0, len(history.time), several)
    counts = np.diff(starts, append=len(history.time))
    return history.time[starts], np.add.reduceat(pressure, starts, axis=0) / counts[:, None]


def _label_crack(axes: Axes, scale: Scale) -> None:
    axes.set_ylabel(f"from the heel\n[{scale.unit}]")
    axes.grid(visible=False)


def borders(places: Floats) -> Floats:
    """Return the borders half-way between places, and the first and the last of these."""
    return np.concatenate([places[:1], (places[1:] + places[:-1]) / 2.0, places[-1:]])
