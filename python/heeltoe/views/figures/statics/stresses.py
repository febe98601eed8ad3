"""The normal stress along the crack, where it is open, and where the resultant meets it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from heeltoe.models.statics.load_case import LoadCase
from heeltoe.units.systems import Units
from heeltoe.units.write import number, scaled
from heeltoe.views.figures.panels import beside
from heeltoe.views.figures.style import COLOURS

_THIRD, _HALF = "#E3E3E3", "#F2F2F2"


def draw_stresses(axes: Axes, load_case: LoadCase, units: Units) -> None:
    """Draw the stress of the closed part, compression downwards, over the middle third and the middle half."""
    length = units.scale("length")
    start, end, width = load_case.contact_from_m, load_case.contact_to_m, load_case.contact_width_m
    middle = (start + end) / 2.0
    for reach, colour in ((1.0 / 4.0, _HALF), (1.0 / 6.0, _THIRD)):
        low, high = middle - reach * width, middle + reach * width
        axes.axvspan(length(low), length(high), color=colour, linewidth=0.0, zorder=0.2)
    axes.axhline(0.0, color="#000000", linewidth=1.0)
    open_ = load_case.cracked_length_m
    closed = (start + open_, end) if load_case.cracked_from == "heel" else (start, end - open_)
    stands = load_case.heel_stress_pa is not None and load_case.toe_stress_pa is not None
    if stands:
        ends = np.array([load_case.heel_stress_pa, load_case.toe_stress_pa], dtype=float)
        ends[np.abs(ends) < 1e-6 * np.abs(ends).max(initial=0.0)] = 0.0
        scale = units.scale("pressure", float(np.abs(ends).max()))
        x = np.linspace(*closed, 201)
        stress = scale(np.interp(x, closed, ends))
        for side, colour, hatch in ((stress >= 0.0, COLOURS["slip"], "|||"), (stress <= 0.0, COLOURS["crack"], "///")):
            axes.fill_between(
                length(x), stress, where=side, facecolor="none", edgecolor=colour, hatch=hatch, linewidth=0.8
            )
        axes.plot(length(x), stress, color="#000000", linewidth=1.0)
        for place, value, side in zip(closed, ends.tolist(), ("left", "right"), strict=True):
            axes.annotate(
                scaled(value, scale, 4),
                (length(place), 0.0),
                # On the other side of the line than what is drawn.
                xytext=(3 if side == "left" else -3, 3 if value >= 0.0 else -3),
                textcoords="offset points",
                ha=side,
                va="bottom" if value >= 0.0 else "top",
                fontsize=8,
                bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.6},
            )
        axes.set_ylabel(f"stress [{scale.unit}]\n(compression down)")
    else:
        axes.set_yticks([])
        axes.set_ylabel("no stress:\nit does not stand")
        axes.set_ylim(-1.0, 1.0)
    axes.margins(y=0.28)
    axes.invert_yaxis()
    gone = (start, closed[0]) if load_case.cracked_from == "heel" else (closed[1], end)
    if open_:
        axes.plot(length(np.array(gone)), [0.0, 0.0], color=COLOURS["crack"], linewidth=4.0, solid_capstyle="butt")
    if load_case.resultant_from_heel_m is not None:
        axes.axvline(length(load_case.resultant_from_heel_m), color="#6A4C93", linewidth=1.4, linestyle="--")
    room = 0.06 * load_case.contact_to_m
    axes.set_xlim(length(min(0.0, _beyond(load_case)) - room), length(max(end, _beyond(load_case)) + room))
    axes.set_xlabel(
        f"distance from the heel along the crack [{length.unit}]; grey: middle third, light grey: middle half"
    )
    axes.grid(visible=False)
    beside(axes, _label(load_case, units))


def _beyond(load_case: LoadCase) -> float:
    """Return where the resultant is, as far as it is worth an axis [m]."""
    place = 0.0 if load_case.resultant_from_heel_m is None else load_case.resultant_from_heel_m
    return min(max(place, -0.3 * load_case.contact_to_m), 1.3 * load_case.contact_to_m)


def _label(load_case: LoadCase, units: Units) -> str:
    """Say where the resultant is and how far the crack is open."""
    length = units.scale("length")
    if load_case.resultant_from_heel_m is None or load_case.eccentricity_m is None:
        return "no resultant: the block floats"
    zone = "outside the contact" if load_case.resultant_zone == "outside" else f"in the {load_case.resultant_zone}"
    away = number(length(abs(load_case.eccentricity_m)), 4)
    way = "downstream" if load_case.eccentricity_m >= 0.0 else "upstream"
    sentence = f"resultant (dashed) {zone}, {away} {length.unit} {way} of the middle"
    if load_case.outcome != "stands":
        return f"{sentence}; the block {'floats' if load_case.outcome == 'floats' else 'does not stand'}"
    if not load_case.cracked_length_m:
        return f"{sentence}; nothing opens"
    return f"{sentence}; open {scaled(load_case.cracked_length_m, length, 4)} from the {load_case.cracked_from} (red)"
