"""GeoNet V1A and V2A (New Zealand): three components one behind the other, in mm/s2 and columns of eight characters.

A component has 16 lines of text, 40 integers, 60 reals and, ten to a line, the accelerations, behind which V2A has
velocities and displacements::

    Number of points  8192    Duration 163.82 sec
    Instrument corrected data at 0.020 sec intervals
    Component N10E  Longitudinal Accelerometer Axis
    Acceleration:  peak   2364.6 mm/s/s at  48.14 sec     rms    292.2 mm/s/s
"""

from __future__ import annotations

import math
import re

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_match, find_text, plain, split_at
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, numbers, real

FORMAT = "GeoNet V1A, V2A"

_FIRST = pattern(r"\s*(un)?corrected accelerogram\s+\d{8}_\d{6}_", re.IGNORECASE)
_COUNT = pattern(r"\s*number of points\s+(\d{1,9})\b", re.IGNORECASE)
_STEP = pattern(rf"(?:at|intervals of)\s+({NUMBER})\s*s(?:ec)?\b", re.IGNORECASE)
_SCALE = pattern(rf"raw readings in units of\s+({NUMBER})\s*mm/s/s", re.IGNORECASE)
_PEAK = pattern(rf"\s*acceleration:\s*peak\s+({NUMBER})\s*mm/s/s", re.IGNORECASE)
_COMPONENT = pattern(r"\s*component\s+(\S+)", re.IGNORECASE)
_TEXT, _BLOCK, _ROW, _WIDTH = 16, 10, 10, 8


def matches(lines: list[str]) -> bool:
    """Whether the file opens in the words of the format."""
    return bool(lines) and _FIRST.match(lines[0][:200]) is not None


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read the accelerations of every component of a file that matches."""
    starts = [k for k, line in enumerate(lines) if _FIRST.match(line[:200])]
    return [_component(lines[start:stop], name, start) for start, stop in split_at(lines, starts)]


def _component(lines: list[str], name: str, before: int) -> RawRecord:
    text = [line[:200] for line in lines[:_TEXT]]
    opened = _FIRST.match(text[0])
    count = find_match(_COUNT, text)
    step = next((match for line in text[10:12] if (match := _STEP.search(line))), None)
    if opened is None or count is None or step is None:
        raise InputError("record-header", name, "number of points and step")
    rows = math.ceil(int(count[1]) / _ROW)
    first = _TEXT + _BLOCK
    values = numbers(lines[first : first + rows], name, before + first + 1, _WIDTH)
    if scale := find_text(_SCALE, text):
        values = values * real(scale)
    return RawRecord(
        values,
        time_step=real(step[1]),
        unit="mm/s^2",
        about={
            "event": plain(text[6]) if len(text) > 7 else "",
            "date": plain(text[7]) if len(text) > 7 else "",
            "station": plain(text[2]) if len(text) > 2 else "",
            "component": find_text(_COMPONENT, text),
        },
        processing=tuple(
            plain(line) for line in text if "filter" in line.lower() or "instrument corrected" in line.lower()
        ),
        warnings=check_series(values, name, int(count[1]), find_text(_PEAK, text)),
        uncorrected="its first line says so" if opened[1] else "",
    )
