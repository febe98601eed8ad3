"""Everything that `--out` writes: strict JSON, histories, crack, figures, VTK files; all of it or nothing."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from shutil import rmtree
from tempfile import TemporaryDirectory

from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.models.flexible.history import crack_table
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.result.response import Response
from heeltoe.result.write import json_text, write_table
from heeltoe.study.comparison import Comparison
from heeltoe.study.grid import Grid
from heeltoe.study.overturning import OverturningMap
from heeltoe.views.figures import NAMES, save_all, write_comparison_figure, write_figures
from heeltoe.views.figures.overturning import overturning_figure

# Names of files that a run may leave; those of an earlier one into the same directory would not belong to this one.
_TABLES = ("histories", "events", "crack", "table")
_OWN = (
    "result.json",
    *(f"{name}{suffix}" for name in _TABLES for suffix in (".parquet", ".csv")),
    *(f"{name}{suffix}" for name in NAMES for suffix in (".png", ".svg")),
)
_VTK = "vtk"


def write_all(
    result: Response | Comparison | Grid,
    directory: Path,
    case: Case | None = None,
    units: str = "si",
    *,
    suffix: str = ".parquet",
    vtk: bool = False,
    figures: bool = True,
) -> list[Path]:
    """Write a result with its histories and figures.

    Of one model ``result.json``, ``histories``, ``events`` (rigid) or ``crack`` (flexible) and the figures go right
    into the directory. Of both, ``result.json`` with both and the figure ``comparison`` do, and each model's own into
    the directories named after the models. Of a table of runs ``result.json``, ``table`` and its figures. With the case
    there is a figure of the section, too. All is
    written aside first, so that a failure leaves nothing half-done; files of these names from an earlier run are
    replaced or removed.

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
        Whether a result of one model or both has figures; a report holds them all itself.

    Returns
    -------
    list of Path
        What was written; of the VTK files only those that list the others.

    Raises
    ------
    InputError
        Where the directory cannot be written, the units are unknown, or what VTK files need is not installed.
    """

    def write(fresh: Path) -> None:
        if isinstance(result, Comparison):
            (fresh / "result.json").write_text(json_text(result.to_json()) + "\n", encoding="utf-8")
            if figures:
                write_comparison_figure(result, fresh, case=case, units=units)
            for each in (result.rigid, result.flexible):
                _write_one(each, fresh / each.model, suffix, vtk)
                if figures:
                    write_figures(each, fresh / each.model, units=units)
        elif isinstance(result, Grid):
            _write_grid(result, fresh, units)
        else:
            _write_one(result, fresh, suffix, vtk)
            if figures:
                write_figures(result, fresh, case=case, units=units)

    return _whole(write, directory, _OWN)


def write_overturning(found: OverturningMap, directory: Path) -> list[Path]:
    """Write a map as ``overturning.csv``, ``.png`` and ``.svg``, all of them or none, and return their paths.

    What a run has left in the directory stays.
    """

    def write(fresh: Path) -> None:
        write_table(found.to_table(), fresh / "overturning.csv")
        save_all({"overturning": overturning_figure(found)}, fresh)

    return _whole(write, directory, ())


def _whole(write: Callable[[Path], None], directory: Path, own: tuple[str, ...]) -> list[Path]:
    """Let `write` fill a place aside, then move all of it into `directory`, where files of the names `own` go.

    After a failure, or an interruption, there is what was there before.
    """
    made = next((place for place in (*reversed(directory.parents), directory) if not place.exists()), None)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=directory) as fresh:
            write(Path(fresh))
            return _move(Path(fresh), directory, own)
    except BaseException as error:
        if made is not None:
            rmtree(made, ignore_errors=True)
        if isinstance(error, OSError):
            raise InputError("cannot-write", "--out", directory, reason=error.strerror or error) from None
        raise


def _write_one(response: Response, directory: Path, suffix: str, vtk: bool) -> None:
    directory.mkdir(exist_ok=True)
    (directory / "result.json").write_text(json_text(response.to_json()) + "\n", encoding="utf-8")
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

        write_vtk_series(response.crack, directory / _VTK)


def _write_grid(grid: Grid, directory: Path, units: str) -> None:
    from heeltoe.views.figures import write_grid_figures

    (directory / "result.json").write_text(json_text(grid.to_json()) + "\n", encoding="utf-8")
    for suffix in (".csv", ".parquet"):
        write_table(grid.to_table(), directory / f"table{suffix}")
    write_grid_figures(grid, directory, units)


def _move(fresh: Path, directory: Path, own: tuple[str, ...]) -> list[Path]:
    """Move all files to where they belong; remove what an earlier run has left there under the names `own`."""
    sources = sorted(path for path in fresh.rglob("*") if path.is_file())
    for folder in {source.parent.relative_to(fresh) for source in sources}:
        for name in own:
            (directory / folder / name).unlink(missing_ok=True)
        if folder.name == _VTK:
            for series in ("dam", "crack"):
                for path in (directory / folder).glob(f"{series}-*.vtu"):
                    path.unlink()
    written = []
    for source in sources:
        place = directory / source.relative_to(fresh)
        place.parent.mkdir(parents=True, exist_ok=True)
        source.replace(place)
        # There are as many VTK files as frames; those that list them are the ones to open.
        if place.suffix != ".vtu":
            written.append(place)
    return written
