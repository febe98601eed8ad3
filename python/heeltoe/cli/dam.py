"""Commands about a dam beside running it: periods, overturning, animation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.base.atomic_files import check_directory, check_file
from heeltoe.cli.common import (
    LONGEST_PATH,
    NO_RESULT,
    CasePath,
    Changes,
    Details,
    JsonPath,
    OtherMotion,
    OtherPeak,
    OtherUnits,
    check_json,
    check_units,
    finish,
    motion_changes,
    say_cost,
    status,
    units_of,
)
from heeltoe.cli.streams import console
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain

if TYPE_CHECKING:
    from rich.console import Console


def periods(
    case: CasePath,
    count: Annotated[int, typer.Option(metavar="N", help="Number of periods of the dam and of its parts.")] = 5,
    response: Annotated[
        bool,
        typer.Option("--response", help="Print how the crest answers by frequency, with and without rock and water."),
    ] = False,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write the figure of the response here; needs --response.")
    ] = None,
    set_: Changes = None,
    json_: JsonPath = None,
    units: OtherUnits = None,
    details: Details = False,
) -> None:
    """Print the vibration periods of the intact dam and of the parts above and below its crack."""
    from heeltoe.case.read import read_case
    from heeltoe.models.flexible.body.periods import dam_periods
    from heeltoe.views.terminal.dam import about_dam, print_drawing, print_periods

    check_units(units)
    if out is not None and not response:
        raise InputError("needs-other", "--out", other="--response")
    loaded = read_case(case, list(set_ or []))
    check_json(json_)
    if out is not None:
        from heeltoe.views.files.write import RESPONSE

        check_directory(out, "--out", RESPONSE)
    from heeltoe.models.flexible.body.cost import building, parts_of, surroundings_of

    say_cost(building(parts_of(loaded), surroundings_of(loaded)))
    with status() as say:
        say("building the elastic parts")
        periods = dam_periods(loaded, count, response=response, field="--count")
    shown = units_of(loaded, units)
    dam = about_dam(loaded, shown)
    written: list[Path] = []
    if out is not None and periods.amplification is not None:
        from heeltoe.views.files.write import write_amplification

        written = write_amplification(periods.title, periods.amplification, out)

    def show(console: Console) -> None:
        print_periods(periods, console, dam, details=details, units=shown)
        print_drawing(loaded, console, shown)

    finish(periods.to_json, json_, written, show)


def overturning(
    case: CasePath,
    pulse: Annotated[str, typer.Option(metavar="sine|half-sine|cosine", help="Shape of the pulse.")] = "sine",
    count: Annotated[int, typer.Option(metavar="N", help="Number of frequencies and of amplitudes.")] = 60,
    set_: Changes = None,
    json_: JsonPath = None,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Write map and figure here.")] = Path("overturning"),
    units: OtherUnits = None,
) -> None:
    """Draw which pulses overturn the block, over frequency and amplitude, with the safe gap."""
    from heeltoe.case.read import read_case
    from heeltoe.study.small.overturning import map_cost, overturning_map
    from heeltoe.views.files.write import OVERTURNING, write_overturning
    from heeltoe.views.terminal.dam import about_dam, print_drawing, print_overturning

    check_units(units)
    loaded = read_case(case, list(set_ or []))
    check_directory(out, "--out", OVERTURNING)
    check_json(json_)
    say_cost(map_cost(count))
    with status() as say:
        say(f"running {count * count} pulses")
        overturning = overturning_map(loaded, pulse, count=count)
        written = write_overturning(overturning, out)
    in_units = units_of(loaded, units)

    def show(console: Console) -> None:
        print_overturning(overturning, console, about_dam(loaded, in_units))
        print_drawing(loaded, console, in_units)

    finish(overturning.to_json, json_, written, show)


def animate(
    case: CasePath,
    model: Annotated[str, typer.Option(metavar="auto|rigid|flexible|decoupled", help="Model of the dam.")] = "auto",
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FILE", help="Output file: .mp4, .gif or .html (default: CASE.animation.html)."),
    ] = None,
    to: Annotated[Path | None, typer.Option("--to", hidden=True, help="The older name of --out.")] = None,
    exaggerate: Annotated[str, typer.Option(metavar="N|auto", help="Magnify displacements N times.")] = "auto",
    fps: Annotated[float, typer.Option(hidden=True, help="Frames per second of a video.")] = 30.0,
    speed: Annotated[
        float, typer.Option(metavar="1.0", help="Playback speed, in seconds of the earthquake per second.")
    ] = 1.0,
    from_: Annotated[str, typer.Option("--from", metavar="0s", help="Time at which to start.")] = "0 s",
    until: Annotated[str | None, typer.Option(metavar="20s", help="Time at which to end.")] = None,
    motion: OtherMotion = None,
    pga: OtherPeak = None,
    set_: Changes = None,
    units: OtherUnits = None,
) -> None:
    """Animate the dam: a video, or a page that plays offline in any browser."""
    from time import perf_counter

    from heeltoe.case.read import read_case
    from heeltoe.models.run import AUTO, MODELS, earthquake, record_cost, run, wish_cost
    from heeltoe.units.parse import parse
    from heeltoe.views.animation.frames import shaken_sign
    from heeltoe.views.animation.write import animate as write_animation
    from heeltoe.views.animation.write import check_options, writing_cost

    if model not in (AUTO, *MODELS):
        raise InputError("not-a-choice", "--model", model, choices=f"{', '.join((AUTO, *MODELS))}")
    if out is not None and to is not None:
        raise InputError("fields-conflict", "--to", other="--out")
    place = out or to or Path(f"{Path(case).stem}.animation.html")
    many = None if exaggerate == "auto" else parse(exaggerate, "number", "--exaggerate")
    check_units(units)
    start = parse(from_, "duration", "--from")
    end = None if until is None else parse(until, "duration", "--until")
    check_options(place, exaggerate=many, frames_per_second=fps, speed=speed)
    check_file(place, "--out")
    loaded = read_case(case, [*(set_ or []), *motion_changes(motion, pga=pga)])
    say_cost(record_cost(loaded))
    drawing = writing_cost(place, earthquake(loaded).run_end if end is None else end - start, fps, speed)
    cost = wish_cost(loaded, model)
    say_cost(cost and cost + drawing)
    with status() as say:
        began = perf_counter()
        say("running")
        response = run(loaded, model)
        analysed = perf_counter()
        if response.histories:
            say("drawing")
            shown = loaded.with_({"units": units_of(loaded, units)})
            write_animation(
                shown, response, place, exaggerate=many, frames_per_second=fps, speed=speed, window=(start, end)
            )
        drawn = perf_counter()
    words = console()
    if response.histories:
        spent = f"analysis {analysed - began:.1f} s, writing {drawn - analysed:.1f} s"
        size = place.stat().st_size / 1e6 if place.is_file() else 0.0
        words.print(
            f"wrote {plain(place, LONGEST_PATH)} ({size:.1f} MB; {spent})",
            soft_wrap=True,
            markup=False,
        )
        words.print(f"It shows {shaken_sign(response)}.", soft_wrap=True, markup=False)
    if not response.ok:
        words.print(f"{response.outcome}: {response.advice}", soft_wrap=True, markup=False)
        raise typer.Exit(NO_RESULT)
