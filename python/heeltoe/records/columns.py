"""Plain columns: time and acceleration, or acceleration alone; a header in words or behind ``#`` if there is one.

Columns are parted by blanks, tabs, commas or semicolons. A header may state the unit and the step::

    # time step: 0.02 s
    # units: column 1 time [s], column 2 acceleration [g]
    time [s], acceleration [cm/s2]
"""

from __future__ import annotations

import re

import numpy as np

from heeltoe.errors import InputError
from heeltoe.records.raw import RawRecord, numbers

FORMAT = "columns"

_UNITS = (
    ("cm/s^2", r"cm\s*/\s*s(?:ec)?\s*(?:\^|\*\*)?\s*2|cm/s/s|cm s-2|\bgals?\b"),
    ("mm/s^2", r"mm\s*/\s*s(?:ec)?\s*(?:\^|\*\*)?\s*2"),
    ("m/s^2", r"(?<![cm])m\s*/\s*s(?:ec)?\s*(?:\^|\*\*)?\s*2|(?<![cm])m/s/s|(?<![cm])m s-2"),
    ("ft/s^2", r"ft\s*/\s*s(?:ec)?\s*(?:\^|\*\*)?\s*2"),
    ("in/s^2", r"in\s*/\s*s(?:ec)?\s*(?:\^|\*\*)?\s*2"),
    ("g", r"\[\s*g\s*\]|\(\s*g\s*\)|\bin g\b|units?\s*[:=]\s*g\b|accel\w*\s*,?\s+g\b"),
)
_ONE_G = re.compile(r"1\s*g\s*=[^)\]]*", re.IGNORECASE)
_STEP = re.compile(r"(?:time step|\bdt\b|delta t|step)\s*[:=]?\s*([\d.]+(?:e[-+]?\d+)?)\s*(ms|s\b|sec)?", re.IGNORECASE)
_STATED = re.compile(r"(?:number of points|points|npts|samples)\s*[:=]\s*(\d{1,12})\b", re.IGNORECASE)
_HEADER_LINES, _HEADER_WIDTH = 100, 400
_SEPARATORS = str.maketrans({",": " ", ";": " ", "\t": " "})
_ABOUT = re.compile(r"^(event|earthquake|station|component|date|processing)\s*[:=]\s*(.+)$", re.IGNORECASE)


def _is_data(line: str) -> bool:
    """Whether a line starts with something that wants to be a number."""
    word = line.translate(_SEPARATORS).split()[:1]
    return bool(word) and re.match(r"[-+]?\.?\d", word[0]) is not None


def _split(lines: list[str]) -> tuple[list[str], int]:
    """Header lines without their ``#``, and the index of the first line of data."""
    header: list[str] = []
    for k, line in enumerate(lines):
        text = line.strip()
        if text and not text.startswith(("#", "%", "//")) and _is_data(text):
            return header, k
        # What a header has to say it says early; a long one must not slow the search down.
        if k < _HEADER_LINES:
            header.append(text.lstrip("#%/ ").strip()[:_HEADER_WIDTH])
    return header, len(lines)


def matches(lines: list[str]) -> bool:
    """Whether there are lines of one or two numbers, alike, after a header of any kind."""
    _, first = _split(lines)
    data = [line for line in lines[first : first + 20] if line.strip()]
    if not data:
        return False
    widths = [len(line.translate(_SEPARATORS).split()) for line in data]
    # A line or two may be spoilt; the reader names them.
    return widths[0] in (1, 2) and widths.count(widths[0]) > len(widths) / 3


def read(lines: list[str], name: str) -> RawRecord:
    """Read a file that matches."""
    header, first = _split(lines)
    data = [line.split("#")[0].translate(_SEPARATORS) for line in lines[first:]]
    data = [line for line in data if line.strip()]
    width = len(data[0].split())
    for k, line in enumerate(data):
        if len(line.split()) != width:
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
    warnings = []
    stated = _STATED.search(said)
    if stated and int(stated[1]) != len(table):
        warnings.append(f"{name} states {stated[1]} values and has {len(table)}: all of them are used")
    step = _step(said)
    time = np.ascontiguousarray(table[:, 0]) if width == 2 else None
    if time is not None and step is not None and time.size > 1:
        median = float(np.median(np.diff(time)))
        if abs(median - step) > 0.01 * step:
            warnings.append(f"{name} states a step of {step:g} s, but its times are {median:g} s apart: they are used")
    return RawRecord(
        np.ascontiguousarray(table[:, -1]),
        time=time,
        time_step=step if time is None else None,
        unit=_unit(header),
        about=about,
        processing=processing,
        warnings=tuple(warnings),
    )


def _unit(header: list[str]) -> str | None:
    """The unit a header states, or None where it states none or several: nothing is guessed.

    Lines that speak of units go before lines that speak of acceleration; what one g is worth is no unit.
    """
    for word in ("unit", "acc"):
        found = set()
        for line in header:
            if word in line.lower():
                text = _ONE_G.sub("", line)
                found |= {unit for unit, pattern in _UNITS if re.search(pattern, text, re.IGNORECASE)}
        if found:
            return found.pop() if len(found) == 1 else None
    return None


def _step(said: str) -> float | None:
    found = _STEP.search(said)
    if not found:
        return None
    try:
        return float(found[1]) * (1e-3 if found[2] == "ms" else 1.0)
    except ValueError:
        return None
