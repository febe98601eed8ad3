"""CWA and CWB (Taiwan): time and three components side by side, in gal, below lines that begin with ``#``::

#StationCode: ABC
#StartTime(GMT+08): 1980/01/01-00:00:00.000
#RecordLength(sec): 60
#SampleRate(Hz): 200
#AmplitudeUnit:  gal. DCoffset(corr)
#AmplitudeMAX. U:   10.000~  -10.000
#DataSequence: Time U(+); N(+); E(+)
"""

from __future__ import annotations

import re

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_data, labelled
from heeltoe.motion.records.raw import NUMBER, RawRecord, leading, peaked, real, stated, table, word_of_unit
from heeltoe.motion.records.stated import number
from heeltoe.warnings.notice import Notice

FORMAT = "CWA, CWB (Taiwan)"

_COLUMN = pattern(r"\b([UNEVZ])\s*\(([+-])\)", re.IGNORECASE)
_PEAKS = pattern(rf"#amplitudemax\.?\s*([UNEVZ])\s*:\s*({NUMBER})\s*~\s*({NUMBER})", re.IGNORECASE)
_HEADER_LINES = 60
_WAYS = {"U": "up", "V": "up", "Z": "up", "N": "north", "E": "east"}


def matches(lines: list[str]) -> bool:
    """Whether the first lines bear the labels of the format."""
    header = labelled(lines, _HEADER_LINES)
    return "#datasequence" in header and "#samplerate(hz)" in header


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    header = labelled(lines, _HEADER_LINES)
    order, rate = header["#datasequence"], stated(header["#samplerate(hz)"])
    columns = _COLUMN.findall(order)
    unit = word_of_unit(header.get("#amplitudeunit", "").split(" ")[0].strip(".,; "))
    if not columns or not rate or rate <= 0.0:
        raise InputError("record-header", name, "sampling rate and order of columns")
    timed = order.lower().startswith("time")
    last = max(k for k, line in enumerate(lines[:_HEADER_LINES]) if line.startswith("#"))
    first = find_data(lines, last + 1)
    values = table(lines[first:], name, first + 1, len(columns) + timed)
    if values.shape[1] == 0:
        raise InputError("too-few", name, "0 samples", least="two")
    if timed and values.shape[1] > 1:
        _check_step(values[0], 1.0 / rate, name)
    length = number(leading(header.get("#recordlength(sec)", "")))
    peaks = {
        way.upper(): (high, low) for way, high, low in map(re.Match.groups, filter(None, map(_PEAKS.match, lines)))
    }
    corrected = "corr" in header.get("#amplitudeunit", "").lower()
    magnitude = header.get("#magnitude(ml)", "")
    records = []
    for (way, sign), column in zip(columns, values[int(timed) :], strict=True):
        warnings: tuple[Notice, ...] = ()
        if written := peaks.get(way.upper()):
            warnings = peaked(column, max(written, key=lambda text: abs(real(text))), name)
        records.append(
            RawRecord(
                column if sign == "+" else -column,
                time_step=1.0 / rate,
                unit=unit,
                about={
                    "event": f"magnitude {magnitude}" if magnitude else "",
                    "date": next((value for label, value in header.items() if label.startswith("#origin time")), ""),
                    "station": header.get("#stationcode", ""),
                    "component": _WAYS[way.upper()],
                },
                processing=("offset corrected, by its header",) if corrected else (),
                warnings=warnings,
                durations=(length,) if length else (),
            )
        )
    return records


def _check_step(time: Floats, step: float, name: str) -> None:
    """Refuse times that are not as far apart as the header says."""
    found = float((time[-1] - time[0]) / (time.size - 1))
    if not abs(found - step) <= 0.01 * step or not np.isfinite(time).all():
        raise InputError("record-step-differs", name, f"{step:g} s", found=f"{found:g} s")
