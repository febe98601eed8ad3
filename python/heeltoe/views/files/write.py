"""Everything that `--out` writes: strict JSON, histories, crack, figures, VTK files; all of it or nothing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from heeltoe.base.atomic_files import write_whole
from heeltoe.base.heap import give_back
from heeltoe.result.response import Response
from heeltoe.result.write import write_json, write_table
from heeltoe.views.figures.names import NAMES
from heeltoe.views.files.names import VTK_FILES, WORKBOOK

# Not at run time: each result needs the libraries of its own figures, and no others'.
if TYPE_CHECKING:
    import pyarrow as pa
    from matplotlib.figure import Figure

    from heeltoe.case.model import Case
    from heeltoe.mechanics.law_curve import LawCurve
    from heeltoe.mechanics.law_fit import LawFits
    from heeltoe.mechanics.shear_tests import ShearTest
    from heeltoe.models.flexible.surroundings.amplification import Amplification
    from heeltoe.study.answers.study_results import StudyResults
    from heeltoe.study.small.overturning import OverturningMap
    from heeltoe.study.small.run_table import SmallStudy
    from heeltoe.study.small.solved import Solved

#: The directory of the VTK files, one of each kind for each frame, of which only what lists them is told.
VTK = "vtk"
#: Files of a map of overturning.
OVERTURNING = ("overturning.csv", "overturning.png", "overturning.svg")
#: Files of a field that was solved for.
SOLVED = ("solve.json", "solve.csv", "solve.png", "solve.svg")
#: Files of the response of a crest.
RESPONSE = ("response.csv", "response.png", "response.svg")
#: Files of a friction law.
LAW = ("law.png", "law.svg")
#: Files of laws that were fitted to shear tests.
LAW_FIT = (
    "law-fit.json",
    "law-fit.toml",
    *("strength.png", "strength.svg", "fall.png", "fall.svg"),
    *("report.pdf", "report.html"),
)
_TABLES = ("histories", "events", "crack", "table")
#: The dams of a table by their ranks.
PORTFOLIO = "portfolio.csv"
STUDY_REPORT = _REPORT = ("report.pdf", "report.html")


def names(*suffixes: str, report: bool = True) -> tuple[str, ...]:
    """Return the names of all files that a run may leave right in its directory, with these suffixes of tables."""
    return (
        "result.json",
        *(f"{name}{suffix}" for name in _TABLES for suffix in suffixes),
        *(f"{name}{suffix}" for name in NAMES for suffix in (".png", ".svg")),
        WORKBOOK,
        *(_REPORT if report else ()),
    )


def write_all(
    result: Response | SmallStudy,
    directory: Path,
    case: Case | None = None,
    units: str = "si",
    *,
    suffix: str = ".parquet",
    vtk: bool = False,
    figures: Mapping[str, Figure] | None = None,
    finish: Callable[[str, Figure], object] | None = None,
    report: Callable[[Path], object] | None = None,
) -> list[Path]:
    """Write a result with its histories and figures.

    Of a response ``result.json``, ``histories``, ``events`` (rigid) or ``crack`` (flexible) and the figures go right
    into the directory; what stands beside it goes into a directory named after its model, histories and figures of
    further cracks into one named after their place from the crest down, ``crack-1``. Of a table of runs
    ``result.json``, ``table`` and its figures. With the case there is a figure of the section, too. All is written
    aside first, so that a failure leaves nothing half-done; what an earlier run has left there is replaced or
    removed, and files that are not heeltoe's stay (:mod:`heeltoe.base.atomic_files`).

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
    finish
        Gets each figure that is written, with its name before.
    report
        Writes a report into a directory. An earlier report goes where this is given, and stays where it is not.

    Returns
    -------
    list of Path
        What was written; of the VTK files only those that list the others.

    Raises
    ------
    InputError
        Where the directory cannot be written or holds files of these names that are not heeltoe's, the units are
        unknown, or what VTK files need is not installed.
    """
    drawn = figures_of(result, case, units) if figures is None else figures
    if drawn:
        from heeltoe.views.figures.write import save_all

    def write(fresh: Path) -> None:
        _write(result, fresh, suffix, vtk)
        give_back()
        if drawn:
            save_all(drawn, fresh, finish)
            give_back()
        if report:
            report(fresh)

    own = (*names(".parquet", ".csv", report=report is not None), *VTK_FILES)
    return [path for path in write_whole(write, directory, own) if path.suffix != ".vtu"]


def write_overturning(overturning: OverturningMap, directory: Path) -> list[Path]:
    """Write a map as ``overturning.csv``, ``.png`` and ``.svg``, all of them or none, and return their paths.

    What a run has left in the directory stays, as does what is not heeltoe's.
    """
    from heeltoe.views.figures.runs import overturning_figure

    figures = {"overturning": overturning_figure(overturning)}
    return _write_few(directory, figures, {"overturning.csv": overturning.to_table()})


def write_solved(solved: Solved, directory: Path, units: str = "si") -> list[Path]:
    """Write a field that was solved for as ``solve.json``, ``.csv``, ``.png`` and ``.svg``, all or none, and return
    their paths."""
    from heeltoe.views.content.solve import field_scale
    from heeltoe.views.figures.runs import solve_figure

    figures = {"solve": solve_figure(solved, field_scale(solved, units), units)}
    return _write_few(directory, figures, {"solve.csv": solved.to_table()}, {"solve.json": solved.to_json()}, SOLVED)


def write_amplification(title: str, amplification: Amplification, directory: Path) -> list[Path]:
    """Write the response of a crest as ``response.csv``, ``.png`` and ``.svg``, all or none, and return their paths."""
    from heeltoe.views.figures.amplification import amplification_figure

    figures = {"response": amplification_figure(title, amplification)}
    return _write_few(directory, figures, {"response.csv": amplification.to_table()})


def write_law(curves: Mapping[str, LawCurve], directory: Path) -> list[Path]:
    """Write the curves of friction laws by their names as PNG and SVG, all or none, and return their paths."""
    from heeltoe.views.figures.law import law_figure

    return _write_few(directory, {name: law_figure(curve) for name, curve in curves.items()})


def write_law_fits(
    fits: LawFits,
    tests: Sequence[ShearTest],
    title: str,
    directory: Path,
    units: str = "si",
    *,
    report: Callable[[Path, Mapping[str, Figure]], None] | None = None,
) -> list[Path]:
    """Write laws fitted to shear tests as ``law-fit.json``, the block of a case as ``law-fit.toml``, figures of the
    strength and of a fall, and what `report` writes with them, all or none, and return their paths."""
    from heeltoe.views.figures.law import fall_figure, law_fit_figure
    from heeltoe.views.figures.write import save_all

    drawn = {
        "strength": law_fit_figure(fits, tests, title, units),
        "fall": fall_figure(fits, tests, title, units),
    }
    figures = {name: figure for name, figure in drawn.items() if figure is not None}

    def write(fresh: Path) -> None:
        write_json(fits.to_json(), fresh / LAW_FIT[0])
        (fresh / LAW_FIT[1]).write_text(fits.crack, encoding="utf-8")
        save_all(figures, fresh)
        if report is not None:
            report(fresh, figures)

    return write_whole(write, directory, LAW_FIT)


def _write_few(
    directory: Path,
    figures: Mapping[str, Figure],
    tables: Mapping[str, pa.Table] | None = None,
    results: Mapping[str, Mapping[str, Any]] | None = None,
    own: Sequence[str] = (),
) -> list[Path]:
    """Write figures, tables and JSON by their names, all or none; files of an earlier run that match `own` go."""

    from heeltoe.views.figures.write import save_all

    def write(fresh: Path) -> None:
        for name, data in (results or {}).items():
            write_json(data, fresh / name)
        for name, table in (tables or {}).items():
            write_table(table, fresh / name)
        save_all(figures, fresh)

    return write_whole(write, directory, own)


def write_study(
    study: StudyResults,
    directory: Path,
    units: str = "si",
    *,
    figures: bool = True,
    report: Callable[[Path, Mapping[str, Figure]], None] | None = None,
    workbook: bool = False,
) -> list[Path]:
    """Write the figures of a study into ``figures/`` of its directory, and its report beside them, those of an earlier
    time gone, and return their paths; its runs do not change. The ranks of a table of dams go into
    ``portfolio.csv``.

    Parameters
    ----------
    study, directory
        The study, and where it is.
    units
        Of the figures, ``"si"`` or ``"us"``.
    figures
        Whether they are written.
    report
        Writes a report into a directory, given the figures; None for none.
    workbook
        Whether its tables go into ``workbook.xlsx``, too.
    """

    from heeltoe.views.figures.studies.all import study_figures
    from heeltoe.views.figures.write import save_all

    def write(fresh: Path) -> None:
        drawn = study_figures(study, units) if figures or report is not None else {}
        if study.portfolio is not None:
            write_table(study.portfolio_table(), fresh / PORTFOLIO)
        if figures:
            (fresh / "figures").mkdir()
            save_all(drawn, fresh / "figures")
        if workbook:
            from heeltoe.views.files.workbook import fill_workbook

            fill_workbook(study, fresh / WORKBOOK)
        if report is not None:
            report(fresh, drawn)

    if not figures and report is None and study.portfolio is None and not workbook:
        return []
    own = (PORTFOLIO, WORKBOOK, *(("*.png", "*.svg") if figures else ()), *(STUDY_REPORT if report is not None else ()))
    return write_whole(write, directory, own)


def figures_of(result: Response | SmallStudy, case: Case | None, units: str) -> Mapping[str, Figure]:
    """Return the figures of a result."""
    if isinstance(result, Response):
        from heeltoe.views.figures.all import all_figures

        return all_figures(case, result, units)
    from heeltoe.views.figures.runs import small_figures

    return small_figures(result, units)


def _write(result: Response | SmallStudy, directory: Path, suffix: str, vtk: bool) -> None:
    """Write JSON and tables of a result."""
    if isinstance(result, Response):
        _write_response(result, directory, suffix, vtk)
    else:
        from heeltoe.views.files.statics import write_run_table

        write_run_table(result, directory)


def _write_response(response: Response, directory: Path, suffix: str, vtk: bool) -> None:
    write_json(response.to_json(), directory / "result.json")
    if response.beside is not None:
        (directory / response.beside.model).mkdir()
        _write_response(response.beside, directory / response.beside.model, suffix, vtk)
    if not response.histories:
        return
    write_table(response.to_table(), directory / f"histories{suffix}")
    if response.event_log:
        write_table(response.events_table(), directory / f"events{suffix}")
    for name, other in response.others.items():
        (directory / name).mkdir()
        write_table(other.to_table(), directory / name / f"histories{suffix}")
        if other.event_log:
            write_table(other.events_table(), directory / name / f"events{suffix}")
    from heeltoe.models.flexible.result.response import FlexibleResponse

    if not isinstance(response, FlexibleResponse):
        return
    from heeltoe.models.flexible.result.history import crack_table

    write_table(crack_table(response.crack), directory / f"crack{suffix}")
    for name, at_crack in response.others.items():
        write_table(crack_table(at_crack.crack), directory / name / f"crack{suffix}")
    if vtk:
        (directory / VTK).mkdir()
        from heeltoe.views.files.vtk import write_frames

        write_frames(response.crack, directory / VTK)
