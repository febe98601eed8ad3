"""A study on the terminal."""

from __future__ import annotations

from rich.console import Console
from rich.markup import escape

from heeltoe.study.answers.study_results import StudyResults
from heeltoe.study.run.run import Outlook, Progress
from heeltoe.units.sentences import counted
from heeltoe.views.content.study import study_answer, study_sections
from heeltoe.views.terminal.render import render
from heeltoe.views.terminal.screen import Screen, print_title, print_warnings


def duration(seconds: float) -> str:
    """Write a time in the unit in which it is read easily."""
    if seconds == float("inf"):
        return "?"
    for most, unit, size in ((90.0, "s", 1.0), (5400.0, "min", 60.0), (172800.0, "h", 3600.0)):
        if seconds < most:
            return f"{seconds / size:.0f} {unit}" if seconds >= 1.0 else "less than 1 s"
    return f"{seconds / 86400.0:,.0f} days"


def outlook_text(expected: Outlook) -> str:
    """Say how many runs a study has, and how long they take."""
    plan = expected.plan
    dams, motions, strengths, models = plan.sizes
    parts = [counted(dams, "dam")]
    if plan.every and motions > 1:
        parts.append(f"{motions} motions")
    parts += [f"{strengths} strengths"] if strengths > 1 else []
    parts += [f"{models} models"] if models > 1 else []
    drawn = f"; of {len(plan.shakes)} motions, one each" if not plan.every and len(plan.shakes) > 1 else ""
    times = " x ".join(parts)
    return f"{plan.count:,} runs ({times}{drawn}), {_about(expected.seconds)} on {expected.cores} cores"


def _about(seconds: float) -> str:
    text = duration(seconds)
    return text if text.startswith("less") else f"about {text}"


def print_outlook(expected: Outlook, console: Console) -> None:
    """Print how many runs a study has, and how long they take."""
    console.print(escape(outlook_text(expected)), soft_wrap=True, highlight=False)


def progress_text(progress: Progress) -> str:
    """Say how fast a study runs, and how long it still takes."""
    failed = f", {progress.failed:,} without a result" if progress.failed else ""
    rate = f"{progress.rate:,.0f} runs/s" if progress.rate >= 1.0 else f"{60.0 * progress.rate:.0f} runs/min"
    return f"{rate}, {_about(progress.left)} left{failed}"


def print_study(study: StudyResults, console: Console, units: str = "si", *, details: bool = False) -> None:
    """Print the answers of a study in sentences; in detail its tables, too. Lengths are in ``"si"`` or ``"us"``."""
    print_title(study.title, "study" if study.suite is None else "suite", console)
    plan = study.manifest["study"]
    events = counted(len(study.manifest["events"]), "event")
    # A suite, or several motions of one dam, vary no field.
    by = f"{plan['method']}, {counted(len(plan['vary']), 'field')}, {events}" if plan["vary"] else events
    console.print(escape(f"{study.store.count:,} runs; {by}"), style="dim", soft_wrap=True, highlight=False)
    render(study_answer(study, units), console)
    warnings = study.manifest["warnings"]
    if not details:
        Screen(console).add_warnings(warnings, "distributions, fragility, measures of strength and sensitivity")
        return
    render(study_sections(study, units), console)
    print_warnings(warnings, console)
