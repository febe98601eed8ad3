"""How the crest moves over time."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.result.crest import ACCELERATION, DISPLACEMENT
from heeltoe.result.response import Response
from heeltoe.units.systems import Scale, unit_system
from heeltoe.views.figures.panels import beside, draw_limits, largest, panels
from heeltoe.views.figures.shaking import draw_horizontal
from heeltoe.views.figures.style import COLOURS, align_labels, describe, styled
from heeltoe.views.figures.time_axis import time_axis


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
    slip = np.sum([crack.histories["slip_m"] for crack in response.cracks], axis=0)
    shift.plot(h["time_s"], scale(h[DISPLACEMENT]), color=COLOURS["rotation"], linewidth=0.9, label="crest")
    label = "slip of all cracks" if response.several else "slip of the crack"
    shift.plot(h["time_s"], scale(slip), color=COLOURS["slip"], linewidth=1.0, linestyle="--", label=label)
    shift.set_ylabel(f"crest [{scale.unit}]\n(+ downstream)")
    shift.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, fontsize=7, borderaxespad=0.0)
    beside(shift, f"largest {scale(crest.displacement_m):.4g} {scale.unit}")
    draw_limits(shift, response, {"crest_displacement": "crest displacement"}, scale)
    shakes.plot(h["time_s"], h[ACCELERATION] / response.gravity, color=COLOURS["rotation"], linewidth=0.7)
    shakes.set_ylabel("acceleration\nof crest [g]")
    beside(shakes, f"largest {crest.acceleration_g:.3g} g")
    draw_limits(shakes, response, {"crest_acceleration": "crest acceleration"}, Scale(1.0, "g"))
    time_axis(shakes, response)
    align_labels([shaking, shift, shakes])
    return figure
