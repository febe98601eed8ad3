"""What the commands of many runs have in common: they run, write, show, and say how to go on."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import typer

from heeltoe.base.atomic_files import check_directory
from heeltoe.cli.common import LONGEST_PATH, NO_RESULT, command_line, finish, say_file, study_bar
from heeltoe.cli.streams import console
from heeltoe.errors.sanitize import plain

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

    from heeltoe.study.answers.study_results import StudyResults
    from heeltoe.study.run.run import Outlook, Progress


class Runner(Protocol):
    """What runs a study, or a suite."""

    def __call__(self, *, progress: Callable[[Progress], None], before: Callable[[Outlook], None]) -> StudyResults:
        """Return the results."""


@dataclass(frozen=True)
class Output:
    """Where the results of many runs go.

    Attributes
    ----------
    place
        Directory of the runs; None where nothing is kept.
    base
        Where relative paths of the case start.
    units
        In which everything is shown.
    again
        The command that goes on with runs that are interrupted, without its directory.
    json, details, report, xlsx, figures
        As the options say.
    """

    place: Path | None
    base: Path
    units: str
    again: str
    json: str | None
    details: bool
    report: bool
    xlsx: bool
    figures: bool = True


def run_many(runner: Runner, output: Output) -> None:
    """Run a study or a suite, write and show it."""
    from heeltoe.views.files.statics import WORKBOOK
    from heeltoe.views.files.workbook import check_workbook
    from heeltoe.views.files.write import STUDY_REPORT, write_study
    from heeltoe.views.report.write import check_packages, write_study_report
    from heeltoe.views.terminal.study import print_outlook, print_study

    place, units, words = output.place, output.units, console(stderr=True)
    if output.xlsx:
        check_workbook()
    if output.report and place is not None:
        check_packages()
        check_directory(place, "--out", STUDY_REPORT)
    try:
        with study_bar() as progress:
            results = runner(progress=progress, before=lambda expected: print_outlook(expected, words))
    except KeyboardInterrupt:
        if place is not None:
            directory = plain(place, LONGEST_PATH)
            again = f"{output.again} --out {directory} --resume"
            print(f"heeltoe: what is done stays in {directory}; go on by: {again}", file=sys.stderr)
        raise

    def report(fresh: Path, drawn: Mapping[str, Figure]) -> None:
        write_study_report(results, fresh, base=output.base, units=units, command=command_line(), figures=drawn)

    written: list[Path] = []
    if place is not None:
        chosen = report if output.report else None
        written = write_study(results, place, units, figures=output.figures, report=chosen, workbook=output.xlsx)
    finish(
        results.to_json(), output.json, [], lambda screen: print_study(results, screen, units, details=output.details)
    )
    if place is not None:
        say_file("wrote", place, words)
        if output.figures:
            say_file("wrote", place / "figures", words)
        for file in written:
            if file.name in (*STUDY_REPORT, WORKBOOK):
                say_file("wrote", file, words)
    if not results.answered:
        raise typer.Exit(NO_RESULT)
