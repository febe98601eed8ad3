"""What the terminal shows of a run, whatever it is: a response, with one beside it or without, or a table of many."""

from __future__ import annotations

from functools import singledispatch

from rich.console import Console

from heeltoe.result.response import Response
from heeltoe.views.terminal.response import print_summary


@singledispatch
def show(result: object, console: Console, units: str = "si") -> None:
    """Print a result in units ``"si"`` or ``"us"``."""
    # Loaded when there is one to show: most commands end with a single response.
    from heeltoe.study.small import SmallStudy
    from heeltoe.views.terminal.small import print_small

    show.register(SmallStudy, print_small)
    if not isinstance(result, SmallStudy):
        raise TypeError(f"nothing shows a {type(result).__name__} on the terminal")
    show(result, console, units)


@show.register
def _(response: Response, console: Console, units: str = "si") -> None:
    if response.beside is None:
        print_summary(response, console, units)
        return
    # As above.
    from heeltoe.views.terminal.beside import print_side_by_side

    print_side_by_side(response, response.beside, console, units)
