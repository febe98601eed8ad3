"""CSMNC (China Strong Motion Network Centre): one component, some 16 lines of header, eight values to a line::

COMP. EW
UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC
NO. OF POINTS:  12000  EQUALLY SPACED INTERVALS OF:  0.005  SEC
PEAK VALUE:    -1005.350   AT   26.35 SEC    DURATION:  60 SEC
"""

from __future__ import annotations

import re

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_data, find_text, plain
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, numbers, real, word_of_unit

FORMAT = "CSMNC"

_QUANTITY = pattern(
    r"\s*(un)?(?:corrected|processed)?\s*(acceleration|velocity|displacement)\b.*\bunit:\s*(\S+)", re.IGNORECASE
)
_COUNT = pattern(rf"\s*no\. of points:\s*(\d{{1,9}})\s+equally spaced intervals of:\s*({NUMBER})\s*sec", re.IGNORECASE)
_PEAK = pattern(rf"\s*peak value:\s*({NUMBER})", re.IGNORECASE)
_COMPONENT, _STATION = (
    pattern(r"\s*comp\.\s*(\S+)", re.IGNORECASE),
    pattern(r"\s*station:\s*(\S+)", re.IGNORECASE),
)
_HEADER_LINES = 30


def matches(lines: list[str]) -> bool:
    """Whether header lines state quantity, count and step in the words of the format."""
    head = [line[:200] for line in lines[:_HEADER_LINES]]
    return any(map(_COUNT.match, head)) and any(map(_QUANTITY.match, head))


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    head = [line[:200] for line in lines[:_HEADER_LINES]]
    place, count = next((k, match) for k, line in enumerate(head) if (match := _COUNT.match(line)))
    quantity = next(match for line in head if (match := _QUANTITY.match(line)))
    if quantity[2].lower() != "acceleration":
        raise InputError("record-not-acceleration", name, quantity[2].lower())
    first = find_data(lines, place + 1)
    values = numbers(lines[first:], name, first + 1)
    record = RawRecord(
        values,
        time_step=real(count[2]),
        unit=word_of_unit(quantity[3]),
        about={
            "event": plain(head[2]) if place > 2 else "",
            "date": plain(head[1].partition(" ")[2]) if place > 2 else "",
            "station": find_text(_STATION, head),
            "component": find_text(_COMPONENT, head),
        },
        warnings=check_series(values, name, int(count[1]), find_text(_PEAK, head)),
        uncorrected="its header says so" if quantity[1] else "",
    )
    return [record]
