"""The hazard curve of a study: how often a year the ground shakes more strongly than so much."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.input_files import read_csv_rows, reason_of
from heeltoe.errors.error import InputError, shown
from heeltoe.study.plan.file import Hazard, Value
from heeltoe.study.plan.problems import Problems
from heeltoe.units.parse import parse, parse_acceleration

#: What each measure of strength holds.
QUANTITIES = {
    "pga": "acceleration",
    "sa": "acceleration",
    "pgv": "velocity",
    "arias": "velocity",
    "cumulative absolute velocity": "velocity",
    "velocity spectrum intensity": "length",
    "housner intensity": "length",
}
_UNIT = re.compile(r"\[([^\[\]]+)\]")
# Bytes; no curve comes near.
_LARGEST = 1_000_000


@dataclass(frozen=True, eq=False)
class HazardCurve:
    """A hazard curve, straight on double logarithmic axes, which goes on beyond its ends as there.

    Attributes
    ----------
    strength
        (n,) ascending, SI.
    rate
        (n,) falling, how often a year it is exceeded [1/year].
    at
        Other strengths of which the study asks, SI.
    """

    strength: Floats
    rate: Floats
    at: tuple[float, ...] = ()

    def to_json(self) -> dict[str, list[float]]:
        """Return it as a study keeps it."""
        return {"strength": self.strength.tolist(), "annual_rate": self.rate.tolist(), "at": list(self.at)}


def read_hazard(hazard: Hazard, measure: str, gravity: float, directory: Path) -> HazardCurve:
    """Read the hazard curve of a study.

    Parameters
    ----------
    hazard
        From the study file.
    measure
        Of strength: that of the fragility curves.
    gravity
        One g [m/s2].
    directory
        Where a relative file is.

    Raises
    ------
    InputError
        Where there is no such curve, or it does not fall.
    """
    quantity, field = QUANTITIES[measure], "hazard.curve"
    if hazard.file is not None:
        field = f"hazard.file: {Path(hazard.file).name}"
        pairs = _of_file(directory / os.path.expanduser(hazard.file), field)
    else:
        pairs = [(str(strength), rate) for strength, rate in hazard.curve or ()]

    def strengths_of(values: Sequence[Value], path: str) -> list[float]:
        numbers, problems = list[float](), Problems()
        for place, value in enumerate(values):
            with problems:
                at = f"{path}[{place}]"
                acceleration = quantity == "acceleration"
                number = parse_acceleration(value, at).si(gravity) if acceleration else parse(value, quantity, at)
                if not 0.0 < number < math.inf:
                    raise InputError("out-of-range", at, str(value), bound="above 0")
                numbers.append(number)
        problems.tell()
        return numbers

    strengths = strengths_of([text for text, _ in pairs], field)
    strength, rate = np.array(strengths), np.array([rate for _, rate in pairs], dtype=np.float64)
    sound = strength.size >= 2 and bool(np.isfinite(strength).all() and np.isfinite(rate).all())
    if not sound or strength[0] <= 0.0 or (np.diff(strength) <= 0.0).any():
        raise InputError("hazard-order", field, shown([text for text, _ in pairs][:4]))
    if (rate <= 0.0).any() or (np.diff(rate) >= 0.0).any():
        raise InputError("hazard-rates", field, shown(rate.tolist()[:4]))
    return HazardCurve(strength, rate, tuple(strengths_of(hazard.at, "hazard.at")))


def _of_file(path: Path, field: str) -> list[tuple[str, float]]:
    """Return strengths with their unit, and rates, of a file of two columns with a header."""
    try:
        rows = read_csv_rows(path, _LARGEST)
    except (OSError, ValueError) as error:
        raise InputError("hazard-unreadable", "hazard.file", shown(str(path)), reason=reason_of(error)) from None
    unit = _UNIT.search(rows[0][0]) if rows else None
    if unit is None:
        raise InputError("hazard-header", field)
    return [_pair(row, unit[1], f"{field}: row {number}") for number, row in enumerate(rows[1:], start=1)]


def _pair(row: Sequence[str], unit: str, field: str) -> tuple[str, float]:
    try:
        strength, rate = row
        return f"{float(strength)!r} {unit}", float(rate)
    except ValueError:
        raise InputError("hazard-row", field, shown(", ".join(row))) from None
