"""Figures of a response (matplotlib): one visual language, colour-blind safe, units on every axis."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.response import Response
from heeltoe.verdicts import length

if TYPE_CHECKING:
    from heeltoe.comparison import Comparison
    from heeltoe.crack_history import CrackHistory

# Okabe and Ito's palette, which readers with colour-blindness can tell apart.
COLOURS = {
    "ground": "#000000",
    "slip": "#0072B2",
    "rotation": "#D55E00",
    "heel": "#CC79A7",
    "toe": "#009E73",
    "limit": "#999999",
}
MODE_COLOURS = {
    "rest": "#DDDDDD",
    "slide": "#56B4E9",
    "rock": "#E69F00",
    "slide-rock": "#D55E00",
    "drift": "#000000",
}
# The states of an elastic dam's crack as kinds of motion.
_KINDS = {"sliding": "slide", "rocking": "rock", "slide-rocking": "slide-rock", "drifting": "drift"}
STATUS_COLOURS = {
    "absent": "#FFFFFF",
    "open": "#F0E442",
    "stick": "#DDDDDD",
    "slip downstream": "#0072B2",
    "slip upstream": "#D55E00",
}
ENERGY_COLOURS = {
    "put in": ("input_energy_j", "#000000", "-"),
    "friction": ("friction_energy_j", "#0072B2", "-"),
    "damping": ("damping_energy_j", "#009E73", "--"),
    "impacts": ("impact_energy_j", "#D55E00", "-."),
    "stored, since the start": ("stored_energy_j", "#CC79A7", "-"),
}
# Openings of an elastic dam's crack below a hundredth of a millimetre are not worth a panel.
_NO_OPENING = 1e-5

STYLE: dict[Any, Any] = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E6E6E6",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "svg.fonttype": "none",
}


def write_figures(response: Response, directory: Path) -> list[Path]:
    """Write the figures of a response into `directory` as PNG and SVG and return their paths.

    A response without histories (the run never started) has none.
    """
    if not response.histories:
        return []
    drawings: dict[str, Callable[[Response], Figure]] = {"response": response_figure}
    if response.model == "flexible":
        drawings |= {"forces": force_figure, "energy": energy_figure, "crack": crack_figure}
    else:
        drawings["accelerations"] = acceleration_figure
    return _write(drawings, response, directory)


def write_comparison_figure(both: Comparison, directory: Path) -> list[Path]:
    """Write the figure of both models into `directory` as PNG and SVG and return their paths, if both have started."""
    if not (both.rigid.histories and both.flexible.histories):
        return []
    return _write({"comparison": comparison_figure}, both, directory)


def _write(
    drawings: Mapping[str, Callable[[Any], Figure]], result: Response | Comparison, directory: Path
) -> list[Path]:
    import matplotlib as mpl

    written = []
    with mpl.rc_context(STYLE):
        for name, draw in drawings.items():
            figure = draw(result)
            for suffix in (".png", ".svg"):
                path = directory / f"{name}{suffix}"
                figure.savefig(path, dpi=150)
                written.append(path)
    return written


def response_figure(response: Response) -> Figure:
    """Draw ground acceleration, slip, rotation, gaps and the mode ribbon over time.

    Rotation and gaps are left out where the block never rocks, where the crack of an elastic dam hardly opens. Where
    the slip has a spread, a band shows what it comes to with slightly weaker and stronger shaking.
    """
    h = response.histories
    time = h["time_s"]
    nothing = _NO_OPENING if response.model == "flexible" else 0.0
    rocks = max(response.largest_gap_heel_m, response.largest_gap_toe_m) > nothing
    names = ["ground", "slip", *(["rotation", "gaps"] if rocks else []), "mode"]
    heights = [0.22 if name == "mode" else 1.0 for name in names]
    figure = Figure(figsize=(7.5, 1.55 * sum(heights) + 1.25), layout="constrained")
    axes = dict(
        zip(
            names,
            np.atleast_1d(figure.subplots(len(names), 1, sharex=True, height_ratios=heights)),
            strict=True,
        )
    )
    figure.suptitle(_heading(response), fontsize=10, x=0.01, ha="left")

    _ground(axes["ground"], response)
    slip = axes["slip"]
    slip.plot(time, 1e3 * h["slip_m"], color=COLOURS["slip"], linewidth=1.4)
    slip.set_ylabel("slip [mm]\n(+ downstream)")
    residual = 1e3 * response.residual_slip_m
    spread = None if response.spread is None else response.spread["residual_slip_m"]
    below = residual
    if spread is not None:
        below = 1e3 * spread["min"]
        slip.axhspan(below, 1e3 * spread["max"], color=COLOURS["slip"], alpha=0.15, linewidth=0)
    slip.annotate(
        length(response.residual_slip_m),
        (time[-1], min(below, residual) if residual > 0 else residual),
        xytext=(-2, -12 if residual > 0 else 5),
        textcoords="offset points",
        ha="right",
        color=COLOURS["slip"],
    )
    if rocks:
        axes["rotation"].plot(time, 1e3 * h["rotation_rad"], color=COLOURS["rotation"], linewidth=1.0)
        axes["rotation"].set_ylabel("rotation [mrad]\n(+ about heel)")
        gaps = axes["gaps"]
        gaps.plot(time, 1e3 * h["gap_heel_m"], color=COLOURS["heel"], linewidth=1.0, label="heel (upstream)")
        gaps.plot(
            time,
            1e3 * h["gap_toe_m"],
            color=COLOURS["toe"],
            linewidth=1.0,
            linestyle="--",
            label="toe (downstream)",
        )
        gaps.set_ylabel("opening [mm]")
        gaps.legend(loc="upper right", ncols=2)
    _ribbon(axes["mode"], response)
    axes["mode"].set_xlabel("time [s]")
    axes["mode"].set_xlim(time[0], time[-1])
    return figure


def acceleration_figure(response: Response) -> Figure:
    """Draw ground, relative and absolute accelerations of the base, and the forces in the crack."""
    h = response.histories
    time, g = h["time_s"], response.gravity
    figure = Figure(figsize=(7.5, 6.0), layout="constrained")
    ground, base, forces = figure.subplots(3, 1, sharex=True)
    figure.suptitle(_heading(response), fontsize=10, x=0.01, ha="left")
    _ground(ground, response)
    base.plot(time, h["slip_acceleration_m_s2"] / g, color=COLOURS["slip"], linewidth=0.8)
    base.set_ylabel("slip acceleration [g]")
    for name, key, dash in (("heel", "normal_force_heel_n", "-"), ("toe", "normal_force_toe_n", "--")):
        forces.plot(
            time,
            h[key] / 1e6,
            color=COLOURS[name],
            linewidth=0.8,
            linestyle=dash,
            label=f"normal force, {name}",
        )
    forces.plot(time, h["friction_force_n"] / 1e6, color=COLOURS["ground"], linewidth=0.6, label="friction")
    forces.set_ylabel("force [MN/m]")
    forces.set_xlabel("time [s]")
    forces.set_xlim(time[0], time[-1])
    forces.legend(loc="upper center", bbox_to_anchor=(0.5, -0.28), ncols=3)
    return figure


def force_figure(response: Response) -> Figure:
    """Draw ground acceleration, slip velocity, what of an elastic dam's crack touches, and the forces in it."""
    h = response.histories
    time = h["time_s"]
    figure = Figure(figsize=(7.5, 6.5), layout="constrained")
    ground, velocity, touching, forces = figure.subplots(4, 1, sharex=True, height_ratios=[1.0, 1.0, 0.6, 1.3])
    figure.suptitle(_heading(response), fontsize=10, x=0.01, ha="left")
    _ground(ground, response)
    velocity.plot(time, h["slip_velocity_m_s"], color=COLOURS["slip"], linewidth=0.7)
    velocity.set_ylabel("slip velocity\n[m/s]")
    touching.fill_between(time, 100.0 * h["touching"], color=COLOURS["toe"], alpha=0.6, linewidth=0, step="mid")
    touching.set_ylabel("touching\n[% of nodes]")
    touching.set_ylim(0.0, 100.0)
    # The first frame has no time before it over which a mean could be taken.
    forces.plot(time[1:], h["normal_force_n"][1:] / 1e6, color=COLOURS["heel"], linewidth=0.8, label="normal force")
    friction = h["friction_force_n"][1:] / 1e6
    forces.plot(time[1:], friction, color=COLOURS["ground"], linewidth=0.6, label="friction, + downstream")
    forces.set_ylabel("force on the part\nabove [MN/m]")
    forces.set_xlabel("time [s]")
    forces.set_xlim(time[0], time[-1])
    forces.legend(loc="upper center", bbox_to_anchor=(0.5, -0.3), ncols=2)
    return figure


def energy_figure(response: Response) -> Figure:
    """Draw where the energy goes that water, weight and ground put into an elastic dam."""
    h = response.histories
    time = h["time_s"]
    figure = Figure(figsize=(7.5, 3.6), layout="constrained")
    axes = figure.subplots()
    figure.suptitle(_heading(response), fontsize=10, x=0.01, ha="left")
    for label, (key, colour, dash) in ENERGY_COLOURS.items():
        values = h[key] - (h[key][0] if key == "stored_energy_j" else 0.0)
        axes.plot(time, values / 1e6, color=colour, linestyle=dash, linewidth=1.2, label=label)
    axes.set_ylabel("energy [MJ/m]")
    axes.set_xlabel("time [s]")
    axes.set_xlim(time[0], time[-1])
    axes.legend(loc="upper left", fontsize=8)
    return figure


def crack_figure(response: Response) -> Figure:
    """Draw which part of an elastic dam's crack sticks, slips and opens over time, with the slip above it."""
    record = response.crack
    assert record is not None
    h = response.histories
    figure = Figure(figsize=(7.5, 4.8), layout="constrained")
    slip, crack = figure.subplots(2, 1, sharex=True, height_ratios=[1.0, 1.8])
    figure.suptitle(_heading(response), fontsize=10, x=0.01, ha="left")
    slip.plot(h["time_s"], 1e3 * h["slip_m"], color=COLOURS["slip"], linewidth=1.2)
    slip.set_ylabel("slip [mm]\n(+ downstream)")
    _status_map(crack, record)
    crack.set_xlabel("time [s]")
    crack.set_xlim(h["time_s"][0], h["time_s"][-1])
    return figure


def _status_map(axes: Axes, record: CrackHistory) -> None:
    """Colour every watched node of one whole face at every moment by its status."""
    names = _kernel.CONTACT_STATUSES
    along = record.upper_position[0, 0]
    # The nodes of a face that is watched as a whole come first; those of its ends that follow say nothing new.
    status = record.status[:, : along.size]
    if status.shape[1] < along.size:
        assert record.lower_position is not None
        along = record.lower_position[0, 0, : status.shape[1]]
    axes.pcolormesh(
        _edges(record.time),
        _edges(along),
        status.T,
        cmap=ListedColormap([STATUS_COLOURS[name] for name in names]),
        norm=BoundaryNorm(np.arange(len(names) + 1) - 0.5, len(names)),
        # Hundreds of thousands of rectangles would make a drawing of many megabytes.
        rasterized=True,
    )
    axes.set_ylabel("along the crack [m]\nheel 0, toe above")
    axes.grid(visible=False)
    seen = [name for k, name in enumerate(names) if (status == k).any()]
    handles = [
        Patch(
            facecolor=STATUS_COLOURS[name], edgecolor="#BBBBBB", label="nothing opposite" if name == "absent" else name
        )
        for name in seen
    ]
    axes.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.2),
        ncols=len(seen),
    )


def _edges(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the borders half-way between places, and the first and the last of these."""
    return np.concatenate([places[:1], (places[1:] + places[:-1]) / 2.0, places[-1:]])


def comparison_figure(both: Comparison) -> Figure:
    """Draw slip, rotation and openings of both models on the same ground motion."""
    models = ((both.rigid, COLOURS["rotation"], "--"), (both.flexible, COLOURS["slip"], "-"))
    panels = (
        ("slip_m", "slip [mm]\n(+ downstream)"),
        ("rotation_rad", "rotation [mrad]\n(+ about heel)"),
        ("gap_heel_m", "opening at\nthe heel [mm]"),
        ("gap_toe_m", "opening at\nthe toe [mm]"),
    )
    figure = Figure(figsize=(7.5, 8.2), layout="constrained")
    ground, *rest = figure.subplots(1 + len(panels), 1, sharex=True)
    flexible = both.flexible
    peak = flexible.motion.pga / flexible.gravity
    figure.suptitle(
        f"{both.title or 'Untitled case'}\n{flexible.motion.name}, peak {peak:.3g} g", fontsize=10, x=0.01, ha="left"
    )
    _ground(ground, flexible)
    for axes, (key, label) in zip(rest, panels, strict=True):
        for response, colour, dash in models:
            axes.plot(
                response.histories["time_s"],
                1e3 * response.histories[key],
                color=colour,
                linestyle=dash,
                linewidth=1.1,
                label=f"{response.model} model",
            )
        axes.set_ylabel(label)
    rest[-1].legend(loc="upper center", bbox_to_anchor=(0.5, -0.35), ncols=2)
    rest[-1].set_xlabel("time [s]")
    rest[-1].set_xlim(0.0, max(response.histories["time_s"][-1] for response, *_ in models))
    return figure


def _heading(response: Response) -> str:
    title = response.title or "Untitled case"
    peak = response.motion.pga / response.gravity
    damping = f", {response.damping} damping" if response.model == "flexible" else ""
    return f"{title}\n{response.motion.name}, peak {peak:.3g} g; {response.model} model{damping}"


def _ground(axes: Axes, response: Response) -> None:
    h, g = response.histories, response.gravity
    axes.plot(h["time_s"], h["ground_acceleration_m_s2"] / g, color=COLOURS["ground"], linewidth=0.7)
    critical = response.static["critical_acceleration_g"]
    low, high = axes.get_ylim()
    of = "rigid block: " if response.model == "flexible" else ""
    # A ground that accelerates upstream (negative) moves the block downstream.
    for sign, way in ((-1.0, "downstream"), (1.0, "upstream")):
        magnitude, first = min((critical[f"{kind}_{way}"], kind) for kind in ("sliding", "rocking"))
        limit = sign * magnitude
        if not low <= limit <= high:
            continue
        axes.axhline(limit, color=COLOURS["limit"], linewidth=1.0, linestyle="--")
        axes.annotate(
            f"{of}{first} {way} starts",
            (1.0, limit),
            xycoords=("axes fraction", "data"),
            xytext=(-2, -9 if sign < 0.0 else 3),
            textcoords="offset points",
            ha="right",
            fontsize=7,
            color="#555555",
        )
    axes.set_ylabel("ground\nacceleration [g]")


def _ribbon(axes: Axes, response: Response) -> None:
    """Colour each moment by its mode; events give the exact changes, where there are any, else the frames."""
    if response.model == "flexible":
        # A frame has the state of the step that ends with it.
        times = np.concatenate([[0.0], response.histories["time_s"]])
        kinds = [_kind(mode) for mode in response.mode]
    else:
        times = np.concatenate([[0.0], response.event_log["time_s"], [response.end_time_s]])
        kinds = [_kind(mode) for mode in ("rest", *response.event_log["mode_after"])]
    for kind, colour in MODE_COLOURS.items():
        spans = [
            (start, stop - start)
            for start, stop, this in zip(times[:-1], times[1:], kinds, strict=True)
            if this == kind and stop > start
        ]
        axes.broken_barh(spans, (0.0, 1.0), facecolors=colour)
    seen = [kind for kind in MODE_COLOURS if kind in kinds]
    axes.legend(
        handles=[Patch(facecolor=MODE_COLOURS[kind], label=kind) for kind in seen],
        loc="upper center",
        bbox_to_anchor=(0.5, -1.6),
        ncols=len(seen),
    )
    axes.set_yticks([])
    axes.set_ylim(0.0, 1.0)
    axes.grid(visible=False)
    axes.set_ylabel("mode", rotation=0, ha="right", va="center")


def _kind(mode: str) -> str:
    """Return the kind of a mode by its name in the kernels: "slide-rock on toe upstream" is a slide-rock."""
    return _KINDS.get(mode, mode.split(" ")[0])
