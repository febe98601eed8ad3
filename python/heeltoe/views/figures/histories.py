"""What happened over time: slip, rotation, openings and modes; accelerations and forces; slip by mode."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.base.arrays import Floats
from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.units.write import number
from heeltoe.views.figures.panels import (
    draw_openings,
    draw_ribbon,
    draw_rotation,
    draw_slip,
    is_elastic,
    kind_of,
    largest,
    mode_rows,
    panels,
)
from heeltoe.views.figures.path import draw_pieces, piece_handles
from heeltoe.views.figures.shaking import draw_shaking, shaking_heights
from heeltoe.views.figures.style import (
    COLOURS,
    MODE_COLOURS,
    MODE_DASHES,
    MODE_HATCHES,
    WIDTH,
    align_labels,
    describe,
    styled,
)
from heeltoe.views.figures.time_axis import time_axis

# Openings of an elastic dam's crack below a hundredth of a millimetre are not worth a panel.
_NO_OPENING = 1e-5
#: Slip of one kind below this [m] has no place in a picture.
NO_SLIP = 1e-6
_SLIP_KINDS = {"slide": "sliding", "slide-rock": "slide_rocking", "drift": "drifting"}


@styled
def response_figure(response: Response, units: str = "si") -> Figure:
    """Draw the motion that shakes the crack, slip, rotation, openings and the mode ribbon over time.

    Rotation and openings are left out where the block never rocks, where the crack of an elastic dam hardly opens.
    Where the slip has a spread, a band shows what it comes to with slightly weaker and stronger shaking.
    """
    system = unit_system(units)
    nothing = _NO_OPENING if is_elastic(response) else 0.0
    rocks = lifts_off(response, nothing)
    rows = 0.13 * len(mode_rows(response)) + 0.05
    above = shaking_heights(response)
    figure, axes = panels([*above, 1.0, *([1.0, 1.0] if rocks else []), rows], 1.55)
    shaking, rest = axes[: len(above)], axes[len(above) :]
    describe(figure, response)
    draw_shaking(shaking, response)
    draw_slip(rest[0], response, system)
    if rocks:
        draw_rotation(rest[1], response, system)
        draw_openings(rest[2], response, system)
    draw_ribbon(rest[-1], response)
    time_axis(rest[-1], response)
    align_labels(axes)
    return figure


def lifts_off(response: Response, nothing: float = 0.0) -> bool:
    """Whether heel or toe leave the part below by more than next to nothing [m]."""
    return bool(max(response.largest_gap_heel_m, response.largest_gap_toe_m) > nothing)


@styled
def acceleration_figure(response: Response, units: str = "si") -> Figure:
    """Draw the ground's acceleration, that of the slip, and the forces in the crack of a rigid block."""
    force = unit_system(units)
    h = response.histories
    time, g = h["time_s"], response.gravity
    figure, (*shaking, base, forces) = panels([*shaking_heights(response), 1.0, 1.2], 1.7)
    describe(figure, response)
    draw_shaking(shaking, response)
    base.plot(time, h["slip_acceleration_m_s2"] / g, color=COLOURS["slip"], linewidth=0.8)
    base.set_ylabel("slip\nacceleration [g]")
    keys = {"heel": "normal_force_heel_n", "toe": "normal_force_toe_n"}
    scale = force.scale("force", largest(*(h[key] for key in keys.values()), h["friction_force_n"]))
    for (name, key), dash in zip(keys.items(), ("-", "--"), strict=True):
        label = f"normal force, {name}"
        forces.plot(time, scale(h[key]), color=COLOURS[name], linewidth=0.9, linestyle=dash, label=label)
    friction = scale(h["friction_force_n"])
    forces.plot(time, friction, color="#000000", linewidth=0.7, linestyle=":", label="friction, + downstream")
    forces.set_ylabel(f"force [{scale.unit}]\non part above")
    time_axis(forces, response)
    figure.legend(*forces.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    align_labels([*shaking, base, forces])
    return figure


@styled
def force_figure(response: Response, units: str = "si") -> Figure:
    """Draw ground acceleration, slip velocity, what of an elastic dam's crack touches, and the forces in it."""
    system = unit_system(units)
    h = response.histories
    time = h["time_s"]
    figure, (*shaking, velocity, touching, forces) = panels([*shaking_heights(response), 1.0, 0.6, 1.3], 1.45)
    describe(figure, response)
    draw_shaking(shaking, response)
    scale = system.scale("velocity")
    velocity.plot(time, scale(h["slip_velocity_m_s"]), color=COLOURS["slip"], linewidth=0.7)
    velocity.set_ylabel(f"slip rate\n[{scale.unit}]")
    touching.fill_between(time, 100.0 * h["touching"], color=COLOURS["toe"], alpha=0.6, linewidth=0, step="mid")
    touching.set_ylabel("touching\n[%]")
    touching.set_ylim(0.0, 100.0)
    # The first frame has no time before it over which a mean could be taken.
    normal, friction = h["normal_force_n"][1:], h["friction_force_n"][1:]
    scale = system.scale("force", largest(normal, friction))
    forces.plot(time[1:], scale(normal), color=COLOURS["heel"], linewidth=0.9, label="normal force")
    forces.plot(
        time[1:], scale(friction), color="#000000", linewidth=0.7, linestyle="--", label="friction, + downstream"
    )
    forces.set_ylabel(f"force on the\nupper part\n[{scale.unit}]")
    time_axis(forces, response)
    figure.legend(loc="outside lower center", ncols=2)
    align_labels([*shaking, velocity, touching, forces])
    return figure


@styled
def slip_by_mode_figure(response: Response, units: str = "si") -> Figure:
    """Draw how much of the slip has come from each kind of motion: over time, and in the end.

    Of an elastic dam only the sums at the end are known, and in which state each frame ends: its slip is one curve,
    drawn as the states look.
    """
    exact = "time_s" in response.event_log
    summed = slip_by_kind(response) if exact else {}
    named = {kind: key for kind, key in _SLIP_KINDS.items() if abs(response.slip_by_mode_m[key]) > NO_SLIP}
    scale = unit_system(units).scale("displacement", largest(*summed.values(), response.histories["slip_m"]))
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    curves, bars = figure.subplots(1, 2, sharey=True, width_ratios=[3.0, 1.2])
    describe(figure, response)
    time = response.histories["time_s"]
    total = scale(response.histories["slip_m"])
    if exact:
        curves.plot(time, total, color="#999999", linewidth=2.4, label="all")
    else:
        kinds = [kind_of(mode) for mode in response.mode]
        draw_pieces(curves, time, total, kinds)
        curves.update_datalim(np.column_stack([time, total]))
        curves.autoscale_view()
    for kind, values in summed.items():
        curves.plot(
            time, scale(values), color=MODE_COLOURS[kind], linestyle=MODE_DASHES[kind], linewidth=1.3, label=kind
        )
    curves.set_ylabel(f"slip so far [{scale.unit}]\n(+ downstream)")
    time_axis(curves, response)
    ends = {kind: response.slip_by_mode_m[key] for kind, key in named.items()}
    for place, (kind, value) in enumerate({**ends, "all": response.residual_slip_m}.items()):
        colour, hatch = MODE_COLOURS.get(kind, "#999999"), MODE_HATCHES.get(kind, "")
        bars.bar(place, scale(value), width=0.7, facecolor=colour, hatch=hatch, edgecolor="white")
        bars.annotate(
            number(scale(value), 3) if abs(scale(value)) > 5e-3 else "0",
            (place, scale(value)),
            xytext=(0, 3 if value >= 0.0 else -3),
            textcoords="offset points",
            ha="center",
            va="bottom" if value >= 0.0 else "top",
            fontsize=8,
        )
    bars.axhline(0.0, color="#000000", linewidth=0.6)
    bars.set_xticks(range(len(ends) + 1), [*ends, "all"], rotation=30, ha="right")
    bars.set_xlabel(f"in the end [{scale.unit}]")
    bars.grid(visible=False, axis="x")
    (low, high), room = curves.get_ylim(), 0.09
    curves.set_ylim(low - room * (high - low) * (min(ends.values()) < 0.0), high + room * (high - low))
    handles = curves.get_legend_handles_labels()[0] if exact else piece_handles(kinds)
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def slip_by_kind(response: Response) -> dict[str, Floats]:
    """Return the slip (n,) that each kind of motion has brought up to each moment of the histories [m].

    Events split the time between two moments exactly. Kinds that bring nothing are left out.
    """
    h = response.histories
    time, slip = h["time_s"], h["slip_m"]
    log = response.event_log
    at = np.concatenate([[0.0], log["time_s"]])
    where = np.concatenate([slip[:1], log["slip_m"]])
    kinds = np.array([kind_of(mode) for mode in ("rest", *log["mode_after"])])
    # Of a moment, the event before it; the slip since then belongs to the mode that began there.
    last = np.searchsorted(at, time, side="right") - 1
    steps = np.diff(where, append=where[-1])
    result = {}
    for kind in _SLIP_KINDS:
        mine = kinds == kind
        before = np.concatenate([[0.0], np.cumsum(np.where(mine, steps, 0.0))])
        result[kind] = before[last] + np.where(mine[last], slip - where[last], 0.0)
    return {
        kind: values for kind, values in result.items() if abs(response.slip_by_mode_m[_SLIP_KINDS[kind]]) > NO_SLIP
    }
