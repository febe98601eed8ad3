"""Two granite stones on a shaking table: which of the runs overturned them, and which overturn a plane block.

The data belong to the owners of the repository ZhiangChen/virtual_shake_robot_pybullet (commit 9f239e7) and are no part
of the project: they are read where ``HEELTOE_GRANITE`` names their folder, data/Shake_Table_Response of that
repository.
"""

from __future__ import annotations

import os
import re
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from heeltoe import GroundMotion, rigid_many
from heeltoe.base.arrays import Floats
from heeltoe.kernel.block import OUTCOMES
from validation.row import Row, Skipped
from validation.sources import plane_case

_G = 9.81
_VARIABLE = "HEELTOE_GRANITE"
_RESULTS, _PEAKS = "Results_Granite.xlsx", "PGVA-zchen.xlsx"
#: Heights of the stones by their meshes [m].
_HEIGHTS = (0.80, 0.78)
#: The one number that the even runs choose: width of the base over the height.
_SLENDERNESS = np.arange(0.04, 0.41, 0.02)
#: So many samples of the table, 800 a second, are one of ours.
_SAMPLES, _STEP = 4, 0.005
#: The table stands still so long [s] at first, which gives the zero of the accelerometer.
_STILL = 0.25
_CELLS = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"

Flags = np.ndarray[tuple[int], np.dtype[np.bool_]]


@dataclass(frozen=True)
class Stone:
    """Runs of one stone: whether each overturned it, what the owners' discrete elements say by name, peak velocity."""

    overturned: Flags
    elements: dict[str, Flags]


def stones() -> Iterator[Row]:
    """Overturning of two granite stones on a shaking table: share of the odd runs that is foretold.

    Each run shook both stones by a scaled record of one component. A plane block as high as the stone, which rocks
    without sliding, overturns or not by the acceleration measured on the table. The width of its base is the
    one that is right most often in the even runs; the odd runs judge. The owners' discrete elements are those of the
    stiffness that is right most often in the even runs, and the threshold of the peak velocity is chosen likewise.

    With the 490 records that were at hand the bases are 0.08 and 0.10 as wide as the stones are high: they stand on a
    small part of themselves.
    """
    folder = _folder()
    numbers, (first, second), velocity = _read(folder)
    there = np.array([_file(folder, number).is_file() for number in numbers])
    odd = np.arange(numbers.size) % 2 == 1
    motions = [_motion(_file(folder, number)) for number in numbers[there]]
    counted = int(there.sum())
    yield Row("runs", float(numbers.size), float(counted), None, remark=_ABSENT, kind="measured")
    for name, stone, height in (("stone 1", first, _HEIGHTS[0]), ("stone 2", second, _HEIGHTS[1])):
        fell = stone.overturned[there]
        judged, chosen = odd[there], ~odd[there]
        tries = {width: _overturns(height, float(width), motions) for width in _SLENDERNESS}
        width = max(tries, key=lambda one: float(np.mean((tries[one] == fell)[chosen])))
        best = max(stone.elements.values(), key=lambda says: float(np.mean((says[there] == fell)[chosen])))
        peaks = velocity[there]
        least = max(peaks, key=lambda one: float(np.mean(((peaks >= one) == fell)[chosen])))
        ours = float(np.mean((tries[width] == fell)[judged]))
        elements = float(np.mean((best[there] == fell)[judged]))
        threshold = float(np.mean(((peaks >= least) == fell)[judged]))
        what = f"{name}: share of the odd runs that a plane block foretells, beside"
        yield Row(
            f"{what} the owners' discrete elements", elements, ours, None, remark=_PLANE, kind="program", digits=2
        )
        yield Row(f"{what} one peak velocity", threshold, ours, None, remark=_PLANE, kind="program", digits=2)


_ABSENT = "records that are larger than the copy of the repository at hand keeps are not counted below"
_PLANE = "a stone rocks in three dimensions on an uneven base; one length alone is chosen"


def _folder() -> Path:
    folder = Path(os.environ.get(_VARIABLE, ""))
    if _VARIABLE not in os.environ or not (folder / _RESULTS).is_file():
        raise Skipped(
            f"the shaking table's data are not here; set {_VARIABLE} to the folder data/Shake_Table_Response of the "
            "repository ZhiangChen/virtual_shake_robot_pybullet, commit 9f239e7"
        )
    return folder


def _file(folder: Path, number: np.integer[Any]) -> Path:
    return folder / f"Test{int(number):03d}.txt"


def _read(folder: Path) -> tuple[np.ndarray[tuple[int], np.dtype[np.int64]], tuple[Stone, Stone], Floats]:
    """Return numbers of the tests, what each stone did, and peak velocities of the table [m/s]."""
    heads, *rows = _sheet(folder / _RESULTS)
    numbers = np.array([int(row["A"]) for row in rows])

    def column(letter: str) -> Flags:
        return np.array([row[letter] == "1" for row in rows])

    stones = [
        Stone(column(letter), {heads[one]: column(one) for one in heads if heads[one].startswith(f"Specimen {place}")})
        for place, letter in ((1, "B"), (2, "C"))
    ]
    peaks = {row["B"]: float(row["C"]) * float(row["D"]) * _G for row in _sheet(folder / _PEAKS)[1:]}
    return numbers, (stones[0], stones[1]), np.array([peaks[row["A"]] for row in rows])


def _sheet(path: Path) -> list[dict[str, str]]:
    """Return the rows of the first sheet of a workbook, by the letters of their columns."""
    with zipfile.ZipFile(path) as book:
        items = ElementTree.fromstring(book.read("xl/sharedStrings.xml")).iter(f"{_CELLS}si")
        words = ["".join(part.text or "" for part in item.iter(f"{_CELLS}t")) for item in items]
        rows = ElementTree.fromstring(book.read("xl/worksheets/sheet1.xml")).iter(f"{_CELLS}row")
        return [dict(cell for one in row.iter(f"{_CELLS}c") for cell in _cell(one, words)) for row in rows]


def _cell(cell: ElementTree.Element, words: list[str]) -> Iterator[tuple[str, str]]:
    value, column = cell.find(f"{_CELLS}v"), re.match("[A-Z]+", cell.get("r") or "")
    if value is not None and value.text is not None and column is not None:
        yield column[0], words[int(value.text)] if cell.get("t") == "s" else value.text


def _motion(path: Path) -> GroundMotion:
    """Return what the accelerometer of the table says, in its second column [g], its zero taken off."""
    table = np.loadtxt(path, skiprows=1, usecols=1, encoding="utf-8")
    table = table[: table.size // _SAMPLES * _SAMPLES].reshape(-1, _SAMPLES).mean(axis=1)
    table = table - table[: round(_STILL / _STEP)].mean()
    return GroundMotion(path.stem, np.arange(table.size) * _STEP, _G * table)


def _overturns(height: float, slenderness: float, motions: list[GroundMotion]) -> Flags:
    """Return which motions overturn a block of this height [m] and width over height."""
    width = slenderness * height
    block = plane_case(
        {
            "gravity": f"{_G} m/s^2",
            "section": {
                "polygon": [
                    ["0 m", "0 m"],
                    [f"{width} m", "0 m"],
                    [f"{width} m", f"{height} m"],
                    ["0 m", f"{height} m"],
                ]
            },
            "crack": {"friction": 10.0, "restitution": 0.0},
            "analysis": {"rotation": "p-delta"},
        }
    )
    found = rigid_many([block] * len(motions), motions, motion_of=list(range(len(motions))))
    return np.asarray(found["outcome"] == OUTCOMES.index("overturned"))
