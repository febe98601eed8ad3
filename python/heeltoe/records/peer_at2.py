"""PEER AT2: four header lines, then accelerations in g, several to a line.

The fourth line states count and step, in the words of its year::

    NPTS=   5372, DT=   .0100 SEC,                   (NGA)
    NPTS=  1559, DT= .02000 SEC                      (before NGA)
    4000    0.0100    NPTS, DT                       (1999)
"""

from __future__ import annotations

import re

from heeltoe.errors import InputError
from heeltoe.records.raw import RawRecord, numbers

FORMAT = "PEER AT2"

_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[ED][-+]?\d+)?)"
_COUNTS = (
    re.compile(rf"NPTS\s*=\s*{_NUMBER}\s*,?\s*DT\s*=\s*{_NUMBER}", re.IGNORECASE),
    re.compile(rf"^\s*{_NUMBER}\s*,?\s+{_NUMBER}\s*,?\s*NPTS\s*,\s*DT", re.IGNORECASE),
)
# The line with the counts is the fourth; some distributors add or drop a line.
_HEADER_LINES, _HEADER_WIDTH = 12, 400


def _counts(lines: list[str]) -> tuple[int, str, str] | None:
    for k, line in enumerate(lines[:_HEADER_LINES]):
        for pattern in _COUNTS:
            if found := pattern.search(line[:_HEADER_WIDTH]):
                return k, found[1], found[2]
    return None


def matches(lines: list[str]) -> bool:
    """Whether a header line states count and step in PEER's words."""
    return _counts(lines) is not None


def read(lines: list[str], name: str) -> RawRecord:
    """Read a file that matches."""
    found = _counts(lines)
    assert found is not None
    k, count_text, step_text = found
    header = [line.strip()[:_HEADER_WIDTH] for line in lines[:k] if line.strip()]
    words = " ".join(header).lower()
    if "velocity" in words or "displacement time" in words:
        raise InputError("record-not-acceleration", name, "velocity" if "velocity" in words else "displacement")
    values = numbers(lines[k + 1 :], name, k + 2)
    stated = float(count_text.upper().replace("D", "E"))
    warnings = []
    if stated != values.size:
        warnings.append(f"{name} states {stated:g} values and has {values.size}: all of them are used")
    return RawRecord(
        values,
        time_step=float(step_text.upper().replace("D", "E")),
        unit=_unit(words),
        about=_about(header),
        processing=("PEER NGA processing",) if "nga" in words else (),
        warnings=tuple(warnings),
    )


def _unit(words: str) -> str | None:
    found = re.search(r"units? (?:of|are|in|:)\s*\(?\s*([a-z0-9/^*.]+)", words)
    return found[1] if found else None


def _about(header: list[str]) -> dict[str, str]:
    """NGA and PEER 1999 write "event, date, station, component" in the second line."""
    for line in header[1:]:
        parts = [part.strip() for part in line.split(",")]
        if len(parts) >= 4 and re.search(r"\d", parts[1]):
            return {
                "event": parts[0],
                "date": parts[1],
                "station": ", ".join(parts[2:-1]),
                "component": parts[-1],
            }
    return {"event": header[0]} if header and "PEER" not in header[0].upper() else {}
