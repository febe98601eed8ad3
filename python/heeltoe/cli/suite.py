"""A suite of records on the command line: ``heeltoe run CASE --motions FOLDER``."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from heeltoe.cli.common import (
    LONGEST_PATH,
    NO_RESULT,
    as_given,
    check_json,
    command_line,
    finish,
    say_file,
    study_bar,
    units_of,
)
from heeltoe.cli.streams import console
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from heeltoe.cli.run import Asked


@dataclass(frozen=True)
class Suite:
    """The options of a suite, as they were typed."""

    motions: Sequence[str]
    sa: str | None
    match: str | None
    target: str | None
    judge: str | None
    vertical: bool
    resume: bool

    def options(self) -> dict[str, Any]:
        """Return what needs a suite."""
        return {
            "--sa": self.sa,
            "--match": self.match,
            "--target": self.target,
            "--judge": self.judge,
            "--vertical": self.vertical,
            "--resume": self.resume,
        }


def refuse(options: Mapping[str, Any], code: str) -> None:
    """Refuse the first of some options that is there."""
    for option, value in options.items():
        if value:
            raise InputError(code, option)


def run_suite_command(
    path: str, changes: Sequence[str | Mapping[str, Any]], pga: str | None, suite: Suite, request: Asked
) -> None:
    """Run a suite, write and show it."""
    from heeltoe.case.read import read_case
    from heeltoe.study.run.suite import run_suite
    from heeltoe.views.files.statics import WORKBOOK
    from heeltoe.views.files.write import STUDY_REPORT, write_study
    from heeltoe.views.report.write import write_study_report
    from heeltoe.views.terminal.study import print_outlook, print_study

    request.check()
    case = read_case(path, changes)
    units = units_of(case, request.units)
    check_json(request.json)
    place = request.out or (Path(f"{Path(path).stem}-suite") if request.report else None)
    if suite.resume and place is None:
        raise InputError("suite-resume", "--resume")
    sa, _, period = (suite.sa or "").partition("@")
    words = console(stderr=True)
    try:
        with study_bar() as progress:
            found = run_suite(
                case,
                [as_given(name) for name in suite.motions],
                model=request.model,
                pga=pga,
                sa=sa or None,
                period=period or "T1",
                match=suite.match,
                target=suite.target,
                judge=suite.judge or "largest",
                vertical=suite.vertical,
                out=place,
                resume=suite.resume,
                progress=progress,
                before=lambda expected: print_outlook(expected, words),
            )
    except KeyboardInterrupt:
        if place is not None:
            print(f"heeltoe: what is done stays in {plain(place, LONGEST_PATH)}; go on by --resume", file=sys.stderr)
        raise

    def report(fresh: Path, drawn: Mapping[str, Figure]) -> None:
        base = Path(path).parent
        write_study_report(found, fresh, base=base, units=units, command=command_line(), figures=drawn)

    written = (
        []
        if place is None
        else write_study(found, place, units, report=report if request.report else None, workbook=request.xlsx)
    )
    finish(found.to_json(), request.json, [], lambda screen: print_study(found, screen, units, details=request.details))
    if place is not None:
        say_file("wrote", place, words)
        say_file("wrote", place / "figures", words)
        for file in written:
            if file.name in (*STUDY_REPORT, WORKBOOK):
                say_file("wrote", file, words)
    if not found.answered:
        raise typer.Exit(NO_RESULT)
