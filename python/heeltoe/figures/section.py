"""The section with its crack, water, uplift and forces."""

from __future__ import annotations

from matplotlib.figure import Figure

from heeltoe.case import Case
from heeltoe.figures.style import styled


@styled
def section_figure(case: Case, units: str = "si") -> Figure:
    """Draw the section."""
    return Figure()
