"""Shear tests of a joint, as a laboratory reports them: a table with units in its headings.

A row is a test, with its normal stress and its peak or residual shear stress, or a point of a curve of shear stress
over slip. A specimen that is sheared several times has a stage for each.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.input_files import read_csv_rows, reason_of
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import near
from heeltoe.units.parse import parse, plain_number

#: Columns of a table, with the kind of quantity; None for words.
COLUMNS: dict[str, str | None] = {
    "specimen": None,
    "surface": None,
    "stage": "number",
    "normal stress": "pressure",
    "peak shear": "pressure",
    "residual shear": "pressure",
    "shear": "pressure",
    "slip": "length",
    "speed": "velocity",
    "size": "length",
    "wall strength": "pressure",
}
#: Shorter tables fit nothing.
FEWEST = 3
_FIELD = "tests"
_LARGEST = 64_000_000
_HEAD = re.compile(r"([^\[\]()]+?)\s*(?:[\[(]([^\[\]()]*)[\])])?\s*")
# The loading of a curve ends where it first bears so much of its peak, a mean of so many points.
_LOADED, _SMOOTHED = 0.95, 5
# A curve has at least so many points; its residual shear is the mean of the last part of its slip.
_POINTS, _LAST = 8, 1.0 / 3.0


@dataclass(frozen=True, eq=False)
class Curve:
    """Shear stress over slip once the joint is loaded.

    Attributes
    ----------
    slip_m
        (n,) slip since then.
    ratio
        (n,) shear stress over normal stress.
    """

    slip_m: Floats
    ratio: Floats

    @property
    def fall(self) -> float:
        """By how much the ratio falls from the mean of the first third of the slip to that of the last third."""
        return float(_mean_of(self, 0.0, _LAST) - _mean_of(self, 1.0 - _LAST, 1.0))


@dataclass(frozen=True)
class ShearTest:
    """One shear test: one specimen under one normal stress. NaN where the table does not say.

    Attributes
    ----------
    specimen, surface
        As the table has them.
    stage
        Which of the tests of its specimen it is, from 1 on.
    normal_pa, peak_pa, residual_pa
        Stresses.
    speed_m_s
        Speed of the slip.
    size_m
        Length of the specimen along the slip.
    wall_strength_pa
        Compressive strength of the walls of the joint.
    curve
        Of a table of curves.
    """

    specimen: str
    surface: str
    stage: int
    normal_pa: float
    peak_pa: float
    residual_pa: float
    speed_m_s: float
    size_m: float
    wall_strength_pa: float
    curve: Curve | None = None


def read_shear_tests(path: str | os.PathLike[str]) -> tuple[ShearTest, ...]:
    """Read a table of shear tests.

    Raises
    ------
    InputError
        Where there is no such file, a heading is unknown, twice or without its unit, a column is missing, a cell is no
        number, or there are too few tests.
    """
    try:
        rows = read_csv_rows(Path(path), _LARGEST)
    except FileNotFoundError:
        raise InputError("file-missing", _FIELD, shown(str(path)), expected="the shear tests, as CSV") from None
    except (OSError, ValueError) as error:
        raise InputError(
            "file-unreadable", _FIELD, shown(str(path)), reason=reason_of(error), expected="a CSV file in UTF-8"
        ) from None
    head, *cells = rows or [[]]
    for number, row in enumerate(cells):
        if len(row) != len(head):
            raise InputError("row-length", f"{_FIELD}: row {number + 1}", len(row), count=len(head))
    columns = [_column(title) for title in head]
    names = [name for name, _ in columns]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InputError("listed-twice", _FIELD, shown(twice))
    _check_columns(names)
    table = {
        name: _words(cells, place) if COLUMNS[name] is None else _numbers(cells, place, name, factor)
        for place, (name, factor) in enumerate(columns)
    }
    tests = _of_curves(table) if "shear" in table else _of_rows(table, len(cells))
    if len(tests) < FEWEST and not ("shear" in table and tests):
        raise InputError("too-few", _FIELD, f"{len(tests)} tests with a strength", least=FEWEST)
    return tests


def _column(title: str) -> tuple[str, float]:
    """Return the column of a heading and what one of its unit is, SI."""
    match = _HEAD.fullmatch(title)
    words, unit = (match[1], (match[2] or "").strip()) if match else (title, "")
    name = " ".join(words.replace("_", " ").lower().split()).removesuffix(" stress") if match else title
    name = "normal stress" if name == "normal" else name
    if name not in COLUMNS:
        raise InputError(
            "not-a-choice", _FIELD, shown(title), choices=f"columns of {', '.join(COLUMNS)}{near(name, COLUMNS)}"
        )
    kind = COLUMNS[name]
    if kind in (None, "number"):
        return name, 1.0
    if not unit:
        raise InputError(
            "unit-missing", f"{_FIELD}: {name}", shown(title), example="normal stress [MPa] as its heading"
        )
    return name, parse(f"1 {unit}", kind or "", f"{_FIELD}: {name}")


def _check_columns(names: Sequence[str]) -> None:
    """Refuse a table that has neither strengths nor curves."""
    strengths = {"peak shear", "residual shear"} & {*names}
    curves = {"shear", "slip"} & {*names}
    if strengths and curves:
        raise InputError("tests-both", f"{_FIELD}: {next(iter(sorted(curves)))}")
    needed = ["normal stress", *(("specimen", "slip", "shear") if curves else () if strengths else ("peak shear",))]
    missing = next((name for name in needed if name not in names), None)
    if missing is not None:
        raise InputError(
            "missing", f"{_FIELD}: {missing}", remedy="add this column; `docs/friction.md` lists the columns"
        )


def _words(rows: Sequence[Sequence[str]], place: int) -> list[str]:
    return [row[place] for row in rows]


def _numbers(rows: Sequence[Sequence[str]], place: int, name: str, factor: float) -> list[float]:
    """Return a column of numbers; an empty cell is NaN where a test may go without."""
    numbers = []
    for number, row in enumerate(rows):
        cell, field = row[place], f"{_FIELD}: row {number + 1}: {name}"
        if not cell and name not in ("normal stress", "slip", "shear"):
            numbers.append(np.nan)
            continue
        try:
            value = plain_number(cell)
        except ValueError:
            raise InputError("tests-cell", field, shown(cell)) from None
        least_open = name in ("normal stress", "size", "wall strength", "stage")
        if not np.isfinite(value) or value < 0.0 or (least_open and value == 0.0):
            raise InputError("out-of-range", field, shown(cell), bound=f"of {'above 0' if least_open else '0 or more'}")
        numbers.append(value * factor)
    return numbers


def _of_rows(table: dict[str, list[str] | list[float]], count: int) -> tuple[ShearTest, ...]:
    """Return the tests of a table with a row for each."""
    nothing = [np.nan] * count
    number = {name: np.array(table.get(name, nothing), dtype=float) for name, kind in COLUMNS.items() if kind}
    specimens = [str(word) or str(row + 1) for row, word in enumerate(table.get("specimen", range(1, count + 1)))]
    surfaces = [str(word) for word in table.get("surface", [""] * count)]
    tests = []
    for row in range(count):
        peak, residual = number["peak shear"][row], number["residual shear"][row]
        if np.isnan(peak) and np.isnan(residual):
            raise InputError("tests-cell", f"{_FIELD}: row {row + 1}: peak shear", shown(""))
        # Without a column of stages, the tests of a specimen follow each other.
        stage = number["stage"][row]
        stage = specimens[: row + 1].count(specimens[row]) if np.isnan(stage) else int(stage)
        tests.append(
            ShearTest(
                specimen=specimens[row],
                surface=surfaces[row],
                stage=stage,
                normal_pa=float(number["normal stress"][row]),
                peak_pa=float(peak),
                residual_pa=float(residual),
                speed_m_s=float(number["speed"][row]),
                size_m=float(number["size"][row]),
                wall_strength_pa=float(number["wall strength"][row]),
            )
        )
    return tuple(tests)


def _of_curves(table: dict[str, list[str] | list[float]]) -> tuple[ShearTest, ...]:
    """Return the tests of a table of curves: points of the same specimen and stage are one."""
    count = len(table["shear"])
    nothing = [np.nan] * count
    number = {name: np.array(table.get(name, nothing), dtype=float) for name, kind in COLUMNS.items() if kind}
    stages = np.where(np.isnan(number["stage"]), 1.0, number["stage"])
    keys = [(str(word), int(stage)) for word, stage in zip(table["specimen"], stages, strict=True)]
    tests = []
    for specimen, stage in dict.fromkeys(keys):
        rows = np.array([place for place, key in enumerate(keys) if key == (specimen, stage)])
        rows = rows[np.argsort(number["slip"][rows], kind="stable")]
        if rows.size < _POINTS:
            raise InputError("tests-points", f"{_FIELD}: {specimen}", rows.size, least=_POINTS)
        normal, shear = number["normal stress"][rows], number["shear"][rows]
        curve = _loaded(number["slip"][rows], shear / normal)
        mean = float(normal.mean())
        tests.append(
            ShearTest(
                specimen=specimen,
                surface=str(table["surface"][int(rows[0])]) if "surface" in table else "",
                stage=stage,
                normal_pa=mean,
                peak_pa=_mean_of(curve, 0.0, 0.0) * mean,
                residual_pa=_mean_of(curve, 1.0 - _LAST, 1.0) * mean,
                speed_m_s=float(number["speed"][rows].mean()),
                size_m=float(number["size"][rows[0]]),
                wall_strength_pa=float(number["wall strength"][rows[0]]),
                curve=curve,
            )
        )
    return tuple(tests)


def _loaded(slip: Floats, ratio: Floats) -> Curve:
    """Return a curve from where the joint is loaded: where it first bears nearly its largest smoothed stress."""
    smoothed = np.convolve(ratio, np.full(_SMOOTHED, 1.0 / _SMOOTHED), mode="valid").max()
    first = int(np.argmax(ratio >= _LOADED * min(smoothed, ratio.max())))
    first = min(first, slip.size - _SMOOTHED)
    return Curve(slip[first:] - slip[first], ratio[first:])


def _mean_of(curve: Curve, start: float, end: float) -> float:
    """Return the mean ratio over a part of the slip, of its first points at least."""
    whole = float(curve.slip_m[-1])
    inside = (curve.slip_m >= start * whole) & (curve.slip_m <= end * whole)
    if start == 0.0:
        inside[:_SMOOTHED] = True
    return float(curve.ratio[inside].mean())
