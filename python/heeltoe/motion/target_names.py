"""Target spectra as they are written on a command line: ``en1998:0.3 g,B``, ``asce7:0.9 g,0.4 g,8 s``, or the file of a
table."""

from __future__ import annotations

from pathlib import Path

from heeltoe.errors import InputError
from heeltoe.motion.records.quantities import units_in
from heeltoe.motion.records.raw import table as table_of
from heeltoe.motion.targets import Target, asce_7, en_1998, table
from heeltoe.units.parse import STANDARD_GRAVITY, acceleration_unit, parse, parse_acceleration

# No table of a spectrum comes near.
_LARGEST_BYTES = 1_000_000


def target_of(text: str, field: str, gravity: float = STANDARD_GRAVITY) -> Target:
    """Return the spectrum that a text names.

    Parameters
    ----------
    text
        ``en1998:PEAK,GROUND`` with ``,2`` behind it for spectra of type 2, ``asce7:S_DS,S_D1,T_L``, or a file with
        periods [s] and accelerations in two columns, whose header states the unit of these.
    field
        Where it stands, for errors.
    gravity
        One g [m/s2].

    Raises
    ------
    InputError
        Where there is no such spectrum.
    """
    kind, colon, rest = text.partition(":")
    parts = [part.strip() for part in rest.split(",")]
    try:
        if colon and kind == "en1998" and len(parts) in (2, 3) and parts[2:] in ([], ["1"], ["2"]):
            return en_1998(parse_acceleration(parts[0], field).si(gravity), parts[1], int((parts[2:] or ["1"])[0]))
        if colon and kind == "asce7" and len(parts) == 3:
            short, second = (parse_acceleration(part, field).si(gravity) for part in parts[:2])
            return asce_7(short, second, parse(parts[2], "duration", field))
    except InputError as error:
        error.field = field
        raise
    path = Path(text)
    try:
        if not path.is_file() or path.stat().st_size > _LARGEST_BYTES:
            raise InputError("target-form", field, text)
        lines = path.read_text("latin-1").replace(",", " ").replace(";", " ").splitlines()
    except (OSError, ValueError):
        raise InputError("target-form", field, text) from None
    return _of_file(lines, path.name, gravity)


def _of_file(lines: list[str], name: str, gravity: float) -> Target:
    header = [line for line in lines if line.strip() and not line.lstrip()[:1].isdigit()]
    data = [line for line in lines if line.lstrip()[:1].isdigit()]
    units = {unit for line in header for unit in units_in(line)}
    if len(units) != 1:
        raise InputError("target-unit", name)
    if not data:
        raise InputError("target-table", name)
    periods, accelerations = table_of(data, name, len(header) + 1, 2)
    return table(periods, accelerations * acceleration_unit(units.pop(), name).si(gravity), name=Path(name).stem)
