"""Two models side by side on the same ground motion."""

from __future__ import annotations

from matplotlib.figure import Figure

from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import draw_limits, largest, panels, shown_rotation
from heeltoe.views.figures.shaking import draw_shaking, shaking_heights
from heeltoe.views.figures.style import COLOURS, align_labels, heading, shaken_by, styled
from heeltoe.views.figures.time_axis import time_axis

_PANELS = (
    ("slip_m", "displacement", "slip [{}]\n(+ downstream)"),
    ("rotation_rad", "rotation", "rotation [{}]\n(+ about heel)"),
    ("gap_heel_m", "displacement", "opening,\nheel [{}]"),
    ("gap_toe_m", "displacement", "opening,\ntoe [{}]"),
)
# The limits that each panel shows.
_LIMITS = {
    "slip_m": {"residual_slip": "residual slip", "peak_slip": "peak slip"},
    "rotation_rad": {"rotation": "rotation"},
    "gap_heel_m": {"opening_upstream": "opening"},
    "gap_toe_m": {"opening_downstream": "opening"},
}


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
        if cut is not None and key != "slip_m":
            limit = cut if quantity == "rotation" else cut * block.crack_width_m
            most = max(limit, largest(dam.histories[key]))
        scale = system.scale(quantity, most)
        if cut is not None and key != "slip_m":
            panel.set_ylim(-1.1 * scale(most) if quantity == "rotation" else 0.0, 1.1 * scale(most))
        for response, colour, dash in models:
            panel.plot(
                response.histories["time_s"],
                scale(response.histories[key]),
                color=colour,
                linestyle=dash,
                linewidth=1.1,
                label=f"{response.model} model",
            )
        draw_limits(panel, dam, _LIMITS[key], scale)
        panel.set_ylabel(label.format(scale.unit))
    time_axis(rest[-1], dam, block)
    figure.legend(*rest[-1].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    align_labels(axes)
    return figure
