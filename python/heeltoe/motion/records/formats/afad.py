"""AFAD (Turkish network, text of the older archive): three components side by side, in gal::

STRONG GROUND MOTION RECORDS OF TURKIYE
NUMBER OF DATA          : 28683
SAMPLING INTERVAL (sec) : 0.01
RAW PGA VALUES (gal)    : (N-S) 13.200332 (E-W) 12.163827 (U-D) 9.840572
       N-S          E-W          U-D
"""

from __future__ import annotations

import re

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import labelled
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, stated, table

FORMAT = "AFAD"

_FIRST = pattern(r"\s*strong ground motion records of turk", re.IGNORECASE)
_PEAK = pattern(rf"\(([NSEWUD]-[NSEWUD])\)\s*({NUMBER})", re.IGNORECASE)
_HEADER_LINES = 40


def matches(lines: list[str]) -> bool:
    """Whether the file opens in the words of the format."""
    return any(_FIRST.match(line[:200]) for line in lines[:3])


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    header = labelled(lines, _HEADER_LINES)
    ways = next((k for k, line in enumerate(lines[:_HEADER_LINES]) if line.split() == ["N-S", "E-W", "U-D"]), None)
    count, step = stated(header.get("number of data", "")), stated(header.get("sampling interval (sec)", ""))
    if ways is None or count is None or not step:
        raise InputError("record-header", name, "components, number of data or sampling interval")
    peaks = next((value for label, value in header.items() if "pga values (gal)" in label), "")
    peak_of = {way.upper(): peak for way, peak in _PEAK.findall(peaks)}
    raw = any(label.startswith("raw pga") for label in header)
    magnitude = header.get("earthquake magnitude", "")
    return [
        RawRecord(
            values,
            time_step=step,
            unit="gal",
            about={
                "event": f"magnitude {magnitude} at {header.get('epicenter coordinates', '')}",
                "date": header.get("earthquake date", ""),
                "station": f"{header.get('station id', '')} {header.get('place', '')}".strip(),
                "component": way,
            },
            warnings=check_series(values, name, count, peak_of.get(way, "")),
            uncorrected="its header speaks of raw values" if raw else "",
        )
        for way, values in zip(("N-S", "E-W", "U-D"), table(lines[ways + 1 :], name, ways + 2, 3), strict=True)
    ]
