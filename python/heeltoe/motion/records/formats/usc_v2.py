"""USC volume 2 (Los Angeles strong-motion network): corrected acceleration, velocity and displacement of one component.

25 lines of text, 100 integers, 100 reals, then three series, each behind a line that says what it is::

    PEAK ACCELERATION =  -242.39450  CMS/SEC/SEC AT    4.580   SEC.
      1887 POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC/SEC
"""

from __future__ import annotations

import re

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_text, plain, split_at
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, numbers, real, word_of_unit

FORMAT = "USC V2"

_FIRST = pattern(r"\s*corrected accelerogram\b", re.IGNORECASE)
_SERIES = pattern(
    rf"\s*(\d+) points of (acc|vel|dis)\w* data equally spaced at\s+({NUMBER})\s*sec\W+in units\s+(\S+)", re.IGNORECASE
)
_PEAK = pattern(rf"\s*peak acceleration\s*=\s*({NUMBER})\s*cms?/sec/sec", re.IGNORECASE)
_COMPONENT = pattern(r"\s*comp\s+(\S+)\s*\d*\s*$", re.IGNORECASE)
_STATION = pattern(r"\s*station\s+(usc#\s*\d+)", re.IGNORECASE)
_FILTERED = pattern(r"\s*accelerogram is .*filtered.*", re.IGNORECASE)
_HEADER_LINES, _LINE = 80, 200


def matches(lines: list[str]) -> bool:
    """Whether the file opens in the words of the format and announces a series in them."""
    head = [line[:_LINE] for line in lines[:_HEADER_LINES]]
    return bool(head) and _FIRST.match(head[0]) is not None and any(map(_SERIES.match, head))


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read the acceleration of a file that matches."""
    starts = [k for k, line in enumerate(lines) if _SERIES.match(line[:_LINE])]
    records = []
    for start, stop in split_at(lines, starts):
        series = _SERIES.match(lines[start][:_LINE])
        assert series is not None
        if series[2].lower() != "acc":
            continue
        values = numbers(lines[start + 1 : stop], name, start + 2, 10)
        head = [line[:_LINE] for line in lines[: min(start, _HEADER_LINES)]]
        records.append(
            RawRecord(
                values,
                time_step=real(series[3]),
                unit=word_of_unit(series[4]),
                about={
                    "event": plain(head[2][:72]) if len(head) > 3 else "",
                    "date": plain(head[3][:72]) if len(head) > 3 else "",
                    "station": plain(find_text(_STATION, head)),
                    "component": find_text(_COMPONENT, head),
                },
                processing=tuple(plain(line) for line in head if _FILTERED.match(line)),
                warnings=check_series(values, name, int(series[1]), find_text(_PEAK, head)),
            )
        )
    if not records:
        raise InputError("record-not-acceleration", name, "velocity or displacement")
    return records
