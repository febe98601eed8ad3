"""The curve of a friction law; what a crack with one bears and could bear, and how far it has slipped by then; how a
rough crack dilates and wears."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from heeltoe.mechanics.law_curve import LawCurve
from heeltoe.result.response import Response
from heeltoe.units.sentences import written
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.panels import largest, panels
from heeltoe.views.figures.style import COLOURS, LOOKS, align_labels, describe, heading, styled
from heeltoe.views.figures.time_axis import time_axis

if TYPE_CHECKING:
    from heeltoe.mechanics.law_fit import LawFits
    from heeltoe.mechanics.shear_tests import ShearTest


@styled
def law_figure(curve: LawCurve, units: str = "si") -> Figure:
    """Draw the apparent friction of a law over its variable."""
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
def law_fit_figure(fits: LawFits, tests: Sequence[ShearTest], title: str, units: str = "si") -> Figure:
    """Draw the strengths of shear tests with the laws that were fitted to them, and the band of further tests."""
    figure = Figure(figsize=(7.0, 4.5), layout="constrained")
    axes = figure.subplots()
    normal = np.array([test.normal_pa for test in tests])
    peak, residual = (np.array([getattr(test, name) for test in tests]) for name in ("peak_pa", "residual_pa"))
    scale = unit_system(units).scale("pressure", float(np.nanmax([peak, residual])))
    axes.plot(scale(normal), scale(peak), "o", color="#000000", markersize=4, label="peak")
    axes.plot(scale(normal), scale(residual), "x", color=COLOURS["limit"], markersize=4, label="residual")
    laws = [fit for fit in fits.fits if fit.band is not None and fit.over == "normal stress"]
    for fit, (colour, dashes) in zip(laws, LOOKS, strict=False):
        assert fit.band is not None
        at = np.array(fit.band.at)
        best, low, high = (at * np.array(values) for values in (fit.band.best, fit.band.low, fit.band.high))
        label = f"{fit.law}, chosen" if fit.chosen else fit.law
        axes.plot(
            scale(at), scale(best), dashes, color=COLOURS[colour], linewidth=2.0 if fit.chosen else 1.0, label=label
        )
        if fit.chosen:
            axes.fill_between(scale(at), scale(low), scale(high), color=COLOURS[colour], alpha=0.15, linewidth=0)
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel(f"normal stress [{scale.unit}]")
    axes.set_ylabel(f"shear stress [{scale.unit}]")
    axes.legend(loc="best")
    heading(figure, title, "shear tests; shaded: 95 % of further tests by the chosen law")
    return figure


@styled
def fall_figure(fits: LawFits, tests: Sequence[ShearTest], title: str, units: str = "si") -> Figure | None:
    """Draw the friction over slip or speed with the fall that was found; None where there is none."""
    fit = next((fit for fit in fits.fits if fit.chosen and fit.over != "normal stress"), None)
    if fit is None or fit.band is None:
        return None
    figure = Figure(figsize=(7.0, 4.0), layout="constrained")
    axes = figure.subplots()
    kind = "displacement" if fit.over == "slip path" else "velocity"
    scale = unit_system(units).scale(kind, fit.band.at[-1])
    curves = [test.curve for test in tests if test.curve is not None]
    if fit.over == "slip path":
        for curve in curves:
            axes.plot(scale(curve.slip_m), curve.ratio, color=COLOURS["limit"], linewidth=0.6)
    else:
        for test in tests:
            left = test.peak_pa if np.isnan(test.residual_pa) else test.residual_pa
            axes.plot(scale(test.speed_m_s), left / test.normal_pa, "o", color="#000000", markersize=4)
    at = scale(np.array(fit.band.at))
    axes.plot(at, fit.band.best, color=COLOURS["slip"], linewidth=2.0, label=fit.law)
    axes.fill_between(at, fit.band.low, fit.band.high, color=COLOURS["slip"], alpha=0.15, linewidth=0)
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel(f"{fit.over} [{scale.unit}]")
    axes.set_ylabel("apparent friction:\nshear stress over normal stress")
    axes.legend(loc="best")
    heading(figure, title, "shear tests; shaded: 95 % of further tests")
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
