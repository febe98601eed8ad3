"""COSMOS V2 (format 1.20): one section per channel and quantity, often several in one file.

A section has some 13 lines of text, a block of integers, a block of reals, comments behind ``|`` and one series::

    Corrected acceleration   (Format v01.20 with 13 text lines) Src: 15481673
    ...
     100 Real-header values follow on  20 lines, Format= (5F15.6)
    ...
       42000 acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(1E15.6)
    ...
    End-of-data for Chan  1 acceleration

Real 62 is the step of the series in milliseconds. Real 34, in seconds, is the recorder's: it may be another one.
"""

from __future__ import annotations

import re
from dataclasses import replace

from heeltoe.base.arrays import Floats
from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_line, plain, split_at
from heeltoe.motion.records.raw import (
    NUMBER,
    RawRecord,
    breaks_off,
    counted,
    doubtful,
    numbers,
    peaked,
    real,
    word_of_unit,
)
from heeltoe.warnings.notice import Notice

FORMAT = "COSMOS V2"

_SECTION = pattern(r"\s*(?:corrected|velocity|displacement)\b.*\(format v *[\d.]+", re.IGNORECASE)
_SERIES = pattern(r"\s*(\d+)\s+(acc|vel|dis)\w*\b.*\b(?:pts|points|data)\b", re.IGNORECASE)
_UNIT = pattern(r"units?\s*[=:]\s*([a-z][\w/^]*)", re.IGNORECASE)
_WIDTH = pattern(r"format\s*[=:]\s*\(\s*\d*\s*[a-z]\s*(\d{1,2})", re.IGNORECASE)
_SECONDS = pattern(rf"approx\.?\s+({NUMBER})\s*sec", re.IGNORECASE)
_REALS = pattern(r"\s*\d+\s+real-header values follow on\s+(\d{1,3})\s+lines", re.IGNORECASE)
_END = pattern(r"\s*(?:/&|end[- ]of[- ]data)", re.IGNORECASE)
_CHANNEL = pattern(r"\s*sta chan\s*(\S+?)\s*:\s*([^(]*)", re.IGNORECASE)
_CODE = pattern(r"\|\s*<scnl>\s*\w+\.(\w+)\.", re.IGNORECASE)
_STATION = pattern(r"\s*statn no:.*\bcode:\s*\S+\s+(.*)", re.IGNORECASE)
_EVENT = pattern(r"\s*re?co?rd of\s+(?:(.*?)\bearthquake\s+of\s+)?(.+)", re.IGNORECASE)
_PROCESSED = pattern(rf"\s*(processed:.*?)(?:,\s*max\s*=\s*({NUMBER})\s*([a-z][\w/^]*).*)?$", re.IGNORECASE)
_FILTERED = pattern(r"\s*record\b.*\bfiltered", re.IGNORECASE)
_LINE = 200


def matches(lines: list[str]) -> bool:
    """Whether one of the first lines opens a section of corrected data."""
    return any(_SECTION.match(line[:_LINE]) for line in lines[:5])


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read the accelerations of every channel of a file that matches."""
    starts = [k for k, line in enumerate(lines) if _SECTION.match(line[:_LINE])]
    records, others = [], []
    for start, stop in split_at(lines, starts):
        series = find_line(lines, _SERIES, start, stop)
        match = _SERIES.match(lines[series][:_LINE]) if series < stop else None
        if match is None:
            raise InputError("record-header", name, "series of numbers")
        quantity = match[2].lower()
        if quantity == "acc":
            # Velocity and displacement may follow without a header of their own.
            end = min(find_line(lines, _END, series + 1, stop), find_line(lines, _SERIES, series + 1, stop))
            values = numbers(lines[series + 1 : end], name, series + 2, _width(lines[series]))
            header = [line[:_LINE] for line in lines[start : series + 1]]
            records.append(_channel(header, values, real(match[1]), name, start + 1))
        else:
            others.append({"vel": "velocity", "dis": "displacement"}[quantity])
    if records and find_line(lines, _END, starts[-1], len(lines)) == len(lines):
        records[-1] = replace(records[-1], warnings=(*records[-1].warnings, breaks_off(name)))
    if not records:
        raise InputError("record-not-acceleration", name, others[0])
    return records


def _channel(header: list[str], values: Floats, count: float, name: str, first_line: int) -> RawRecord:
    announced = header[-1]
    unit = word_of_unit(match[1]) if (match := _UNIT.search(announced)) else None
    warnings = counted(values, count, name)
    number, about, processing = "", {"component": ""}, []
    for line in header:
        if match := _CHANNEL.match(line):
            number = match[1] if match[1].isdecimal() else ""
            about["component"] = match[2].strip() if match[2].strip().lower() != "other" else ""
        elif (match := _CODE.match(line)) and not about["component"]:
            about["component"] = match[1]
        elif match := _STATION.match(line):
            about["station"] = re.split(r"\s{2,}", match[1].strip())[-1]
        elif match := _PROCESSED.match(line):
            processing.append(plain(match[1]))
            if match[2] and word_of_unit(match[3]) == unit:
                warnings += peaked(values, match[2], name)
        elif _FILTERED.match(line):
            processing.append(plain(line))
        elif "date" not in about and (match := _EVENT.match(line)):
            about["event"] = f"{match[1].strip()} earthquake" if match[1] else ""
            about["date"] = plain(match[2])
    step, doubt = _step(_reals(header, name, first_line), count, announced, name)
    return RawRecord(
        values,
        time_step=step,
        unit=unit,
        about=about,
        processing=tuple(processing),
        warnings=warnings + doubt,
        channel=number,
    )


def _width(announced: str) -> int:
    return int(match[1]) if (match := _WIDTH.search(announced[:_LINE])) else 10


def _reals(header: list[str], name: str, first_line: int) -> Floats:
    for k, line in enumerate(header):
        if match := _REALS.match(line):
            return numbers(header[k + 1 : k + 1 + int(match[1])], name, first_line + k + 1, _width(line))
    raise InputError("record-header", name, "real header")


def _step(reals: Floats, count: float, announced: str, name: str) -> tuple[float | None, tuple[Notice, ...]]:
    """The step [s] and what is doubtful about it: of the two that may be stated, the one the duration agrees with."""
    stated = [float(reals[k]) * scale for k, scale in ((61, 1e-3), (33, 1.0)) if k < reals.size and reals[k] > 0.0]
    seconds = _SECONDS.search(announced)
    if not stated or seconds is None:
        return next(iter(stated), None), ()
    duration = real(seconds[1])
    for step in stated:
        if abs(count * step - duration) <= 1.0 + 0.01 * duration:
            return step, ()
    text = "states a step of {step_s:g s}, {values:g} values and {duration_s:g s}: check it"
    doubt = doubtful(name, text, step_s=stated[0], values=count, duration_s=duration)
    return stated[0], (doubt,)
