"""What the terminal shows of a sequence of motions (rich)."""

from __future__ import annotations

from rich.console import Console
from rich.markup import escape

from heeltoe.result.response import Response
from heeltoe.views.terminal.common import quiet_table
from heeltoe.views.words.sequence import COLUMNS, sequence_rows


def print_sequence(response: Response, console: Console, units: str) -> None:
    """Print what each motion does and leaves, where there are several."""
    if not response.sequence:
        return
    table = quiet_table()
    for place, name in enumerate(COLUMNS):
        table.add_column(name, justify="right" if place else "left")
    for row in sequence_rows(response, units):
        table.add_row(*map(escape, row))
    console.print()
    console.print(table)
