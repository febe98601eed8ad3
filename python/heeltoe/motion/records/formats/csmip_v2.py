"""CSMIP V2 (CDMG, CGS): several channels in one file, of each the corrected acceleration, velocity and displacement.

A channel has 25 lines of text, 100 integers, 100 reals and three series, each behind a line that says what it is::

     3251 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)
    15050 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.6)

and ends with ``/&  ----------  END OF DATA FOR CHANNEL  1  ----------``.
"""

from __future__ import annotations

import re
from dataclasses import replace

from heeltoe.base.pattern import pattern
from heeltoe.motion.records.lines import find_line, find_match, plain
from heeltoe.motion.records.raw import NUMBER, RawRecord, breaks_off, check_series, numbers, real, word_of_unit
from heeltoe.warnings.notice import Notice

FORMAT = "CSMIP V2"

_ACCELERATION = pattern(
    rf"\s*(\d+) points of acc\w* data equally.spaced at\s+({NUMBER})\s*sec[.,]*\s*(?:\(units:|in)\s*([a-z][\w/^]*)",
    re.IGNORECASE,
)
_END = pattern(r"\s*/&|.*(?:end of data| points of |corrected accelerogram)", re.IGNORECASE)
_CLOSED = pattern(r"\s*/&|.*end of data", re.IGNORECASE)
_FORMAT = pattern(r"\(\s*\d+\s*[a-z](\d{1,2})\.", re.IGNORECASE)
_CHANNEL = pattern(r"\bchan\s*(\d+):\s*(\S+(?: \S+)*)", re.IGNORECASE)
_FIRST = pattern(r"\s*corrected accelerogram", re.IGNORECASE)
_RAW = pattern(r"\s*uncorrected accelerogram", re.IGNORECASE)
_PEAK = pattern(rf"peak\s+acceleration\s*=\s*({NUMBER})\s*([a-z][\w/^]*)", re.IGNORECASE)
_FILTERED, _PROCESSED = pattern(r"\s*accelerogram .*filtered", re.IGNORECASE), pattern(r"processed:\s*\S", re.I)
_UNNAMED = pattern(r"re?co?rd of\s+(.+)", re.IGNORECASE)
# A header has 45 lines; the format is recognised by the line behind the first one.
_HEADER_LINES, _WIDTH = 60, 200


def matches(lines: list[str]) -> bool:
    """Whether a line announces accelerations in the words of the format; volume 1 has them too, uncorrected."""
    if any(_RAW.match(line[:_WIDTH]) for line in lines[:1]):
        return False
    return any(_ACCELERATION.match(line[:_WIDTH]) for line in lines[: 2 * _HEADER_LINES])


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read the accelerations of every channel of a file that matches."""
    starts = [k for k, line in enumerate(lines) if _ACCELERATION.match(line[:_WIDTH])]
    records = []
    for before, k in zip([-1, *starts], starts, strict=False):
        end = find_line(lines, _END, k + 1, len(lines))
        header = [line[:_WIDTH] for line in lines[max(before + 1, k - _HEADER_LINES) : k]]
        records.append(_channel(header, lines[k][:_WIDTH], lines[k + 1 : end], name, k + 2))
    if starts and not any(_CLOSED.match(line[:_WIDTH]) for line in lines[starts[-1] :]):
        records[-1] = replace(records[-1], warnings=(*records[-1].warnings, breaks_off(name)))
    opened = sum(_FIRST.match(line[:_WIDTH]) is not None for line in lines)
    if opened > len(records):
        lost = Notice("record-channels", name=name, opened=opened, found=len(records))
        records = [replace(record, warnings=(*record.warnings, lost)) for record in records]
    return records


def _channel(header: list[str], announced: str, data: list[str], name: str, first_line: int) -> RawRecord:
    series = _ACCELERATION.match(announced)
    assert series is not None
    form = _FORMAT.search(announced)
    values = numbers(data, name, first_line, int(form[1]) if form else 10)
    unit = word_of_unit(series[3])
    channels = [match for line in header if (match := _CHANNEL.search(line))]
    number, component = channels[-1].groups() if channels else ("", "")
    called = f"{name}, channel {number}" if number else name
    peak = find_match(_PEAK, map(str.strip, header))
    stated = peak[1] if peak and word_of_unit(peak[2]) == unit else ""
    filters = [plain(line) for line in header if _FILTERED.match(line)]
    processing = [plain(line[match.start() :]) for line in header if (match := _PROCESSED.search(line))][:1] + filters
    return RawRecord(
        values,
        time_step=real(series[2]),
        unit=unit,
        about={**_about(header), "component": component},
        processing=tuple(processing),
        warnings=check_series(values, called, real(series[1]), stated),
        channel=number,
    )


def _about(header: list[str]) -> dict[str, str]:
    """Event, date and station stand in the third, fourth and seventh line of text."""
    first = next((k for k, line in enumerate(header) if _FIRST.match(line)), None)
    if first is None or len(header) < first + 7:
        return {}
    event, date, station = (re.split(r"\s{2,}", header[first + k].strip())[0] for k in (2, 3, 6))
    if unnamed := _UNNAMED.match(event):
        event, date = "", unnamed[1]
    return {"event": event, "date": date, "station": station}
