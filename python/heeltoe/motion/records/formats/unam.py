"""UNAM, CICESE and the Mexican database (ASA, archivo estandar de aceleracion): up to twelve channels side by side, in
gal::

INTERVALO DE MUESTREO, C1-C6 (s)       : /0.005/0.005/0.005
ACEL. MAX.(Gal), C1-C6                 : /25.6114/58.7394/-42.3377
UNIDADES DE LOS DATOS                  : Gal (cm/s/s)
   CANAL-1   CANAL-2   CANAL-3
         V      N00E      N90E
"""

from __future__ import annotations

import re

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import find_data, labelled, parted
from heeltoe.motion.records.raw import RawRecord, check_series, leading, stated, table

FORMAT = "UNAM ASA"

_CHANNELS = pattern(r"\s*canal-?\s*1\b", re.IGNORECASE)
_HEADER_LINES = 160


def matches(lines: list[str]) -> bool:
    """Whether the first lines bear the title of the format."""
    return any("ARCHIVO ESTANDAR DE ACELERACION" in line[:200].upper() for line in lines[:20])


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Read a file that matches."""
    header = labelled(lines, _HEADER_LINES)
    above = next((k for k, line in enumerate(lines[:_HEADER_LINES]) if _CHANNELS.match(line[:200])), None)
    steps = [stated(text) for text in _parts(header, "intervalo de muestreo")]
    unit = header.get("unidades de los datos", "").lower()
    if above is None or above + 3 > len(lines) or not steps or not steps[0] or not unit.startswith("gal"):
        raise InputError("record-header", name, "channels, step or unit")
    # Some files have a heading for each channel there might be.
    first = find_data(lines, above + 1)
    width = len(parted(lines[first]).split()) if first < len(lines) else 0
    channels = stated(header.get("numero de canales", ""))
    if width == 0 or (channels is not None and channels != width):
        raise InputError("record-header", name, f"number of channels, of which there are {width},")
    ways = _ways(lines[above + 1], header, width)
    peaks, counts = (
        _parts(header, "acel. max."),
        [stated(text) for text in _parts(header, "num. total de muestras")],
    )
    about = {
        "event": f"magnitude {header.get('magnitud(es)', '').strip('/ ')}".removesuffix("magnitude "),
        "date": f"{header.get('fecha del sismo [gmt]', '')} {header.get('hora epicentro (gmt)', '')}".strip(),
        "station": header.get("nombre de la estacion", ""),
    }
    records = []
    for k, values in enumerate(table(lines[first:], name, first + 1, width)):
        count = counts[k] if k < len(counts) else None
        warnings = check_series(values, name, count, leading(peaks[k]) if k < len(peaks) else "")
        step = steps[k] if k < len(steps) else steps[0]
        records.append(
            RawRecord(values, time_step=step, unit="gal", about={**about, "component": ways[k]}, warnings=warnings)
        )
    return records


def _ways(below: str, header: dict[str, str], width: int) -> list[str]:
    """Return the directions of the channels, by the line below their names, or by the label."""
    for ways in (below.split(), re.split(r";\s+", below.strip()), _parts(header, "orientacion")):
        if len(ways) == width:
            # Behind a semicolon stands which way is positive: V;+ is up.
            parts = [way.strip().rstrip(";").partition(";") for way in ways]
            return [f"{way}-" if sign.strip() == "-" else way for way, _, sign in parts]
    return [""] * width


def _parts(header: dict[str, str], label: str) -> list[str]:
    """Header lines of each channel, the first six and the rest one behind the other."""
    texts = [value for key, value in header.items() if key.startswith(label) and re.search(r"c\d+ ?- ?c\d+", key)]
    return [part.strip() for text in texts for part in text.split("/")[1:] if part.strip()]
