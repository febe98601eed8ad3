"""Common parts of the figures of a study: the strength of the motion along an axis, headings, colours of models."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure

from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.units.systems import INCH
from heeltoe.views.figures.style import heading
from heeltoe.views.words.studies import strength_scale

#: Okabe and Ito's, with dashes beside them, for models, limits and whatever else is distinguished.
LINES = (("#0072B2", "-"), ("#D55E00", "--"), ("#009E73", "-."), ("#CC79A7", ":"), ("#E69F00", "-"), ("#000000", "--"))
_WORDS = {"pga": "peak ground acceleration", "pgv": "peak ground velocity", "arias": "Arias intensity"}


@dataclass(frozen=True)
class Strength:
    """How strong motions are, along an axis.

    Attributes
    ----------
    measure, period
        As :meth:`heeltoe.study.answers.study_results.StudyResults.bands` takes them.
    scale
        What a strength in SI is divided by.
    label
        What it is called, with the unit of people.
    """

    measure: str
    period: Any
    scale: float
    label: str


def strength_of(study: StudyResults, units: str = "si") -> Strength:
    """Return the measure in which the study counts."""
    plan = study.manifest["study"]
    settings = plan["fragility"] or (plan["motions"] or {}).get("scale") or {}
    measure = settings.get("measure", "pga")
    return measured("pga" if measure == "factor" else measure, settings.get("period"), units)


def measured(measure: str, period: Any, units: str = "si") -> Strength:
    """Return a measure as people read it."""
    name = _WORDS.get(measure, measure)
    if measure == "sa":
        name = f"spectral acceleration at {float(str(period).split()[0]):g} s"
    scale = strength_scale(measure, units)
    return Strength(measure, period, 1.0 / scale.factor, f"{name} [{scale.unit}]")


def slip_scale(units: str) -> tuple[float, str]:
    """Return what a slip in metres is multiplied by along an axis, and its unit."""
    return (1.0 / INCH, "in") if units == "us" else (1e3, "mm")


def farthest(study: StudyResults) -> float:
    """Return the largest residual slip of all runs, either way [m]; zero where there is none."""
    return max((abs(item[RESIDUAL_SLIP.key]["largest"] or 0.0) for item in study.summary), default=0.0)


def headed(figure: Figure, study: StudyResults, *lines: str) -> Figure:
    """Write above a figure which study it shows, and what."""
    count = sum(study.outcomes.values())
    runs = f"{count:,} runs" if study.complete else f"{count:,} of {study.store.count:,} runs"
    heading(figure, study.title, "; ".join([runs, *lines]))
    return figure
