"""The files of the static checks: JSON, calculation sheets, checks, figures; all of them or none."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from matplotlib.figure import Figure

from heeltoe.base.atomic_files import write_whole
from heeltoe.models.statics.joints import Joints
from heeltoe.result.write import write_json, write_table
from heeltoe.study.small.run_table import SmallStudy
from heeltoe.study.small.statics import StaticsTable, statics_json
from heeltoe.views.figures.write import save_all
from heeltoe.views.files.names import WORKBOOK

_REPORT = ("report.pdf", "report.html")
_TABLES = ("result.json", "sheet.csv", "checks.csv", "table.csv", "table.parquet")
_FIGURES = tuple(
    f"{name}{suffix}" for name in ("section", "checks", "forces-*", "at-*-forces-*") for suffix in (".png", ".svg")
)
#: Names of all files that the static checks may leave.
OWN = (*_TABLES, *_FIGURES, *_REPORT, WORKBOOK)


def write_statics(
    joints: Joints,
    directory: Path,
    figures: Mapping[str, Figure],
    *,
    report: Callable[[Path], object] | None = None,
) -> list[Path]:
    """Write the checks as ``result.json``, every force of every load case as ``sheet.csv``, every check as
    ``checks.csv``, both with SI numbers, these figures, and what `report` writes into a directory.

    An earlier report goes where this is given, and stays where it is not.
    """

    import pyarrow as pa

    def write(fresh: Path) -> None:
        write_json(statics_json(joints), fresh / "result.json")
        write_table(pa.Table.from_pylist(list(force_rows(joints))), fresh / "sheet.csv")
        write_table(pa.Table.from_pylist(list(check_rows(joints))), fresh / "checks.csv")
        save_all(figures, fresh)
        if report is not None:
            report(fresh)

    own = OWN if report is not None else (*_TABLES, *_FIGURES, WORKBOOK)
    return write_whole(write, directory, own)


def write_statics_table(table: StaticsTable, directory: Path) -> list[Path]:
    """Write a table of static checks as :func:`write_run_table` does."""
    return write_whole(lambda fresh: write_run_table(table, fresh), directory, OWN)


def write_run_table(table: SmallStudy | StaticsTable, directory: Path) -> None:
    """Write a table of runs, or of static checks, as ``result.json``, ``table.csv`` and ``table.parquet``."""
    write_json(table.to_json(), directory / "result.json")
    for suffix in (".csv", ".parquet"):
        write_table(table.to_table(), directory / f"table{suffix}")


def force_rows(joints: Joints) -> Iterator[dict[str, object]]:
    """Return every force of every load case at every section."""
    for joint in joints.ranked:
        for load_case in joint.statics.to_json()["cases"]:
            for force in load_case["forces"]:
                yield {"elevation_m": joint.elevation_m, "load_case": load_case["name"], **force}


def check_rows(joints: Joints) -> Iterator[dict[str, object]]:
    """Return every check of every load case at every section."""
    for joint in joints.ranked:
        for check in joint.statics.checks:
            yield {"elevation_m": joint.elevation_m, **check.to_json()}
