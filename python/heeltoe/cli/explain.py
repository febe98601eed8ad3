"""The command that says what a name means."""

from __future__ import annotations

from typing import Annotated

import typer

from heeltoe.cli.common import JsonPath, check_json, finish


def explain(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME",
            help="A field (crack.friction), a block (uplift), a key of the JSON (residual_slip_m) or a column; "
            "all of them without it.",
        ),
    ] = None,
    json_: JsonPath = None,
) -> None:
    """Say what a field of a case or a study, a key of the JSON or a column of a table means."""
    from heeltoe.views.explain.find import everything
    from heeltoe.views.explain.find import explain as find
    from heeltoe.views.terminal.explain import as_json, print_list, print_meanings

    found = everything() if name is None else find(name)
    check_json(json_)
    show = print_list if name is None else print_meanings
    finish(as_json(found), json_, [], lambda console: show(found, console))
