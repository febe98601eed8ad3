"""Criteria by level: what the suite of each level comes to, in words, and the page of all levels."""

from __future__ import annotations

from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.kernel.build import build_info
from heeltoe.study.run.levels import LevelCheck, LevelResult, LevelResults
from heeltoe.units.sentences import counted
from heeltoe.units.write import measured
from heeltoe.views.content.input import named, revisions
from heeltoe.views.content.tree import Document, Notes, Table, paragraph, without_gaps

#: Columns of the table of levels.
HEAD = ("return period", "records", "judged", "result and limit", "met")


def levels_document(case: Case, results: LevelResults, units: str = "si") -> Document:
    """Return the page of a dam at every level of earthquake."""
    few = [too_few(level) for level in results.levels if not level.enough]
    rows = [tuple(level_row(level, units)) for level in results.levels]
    return Document(
        title=plain(results.title) or "Untitled case",
        subtitle=f"Criteria by level of earthquake, by the {results.model} model",
        footer=" · ".join([*named(case), f"heeltoe {build_info()['heeltoe']}", "criteria by level"]),
        blocks=without_gaps(
            revisions(case),
            paragraph(levels_verdict(results)),
            Table(HEAD, tuple(rows), plain(results.criteria), "rrlll"),
            Notes("warning", "Suites that are too small", tuple((text,) for text in few)) if few else None,
        ),
        about=tuple((label, plain(words)) for label, words in case.project.rows()),
    )


def levels_verdict(results: LevelResults) -> str:
    """Say whether all levels are met."""
    return "All levels are met." if results.met else "A level is not met."


def level_row(level: LevelResult, units: str) -> list[str]:
    """Return the cells of a level, below :data:`HEAD`."""
    lines = "; ".join(check_line(check, units) for check in level.checks) or "no limits"
    met = "yes" if level.met else "NO"
    return [f"{level.return_period_years:,g} years", str(level.records), level.judge, lines, met]


def check_line(check: LevelCheck, units: str) -> str:
    """Return a number of a level beside its limit."""
    bound = "at least" if not check.unit else "at most"
    value, allowed = (_shown(number, check.unit, units) for number in (check.value, check.allowed))
    return f"{check.label} {value}, {bound} {allowed}{'' if check.met else ': not met'}"


def too_few(level: LevelResult) -> str:
    """Say that a suite is too small."""
    needed = counted(level.records_needed, "earthquake")
    return f"{level.return_period_years:,g} years: the suite has {level.records}, the criteria ask for {needed}."


def _shown(value: float | None, unit: str, units: str) -> str:
    if value is None:
        return "none: the dam fails"
    return measured(value, unit, units) if unit else f"{value:.3g}"
