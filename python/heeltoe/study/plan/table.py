"""A table of dams: one row a dam, fields by name with their units in the header, as CSV."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from heeltoe.base.input_files import read_csv_rows, reason_of
from heeltoe.case.model import Case
from heeltoe.case.paths import quantity_of
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import harmless
from heeltoe.study.plan.axes import Axis
from heeltoe.study.plan.problems import Problems
from heeltoe.units.parse import parse, plain_number

#: More dams than these are drawn, not listed.
MOST = 200_000
#: The column of the names.
NAME = "name"
# Bytes; a table of as many dams as may be has less.
_LARGEST = 64_000_000
_no_dams = partial(InputError, "empty", "cases", what="dams", expected="a header with fields, and a row for each dam")
_HEAD = re.compile(r"([^\[\]]+(?:\[\d+\][^\[\]]*)*?)\s*(?:\[([^\[\]]*)\])?\s*")


@dataclass(frozen=True, eq=False)
class DamTable:
    """Dams of a table.

    Attributes
    ----------
    names
        Of the dams; their numbers where the table has no column ``name``.
    axes
        The fields, each with a value for every dam.
    units
        Units of the header, by fields that hold no quantity; none should be there.
    """

    names: tuple[str, ...]
    axes: tuple[Axis, ...]
    units: Mapping[str, str]

    def check(self, case: Case) -> None:
        """Refuse dams that are no cases.

        Raises
        ------
        InputError
            Naming the row and the field of the first, with the others.
        """
        problems = Problems()
        for axis in self.axes:
            with problems:
                self._check_heading(axis, case)
        problems.tell()
        for row, name in enumerate(self.names):
            changes = {key: value for axis in self.axes for key, value in axis.changes(_at(axis, row)).items()}
            with problems:
                try:
                    case.with_(changes)
                except InputError as error:
                    for problem in (error, *error.others):
                        problem.field = f"cases: row {row + 1} ({harmless(name)}): {problem.field}"
                    raise
        problems.tell()

    def _check_heading(self, axis: Axis, case: Case) -> None:
        try:
            case.with_(axis.changes(_at(axis, 0)))
        except InputError as error:
            if error.code == "unknown-field":
                error.field = f"cases: {axis.path}"
                raise
        if axis.path in self.units:
            raise InputError("dams-unit", f"cases: {axis.path}", self.units[axis.path])


def _at(axis: Axis, row: int) -> Any:
    return axis.values[row] if axis.numbers is None else float(axis.numbers[row])


def read_table(path: Path) -> DamTable:
    """Read a table of dams.

    Raises
    ------
    InputError
        Where there is no such file, a column is no field, or a cell no value of it.
    """
    rows = _rows(path)
    if len(rows) < 2:
        raise _no_dams(shown(path.name))
    head, *dams = rows
    if len(dams) > MOST:
        raise InputError("too-many", "cases", f"{len(dams):,}", most=f"{MOST:,}")
    problems, axes, units = Problems(), list[Axis](), dict[str, str]()
    names = tuple(str(number + 1) for number in range(len(dams)))
    for number, dam in enumerate(dams):
        if len(dam) != len(head):
            with problems:
                raise InputError("row-length", f"cases: row {number + 1}", len(dam), count=len(head))
    problems.tell()
    if len(set(head)) < len(head):
        raise InputError("listed-twice", "cases", shown(head))
    for place, title in enumerate(head):
        cells = [dam[place] for dam in dams]
        if title.lower() in (NAME, "dam"):
            for number, cell in enumerate(cells):
                with problems:
                    if harmless(cell) != cell:
                        raise InputError("dams-letter", f"cases: row {number + 1}", shown(cell))
            names = tuple(cells)
            continue
        with problems:
            axis, unit = _axis(title, cells)
            axes.append(axis)
            if unit:
                units[axis.path] = unit
    problems.tell()
    if not axes:
        raise _no_dams(shown(path.name))
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError("dams-name", f"cases: row {names.index(twice) + 1}", shown(twice), count=names.count(twice))
    return DamTable(names, tuple(axes), units)


def _rows(path: Path) -> list[list[str]]:
    try:
        return read_csv_rows(path, _LARGEST)
    except FileNotFoundError:
        raise InputError(
            "file-missing", "cases", shown(str(path)), expected="a CSV file, relative to the study file"
        ) from None
    except (OSError, ValueError) as error:
        raise InputError(
            "file-unreadable", "cases", shown(str(path)), reason=reason_of(error), expected="a CSV file in UTF-8"
        ) from None


def _axis(title: str, cells: Sequence[str]) -> tuple[Axis, str]:
    """Return a column of the table, and the unit of one that holds no quantity, or is no field."""
    match = _HEAD.fullmatch(title)
    path, unit = (match[1].strip(), (match[2] or "").strip()) if match else (title, "")
    if re.split(r"[.\[]", path, maxsplit=1)[0] in ("motion", "aftershocks"):
        raise InputError("study-motion-varies", f"cases: {path}")
    quantity = quantity_of(path)
    if quantity is None:
        return Axis(path, None, tuple(cells), None), unit
    one, problems = parse(f"1 {unit}".strip(), quantity, f"cases: {path}"), Problems()
    numbers = np.zeros(len(cells))
    for row, cell in enumerate(cells):
        with problems:
            try:
                numbers[row] = plain_number(cell) * one
            except ValueError:
                # A cell may have a unit of its own.
                numbers[row] = parse(cell, quantity, f"cases: row {row + 1}: {path}")
    problems.tell()
    return Axis(path, quantity, tuple(cells), numbers), ""
