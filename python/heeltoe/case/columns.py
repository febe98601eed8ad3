"""Many dams at once: cases whose numbers are columns, one row for each dam.

What a case says by its words must be the same in all rows; :func:`by_columns` divides the rows by the pattern of the
uplift. What a row may say is what a case may say, and what is wrong with one is said as of a single case.
"""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Integers
from heeltoe.case.combinations import check
from heeltoe.case.dam import UPLIFT_OPTIONS, pattern_of
from heeltoe.case.model import Case, misfits
from heeltoe.case.paths import bounds_of, quantity_of
from heeltoe.errors.error import InputError, expect, shown
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
_Arrays = dict[str, NDArray[Any]]


@dataclass(frozen=True, eq=False)
class Rows:
    """Rows of columns.

    Attributes
    ----------
    sound
        (n,) which of them are cases.
    parts
        Cases whose numbers are columns, each with the sound rows that it stands for.
    """

    sound: NDArray[np.bool_]
    parts: tuple[tuple[Integers, Case], ...]


def by_columns(case: Case, columns: Columns, *, every: bool = False) -> Rows:
    """Return cases whose numbers are columns.

    Parameters
    ----------
    case
        What all rows have in common.
    columns
        Of :data:`COLUMNS`, (n,) each: numbers in SI units, words in the pattern of the uplift; one row where there are
        none. They change the case as :meth:`heeltoe.Case.with_` does. An option of one pattern is NaN in rows of
        another.
    every
        Look at every row, and leave out those that are no cases.

    Raises
    ------
    InputError
        Where the case has several cracks, a field can be no column, or columns differ in length; without `every` as of
        a single case, for the first row that is none.
    """
    expect(case, Case, "a case", "case")
    check(case, "table")
    fields, count = _checked(columns)
    sound, parts = np.ones(count, dtype=np.bool_), []
    for rows in _alike(fields, count):
        here = _taken(fields, rows)
        wrong, many = _part(case, here, every=every)
        sound[rows[wrong]] = False
        if many is not None:
            parts.append((rows[~wrong], many))
    if not every and not sound.all():
        first = int(sound.argmin())
        _row(case, fields, first)
        raise AssertionError(f"row {first} is refused among many and taken alone")
    return Rows(sound, tuple(parts))


def _part(case: Case, here: _Arrays, *, every: bool) -> tuple[NDArray[np.bool_], Case | None]:
    """Return which rows of one pattern are no cases, of which only the first is certain without `every`, and the others
    as a case; None where there is no other, or need not be."""
    wrong = _out_of_bounds(case, here)
    one: Case | None = None
    for place in np.flatnonzero(~wrong).tolist():
        try:
            one = _row(case, here, place)
            break
        except InputError:
            wrong[place] = True
            if not every:
                break
    if one is None or (wrong.any() and not every):
        return wrong, None
    kept = np.flatnonzero(~wrong)
    many = _filled(one, _taken(here, kept))
    misfit = _misfit(many, kept.size)
    if misfit is None:
        misfit = np.array([not _stands(case, here, place) for place in kept.tolist()])
    if not misfit.any():
        return wrong, many
    wrong[kept[misfit]] = True
    return wrong, None if misfit.all() else _filled(one, _taken(here, kept[~misfit]))


def _taken(fields: _Arrays, rows: Integers) -> _Arrays:
    return {path: values[rows] for path, values in fields.items()}


def _stands(case: Case, here: _Arrays, row: int) -> bool:
    try:
        _row(case, here, row)
    except InputError:
        return False
    return True


def _checked(columns: Columns) -> tuple[_Arrays, int]:
    """Return the columns as arrays, and their length; one row where there are none."""
    fields: _Arrays = {}
    count: int | None = None
    for path, values in columns.items():
        if path not in COLUMNS:
            raise InputError("column-unknown", path, columns=", ".join(COLUMNS))
        try:
            column = np.asarray(values, dtype=np.str_ if path == PATTERN else np.float64)
        except (ValueError, TypeError):
            raise InputError("wrong-type", path, shown(values), expected="a column of numbers in SI units") from None
        count = column.size if count is None else count
        if column.shape != (count,):
            raise InputError("blocks-many", path, " x ".join(map(str, column.shape)) or "one number", count=count)
        fields[path] = column
    return fields, 1 if count is None else count


def _alike(fields: _Arrays, count: int) -> list[Integers]:
    """Return the rows of each pattern of the uplift."""
    if PATTERN not in fields or count == 0:
        return [np.arange(count)] if count else []
    _, which = np.unique(fields[PATTERN].astype(str), return_inverse=True)
    return [np.flatnonzero(which == group) for group in range(which.max() + 1)]


def _row(case: Case, here: _Arrays, row: int) -> Case:
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


def _filled(case: Case, here: _Arrays) -> Case:
    """Return a case with columns in the place of its numbers."""
    blocks: dict[str, dict[str, Any]] = {}
    for path, values in here.items():
        block, _, name = path.rpartition(".")
        if path != PATTERN and _OPTIONS.get(path, case.uplift.pattern) == case.uplift.pattern:
            blocks.setdefault(block, {})[name] = values
    changes = blocks.pop("", {})
    changes |= {name: getattr(case, name).model_copy(update=fields) for name, fields in blocks.items()}
    return case.model_copy(update=changes)


def _out_of_bounds(case: Case, here: _Arrays) -> NDArray[np.bool_]:
    """Return which rows have a number that its field does not take."""
    wrong = np.zeros(next(iter(here.values())).size if here else 1, dtype=np.bool_)
    pattern = pattern_of(here[PATTERN][0]) if PATTERN in here else case.uplift.pattern
    for path, values in here.items():
        if path == PATTERN:
            continue
        if _OPTIONS.get(path, pattern) != pattern:
            wrong |= ~np.isnan(values)
            continue
        wrong |= ~np.isfinite(values)
        for kind, bound in bounds_of(path):
            wrong |= ~getattr(operator, kind)(values, bound)
    elevation: Any = here.get("crack.elevation")
    if elevation is not None:
        wrong |= outside(case.outline, elevation)
    return wrong


def _misfit(many: Case, count: int) -> NDArray[np.bool_] | None:
    """Return which rows have numbers that do not go together; None where the section cannot be cut at some row."""
    wrong = np.zeros(count, dtype=np.bool_)
    wrong |= many.crack.mu_static < many.crack.mu_kinetic
    if many.ice is not None and many.reservoir is not None:
        wrong |= many.ice.depth >= many.reservoir.depth
    try:
        for misfit, _ in misfits(many):
            wrong |= misfit
    except InputError:
        return None
    return wrong
