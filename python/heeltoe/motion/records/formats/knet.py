"""K-NET and KiK-net ASCII (NIED): 17 lines of header, then counts of the digitiser, eight to a line.

A label fills 18 characters, the value follows::

    Sampling Freq(Hz) 100Hz
    Dir.              N-S
    Scale Factor      3920(gal)/6182761

Counts times the scale factor are gal. They carry the offset of the instrument: as NIED does for the peak that the
header states, the mean is taken out.
"""

from __future__ import annotations

import re

import numpy as np

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_data
from heeltoe.motion.records.raw import NUMBER, RawRecord, check_series, doubtful, numbers, real
from heeltoe.motion.start import moment_of

FORMAT = "K-NET"

_LABEL = 18
_BOREHOLE = (
    "was recorded in a borehole: a motion within the ground contains waves that the surface above reflects, and an "
    "analysis uses it as the motion at the surface of the rock"
)
_SIGNS = ("origin time", "scale factor")
_SCALE = pattern(rf"({NUMBER})\s*\(gal\)\s*/\s*({NUMBER})", re.IGNORECASE)
# A sensor of KiK-net in the borehole, and one at the surface above it.
_KIKNET = {
    "1": "N-S borehole",
    "2": "E-W borehole",
    "3": "U-D borehole",
    "4": "N-S surface",
    "5": "E-W surface",
    "6": "U-D surface",
}


def matches(lines: list[str]) -> bool:
    """Whether the first lines bear the labels of the format."""
    head = [line[:_LABEL].strip().lower() for line in lines[:20]]
    return any(label in _SIGNS for label in head) and any(line.lower().startswith("dir.") for line in head)


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    first = find_data(lines)
    header = {line[:_LABEL].strip().lower(): line[_LABEL:200].strip() for line in lines[: min(first, 40)]}
    scale = _SCALE.match(header.get("scale factor", ""))
    if scale is None or real(scale[2]) == 0.0:
        raise InputError("record-header", name, "scale factor")
    counts = numbers(lines[first:], name, first + 1)
    if counts.size == 0:
        raise InputError("too-few", name, "0 samples", least="two")
    with np.errstate(over="ignore", invalid="ignore"):
        values = counts * (real(scale[1]) / real(scale[2]))
        offset = float(values.mean())
        values = values - offset
    frequency = re.match(rf"({NUMBER})\s*hz", header.get("sampling freq(hz)", ""), re.IGNORECASE)
    rate = real(frequency[1]) if frequency else 0.0
    duration, peak = (
        re.fullmatch(NUMBER, header.get(label, ""), re.IGNORECASE) for label in ("duration time(s)", "max. acc. (gal)")
    )
    count = real(duration[0]) * rate if duration and rate > 0.0 else None
    # Rounding of the mean, and of the counts.
    warnings = check_series(values, name, count, peak[0] if peak else "", share=0.01)
    if "borehole" in _KIKNET.get(header.get("dir.", ""), ""):
        warnings += (doubtful(name, _BOREHOLE),)
    record = RawRecord(
        values,
        time_step=1.0 / rate if rate > 0.0 else None,
        unit="gal",
        about=_about(header),
        processing=(f"mean of {offset:.5g} gal taken out",),
        warnings=warnings,
        begins=moment_of(header.get("record time", "")),
    )
    return [record]


def _about(header: dict[str, str]) -> dict[str, str]:
    direction = header.get("dir.", "")
    place = [header[label] for label in ("lat.", "long.") if header.get(label)]
    magnitude = header.get("mag.")
    return {
        "event": f"magnitude {magnitude} at {', '.join(place)}" if magnitude and place else "",
        "date": header.get("origin time", ""),
        "station": header.get("station code", ""),
        "component": _KIKNET.get(direction, direction),
    }
