"""Histories: slip, rotation, openings and modes, of one model or of two side by side; accelerations,
forces and stresses; slip by mode; how the crest moves."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.base.arrays import Floats
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.crest import ACCELERATION, DISPLACEMENT
from heeltoe.result.histories import GAPS, ROTATION, SLIP
from heeltoe.result.response import Response
from heeltoe.units.systems import Scale, unit_system
from heeltoe.units.write import number
from heeltoe.views.figures.panels import (
    SLIP_KINDS,
    beside,
    draw_limits,
    draw_openings,
    draw_ribbon,
    draw_rotation,
    draw_slip,
    is_elastic,
    kind_of,
    largest,
    mode_rows,
    panels,
    shown_rotation,
)
from heeltoe.views.figures.path import draw_pieces, piece_handles
from heeltoe.views.figures.shaking import draw_horizontal, draw_shaking, shaking_heights
from heeltoe.views.figures.style import (
    COLOURS,
    MODE_COLOURS,
    MODE_DASHES,
    MODE_HATCHES,
    WIDTH,
    align_labels,
    describe,
    heading,
    shaken_by,
    styled,
)
from heeltoe.views.figures.time_axis import time_axis

# Openings of an elastic dam's crack below a hundredth of a millimetre are not worth a panel.
_NO_OPENING = 1e-5
#: Slip of one kind below this [m] has no place in a picture.
NO_SLIP = 1e-6
_SLIP_KEYS = {kind: key for key, kind in SLIP_KINDS.items()}


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
    time, g = h.time_s, response.gravity
    figure, (*shaking, base, forces) = panels([*shaking_heights(response), 1.0, 1.2], 1.7)
    describe(figure, response)
    draw_shaking(shaking, response)
    base.plot(time, h.slip_acceleration_m_s2 / g, color=COLOURS["slip"], linewidth=0.8)
    base.set_ylabel("slip\nacceleration [g]")
    keys = {"heel": "normal_force_heel_n", "toe": "normal_force_toe_n"}
    scale = force.scale("force", largest(*(h[key] for key in keys.values()), h.friction_force_n))
    for (name, key), dash in zip(keys.items(), ("-", "--"), strict=True):
        label = f"normal force, {name}"
        forces.plot(time, scale(h[key]), color=COLOURS[name], linewidth=0.9, linestyle=dash, label=label)
    friction = scale(h.friction_force_n)
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
    time = h.time_s
    figure, (*shaking, velocity, touching, forces) = panels([*shaking_heights(response), 1.0, 0.6, 1.3], 1.45)
    describe(figure, response)
    draw_shaking(shaking, response)
    scale = system.scale("velocity")
    velocity.plot(time, scale(h.slip_velocity_m_s), color=COLOURS["slip"], linewidth=0.7)
    velocity.set_ylabel(f"slip rate\n[{scale.unit}]")
    touching.fill_between(time, 100.0 * h.touching, color=COLOURS["toe"], alpha=0.6, linewidth=0, step="mid")
    touching.set_ylabel("touching\n[%]")
    touching.set_ylim(0.0, 100.0)
    # The first frame has no time before it over which a mean could be taken.
    normal, friction = h.normal_force_n[1:], h.friction_force_n[1:]
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
    exact = bool(response.event_log)
    summed = slip_by_kind(response) if exact else {}
    named = {kind: key for kind, key in _SLIP_KEYS.items() if abs(response.slip_by_mode_m[key]) > NO_SLIP}
    scale = unit_system(units).scale("displacement", largest(*summed.values(), response.histories.slip_m))
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    curves, bars = figure.subplots(1, 2, sharey=True, width_ratios=[3.0, 1.2])
    describe(figure, response)
    time = response.histories.time_s
    total = scale(response.histories.slip_m)
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
    for place, (kind, value) in enumerate({**ends, "all": RESIDUAL_SLIP.of(response)}.items()):
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
    time, slip = h.time_s, h.slip_m
    log = response.event_log
    at = np.concatenate([[0.0], log.time_s])
    where = np.concatenate([slip[:1], log.slip_m])
    kinds = np.array([kind_of(mode) for mode in ("rest", *log.mode_after)])
    # Of a moment, the event before it; the slip since then belongs to the mode that began there.
    last = np.searchsorted(at, time, side="right") - 1
    steps = np.diff(where, append=where[-1])
    result = {}
    for kind in _SLIP_KEYS:
        mine = kinds == kind
        before = np.concatenate([[0.0], np.cumsum(np.where(mine, steps, 0.0))])
        result[kind] = before[last] + np.where(mine[last], slip - where[last], 0.0)
    return {kind: values for kind, values in result.items() if abs(response.slip_by_mode_m[_SLIP_KEYS[kind]]) > NO_SLIP}


@styled
def crest_figure(response: Response, units: str = "si") -> Figure:
    """Draw the displacement of the crest relative to the ground, with the slip in it, and its acceleration with that of
    the ground."""
    h, crest = response.histories, response.crest
    assert crest is not None
    figure, (shaking, shift, shakes) = panels([1.0, 1.2, 1.2], 1.5)
    describe(figure, response)
    draw_horizontal(shaking, response)
    scale = unit_system(units).scale("displacement", largest(h[DISPLACEMENT]))
    # What all cracks slip, which the crest goes with.
    slip = np.sum([crack.histories.slip_m for crack in response.cracks], axis=0)
    shift.plot(h.time_s, scale(h[DISPLACEMENT]), color=COLOURS["rotation"], linewidth=0.9, label="crest")
    label = "slip of all cracks" if response.several else "slip of the crack"
    shift.plot(h.time_s, scale(slip), color=COLOURS["slip"], linewidth=1.0, linestyle="--", label=label)
    shift.set_ylabel(f"crest [{scale.unit}]\n(+ downstream)")
    shift.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, fontsize=7, borderaxespad=0.0)
    beside(shift, f"largest {scale(crest.displacement_m):.4g} {scale.unit}")
    draw_limits(shift, response, (DISPLACEMENT,), scale)
    shakes.plot(h.time_s, h[ACCELERATION] / response.gravity, color=COLOURS["rotation"], linewidth=0.7)
    shakes.set_ylabel("acceleration\nof crest [g]")
    beside(shakes, f"largest {crest.acceleration_g:.3g} g")
    draw_limits(shakes, response, (ACCELERATION,), Scale(1.0, "g"))
    time_axis(shakes, response)
    align_labels([shaking, shift, shakes])
    return figure


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
        heel, toe = h.normal_force_heel_n, h.normal_force_toe_n
        time, normal, moment = h.time_s, heel + toe, (toe - heel) * width / 2.0
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
    longer = np.pad(values, (several // 2, (several - 1) // 2), mode="edge")
    return np.convolve(longer, np.full(several, 1.0 / several), mode="valid")


_PANELS = (
    (SLIP, "displacement", "slip [{}]\n(+ downstream)"),
    (ROTATION, "rotation", "rotation [{}]\n(+ about heel)"),
    (GAPS[0], "displacement", "opening,\nheel [{}]"),
    (GAPS[1], "displacement", "opening,\ntoe [{}]"),
)


@styled
def comparison_figure(dam: Response, block: Response, units: str = "si") -> Figure:
    """Draw slip, rotation and openings of both models."""
    system = unit_system(units)
    models = ((block, COLOURS["rotation"], "--"), (dam, COLOURS["slip"], "-"))
    above = shaking_heights(dam)
    figure, axes = panels([*above, *[1.0] * len(_PANELS)], 1.5)
    shaking, rest = axes[: len(above)], axes[len(above) :]
    heading(figure, dam.title or "Untitled case", shaken_by(dam))
    draw_shaking(shaking, dam)
    for panel, (key, quantity, label) in zip(rest, _PANELS, strict=True):
        most = largest(*(response.histories[key] for response, *_ in models))
        # A rigid block that overturns leaves the axes; before that it is compared.
        cut = shown_rotation(block)
        if cut is not None and key != SLIP:
            limit = cut if quantity == "rotation" else cut * block.crack_width_m
            most = max(limit, largest(dam.histories[key]))
        scale = system.scale(quantity, most)
        if cut is not None and key != SLIP:
            panel.set_ylim(-1.1 * scale(most) if quantity == "rotation" else 0.0, 1.1 * scale(most))
        for response, colour, dash in models:
            panel.plot(
                response.histories.time_s,
                scale(response.histories[key]),
                color=colour,
                linestyle=dash,
                linewidth=1.1,
                label=f"{response.model} model",
            )
        draw_limits(panel, dam, (key,), scale)
        panel.set_ylabel(label.format(scale.unit))
    time_axis(rest[-1], dam, block)
    figure.legend(*rest[-1].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    align_labels(axes)
    return figure
