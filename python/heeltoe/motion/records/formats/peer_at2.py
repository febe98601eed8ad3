"""PEER AT2: four header lines, then accelerations in g, several to a line.

The fourth line states count and step, in the words of its year::

    NPTS=   5372, DT=   .0100 SEC,                   (NGA)
    NPTS=  1559, DT= .02000 SEC                      (before NGA)
    4000    0.0100    NPTS, DT                       (1999)

and the third may go on after the unit: ``IN UNITS OF G. FILTER POINTS: HP=0.2 Hz  LP=15.0 Hz``.
"""

from __future__ import annotations

import re

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import unglued
from heeltoe.motion.records.raw import NUMBER, RawRecord, counted, doubtful, numbers, real, word_of_unit

FORMAT = "PEER AT2"

_COUNTS = (
    pattern(rf"NPTS\s*=\s*({NUMBER})\s*,?\s*DT\s*=\s*({NUMBER})", re.IGNORECASE),
    pattern(rf"^\s*({NUMBER})\s*,?\s+({NUMBER})\s*,?\s*NPTS\s*,\s*DT", re.IGNORECASE),
)
# The line with the counts is the fourth; some distributors add or drop a line.
_HEADER_LINES, _HEADER_WIDTH = 12, 400


def _counts(lines: list[str]) -> tuple[int, str, str] | None:
    for k, line in enumerate(lines[:_HEADER_LINES]):
        for count in _COUNTS:
            if match := count.search(line[:_HEADER_WIDTH]):
                return k, match[1], match[2]
    return None


def matches(lines: list[str]) -> bool:
    """Whether a header line states count and step in PEER's words."""
    return _counts(lines) is not None


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    match = _counts(lines)
    assert match is not None
    k, count_text, step_text = match
    header = [line.strip()[:_HEADER_WIDTH] for line in lines[:k] if line.strip()]
    words = " ".join(header).lower()
    # Only with what follows: a station may be called Velocity Park.
    if other := re.search(r"(velocity|displacement)\s+time\s+(?:series|history)", words):
        raise InputError("record-not-acceleration", name, other[1])
    values = numbers(lines[k + 1 :], name, k + 2)
    warnings = [*counted(values, real(count_text), name)]
    if _torn(lines[k + 1 :]):
        warnings.append(doubtful(name, "ends in the middle of a number: its last value may be wrong"))
    record = RawRecord(
        values,
        time_step=real(step_text),
        unit=_unit(words),
        about=_about(header),
        processing=_processing(words),
        warnings=tuple(warnings),
    )
    return [record]


def _unit(words: str) -> str | None:
    match = re.search(r"units? (?:of|are|in|:)\s*\(?\s*([a-z0-9/^*.]+)", words)
    return word_of_unit(match[1]) if match else None


def _processing(words: str) -> tuple[str, ...]:
    processing = ("PEER NGA processing",) if re.search(r"\bnga\b", words) else ()
    match = re.search(r"filter points?:\s*hp\s*=\s*[\d.]+\s*hz\s+lp\s*=\s*[\d.]+\s*hz", words)
    return (*processing, match[0]) if match else processing


def _torn(lines: list[str]) -> bool:
    """Whether the last number is shorter than those before it, where these are all of one length.

    The start of -.1234E-02 is a number too, and a hundred times larger.
    """
    tail = [line for line in lines[-50:] if line.strip()][-3:]
    lengths = [len(word.lstrip("+-")) for word in unglued(" ".join(tail)).split()]
    return len(lengths) > 3 and len(set(lengths[:-1])) == 1 and lengths[-1] < lengths[0]


def _about(header: list[str]) -> dict[str, str]:
    """The second line is "event, date, station, component" (NGA) or "event date time, station, component" (1999)."""
    for line in header[1:]:
        parts = [part.strip() for part in line.split(",")]
        if len(parts) >= 4 and re.search(r"\d", parts[1]):
            return {
                "event": parts[0],
                "date": parts[1],
                "station": ", ".join(parts[2:-1]),
                "component": parts[-1],
            }
        if len(parts) == 3 and (match := re.search(r"\s\d+/\d+/\d+.*$", parts[0])):
            component, _, owner = parts[2].partition("(")
            return {
                "event": parts[0][: match.start()].strip(),
                "date": match[0].strip(),
                "station": f"{parts[1]} ({owner}" if owner else parts[1],
                "component": component.strip(),
            }
    return {"event": header[0]} if header and "PEER" not in header[0].upper() else {}
