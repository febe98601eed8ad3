"""The command that draws a friction law, or fits laws to shear tests."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.base.atomic_files import check_directory
from heeltoe.cli.common import Changes, JsonPath, OtherUnits, check_json, check_units, finish, units_of
from heeltoe.errors.error import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console


def law(
    name: Annotated[
        str, typer.Argument(metavar="NAME|CASE.toml|fit", help="Name of a friction law, a case file, or fit.")
    ],
    tests: Annotated[
        str | None, typer.Argument(metavar="[TESTS.csv]", help="With fit: table of shear tests.", show_default=False)
    ] = None,
    set_: Changes = None,
    json_: JsonPath = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write the figure here.")] = None,
    report: Annotated[bool, typer.Option("--report", help="With fit and --out: a report as PDF and HTML.")] = False,
    units: OtherUnits = None,
) -> None:
    """Draw a friction law by name with sample numbers, or the laws of all cracks of a case; or fit laws to shear tests.

    `heeltoe law fit TESTS.csv` reads normal stress, peak and residual shear, or curves of shear over slip, with units
    in the headings, and prints a block for the case file.
    """
    from heeltoe.case.read import read_case
    from heeltoe.mechanics.law_curve import curves_of, sample_curve
    from heeltoe.views.terminal.law import print_law

    check_units(units)
    shown = units or "si"
    if name == "fit":
        _fit(tests, bool(set_), json_, out, shown, report=report)
        return
    if report:
        raise InputError("needs-other", "--report", other="the word fit")
    if tests is not None:
        raise InputError("needs-other", "TESTS.csv", other="the word fit before it")
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

    finish(lambda: data, json_, written, say)


def _fit(path: str | None, changed: bool, json_: str | None, out: Path | None, units: str, *, report: bool) -> None:
    """Fit laws to the shear tests of a table."""
    from heeltoe.mechanics.law_fit import fit_laws
    from heeltoe.mechanics.shear_tests import read_shear_tests
    from heeltoe.views.terminal.law_fit import print_law_fits

    if path is None:
        raise InputError("missing", "law fit TESTS.csv", remedy="write: heeltoe law fit TESTS.csv")
    if changed:
        raise InputError("needs-other", "--set", other="a case")
    if report and out is None:
        raise InputError("needs-other", "--report", other="--out")
    if report:
        from heeltoe.views.report.write import check_packages

        check_packages()
    check_json(json_)
    if out is not None:
        from heeltoe.views.files.write import LAW_FIT

        check_directory(out, "--out", LAW_FIT)
    tests = read_shear_tests(Path(path))
    fits, title = fit_laws(tests), Path(path).name
    written: list[Path] = []
    if out is not None:
        from heeltoe.views.content.law_fit import law_fit_document
        from heeltoe.views.files.write import write_law_fits
        from heeltoe.views.report.write import write_kinds

        def page(fresh: Path, figures: Mapping[str, Figure]) -> None:
            write_kinds(law_fit_document(fits, title, units, figures), fresh)

        written = write_law_fits(fits, tests, title, out, units, report=page if report else None)
    finish(fits.to_json, json_, written, lambda console: print_law_fits(fits, title, console, units))
