"""Volume 1 of BHRC (Iran) and of RENADIC (Chile): uncorrected components one behind the other, each closed by ``/&``.

Both have lines of text, 100 integers and 50 reals on seven lines each, and then the record, by BHRC as values ten to a
line, by RENADIC as pairs of time and value, both in tenths of g::

    * VOL1DS FILE:  5520/01                     UNCORRECTED ACCELEROGRAM DATA    PROCESSED: 05/24/2011
    COMP L1                                     CHAN  1: EW       (STA CHN:  1)
    NO. OF POINTS =  15616  DURATION = 78.080   UNITS OF UNCOR ACCEL ARE SEC AND G/10.  MAX  = -0.682 G, ...
"""

from __future__ import annotations

import re

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_line, find_match, plain, split_at
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, numbers, real
from heeltoe.warnings.notice import Notice

FORMAT = "volume 1 (BHRC, RENADIC)"

_BHRC = re.compile(r"\*?\s*vol1ds file", re.IGNORECASE)
_RENADIC, _OWNER = (
    re.compile(r"\s*uncorrected accelerogram data", re.IGNORECASE),
    re.compile(r"\brenadic\b", re.IGNORECASE),
)
_COUNT = re.compile(
    rf"\s*no\. of points\s*=\s*(\d{{1,9}})\s+(?:duration|record length)\s*=\s*({NUMBER})", re.IGNORECASE
)
_TENTHS = re.compile(r"\s*units\b.*\bg/10\b", re.IGNORECASE)
_PEAK = re.compile(rf"max\s*=\s*({NUMBER})\s*g\b", re.IGNORECASE)
_WAY = re.compile(r"\s*(?:comp\s+([LVT])\s*\d*|chan\s*(\d+):\s*(\S+))", re.IGNORECASE)
_AZIMUTH = re.compile(r"azimuth\s+l\s+(\d{1,3})\s+t\s+(\d{1,3})", re.IGNORECASE)
_END = re.compile(r"\s*/&")
_TEXT, _NUMBERS, _PAIR = 30, 14, 7


def matches(lines: list[str]) -> bool:
    """Whether the file opens in the words of one of them."""
    head = [line[:200] for line in lines[:12]]
    return bool(head) and (
        _BHRC.match(head[0]) is not None or (_RENADIC.match(head[0]) is not None and any(map(_OWNER.search, head)))
    )


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read every component of a file that matches."""
    starts = [k for k, line in enumerate(lines) if _BHRC.match(line[:200]) or _RENADIC.match(line[:200])]
    records = [_component(lines[start:stop], name, start) for start, stop in split_at(lines, starts)]
    if not any(_END.match(line) for line in lines[starts[-1] :]):
        records[-1].warnings += (Notice("record-breaks-off", name=name),)
    return records


def _component(lines: list[str], name: str, before: int) -> RawRecord:
    text = [line[:200] for line in lines[:_TEXT]]
    count = next((match for line in text if (match := _COUNT.match(line))), None)
    units = next((k for k, line in enumerate(text) if _TENTHS.match(line)), None)
    if count is None or units is None or not real(count[2]) > 0.0 or int(count[1]) == 0:
        raise InputError("record-header", name, "number of points, duration and unit of g/10")
    # A line of text stands behind that of the units.
    first = units + 2 + _NUMBERS
    last = find_line(lines, _END, first, len(lines))
    pairs = _RENADIC.match(text[0]) is not None
    table = numbers(lines[first:last], name, before + first + 1, _PAIR if pairs else 0)
    time, values = _pairs(table, name, before + first + 1) if pairs else (None, table)
    values = values / 10.0
    peak = _PEAK.search(text[units])
    way = find_match(_WAY, text)
    return RawRecord(
        values,
        time=time,
        time_step=real(count[2]) / int(count[1]) if time is None else None,
        unit="g",
        about={"component": _direction(way, text), **_about(text, pairs)},
        warnings=check_series(values, name, int(count[1]), peak[1] if peak else ""),
        channel=(way[2] or "") if way else "",
        uncorrected="it is of volume 1, as the instrument gave it",
    )


def _pairs(values: Floats, name: str, line: int) -> tuple[Floats, Floats]:
    if values.size % 2:
        raise InputError("record-ragged", name, f"{values.size} numbers", line=line, width=2)
    table = values.reshape(-1, 2)
    return np.ascontiguousarray(table[:, 0]), np.ascontiguousarray(table[:, 1])


def _direction(way: re.Match[str] | None, text: list[str]) -> str:
    """Longitudinal and transverse components by their azimuths, where these are stated."""
    if way is None:
        return ""
    if way[1] is None:
        return str(way[3])
    azimuth = next((match for line in text if (match := _AZIMUTH.search(line))), None)
    letter = way[1].upper()
    if letter == "V" or azimuth is None:
        return letter
    return f"{azimuth[1 if letter == 'L' else 2]} deg"


def _about(text: list[str], renadic: bool) -> dict[str, str]:
    if renadic and len(text) > 5:
        event, date, station = (plain(text[k].partition("(")[0]) for k in (1, 2, 5))
        return {"event": event, "date": date, "station": station}
    origin = next((plain(line.partition(":")[2]) for line in text if line.lower().startswith("origin time")), "")
    station = next((plain(line.partition("Station")[0]) for line in text if _AZIMUTH.search(line)), "")
    return {"event": "", "date": origin, "station": station}
