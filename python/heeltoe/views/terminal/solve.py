"""What the terminal shows of a field that was solved for."""

from __future__ import annotations

from rich.console import Console

from heeltoe.study.small.solve import Solved
from heeltoe.views.content.solve import solve_answer, solve_table
from heeltoe.views.terminal.render import print_title, render


def print_solved(solved: Solved, console: Console, units: str = "si", *, details: bool = False) -> None:
    """Print where the limit is just met; in detail the runs, too."""
    print_title(solved.title or "Untitled case", f"{solved.model} model", console)
    render(solve_answer(solved, units), console)
    if details:
        render((solve_table(solved, units),), console)
