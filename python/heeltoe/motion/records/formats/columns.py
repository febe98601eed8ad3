"""Plain columns: time and acceleration, or acceleration alone; a header in words or behind ``#`` if there is one. More
columns than two are read where a line above them names each.

Columns are parted by blanks, tabs, commas or semicolons; beside semicolons and tabs, commas are decimal. A header may
state the unit and the step::

    # time step: 0.02 s
    # units: column 1 time [s], column 2 acceleration [g]
    time [s], acceleration [cm/s2]
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.errors import InputError
from heeltoe.motion.records.cells import is_data, parted, with_points
from heeltoe.motion.records.quantities import (
    direction_in,
    is_time,
    names_of,
    other_quantity,
    quantity_of,
    unit_of,
    units_in,
)
from heeltoe.motion.records.raw import RawRecord, counted, numbers
from heeltoe.warnings import Notice

FORMAT = "columns"

_STEP = re.compile(
    r"(?:time[ -]?step|(?:time|sampling) interval|\bdt\b|delta[ -]?t|^step(?=\s*[:=]))"
    r"\s*(?:[\[(]\s*([a-z]+)\s*[\])])?\s*[:=]?\s*([\d.]+(?:e[-+]?\d+)?)\s*([a-z]*)",
    re.IGNORECASE,
)
_SECONDS, _MILLISECONDS = r"s|secs?|seconds?", r"ms|msecs?|milliseconds?"
_TIME_IN_MS = re.compile(rf"\bt(?:ime)?\s*[\[(]\s*(?:{_MILLISECONDS})\s*[\])]", re.IGNORECASE)
_STATED = re.compile(r"(?:number of points|points|npts|samples)\s*[:=]\s*(\d{1,12})\b", re.IGNORECASE)
_HEADER_LINES, _HEADER_WIDTH = 100, 400
# More moments than this that are 1 s apart count samples: no record is so slow.
_FEW = 20
# A line of data is shorter; of a longer one, a part tells what it is.
_DATA_WIDTH, _MOST_COLUMNS = 4000, 20
_ABOUT = re.compile(r"^(event|earthquake|station|component|date|processing)\s*[:=]\s*(.+)$", re.IGNORECASE)


def _split(lines: list[str]) -> tuple[list[str], int]:
    """Header lines without their ``#``, and the index of the first line of data."""
    header: list[str] = []
    for k, line in enumerate(lines):
        text = line.strip()
        if text and not text.startswith(("#", "%", "//")) and is_data(text[:_HEADER_WIDTH]):
            return header, k
        # What a header has to say it says early; a long one must not slow the search down.
        if k < _HEADER_LINES:
            header.append(text.replace('"', "").lstrip("#%/ ").strip()[:_HEADER_WIDTH])
    return header, len(lines)


def matches(lines: list[str]) -> bool:
    """Whether there are lines of as many numbers, after a header of any kind."""
    _, first = _split(lines)
    data = [parted(line[:_DATA_WIDTH].split("#")[0]).split() for line in lines[first : first + 20] if line.strip()]
    if not data:
        return False
    widths = [len(words) for words in data]
    # Prose may begin with a number. A line or two may be spoilt; the reader names them.
    numeric = widths[0] <= 2 or all(map(is_data, data[0][:_MOST_COLUMNS]))
    return numeric and widths.count(widths[0]) > len(widths) / 3


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    header, first = _split(lines)
    data = [parted(line.split("#")[0]) for line in with_points(lines[first:], name, first + 1)]
    width = len(data[0].split())
    names = names_of(header, width)
    if width > 2 and names is None:
        raise InputError("record-columns", name, width)
    for k, line in enumerate(data):
        if len(line.split()) not in (0, width):
            raise InputError("record-ragged", name, f"{len(line.split())} columns", line=first + k + 1, width=width)
    values = numbers(data, name, first + 1)
    if values.size % width:
        raise InputError("record-ragged", name, f"{values.size} numbers", line=first + 1, width=width)
    columns = np.ascontiguousarray(values.reshape(-1, width).T)
    about = {}
    for line in header:
        if found := _ABOUT.match(line):
            about[found[1].lower().replace("earthquake", "event")] = found[2].strip()
    processing = (about.pop("processing"),) if "processing" in about else ()
    stated = _STATED.search(" \n ".join(header))
    warnings = counted(columns[0], int(stated[1]), name) if stated else ()
    timed = width == 2 or (names is not None and width > 2 and is_time(names[0]))
    clock = _clock(columns[0] if timed else None, header, name)
    series = _series(columns[1:] if timed else columns, (names or [""] * width)[int(timed) :], header, name)
    return [
        RawRecord(
            each,
            time=clock.time,
            time_step=clock.step,
            unit=unit,
            about={**about, "component": direction} if direction else dict(about),
            processing=(*processing, *clock.said),
            warnings=(*warnings, *clock.warnings),
            counts_samples=clock.counts,
        )
        for each, direction, unit in series
    ]


@dataclass(frozen=True)
class _Clock:
    """When the values of a file are: their moments [s] or their step [s], and what is to be said of them."""

    time: Floats | None
    step: float | None
    said: tuple[str, ...] = ()
    warnings: tuple[Notice, ...] = ()
    counts: bool = False


def _clock(time: Floats | None, header: list[str], name: str) -> _Clock:
    step = next((value for line in header if (value := _step(line)) is not None), None)
    if time is None:
        return _Clock(None, step)
    said: tuple[str, ...] = ()
    if any(_TIME_IN_MS.search(line) for line in header):
        time, said = time / 1e3, ("time read in ms",)
    elif time.size > _FEW and (np.diff(time) == 1.0).all():
        return _Clock(None, step, ("the first column counts the samples",), counts=True)
    if step is not None and time.size > 1:
        median = float(np.median(np.diff(time)))
        if abs(median - step) > 0.01 * step:
            return _Clock(time, None, said, (Notice("record-step-differs", name=name, stated_s=step, found_s=median),))
    return _Clock(time, None, said)


def _series(columns: Floats, names: list[str], header: list[str], name: str) -> list[tuple[Floats, str, str | None]]:
    """The accelerations among columns, each with its direction and its unit."""
    unit = unit_of(header)
    if len(columns) == 1:
        told = [line for line in header if not _ABOUT.match(line)]
        if quantity := other_quantity(told) or (None if unit else quantity_of(names[0])):
            raise InputError("record-not-acceleration", name, quantity)
        return [(columns[0], "", unit)]
    quantities = [quantity_of(each) for each in names]
    kept = [
        (values, direction_in(each), next(iter(units_in(each)), unit))
        for values, each, quantity in zip(columns, names, quantities, strict=True)
        if quantity is None
    ]
    if not kept:
        raise InputError("record-not-acceleration", name, " and ".join(sorted({each or "" for each in quantities})))
    return kept


def _step(line: str) -> float | None:
    """The time step [s] a line states; None where it states none or in words that are not known."""
    found = _STEP.search(line)
    if not found:
        return None
    unit = (found[1] or found[3] or "s").lower()
    try:
        value = float(found[2])
    except ValueError:
        return None
    if re.fullmatch(_MILLISECONDS, unit):
        return value / 1e3
    return value if re.fullmatch(_SECONDS, unit) else None
