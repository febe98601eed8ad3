"""The command that runs a case, once or as a table of runs."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer
from typer.core import TyperCommand

from heeltoe.cli.common import (
    NO_RESULT,
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
    from heeltoe.models.flexible.cost import Cost
    from heeltoe.result.response import Response
    from heeltoe.study.small import SmallStudy

#: Changes of fields, as options give them.
Given = Sequence[str | Mapping[str, Any]]


class Run(TyperCommand):
    """A command whose option ``--spread`` needs no value, which is empty then; typer itself knows no such option."""

    def parse_args(self, ctx: typer.Context, args: list[str]) -> list[str]:  # type: ignore[override]
        given = list(args)
        for place, argument in enumerate(args):
            if argument == "--":
                break
            following = args[place + 1] if place + 1 < len(args) else "--"
            if argument == "--spread" and (following.startswith("--") or following.endswith((".toml", ".json"))):
                given[place] = "--spread="
        return super().parse_args(ctx, given)


def run(
    case: CasePath,
    model: Annotated[
        str,
        typer.Option(
            metavar="auto|rigid|decoupled|flexible|both",
            help="What the dam is taken for; auto: elastic with a block beside it where the case gives a modulus.",
        ),
    ] = "auto",
    motion: Annotated[str | None, typer.Option(metavar="FILE-or-NAME", help="Another ground motion.")] = None,
    pga: Annotated[str | None, typer.Option(metavar="0.4g", help="Scale the motion to this peak.")] = None,
    reverse: Annotated[bool, typer.Option("--reverse", help="Turn the motion round.")] = False,
    duration: Annotated[str | None, typer.Option(metavar="30s", help="Length of the run.")] = None,
    set_: Changes = None,
    spread: Annotated[
        str | None,
        typer.Option(
            metavar="[N|none]",
            help="Run N times more, 11 if not said, the shaking scaled by 0.99 to 1.01: what the result hangs on. "
            "A report of a rigid or decoupled block has it without asking, but for none.",
        ),
    ] = None,
    json_: JsonPath = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write figures, histories and JSON here.")] = None,
    csv: Annotated[bool, typer.Option("--csv", help="Histories as CSV instead of Parquet.")] = False,
    vtk: Annotated[
        bool, typer.Option("--vtk", help="With --out: VTK files of the flexible model for ParaView.")
    ] = False,
    units: CaseUnits = None,
    output_step: Annotated[
        str | None,
        typer.Option(
            metavar="0.001s", help="Spacing of the histories; without it the record's own, 0.01 s if flexible."
        ),
    ] = None,
    evidence: Annotated[
        str | None,
        typer.Option(
            metavar="full|step|none",
            help="What the flexible model is compared with: another step and mesh and the shaking varied by 1 %, "
            "another step, or nothing.",
        ),
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PATH=V1,V2,...",
            help="A small study: every combination of the values of some fields, a list, or "
            "{from=V1,to=V2,count=N} and the other distributions of a study file.",
        ),
    ] = None,
    report: Annotated[
        bool,
        typer.Option(
            "--report",
            help="Write a report as PDF and HTML, into --out or a directory named by the case, with figures in "
            "the report.",
        ),
    ] = False,
) -> None:
    """Run a case and say what the dam does."""
    asked = _Asked(model, spread, json_, out, units, csv, vtk, vary, report)
    changes = list(set_ or [])
    options = (
        ("motion.file", motion and json.dumps(as_given(motion))),
        ("motion.pga", pga),
        ("motion.duration", duration),
        ("flexible.evidence", evidence),
    )
    changes += [f"{name}={value}" for name, value in options if value is not None]
    _run(case, changes, reverse, output_step, asked)


@dataclass(frozen=True)
class _Asked:
    """What is asked for beside the case, as it was typed."""

    model: str
    spread: str | None
    json: str | None
    out: Path | None
    units: str | None
    csv: bool
    vtk: bool
    vary: list[str] | None
    report: bool

    @property
    def suffix(self) -> str:
        """Of tables."""
        return ".csv" if self.csv else ".parquet"

    def check(self) -> None:
        """Refuse what cannot be, or does not go together, before anything is read."""
        from heeltoe.models.run import check_model

        check_model(self.model, "--model")
        check_units(self.units)
        if self.report:
            from heeltoe.views.report.write import check_packages

            check_packages()
        if self.vtk and self.out is None and not self.report:
            raise InputError("vtk-without-out", "--vtk")
        if self.vary:
            for option, given in (
                ("--vtk", self.vtk),
                ("--spread", self.spread is not None),
                ("--report", self.report),
            ):
                if given:
                    raise InputError("vary-option", option)

    def check_elastic(self, case: Case) -> None:
        """Refuse what shows elastic parts where there are none."""
        from heeltoe.models.run import models_of

        if self.vtk and "flexible" not in models_of(case, self.model)[0]:
            raise InputError("vtk-rigid", "--vtk")

    def runs(self) -> int | Literal["cheap"] | None:
        """Return how many runs with the shaking varied are asked for; a report has what costs little without asking."""
        if self.spread is None:
            return "cheap" if self.report else None
        if self.spread == "none":
            return None
        from heeltoe.study.spread import RUNS, check_runs

        return check_runs(self.spread or RUNS, "--spread")


def _run(path: str, changes: Given, reverse: bool, output_step: str | None, asked: _Asked) -> None:
    """Read the case with its changes, run it, write and show what is asked for."""
    from heeltoe.case.read import read_case
    from heeltoe.case.sequence import turned_round
    from heeltoe.units.parse import parse
    from heeltoe.views.terminal.show import show

    asked.check()
    runs = asked.runs()
    case = read_case(path, changes)
    if reverse and case.motion is not None:
        changes = [*changes, turned_round(case)]
        case = read_case(path, changes)
    asked.check_elastic(case)
    units = units_of(case, asked.units)
    step = None if output_step is None else parse(output_step, "duration", "--output-step")
    place = asked.out or (Path(f"{Path(path).stem}-report") if asked.report else None)
    if place is not None:
        from heeltoe.views.files.write import names

        check_directory(place, "--out", names(asked.suffix, report=asked.report))
    check_json(asked.json)
    with status() as say:
        result: Response | SmallStudy
        if asked.vary:
            result = _table(path, changes, asked, step, say)
        else:
            from heeltoe.study.analysis import analyse

            result = analyse(case, asked.model, output_step=step, spread=runs, say=say)
        # Files first: if they cannot be written that is all there is to say.
        earlier = [] if place is None else files(place)
        written = [] if place is None else _write(result, case, asked, place, say)
    removed = [] if place is None else [place / name for name in earlier if not (place / name).exists()]
    finish(result.to_json(), asked.json, written, lambda console: show(result, console, units), removed)
    if not result.ok:
        raise typer.Exit(NO_RESULT)


def _table(path: str, changes: Given, asked: _Asked, step: float | None, say: Callable[[str], None]) -> SmallStudy:
    """Run a table of runs."""
    from heeltoe.models.run import cost_of
    from heeltoe.models.run import run as run_model
    from heeltoe.study.small import parse_axes, run_small

    def run_one(each: Case) -> Response:
        return run_model(each, asked.model, output_step=step)

    def cost(each: Case) -> Cost | None:
        return cost_of(each, asked.model, step)

    def progress(done: int, of: int) -> None:
        say(f"running the {asked.model} model, {done} of {of} runs done")

    return run_small(path, changes, parse_axes(asked.vary or []), run_one, cost=cost, progress=progress)


def _write(
    result: Response | SmallStudy, case: Case, asked: _Asked, place: Path, say: Callable[[str], None]
) -> list[Path]:
    """Write files and report; what asks for a report alone has its figures in it."""
    from heeltoe.study.small import SmallStudy
    from heeltoe.views.files.write import figures_of, write_run

    say("writing")
    units = units_of(case, asked.units)
    figures = figures_of(result, case, units)

    def report(fresh: Path) -> None:
        if not asked.report or isinstance(result, SmallStudy):
            return
        from heeltoe.views.report.write import build_report, write_kinds

        say("writing the report")
        write_kinds(build_report(case, result, units=units, command=command_line(), figures=figures), fresh)

    shown = figures if asked.out else {}
    return write_run(result, place, shown, suffix=asked.suffix, vtk=asked.vtk, report=report)
