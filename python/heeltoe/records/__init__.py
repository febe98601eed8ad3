"""Strong-motion records: one reader per format, chosen by looking into the file.

A reader is a module with ``FORMAT``, ``matches(lines) -> bool`` and ``read(lines, name) -> RawRecord``. To add a
format, write one and put it into :data:`READERS` before the more forgiving ones.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from heeltoe.errors import InputError
from heeltoe.motion import STANDARD_GRAVITY, GroundMotion
from heeltoe.quantities import acceleration_unit
from heeltoe.records import columns, foreign, peer_at2
from heeltoe.records.raw import RawRecord

__all__ = ["READERS", "RawRecord", "read_record", "read_text"]

#: In the order in which they are asked.
READERS: tuple[ModuleType, ...] = (peer_at2, columns)

# No record of one component comes near; what is larger is something else.
_LARGEST_BYTES = 64_000_000
# Beyond these the numbers are no record in any unit, and displacements would overflow.
_LARGEST_VALUE, _LARGEST_GAP = 1e12, 1e4


def read_record(
    path: str | os.PathLike[str],
    *,
    unit: str | None = None,
    time_step: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    field: str = "motion",
) -> GroundMotion:
    """Read a record as it was downloaded.

    Parameters
    ----------
    path
        The file.
    unit
        Unit of the accelerations where the file does not state it (``"g"``, ``"cm/s^2"``, ...); where it does, the two
        must agree.
    time_step
        Step [s] of a file that does not state it; where it does, the two must agree.
    gravity
        One g [m/s2], for records in g.
    field
        Where the record stands in a case, for errors that ask for more.

    Returns
    -------
    GroundMotion

    Raises
    ------
    InputError
        Where there is no such file, or what is in it cannot be used.
    """
    path = Path(path)
    try:
        status = path.stat()
        # A device or a pipe may never end.
        if not stat.S_ISREG(status.st_mode):
            raise InputError("record-unreadable", str(path), reason="it is not a file")
        if status.st_size > _LARGEST_BYTES:
            raise InputError("record-large", str(path), f"{status.st_size / 1e6:.0f} MB")
        data = path.read_bytes()
    except (OSError, ValueError) as error:
        raise InputError("record-unreadable", str(path), reason=getattr(error, "strerror", None) or error) from None
    return read_text(data, path.name, unit=unit, time_step=time_step, gravity=gravity, field=field)


def read_text(
    data: bytes,
    name: str,
    *,
    unit: str | None = None,
    time_step: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    field: str = "motion",
) -> GroundMotion:
    """Read a record from the bytes of its file; see :func:`read_record`."""
    lines = _lines(data, name)
    reader = next((reader for reader in READERS if foreign.recognised(lines) is None and reader.matches(lines)), None)
    if reader is None:
        known = foreign.recognised(lines)
        if known is not None:
            raise InputError("record-format-later", name, known)
        raise InputError("record-format", name, repr(lines[0][:40]))
    raw: RawRecord = reader.read(lines, name)
    return _motion(raw, reader.FORMAT, name, unit, time_step, gravity, field)


def _lines(data: bytes, name: str) -> list[str]:
    if not data.strip():
        raise InputError("record-empty", name)
    if b"\x00" in data:
        raise InputError("record-binary", name)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Old headers carry degree signs and names in Latin-1, which decodes anything.
        text = data.decode("latin-1")
    return text.splitlines()


def _motion(
    raw: RawRecord,
    format_: str,
    name: str,
    unit: str | None,
    time_step: float | None,
    gravity: float,
    field: str,
) -> GroundMotion:
    if raw.values.size < 2:
        raise InputError("motion-short", name, raw.values.size)
    if not np.isfinite(raw.values).all():
        bad = int(np.flatnonzero(~np.isfinite(raw.values))[0])
        raise InputError("motion-not-finite", name, str(raw.values[bad]), number=bad + 1)
    peak = float(np.abs(raw.values).max())
    time = _time(raw, name, time_step, field)
    stated = raw.unit or unit
    if stated is None:
        raise InputError("record-unit-missing", name, f"{peak:.4g}", unit_field=f"{field}.unit", guess=_guess(peak))
    factor = acceleration_unit(stated, f"{field}.unit" if raw.unit is None else name).si(gravity)
    if raw.unit and unit and acceleration_unit(unit, f"{field}.unit").si(gravity) != factor:
        raise InputError("record-unit-conflict", f"{field}.unit", unit, stated=raw.unit, name=name)
    if peak * factor > _LARGEST_VALUE:
        raise InputError("motion-peak", name, f"{peak:.4g} {stated}", name="it")
    acceleration = raw.values * factor
    return GroundMotion(
        name=Path(name).stem,
        time=time,
        acceleration=acceleration,
        format=format_,
        units_as_read=stated if raw.unit else f"{stated} (as told)",
        source=name,
        processing=raw.processing,
        warnings=raw.warnings,
        **raw.about,
    )


def _time(raw: RawRecord, name: str, time_step: float | None, field: str) -> NDArray[np.float64]:
    if raw.time is not None:
        with np.errstate(invalid="ignore", over="ignore"):
            gap = float(np.abs(np.diff(raw.time)).max())
        if gap > _LARGEST_GAP:
            raise InputError("record-step", name, f"{gap:g} s")
        return raw.time
    step = raw.time_step or time_step
    if step is None:
        raise InputError("record-step-missing", name, step_field=f"{field}.time_step")
    if raw.time_step and time_step and abs(raw.time_step - time_step) > 1e-9 * time_step:
        raise InputError("record-step-conflict", f"{field}.time_step", f"{time_step:g} s", stated=raw.time_step)
    if not 1e-6 <= step <= 10.0:
        raise InputError("record-step", name, f"{step:g} s")
    return np.arange(raw.values.size, dtype=np.float64) * step


def _guess(peak: float) -> str:
    # Hardly any ground has passed 1.3 g; a few m/s^2 are a common peak, and a few g a grave mistake.
    if peak < 1.3:
        return 'probably unit = "g"'
    return 'probably unit = "cm/s^2"' if peak > 20.0 else 'unit = "m/s^2", or "g" or "cm/s^2"'
