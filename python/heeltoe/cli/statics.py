"""The command of the static checks."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.cli.common import (
    CasePath,
    CaseUnits,
    Changes,
    JsonPath,
    as_given,
    check_json,
    check_units,
    command_line,
    finish,
    status,
    units_of,
)
from heeltoe.errors import InputError
from heeltoe.whole import check_directory, files

if TYPE_CHECKING:
    from heeltoe.case.model import Case
    from heeltoe.models.statics.joints import Joints
    from heeltoe.study.statics import After, StaticsTable


def statics(
    case: CasePath,
    set_: Changes = None,
    criteria: Annotated[
        str | None,
        typer.Option(metavar="USACE|USBR|FERC|CDA|CADAM3D|FILE.toml", help="Whose required factors to judge by."),
    ] = None,
    slip: Annotated[
        str | None,
        typer.Option(metavar="0.15m", help="Residual slip of the post-seismic case; without it that of a run."),
    ] = None,
    model: Annotated[
        str | None,
        typer.Option(
            metavar="auto|rigid|decoupled|flexible", help="Whose run says that slip, whatever slip the case gives."
        ),
    ] = None,
    motion: Annotated[str | None, typer.Option(metavar="FILE-or-NAME", help="Another ground motion.")] = None,
    pga: Annotated[str | None, typer.Option(metavar="0.4g", help="Scale the motion to this peak.")] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(metavar="PATH=V1,V2,...", help="A table of every combination of values, as of `heeltoe run`."),
    ] = None,
    sheet: Annotated[bool, typer.Option("--sheet", help="Show the calculation sheet of each load case.")] = False,
    json_: JsonPath = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write figures, calculation sheets, checks and JSON here.")
    ] = None,
    report: Annotated[
        bool,
        typer.Option("--report", help="Write a report as PDF and HTML, into --out or a directory named by the case."),
    ] = False,
    every_section: Annotated[
        bool, typer.Option("--every-section", help="Figures of every section, not of the governing one alone.")
    ] = False,
    units: CaseUnits = None,
) -> None:
    """Judge the stability before, during (pseudo-static) and after the earthquake."""
    asked = _Asked(slip, model, motion, pga, vary or [], sheet, out, report, every_section)
    asked.check()
    check_units(units)
    changes = [*(set_ or []), *([] if criteria is None else [_judged_by(criteria)])]
    options = (("file", motion and json.dumps(as_given(motion))), ("pga", pga))
    changes += [f"motion.{name}={value}" for name, value in options if value is not None]
    _statics(case, changes, json_, units, asked)


def _judged_by(criteria: str) -> str:
    """Return the change of a case that asks for criteria by their name, or by a file relative to here."""
    if criteria.endswith(".toml"):
        return f"statics.criteria_file={json.dumps(as_given(criteria))}"
    return f"statics.criteria={criteria}"


@dataclass(frozen=True)
class _Asked:
    """What is asked for beside the case, as it was typed."""

    slip: str | None
    model: str | None
    motion: str | None
    pga: str | None
    vary: list[str]
    sheet: bool
    out: Path | None
    report: bool
    every_section: bool

    def check(self) -> None:
        """Refuse what cannot be, or does not go together, before anything is read."""
        if self.model is not None:
            from heeltoe.models.run import check_model

            check_model(self.model, "--model")
        for option, given in (("--model", self.model), ("--motion", self.motion), ("--pga", self.pga)):
            if self.slip is not None and given is not None:
                raise InputError("contradiction", "--slip", self.slip, other=f"{option} {given}")
        if self.report:
            from heeltoe.views.report.write import check_packages

            check_packages()
        if self.every_section and self.out is None and not self.report:
            raise InputError("needs-other", "--every-section", other="--out or --report")
        options = (("--report", self.report), ("--sheet", self.sheet), ("--every-section", self.every_section))
        for option, asked in options:
            if self.vary and asked:
                raise InputError("vary-option", option)

    def after(self) -> After:
        """Return where the slip of the post-seismic case comes from."""
        from heeltoe.models.run import AUTO
        from heeltoe.study.statics import After
        from heeltoe.units.parse import parse

        if self.slip is not None:
            return After(parse(self.slip, "length", "--slip"), "--slip")
        shaken = self.motion is not None or self.pga is not None
        return After(model=self.model or (AUTO if shaken else None))


def _statics(path: str, changes: list[str], json_: str | None, units: str | None, asked: _Asked) -> None:
    """Read the case with its changes, judge it, write and show what is asked for."""
    from heeltoe.case.read import read_case
    from heeltoe.study.small import parse_axes
    from heeltoe.study.statics import judge, statics_json, statics_table
    from heeltoe.views.terminal.statics import print_sections, print_statics_table

    loaded, after = read_case(path, changes), asked.after()
    shown = units_of(loaded, units)
    place = asked.out or (Path(f"{Path(path).stem}-statics") if asked.report else None)
    if place is not None:
        from heeltoe.views.files.statics import OWN

        check_directory(place, "--out", OWN)
    check_json(json_)
    earlier = [] if place is None else files(place)
    written: list[Path] = []
    with status() as say:
        if asked.vary:
            table = statics_table(path, changes, parse_axes(asked.vary), after, say)
            written = [] if place is None else _write(table, loaded, asked, place, shown, say)
        else:
            found = judge(loaded, after, say)
            written = [] if place is None else _write(found, loaded, asked, place, shown, say)
    removed = [] if place is None else [place / name for name in earlier if not (place / name).exists()]
    if asked.vary:
        finish(table.to_json(), json_, written, lambda console: print_statics_table(table, console, shown), removed)
    else:
        data = statics_json(found)
        finish(data, json_, written, lambda console: print_sections(found, console, shown, sheet=asked.sheet), removed)


def _write(
    found: Joints | StaticsTable, case: Case, asked: _Asked, place: Path, units: str, say: Callable[[str], None]
) -> list[Path]:
    """Write files and report; what asks for a report alone has its figures in it."""
    from heeltoe.study.statics import StaticsTable
    from heeltoe.views.figures.statics.all import statics_figures
    from heeltoe.views.files.statics import write_statics, write_statics_table

    say("writing")
    if isinstance(found, StaticsTable):
        return write_statics_table(found, place)
    figures = statics_figures(found, units, every=asked.every_section)

    def report(fresh: Path) -> None:
        from heeltoe.views.report.statics import statics_document
        from heeltoe.views.report.write import write_kinds

        say("writing the report")
        write_kinds(statics_document(case, found, figures, units=units, command=command_line()), fresh)

    return write_statics(found, place, figures if asked.out else {}, report=report if asked.report else None)
