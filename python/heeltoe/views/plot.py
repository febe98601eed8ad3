"""The figure of a thing, for who asks it to draw itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import singledispatch
from os import PathLike
from pathlib import Path

from matplotlib.figure import Figure

from heeltoe.case.model import Case
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import near
from heeltoe.models.statics.model import Statics
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.response import Response
from heeltoe.study.small.overturning import OverturningMap
from heeltoe.study.small.run_table import SmallStudy
from heeltoe.study.small.solved import Solved
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.all import Figures, all_figures
from heeltoe.views.figures.write import save

#: What a figure can be written as.
_ENDINGS = (".png", ".svg", ".pdf")


def plot(thing: object, name: str | None, path: str | PathLike[str] | None, units: str | None) -> Figure:
    """Return a figure of a thing, and write it where a path is given; see :meth:`heeltoe.base.display.Shown.plot`."""
    units = unit_system(units or (thing.units if isinstance(thing, Case) else "si")).name
    place = None if path is None else Path(path)
    if place is not None and place.suffix.lower() not in _ENDINGS:
        raise InputError("file-ending", "path", place, kind="a figure", endings=".png, .svg or .pdf")
    figures = _figures(thing, units)
    if not figures:
        raise InputError("nothing-to-show", "plot", getattr(thing, "outcome", ""))
    wanted = next(iter(figures)) if name is None else name
    if wanted not in figures:
        guess = near(str(wanted), figures)
        raise InputError("not-a-choice", "plot", shown(name), choices=f"{', '.join(figures)}{guess}")
    figure = figures[wanted]
    if place is not None:
        try:
            save(figure, place)
        except OSError as error:
            raise InputError("cannot-write", "path", place, reason=error.strerror or error) from None
    return figure


@singledispatch
def _figures(thing: object, units: str) -> Mapping[str, Figure]:
    """Return the figures of a thing by name, the main one first."""
    raise TypeError(f"there are no figures of a {type(thing).__name__}")


def _one(name: str, draw: Callable[[], Figure]) -> Figures:
    return Figures({name: draw})


@_figures.register
def _(response: Response, units: str) -> Mapping[str, Figure]:
    return all_figures(None, response, units)


@_figures.register
def _(solved: Solved, units: str) -> Mapping[str, Figure]:
    from heeltoe.views.content.solve import field_scale
    from heeltoe.views.figures.runs import solve_figure

    return _one("solve", lambda: solve_figure(solved, field_scale(solved, units), units))


@_figures.register
def _(grid: SmallStudy, units: str) -> Mapping[str, Figure]:
    from heeltoe.views.figures.runs import small_figures

    return small_figures(grid, units)


@_figures.register
def _(case: Case, units: str) -> Mapping[str, Figure]:
    from heeltoe.views.figures.section import section_figure

    return _one("section", lambda: section_figure(case, units))


@_figures.register
def _(motion: GroundMotion, units: str) -> Mapping[str, Figure]:
    from heeltoe.views.figures.motion import motion_figure

    return _one("motion", lambda: motion_figure(motion, STANDARD_GRAVITY, units))


@_figures.register
def _(statics: Statics, units: str) -> Mapping[str, Figure]:
    from heeltoe.views.figures.statics.checks import statics_figure

    unit_system(units)
    return _one("statics", lambda: statics_figure(statics))


@_figures.register
def _(overturning: OverturningMap, units: str) -> Mapping[str, Figure]:
    from heeltoe.views.figures.runs import overturning_figure

    return _one("overturning", lambda: overturning_figure(overturning))
