"""ESM and ITACA ASC (DYNA 1.2), also of AFAD's newer records: one component, its labels, then a value to a line::

SAMPLING_INTERVAL_S: 0.005000
UNITS: cm/s^2
PGA_CM/S^2: 0.202093
DATA_TYPE: ACCELERATION
"""

from __future__ import annotations

import re

from heeltoe.errors import InputError
from heeltoe.motion.records.cells import is_data
from heeltoe.motion.records.raw import RawRecord, counted, labelled, leading, numbers, peaked, stated, word_of_unit

FORMAT = "ESM ASC"

_HEADER_LINES = 80
_LABEL = re.compile(r"\s*[A-Z][A-Z0-9_/^]*:")


def matches(lines: list[str]) -> bool:
    """Whether the first lines bear the labels of the format."""
    said = labelled(lines, _HEADER_LINES)
    return "sampling_interval_s" in said and "data_type" in said


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    said = labelled(lines, _HEADER_LINES)
    quantity = said["data_type"].lower()
    if quantity != "acceleration":
        raise InputError("record-not-acceleration", name, quantity[:40] or "nameless")
    last = max(k for k, line in enumerate(lines[:_HEADER_LINES]) if _LABEL.match(line))
    first = next((k for k in range(last + 1, len(lines)) if is_data(lines[k][:200])), len(lines))
    values = numbers(lines[first:], name, first + 1)
    count, step = stated(said.get("ndata", "")), stated(said["sampling_interval_s"])
    warnings = counted(values, count, name) if count is not None else ()
    unit = word_of_unit(said.get("units", ""))
    peak = leading(said.get("pga_cm/s^2", ""))
    if peak and unit in ("cm/s^2", "gal"):
        warnings += peaked(values, peak, name)
    baseline = said.get("baseline_correction", "")
    record = RawRecord(
        values,
        time_step=step if step and step > 0.0 else None,
        unit=unit,
        about={
            "event": said.get("event_name", ""),
            "date": " ".join(said.get(label, "") for label in ("event_date_yyyymmdd", "event_time_hhmmss")).strip(),
            "station": ".".join(said[label] for label in ("network", "station_code") if said.get(label)),
            "component": said.get("stream", ""),
        },
        processing=tuple(_processing(said)),
        warnings=warnings,
        uncorrected=f"its header says {baseline.lower()}" if "not removed" in baseline.lower() else "",
    )
    return [record]


def _processing(said: dict[str, str]) -> list[str]:
    """What the header says was done, without what it leaves open."""
    low, high = said.get("low_cut_frequency_hz", ""), said.get("high_cut_frequency_hz", "")
    band = f"{said.get('filter_type', '')} {low} to {high} Hz".lower().strip() if low or high else ""
    return [each for each in (said.get("processing", ""), said.get("baseline_correction", "").lower(), band) if each]
