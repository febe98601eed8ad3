"""Plain columns: time and acceleration, or acceleration alone; a header in words or behind ``#`` if there is one. More
columns than two are read where a line above them names each.

Columns are parted by blanks, tabs, commas or semicolons; beside semicolons and tabs, commas are decimal, and beside
blanks where every cell has one within. A header may state the units and the step::

    # time step: 0.02 s
    # units: column 1 time [s], column 2 acceleration [g]
    time [s], acceleration [cm/s2]
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import is_data, parted
from heeltoe.motion.records.quantities import (
    direction_in,
    is_time,
    names_of,
    other_quantity,
    quantity_of,
    unit_of,
    units_in,
)
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, numbers, real
from heeltoe.warnings.notice import Notice

FORMAT = "columns"

_STEP = re.compile(
    r"(?:time[ -]?step|(?:time|sampling) interval|\bdt\b|delta[ -]?t|^step(?=\s*[:=]))"
    r"\s*(?:[\[(]\s*([a-z]+)\s*[\])])?\s*[:=]?\s*([\d.]+(?:e[-+]?\d+)?)\s*([a-z]*)",
    re.IGNORECASE,
)
# Seconds in each unit of time, by the pattern of its names.
_UNITS_OF_TIME = {
    "s": (r"s|secs?|seconds?", 1.0),
    "ms": (r"ms|msecs?|milliseconds?", 1e-3),
    "min": (r"mins?|minutes?", 60.0),
    "h": (r"h|hrs?|hours?", 3600.0),
}
_TIME_IN = re.compile(r"\btime\s+in\s+([^\W\d]+)|\bt(?:ime)?\s*[\[(]\s*([^\])]{1,30}?)\s*[\])]", re.IGNORECASE)
# A factor beside a table, or one within its unit, as in "x 10 gal" or "g * 1e-3".
_FACTOR = re.compile(
    r"\b(?:scale|scaling|multiplication|multiplier|conversion|calibration|amplification)(?:[ _-]?factor)?\s*[:=]\s*"
    rf"({NUMBER})|\bfactor\s*[:=]\s*({NUMBER})|[x×*]\s*(10\s*(?:\^|\*\*|e)?\s*[-+]?\d*)\b",
    re.IGNORECASE,
)
_AGAINST = re.compile(
    r"\s*(?:freq(?:uency|\.)?|period|omega)\b|[^\W_]*\s*[\[(]\s*(?:hz|1/s|rad/s)\s*[\])]", re.IGNORECASE
)
_STATED = re.compile(r"(?:number of points|points|npts|samples)\s*[:=]\s*(\d{1,12})\b", re.IGNORECASE)
_HEADER_LINES, _HEADER_WIDTH = 100, 400
# More moments than this that are 1 s apart count samples: no record is so slow.
_FEW = 20
# A line of data is shorter; of a longer one, a part tells what it is.
_DATA_WIDTH, _MOST_COLUMNS = 4000, 20
_DECIMAL_COMMA = re.compile(r"\d,\d")
_BLANK_CELLS = re.compile(r"\s*[-+]?\d+,\d+(?:[eE][-+]?\d+)?(?:\s+[-+]?\d+,\d+(?:[eE][-+]?\d+)?)+\s*")
_CELL = re.compile(r"\s*[-+]?\d+(?:,\d+)?(?:[eE][-+]?\d+)?\s*")
# 1,250 is 1250 to some, and 1.25 to others; 0,250 is clear, since no thousands begin with a zero.
_THOUSANDS = re.compile(r"\s*[-+]?[1-9]\d{0,2},\d{3}\s*")
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
    data = [parted(line.split("#")[0]) for line in _with_points(lines[first:], name, first + 1)]
    width = len(data[0].split())
    names = names_of(header, width)
    if any(_AGAINST.match(column) for column in names or ()):
        raise InputError("record-not-acceleration", name, "spectrum, no time history: a")
    _check_factor(header, name)
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
        if match := _ABOUT.match(line):
            about[match[1].lower().replace("earthquake", "event")] = match[2].strip()
    processing = (about.pop("processing"),) if "processing" in about else ()
    stated = _STATED.search(" \n ".join(header))
    warnings = check_series(columns[0], name, int(stated[1]) if stated else None)
    timed = width == 2 or (names is not None and width > 2 and is_time(names[0]))
    clock = _clock(columns[0] if timed else None, header, name)
    series = _series(columns[1:] if timed else columns, (names or [""] * width)[int(timed) :], header, name)
    return [
        RawRecord(
            values,
            time=clock.time,
            time_step=clock.step,
            unit=unit,
            about={**about, "component": direction} if direction else dict(about),
            processing=(*processing, *clock.processing),
            warnings=(*warnings, *clock.warnings),
            counts_samples=clock.counts,
        )
        for values, direction, unit in series
    ]


@dataclass(frozen=True)
class _Clock:
    """When the values of a file are: their moments [s] or their step [s], and what is to be said of them."""

    time: Floats | None
    step: float | None
    processing: tuple[str, ...] = ()
    warnings: tuple[Notice, ...] = ()
    counts: bool = False


def _check_factor(header: list[str], name: str) -> None:
    """Refuse a header with a factor other than 1: whether the values contain it nobody can tell."""
    for line in header:
        for match in () if _ABOUT.match(line) else _FACTOR.finditer(line):
            value = match[1] or match[2]
            if value is None or real(value) != 1.0:
                raise InputError("record-factor", name, repr(value or match[0]))


def _seconds_in(unit: str) -> float | None:
    """Return how many seconds a unit of time has; None where it is not known."""
    return next(
        (size for names, size in _UNITS_OF_TIME.values() if re.fullmatch(names, unit.strip(". "), re.IGNORECASE)), None
    )


def _time_unit(header: list[str], name: str) -> tuple[str, float]:
    """Return the unit in which the header states the times, and how many seconds it has; seconds without one."""
    for line in header:
        if match := _TIME_IN.search(line):
            unit = match[1] or match[2]
            size = _seconds_in(unit)
            if size is None and match[1] is None:
                raise InputError("record-time-unit", name, repr(unit))
            if size is not None:
                return unit, size
    return "s", 1.0


def _clock(time: Floats | None, header: list[str], name: str) -> _Clock:
    step = next((value for line in header if (value := _step(line)) is not None), None)
    if time is None:
        return _Clock(None, step)
    processing: tuple[str, ...] = ()
    unit, seconds = _time_unit(header, name)
    if seconds != 1.0:
        # Thousandths are divided, so that 20 ms are 0.02 s to the last bit.
        time = time / (1.0 / seconds) if seconds < 1.0 else time * seconds
        processing = (f"time read in {unit}",)
    elif time.size > _FEW and (np.diff(time) == 1.0).all():
        return _Clock(None, step, ("the first column counts the samples",), counts=True)
    if step is not None and time.size > 1:
        median = float(np.median(np.diff(time)))
        if abs(median - step) > 0.01 * step:
            return _Clock(
                time, None, processing, (Notice("record-step-differs", name=name, stated_s=step, found_s=median),)
            )
    return _Clock(time, None, processing)


def _series(columns: Floats, names: list[str], header: list[str], name: str) -> list[tuple[Floats, str, str | None]]:
    """The accelerations among columns, each with its direction and its unit."""
    unit = unit_of(header)
    if len(columns) == 1:
        header_lines = [line for line in header if not _ABOUT.match(line)]
        if quantity := other_quantity(header_lines) or (None if unit else quantity_of(names[0])):
            raise InputError("record-not-acceleration", name, quantity)
        return [(columns[0], "", unit)]
    quantities = [quantity_of(column_name) for column_name in names]
    kept = [
        (values, direction_in(column_name), next(iter(units_in(column_name)), unit))
        for values, column_name, quantity in zip(columns, names, quantities, strict=True)
        if quantity is None
    ]
    if not kept:
        raise InputError(
            "record-not-acceleration", name, " and ".join(sorted({quantity or "" for quantity in quantities}))
        )
    return kept


def _step(line: str) -> float | None:
    """The time step [s] a line states; None where it states none or in words that are not known."""
    match = _STEP.search(line)
    if not match:
        return None
    seconds = _seconds_in(match[1] or match[3] or "s")
    try:
        value = float(match[2])
    except ValueError:
        return None
    if seconds is None:
        return None
    return value / 1e3 if seconds == 1e-3 else value * seconds


def _with_points(lines: list[str], name: str, first_line: int) -> list[str]:
    """Return lines of data with points for decimal commas, which semicolons or tabs beside them give away.

    Parameters
    ----------
    lines
        Lines of data.
    name
        Of the file, for errors.
    first_line
        Number of the first of them in the file, for errors.

    Raises
    ------
    InputError
        Where a comma may mean one thing or another.
    """
    if not any("," in line for line in lines):
        return lines
    texts = [line.split("#")[0].replace('"', "") for line in lines]
    if not any(_has_decimal_comma(text) for text in texts):
        return lines
    surely = False
    for number, (line, text) in enumerate(zip(lines, texts, strict=True), first_line):
        parting = r"\s+" if _BLANK_CELLS.fullmatch(text) else r"[;\t]"
        cells = [cell for cell in re.split(parting, text) if cell.strip()]
        if not all(_CELL.fullmatch(cell) for cell in cells):
            raise InputError("record-comma", name, repr(line.strip()[:30]), line=number)
        surely = surely or any("," in cell and not _THOUSANDS.fullmatch(cell) for cell in cells)
    if not surely:
        raise InputError("record-comma", name, repr(lines[0].strip()[:30]), line=first_line)
    return [text.replace(",", ".") for text in texts]


def _has_decimal_comma(text: str) -> bool:
    text = text.strip()
    if _BLANK_CELLS.fullmatch(text):
        return True
    return (";" in text or "\t" in text) and _DECIMAL_COMMA.search(text) is not None
