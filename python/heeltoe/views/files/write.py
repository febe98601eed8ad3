"""Everything that `--out` writes: strict JSON, histories, crack, figures, VTK files; all of it or nothing."""

from __future__ import annotations

from collections.abc import Mapping
from functools import singledispatch
from pathlib import Path

from matplotlib.figure import Figure

from heeltoe.case.model import Case
from heeltoe.models.flexible.history import crack_table
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.result.response import Response
from heeltoe.result.write import json_text, write_table
from heeltoe.study.grid import Grid
from heeltoe.study.overturning import OverturningMap
from heeltoe.views.figures.all import NAMES, all_figures
from heeltoe.views.figures.overturning import overturning_figure
from heeltoe.views.figures.runs import grid_figures
from heeltoe.views.figures.write import save_all
from heeltoe.views.files.whole import VTK, write_whole

# Names of files that a run may leave; those of an earlier one into the same directory would not belong to this one.
_TABLES = ("histories", "events", "crack", "table")
_OWN = (
    "result.json",
    *(f"{name}{suffix}" for name in _TABLES for suffix in (".parquet", ".csv")),
    *(f"{name}{suffix}" for name in NAMES for suffix in (".png", ".svg")),
)


def write_all(
    result: Response | Grid,
    directory: Path,
    case: Case | None = None,
    units: str = "si",
    *,
    suffix: str = ".parquet",
    vtk: bool = False,
    figures: Mapping[str, Figure] | None = None,
) -> list[Path]:
    """Write a result with its histories and figures.

    Of a response ``result.json``, ``histories``, ``events`` (rigid) or ``crack`` (flexible) and the figures go right
    into the directory; what stands beside it goes into a directory named after its model. Of a table of runs
    ``result.json``, ``table`` and its figures. With the case there is a figure of the section, too. All is written
    aside first, so that a failure leaves nothing half-done; files of these names from an earlier run are replaced or
    removed.

    Parameters
    ----------
    result
        What to write.
    directory
        Where; it is made if it is not there.
    case
        Of the result.
    units
        Of the figures, ``"si"`` or ``"us"``; numbers in files are SI.
    suffix
        Of the tables, ``.parquet`` or ``.csv``.
    vtk
        Write the flexible model's parts as VTK files into ``vtk``, too; those of an earlier run there go.
    figures
        Figures of the result, drawn before; none of them where this is empty, as where a report holds them. They are
        drawn here where it is not given.

    Returns
    -------
    list of Path
        What was written; of the VTK files only those that list the others.

    Raises
    ------
    InputError
        Where the directory cannot be written, the units are unknown, or what VTK files need is not installed.
    """

    drawn = figures_of(result, case, units) if figures is None else figures

    def write(fresh: Path) -> None:
        _write(result, fresh, suffix, vtk)
        save_all(drawn, fresh)

    return write_whole(write, directory, _OWN)


def write_overturning(found: OverturningMap, directory: Path) -> list[Path]:
    """Write a map as ``overturning.csv``, ``.png`` and ``.svg``, all of them or none, and return their paths.

    What a run has left in the directory stays.
    """

    def write(fresh: Path) -> None:
        write_table(found.to_table(), fresh / "overturning.csv")
        save_all({"overturning": overturning_figure(found)}, fresh)

    return write_whole(write, directory, ())


@singledispatch
def figures_of(result: object, case: Case | None, units: str) -> Mapping[str, Figure]:
    """Return the figures of a result."""
    raise TypeError(f"there are no figures of a {type(result).__name__}")


figures_of.register(Response, lambda result, case, units: all_figures(case, result, units))
figures_of.register(Grid, lambda result, case, units: grid_figures(result, units))


@singledispatch
def _write(result: object, directory: Path, suffix: str, vtk: bool) -> None:
    """Write JSON and tables of a result."""
    raise TypeError(f"nothing writes a {type(result).__name__}")


@_write.register
def _(response: Response, directory: Path, suffix: str, vtk: bool) -> None:
    _write_json(response, directory)
    if response.beside is not None:
        (directory / response.beside.model).mkdir()
        _write(response.beside, directory / response.beside.model, suffix, vtk)
    if not response.histories:
        return
    response.write_histories(directory / f"histories{suffix}")
    if response.event_log:
        response.write_events(directory / f"events{suffix}")
    if not isinstance(response, FlexibleResponse):
        return
    write_table(crack_table(response.crack), directory / f"crack{suffix}")
    if vtk:
        from heeltoe.views.files.vtk import write_vtk_series

        write_vtk_series(response.crack, directory / VTK)


@_write.register
def _(grid: Grid, directory: Path, suffix: str, vtk: bool) -> None:
    _write_json(grid, directory)
    for each in (".csv", ".parquet"):
        write_table(grid.to_table(), directory / f"table{each}")


def _write_json(result: Response | Grid, directory: Path) -> None:
    (directory / "result.json").write_text(json_text(result.to_json()) + "\n", encoding="utf-8")
