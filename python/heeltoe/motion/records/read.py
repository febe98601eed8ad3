"""Strong-motion records: one reader per format, chosen by looking into the file.

A reader is a module with ``FORMAT``, ``matches(lines) -> bool`` and ``read(lines, name) -> list[RawRecord]``, one for
each channel. To add a format, write one and put it into :data:`READERS` before the more forgiving ones.
"""

from __future__ import annotations

import codecs
import os
import stat
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Literal

from heeltoe.base.input_files import read_bounded
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.records import HeaderFactor, seismology
from heeltoe.motion.records.archive import LARGEST_BYTES, is_archive, is_workbook, unpacked
from heeltoe.motion.records.catalog import PREFIX, find, is_called_record
from heeltoe.motion.records.channel import choose, numbered
from heeltoe.motion.records.formats import (
    afad,
    columns,
    cosmos_v2,
    csmip_v2,
    csmnc,
    esm,
    foreign,
    geonet,
    knet,
    peer_at2,
    taiwan,
    unam,
    usc_v2,
    usgs_smc,
    volume1,
)
from heeltoe.motion.records.raw import RawRecord
from heeltoe.motion.records.to_motion import Options, to_motion
from heeltoe.units.parse import STANDARD_GRAVITY

__all__ = ["READERS", "RawRecord", "is_record", "read_channels", "read_record", "read_text", "read_text_channels"]

#: In the order in which they are asked.
READERS: tuple[ModuleType, ...] = (
    esm,
    afad,
    taiwan,
    unam,
    geonet,
    usc_v2,
    volume1,
    csmip_v2,
    cosmos_v2,
    usgs_smc,
    knet,
    csmnc,
    foreign,
    peer_at2,
    columns,
)

_NO_OPTIONS = Options()
# Errors of a file of an archive that is no record: a readme, a picture, the velocity, or the record uncorrected.
_NO_RECORD = {"record-format", "record-format-later", "record-binary", "record-empty", "record-not-acceleration"}


def read_record(
    path: str | os.PathLike[str],
    channel: str | int | None = None,
    *,
    unit: str | None = None,
    time_step: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    field: str = "motion",
    assume: bool = False,
    layout: Literal["rows", "columns"] | None = None,
    factor: float | HeaderFactor | None = None,
    several: bool = False,
) -> GroundMotion:
    """Read a record as it was downloaded.

    Parameters
    ----------
    path
        The file, or the name of a record as a case takes it: of a file in ``$HEELTOE_RECORDS``, or of one that
        `heeltoe motion --list` shows, or ``synthetic:...`` for a motion made to order.
    channel
        Which one of a file of several, by number or by direction (``1``, ``"90 deg"``, ``"up"``).
    unit
        Unit of the accelerations where the file does not state it (``"g"``, ``"cm/s^2"``, ...); where it does, the two
        must agree.
    time_step
        Step [s] of a file that does not state it; where it does, the two must agree.
    gravity
        One g [m/s2], for records in g.
    field
        Where the record stands in a case, for errors that ask for more.
    assume
        Take the likeliest unit and step where neither the file nor the caller states them, and warn of it: good enough
        to look at a file, not for an analysis.
    layout
        Whether the values of a plain table run along its rows or down its columns, where its header does not say so.
    factor
        Factor of the values where the header has one: that one, or 1 where they contain it; of several files one of the
        words "multiply", "divide" and "contain".
    several
        Whether these options are meant for several files: they hold where this one does not state them.

    Returns
    -------
    GroundMotion

    Raises
    ------
    InputError
        Where there is no such file, or what is in it cannot be used.
    """
    text = os.fspath(path)
    if text.startswith(PREFIX):
        from heeltoe.motion.scenario import synthetic

        return synthetic(text, gravity=gravity, field=f"{field}.file")
    place = _place(path, field)
    data, name = _load(place)
    options = Options(unit, time_step, gravity, field, assume, layout, factor, several)
    return called(_chosen(_records(data, name, options, place), name, channel, options), place, text)


def read_channels(
    path: str | os.PathLike[str],
    *,
    unit: str | None = None,
    time_step: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    field: str = "motion",
    assume: bool = True,
    layout: Literal["rows", "columns"] | None = None,
    factor: float | HeaderFactor | None = None,
    several: bool = False,
) -> list[GroundMotion]:
    """Read all channels of a file, to look at them; see :func:`read_record`. Most files have one."""
    place = _place(path, field)
    data, name = _load(place)
    options = Options(unit, time_step, gravity, field, assume, layout, factor, several)
    records = _records(data, name, options, place)
    return [to_motion(raw, name, len(records), options) for raw in records]


def called(motion: GroundMotion, path: Path, path_as_written: str) -> GroundMotion:
    """Return a motion under the name that a user gave, which is the one that tells versions of a record apart."""
    if path.stem == path_as_written:
        return motion
    return replace(motion, name=Path(path_as_written).stem + motion.name.removeprefix(path.stem))


def read_text(data: bytes, name: str, channel: str | int | None = None, options: Options = _NO_OPTIONS) -> GroundMotion:
    """Read a record from the bytes of its file; see :func:`read_record`."""
    return _chosen(_records(data, name, options), name, channel, options)


def _chosen(records: list[RawRecord], name: str, channel: str | int | None, options: Options) -> GroundMotion:
    return to_motion(choose(records, channel, name, f"{options.field}.channel"), name, len(records), options)


def read_text_channels(data: bytes, name: str, options: Options = _NO_OPTIONS) -> list[GroundMotion]:
    """Read all channels from the bytes of a file; see :func:`read_channels`."""
    records = _records(data, name, options)
    return [to_motion(raw, name, len(records), options) for raw in records]


# Velocities and displacements by PEER, which need not be opened.
_NO_ACCELERATIONS = {".vt2", ".dt2"}
# Bytes of a file in which a format names itself.
_OPENING = 30_000


def is_record(path: Path) -> bool:
    """Whether a file in a folder is a record: by its name, or as it opens in the words of a format; networks end the
    names of their files with dates and channels, too."""
    if is_called_record(path):
        return True
    if not path.is_file() or path.suffix.lower() in _NO_ACCELERATIONS:
        return False
    try:
        data = read_bounded(path, _OPENING)
    except OSError:
        return False
    if is_archive(data):
        return False
    if seismology.is_miniseed(data) or seismology.is_sac(data):
        return True
    lines = data.decode("latin-1").splitlines() or [""]
    return b"\x00" not in data and any(reader.matches(lines) for reader in READERS if reader not in (columns, foreign))


def _place(path: str | os.PathLike[str], field: str) -> Path:
    """Return where a record is that is given by its path or by its name."""
    return Path(path) if os.path.exists(path) else find(path, Path(), field=f"{field}.file")


def _load(path: str | os.PathLike[str]) -> tuple[bytes, str]:
    path = Path(path)
    try:
        status = path.stat()
        # A device or a pipe may never end.
        if not stat.S_ISREG(status.st_mode):
            raise InputError("source-unreadable", str(path), reason="it is not a file", expected="a record")
        if status.st_size > LARGEST_BYTES:
            raise InputError("too-large", str(path), f"{LARGEST_BYTES // 10**6} MB", expected="a file with one record")
        return path.read_bytes(), path.name
    except (OSError, ValueError) as error:
        raise InputError(
            "source-unreadable", str(path), reason=getattr(error, "strerror", None) or error, expected="a record"
        ) from None


def _records(data: bytes, name: str, options: Options, place: Path | None = None) -> list[RawRecord]:
    """The channels of a file, or of all the files in an archive, numbered."""
    if is_workbook(data):
        raise InputError("record-workbook", name)
    stations = seismology.beside(place, data) if place is not None else []
    if not is_archive(data):
        return numbered(_read(data, name, stations, options))
    files = unpacked(data, name)
    stations += [content for _, content in files if seismology.is_station_xml(content)]
    records: list[RawRecord] = []
    refused: list[InputError] = []
    for own, content in files:
        if len(files) > 1 and seismology.is_station_xml(content):
            continue
        try:
            records += _read(content, own, stations, options)
        except InputError as error:
            if len(files) == 1 or error.code not in _NO_RECORD:
                raise
            refused.append(error)
    if not records:
        raise (
            refused[0]
            if refused
            else InputError(
                "empty", name, "the archive", what="record that can be read", expected="an archive of records"
            )
        )
    return numbered(records)


def _read(data: bytes, name: str, stations: list[bytes], options: Options) -> list[RawRecord]:
    if is_archive(data):
        raise InputError("source-unreadable", name, reason="it stands in another one", expected="the record, unpacked")
    if seismology.is_miniseed(data) or seismology.is_sac(data):
        return seismology.read(data, name, stations)
    lines = _lines(data, name)
    reader = next((reader for reader in READERS if reader.matches(lines)), None)
    if reader is None:
        raise InputError("record-format", name, repr(lines[0][:40]))
    records = _read_columns(lines, name, options) if reader is columns else reader.read(lines, name)
    return [replace(record, format=reader.FORMAT) for record in records]


def _read_columns(lines: list[str], name: str, options: Options) -> list[RawRecord]:
    """Read a plain table, which alone leaves it open how its values run; the layout of several files is for those."""
    if options.layout is None or not options.several:
        return columns.read(lines, name, options.layout, options.field)
    try:
        return columns.read(lines, name, None, options.field)
    except InputError as error:
        if error.code not in columns.ASKS_FOR_LAYOUT:
            raise
        return columns.read(lines, name, options.layout, options.field)


def _lines(data: bytes, name: str) -> list[str]:
    # Some programs fill the last block of a text file.
    data = data.rstrip(b"\x00\x1a")
    if not data.removeprefix(codecs.BOM_UTF8).strip():
        raise InputError("record-empty", name)
    if b"\x00" in data:
        raise InputError("record-binary", name)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Old headers carry degree signs and names in Latin-1, which decodes anything.
        text = data.decode("latin-1")
    return text.splitlines()
