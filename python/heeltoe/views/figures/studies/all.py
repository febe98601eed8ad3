"""The figures of a study: those that its method and its motions make sense of."""

from __future__ import annotations

from matplotlib.figure import Figure

from heeltoe.study.answers.study_results import StudyResults
from heeltoe.views.figures.studies.curves import bands_figure, fragility_figure
from heeltoe.views.figures.studies.hazard import hazard_figure
from heeltoe.views.figures.studies.parts import modes_figure, slips_figure
from heeltoe.views.figures.studies.ranks import ranks_figure
from heeltoe.views.figures.studies.sensitivity import sobol_figure, tornado_figure
from heeltoe.views.figures.studies.suite import suite_figures


def study_figures(study: StudyResults, units: str = "si") -> dict[str, Figure]:
    """Return what can be drawn of a study, complete or not, by name, in units ``"si"`` or ``"us"``."""
    method, asked = study.manifest["study"]["method"], study.manifest["study"]["fragility"]
    drawn = {
        **suite_figures(study, units),
        "ranks": ranks_figure(study, units) if study.portfolio else None,
        "bands": None if study.suite else bands_figure(study, units),
        "fragility": fragility_figure(study, units) if asked else None,
        "hazard": hazard_figure(study, units) if study.hazard else None,
        "slips": None if study.suite else slips_figure(study, units),
        "modes": None if study.suite else modes_figure(study, units),
        "sobol": sobol_figure(study) if method == "sensitivity" else None,
        "tornado": tornado_figure(study, units) if method == "one at a time" else None,
    }
    return {name: figure for name, figure in drawn.items() if figure is not None}
