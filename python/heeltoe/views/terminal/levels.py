"""Criteria by level in the terminal: a row for each level, and the limits that are not met."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Console

from heeltoe.views.content.levels import HEAD, check_line, level_row, levels_verdict, too_few
from heeltoe.views.terminal.screen import print_items, print_title, quiet_table, safe

if TYPE_CHECKING:
    from heeltoe.study.run.levels import LevelResults


def print_levels(results: LevelResults, console: Console, units: str = "si") -> None:
    """Print a row for each level of earthquake."""
    print_title(results.title, f"{results.model} model, by level of earthquake", console)
    if results.criteria:
        console.print(safe(results.criteria), style="dim")
    console.print()
    table = quiet_table()
    for heading in HEAD:
        table.add_column(heading)
    for level in results.levels:
        *cells, _, met = level_row(level, units)
        lines = [check_line(check, units) for check in level.checks] or ["no limits"]
        table.add_row(*cells, "\n".join(lines), met if level.met else f"[red]{met}[/]")
    console.print(table)
    few = [too_few(level) for level in results.levels if not level.enough]
    if few:
        console.print()
        print_items(few, console)
    console.print()
    text = levels_verdict(results)
    console.print(text if results.met else f"[bold red]{text}[/]")
