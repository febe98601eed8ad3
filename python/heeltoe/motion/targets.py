"""Target response spectra, of standards or of a table: pseudo-acceleration as a function of period. A command line
names them ``en1998:0.3 g,B``, ``asce7:0.9 g,0.4 g,8 s``, or by the file of a table."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError, shown
from heeltoe.motion.openquake import is_of_openquake, spectrum_of_openquake
from heeltoe.motion.records.quantities import units_in
from heeltoe.motion.records.raw import table as rows_of
from heeltoe.units.parse import STANDARD_GRAVITY, acceleration_unit, parse, parse_acceleration

#: What the names of spectra of standards begin with.
STANDARDS = ("en1998:", "asce7:")
# Word and unit in brackets of the first column of a table, and what the units hold.
_FIRST_COLUMN = re.compile(r"[\s#%*'\"]*([^\W\d_][^,;\t\[(]*)?(?:[\[(]([^\])]*)[\])])?")
_LOGARITHM = re.compile(r"\b(?:log\s?_?(?:10|e)?|ln)(?:\b|(?=[\s_(\[]|p?sa\b|t\b))")
_DAMPED = re.compile(r"(\d+(?:\.\d+)?)\s?%\s?(?:of )?(?:critical )?damp|\bdamping\b[^\d%]{0,12}(\d+(?:\.\d+)?)\s?(%?)")
_DATA = re.compile(r"\s*[-+]?\.?\d")
# The damping of spectra that do not say theirs.
_USUAL_DAMPING = 0.05
_PERIODS = {"": "", "s": "s", "sec": "s", "seconds": "s", "ms": "ms", "msec": "ms", "hz": "hz", "1/s": "hz"}
# No table of a spectrum comes near.
_LARGEST_BYTES = 1_000_000


@dataclass(frozen=True)
class Target:
    """A response spectrum to be met; call it with periods [s] for pseudo-accelerations [m/s2].

    Attributes
    ----------
    name
        What it is called in every output.
    damping
        Damping ratio it stands for.
    shortest, longest
        Periods [s] between which it is defined.
    ordinate
        Pseudo-acceleration [m/s2] of an array of periods in that range.
    """

    name: str
    damping: float
    shortest: float
    longest: float
    ordinate: Callable[[Floats], Floats]

    def __call__(self, periods: ArrayLike) -> Floats:
        """Return the pseudo-accelerations [m/s2] at `periods` [s]."""
        period = np.asarray(periods, dtype=np.float64)
        outside = ~((period >= self.shortest) & (period <= self.longest))
        if outside.any():
            bounds = f"{self.shortest:g} s to {self.longest:g} s"
            raise InputError(
                "out-of-range",
                "periods",
                f"{period[outside][0]:g} s",
                bound=f"within {bounds}, the periods of {self.name}",
            )
        return self.ordinate(period)


# S, TB [s], TC [s], TD [s] of EN 1998-1:2004, table 3.2 (type 1) and table 3.3 (type 2), the recommended values.
_EN_1998 = {
    1: {
        "A": (1.0, 0.15, 0.4, 2.0),
        "B": (1.2, 0.15, 0.5, 2.0),
        "C": (1.15, 0.20, 0.6, 2.0),
        "D": (1.35, 0.20, 0.8, 2.0),
        "E": (1.4, 0.15, 0.5, 2.0),
    },
    2: {
        "A": (1.0, 0.05, 0.25, 1.2),
        "B": (1.35, 0.05, 0.25, 1.2),
        "C": (1.5, 0.10, 0.25, 1.2),
        "D": (1.8, 0.10, 0.30, 1.2),
        "E": (1.6, 0.05, 0.25, 1.2),
    },
}


def en_1998(peak: float, ground: str = "A", type_: int = 1, damping: float = 0.05) -> Target:
    """Return the horizontal elastic response spectrum of EN 1998-1:2004, equations (3.2) to (3.6), up to 4 s.

    Parameters
    ----------
    peak
        Design ground acceleration on ground type A, a_g [m/s2], with the importance factor in it.
    ground
        Ground type, A to E.
    type_
        1 for regions of strong earthquakes, 2 where magnitudes stay below 5.5.
    damping
        Damping ratio; eta = sqrt(10 / (5 + 100 damping)), at least 0.55.
    """
    _check_positive("peak", peak, "m/s2")
    if type_ not in _EN_1998:
        raise InputError("not-a-choice", "type_", type_, choices="spectrum type 1 or 2 of EN 1998-1")
    if ground not in _EN_1998[type_]:
        raise InputError("not-a-choice", "ground", ground, choices="ground type A, B, C, D or E of EN 1998-1")
    if not 0.0 <= damping <= 1.0:
        raise InputError("out-of-range", "damping", f"{damping:g}", bound="from 0 to 1")
    soil, tb, tc, td = _EN_1998[type_][ground]
    eta = max(0.55, float(np.sqrt(10.0 / (5.0 + 100.0 * damping))))

    ordinate = partial(_of_en_1998, peak * soil, 2.5 * eta, (tb, tc, td))
    return Target(f"EN 1998-1 type {type_}, ground {ground}, a_g {peak:.4g} m/s2", damping, 0.0, 4.0, ordinate)


def asce_7(short: float, one_second: float, transition: float) -> Target:
    """Return the two-period design spectrum of ASCE/SEI 7-16 (11.4.6) and 7-22 (11.4.5.2), at 5 % damping.

    Parameters
    ----------
    short
        Design acceleration at short periods, S_DS [m/s2].
    one_second
        Design acceleration at 1 s, S_D1 [m/s2].
    transition
        Long-period transition period, T_L [s].
    """
    for name, value, unit in (
        ("short", short, "m/s2"),
        ("one_second", one_second, "m/s2"),
        ("transition", transition, "s"),
    ):
        _check_positive(name, value, unit)
    corner = one_second / short
    if transition < corner:
        raise InputError(
            "out-of-range", "transition", f"{transition:g} s", bound=f"of at least S_D1 / S_DS, {corner:g} s"
        )
    ordinate = partial(_of_asce_7, short, one_second, transition)
    name = f"ASCE 7, S_DS {short:.4g} m/s2, S_D1 {one_second:.4g} m/s2, T_L {transition:g} s"
    return Target(name, 0.05, 0.0, float("inf"), ordinate)


def table(periods: ArrayLike, accelerations: ArrayLike, damping: float = 0.05, name: str = "table") -> Target:
    """Return a spectrum through given points, straight on double logarithmic axes.

    From a period of zero, which has no logarithm, to the next point it is straight on plain axes.

    Parameters
    ----------
    periods
        (k,) ascending periods [s].
    accelerations
        (k,) pseudo-accelerations [m/s2], above zero.
    damping
        Damping ratio they stand for.
    name
        What the spectrum is called.
    """
    t, a = np.array(periods, dtype=np.float64), np.array(accelerations, dtype=np.float64)
    if t.ndim != 1 or t.shape != a.shape or t.size < 2 or not (np.isfinite(t).all() and np.isfinite(a).all()):
        raise InputError("target-table", "periods")
    if t[0] < 0.0 or (np.diff(t) <= 0.0).any() or (a <= 0.0).any():
        raise InputError("target-table", "periods")
    ordinate = partial(_of_table, t, a)
    return Target(name, damping, float(t[0]), float(t[-1]), ordinate)


# Ordinates are functions of a module, as a target may be sent to another process.
def _of_en_1998(top: float, flat: float, corners: tuple[float, float, float], period: Floats) -> Floats:
    tb, tc, td = corners
    # The branches agree where they meet, so the smallest of the last three is the one that holds.
    safe = np.maximum(period, tb)
    falling = flat * np.minimum(1.0, np.minimum(tc / safe, tc * td / safe**2))
    return top * np.where(period < tb, 1.0 + period / tb * (flat - 1.0), falling)


def _of_asce_7(short: float, one_second: float, transition: float, period: Floats) -> Floats:
    start = 0.2 * (one_second / short)
    safe = np.maximum(period, start)
    falling = np.minimum(short, np.minimum(one_second / safe, one_second * transition / safe**2))
    return np.where(period < start, short * (0.4 + 0.6 * period / start), falling)


def _of_table(periods: Floats, accelerations: Floats, period: Floats) -> Floats:
    positive = periods > 0.0
    first = periods[positive][0]
    logs = np.log(periods[positive]), np.log(accelerations[positive])
    result: Floats = np.exp(np.interp(np.log(np.maximum(period, first)), *logs))
    return np.where(period < first, np.interp(period, periods[:2], accelerations[:2]), result)


def _check_positive(name: str, value: float, unit: str) -> None:
    if not (np.isfinite(value) and value > 0.0):
        raise InputError("out-of-range", name, f"{value:g} {unit}", bound="above 0")


def target_of(text: str, field: str, gravity: float = STANDARD_GRAVITY) -> Target:
    """Return the spectrum that a text names.

    Parameters
    ----------
    text
        ``en1998:PEAK,GROUND`` with ``,2`` behind it for spectra of type 2, ``asce7:S_DS,S_D1,T_L``, or a file with
        periods [s] and accelerations in two columns, whose header states the unit of these; or with a uniform hazard,
        conditional mean or median spectrum of OpenQuake's, ``#`` and the probability of exceedance behind it where it
        has several.
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
    file, wanted = file_of_target(text)
    path = Path(file)
    try:
        if not path.is_file() or path.stat().st_size > _LARGEST_BYTES:
            raise InputError("target-form", field, text)
        content = path.read_text("latin-1")
    except (OSError, ValueError):
        raise InputError("target-form", field, text) from None
    if is_of_openquake(content):
        spectrum, about = spectrum_of_openquake(content, path.name, wanted)
        periods, accelerations = np.array(spectrum).reshape(-1, 2).T
        return table(periods, gravity * accelerations, name=f"{path.stem}, {about}")
    if wanted:
        raise InputError("target-form", field, text)
    return _of_file(content.replace(",", " ").replace(";", " ").splitlines(), path.name, gravity)


def file_of_target(text: str, directory: Path | None = None) -> tuple[str, str]:
    """Return the file that a text names, and behind a `#` which of its spectra, where there is no such file."""
    whole = (directory or Path()) / os.path.expanduser(text)
    if "#" not in text or os.path.isfile(whole):
        return text, ""
    file, _, wanted = text.rpartition("#")
    return file, wanted


def _of_file(lines: list[str], name: str, gravity: float) -> Target:
    header = [line for line in lines if line.strip() and not _DATA.match(line)]
    data = [line for line in lines if _DATA.match(line)]
    units = {unit for line in header for unit in units_in(line)}
    if len(units) != 1:
        raise InputError("target-unit", name)
    if not data:
        raise InputError("target-table", name)
    periods, accelerations = rows_of(data, name, len(header) + 1, 2)
    unit = _unit_of_periods(header[-1], name)
    if unit == "hz":
        if (periods <= 0.0).any():
            raise InputError("target-table", name)
        periods, accelerations = 1.0 / periods[::-1], accelerations[::-1]
    elif unit == "ms":
        periods = 1e-3 * periods
    accelerations = accelerations * acceleration_unit(units.pop(), name).si(gravity)
    return table(periods, accelerations, _damping_of(header), Path(name).stem)


def _damping_of(header: list[str]) -> float:
    """Return the damping ratio that a header states; that of most spectra where it states none."""
    stated = next((match for line in header if (match := _DAMPED.search(line.lower()))), None)
    if stated is None:
        return _USUAL_DAMPING
    if stated[1]:
        return float(stated[1]) / 100.0
    return float(stated[2]) / 100.0 if stated[3] or float(stated[2]) >= 1.0 else float(stated[2])


def _unit_of_periods(heading: str, name: str) -> str:
    """Return what the first of two columns holds, by its heading: periods in ``"s"`` or ``"ms"``, frequencies in
    ``"hz"``; seconds where it does not say."""
    if _LOGARITHM.search(heading.lower()):
        raise InputError("heading-logarithm", name, shown(heading.strip()))
    first = _FIRST_COLUMN.match(heading.lower())
    word, unit = (part.strip() if part else "" for part in first.groups()) if first else ("", "")
    frequency = re.match(r"freq|f\b|hz", word) is not None
    # Brackets without a unit of time are those of the second column.
    known = _PERIODS.get("" if units_in(f"[{unit}]") else unit)
    if known is None or (unit and known and (known == "hz") != (frequency or not word)):
        raise InputError("target-column", name, shown(heading.strip()))
    return known or ("hz" if frequency else "s")
