"""The curve of a result over a field, and where it crosses a limit."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.result.limits import LABELS
from heeltoe.study.small.solve import Solved
from heeltoe.units.systems import Scale, unit_system
from heeltoe.views.figures.panels import largest
from heeltoe.views.figures.style import COLOURS, WIDTH, heading, styled

# What lies this far above the limit does not decide how high the figure is.
_HIGHEST = 5.0


@styled
def solve_figure(solved: Solved, scale: Scale, units: str = "si") -> Figure:
    """Draw the result by the worse sign over the field, the limit, and the crossings; `scale` is that of the field."""
    figure = Figure(figsize=(WIDTH, 4.0), layout="constrained")
    axes = figure.subplots()
    known = [point for point in solved.points if point.result_m is not None]
    results = np.array([point.result_m for point in known], dtype=np.float64)
    high = min(float(results.max(initial=0.0)), _HIGHEST * solved.allowed_m)
    metres = unit_system(units).scale("displacement", largest(np.array([high, solved.allowed_m])))
    values = scale(np.array([point.value for point in known]))
    axes.plot(values, metres(results), color=COLOURS["slip"], marker="o", markersize=3.5, label="worse sign")
    top = 1.12 * float(metres(max(high, solved.allowed_m)))
    beyond = [float(scale(point.value)) for point in solved.points if point.result_m is None]
    if beyond:
        label = "fails, or has no result"
        axes.plot(beyond, np.full(len(beyond), 0.96 * top), "x", color=COLOURS["crack"], label=label, markersize=6)
    axes.axhline(metres(solved.allowed_m), color=COLOURS["crack"], linewidth=1.3, label="allowed")
    for place, crossing in enumerate(solved.crossings):
        at, give = float(scale(crossing.value)), float(scale(crossing.give_or_take or 0.0))
        axes.axvspan(at - give, at + give, color="#BBBBBB", alpha=0.6, linewidth=0.0)
        label = f"just met at {at:.4g} {scale.unit}".rstrip()
        axes.axvline(at, color="#444444", linestyle=("--", ":", "-.")[place % 3], linewidth=1.2, label=label)
    axes.set_ylim(0.0, top)
    axes.set_xlabel(f"{solved.field} [{scale.unit}]" if scale.unit else solved.field)
    axes.set_ylabel(f"{LABELS[solved.limit]}, either way [{metres.unit}]")
    axes.legend(loc="best", fontsize=8)
    one_way = "" if solved.one_way else "; not one way"
    heading(figure, solved.title or "Untitled case", f"{solved.model} model, {len(solved.points)} values{one_way}")
    return figure
