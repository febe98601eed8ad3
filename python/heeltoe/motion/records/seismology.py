"""miniSEED and SAC, by obspy: the one with the sensitivity of its instrument from a StationXML, the other in a unit
that its file does not state."""

from __future__ import annotations

import io
import re
import struct
import warnings
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.motion.records.raw import RawRecord, doubtful, peaked
from heeltoe.warnings.notice import Notice

_MINISEED = re.compile(rb"\d{6}[DRQM][ \0]")
# Of SAC: where a header states its version, and which ones there are.
_VERSION, _VERSIONS, _HEADER = 304, (6, 7), 632
_NO_NUMBER = -12345.0
_OTHERS = {6: "displacement", 7: "velocity", 50: "velocity in volts"}
_LARGEST_XML, _MOST_XML = 20_000_000, 500
# Place of the station's code in the header of miniSEED.
_STATION = slice(8, 13)
# A sensor within so much of upright, or of level, is that [deg].
_UPRIGHT, _LEVEL = 80.0, 10.0
_ACCELERATION = pattern(r"(?P<unit>n|u|m|c)?m/(?:s\*\*2|s\^2|s/s|s2|sec\*\*2)", re.IGNORECASE)
_PARTS = {"": 1.0, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9}


def is_miniseed(data: bytes) -> bool:
    """Whether a file opens as miniSEED does."""
    return _MINISEED.match(data) is not None


def is_sac(data: bytes) -> bool:
    """Whether a file has the header of SAC."""
    if len(data) < _HEADER:
        return False
    return any(struct.unpack_from(f"{order}i", data, _VERSION)[0] in _VERSIONS for order in "<>")


def is_station_xml(data: bytes) -> bool:
    """Whether a file describes stations and their instruments."""
    return b"<FDSNStationXML" in data[:2000]


def beside(path: Path, data: bytes) -> list[bytes]:
    """Return the StationXML that lies beside a file of miniSEED under its name, or under that of its station."""
    if not is_miniseed(data):
        return []
    station = data[_STATION].decode("ascii", "replace").strip().lower()
    stations = []
    try:
        for file in [path.with_suffix(".xml"), *sorted(path.parent.glob("*.xml"))[:_MOST_XML]]:
            named = file.stem == path.stem or station in re.split(r"[^a-z0-9]+", file.stem.lower())
            if named and file.is_file() and file.stat().st_size <= _LARGEST_XML:
                stations.append(file.read_bytes())
    except (OSError, ValueError):
        pass
    return stations


def read(data: bytes, name: str, stations: list[bytes]) -> list[RawRecord]:
    """Read every channel of a file of either format.

    Parameters
    ----------
    data
        The file.
    name
        Of it.
    stations
        StationXML that may describe its instruments.

    Raises
    ------
    InputError
        Where obspy is not installed, the file is damaged, or its counts cannot be turned to accelerations.
    """
    if find_spec("obspy") is None:
        raise InputError("package-missing", name, "obspy", install="pip install obspy")
    with warnings.catch_warnings(record=True) as doubts:
        warnings.simplefilter("always")
        import obspy

        seed = is_miniseed(data)
        doubts.clear()
        try:
            stream = obspy.read(io.BytesIO(data), format="MSEED" if seed else "SAC")
            stream.merge(method=-1)
        # A damaged file ends in whatever the reader stumbles over.
        except Exception:
            raise InputError("record-header", name, "channel") from None
        # The sums of a packed block do not come out, or bytes belong to no block: its numbers are not those recorded.
        if damage := next((doubt for doubt in doubts if "mseed" in type(doubt.message).__module__), None):
            raise InputError(
                "source-unreadable",
                name,
                reason=_first_sentence(str(damage.message)),
                expected="the record, downloaded again",
            )
        ids = [trace.id for trace in stream]
        twice = next((channel for channel in ids if ids.count(channel) > 1), None)
        if twice is not None:
            raise InputError("record-gaps", name, twice)
        said = _said(doubts, name)
        records = [_of_counts(trace, name, stations) if seed else _of_sac(trace, name) for trace in stream]
        return [replace(record, warnings=(*record.warnings, *said)) for record in records]


def _said(doubts: list[warnings.WarningMessage], name: str) -> tuple[Notice, ...]:
    """Return the warnings of the reader, except those about itself and about the step, which the header states."""
    texts = [
        _first_sentence(str(doubt.message))
        for doubt in doubts
        if issubclass(doubt.category, UserWarning) and "microsecond precision" not in str(doubt.message)
    ]
    return tuple(doubtful(name, "has a warning by its reader: {text}", text=text) for text in dict.fromkeys(texts))


def _first_sentence(text: str) -> str:
    """Return a text up to its first full stop."""
    return plain(text).partition(". ")[0].rstrip(".")


def _of_counts(trace: Any, name: str, stations: list[bytes]) -> RawRecord:
    values = np.asarray(trace.data, dtype=np.float64)
    about = {"station": f"{trace.stats.network}.{trace.stats.station}", "component": str(trace.stats.channel)}
    about["date"] = trace.stats.starttime.strftime("%Y-%m-%d %H:%M:%S")
    step, begins = float(trace.stats.delta), float(trace.stats.starttime.timestamp)
    if not stations and trace.data.dtype.kind == "f":
        # Somebody has turned it to a unit that miniSEED has no place for.
        return RawRecord(values, time_step=step, about=about, begins=begins, format="miniSEED")
    sensitivity, part, direction = _sensitivity(trace, name, stations)
    if direction:
        about["component"] = f"{direction} ({about['component']})"
    with np.errstate(over="ignore", invalid="ignore"):
        values = values * (part / sensitivity)
        offset = float(values.mean()) if values.size else 0.0
        values = values - offset
    processing = (f"counts over {sensitivity:.6g} of its StationXML", f"mean of {offset:.5g} m/s2 taken out")
    return RawRecord(
        values,
        time_step=step,
        unit="m/s^2",
        about=about,
        begins=begins,
        processing=processing,
        uncorrected="it is in counts, as its instrument gave it",
        format="miniSEED",
    )


def _sensitivity(trace: Any, name: str, stations: list[bytes]) -> tuple[float, float, str]:
    """Counts for each unit of acceleration, that unit in m/s2, and which way the sensor points, where that is known."""
    import obspy

    if not stations:
        wanted = f"{Path(name).stem}.xml or {trace.stats.station}.xml"
        raise InputError("record-response", name, wanted, reason="there is no StationXML")
    for text in stations:
        # No station needs entities, and some of them never end.
        if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
            continue
        try:
            inventory = obspy.read_inventory(io.BytesIO(text), format="STATIONXML")
            response = inventory.get_response(trace.id, trace.stats.starttime)
            sensitivity = response.instrument_sensitivity
            value, unit = float(sensitivity.value), str(sensitivity.input_units)
        except Exception:
            continue
        if not (np.isfinite(value) and value != 0.0):
            continue
        measured = _ACCELERATION.fullmatch(unit.strip())
        if measured is None:
            quantity = "velocity" if re.fullmatch(r"[nuc]?m/s(?:ec)?", unit.strip(), re.IGNORECASE) else unit[:20]
            raise InputError("record-not-acceleration", name, quantity)
        return value, _PARTS[(measured["unit"] or "").lower()], _direction(inventory, trace)
    reason = f"no StationXML describes {trace.id} at that time"
    raise InputError("record-response", name, f"{Path(name).stem}.xml", reason=reason)


def _direction(inventory: Any, trace: Any) -> str:
    """Which way a sensor points by its StationXML: up, down, or degrees from north."""
    try:
        points = inventory.get_orientation(trace.id, trace.stats.starttime)
        azimuth, dip = float(points["azimuth"]), float(points["dip"])
    except Exception:  # a channel may have neither
        return ""
    if abs(dip) >= _UPRIGHT:
        # A dip is counted down from the horizontal.
        return "up" if dip < 0.0 else "down"
    return f"{azimuth:g} deg" if abs(dip) <= _LEVEL else f"{azimuth:g} deg, {-dip:g} deg upward"


def _of_sac(trace: Any, name: str) -> RawRecord:
    header = trace.stats.sac
    if (quantity := _OTHERS.get(int(header.get("idep", 0)))) is not None:
        raise InputError("record-not-acceleration", name, quantity)
    values = np.asarray(trace.data, dtype=np.float64)
    extremes = [float(header.get(key, _NO_NUMBER)) for key in ("depmin", "depmax")]
    scale = float(str(np.float32(header.get("scale", _NO_NUMBER))))
    known = all(np.isfinite(value) and value != _NO_NUMBER for value in extremes)
    return RawRecord(
        values,
        # The trace of obspy (1.5.1) has the step rounded to microseconds: 1/128 s would end a minute 3.8 ms early. The
        # shortest decimal of the header's single precision is the step that was written.
        time_step=float(str(np.float32(header["delta"]))),
        about={
            "station": f"{trace.stats.network}.{trace.stats.station}",
            "component": str(trace.stats.channel),
            "date": trace.stats.starttime.strftime("%Y-%m-%d %H:%M:%S"),
        },
        begins=float(trace.stats.starttime.timestamp),
        warnings=peaked(values, f"{max(map(abs, extremes)):.6e}", name) if known else (),
        # Some programs write a sensitivity there, others what they have multiplied by or want to.
        factor=scale if np.isfinite(scale) and scale not in (_NO_NUMBER, 0.0, 1.0) else None,
        format="SAC",
    )
