"""CSMNC (China Strong Motion Network Centre): one component, some 16 lines of header, eight values to a line::

COMP. EW
UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC
NO. OF POINTS:  12000  EQUALLY SPACED INTERVALS OF:  0.005  SEC
PEAK VALUE:    -1005.350   AT   26.35 SEC    DURATION:  60 SEC
"""

from __future__ import annotations

import re

from heeltoe.errors import InputError
from heeltoe.motion.records.cells import is_data
from heeltoe.motion.records.raw import NUMBER, RawRecord, counted, numbers, peaked, plain, real, word_of_unit

FORMAT = "CSMNC"

_QUANTITY = re.compile(
    r"\s*(un)?(?:corrected|processed)?\s*(acceleration|velocity|displacement)\b.*\bunit:\s*(\S+)", re.IGNORECASE
)
_COUNT = re.compile(
    rf"\s*no\. of points:\s*(\d{{1,9}})\s+equally spaced intervals of:\s*({NUMBER})\s*sec", re.IGNORECASE
)
_PEAK = re.compile(rf"\s*peak value:\s*({NUMBER})", re.IGNORECASE)
_COMPONENT, _STATION = (
    re.compile(r"\s*comp\.\s*(\S+)", re.IGNORECASE),
    re.compile(r"\s*station:\s*(\S+)", re.IGNORECASE),
)
_HEADER_LINES = 30


def matches(lines: list[str]) -> bool:
    """Whether header lines state quantity, count and step in the words of the format."""
    head = [line[:200] for line in lines[:_HEADER_LINES]]
    return any(map(_COUNT.match, head)) and any(map(_QUANTITY.match, head))


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    head = [line[:200] for line in lines[:_HEADER_LINES]]
    place, count = next((k, found) for k, line in enumerate(head) if (found := _COUNT.match(line)))
    quantity = next(found for line in head if (found := _QUANTITY.match(line)))
    if quantity[2].lower() != "acceleration":
        raise InputError("record-not-acceleration", name, quantity[2].lower())
    first = next((k for k in range(place + 1, len(lines)) if is_data(lines[k][:200])), len(lines))
    values = numbers(lines[first:], name, first + 1)
    warnings = counted(values, int(count[1]), name)
    peak = next((found for line in head if (found := _PEAK.match(line))), None)
    if peak:
        warnings += peaked(values, peak[1], name)
    record = RawRecord(
        values,
        time_step=real(count[2]),
        unit=word_of_unit(quantity[3]),
        about={
            "event": plain(head[2]) if place > 2 else "",
            "date": plain(head[1].partition(" ")[2]) if place > 2 else "",
            "station": next((found[1] for line in head if (found := _STATION.match(line))), ""),
            "component": next((found[1] for line in head if (found := _COMPONENT.match(line))), ""),
        },
        warnings=warnings,
        uncorrected="its header says so" if quantity[1] else "",
    )
    return [record]
