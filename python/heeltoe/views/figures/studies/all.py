"""The figures of a study: those that its method and its motions make sense of."""

from __future__ import annotations

from matplotlib.figure import Figure

from heeltoe.study.answers.study_results import Opened
from heeltoe.views.figures.studies.curves import bands_figure, fragility_figure
from heeltoe.views.figures.studies.hazard import hazard_figure
from heeltoe.views.figures.studies.parts import modes_figure, slips_figure
from heeltoe.views.figures.studies.ranks import ranks_figure
from heeltoe.views.figures.studies.sensitivity import sobol_figure, tornado_figure
from heeltoe.views.figures.studies.suite import suite_figures


def study_figures(found: Opened, units: str = "si") -> dict[str, Figure]:
    """Return what can be drawn of a study, complete or not, by name, in units ``"si"`` or ``"us"``."""
    method, asked = found.told["study"]["method"], found.told["study"]["fragility"]
    drawn = {
        **suite_figures(found, units),
        "ranks": ranks_figure(found, units) if found.portfolio else None,
        "bands": None if found.suite else bands_figure(found, units),
        "fragility": fragility_figure(found, units) if asked else None,
        "hazard": hazard_figure(found, units) if found.hazard else None,
        "slips": None if found.suite else slips_figure(found, units),
        "modes": None if found.suite else modes_figure(found, units),
        "sobol": sobol_figure(found) if method == "sensitivity" else None,
        "tornado": tornado_figure(found, units) if method == "one at a time" else None,
    }
    return {name: figure for name, figure in drawn.items() if figure is not None}
