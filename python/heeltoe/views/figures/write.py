"""Which figures a result has, and writing them to files."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.result.response import Response
from heeltoe.study.comparison import Comparison
from heeltoe.views.figures.crack_level import crack_level_figure
from heeltoe.views.figures.dense import filled_in
from heeltoe.views.figures.energy import energy_figure
from heeltoe.views.figures.histories import (
    NO_SLIP,
    acceleration_figure,
    force_figure,
    lifts_off,
    response_figure,
    slip_by_mode_figure,
)
from heeltoe.views.figures.panels import is_elastic
from heeltoe.views.figures.path import path_figure
from heeltoe.views.figures.spectrum import spectrum_figure
from heeltoe.views.figures.style import STYLE, laid_out, without_heading

if TYPE_CHECKING:
    from heeltoe.case.model import Case

#: Every name that a figure of a result can have, in the order in which they are shown.
NAMES = (
    "section",
    "comparison",
    "response",
    "slip-by-mode",
    "accelerations",
    "forces",
    "energy",
    "path",
    "spectrum",
    "crack-level",
    "slips",
    "crack",
    "pressure",
    "deformed",
    "mesh",
    "modes",
)
#: Lift-offs below this [m] have no picture of their own.
_NO_LIFT = 1e-5


def all_figures(
    case: Case | None,
    result: Response | Comparison,
    units: str = "si",
    *,
    headings: bool = False,
    only: Callable[[str], bool] = lambda name: True,
) -> dict[str, Figure]:
    """Return the figures that make sense for a result, by name, in the order in which they are shown.

    Parameters
    ----------
    case
        Of the result; without it there is no figure of the section.
    result
        Of one model, or of both: then ``comparison`` comes with the figures of each under ``rigid/...`` and
        ``flexible/...``. A run that never started has the section alone.
    units
        ``"si"`` or ``"us"``.
    headings
        Whether each figure says above itself which case, motion and model it shows; a page with captions does that.
    only
        Told a name, whether to draw that figure; all of them without it.

    Raises
    ------
    InputError
        Where the units are unknown, or the crack does not cut the section in two.
    """
    drawings: dict[str, Callable[[], Figure]] = {}
    if case is not None:
        from heeltoe.views.figures.section import section_figure

        drawings["section"] = lambda: section_figure(case, units)
    drawings |= _drawings(result, units)
    figures = {name: draw() for name, draw in drawings.items() if only(name)}
    if not headings:
        figures = {name: without_heading(figure) for name, figure in figures.items()}
    return figures


def has_pictures(response: Response) -> bool:
    """Whether there are histories to draw: more than their first moment, and no number that has left all bounds."""
    h = response.histories
    return bool(h) and len(h["time_s"]) > 1 and all(np.isfinite(values).all() for values in h.values())


@singledispatch
def _drawings(result: object, units: str) -> dict[str, Callable[[], Figure]]:
    """Return what draws each figure of a result."""
    raise TypeError(f"there are no figures of a {type(result).__name__}")


@_drawings.register
def _(both: Comparison, units: str) -> dict[str, Callable[[], Figure]]:
    found: dict[str, Callable[[], Figure]] = {}
    if all(map(has_pictures, both.responses)):
        from heeltoe.views.figures.comparison import comparison_figure

        found["comparison"] = lambda: comparison_figure(both, units)
    for each in both.responses:
        found |= {f"{each.model}/{name}": draw for name, draw in _drawings(each, units).items()}
    return found


@_drawings.register
def _(response: Response, units: str) -> dict[str, Callable[[], Figure]]:
    if not has_pictures(response):
        return {}
    response = filled_in(response)
    found: dict[str, Callable[[], Figure]] = {"response": lambda: response_figure(response, units)}
    if any(abs(slip) > NO_SLIP for slip in response.slip_by_mode_m.values()):
        found["slip-by-mode"] = lambda: slip_by_mode_figure(response, units)
    if is_elastic(response):
        found["forces"] = lambda: force_figure(response, units)
    else:
        found["accelerations"] = lambda: acceleration_figure(response, units)
    if response.energy is not None and response.energy.input_j:
        found["energy"] = lambda: energy_figure(response, units)
    if lifts_off(response, _NO_LIFT):
        found["path"] = lambda: path_figure(response, units)
    found["spectrum"] = lambda: spectrum_figure(response, units)
    if isinstance(response, DecoupledResponse):
        chained = response
        found["crack-level"] = lambda: crack_level_figure(chained)
    if isinstance(response, FlexibleResponse):
        found |= _elastic_drawings(response, units)
    return found


def _elastic_drawings(response: FlexibleResponse, units: str) -> dict[str, Callable[[], Figure]]:
    from heeltoe.views.figures.crack import crack_figure, pressure_figure
    from heeltoe.views.figures.dam import mesh_figure, modes_figure
    from heeltoe.views.figures.deformed import deformed_figure

    dam = response.crack.dam
    return {
        "crack": lambda: crack_figure(response, units),
        "pressure": lambda: pressure_figure(response, units),
        "deformed": lambda: deformed_figure(response, units=units),
        "mesh": lambda: mesh_figure(dam, units),
        "modes": lambda: modes_figure(dam, units),
    }


def write_figures(response: Response, directory: Path, *, case: Case | None = None, units: str = "si") -> list[Path]:
    """Write the figures of a response into `directory` as PNG and SVG and return their paths.

    A response without histories (the run never started) has none but the section, where its case is given.
    """
    return save_all(all_figures(case, response, units, headings=True), directory)


def write_comparison_figure(
    both: Comparison, directory: Path, *, case: Case | None = None, units: str = "si"
) -> list[Path]:
    """Write the figure of both models, and of the section where the case is given, into `directory` as PNG and SVG and
    return their paths; the first only if both have started."""
    figures = {}
    if case is not None:
        from heeltoe.views.figures.section import section_figure

        figures["section"] = section_figure(case, units)
    if has_pictures(both.rigid) and has_pictures(both.flexible):
        from heeltoe.views.figures.comparison import comparison_figure

        figures["comparison"] = comparison_figure(both, units)
    return save_all(figures, directory)


def save_all(figures: dict[str, Figure], directory: Path) -> list[Path]:
    """Write figures by their names as PNG and SVG and return the paths."""
    written = []
    for name, figure in figures.items():
        laid_out(figure)
        for suffix in (".png", ".svg"):
            path = directory / f"{name}{suffix}"
            save(figure, path)
            written.append(path)
    return written


def save(figure: Figure, path: Path, dpi: float = 150.0) -> None:
    """Write one figure; the ending of the path says the format."""
    # Without its date the same figure makes the same file.
    metadata = {"Date": None} if path.suffix == ".svg" else None
    with mpl.rc_context(STYLE):
        figure.savefig(path, dpi=dpi, metadata=metadata)
