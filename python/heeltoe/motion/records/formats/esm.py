"""ESM and ITACA ASC (DYNA 1.2), also of AFAD's newer records: one component, its labels, then a value to a line::

SAMPLING_INTERVAL_S: 0.005000
UNITS: cm/s^2
PGA_CM/S^2: 0.202093
DATA_TYPE: ACCELERATION
"""

from __future__ import annotations

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_data, labelled
from heeltoe.motion.records.raw import RawRecord, check_series, leading, numbers, stated, word_of_unit
from heeltoe.motion.start import moment_of

FORMAT = "ESM ASC"

_HEADER_LINES = 80
_LABEL = pattern(r"\s*[A-Z][A-Z0-9_/^]*:")


def matches(lines: list[str]) -> bool:
    """Whether the first lines bear the labels of the format."""
    header = labelled(lines, _HEADER_LINES)
    return "sampling_interval_s" in header and "data_type" in header


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    header = labelled(lines, _HEADER_LINES)
    quantity = header["data_type"].lower()
    if quantity != "acceleration":
        raise InputError("record-not-acceleration", name, quantity[:40] or "nameless")
    last = max(k for k, line in enumerate(lines[:_HEADER_LINES]) if _LABEL.match(line))
    first = find_data(lines, last + 1)
    values = numbers(lines[first:], name, first + 1)
    count, step = stated(header.get("ndata", "")), stated(header["sampling_interval_s"])
    unit = word_of_unit(header.get("units", ""))
    peak = leading(header.get("pga_cm/s^2", "")) if unit in ("cm/s^2", "gal") else ""
    baseline = header.get("baseline_correction", "")
    record = RawRecord(
        values,
        time_step=step if step and step > 0.0 else None,
        unit=unit,
        about={
            "event": header.get("event_name", ""),
            "date": " ".join(header.get(label, "") for label in ("event_date_yyyymmdd", "event_time_hhmmss")).strip(),
            "station": ".".join(header[label] for label in ("network", "station_code") if header.get(label)),
            "component": header.get("stream", ""),
        },
        processing=tuple(_processing(header)),
        warnings=check_series(values, name, count, peak),
        begins=moment_of(header.get("date_time_first_sample_yyyymmdd_hhmmss", "")),
        uncorrected=f"its header says {baseline.lower()}" if "not removed" in baseline.lower() else "",
    )
    return [record]


def _processing(header: dict[str, str]) -> list[str]:
    """Processing steps that the header states, without those that it leaves open."""
    low, high = header.get("low_cut_frequency_hz", ""), header.get("high_cut_frequency_hz", "")
    band = f"{header.get('filter_type', '')} {low} to {high} Hz".lower().strip() if low or high else ""
    return [
        step for step in (header.get("processing", ""), header.get("baseline_correction", "").lower(), band) if step
    ]
