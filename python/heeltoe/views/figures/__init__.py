"""Figures (matplotlib): one visual language, colour-blind safe, readable in black and white, units on every axis."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from heeltoe.units.systems import unit_system
from heeltoe.views.figures.all import NAMES, all_figures
from heeltoe.views.figures.crack_level import crack_level_figure
from heeltoe.views.figures.energy import energy_figure
from heeltoe.views.figures.histories import acceleration_figure, force_figure, response_figure, slip_by_mode_figure
from heeltoe.views.figures.path import path_figure
from heeltoe.views.figures.spectrum import spectrum_figure
from heeltoe.views.figures.style import COLOURS, STYLE
from heeltoe.views.figures.write import save, save_all

if TYPE_CHECKING:
    from heeltoe.views.figures.comparison import comparison_figure
    from heeltoe.views.figures.crack import crack_figure, pressure_figure
    from heeltoe.views.figures.dam import mesh_figure, modes_figure
    from heeltoe.views.figures.deformed import deformed_figure
    from heeltoe.views.figures.runs import grid_figures, slips_figure
    from heeltoe.views.figures.section import section_figure

__all__ = [
    "COLOURS",
    "NAMES",
    "STYLE",
    "acceleration_figure",
    "all_figures",
    "comparison_figure",
    "crack_figure",
    "crack_level_figure",
    "deformed_figure",
    "energy_figure",
    "force_figure",
    "grid_figures",
    "mesh_figure",
    "modes_figure",
    "path_figure",
    "pressure_figure",
    "response_figure",
    "save",
    "save_all",
    "section_figure",
    "slip_by_mode_figure",
    "slips_figure",
    "spectrum_figure",
    "unit_system",
]

# Those that need the elastic parts, or shapes; the figures of a rigid block need not wait for these.
_HOME = {
    "comparison_figure": "comparison",
    "crack_figure": "crack",
    "deformed_figure": "deformed",
    "mesh_figure": "dam",
    "modes_figure": "dam",
    "pressure_figure": "crack",
    "section_figure": "section",
    "slips_figure": "runs",
    "grid_figures": "runs",
}


def __getattr__(name: str) -> Any:
    """Import on first use."""
    if name not in _HOME:
        raise AttributeError(f"module 'heeltoe.views.figures' has no attribute {name!r}")
    value = getattr(import_module(f"heeltoe.views.figures.{_HOME[name]}"), name)
    globals()[name] = value
    return value
