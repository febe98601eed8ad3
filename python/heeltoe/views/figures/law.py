"""The curve of a friction law; what a crack with one bears and could bear, and how far it has slipped by then; how a
rough crack dilates and wears."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.mechanics.law_curve import LawCurve
from heeltoe.result.response import Response
from heeltoe.units.sentences import written
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import largest, panels
from heeltoe.views.figures.style import COLOURS, align_labels, describe, heading, styled
from heeltoe.views.figures.time_axis import time_axis


@styled
def law_figure(curve: LawCurve, units: str = "si") -> Figure:
    """Draw the apparent friction of a law over what it goes by."""
    figure = Figure(figsize=(7.0, 4.0), layout="constrained")
    axes = figure.subplots()
    system = unit_system(units)
    kind = {"slip path": "displacement", "slip speed": "velocity", "normal stress": "pressure"}[curve.over]
    scale = system.scale(kind, float(curve.at[-1]))
    axes.plot(scale(curve.at), curve.friction, color=COLOURS["slip"], label="sliding")
    place = scale(curve.normal_stress_pa) if curve.over == "normal stress" else 0.0
    axes.plot([place], [curve.at_rest], color="#000000", marker="o", linestyle="", label="before any slip")
    axes.set_xlabel(f"{curve.over} [{scale.unit}]")
    axes.set_ylabel("apparent friction:\nstrength over normal stress")
    axes.set_ylim(0.0, 1.08 * max(float(curve.friction.max()), curve.at_rest, 1e-3))
    axes.legend(loc="best")
    stress = written("{stress_pa:.3g MPa}", units, stress_pa=curve.normal_stress_pa)
    heading(figure, curve.title, f"{curve.law}, normal stress {stress}")
    return figure


@styled
def friction_figure(response: Response, units: str = "si") -> Figure:
    """Draw the friction in a crack below what its law could bear at the moment, and the slip and its way to and fro."""
    system = unit_system(units)
    h = response.histories
    time = h.time_s
    figure, (forces, path) = panels([1.2, 1.0], 1.9)
    describe(figure, response)
    # The first frame of an elastic dam has no time before it over which a mean could be taken.
    first = 1 if np.isnan(h.friction_force_n[0]) or response.elastic else 0
    borne, could = np.abs(h.friction_force_n[first:]), h.friction_strength_n[first:]
    scale = system.scale("force", largest(borne, could))
    forces.fill_between(time[first:], scale(borne), color="#000000", alpha=0.25, linewidth=0, label="friction")
    forces.plot(time[first:], scale(could), color=COLOURS["heel"], linewidth=1.0, label="what the law could bear")
    forces.set_ylim(0.0, 1.05 * scale(largest(borne, could)) or 1.0)
    forces.set_ylabel(f"friction, either way\n[{scale.unit}]")
    forces.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, borderaxespad=0.0)
    scale = system.scale("displacement", largest(h.slip_path_m, h.slip_m))
    path.plot(time, scale(h.slip_path_m), color="#bbbbbb", linewidth=3.0, label="way, to and fro")
    path.plot(time, scale(h.slip_m), color=COLOURS["slip"], linewidth=1.2, label="slip, + downstream")
    path.set_ylabel(f"slip and its way\n[{scale.unit}]")
    path.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, borderaxespad=0.0)
    time_axis(path, response)
    align_labels([forces, path])
    return figure


@styled
def asperities_figure(response: Response, units: str = "si") -> Figure:
    """Draw how far a rough crack dilates as it slips, and the angle that wear leaves its flanks."""
    system = unit_system(units)
    h = response.histories
    time, angle = h.time_s, np.degrees(h.asperity_angle_rad)
    figure, (dilation, flanks) = panels([1.2, 1.0], 1.9)
    describe(figure, response)
    scale = system.scale("displacement", largest(h.dilation_m, h.slip_m))
    dilation.plot(time, scale(h.dilation_m), color=COLOURS["heel"], linewidth=1.2, label="dilation")
    dilation.plot(time, scale(h.slip_m), color=COLOURS["slip"], linewidth=1.2, label="slip, + downstream")
    dilation.set_ylabel(f"dilation and slip\n[{scale.unit}]")
    dilation.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, borderaxespad=0.0)
    flanks.plot(time, angle, color="#000000", linewidth=1.2)
    # What hardly wears is a level line near its start, and not its last digits.
    flanks.set_ylim(min(0.9 * float(angle[0]), float(angle.min())), 1.02 * float(angle[0]))
    flanks.set_ylabel("angle of the flanks\n[degrees]")
    time_axis(flanks, response)
    align_labels([dilation, flanks])
    return figure
