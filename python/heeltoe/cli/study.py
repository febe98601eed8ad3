"""The command that runs a study."""

from __future__ import annotations

import os
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from heeltoe.cli.common import (
    LONGEST_PATH,
    Details,
    JsonPath,
    OtherUnits,
    Workbook,
    check_json,
    check_units,
    finish,
    say_cost,
    units_of,
)
from heeltoe.cli.many import Output, run_many
from heeltoe.cli.streams import console
from heeltoe.errors.sanitize import plain


def study(
    file: Annotated[str, typer.Argument(metavar="STUDY.toml", help="The study file (TOML or JSON).")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Directory of the runs (default: named after the file).")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Continue a study that was interrupted.")] = False,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Dask scheduler whose workers do the runs (default: this machine)."),
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Print the number of runs and the expected time, and run nothing.")
    ] = False,
    no_figures: Annotated[bool, typer.Option("--no-figures", hidden=True, help="Write no figures.")] = False,
    report: Annotated[
        bool, typer.Option("--report", help="Write a report as PDF and HTML into the directory of the runs.")
    ] = False,
    xlsx: Workbook = False,
    units: OtherUnits = None,
    json_: JsonPath = None,
    details: Details = False,
) -> None:
    """Run a study: many dams, many earthquakes, one table."""
    from heeltoe.case.read import read_case
    from heeltoe.models.cost import Cost
    from heeltoe.study.plan.file import read_study
    from heeltoe.study.plan.plan import plan_of
    from heeltoe.study.run.run import estimated_outlook, outlook, run_study
    from heeltoe.views.terminal.study import print_outlook

    check_json(json_)
    check_units(units)
    read = read_study(file)
    if dry_run:
        plan, cores = plan_of(read), os.cpu_count() or 1
        roughly = estimated_outlook(plan, cores)
        # Two runs of elastic dams are tried, and more for five seconds.
        say_cost(Cost(2.0 * roughly.seconds_per_run, roughly.memory / cores))
        expected = outlook(plan, cores)
        print_outlook(expected, console(stderr=True))
        if json_ is not None:
            finish(expected.to_json, json_, [], lambda console: None)
        return
    place = out or Path(f"{Path(file).stem}-study")
    case = read.directory / read.case
    output = Output(
        place,
        case.parent,
        units_of(read_case(case), units),
        f"heeltoe study {plain(file, LONGEST_PATH)}",
        json_,
        details,
        report,
        xlsx,
        figures=not no_figures,
    )
    run_many(partial(run_study, read, place, resume=resume, scheduler=scheduler), output)
