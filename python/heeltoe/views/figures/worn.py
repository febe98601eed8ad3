"""What a crack with a friction law bears and could bear, and how far it has slipped by then."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import largest, panels
from heeltoe.views.figures.style import COLOURS, describe, styled
from heeltoe.views.figures.time_axis import time_axis


@styled
def friction_figure(response: Response, units: str = "si") -> Figure:
    """Draw the friction in a crack below what its law could bear at the moment, and the slip and its way to and fro."""
    system = unit_system(units)
    h = response.histories
    time = h["time_s"]
    figure, (forces, path) = panels([1.2, 1.0], 1.9)
    describe(figure, response)
    # The first frame of an elastic dam has no time before it over which a mean could be taken.
    first = 1 if np.isnan(h["friction_force_n"][0]) or response.elastic else 0
    borne, could = np.abs(h["friction_force_n"][first:]), h["friction_strength_n"][first:]
    scale = system.scale("force", largest(borne, could))
    forces.fill_between(time[first:], scale(borne), color="#000000", alpha=0.25, linewidth=0, label="friction")
    forces.plot(time[first:], scale(could), color=COLOURS["heel"], linewidth=1.0, label="what the law could bear")
    forces.set_ylim(0.0, 1.05 * scale(largest(borne, could)) or 1.0)
    forces.set_ylabel(f"friction, either way\n[{scale.unit}]")
    forces.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, borderaxespad=0.0)
    scale = system.scale("displacement", largest(h["slip_path_m"], h["slip_m"]))
    path.plot(time, scale(h["slip_path_m"]), color="#bbbbbb", linewidth=3.0, label="way, to and fro")
    path.plot(time, scale(h["slip_m"]), color=COLOURS["slip"], linewidth=1.2, label="slip, + downstream")
    path.set_ylabel(f"slip and its way\n[{scale.unit}]")
    path.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, borderaxespad=0.0)
    time_axis(path, response)
    figure.align_ylabels([forces, path])
    return figure
