"""What the figures of a study share: the strength of the motion along an axis, headings, colours of models."""

from __future__ import annotations

from typing import Any

from matplotlib.figure import Figure

from heeltoe.arrays import Floats
from heeltoe.motion.intensity import MEASURES
from heeltoe.study.opened import Opened
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.views.figures.style import heading

#: Okabe and Ito's, with dashes beside them, for models, limits and whatever else is told apart.
LINES = (("#0072B2", "-"), ("#D55E00", "--"), ("#009E73", "-."), ("#CC79A7", ":"), ("#E69F00", "-"), ("#000000", "--"))
_WORDS = {"pga": "peak ground acceleration", "pgv": "peak ground velocity", "arias": "Arias intensity"}


def strength_of(found: Opened) -> tuple[Floats, str]:
    """Return how strong the motion of each run is, by the measure in which the study counts, and what to call it."""
    study = found.told["study"]
    asked = study["fragility"] or (study["motions"] or {}).get("scale") or {}
    measure = asked.get("measure", "pga")
    return measured(found, "pga" if measure == "factor" else measure, asked.get("period"))


def measured(found: Opened, measure: str, period: Any) -> tuple[Floats, str]:
    """Return how strong the motion of each run is, in the unit of people, and what to call it."""
    unit = MEASURES[measure][0] if measure in MEASURES else "m/s^2"
    values = found.strength(measure, period)
    name = _WORDS.get(measure, measure)
    if measure == "sa":
        name = f"spectral acceleration at {float(str(period).split()[0]):g} s"
    return (values / STANDARD_GRAVITY, f"{name} [g]") if unit == "m/s^2" else (values, f"{name} [{unit}]")


def headed(figure: Figure, found: Opened, *lines: str) -> Figure:
    """Write above a figure which study it shows, and what."""
    there = sum(found.outcomes.values())
    runs = f"{there:,} runs" if found.complete else f"{there:,} of {found.store.count:,} runs"
    heading(figure, found.title, "; ".join([runs, *lines]))
    return figure
