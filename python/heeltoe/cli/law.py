"""The command that draws a friction law."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from heeltoe.base.atomic_files import check_directory
from heeltoe.cli.common import CaseUnits, Changes, JsonPath, check_json, check_units, finish, units_of
from heeltoe.errors.error import InputError


def law(
    name: Annotated[str, typer.Argument(metavar="NAME|CASE.toml", help="Name of a friction law, or a case file.")],
    set_: Changes = None,
    json_: JsonPath = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write the figure here.")] = None,
    units: CaseUnits = None,
) -> None:
    """Draw a friction law by name with sample numbers, or the laws of all cracks of a case."""
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
    data = first.to_json() | ({"others": [other.to_json() for other in others]} if others else {})

    def say(console: Console) -> None:
        for curve in curves.values():
            print_law(curve, console, shown)

    finish(data, json_, written, say)
