"""The command line. Results go to standard output, everything for people beside a result to standard error."""

from __future__ import annotations

import json
import shlex
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from typer.core import TyperCommand

from heeltoe.errors import InputError
from heeltoe.motion import STANDARD_GRAVITY, GroundMotion

if TYPE_CHECKING:
    from heeltoe.case import Case
    from heeltoe.comparison import Comparison
    from heeltoe.response import Response

app = typer.Typer(
    name="heeltoe",
    help="What a cracked concrete gravity dam does in an earthquake.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    rich_markup_mode=None,
)

# What --model takes; "both" is the rigid and the flexible one.
_MODELS = ("rigid", "decoupled", "flexible", "both", "rigid,flexible", "decoupled,flexible")

BAD_INPUT = 2
NO_RESULT = 3

CasePath = Annotated[str, typer.Argument(metavar="CASE.toml", help="The case file (TOML or JSON).")]
Changes = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="PATH=VALUE", help="Set any field of the case, e.g. crack.friction=1.0."),
]
JsonPath = Annotated[str | None, typer.Option("--json", metavar="FILE|-", help="Write the result as JSON.")]


def main() -> None:
    """Run the command line; input that cannot be used ends with one line and exit code 2."""
    try:
        app()
    except InputError as error:
        print(f"heeltoe: {error}", file=sys.stderr)
        sys.exit(BAD_INPUT)
    except BrokenPipeError:
        # The reader of our output has closed it, as `head` does; nothing is wrong.
        sys.stderr.close()
        sys.exit(0)


def _version(wanted: bool) -> None:
    if wanted:
        from heeltoe.response import build_info

        print(" ".join(f"{name} {version}" for name, version in build_info().items()))
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and leave.")
    ] = False,
) -> None:
    pass


class _Run(TyperCommand):
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


@app.command(cls=_Run)
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
            metavar="[N]",
            help="Run N times more, 11 if not said, the shaking scaled by 0.99 to 1.01: what the result hangs on.",
        ),
    ] = None,
    json_: JsonPath = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write figures, histories and JSON here.")] = None,
    csv: Annotated[bool, typer.Option("--csv", help="Histories as CSV instead of Parquet.")] = False,
    vtk: Annotated[
        bool, typer.Option("--vtk", help="With --out: VTK files of the flexible model for ParaView.")
    ] = False,
    units: Annotated[str, typer.Option(metavar="si|us", help="Units of figures and report.")] = "si",
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
        typer.Option("--report", help="Write a report as PDF and HTML, into --out or a directory named by the case."),
    ] = False,
) -> None:
    """Run a case and say what the dam does."""
    from heeltoe.case import read_case
    from heeltoe.quantities import parse

    if model not in _MODELS:
        raise InputError("unknown-model", "--model", model)
    if units not in ("si", "us"):
        raise InputError("unknown-units", "--units", units)
    if report:
        from heeltoe.report import check_packages

        check_packages()
        out = out or Path(f"{Path(case).stem}-report")
    if vtk and out is None:
        raise InputError("vtk-without-out", "--vtk")
    if vtk and model in ("rigid", "decoupled"):
        raise InputError("vtk-rigid", "--vtk")
    for option, given in (("--vtk", vtk), ("--spread", spread is not None), ("--report", report)):
        if vary and given:
            raise InputError("vary-option", option)
    if vary and model not in _MODELS[:3]:
        raise InputError("vary-option", "--model", model)
    runs = None
    if spread is not None:
        from heeltoe.spread import RUNS, check_runs

        runs = check_runs(spread or RUNS, "--spread")

    changes = list(set_ or [])
    options = (("file", motion and json.dumps(_as_given(motion))), ("pga", pga), ("duration", duration))
    changes += [f"motion.{name}={value}" for name, value in options if value is not None]
    loaded = read_case(case, changes)
    if reverse and loaded.motion is not None:
        changes.append(f"motion.reverse={'false' if loaded.motion.reverse else 'true'}")
        loaded = read_case(case, changes)
    step = None if output_step is None else parse(output_step, "duration", "--output-step")
    if out is not None:
        _check_directory(out)
    _check_json(json_)
    if vary:
        _vary(case, changes, vary, model, step, json_, out)
        return
    with _status() as say:
        result = _analysis(loaded, model, step, runs, say)
        # Files first: if they cannot be written that is all there is to say.
        written = []
        if out is not None:
            from heeltoe.outputs import write_all

            say("writing")
            suffix = ".csv" if csv else ".parquet"
            written = write_all(result, out, loaded, units, suffix=suffix, vtk=vtk)
            if report:
                from heeltoe.report import write_report

                say("writing the report")
                written += write_report(loaded, result, out, units=units, command=_command())
    _finish(result.to_json(), json_, written, lambda console: _print(result, console))
    if not result.ok:
        raise typer.Exit(NO_RESULT)


def _vary(
    case: str, changes: list[str], vary: list[str], model: str, step: float | None, json_: str | None, out: Path | None
) -> None:
    """Run a table of runs, show and write it."""
    from heeltoe.variation_summary import print_grid
    from heeltoe.variations import parse_variations, run_grid

    variations = parse_variations(vary)
    with _status() as say:

        def run_one(each: Case) -> Response:
            return _run_model(each, model, step)

        def told(done: int, of: int) -> None:
            say(f"running the {model} model, {done} of {of} runs done")

        grid = run_grid(case, changes, variations, run_one, told=told)
        written = []
        if out is not None:
            from heeltoe.outputs import write_all

            say("writing")
            written = write_all(grid, out)
    _finish(grid.to_json(), json_, written, lambda console: print_grid(grid, console))
    if not grid.ok:
        raise typer.Exit(NO_RESULT)


def _analysis(
    case: Case, model: str, step: float | None, runs: int | None, say: Callable[[str], None]
) -> Response | Comparison:
    """Run what is asked for; `say` is told what goes on."""
    result: Response | Comparison
    if model in _MODELS[:3]:
        say(f"running the {model} model")
        result = _run_model(case, model, step)
    else:
        from heeltoe.comparison import compare

        say("running both models")
        result = compare(case, output_step=step, block="decoupled" if model.startswith("decoupled") else "rigid")
    if runs is None:
        return result

    from heeltoe.comparison import Comparison
    from heeltoe.spread import with_spread

    def vary(response: Response) -> Response:
        def told(done: int, of: int) -> None:
            say(f"varying the shaking of the {response.model} model, {done} of {of} runs done")

        return with_spread(response, case, runs, told=told)

    return result.with_responses(vary) if isinstance(result, Comparison) else vary(result)


def _run_model(case: Case, model: str, step: float | None) -> Response:
    """Run one of the models; what another one needs is not loaded."""
    if model == "rigid":
        from heeltoe.rigid_model import rigid

        return rigid(case, output_step=step)
    if model == "decoupled":
        from heeltoe.decoupled_model import decoupled

        return decoupled(case, output_step=step)
    from heeltoe.flexible_model import flexible

    return flexible(case, output_step=step)


def _print(result: Response | Comparison, console: Console) -> None:
    from heeltoe.response import Response
    from heeltoe.summary import print_comparison, print_summary

    if isinstance(result, Response):
        print_summary(result, console)
    else:
        print_comparison(result, console)


@app.command()
def periods(
    case: CasePath,
    count: Annotated[int, typer.Option(metavar="N", help="How many of each.")] = 5,
    set_: Changes = None,
    json_: JsonPath = None,
) -> None:
    """Say in which periods the dam vibrates: intact, and the parts above and below its crack by themselves."""
    from heeltoe.case import read_case
    from heeltoe.dam_summary import print_periods
    from heeltoe.periods import dam_periods

    loaded = read_case(case, list(set_ or []))
    _check_json(json_)
    with _status() as say:
        say("building the elastic parts")
        found = dam_periods(loaded, count, field="--count")
    _finish(found.to_json(), json_, [], lambda console: print_periods(found, console))


@app.command()
def overturning(
    case: CasePath,
    pulse: Annotated[str, typer.Option(metavar="sine|half-sine|cosine", help="Shape of the pulse.")] = "sine",
    count: Annotated[int, typer.Option(metavar="N", help="How many frequencies, and how many amplitudes.")] = 60,
    set_: Changes = None,
    json_: JsonPath = None,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Write map and figure here.")] = Path("overturning"),
) -> None:
    """Draw which pulses overturn the block: a map over their frequency and amplitude, with the safe gap."""
    from heeltoe.case import read_case
    from heeltoe.dam_summary import print_overturning
    from heeltoe.overturning import overturning_map, write_overturning

    loaded = read_case(case, list(set_ or []))
    _check_directory(out)
    _check_json(json_)
    with _status() as say:
        say(f"running {count * count} pulses")
        found = overturning_map(loaded, pulse, count=count)
        written = write_overturning(found, out)
    _finish(found.to_json(), json_, written, lambda console: print_overturning(found, console))


@app.command()
def statics(
    case: CasePath,
    set_: Changes = None,
    criteria: Annotated[
        str | None, typer.Option(metavar="USACE|USBR|FERC|CDA", help="Whose required factors to judge by.")
    ] = None,
    slip: Annotated[
        str | None,
        typer.Option(metavar="0.15m", help="Residual slip of the post-seismic case; without it that of a rigid run."),
    ] = None,
    json_: JsonPath = None,
) -> None:
    """Judge the stability before, during (pseudo-static) and after the earthquake."""
    from heeltoe.case import read_case
    from heeltoe.quantities import parse
    from heeltoe.statics_model import statics as judge
    from heeltoe.statics_summary import print_statics

    changes = [*(set_ or []), *([] if criteria is None else [f"statics.criteria={criteria}"])]
    loaded = read_case(case, changes)
    _check_json(json_)
    with _status() as say:
        if slip is not None:
            found = judge(loaded, parse(slip, "length", "--slip"), slip_source="--slip")
        elif loaded.motion is not None and loaded.statics.residual_slip is None:
            from heeltoe.rigid_model import rigid

            say("running the rigid model")
            response = rigid(loaded)
            if response.outcome == "ok":
                source = f"rigid model, {response.motion.name}, PGA {response.motion.pga / response.gravity:.4g} g"
                found = judge(loaded, response.residual_slip_m, slip_source=source)
            else:
                found = judge(loaded, 0.0, slip_source=f"the rigid model ends {response.outcome!r}, zero is taken")
        else:
            found = judge(loaded)
    _finish(found.to_json(), json_, [], lambda console: print_statics(found, console))


@app.command()
def animate(
    case: CasePath,
    model: Annotated[
        str, typer.Option(metavar="rigid|flexible|decoupled", help="What the dam is taken for.")
    ] = "rigid",
    to: Annotated[
        Path | None, typer.Option(metavar="FILE", help="A .mp4, .gif or .html; CASE.animation.html here if not said.")
    ] = None,
    exaggerate: Annotated[
        str, typer.Option(metavar="N|auto", help="Draw displacements N times as far as they are.")
    ] = "auto",
    fps: Annotated[float, typer.Option(metavar="30", help="Pictures per second of a video.")] = 30.0,
    speed: Annotated[float, typer.Option(metavar="1.0", help="Seconds of the earthquake per second.")] = 1.0,
    from_: Annotated[str, typer.Option("--from", metavar="0s", help="Where to start.")] = "0 s",
    until: Annotated[str | None, typer.Option(metavar="20s", help="Where to end.")] = None,
    motion: Annotated[str | None, typer.Option(metavar="FILE-or-NAME", help="Another ground motion.")] = None,
    pga: Annotated[str | None, typer.Option(metavar="0.4g", help="Scale the motion to this peak.")] = None,
    set_: Changes = None,
) -> None:
    """Show what the dam does: a video, or a page that plays in any browser without a network."""
    from time import perf_counter

    from heeltoe.animation.write import animate as write_animation
    from heeltoe.animation.write import check_options
    from heeltoe.case import read_case
    from heeltoe.quantities import parse

    if model not in ("rigid", "flexible", "decoupled"):
        raise InputError("animation-model", "--model", model)
    place = to or Path(f"{Path(case).stem}.animation.html")
    many = None if exaggerate == "auto" else parse(exaggerate, "number", "--exaggerate")
    start = parse(from_, "duration", "--from")
    end = None if until is None else parse(until, "duration", "--until")
    check_options(place, exaggerate=many, frames_per_second=fps, speed=speed)
    if not place.absolute().parent.is_dir():
        raise InputError("no-directory", str(place.parent))
    changes = list(set_ or [])
    options = (("file", motion and json.dumps(_as_given(motion))), ("pga", pga))
    changes += [f"motion.{name}={value}" for name, value in options if value is not None]
    loaded = read_case(case, changes)
    with _status() as say:
        began = perf_counter()
        response = _one_response(loaded, model, say)
        analysed = perf_counter()
        if response.histories:
            say("drawing")
            write_animation(
                loaded, response, place, exaggerate=many, frames_per_second=fps, speed=speed, start=start, end=end
            )
        drawn = perf_counter()
    console = Console(highlight=False)
    if response.histories:
        spent = f"analysis {analysed - began:.1f} s, writing {drawn - analysed:.1f} s"
        console.print(f"wrote {place} ({place.stat().st_size / 1e6:.1f} MB; {spent})", soft_wrap=True, markup=False)
    if not response.ok:
        console.print(f"{response.outcome}: {response.advice}", soft_wrap=True, markup=False)
        raise typer.Exit(NO_RESULT)


def _one_response(case: Case, model: str, say: Callable[[str], None]) -> Response:
    """Run one model."""
    import heeltoe

    say(f"running the {model} model")
    found: Response = getattr(heeltoe, model)(case)
    return found


@app.command()
def motion(
    file: Annotated[str | None, typer.Argument(metavar="FILE-or-NAME")] = None,
    unit: Annotated[str | None, typer.Option(help="Unit of a file that does not state it: g, cm/s^2, ...")] = None,
    time_step: Annotated[str | None, typer.Option(metavar="0.01s", help="Of a file that does not state it.")] = None,
    channel: Annotated[str | None, typer.Option(help="Of a file of several: its number or direction.")] = None,
    figure: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="Where to draw it; NAME.motion.png here if not said.")
    ] = None,
    no_figure: Annotated[bool, typer.Option("--no-figure", help="Do not draw it.")] = False,
    list_: Annotated[bool, typer.Option("--list", help="List the records that can be used by name.")] = False,
) -> None:
    """Say what is in a record: peaks, measures, origin, warnings; and draw it."""
    from heeltoe.motion_summary import print_motion
    from heeltoe.records.catalog import available

    console = Console(highlight=False)
    if list_:
        for name, where in available():
            console.print(f"{name:40s} {where}", soft_wrap=True)
        return
    if file is None:
        raise InputError("record-missing", "FILE-or-NAME")
    motions = _motions(file, unit, time_step, channel)
    written = None
    if len(motions) == 1 and not no_figure:
        from heeltoe.motion_figure import write_motion_figure

        place = figure or Path(f"{_file_name(motions[0].name)}.motion.png")
        if place.suffix.lower() not in (".png", ".svg", ".pdf"):
            raise InputError("figure-format", "--figure", place)
        try:
            written = write_motion_figure(motions[0], STANDARD_GRAVITY, place)
        except OSError as error:
            raise InputError("cannot-write", "--figure", place, reason=error.strerror or error) from None
    for each in motions:
        print_motion(each, console)
        console.print()
    if written:
        console.print(f"  wrote {written}", soft_wrap=True)
    elif len(motions) > 1:
        console.print(f"{len(motions)} channels; --channel NUMBER shows and draws one", soft_wrap=True)


def _motions(file: str, unit: str | None, time_step: str | None, channel: str | None) -> list[GroundMotion]:
    """Read what is to be looked at: all channels of a file, the one wanted, or a motion made to order."""
    from heeltoe.quantities import parse
    from heeltoe.records import read_channels, read_record
    from heeltoe.records.catalog import find
    from heeltoe.scenario import PREFIX, synthetic

    if file.startswith(PREFIX):
        for option, value in (("--unit", unit), ("--time-step", time_step), ("--channel", channel)):
            if value is not None:
                raise InputError("synthetic-option", option)
        return [synthetic(file, field="FILE-or-NAME")]
    step = None if time_step is None else parse(time_step, "duration", "--time-step")
    path = find(file, Path.cwd(), field="FILE-or-NAME")
    if channel is None:
        return read_channels(path, unit=unit, time_step=step)
    return [read_record(path, channel, unit=unit, time_step=step, assume=True)]


def _file_name(name: str) -> str:
    """A motion's name without what file systems and shells do not like."""
    return "".join(c if c.isalnum() or c in "-_." else "-" for c in name)


@app.command()
def validate(
    name: Annotated[str | None, typer.Argument(help="One of the cases; all of them without it.")] = None,
) -> None:
    """Recompute the reference cases: reference, ours, deviation, verdict."""
    from heeltoe.validation import run_all

    if not run_all(name, Console(highlight=False)):
        raise typer.Exit(1)


@app.command()
def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the case; NAME.toml is written.")],
) -> None:
    """Write a commented case file to start from."""
    from heeltoe.new import new_case_text

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    if path.exists():
        raise InputError("file-exists", str(path))
    if not path.parent.is_dir():
        raise InputError("no-directory", str(path.parent))
    _replace(path, new_case_text(path.stem))
    print(f"wrote {path}; run it with: heeltoe run {path}")


def _command() -> str:
    """Return what was typed, for people who want to type it again."""
    return shlex.join(["heeltoe", *sys.argv[1:]])


def _as_given(motion: str) -> str:
    """A path on the command line is relative to where the user stands, not to the case file."""
    path = Path(motion).expanduser()
    return str(path.resolve()) if path.is_file() else motion


def _check_directory(directory: Path) -> None:
    """Refuse a directory that cannot be made, before anything is computed or printed."""
    for place in (directory, *directory.absolute().parents):
        if place.is_dir():
            return
        if place.exists():
            raise InputError("not-a-directory", "--out", place)


def _check_json(json_: str | None) -> None:
    """Refuse a place that JSON cannot be written to, before anything is computed or printed."""
    if json_ not in (None, "-") and not Path(str(json_)).absolute().parent.is_dir():
        raise InputError("no-directory", str(Path(str(json_)).parent))


def _finish(data: dict[str, Any], json_: str | None, written: list[Path], show: Callable[[Console], None]) -> None:
    """Write JSON where it is wanted, show the result, say what was written."""
    from heeltoe.response import json_text

    text = json_text(data)
    if json_ not in (None, "-"):
        written = [*written, _replace(Path(str(json_)), text + "\n")]
    console = Console(stderr=json_ == "-", highlight=False)
    show(console)
    for path in written:
        console.print(f"  wrote {path}", soft_wrap=True, markup=False)
    if json_ == "-":
        print(text)


@contextmanager
def _status() -> Iterator[Callable[[str], None]]:
    """Show a line that says what goes on and for how long, on a terminal; elsewhere nothing."""
    if not sys.stderr.isatty():
        yield lambda text: None
        return
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("reading")
        yield lambda text: bar.update(task, description=text)


def _replace(path: Path, text: str) -> Path:
    """Write a file whole or not at all."""
    try:
        with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as file:
            file.write(text)
        return Path(file.name).replace(path)
    except OSError as error:
        raise InputError("cannot-write", "file", path, reason=error.strerror or error) from None
