"""Which figures the static checks have."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from matplotlib.figure import Figure

from heeltoe.models.statics.joints import Joint, Joints
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.views.figures.all import Figures
from heeltoe.views.figures.section import section_figure
from heeltoe.views.figures.statics.checks import statics_figure
from heeltoe.views.figures.statics.forces import forces_figure


def statics_figures(joints: Joints, units: str = "si", *, every: bool = False) -> Figures:
    """Return the figures of static checks by name: of the governing section itself, its checks as bars, and the forces
    of each load case; with `every` those forces at the other sections, too."""
    joint = joints.governing
    drawings: dict[str, Callable[[], Figure]] = {
        "section": lambda: section_figure(joint.case, units),
        "checks": lambda: statics_figure(joint.statics),
    }
    for place in joints.ranked if every else (joint,):
        for load_case in place.statics.cases:
            drawings[forces_name(joints, place, load_case)] = partial(forces_figure, place.case, load_case, units)
    return Figures(drawings)


def forces_name(joints: Joints, joint: Joint, load_case: LoadCase) -> str:
    """Return the name of the figure of a load case at a section: of other sections than the governing one it begins
    with the elevation in metres."""
    place = "" if joint is joints.governing else f"at-{joint.elevation_m:.10g}m-"
    return f"{place}forces-{slug(load_case.name)}"


def slug(name: str) -> str:
    """Return the name of a load case as a part of a file's name."""
    return name.replace(",", "").replace(" ", "-")
