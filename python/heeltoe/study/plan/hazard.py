"""The hazard curve of a study: how often a year the ground exceeds a strength."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.distribution import Value
from heeltoe.errors.error import InputError, shown
from heeltoe.study.plan.file import Hazard
from heeltoe.study.plan.hazard_file import read_pairs
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


def read_hazard(
    hazard: Hazard, measure: str, gravity: float, directory: Path, period: float | None = None
) -> HazardCurve:
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
    period
        That of ``"sa"`` [s].

    Raises
    ------
    InputError
        Where there is no such curve, or it does not fall.
    """
    quantity, field = QUANTITIES[measure], "hazard.curve"
    if hazard.file is not None:
        field = f"hazard.file: {Path(hazard.file).name}"
        pairs = read_pairs(directory / os.path.expanduser(hazard.file), field, quantity, measure, period)
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
