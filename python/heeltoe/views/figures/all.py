"""Which figures a result has."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.result.response import Response
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.anchors import anchor_figure, moving_anchors
from heeltoe.views.figures.crack_level import crack_level_figure
from heeltoe.views.figures.dense import filled_in
from heeltoe.views.figures.energy import energy_figure
from heeltoe.views.figures.histories import (
    NO_SLIP,
    acceleration_figure,
    bearing_figure,
    crest_figure,
    force_figure,
    lifts_off,
    response_figure,
    slip_by_mode_figure,
)
from heeltoe.views.figures.law import asperities_figure, friction_figure, law_figure
from heeltoe.views.figures.panels import is_elastic
from heeltoe.views.figures.path import path_figure
from heeltoe.views.figures.plan import plan_figure
from heeltoe.views.figures.spectrum import spectrum_figure
from heeltoe.views.words.response import OF_CRACKS

if TYPE_CHECKING:
    from heeltoe.case.model import Case

#: Lift-offs below this [m] have no picture of their own.
_NO_LIFT = 1e-5
#: Nor has the motion of a crest that goes with the ground up to this [m].
_NO_SHIFT = 1e-5


class Figures(Mapping[str, Figure]):
    """Figures by name, each drawn at its first use, and kept.

    Parameters
    ----------
    drawings
        What draws each, by name, in the order in which they are shown.
    """

    def __init__(self, drawings: Mapping[str, Callable[[], Figure]]) -> None:
        self._drawings = drawings
        self._drawn: dict[str, Figure] = {}

    def __getitem__(self, name: str) -> Figure:
        if name not in self._drawn:
            self._drawn[name] = self._drawings[name]()
        return self._drawn[name]

    def let_go(self, name: str) -> None:
        """Keep a figure no longer."""
        self._drawn.pop(name, None)

    def __contains__(self, name: object) -> bool:
        return name in self._drawings

    def __iter__(self) -> Iterator[str]:
        return iter(self._drawings)

    def __len__(self) -> int:
        return len(self._drawings)


def all_figures(case: Case | None, result: Response, units: str = "si") -> Figures:
    """Return the figures that make sense for a result, by name, in the order in which they are shown.

    Parameters
    ----------
    case
        Of the result; without it there is no figure of the section.
    result
        Of one model, or with another beside it: then there is ``comparison``, and the figures of the other are under
        its name, ``rigid/...``; those of further cracks are under theirs, ``crack-1/...`` from the crest down. A run
        that never started has the section alone.
    units
        ``"si"`` or ``"us"``.

    Returns
    -------
    Figures
        Each says above itself which case, motion and model it shows; ``without_heading`` of
        :mod:`heeltoe.views.figures.style` takes that off.

    Raises
    ------
    InputError
        Where the units are unknown.
    """
    unit_system(units)
    drawings: dict[str, Callable[[], Figure]] = {}
    if case is not None:
        from heeltoe.views.figures.section import section_figure

        drawings["section"] = lambda: section_figure(case, units)
        drawings |= _laws(case, units)
    beside = result.beside
    if beside is not None and has_pictures(result) and has_pictures(beside):
        from heeltoe.views.figures.histories import comparison_figure

        drawings["comparison"] = lambda: comparison_figure(result, beside, units)
    side_gap = None if case is None else case.crack.side_gap
    drawings |= _drawings(result, units, side_gap)
    if case is not None and "response" in drawings and moving_anchors(case):
        drawings["anchors"] = lambda: anchor_figure(case, filled_in(result), units)
    for name, other in result.others.items():
        drawn = _drawings(other, units)
        drawings |= {f"{name}/{figure_name}": drawn[figure_name] for figure_name in OF_CRACKS if figure_name in drawn}
    if beside is not None:
        drawings |= {f"{beside.model}/{name}": draw for name, draw in _drawings(beside, units, side_gap).items()}
    return Figures(drawings)


def _laws(case: Case, units: str) -> dict[str, Callable[[], Figure]]:
    """Return what draws the friction law of each crack that has one."""
    if all(alone.crack.law is None for alone in case.single_crack_cases):
        return {}
    from heeltoe.mechanics.law_curve import curves_of

    return {name: partial(law_figure, curve, units) for name, curve in curves_of(case).items()}


def has_pictures(response: Response) -> bool:
    """Whether there are histories to draw: more than their first moment, and no number that has left all bounds."""
    h = response.histories
    return bool(h) and len(h.time_s) > 1 and all(np.isfinite(values).all() for values in h.values())


def _drawings(
    response: Response, units: str, side_gap: tuple[float, float] | None = None
) -> dict[str, Callable[[], Figure]]:
    """Return what draws each figure of one model; `side_gap` are the joints to its neighbours [m]."""
    if not has_pictures(response):
        return {}
    response = filled_in(response)
    figures: dict[str, Callable[[], Figure]] = {"response": lambda: response_figure(response, units)}
    if "slip_cross_m" in response.histories:
        figures["plan"] = lambda: plan_figure(response, units, side_gap)
    # Of a single mode the slip of the response says it all.
    if sum(abs(slip) > NO_SLIP for slip in response.slip_by_mode_m.values()) > 1:
        figures["slip-by-mode"] = lambda: slip_by_mode_figure(response, units)
    if "friction_strength_n" in response.histories:
        figures["friction"] = lambda: friction_figure(response, units)
    if "dilation_m" in response.histories:
        figures["asperities"] = lambda: asperities_figure(response, units)
    if is_elastic(response):
        figures["forces"] = lambda: force_figure(response, units)
    else:
        figures["accelerations"] = lambda: acceleration_figure(response, units)
    figures["bearing"] = lambda: bearing_figure(response, units)
    if response.crest is not None and response.crest.displacement_m > _NO_SHIFT:
        figures["crest"] = lambda: crest_figure(response, units)
    if response.energy is not None and response.energy.input_j:
        figures["energy"] = lambda: energy_figure(response, units)
    if lifts_off(response, _NO_LIFT):
        figures["path"] = lambda: path_figure(response, units)
    figures["spectrum"] = lambda: spectrum_figure(response, units)
    if isinstance(response, DecoupledResponse):
        chained = response
        figures["crack-level"] = lambda: crack_level_figure(chained)
    if isinstance(response, FlexibleResponse):
        figures |= _elastic_drawings(response, units)
    return figures


def _elastic_drawings(response: FlexibleResponse, units: str) -> dict[str, Callable[[], Figure]]:
    from heeltoe.views.figures.crack import crack_figure, joint_figure, joints_figure, pressure_figure
    from heeltoe.views.figures.dam import mesh_figure, modes_figure
    from heeltoe.views.figures.scatter import scatter_figure
    from heeltoe.views.figures.stress.deformed import deformed_figure
    from heeltoe.views.figures.stress.tension import tension_figure
    from heeltoe.views.figures.water_pressure import water_pressure_figure

    dam = response.crack.dam
    drawn = {"tension": lambda: tension_figure(response, units)} if response.tension is not None else {}
    if sum(crack.joint is not None for crack in response.cracks) > 1:
        drawn["joints"] = lambda: joints_figure(response, units)
    wet = {} if response.crack.water is None else {"water-pressure": lambda: water_pressure_figure(response, units)}
    if response.joint is not None:
        drawn["joint"] = lambda: joint_figure(response, units)
    scatters = response.evidence is not None and response.evidence.scatters
    return {
        **({"scatter": lambda: scatter_figure(response, units)} if scatters else {}),
        "crack": lambda: crack_figure(response, units),
        "pressure": lambda: pressure_figure(response, units),
        **wet,
        "deformed": lambda: deformed_figure(response, units=units),
        **drawn,
        "mesh": lambda: mesh_figure(dam, units),
        "modes": lambda: modes_figure(dam, units),
    }
