"""Many dams at once: cases whose numbers are columns, one row for each dam.

What a case says by its words must be the same in all rows; :func:`by_columns` divides the rows by the pattern of the
uplift. What a row may say is what a case may say, and what is wrong with one is said as of a single case.
"""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.arrays import Integers
from heeltoe.case.dam import UPLIFT_OPTIONS, pattern_of
from heeltoe.case.model import Case, misfits
from heeltoe.case.paths import bounds_of, quantity_of
from heeltoe.errors import InputError, expect, shown
from heeltoe.geometry.section import outside
from heeltoe.units.parse import DIMENSIONS

PATTERN = "uplift.pattern"
#: Fields that may be columns: of words the pattern of the uplift, of SI numbers all others.
COLUMNS = (
    "gravity",
    "concrete.density",
    *(f"crack.{name}" for name in ("elevation", "friction", "static_friction", "kinetic_friction", "restitution")),
    *(f"{side}.{name}" for side in ("reservoir", "tailwater") for name in ("depth", "density")),
    *(f"ice.{name}" for name in ("force", "depth")),
    *(f"silt.{name}" for name in ("depth", "horizontal_density", "vertical_density")),
    PATTERN,
    *(f"uplift.{name}" for name in ("intensity", "extent", "drain_position", "drain_efficiency")),
)
_OPTIONS = {f"uplift.{name}": pattern for name, pattern in UPLIFT_OPTIONS.items()}

#: Columns by the paths of their fields.
Columns = Mapping[str, Sequence[float] | Sequence[str] | NDArray[Any]]
_Given = dict[str, NDArray[Any]]


def by_columns(case: Case, columns: Columns) -> tuple[int, list[tuple[Integers, Case]]]:
    """Return how many rows there are, and cases whose numbers are columns, each with the rows that it stands for.

    Parameters
    ----------
    case
        What all rows have in common.
    columns
        Of :data:`COLUMNS`, (n,) each: numbers in SI units, words in the pattern of the uplift. They change the case as
        :meth:`heeltoe.Case.with_` does. An option of one pattern is NaN in rows of another.

    Raises
    ------
    InputError
        As of a single case, for the first row that is none.
    """
    expect(case, Case, "not-a-case", "case")
    given, count = _checked(columns)
    found: list[tuple[Integers, Case]] = []
    refused: list[tuple[int, InputError]] = []
    for rows in _alike(given, count):
        here, place = {path: values[rows] for path, values in given.items()}, 0
        try:
            many = _filled(_row(case, here, 0), here)
            wrong = _wrong(many, here)
            place = int(wrong.argmax())
            if wrong[place]:
                _row(case, here, place)
                raise AssertionError(f"row {rows[place]} is refused among many and taken alone")
            found.append((rows, many))
        except InputError as error:
            refused.append((int(rows[place]), error))
    if refused:
        raise min(refused, key=lambda each: each[0])[1]
    return count, found


def _checked(columns: Columns) -> tuple[_Given, int]:
    """Return the columns as arrays, and their length; one row where there are none."""
    given: _Given = {}
    count: int | None = None
    for path, values in columns.items():
        if path not in COLUMNS:
            raise InputError("column-unknown", path, columns=", ".join(COLUMNS))
        try:
            column = np.asarray(values, dtype=None if path == PATTERN else np.float64)
        except (ValueError, TypeError):
            raise InputError("wrong-type", path, shown(values), expected="a column of numbers in SI units") from None
        count = column.size if count is None else count
        if column.shape != (count,):
            raise InputError("blocks-many", path, " x ".join(map(str, column.shape)) or "one number", count=count)
        given[path] = column
    return given, 1 if count is None else count


def _alike(given: _Given, count: int) -> list[Integers]:
    """Return the rows of each pattern of the uplift."""
    if PATTERN not in given or count == 0:
        return [np.arange(count)] if count else []
    _, which = np.unique(given[PATTERN].astype(str), return_inverse=True)
    return [np.flatnonzero(which == each) for each in range(which.max() + 1)]


def _row(case: Case, here: _Given, row: int) -> Case:
    """Return a row as a single case, read and checked as any; an option of another pattern, NaN, is not there."""
    pattern = pattern_of(here[PATTERN][row]) if PATTERN in here else case.uplift.pattern
    changes: dict[str, Any] = {}
    for path, values in here.items():
        value = values[row].item()
        if path in _OPTIONS and _OPTIONS[path] != pattern and np.isnan(value):
            continue
        unit = "" if path == PATTERN else DIMENSIONS[quantity_of(path) or ""].unit
        changes[path] = f"{value!r} {unit}" if unit else value
    return case.with_(changes)


def _filled(case: Case, here: _Given) -> Case:
    """Return a case with columns in the place of its numbers."""
    blocks: dict[str, dict[str, Any]] = {}
    for path, values in here.items():
        block, _, name = path.rpartition(".")
        if path != PATTERN and _OPTIONS.get(path, case.uplift.pattern) == case.uplift.pattern:
            blocks.setdefault(block, {})[name] = values
    changes = blocks.pop("", {})
    changes |= {name: getattr(case, name).model_copy(update=fields) for name, fields in blocks.items()}
    return case.model_copy(update=changes)


def _wrong(many: Case, here: _Given) -> NDArray[np.bool_]:
    """Return which rows are no cases."""
    wrong = np.zeros(next(iter(here.values())).size if here else 1, dtype=np.bool_)
    for path, values in here.items():
        if path == PATTERN:
            continue
        if _OPTIONS.get(path, many.uplift.pattern) != many.uplift.pattern:
            wrong |= ~np.isnan(values)
            continue
        wrong |= ~np.isfinite(values)
        for kind, bound in bounds_of(path):
            wrong |= ~getattr(operator, kind)(values, bound)
    wrong |= many.crack.mu_static < many.crack.mu_kinetic
    wrong |= outside(many.outline, many.crack.elevation)
    if many.ice is not None and many.reservoir is not None:
        wrong |= many.ice.depth >= many.reservoir.depth
    # Without a crack there is nothing above it to measure against.
    if not wrong.any():
        for misfit, _ in misfits(many):
            wrong |= misfit
    return wrong
