"""The curve of a friction law."""

from __future__ import annotations

from matplotlib.figure import Figure

from heeltoe.mechanics.law_curve import LawCurve
from heeltoe.units.sentences import written
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.style import COLOURS, heading, styled


@styled
def law_figure(found: LawCurve, units: str = "si") -> Figure:
    """Draw the apparent friction of a law over what it goes by."""
    figure = Figure(figsize=(7.0, 4.0), layout="constrained")
    axes = figure.subplots()
    system = unit_system(units)
    kind = {"slip path": "displacement", "slip speed": "velocity", "normal stress": "pressure"}[found.over]
    scale = system.scale(kind, float(found.at[-1]))
    axes.plot(scale(found.at), found.friction, color=COLOURS["slip"], label="sliding")
    place = scale(found.normal_stress_pa) if found.over == "normal stress" else 0.0
    axes.plot([place], [found.at_rest], color="#000000", marker="o", linestyle="", label="before any slip")
    axes.set_xlabel(f"{found.over} [{scale.unit}]")
    axes.set_ylabel("apparent friction:\nstrength over normal stress")
    axes.set_ylim(0.0, 1.08 * max(float(found.friction.max()), found.at_rest, 1e-3))
    axes.legend(loc="best")
    stress = written("{stress_pa:.3g MPa}", units, stress_pa=found.normal_stress_pa)
    heading(figure, found.title, f"{found.name}, normal stress {stress}")
    return figure
