"""The command that runs a case, once or as a table of runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperCommand

from heeltoe.base.atomic_files import check_directory, files
from heeltoe.cli.common import (
    NO_RESULT,
    CasePath,
    Changes,
    Details,
    JsonPath,
    MotionSource,
    OtherUnits,
    Peak,
    Workbook,
    check_json,
    command_line,
    finish,
    motion_changes,
    refuse,
    removed_files,
    say_cost,
    status,
    units_of,
)
from heeltoe.cli.many import Suite, run_levels_command, run_suite_command
from heeltoe.cli.options import RunOptions
from heeltoe.errors.error import InputError

if TYPE_CHECKING:
    from heeltoe.case.model import Case
    from heeltoe.models.cost import Cost
    from heeltoe.result.response import Response
    from heeltoe.study.small.run_table import SmallStudy

#: Changes of fields, as options give them.
FieldChanges = Sequence[str | Mapping[str, object]]


class Run(TyperCommand):
    """A command whose option ``--spread`` needs no value, which is empty then; typer itself has no optional values."""

    def parse_args(self, ctx: typer.Context, args: list[str]) -> list[str]:  # type: ignore[override]
        words = list(args)
        for place, argument in enumerate(args):
            if argument == "--":
                break
            following = args[place + 1] if place + 1 < len(args) else "--"
            if argument == "--spread" and (following.startswith("--") or following.endswith((".toml", ".json"))):
                words[place] = "--spread="
        return super().parse_args(ctx, words)


def run(
    case: CasePath,
    model: Annotated[
        str,
        typer.Option(
            metavar="auto|rigid|decoupled|flexible|both",
            help="Model of the dam; auto: elastic with a rigid block beside it if the case has a modulus.",
        ),
    ] = "auto",
    motion: MotionSource = None,
    pga: Peak = None,
    reverse: Annotated[bool, typer.Option("--reverse", help="Reverse the sign of all motions.")] = False,
    duration: Annotated[str | None, typer.Option(hidden=True, help="--set motion.duration=30s")] = None,
    set_: Changes = None,
    spread: Annotated[
        str | None,
        typer.Option(
            metavar="[N|none]",
            help="Repeat the run N times (default 11) with the shaking scaled by 0.99 to 1.01: the sensitivity of "
            "the result. Reports of rigid and decoupled models include it by default; use none to skip.",
        ),
    ] = None,
    json_: JsonPath = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write figures, histories and JSON here.")] = None,
    csv: Annotated[bool, typer.Option("--csv", help="Write histories as CSV instead of Parquet.")] = False,
    vtk: Annotated[
        bool, typer.Option("--vtk", help="With --out: VTK files of the flexible model for ParaView.")
    ] = False,
    units: OtherUnits = None,
    output_step: Annotated[
        str | None,
        typer.Option(
            metavar="0.001s",
            help="Time step of the histories (default: that of the record; 0.01 s for the flexible model).",
        ),
    ] = None,
    evidence: Annotated[
        str | None,
        typer.Option(hidden=True, help="--set flexible.evidence=none"),
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PATH=V1,V2,...",
            help="Run every combination of field values: a list, or "
            "{from=V1,to=V2,count=N} and the other distributions of a study file.",
        ),
    ] = None,
    report: Annotated[
        bool,
        typer.Option(
            "--report",
            help="Write a report with figures as PDF and HTML into --out, or into a directory named after the case.",
        ),
    ] = False,
    xlsx: Workbook = False,
    motions: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FOLDER|FILE",
            help="Run a suite: each record of a folder, or each file, with both signs; fields of [suite] say how "
            "(--set suite.judge=mean).",
        ),
    ] = None,
    sa: Annotated[
        str | None,
        typer.Option(
            metavar="0.5g[@0.3s]", help="Scale the motion, or each record of a suite, to Sa at a period (default: T1)."
        ),
    ] = None,
    match: Annotated[str | None, typer.Option(hidden=True, help="--set suite.match=en1998:0.3g,B")] = None,
    target: Annotated[str | None, typer.Option(hidden=True, help="--set suite.target=en1998:0.3g,B")] = None,
    judge: Annotated[str | None, typer.Option(hidden=True, help="--set suite.judge=mean")] = None,
    vertical: Annotated[bool, typer.Option("--vertical", hidden=True, help="--set suite.vertical=true")] = False,
    levels: Annotated[
        Path | None,
        typer.Option(metavar="LEVELS.toml", help="Run a suite at each level of earthquake of these criteria."),
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Continue a suite that was interrupted, in --out.")] = False,
    details: Details = False,
) -> None:
    """Run a case and print what the dam does."""
    from heeltoe.case.fields_file import read_fields
    from heeltoe.case.read import read_case

    suite = Suite(motions or [], sa, match, target, judge, vertical, resume)
    request = RunOptions(model, spread, json_, out, units, csv, vtk, vary, report, details, xlsx)
    request.check()
    changes: list[str | Mapping[str, Any]] = [*(set_ or [])]
    changes += [] if evidence is None else [f"flexible.evidence={evidence}"]
    of_one_run = {
        "--motion": motion,
        "--reverse": reverse,
        "--duration": duration,
        "--spread": spread,
        "--csv": csv,
        "--vtk": vtk,
        "--output-step": output_step,
        "--vary": vary,
    }
    if levels is not None:
        of_one_suite = {name: value for name, value in suite.options().items() if name != "--motions"}
        others = {"--pga": pga, "--sa": sa, "--xlsx": xlsx, "--out": None if report else out}
        refuse(of_one_run | others | of_one_suite, "a suite for each level", "; the file of the levels has it")
        run_levels_command(read_case(case, changes), levels, suite, request)
        return
    if motions or "motions" in read_fields(Path(case)):
        refuse(of_one_run, "a suite of records", " or --motions")
        run_suite_command(case, read_case(case, changes), pga, suite, request)
        return
    refuse(suite.options(), "a run of one motion", ", or add --motions FOLDER")
    changes += motion_changes(motion, pga=pga, duration=duration)
    if sa is not None:
        if pga is not None:
            raise InputError("fields-conflict", "--sa", other="--pga")
        changes = [*changes, _scaling_to_sa(read_case(case, changes), sa)]
    _run(case, changes, reverse, output_step, request)


def _run(path: str, changes: FieldChanges, reverse: bool, output_step: str | None, request: RunOptions) -> None:
    """Read the case with its changes, run it, write and show the results."""
    from heeltoe.case.read import read_case
    from heeltoe.units.parse import parse
    from heeltoe.views.terminal.show import show

    runs = request.runs()
    case = read_case(path, changes)
    if reverse and case.motion is not None:
        changes = [*changes, case.reversal()]
        case = read_case(path, changes)
    request.check_elastic(case)
    units = units_of(case, request.units)
    step = None if output_step is None else parse(output_step, "duration", "--output-step")
    place = request.out or (Path(f"{Path(path).stem}-report") if request.report else None)
    if place is not None:
        from heeltoe.views.files.write import names

        check_directory(place, "--out", names(request.suffix, report=request.report))
    check_json(request.json)
    from heeltoe.models.cost import writing_cost
    from heeltoe.models.run import record_cost, wish_cost

    say_cost(record_cost(case))
    with status() as say:
        result: Response | SmallStudy
        if request.vary:
            result = _table(path, changes, request, step, say)
        else:
            from heeltoe.study.small.analysis import analyse

            cost = wish_cost(case, request.model, step, runs if isinstance(runs, int) else 0)
            say_cost(cost and cost + writing_cost(files=place is not None, report=request.report))
            result = analyse(case, request.model, output_step=step, spread=runs, say=say)
        # Files first: if they cannot be written that is all there is to say.
        earlier = [] if place is None else files(place)
        written = [] if place is None else _write(result, case, request, place, say)
    details = case if request.details else None
    finish(
        result.to_json,
        request.json,
        written,
        lambda console: show(result, console, units, details),
        removed_files(place, earlier),
    )
    if not result.ok:
        raise typer.Exit(NO_RESULT)


def _scaling_to_sa(case: Case, sa: str) -> dict[str, object]:
    """Return the changes that scale the motion of a case to a spectral acceleration, as 0.5g@0.3s; without a period at
    the first one of the dam."""
    if case.motion is None:
        raise InputError("motion-missing", "motion")
    from heeltoe.units.parse import parse, parse_acceleration

    acceleration, at, period = sa.partition("@")
    if not at:
        if case.concrete.modulus is None:
            raise InputError("suite-no-period", "--sa", "T1")
        from heeltoe.models.flexible.surroundings.lowest_modes import first_period

        period = f"{first_period(case, '--sa'):.6g} s"
    parse_acceleration(acceleration, "--sa")
    if not 0.0 < parse(period, "duration", "--sa") <= 100.0:
        raise InputError("out-of-range", "--sa", period, bound="above 0 s, at most 100 s")
    steps = [step.model_dump(mode="json", exclude_unset=True) for step in case.motion.processing]
    steps.append({"step": "scale-to-spectrum", "period": period, "acceleration": acceleration})
    return {"motion.processing": steps, "motion.pga": None}


def _table(
    path: str, changes: FieldChanges, request: RunOptions, step: float | None, say: Callable[[str], None]
) -> SmallStudy:
    """Run a table of runs."""
    from heeltoe.models.run import cost_of, wish_cost
    from heeltoe.models.run import run as run_model
    from heeltoe.study.small.run_table import parse_axes, run_small, table_cost

    def run_one(varied: Case) -> Response:
        return run_model(varied, request.model, output_step=step)

    def cost(varied: Case) -> Cost | None:
        return cost_of(varied, request.model, step)

    def progress(done: int, of: int) -> None:
        say(f"running the {request.model} model, {done} of {of} runs done")

    axes = parse_axes(request.vary or [])
    say_cost(table_cost(path, changes, axes, lambda varied: wish_cost(varied, request.model, step)))
    return run_small(path, changes, axes, run_one, cost=cost, progress=progress)


def _write(
    result: Response | SmallStudy, case: Case, request: RunOptions, place: Path, say: Callable[[str], None]
) -> list[Path]:
    """Write files and report; what asks for a report alone has its figures in it."""
    from heeltoe.base.cache import forget_all
    from heeltoe.base.heap import give_back
    from heeltoe.result.response import Response
    from heeltoe.views.files.write import figures_of, write_all

    say("writing")
    # Figures need the room that the models have left.
    forget_all()
    give_back()
    units = units_of(case, request.units)
    ahead = None
    if request.report and isinstance(result, Response):
        from heeltoe.views.report.write import draw_ahead

        ahead = draw_ahead(case, result, units)
    figures = figures_of(result, case, units) if ahead is None else ahead.figures

    def report(fresh: Path) -> None:
        if request.xlsx:
            from heeltoe.views.files.names import WORKBOOK
            from heeltoe.views.files.workbook import fill_workbook

            fill_workbook(result, fresh / WORKBOOK)
        if not request.report or not isinstance(result, Response):
            return
        from heeltoe.views.report.write import build_report, write_kinds

        say("writing the report")
        built = build_report(case, result, units=units, command=command_line(), figures=figures, ahead=ahead)
        write_kinds(built, fresh)

    return write_all(
        result,
        place,
        figures=figures if request.out else {},
        finish=None if ahead is None else ahead.finish,
        suffix=request.suffix,
        vtk=request.vtk,
        report=report,
    )
