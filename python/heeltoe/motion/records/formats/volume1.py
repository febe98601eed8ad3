"""Volume 1 of CSMIP and USC (California), BHRC (Iran) and RENADIC (Chile): uncorrected components one behind the other,
each closed by ``/&`` except by USC.

All have lines of text, 100 integers and 50 reals on seven lines each, and then the record in g or tenths of it: by BHRC
as values ten to a line, by recent CSMIP in equal steps behind a line that says so, by the others as pairs of time and
value in columns that may touch::

    UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 05/24/2011
    CHAN  1: 90 DEG
    NO. OF POINTS =  15616  RECORD LENGTH = 78.080 SEC
    UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = -0.682 G, AT  11.576 SEC.
    ...
     13200 Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)
"""

from __future__ import annotations

import re

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_line, find_match, plain, split_at
from heeltoe.motion.records.raw import NUMBER, RawRecord, breaks_off, check_series, numbers, real, word_of_unit

FORMAT = "volume 1 (CSMIP, USC, BHRC, RENADIC)"

_BHRC = pattern(r"\*?\s*vol1ds file", re.IGNORECASE)
_CSMIP = pattern(r"\s*uncorrected accelerogram data", re.IGNORECASE)
_RECORDED = pattern(r"re?co?rd of\s+(.+)", re.IGNORECASE)
_USC = pattern(r".*\bof uncorrected accelerogram data of vol", re.IGNORECASE)
_EQUAL = pattern(
    rf"\s*\d{{1,9}}\s+(?:accelerogram points at\s+(?P<rate>{NUMBER})\s*pts/sec\s+in units of"
    rf"|points of accel\w* data equally.spaced at\s+(?P<step>{NUMBER})\s*sec[.,]*\s*\(?units:?)"
    r"\s+(?P<unit>[a-z][\w/^]*)",
    re.IGNORECASE,
)
_FORMAT = pattern(r"\(\s*\d+\s*[a-z](\d{1,2})\.", re.IGNORECASE)
_COUNT = pattern(rf"\s*no\. of points\s*=\s*(\d{{1,9}})\s+(?:duration|record length)\s*=\s*({NUMBER})", re.IGNORECASE)
_UNITS = pattern(r"\s*units\b.*?\b(?:sec\w*\s+and|is)\s+g\b(?:\s*(/10)\b|(?!\s*/))", re.IGNORECASE)
_PEAK = pattern(rf"max\s*=\s*({NUMBER})\s*g\b", re.IGNORECASE)
_WAY = pattern(
    r"\s*(?:comp\s+([LVT])\s*\d*\s*$|chan\s*(\d+):\s*(\S+(?: deg\b)?)|comp\s+([A-Z]\w*)(?:\s+\d+)?\s*$)", re.IGNORECASE
)
_AZIMUTH = pattern(r"azimuth\s+l\s+(\d{1,3})\s+t\s+(\d{1,3})", re.IGNORECASE)
_END = pattern(r"\s*/&")
_TEXT, _NUMBERS, _PAIR = 30, 14, 7


def _is_opened(line: str) -> bool:
    return any(pattern.match(line[:200]) for pattern in (_BHRC, _CSMIP, _USC))


def matches(lines: list[str]) -> bool:
    """Whether the file opens in the words of one of them, and states count and length in theirs."""
    return bool(lines) and _is_opened(lines[0]) and any(_COUNT.match(line[:200]) for line in lines[:_TEXT])


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read every component of a file that matches."""
    starts = [k for k, line in enumerate(lines) if _is_opened(line)]
    records = [_component(lines[start:stop], name, start) for start, stop in split_at(lines, starts)]
    closes = _USC.match(lines[0]) is None
    if closes and not any(_END.match(line) for line in lines[starts[-1] :]):
        records[-1].warnings += (breaks_off(name),)
    return records


def _component(lines: list[str], name: str, before: int) -> RawRecord:
    text = [line[:200] for line in lines[:_TEXT]]
    count = next((match for line in text if (match := _COUNT.match(line))), None)
    units = next(((k, match) for k, line in enumerate(text) if (match := _UNITS.match(line))), None)
    if count is None or units is None or not real(count[2]) > 0.0 or int(count[1]) == 0:
        raise InputError("record-header", name, "number of points, duration and unit of g or g/10")
    # A line of text stands behind that of the units.
    first = units[0] + 2 + _NUMBERS
    equal = _EQUAL.match(lines[first][:200]) if first < len(lines) else None
    first += equal is not None
    last = find_line(lines, _END, first, len(lines))
    step, unit = real(count[2]) / int(count[1]), "g"
    if equal is not None:
        width = _FORMAT.search(lines[first - 1][:200])
        values = numbers(lines[first:last], name, before + first + 1, int(width[1]) if width else 0)
        time, unit = None, equal["unit"]
        rate = real(equal["rate"]) if equal["rate"] else 0.0
        step = 1.0 / rate if rate > 0.0 else real(equal["step"]) if equal["step"] else step
    elif _BHRC.match(text[0]):
        time, values = None, numbers(lines[first:last], name, before + first + 1)
    else:
        time, values = _pairs(numbers(lines[first:last], name, before + first + 1, _PAIR), name, before + first + 1)
    if units[1][1] and equal is None:
        values = values / 10.0
    peak = _PEAK.search(text[units[0]])
    way = find_match(_WAY, text)
    return RawRecord(
        values,
        time=time,
        time_step=step if time is None else None,
        unit=word_of_unit(unit),
        about={"component": _direction(way, text), **_about(text)},
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
        return str(way[3] or way[4])
    azimuth = next((match for line in text if (match := _AZIMUTH.search(line))), None)
    letter = way[1].upper()
    if letter == "V" or azimuth is None:
        return letter
    return f"{azimuth[1 if letter == 'L' else 2]} deg"


def _about(text: list[str]) -> dict[str, str]:
    if _BHRC.match(text[0]) is None and len(text) > 5:
        # USC ends its lines with their lengths.
        event, date, station = (plain(re.sub(r"\s{2,}.*", "", text[k].partition("(")[0].rstrip())) for k in (1, 2, 5))
        if recorded := _RECORDED.match(event):
            event, date = "", recorded[1]
        return {"event": event, "date": date, "station": station}
    origin = next((plain(line.partition(":")[2]) for line in text if line.lower().startswith("origin time")), "")
    station = next((plain(line.partition("Station")[0]) for line in text if _AZIMUTH.search(line)), "")
    return {"event": "", "date": origin, "station": station}
