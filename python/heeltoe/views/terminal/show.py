"""A run of any kind on the terminal: a response, with one beside it or without, or a table of many."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Console

from heeltoe.case.model import Case
from heeltoe.result.response import Response
from heeltoe.views.terminal.response import print_response

if TYPE_CHECKING:
    from heeltoe.study.small.run_table import SmallStudy


def show(result: Response | SmallStudy, console: Console, units: str = "si", details: Case | None = None) -> None:
    """Print a result in units ``"si"`` or ``"us"``, short; in full with the case that it is of."""
    if isinstance(result, Response):
        print_response(result, console, units, details)
        return
    # Here, as tables need more libraries than a single run.
    from heeltoe.views.terminal.small import print_small

    print_small(result, console, units, details=details is not None)
