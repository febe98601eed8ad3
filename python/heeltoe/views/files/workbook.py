"""Tables of a result as a workbook for spreadsheets: numbers with units and meanings, histories, static checks."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pyarrow as pa

from heeltoe.base.atomic_files import written
from heeltoe.errors.error import InputError
from heeltoe.models.statics.joints import Joints
from heeltoe.result.response import Response
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.study.small.run_table import SmallStudy
from heeltoe.study.small.statics import statics_json
from heeltoe.views.explain.keys import numbers_of_results, unit_of
from heeltoe.views.explain.result_keys import OF_A_RUN, OF_STATICS
from heeltoe.views.explain.study_keys import OF_OTHERS
from heeltoe.views.files.statics import check_rows, force_rows

# Rows of a sheet, its head among them, and letters of its name, which may not have these.
_MOST_ROWS, _LONGEST, _FORBIDDEN = 1_048_576, 31, re.compile(r"[\[\]:*?/\\]")
_WIDTHS = {"key": 44, "meaning": 80}
_NUMBERS = ("key", "value", "unit", "meaning")

Row = Sequence[Any]


def check_workbook(field: str = "--xlsx") -> None:
    """Refuse a workbook where the package that writes it is not installed.

    Raises
    ------
    InputError
        Then.
    """
    if find_spec("xlsxwriter") is None:
        raise InputError("package-missing", field, "xlsxwriter", install="pip install xlsxwriter")


def write_workbook(result: Response | SmallStudy | StudyResults | Joints, path: str | Path) -> Path:
    """Write the tables of a result as a workbook, SI, with the unit beside each number or in the head of its column.

    Parameters
    ----------
    result
        A run, a table of runs, a suite or a study, or static checks.
    path
        Where to; a file that is there is replaced.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        Where the package that writes it is not installed, or the file cannot be written.
    """
    check_workbook("path")
    place = Path(path)
    with written(place) as fresh:
        fill_workbook(result, fresh)
    return place


def fill_workbook(result: Response | SmallStudy | StudyResults | Joints, path: Path) -> None:
    """Write a workbook as :func:`write_workbook` into a directory that is written aside already."""
    _write(_sheets(result), path)


def _sheets(result: Response | SmallStudy | StudyResults | Joints) -> Iterator[tuple[str, Row, Iterator[Row]]]:
    """Return each sheet: its name, its head, and its rows."""
    if isinstance(result, Joints):
        yield "numbers", _NUMBERS, _numbers(statics_json(result))
        yield _of_table("loads", pa.Table.from_pylist(list(force_rows(result))))
        yield _of_table("checks", pa.Table.from_pylist(list(check_rows(result))))
        return
    yield "numbers", _NUMBERS, _numbers(result.to_json())
    if isinstance(result, SmallStudy | StudyResults):
        yield _of_table("runs", result.to_table())
    elif isinstance(result, Response):
        for response in result.responses:
            whose = "" if response is result else f" {response.model}"
            if not response.histories:
                continue
            yield _of_table(f"histories{whose}", response.to_table())
            if response.event_log:
                yield _of_table(f"events{whose}", response.events_table())
            for name, other in response.others.items():
                yield _of_table(f"{name}{whose}", other.to_table())


def _of_table(name: str, table: pa.Table) -> tuple[str, Row, Iterator[Row]]:
    """Return a table as a sheet, the units in its head."""
    head = [f"{column} [{unit}]" if (unit := unit_of(column)) else column for column in table.column_names]
    columns = [column.to_pylist() for column in table.columns]
    return name, head, zip(*columns, strict=True)


def _numbers(data: Mapping[str, Any]) -> Iterator[Row]:
    """Walk the numbers and words of a result: path, value, unit, meaning."""
    for path, value in _leaves(data, ""):
        plain = re.sub(r"\.\d+(?=\.|$)", "[]", path.removeprefix("beside."))
        unit, meaning = _meaning(plain)
        yield path, value, unit or unit_of(plain), meaning


def _leaves(value: Any, path: str) -> Iterator[tuple[str, Any]]:
    if isinstance(value, Mapping):
        for name, entry in value.items():
            yield from _leaves(entry, f"{path}.{name}" if path else str(name))
    elif isinstance(value, list | tuple):
        for place, entry in enumerate(value):
            yield from _leaves(entry, f"{path}.{place}")
    elif value is not None:
        yield path, value


@cache
def _known() -> dict[str, tuple[str, str]]:
    words = {name: ("", text) for keys in (OF_A_RUN, OF_STATICS, *OF_OTHERS.values()) for name, text in keys.items()}
    return words | {name: (number.unit, number.meaning) for name, number, _ in numbers_of_results()}


def _meaning(path: str) -> tuple[str, str]:
    """Return unit and meaning of a key; of a number of one of several cracks those of the number of one."""
    known = _known()
    parts = path.split(".")
    for name in (path, path.removeprefix("cracks[]."), ".".join([*parts[:-1], "*"]), path.removesuffix("[]")):
        if name in known:
            return known[name]
    return "", ""


def _write(sheets: Iterator[tuple[str, Row, Iterator[Row]]], path: Path) -> None:
    import xlsxwriter  # type: ignore[import-untyped]

    # Texts stay texts: nothing that people wrote becomes a formula or a link.
    options = {"strings_to_formulas": False, "strings_to_urls": False, "constant_memory": True}
    with xlsxwriter.Workbook(str(path), options) as book:
        bold = book.add_format({"bold": True, "bottom": 1})
        for name, head, rows in sheets:
            sheet = book.add_worksheet(_FORBIDDEN.sub(" ", name)[:_LONGEST])
            for place, title in enumerate(head):
                sheet.set_column(place, place, _WIDTHS.get(title, max(12, len(title) + 2)))
            sheet.freeze_panes(1, 0)
            sheet.write_row(0, 0, head, bold)
            for number, row in enumerate(rows, start=1):
                if number == _MOST_ROWS:
                    break
                sheet.write_row(number, 0, [_cell(value) for value in row])


def _cell(value: Any) -> Any:
    """Return what a cell holds: what is no number of a spreadsheet is empty."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if isinstance(value, int | str) or value is None else str(value)
