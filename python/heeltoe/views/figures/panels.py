"""Panels over time that several figures share: slip, rotation, openings, the ribbon of modes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeGuard

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.result.histories import GAPS, ROTATION, SLIP
from heeltoe.result.judge import LIMITS
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from heeltoe.units.systems import Scale, Units
from heeltoe.units.write import length
from heeltoe.views.figures.style import COLOURS, MODE_COLOURS, WIDTH

#: Modes that make slip as kinds of motion, by their names in the numbers.
SLIP_KINDS = {"sliding": "slide", "slide_rocking": "slide-rock", "drifting": "drift"}
# The states of an elastic dam's crack as kinds of motion.
_KINDS = {"sliding": "slide", "rocking": "rock", "slide-rocking": "slide-rock", "drifting": "drift"}
# From which part of the time on the spread of what remains is drawn.
_LAST = 0.97
# A limit that is farther than so many times what there is has no line.
_NEAR = 2.0
# Up to which rotation a block that overturns at once is shown [rad].
_TILTED = 0.05


def is_elastic(response: Response) -> TypeGuard[FlexibleResponse]:
    """Whether the crack of this response has nodes."""
    return isinstance(response, FlexibleResponse)


def panels(heights: Sequence[float], height: float, *, most: float = 9.6) -> tuple[Figure, list[Axes]]:
    """Return a figure of axes above each other that share their time; `height` is that of a panel of height 1 [in]."""
    figure = Figure(figsize=(WIDTH, min(most, height * sum(heights) + 1.2)), layout="constrained")
    axes = figure.subplots(len(heights), 1, sharex=True, height_ratios=heights)
    return figure, list(np.atleast_1d(axes))


def beside(axes: Axes, text: str, *, colour: str = "#000000") -> None:
    """Write above the right end of a panel, where nothing is drawn: a label within may cover a curve."""
    axes.set_title(text, loc="right", fontsize=8, color=colour, pad=3)


def draw_slip(axes: Axes, response: Response, units: Units) -> None:
    """Draw the slip with its residual, and its spread where there is one."""
    h = response.histories
    spread = None if response.spread is None else response.spread.residual_slip_m
    ends = np.array([] if spread is None else [spread.min, spread.max])
    converged = converged_slip(response)
    within = np.array([] if converged is None else [converged[0] - converged[1], converged[0] + converged[1]])
    scale = units.scale("displacement", largest(h.slip_m, ends, within))
    axes.plot(h.time_s, scale(h.slip_m), color=COLOURS["slip"], linewidth=1.4)
    axes.set_ylabel(f"slip [{scale.unit}]\n(+ downstream)")
    if spread is not None:
        # It is of the slip that remains, at the end of the run alone.
        end = float(h.time_s[-1])
        axes.fill_between(
            [end * _LAST, end], scale(ends[0]), scale(ends[1]), color=COLOURS["slip"], alpha=0.3, linewidth=0
        )
    for edge in within:
        axes.axhline(scale(edge), color=COLOURS["slip"], linewidth=0.6, linestyle=":")
    if largest(h.slip_m, ends, within) == 0.0:
        axes.set_ylim(-1.0, 1.0)
    draw_limits(axes, response, (SLIP,), scale)
    varied = "" if spread is None else f", {scale(ends[0]):.4g} to {scale(ends[1]):.4g} with the shaking varied"
    beside(axes, f"{slip_in_the_end(response, scale)}{varied}", colour=COLOURS["slip"])


def draw_limits(axes: Axes, response: Response, columns: Sequence[str], scale: Scale) -> None:
    """Draw what the case allows as lines, as far as they are near what there is.

    Parameters
    ----------
    columns
        Columns of the histories that the axis shows.
    scale
        The unit of the axis.
    """
    reach = max(map(abs, axes.get_ylim()))
    low, high = axes.get_ylim()
    for check in response.limits:
        allowed = float(scale(check.allowed))
        if LIMITS[check.name].column not in columns or not 0.0 < allowed <= _NEAR * reach:
            continue
        # Where nothing goes, there is no need of a line.
        sides = [allowed] if low > -0.25 * reach else [-allowed] if high < 0.25 * reach else [allowed, -allowed]
        for side in sides:
            axes.axhline(side, color=COLOURS["crack"], linewidth=0.9, linestyle=(0, (6, 2)))
            axes.annotate(
                f"{LIMITS[check.name].label} allowed",
                # At the beginning, where nothing has moved yet, beyond the line and within the panel.
                (0.0, side),
                xycoords=("axes fraction", "data"),
                xytext=(3, 2 if side > 0.0 else -2),
                textcoords="offset points",
                ha="left",
                va="bottom" if side > 0.0 else "top",
                fontsize=7,
                color=COLOURS["crack"],
            )
            low, high = min(low, 1.35 * side), max(high, 1.35 * side)
    axes.set_ylim(low, high)


def slip_in_the_end(response: Response, scale: Scale) -> str:
    """Say what slip remains, and how far step and mesh let it be known."""
    residual, known = response.residual_slip_m, converged_slip(response)
    if known is None:
        return f"in the end {length(residual) if scale.unit == 'mm' else f'{scale(residual):.2f} {scale.unit}'}"
    word = "converged" if response.summary["evidence"]["converged"] else "NOT converged"
    least = scale(known[1]) or 1.0
    decimals = max(1, min(6, 1 - math.floor(math.log10(least))))
    return f"in the end {scale(known[0]):.{decimals}f} ± {scale(known[1]):.{decimals}f} {scale.unit} (dotted), {word}"


def converged_slip(response: Response) -> tuple[float, float] | None:
    """Return the residual slip to trust and how uncertain it is [m]; None without evidence."""
    evidence = response.summary.get("evidence")
    return None if not evidence else (evidence.residual_slip_m.value, evidence.residual_slip_m.uncertainty)


def draw_rotation(axes: Axes, response: Response, units: Units) -> None:
    """Draw the rotation; that of a block which overturns continues by powers of ten beyond its rocking before."""
    h = response.histories
    cut = shown_rotation(response)
    scale = units.scale("rotation", largest(h.rotation_rad))
    axes.plot(h.time_s, scale(h.rotation_rad), color=COLOURS["rotation"], linewidth=1.0)
    axes.set_ylabel(f"rotation [{scale.unit}]\n(+ about heel)")
    draw_limits(axes, response, (ROTATION,), scale)
    if cut is not None:
        axes.set_yscale("symlog", linthresh=float(scale(cut)), linscale=2.0)
        ends = [float(scale(h.rotation_rad.min())), float(scale(h.rotation_rad.max()))]
        axes.set_ylim(1.15 * min(ends[0], -float(scale(cut)) / 2.0), 1.15 * max(ends[1], float(scale(cut)) / 2.0))
        axes.set_yticks([value for value in (-1.5, -0.5, -0.1, 0.0, 0.1, 0.5, 1.5) if ends[0] <= value <= ends[1]])
        axes.yaxis.set_major_formatter("{x:g}")
        axes.minorticks_off()
        note_overturned(axes, response)


def draw_openings(axes: Axes, response: Response, units: Units) -> None:
    """Draw how far the crack is open at heel and toe."""
    h = response.histories
    cut = shown_rotation(response)
    most = largest(h.gap_heel_m, h.gap_toe_m)
    if cut is not None:
        most = min(most, cut * response.crack_width_m)
    scale = units.scale("displacement", most)
    for name, key, dash, label in (
        ("heel", GAPS[0], "-", "heel (upstream)"),
        ("toe", GAPS[1], "--", "toe (downstream)"),
    ):
        axes.plot(h.time_s, scale(h[key]), color=COLOURS[name], linewidth=1.0, linestyle=dash, label=label)
    axes.set_ylabel(f"opening [{scale.unit}]")
    top = scale(most) * 1.05
    axes.set_ylim(min(0.0, axes.get_ylim()[0]) if cut is None else -0.05 * top, top or 1.0)
    draw_limits(axes, response, GAPS, scale)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, borderaxespad=0.0)


def shown_rotation(response: Response) -> float | None:
    """Return up to which rotation [rad] a block that overturns is drawn: enough for its rocking before; None for one
    that stays up."""
    if response.outcome != Outcome.OVERTURNED:
        return None
    rotation = response.histories.rotation_rad
    turns = np.flatnonzero(np.diff(np.sign(rotation)) != 0)
    before = np.abs(rotation[: turns[-1] + 1]) if turns.size else np.zeros(1)
    rocking = float(before.max())
    return min(3.0 * rocking if rocking > 1e-5 else _TILTED, math.pi / 2.0)


def note_overturned(axes: Axes, response: Response) -> None:
    """Say in a panel whose axis is cut that the block turns over, and when."""
    way = "downstream, about its toe" if response.histories.rotation_rad[-1] < 0.0 else "upstream, about its heel"
    beside(axes, f"overturns {way}, at {response.histories.time_s[-1]:.2f} s")


def draw_ribbon(axes: Axes, response: Response) -> None:
    """Draw each kind of motion that there is as a row of bars over time."""
    seen = mode_rows(response)
    for row, kind in enumerate(reversed(seen)):
        colour = MODE_COLOURS[kind]
        # The edge keeps what lasts for a millisecond visible.
        axes.broken_barh(_spans(response, kind), (row + 0.1, 0.8), facecolors=colour, edgecolors=colour, linewidth=0.3)
    axes.set_yticks([row + 0.5 for row in range(len(seen))], list(reversed(seen)))
    axes.tick_params(axis="y", length=0, labelsize=8)
    axes.set_ylim(0.0, len(seen))
    axes.grid(visible=False)
    axes.set_ylabel("mode")


def mode_rows(response: Response) -> list[str]:
    """Return the kinds of motion that there are, from rest to drift."""
    kinds = {kind for kind, start, stop in pieces(response) if stop > start}
    return [kind for kind in MODE_COLOURS if kind in kinds]


def _spans(response: Response, kind: str) -> list[tuple[float, float]]:
    """Return start and length of the times of one kind, neighbours joined."""
    spans: list[tuple[float, float]] = []
    for this, start, stop in pieces(response):
        if this != kind or stop <= start:
            continue
        if spans and spans[-1][0] + spans[-1][1] >= start - 1e-12:
            spans[-1] = (spans[-1][0], stop - spans[-1][0])
        else:
            spans.append((start, stop - start))
    return spans


def pieces(response: Response) -> list[tuple[str, float, float]]:
    """Return kind, start and end; events give the exact changes, where there are any, else the frames."""
    if response.event_log:
        times = np.concatenate([[0.0], response.event_log.time_s, [response.end_time_s]])
        modes = ("rest", *response.event_log.mode_after)
    else:
        # A frame has the state of the step that ends with it.
        times, modes = np.concatenate([[0.0], response.histories.time_s]), response.mode
    kinds = [kind_of(mode) for mode in modes]
    return list(zip(kinds, times[:-1].tolist(), times[1:].tolist(), strict=True))


def kind_of(mode: str) -> str:
    """Return the kind of a mode by its name in the kernels: "slide-rock on toe upstream" is a slide-rock."""
    return _KINDS.get(mode, mode.split(" ")[0])


def largest(*values: ArrayLike) -> float:
    """Return the largest magnitude among arrays and numbers."""
    return max((float(np.max(np.abs(value), initial=0.0)) for value in values), default=0.0)
