"""What the terminal shows of a study (rich)."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.markup import escape

from heeltoe.study.opened import Opened
from heeltoe.study.run import Outlook, Progress
from heeltoe.views.terminal.common import print_title, print_warnings, quiet_table
from heeltoe.views.terminal.study_answers import print_compared, print_hangs_on
from heeltoe.views.words.numbers import Amount, Cell, in_one_unit
from heeltoe.views.words.studies import ABOUT_CRACKS, limits_of, strength_scale


def duration(seconds: float) -> str:
    """Write a time as people say it."""
    if seconds == float("inf"):
        return "?"
    for most, unit, size in ((90.0, "s", 1.0), (5400.0, "min", 60.0), (172800.0, "h", 3600.0)):
        if seconds < most:
            return f"{seconds / size:.0f} {unit}" if seconds >= 1.0 else "less than 1 s"
    return f"{seconds / 86400.0:,.0f} days"


def outlook_text(expected: Outlook) -> str:
    """Say what a study will be."""
    plan = expected.plan
    dams, motions, strengths, models = plan.sizes
    parts = [counted(dams, "dam")]
    if plan.every and motions > 1:
        parts.append(f"{motions} motions")
    parts += [f"{strengths} strengths"] if strengths > 1 else []
    parts += [f"{models} models"] if models > 1 else []
    drawn = f"; of {len(plan.shakes)} motions, one each" if not plan.every and len(plan.shakes) > 1 else ""
    times = " x ".join(parts)
    how_long = duration(expected.seconds)
    about = how_long if how_long.startswith("less") else f"about {how_long}"
    return f"{plan.count:,} runs ({times}{drawn}), {about} on {expected.cores} cores"


def print_outlook(expected: Outlook, console: Console) -> None:
    """Print what a study will be."""
    console.print(escape(outlook_text(expected)), soft_wrap=True, highlight=False)


def progress_text(progress: Progress) -> str:
    """Say how far a study is, but for its share."""
    failed = f", {progress.failed:,} without a result" if progress.failed else ""
    return f"{progress.rate:,.0f} runs/s, {duration(progress.left)} left{failed}"


def print_study(found: Opened, console: Console, units: str = "si") -> None:
    """Print what a study says, lengths in the units ``"si"`` or ``"us"``."""
    print_title(found.title, "study", console)
    told = found.told["study"]
    by = f"{told['method']}, {counted(len(told['vary']), 'field')}, {counted(len(found.told['events']), 'event')}"
    console.print(escape(f"{found.store.count:,} runs; {by}"), style="dim", soft_wrap=True, highlight=False)
    if not found.complete:
        missing = len(found.store.missing())
        console.print(f"[yellow]warning[/yellow]  {missing} of {found.store.parts} parts are not there yet")
    console.print()
    table = quiet_table()
    table.add_column("", no_wrap=True)
    for each in found.summary:
        table.add_column(each["model"], justify="right", no_wrap=True)
    lines = zip(*map(_lines, found.summary), strict=True)
    for cells in in_one_unit([(said[0][0], *(cell for _, cell in said)) for said in lines], units):
        table.add_row(*cells)
    console.print(table)
    if found.walk.cracks > 1:
        console.print(escape(ABOUT_CRACKS), style="dim", highlight=False)
    for each in found.summary:
        others = [f"{name} {count:,}" for name, count in each["outcomes"].items() if name != "ok"]
        if others:
            console.print(escape(f"{each['model']}, runs that ended otherwise: {', '.join(others)}"), highlight=False)
        if each["slid_off"]:
            said = f"{each['model']}: {counted(each['slid_off'], 'run')} slid farther than the crack is long"
            console.print(f"[yellow]warning[/yellow]  {escape(said)}", highlight=False)
    if told["fragility"] is not None:
        _print_fragility(found.fragility, console, units)
    print_compared(found, console, units)
    print_hangs_on(found, console, units)
    if found.told.get("seconds"):
        parts = ", ".join(f"{name} {_seconds(taken)}" for name, taken in found.told["seconds"].items())
        console.print(f"time of the runs, all workers together: {parts}", style="dim", highlight=False)
    print_warnings(found.told["warnings"], console)


def _seconds(taken: float) -> str:
    return f"{taken:.2g} s" if taken < 10.0 else duration(taken)


def counted(count: int, what: str) -> str:
    """Write how many of something there are."""
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def _lines(each: dict[str, Any]) -> list[tuple[str, Cell]]:
    """Return what a summary says of one model, with labels."""
    lost = each["runs"] - sum(each["outcomes"].get(name, 0) for name in ("ok", "overturned"))
    lines: list[tuple[str, Cell]] = [
        ("runs", f"{each['runs']:,}"),
        ("without a result", f"{lost:,}"),
        ("that slide", f"{each['share_that_slides']:.1%}"),
    ]
    # Of one crack the numbers stand by themselves.
    for crack, numbers in enumerate(each.get("cracks", [each])):
        of = f"crack {crack + 1}, " if "cracks" in each else ""
        for name, label in (("residual_slip_m", "residual slip"), ("opening_upstream_m", "opening, upstream face")):
            values = numbers[name]
            for key, what in (("50%", "half stay below"), ("84%", "84 % stay below"), ("95%", "95 % stay below")):
                lines.append((f"{of}{label}: {what}", Amount(values[key], zero="0")))
            lines.append((f"{of}{label}: largest", Amount(values["largest"], zero="0")))
    modes = ("sliding", "slide_rocking", "drifting")
    for name in modes:
        share = each["dominant_mode"].get(name)
        lines.append((f"most of the slip by {name.replace('_', '-')}", "-" if share is None else f"{share:.1%}"))
    return lines


def _print_fragility(curves: list[dict[str, Any]], console: Console, units: str) -> None:
    if not curves:
        return
    measure = curves[0]["measure"]
    models = list(dict.fromkeys(each["model"] for each in curves))
    limits = limits_of([(each["limit"], each["value"]) for each in curves], units)
    for model in models:
        console.print()
        table = quiet_table()
        table.padding = (0, 2, 0, 0)
        exceeds = f"exceeds, {model}" if len(models) > 1 else "exceeds"
        for place, heading in enumerate((exceeds, f"median {measure}", "dispersion", "records", "other", "runs")):
            # Limits go into two lines, as there are, rather than any number is cut.
            table.add_column(heading, no_wrap=place > 0, justify="left" if place < 3 else "right")
        mine = [each for each in curves if each["model"] == model]
        for each in mine:
            if each["median"] is not None:
                table.add_row(limits[each["limit"], each["value"]], *_fragility(each, units))
        if table.row_count:
            console.print(table)
        of = f"{model}, " if len(models) > 1 else ""
        for each in mine:
            if each["median"] is None:
                what = limits[each["limit"], each["value"]]
                console.print(f"{of}{what}: {each['why']} ({each['exceeding']:,} of {each['runs']:,})", highlight=False)
    if all(each["median"] is None for each in curves):
        return
    said = [
        f"below each number what it lies within with {curves[0]['confidence']:.0%}, leaving out one event at a time"
    ]
    said.append(f"medians in {strength_scale(measure, units).unit}")
    said += ["* stronger or weaker than any motion here"] if not all(each["reached"] for each in curves) else []
    console.print("; ".join(said), style="dim", highlight=False)
    unknown = max(each["unknown"] for each in curves)
    if unknown:
        console.print(f"[yellow]warning[/yellow]  {counted(unknown, 'run')} without a result are behind no curve")


def _fragility(each: dict[str, Any], units: str) -> tuple[str, ...]:
    """Return what is said of a curve."""
    share = f"{each['exceeding'] / max(each['runs'], 1):.1%}"
    factor = strength_scale(each["measure"], units).factor
    median = _with(each["median"], each["median_interval"], factor, "" if each["reached"] else " *")
    dispersion = _with(each["dispersion"], each["dispersion_interval"])
    return median, dispersion, _part(each["record"]), _part(each["other"]), share


def _with(value: float, interval: tuple[float, float] | None, factor: float = 1.0, mark: str = "") -> str:
    """Write a number above what it lies within."""
    ends = "" if interval is None else f"\n[dim]{factor * interval[0]:.2g} to {factor * interval[1]:.2g}[/]"
    return f"{factor * value:.3g}{mark}{ends}"


def _part(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"
