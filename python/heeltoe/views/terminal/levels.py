"""Criteria by level in the terminal: a row for each level, and the limits that are not met."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Console

from heeltoe.units.sentences import counted
from heeltoe.units.write import measured
from heeltoe.views.terminal.render import print_items, print_title, quiet_table, safe

if TYPE_CHECKING:
    from heeltoe.study.run.levels import LevelCheck, LevelResult, LevelResults


def print_levels(results: LevelResults, console: Console, units: str = "si") -> None:
    """Print a row for each level of earthquake."""
    print_title(results.title, f"{results.model} model, by level of earthquake", console)
    if results.criteria:
        console.print(safe(results.criteria), style="dim")
    console.print()
    table = quiet_table()
    for heading in ("return period", "records", "judged", "result and limit", "met"):
        table.add_column(heading)
    for level in results.levels:
        lines = [_line(check, units) for check in level.checks] or ["no limits"]
        met = "yes" if level.met else "[red]NO[/]"
        table.add_row(f"{level.return_period_years:,g} years", str(level.records), level.judge, "\n".join(lines), met)
    console.print(table)
    few = [_too_few(level) for level in results.levels if not level.enough]
    if few:
        console.print()
        print_items(few, console)
    console.print()
    console.print("All levels are met." if results.met else "[bold red]A level is not met.[/]")


def _line(check: LevelCheck, units: str) -> str:
    """Return a number of a level beside its limit."""
    bound = "at least" if not check.unit else "at most"
    value, allowed = (_shown(number, check.unit, units) for number in (check.value, check.allowed))
    return f"{check.label} {value}, {bound} {allowed}{'' if check.met else ': not met'}"


def _shown(value: float | None, unit: str, units: str) -> str:
    if value is None:
        return "none: the dam fails"
    return measured(value, unit, units) if unit else f"{value:.3g}"


def _too_few(level: LevelResult) -> str:
    """Say that a suite is too small."""
    needed = counted(level.records_needed, "earthquake")
    return f"{level.return_period_years:,g} years: the suite has {level.records}, the criteria ask for {needed}."
