"""Many runs on the command line, a study or a suite of records (``heeltoe run CASE`` of a case with `[[motions]]`, or
with ``--motions``): they run, write, show, and say how to go on."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import typer

from heeltoe.base.atomic_files import check_directory
from heeltoe.cli.common import (
    LONGEST_PATH,
    NO_RESULT,
    check_json,
    command_line,
    finish,
    resolved_path,
    say_cost,
    say_file,
    study_bar,
    units_of,
)
from heeltoe.cli.streams import console
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

    from heeltoe.case.model import Case
    from heeltoe.cli.options import RunOptions
    from heeltoe.study.answers.study_results import StudyResults
    from heeltoe.study.run.run import Outlook, Progress


class Runner(Protocol):
    """A function that runs a study or a suite."""

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
    from heeltoe.views.files.names import WORKBOOK
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
    announced: list[Outlook] = []

    def announce(expected: Outlook) -> None:
        if not announced:
            say_cost(expected.cost)
        # A number that is estimated alone is none of the study.
        if announced or "flexible" not in expected.plan.study.model:
            print_outlook(expected, words)
        announced.append(expected)

    try:
        with study_bar() as progress:
            results = runner(progress=progress, before=announce)
    except KeyboardInterrupt:
        if place is not None:
            directory = plain(place, LONGEST_PATH)
            again = f"{output.again} --out {directory} --resume"
            print(f"heeltoe: finished runs are in {directory}; to continue: {again}", file=sys.stderr)
        raise

    def report(fresh: Path, drawn: Mapping[str, Figure]) -> None:
        write_study_report(results, fresh, base=output.base, units=units, command=command_line(), figures=drawn)

    written: list[Path] = []
    if place is not None:
        chosen = report if output.report else None
        written = write_study(results, place, units, figures=output.figures, report=chosen, workbook=output.xlsx)
    finish(results.to_json, output.json, [], lambda screen: print_study(results, screen, units, details=output.details))
    if place is not None:
        say_file("wrote", place, words)
        if output.figures:
            say_file("wrote", place / "figures", words)
        for file in written:
            if file.name in (*STUDY_REPORT, WORKBOOK):
                say_file("wrote", file, words)
    if not results.answered:
        raise typer.Exit(NO_RESULT)


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

    def options(self) -> dict[str, object]:
        """Return what needs a suite; one motion can be scaled to Sa, too."""
        return {f"--{name}": value for name, value in vars(self).items() if name not in ("motions", "sa")}

    def fields(self, pga: str | None) -> dict[str, Any]:
        """Return the fields of the block `[suite]` that are given."""
        sa, _, period = (self.sa or "").partition("@")
        return {
            "pga": pga,
            "sa": sa or None,
            "period": period or None,
            "match": self.match,
            "target": self.target,
            "judge": self.judge,
            "vertical": self.vertical or None,
        }


def run_suite_command(path: str, case: Case, pga: str | None, suite: Suite, request: RunOptions) -> None:
    """Run a suite, write and show it."""
    from heeltoe.study.run.suite import run_suite

    check_json(request.json)
    place = request.out or (Path(f"{Path(path).stem}-suite") if request.report else None)
    if suite.resume and place is None:
        raise InputError("needs-other", "--resume", other="--out DIR, the directory of the suite")
    motions = [resolved_path(name) for name in suite.motions] or None
    runner = partial(run_suite, case, motions, model=request.model, out=place, resume=suite.resume, **suite.fields(pga))
    output = Output(
        place,
        Path(path).parent,
        units_of(case, request.units),
        f"heeltoe run {plain(path, LONGEST_PATH)}{' ... --motions ...' if motions else ''}",
        request.json,
        request.details,
        request.report,
        request.xlsx,
    )
    run_many(runner, output)


def run_levels_command(case: Case, path: Path, suite: Suite, request: RunOptions) -> None:
    """Run a suite at each level of earthquake, and show a row for each; a report goes into --out."""
    from heeltoe.study.plan.levels import read_levels
    from heeltoe.study.run.levels import run_levels
    from heeltoe.views.terminal.levels import print_levels

    check_json(request.json)
    place = (request.out or Path(f"{path.stem}-report")) if request.report else None
    if place is not None:
        from heeltoe.views.report.write import check_packages

        check_packages()
        check_directory(place, "--out", ("report.pdf", "report.html"))
    levels = read_levels(path)
    motions = [resolved_path(name) for name in suite.motions] or None
    with study_bar() as progress:
        results = run_levels(case, levels, motions, model=request.model, progress=progress)
    units = units_of(case, request.units)
    written: list[Path] = []
    if place is not None:
        from heeltoe.views.content.levels import levels_document
        from heeltoe.views.report.write import write_document

        written = write_document(levels_document(case, results, units), place)
    finish(results.to_json, request.json, written, lambda screen: print_levels(results, screen, units))
    if any(check.value is None for level in results.levels for check in level.checks):
        raise typer.Exit(NO_RESULT)
