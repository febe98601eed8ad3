"""The command that says what a name means."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.cli.common import JsonPath, check_json, finish

if TYPE_CHECKING:
    from rich.console import Console


def explain(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME",
            help="A field (crack.friction), a block (uplift), a key of the JSON (residual_slip_m) or a column; "
            "the subjects without it.",
        ),
    ] = None,
    all_: Annotated[
        bool, typer.Option("--all", help="List all names, a line each; with NAME, hidden fields too.")
    ] = False,
    json_: JsonPath = None,
    schema: Annotated[
        bool, typer.Option("--schema", help="Print the JSON schema of `heeltoe run --json`, with units and meanings.")
    ] = False,
) -> None:
    """Say what a field of a case or a study, a key of the JSON, a column of a table or an outcome means."""
    if schema:
        from heeltoe.result.schema import run_schema
        from heeltoe.result.write import json_text

        typer.echo(json_text(run_schema()))
        return
    from heeltoe.views.explain.find import everything
    from heeltoe.views.explain.find import explain as find
    from heeltoe.views.terminal.explain import as_json, print_list, print_meanings, print_subjects

    entry = everything() if name is None else find(name, all_=all_)
    check_json(json_)

    def show(console: Console) -> None:
        if name is not None:
            print_meanings(entry, console, all_=all_)
        elif all_:
            print_list(entry, console)
        else:
            print_subjects(entry, console)

    finish(lambda: as_json(entry), json_, [], show)
