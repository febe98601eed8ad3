"""The command that looks for the value of a field at which a limit is just met."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.base.atomic_files import check_directory
from heeltoe.cli.common import (
    NO_RESULT,
    CasePath,
    Changes,
    Details,
    JsonPath,
    OtherUnits,
    check_json,
    check_units,
    finish,
    say_cost,
    status,
    units_of,
)
from heeltoe.errors.error import InputError, shown

if TYPE_CHECKING:
    from rich.console import Console


def solve(
    case: CasePath,
    field: Annotated[str, typer.Argument(metavar="FIELD", help="Field to solve for, e.g. crack.friction.")],
    until: Annotated[
        str, typer.Option(metavar="'residual_slip = 150 mm'", help="The limit of the case that is to be just met.")
    ],
    between: Annotated[
        str | None, typer.Option(metavar="LOW,HIGH", help="Range to search (default: half to twice the value).")
    ] = None,
    model: Annotated[
        str, typer.Option(metavar="auto|rigid|decoupled|flexible", help="Model of the dam, as of run.")
    ] = "auto",
    set_: Changes = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write curve, table and JSON here.")] = None,
    units: OtherUnits = None,
    json_: JsonPath = None,
    details: Details = False,
) -> None:
    """Find the value of a field at which a limit is just met, by both signs of the motion."""
    from heeltoe.case.read import read_case
    from heeltoe.study.small.solve import search_cost
    from heeltoe.study.small.solve import solve as solve_case
    from heeltoe.views.files.write import SOLVED, write_solved
    from heeltoe.views.terminal.dam import print_drawing
    from heeltoe.views.terminal.small import print_solved

    check_units(units)
    check_json(json_)
    loaded = read_case(case, list(set_ or []))
    in_units = units_of(loaded, units)
    if out is not None:
        check_directory(out, "--out", SOLVED)
    ends = None if between is None else [part.strip() for part in between.split(",")]
    if ends is not None and len(ends) != 2:
        raise InputError(
            "wrong-quantity",
            "--between",
            shown(between),
            kind="a range, LOW,HIGH with the lower end first",
            example="0.6,1.2",
        )
    say_cost(search_cost(loaded, model))
    with status() as say:
        solution = solve_case(
            loaded, field, until, model=model, between=None if ends is None else (ends[0], ends[1]), progress=say
        )
        written = [] if out is None else write_solved(solution, out, in_units)

    def show(console: Console) -> None:
        print_solved(solution, console, in_units, details=details)
        print_drawing(loaded, console, in_units)

    finish(solution.to_json, json_, written, show)
    if not solution.crossings:
        raise typer.Exit(NO_RESULT)
