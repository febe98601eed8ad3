"""Figures of a response (matplotlib): one visual language, colour-blind safe, units on every axis."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from heeltoe.response import Response

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
    import matplotlib as mpl

    if not response.histories:
        return []
    written = []
    with mpl.rc_context(STYLE):
        for name, draw in (("response", response_figure), ("accelerations", acceleration_figure)):
            figure = draw(response)
            for suffix in (".png", ".svg"):
                path = directory / f"{name}{suffix}"
                figure.savefig(path, dpi=150)
                written.append(path)
    return written


def response_figure(response: Response) -> Figure:
    """Draw ground acceleration, slip, rotation, gaps and the mode ribbon over time.

    Rotation and gaps are left out where the block never rocks.
    """
    h = response.histories
    time = h["time_s"]
    rocks = response.largest_gap_heel_m > 0.0 or response.largest_gap_toe_m > 0.0
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
    slip.annotate(
        f"{residual:.1f} mm",
        (time[-1], residual),
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


def _heading(response: Response) -> str:
    title = response.title or "Untitled case"
    peak = response.motion.pga / response.gravity
    return f"{title}\n{response.motion.name}, peak {peak:.3g} g; {response.model} model"


def _ground(axes: Axes, response: Response) -> None:
    h, g = response.histories, response.gravity
    axes.plot(h["time_s"], h["ground_acceleration_m_s2"] / g, color=COLOURS["ground"], linewidth=0.7)
    critical = response.static["critical_acceleration_g"]
    low, high = axes.get_ylim()
    # A ground that accelerates upstream (negative) moves the block downstream.
    for sign, way in ((-1.0, "downstream"), (1.0, "upstream")):
        magnitude, first = min((critical[f"{kind}_{way}"], kind) for kind in ("sliding", "rocking"))
        limit = sign * magnitude
        if not low <= limit <= high:
            continue
        axes.axhline(limit, color=COLOURS["limit"], linewidth=1.0, linestyle="--")
        axes.annotate(
            f"{first} {way} starts",
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
    """Colour each moment by its mode; the events give the exact changes."""
    end = response.end_time_s
    times = np.concatenate([[0.0], response.event_log["time_s"], [end]])
    modes = ["rest", *response.event_log["mode_after"]]
    kinds = [_kind(mode) for mode in modes]
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
    """Return the kind of a mode by its name in the kernel: "slide-rock on toe upstream" is a slide-rock."""
    return mode.split(" ")[0]
