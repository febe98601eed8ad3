"""Which figures the static checks have."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from matplotlib.figure import Figure

from heeltoe.models.statics.joints import Joints
from heeltoe.views.figures.all import Figures
from heeltoe.views.figures.section import section_figure
from heeltoe.views.figures.statics.checks import statics_figure
from heeltoe.views.figures.statics.forces import forces_figure


def statics_figures(found: Joints, units: str = "si") -> Figures:
    """Return the figures of static checks by name, those of the governing section: the section, the checks as bars,
    and the forces of each load case."""
    joint = found.governing
    drawings: dict[str, Callable[[], Figure]] = {
        "section": lambda: section_figure(joint.case, units),
        "checks": lambda: statics_figure(joint.statics),
    }
    for each in joint.statics.cases:
        drawings[f"forces-{slug(each.name)}"] = partial(forces_figure, joint.case, each, units)
    return Figures(drawings)


def slug(name: str) -> str:
    """Return the name of a load case as a part of a file's name."""
    return name.replace(",", "").replace(" ", "-")
