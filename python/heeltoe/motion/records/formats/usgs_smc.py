"""USGS SMC: one accelerogram in cm/s2, corrected or as the instrument gave it.

11 lines of text, 48 integers on six lines, 50 reals on ten, comments behind ``|``, then the data, eight to a line in
columns of ten that may touch (``-1.2518E+1 1.5642E+0-8.8063E+0``). Unknown ones are -32768, or 1.7e38. Data without a
rate are pairs of time and value.
"""

from __future__ import annotations

import re

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_text, plain
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, doubtful, numbers

FORMAT = "USGS SMC"

_FIRST = pattern(r"\s*\d?\s*((?:un)?corrected accelerogram|velocity|displacement)\s*$", re.IGNORECASE)
_EVENT = pattern(r"\s*(\d{4})\s+(\d\d?)\s+(\d\d?)(?:\s+(\d{4}))?\s+(.*)")
_STATION = pattern(r"\s*station\s*=\s*(.*?)\s*component\s*=\s*(.*)", re.IGNORECASE)
_PEAK = pattern(rf".*\bpk(?:\s+acc)?\s*=\s*({NUMBER})", re.IGNORECASE)
_TEXT, _INTEGERS, _REALS = slice(0, 11), slice(11, 17), slice(17, 27)
_UNKNOWN = -32768
# Fewer times than this may grow by chance, and a smaller share of them.
_FEW, _MOSTLY = 20, 0.9
# Numbers in a row.
_ROW = 8
_LINE = 200


def matches(lines: list[str]) -> bool:
    """Whether the file opens in the words of the format; its second line is a star if it has nothing to say."""
    head = [line[:_LINE] for line in lines[_TEXT]]
    return _FIRST.match(head[0]) is not None and (
        any(line.strip() == "*" for line in head) or any(_STATION.match(line) for line in head)
    )


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    text = [line[:_LINE] for line in lines[_TEXT]]
    kind = _FIRST.match(text[0])
    assert kind is not None
    if kind[1].lower() in ("velocity", "displacement"):
        raise InputError("record-not-acceleration", name, kind[1].lower())
    integers, reals = numbers(lines[_INTEGERS], name, 12), numbers(lines[_REALS], name, 18)
    if integers.size < 48 or reals.size < 50:
        raise InputError("record-header", name, "48 integers and 50 reals")
    first = next((k for k in range(_REALS.stop, len(lines)) if not lines[k].startswith("|")), len(lines))
    values = numbers(lines[first:], name, first + 1, 10)
    count = integers[16] if integers[16] != _UNKNOWN else None
    # A rate that is unknown is 1.7e38.
    step = 1.0 / float(reals[1]) if 0.0 < reals[1] < 1e5 else None
    timed = step is None and _has_times(values)
    # Some of these files have a row more than they state, whose times go back.
    left = int(values.size - count) if timed and count is not None and 0 < values.size - count <= _ROW else 0
    values = values[: values.size - left]
    pairs = values[: values.size // 2 * 2].reshape(-1, 2)
    flagged = (doubtful(name, "flags a problem with its data: see its comments"),) if integers[17] == 1 else ()
    # Both numbers of a pair count.
    counts = check_series(values, name, count)
    accelerations = np.ascontiguousarray(pairs[:, 1]) if timed else values
    warnings = (*counts, *flagged, *check_series(accelerations, name, None, find_text(_PEAK, text)))
    record = RawRecord(
        accelerations,
        time=np.ascontiguousarray(pairs[:, 0]) if timed else None,
        time_step=step,
        unit="cm/s^2",
        about=_about(text, integers),
        processing=(
            *(("corrected accelerogram",) if kind[1].lower().startswith("corr") else ()),
            *((f"{left} numbers behind the stated {count:g} left out",) if left else ()),
        ),
        warnings=warnings,
        uncorrected="its first line says so" if kind[1].lower().startswith("un") else "",
    )
    return [record]


def _has_times(values: Floats) -> bool:
    """Whether times stand before the values, as the instrument gave them: nothing else grows nearly all through."""
    times = values[::2]
    return times.size > _FEW and float((np.diff(times) >= 0.0).mean()) > _MOSTLY


def _about(text: list[str], integers: Floats) -> dict[str, str]:
    about = {"component": _direction(integers)}
    for line in text:
        if match := _STATION.match(line):
            about["station"] = plain(match[1]).rstrip(",")
            about["component"] = plain(match[2]) or about["component"]
        elif match := _EVENT.match(line):
            year, month, day, minute, event = match.groups("")
            about["date"] = f"{year}-{month:0>2}-{day:0>2} {minute}".strip()
            about["event"] = plain(event)
    return about


def _direction(integers: Floats) -> str:
    """The direction the integers state: degrees from the vertical, then from north."""
    vertical, horizontal = integers[12:14]
    if vertical in (0, 180):
        return "up" if vertical == 0 else "down"
    return f"{horizontal:g}" if horizontal != _UNKNOWN else ""
