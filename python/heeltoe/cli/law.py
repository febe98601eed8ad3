"""The command that draws a friction law."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from heeltoe.cli.common import CaseUnits, Changes, JsonPath, check_json, check_units, finish, units_of
from heeltoe.errors import InputError
from heeltoe.whole import check_directory


def law(
    name: Annotated[str, typer.Argument(metavar="NAME|CASE.toml", help="Name of a law, or a case.")],
    set_: Changes = None,
    json_: JsonPath = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write the figure here.")] = None,
    units: CaseUnits = None,
) -> None:
    """Draw a friction law: by its name with sample numbers, or those of the cracks of a case."""
    from heeltoe.case.read import read_case
    from heeltoe.mechanics.law_curve import curves_of, sample_curve
    from heeltoe.views.terminal.law import print_law

    check_units(units)
    shown = units or "si"
    if name.endswith(".toml"):
        loaded = read_case(name, list(set_ or []))
        curves, shown = curves_of(loaded), units_of(loaded, units)
    elif set_:
        raise InputError("needs-other", "--set", other="a case")
    else:
        curves = {"law": sample_curve(name)}
    check_json(json_)
    written: list[Path] = []
    if out is not None:
        from heeltoe.views.files.write import LAW, write_law

        check_directory(out, "--out", LAW)
        written = write_law(curves, out)
    first, *others = curves.values()
    told = first.to_json() | ({"others": [each.to_json() for each in others]} if others else {})

    def say(console: Console) -> None:
        for curve in curves.values():
            print_law(curve, console, shown)

    finish(told, json_, written, say)
