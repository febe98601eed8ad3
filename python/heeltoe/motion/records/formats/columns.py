"""Plain columns: time and acceleration, or acceleration alone; a header in words or behind ``#`` if there is one.

Columns are parted by blanks, tabs, commas or semicolons; beside semicolons and tabs, commas are decimal. A header may
state the unit and the step::

    # time step: 0.02 s
    # units: column 1 time [s], column 2 acceleration [g]
    time [s], acceleration [cm/s2]
"""

from __future__ import annotations

import re

import numpy as np

from heeltoe.errors import InputError
from heeltoe.motion.records.cells import is_data, parted, with_points
from heeltoe.motion.records.raw import RawRecord, counted, numbers
from heeltoe.warnings import Notice

FORMAT = "columns"

# A unit with a letter before it is another one (nm/s2), with a number before it a quantity (a peak, not the unit of
# the data), with an operation behind it a part of one (g/10).
_BEFORE, _AFTER = r"(?<![^\W_])(?<![\d.]\s)", r"\b(?!\s*[/*^×])"
_PER_S2 = r"(?:\s*/\s*s(?:ec)?\s*(?:(?:\^|\*\*)?\s*2|/\s*s(?:ec)?)|\s+s(?:\^|\*\*)?-2)"
_UNITS = (
    ("cm/s^2", rf"{_BEFORE}(?:cm{_PER_S2}|gals?){_AFTER}"),
    ("mm/s^2", rf"{_BEFORE}mm{_PER_S2}{_AFTER}"),
    ("m/s^2", rf"{_BEFORE}m{_PER_S2}{_AFTER}"),
    ("ft/s^2", rf"{_BEFORE}ft{_PER_S2}{_AFTER}"),
    ("in/s^2", rf"{_BEFORE}in(?:ch)?{_PER_S2}{_AFTER}"),
    ("g", rf"\[\s*g\s*\]|\(\s*g\s*\)|(?:\bin\s|units?\s*[:=]\s*|accel\w*\s*,?\s)\s*g{_AFTER}"),
)
_ONE_G = re.compile(r"1\s*g\s*=[^)\]]*", re.IGNORECASE)
_STEP = re.compile(
    r"(?:time[ -]?step|(?:time|sampling) interval|\bdt\b|delta[ -]?t|^step(?=\s*[:=]))"
    r"\s*(?:[\[(]\s*([a-z]+)\s*[\])])?\s*[:=]?\s*([\d.]+(?:e[-+]?\d+)?)\s*([a-z]*)",
    re.IGNORECASE,
)
_SECONDS, _MILLISECONDS = r"s|secs?|seconds?", r"ms|msecs?|milliseconds?"
_TIME_IN_MS = re.compile(rf"\bt(?:ime)?\s*[\[(]\s*(?:{_MILLISECONDS})\s*[\])]", re.IGNORECASE)
_STATED = re.compile(r"(?:number of points|points|npts|samples)\s*[:=]\s*(\d{1,12})\b", re.IGNORECASE)
_HEADER_LINES, _HEADER_WIDTH = 100, 400
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
    if width > 2:
        raise InputError("record-columns", name, width)
    for k, line in enumerate(data):
        if len(line.split()) not in (0, width):
            raise InputError("record-ragged", name, f"{len(line.split())} columns", line=first + k + 1, width=width)
    values = numbers(data, name, first + 1)
    if values.size % width:
        raise InputError("record-ragged", name, f"{values.size} numbers", line=first + 1, width=width)
    table = values.reshape(-1, width)
    said = " \n ".join(header)
    about = {}
    for line in header:
        if found := _ABOUT.match(line):
            about[found[1].lower().replace("earthquake", "event")] = found[2].strip()
    processing = (about.pop("processing"),) if "processing" in about else ()
    warnings: list[Notice] = []
    stated = _STATED.search(said)
    if stated:
        warnings.extend(counted(table[:, 0], int(stated[1]), name))
    step = next((value for line in header if (value := _step(line)) is not None), None)
    time = np.ascontiguousarray(table[:, 0]) if width == 2 else None
    if time is not None and any(_TIME_IN_MS.search(line) for line in header):
        time = time / 1e3
        processing = (*processing, "time read in ms")
    if time is not None and step is not None and time.size > 1:
        median = float(np.median(np.diff(time)))
        if abs(median - step) > 0.01 * step:
            warnings.append(Notice("record-step-differs", name=name, stated_s=step, found_s=median))
    record = RawRecord(
        np.ascontiguousarray(table[:, -1]),
        time=time,
        time_step=step if time is None else None,
        unit=_unit(header),
        about=about,
        processing=processing,
        warnings=tuple(warnings),
    )
    return [record]


def _unit(header: list[str]) -> str | None:
    """The unit a header states, or None where it states none or several: nothing is guessed.

    Lines that speak of units go before lines that speak of acceleration; what one g is worth is no unit.
    """
    for word in ("unit", "acc"):
        found = set()
        for line in header:
            if word in line.lower():
                text = _ONE_G.sub("", line.replace("²", "2"))
                found |= {unit for unit, pattern in _UNITS if re.search(pattern, text, re.IGNORECASE)}
        if found:
            return found.pop() if len(found) == 1 else None
    return None


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
