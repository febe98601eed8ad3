"""What the figures of a study share: the strength of the motion along an axis, headings, colours of models."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure

from heeltoe.study.answers.study_results import Opened
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
        As :meth:`heeltoe.study.answers.study_results.Opened.bands` takes them.
    scale
        What a strength in SI is divided by.
    label
        What it is called, with the unit of people.
    """

    measure: str
    period: Any
    scale: float
    label: str


def strength_of(found: Opened, units: str = "si") -> Strength:
    """Return the measure in which the study counts."""
    study = found.told["study"]
    asked = study["fragility"] or (study["motions"] or {}).get("scale") or {}
    measure = asked.get("measure", "pga")
    return measured("pga" if measure == "factor" else measure, asked.get("period"), units)


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


def farthest(found: Opened) -> float:
    """Return the largest residual slip of all runs, either way [m]; zero where there is none."""
    return max((abs(item["residual_slip_m"]["largest"] or 0.0) for item in found.summary), default=0.0)


def headed(figure: Figure, found: Opened, *lines: str) -> Figure:
    """Write above a figure which study it shows, and what."""
    there = sum(found.outcomes.values())
    runs = f"{there:,} runs" if found.complete else f"{there:,} of {found.store.count:,} runs"
    heading(figure, found.title, "; ".join([runs, *lines]))
    return figure
