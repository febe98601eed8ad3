"""The command that runs a study."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.base.atomic_files import check_directory
from heeltoe.cli.common import (
    LONGEST_PATH,
    NO_RESULT,
    CaseUnits,
    Details,
    JsonPath,
    Workbook,
    check_json,
    check_units,
    command_line,
    finish,
    say_file,
    study_bar,
    units_of,
)
from heeltoe.cli.streams import console
from heeltoe.errors.sanitize import plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def study(
    file: Annotated[str, typer.Argument(metavar="STUDY.toml", help="The study file (TOML or JSON).")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Directory of the runs (default: named after the file).")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Continue a study that was interrupted.")] = False,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Dask scheduler whose workers do the runs (default: this machine)."),
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Print the number of runs and the expected time, and run nothing.")
    ] = False,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figures.")] = False,
    report: Annotated[
        bool, typer.Option("--report", help="Write a report as PDF and HTML into the directory of the runs.")
    ] = False,
    xlsx: Workbook = False,
    units: CaseUnits = None,
    json_: JsonPath = None,
    details: Details = False,
) -> None:
    """Run a study: many dams, many earthquakes, one table."""
    from heeltoe.case.read import read_case
    from heeltoe.study.plan.file import read_study
    from heeltoe.study.plan.plan import plan_of
    from heeltoe.study.run.run import outlook, run_study
    from heeltoe.views.files.statics import WORKBOOK
    from heeltoe.views.files.workbook import check_workbook
    from heeltoe.views.files.write import STUDY_REPORT, write_study
    from heeltoe.views.report.write import check_packages, write_study_report
    from heeltoe.views.terminal.study import print_outlook, print_study

    check_json(json_)
    check_units(units)
    words = console(stderr=True)
    read = read_study(file)
    if dry_run:
        expected = outlook(plan_of(read), os.cpu_count() or 1)
        print_outlook(expected, words)
        if json_ is not None:
            finish(expected.to_json(), json_, [], lambda console: None)
        return
    place = out or Path(f"{Path(file).stem}-study")
    if xlsx:
        check_workbook()
    if report:
        check_packages()
        check_directory(place, "--out", STUDY_REPORT)
    try:
        with study_bar() as progress:
            results = run_study(
                read,
                place,
                resume=resume,
                scheduler=scheduler,
                progress=progress,
                before=lambda expected: print_outlook(expected, words),
            )
    except KeyboardInterrupt:
        again = f"heeltoe study {plain(file, LONGEST_PATH)} --out {plain(place, LONGEST_PATH)} --resume"
        print(f"heeltoe: what is done stays in {plain(place, LONGEST_PATH)}; go on by: {again}", file=sys.stderr)
        raise

    in_units = units_of(read_case(read.directory / read.case), units)

    def reported(fresh: Path, drawn: Mapping[str, Figure]) -> None:
        base = (read.directory / read.case).parent
        write_study_report(results, fresh, base=base, units=in_units, command=command_line(), figures=drawn)

    written = write_study(
        results, place, in_units, figures=not no_figures, report=reported if report else None, workbook=xlsx
    )
    finish(results.to_json(), json_, [], lambda console: print_study(results, console, in_units, details=details))
    say_file("wrote", place, words)
    if not no_figures:
        say_file("wrote", place / "figures", words)
    for path in written:
        if path.name in (*STUDY_REPORT, WORKBOOK):
            say_file("wrote", path, words)
    if not results.answered:
        raise typer.Exit(NO_RESULT)
