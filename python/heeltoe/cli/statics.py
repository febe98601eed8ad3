"""The command of the static checks."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.base.atomic_files import check_directory, files
from heeltoe.cli.common import (
    CasePath,
    Changes,
    Details,
    JsonPath,
    OtherMotion,
    OtherPeak,
    OtherUnits,
    Workbook,
    check_json,
    check_units,
    check_written,
    command_line,
    finish,
    motion_changes,
    refuse,
    removed_files,
    resolved_path,
    say_cost,
    status,
    units_of,
)
from heeltoe.errors.error import InputError

if TYPE_CHECKING:
    from rich.console import Console

    from heeltoe.case.model import Case
    from heeltoe.models.statics.joints import Joints
    from heeltoe.study.small.statics import After, StaticsTable


def statics(
    case: CasePath,
    set_: Changes = None,
    criteria: Annotated[
        str | None,
        typer.Option(metavar="USACE|USBR|FERC|CDA|CADAM3D|FILE.toml", help="Criteria with the required factors."),
    ] = None,
    slip: Annotated[
        str | None,
        typer.Option(metavar="0.15m", help="Residual slip of the post-seismic case (default: computed by a run)."),
    ] = None,
    model: Annotated[
        str | None,
        typer.Option(
            metavar="auto|rigid|decoupled|flexible", help="Model used to compute the residual slip; overrides the case."
        ),
    ] = None,
    motion: OtherMotion = None,
    pga: OtherPeak = None,
    spectrum: Annotated[
        str | None,
        typer.Option(
            metavar="motion|SPECTRUM",
            help="Check an earthquake by its response spectrum, too, with two modes of the dam with water and "
            "rock: that of the case's motion, or a design spectrum, as heeltoe motion --match takes it.",
        ),
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(metavar="PATH=V1,V2,...", help="Check every combination of field values, as in `heeltoe run`."),
    ] = None,
    sheet: Annotated[bool, typer.Option("--sheet", help="Print the calculation sheet of every load case.")] = False,
    json_: JsonPath = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write figures, calculation sheets, checks and JSON here.")
    ] = None,
    report: Annotated[
        bool,
        typer.Option(
            "--report", help="Write a report as PDF and HTML into --out, or into a directory named after the case."
        ),
    ] = False,
    xlsx: Workbook = False,
    every_section: Annotated[
        bool, typer.Option("--every-section", hidden=True, help="Draw every section, not only the governing one.")
    ] = False,
    units: OtherUnits = None,
    details: Details = False,
) -> None:
    """Check the stability before, during (pseudo-static) and after the earthquake."""
    request = _Options(slip, model, motion, pga, vary or [], sheet, out, report, every_section, details, xlsx, spectrum)
    request.check()
    check_units(units)
    changes = [*(set_ or []), *([] if criteria is None else [_judged_by(criteria)]), *motion_changes(motion, pga=pga)]
    _statics(case, changes, json_, units, request)


def _judged_by(criteria: str) -> str:
    """Return the change of a case that asks for criteria by their name, or by a file relative to here."""
    if criteria.endswith(".toml"):
        return f"statics.criteria_file={json.dumps(resolved_path(criteria))}"
    return f"statics.criteria={criteria}"


@dataclass(frozen=True)
class _Options:
    """Options beside the case, as typed."""

    slip: str | None
    model: str | None
    motion: str | None
    pga: str | None
    vary: list[str]
    sheet: bool
    out: Path | None
    report: bool
    every_section: bool
    details: bool
    xlsx: bool
    spectrum: str | None

    def check(self) -> None:
        """Refuse what cannot be, or does not go together, before anything is read."""
        if self.model is not None:
            from heeltoe.models.run import check_model

            check_model(self.model, "--model")
        for option, option_value in (("--model", self.model), ("--motion", self.motion), ("--pga", self.pga)):
            if self.slip is not None and option_value is not None:
                raise InputError("contradiction", "--slip", self.slip, other=f"{option} {option_value}")
        check_written(self.out, report=self.report, xlsx=self.xlsx, others={"--every-section": self.every_section})
        if self.vary:
            options = {"--report": self.report, "--sheet": self.sheet}
            refuse(
                {**options, "--every-section": self.every_section, "--xlsx": self.xlsx}, "a table of runs", " or --vary"
            )

    def after(self) -> After:
        """Return where the slip of the post-seismic case comes from."""
        from heeltoe.models.run import AUTO
        from heeltoe.study.small.statics import After
        from heeltoe.units.parse import parse

        if self.slip is not None:
            return After(parse(self.slip, "length", "--slip"), "--slip")
        shaken = self.motion is not None or self.pga is not None
        return After(model=self.model or (AUTO if shaken else None))


def _statics(path: str, changes: list[str], json_: str | None, units: str | None, request: _Options) -> None:
    """Read the case with its changes, judge it, write and show the results."""
    from heeltoe.case.read import read_case
    from heeltoe.study.small.run_table import parse_axes, table_cost
    from heeltoe.study.small.statics import StaticsTable, judge, statics_cost, statics_json, statics_table
    from heeltoe.views.terminal.statics import print_sections, print_statics_table

    loaded, after = read_case(path, changes), request.after()
    shown = units_of(loaded, units)
    place = request.out or (Path(f"{Path(path).stem}-statics") if request.report else None)
    if place is not None:
        from heeltoe.views.files.statics import OWN

        check_directory(place, "--out", OWN)
    check_json(json_)
    earlier = [] if place is None else files(place)
    if not request.vary:
        say_cost(statics_cost(loaded, after))
    with status() as say:
        results: Joints | StaticsTable
        if request.vary:
            axes = parse_axes(request.vary)
            say_cost(table_cost(path, changes, axes, lambda varied: statics_cost(varied, after)))
            results = statics_table(path, changes, axes, after, say, spectrum=request.spectrum)
        else:
            results = judge(loaded, after, say, spectrum=request.spectrum)
        written = [] if place is None else _write(results, loaded, request, place, shown, say)

    def show(console: Console) -> None:
        if isinstance(results, StaticsTable):
            print_statics_table(results, console, shown)
        else:
            print_sections(results, console, shown, sheet=request.sheet, details=request.details)

    finish(
        lambda: results.to_json() if isinstance(results, StaticsTable) else statics_json(results),
        json_,
        written,
        show,
        removed_files(place, earlier),
    )


def _write(
    results: Joints | StaticsTable, case: Case, request: _Options, place: Path, units: str, say: Callable[[str], None]
) -> list[Path]:
    """Write files and report; what asks for a report alone has its figures in it."""
    from heeltoe.study.small.statics import StaticsTable
    from heeltoe.views.figures.statics.all import statics_figures
    from heeltoe.views.files.statics import write_statics, write_statics_table

    say("writing")
    if isinstance(results, StaticsTable):
        return write_statics_table(results, place)
    figures = statics_figures(results, units, every=request.every_section)

    def report(fresh: Path) -> None:
        if request.xlsx:
            from heeltoe.views.files.names import WORKBOOK
            from heeltoe.views.files.workbook import fill_workbook

            fill_workbook(results, fresh / WORKBOOK)
        if not request.report:
            return
        from heeltoe.views.content.statics import statics_document
        from heeltoe.views.report.write import write_kinds

        say("writing the report")
        write_kinds(statics_document(case, results, figures, units=units, command=command_line()), fresh)

    return write_statics(
        results, place, figures if request.out else {}, report=report if request.report or request.xlsx else None
    )
