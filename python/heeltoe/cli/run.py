"""The command that runs a case, once or as a table of runs."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer
from typer.core import TyperCommand

from heeltoe.cli.common import (
    NO_RESULT,
    CasePath,
    Changes,
    JsonPath,
    UnitsName,
    as_given,
    check_directory,
    check_json,
    command_line,
    finish,
    status,
)
from heeltoe.errors import InputError
from heeltoe.units.systems import unit_system

if TYPE_CHECKING:
    from heeltoe.case.model import Case
    from heeltoe.result.response import Response
    from heeltoe.study.comparison import Comparison

R = TypeVar("R", bound="Response")

# What --model takes beside one model: the first is the rigid and the flexible one.
_BOTH = ("both", "rigid,flexible", "decoupled,flexible")


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
        str, typer.Option(metavar="rigid|decoupled|flexible|both", help="What the dam is taken for.")
    ] = "rigid",
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
    units: UnitsName = "si",
    output_step: Annotated[
        str | None,
        typer.Option(
            metavar="0.001s", help="Spacing of the histories; without it the record's own, 0.01 s if flexible."
        ),
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(metavar="PATH=V1,V2,...", help="A table of runs: every combination of the values of some fields."),
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
    from heeltoe.case.read import read_case
    from heeltoe.models.run import MODELS
    from heeltoe.units.parse import parse
    from heeltoe.views.terminal.show import show

    if model not in (*MODELS, *_BOTH):
        raise InputError(
            "unknown-model", "--model", model, models="rigid, decoupled, flexible, both or decoupled,flexible"
        )
    unit_system(units, "--units")
    if report:
        from heeltoe.views.report import check_packages

        check_packages()
    # What asks for a report alone gets its figures in it.
    figures = out is not None
    if report and out is None:
        out = Path(f"{Path(case).stem}-report")
    if vtk and out is None:
        raise InputError("vtk-without-out", "--vtk")
    if vtk and model in ("rigid", "decoupled"):
        raise InputError("vtk-rigid", "--vtk")
    for option, given in (("--vtk", vtk), ("--spread", spread is not None), ("--report", report)):
        if vary and given:
            raise InputError("vary-option", option)
    if vary and model in _BOTH:
        raise InputError("vary-option", "--model", model)
    runs = None
    if spread not in (None, "none"):
        from heeltoe.study.spread import RUNS, check_runs

        runs = check_runs(spread or RUNS, "--spread")

    changes = list(set_ or [])
    options = (("file", motion and json.dumps(as_given(motion))), ("pga", pga), ("duration", duration))
    changes += [f"motion.{name}={value}" for name, value in options if value is not None]
    loaded = read_case(case, changes)
    if reverse and loaded.motion is not None:
        changes.append(f"motion.reverse={'false' if loaded.motion.reverse else 'true'}")
        loaded = read_case(case, changes)
    step = None if output_step is None else parse(output_step, "duration", "--output-step")
    if out is not None:
        check_directory(out)
    check_json(json_)
    if vary:
        _vary(case, changes, vary, model, step, json_, out, units)
        return
    with status() as say:
        result = _analysis(loaded, model, step, runs, say)
        if report and spread is None:
            result = _with_cheap_spread(result, loaded, say)
        # Files first: if they cannot be written that is all there is to say.
        written = []
        if out is not None:
            from heeltoe.views.files.write import write_all

            say("writing")
            suffix = ".csv" if csv else ".parquet"
            written = write_all(result, out, loaded, units, suffix=suffix, vtk=vtk, figures=figures)
            if report:
                from heeltoe.views.report import write_report

                say("writing the report")
                written += write_report(loaded, result, out, units=units, command=command_line())
    finish(result.to_json(), json_, written, lambda console: show(result, console, units))
    if not result.ok:
        raise typer.Exit(NO_RESULT)


def _vary(
    case: str,
    changes: list[str],
    vary: list[str],
    model: str,
    step: float | None,
    json_: str | None,
    out: Path | None,
    units: str,
) -> None:
    """Run a table of runs, show and write it."""
    from heeltoe.models.run import run as run_model
    from heeltoe.study.grid import parse_variations, run_grid
    from heeltoe.views.terminal.show import show

    variations = parse_variations(vary)
    with status() as say:

        def run_one(each: Case) -> Response:
            return run_model(each, model, output_step=step)

        def progress(done: int, of: int) -> None:
            say(f"running the {model} model, {done} of {of} runs done")

        grid = run_grid(case, changes, variations, run_one, progress=progress)
        written = []
        if out is not None:
            from heeltoe.views.files.write import write_all

            say("writing")
            written = write_all(grid, out, units=units)
    finish(grid.to_json(), json_, written, lambda console: show(grid, console, units))
    if not grid.ok:
        raise typer.Exit(NO_RESULT)


def _analysis(
    case: Case, model: str, step: float | None, runs: int | None, say: Callable[[str], None]
) -> Response | Comparison:
    """Run what is asked for; `say` is told what goes on."""
    result: Response | Comparison
    if model in _BOTH:
        from heeltoe.study.comparison import compare

        say("running both models")
        result = compare(case, output_step=step, block="decoupled" if model.startswith("decoupled") else "rigid")
    else:
        from heeltoe.models.run import run as run_model

        say(f"running the {model} model")
        result = run_model(case, model, output_step=step)
    return result if runs is None else _with_spread(result, case, runs, say)


def _with_cheap_spread(result: Response | Comparison, case: Case, say: Callable[[str], None]) -> Response | Comparison:
    """Give a result the spread that costs milliseconds: that of a rigid block which stands, whatever shakes it."""
    from heeltoe.study.spread import RUNS

    return _with_spread(result, case, RUNS, say, lambda each: each.ok and not each.elastic)


def _with_spread(
    result: Response | Comparison,
    case: Case,
    runs: int,
    say: Callable[[str], None],
    wanted: Callable[[Response], bool] = lambda response: True,
) -> Response | Comparison:
    """Vary the shaking of the responses that are wanted."""
    from heeltoe.study.comparison import Comparison
    from heeltoe.study.spread import with_spread

    def vary(response: R) -> R:
        if not wanted(response):
            return response

        def progress(done: int, of: int) -> None:
            say(f"varying the shaking of the {response.model} model, {done} of {of} runs done")

        return with_spread(response, case, runs, progress=progress)

    return result.with_responses(vary) if isinstance(result, Comparison) else vary(result)
