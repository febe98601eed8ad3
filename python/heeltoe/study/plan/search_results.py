"""The list of records that PEER's data base puts into a download, ``_SearchResults.csv``: what it says of each."""

from __future__ import annotations

import csv
import math
import os
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from heeltoe.base.input_files import read_bounded
from heeltoe.motion.check import Way

_HEAD = "-- summary of metadata of selected records --"
_LARGEST = 10_000_000
_FILES: dict[str, Way] = {
    "horizontal-1 acc. filename": "level",
    "horizontal-2 acc. filename": "level",
    "vertical acc. filename": "up",
}


@dataclass(frozen=True)
class Listed:
    """A row of a list of records.

    Attributes
    ----------
    way
        Whether it is vertical; empty where it does not say so.
    earthquake
        Its number in the data base, which the components of one record share; empty without it.
    magnitude
        Magnitude of the earthquake.
    distance_m
        To the rupture [m].
    vs30_m_s
        Velocity of shear waves in the upper 30 m below the instrument [m/s].
    pulse_period_s
        Period of the pulse in the velocity [s]; None where there is none, or it is not known.
    """

    way: Way = ""
    earthquake: tuple[str, ...] = ()
    magnitude: float | None = None
    distance_m: float | None = None
    vs30_m_s: float | None = None
    pulse_period_s: float | None = None


def is_list(name: str) -> bool:
    """Whether a file is such a list by its name."""
    return name.lower().lstrip("_").startswith("searchresults") and name.lower().endswith(".csv")


def listed_records(folder: Path) -> dict[str, Listed]:
    """Return what the lists in a folder say of its records, by the names of their files in small letters."""
    found: dict[str, Listed] = {}
    if not os.path.isdir(folder):
        return found
    for path in sorted(folder.iterdir()):
        if is_list(path.name) and path.is_file():
            try:
                found |= _rows(read_bounded(path, _LARGEST).decode("utf-8-sig", "replace").splitlines())
            except OSError:
                # It only adds to what the records say.
                continue
    return found


def _rows(lines: list[str]) -> dict[str, Listed]:
    begins = next((place for place, line in enumerate(lines) if line.strip(" ,").lower() == _HEAD), None)
    if begins is None:
        return {}
    rows = csv.reader(lines[begins + 1 :], skipinitialspace=True)
    head: list[str] = []
    found: dict[str, Listed] = {}
    for row in rows:
        cells = [cell.strip() for cell in row]
        if not head:
            head = [cell.lower() for cell in cells]
            continue
        if not any(cells):
            break
        values = dict(zip(head, cells, strict=False))
        number = values.get("record sequence number", "")
        far = _number(values, "rrup")
        listed = partial(
            Listed,
            earthquake=("PEER", number) if number else (),
            magnitude=_number(values, "magnitude"),
            distance_m=None if far is None else 1e3 * far,
            vs30_m_s=_number(values, "vs30"),
            pulse_period_s=_number(values, "tp-pulse"),
        )
        for column, way in _FILES.items():
            # Where there is no such component it has dashes.
            if name := values.get(column, "").strip("-"):
                found[name.lower()] = listed(way)
    return found


def _number(values: dict[str, str], name: str) -> float | None:
    """Return the number of a column whose name begins so; None without one, as dashes and -999 stand for none."""
    text = next((value for column, value in values.items() if column.startswith(name)), "")
    try:
        number = float(text)
    except ValueError:
        return None
    return number if math.isfinite(number) and number > 0.0 else None
