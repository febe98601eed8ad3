"""How far an elastic dam slides whose block slides so far, or holds, in few numbers that need no elastic run.

Straight lines in logarithms, fitted to dams that were run under all models (docs/rigid-or-flexible.md). The numbers of
the fit stand in criterion.json, which the program of the study writes.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Literal

import numpy as np

from heeltoe.units.sentences import Sentence

Regime = Literal["slides", "holds"]
#: A block that slides no farther holds [m].
LEAST_M = 1e-3
#: What counts of a dam whose block holds [m].
FAR_M = 10e-3
#: Share of the cases fitted that lie within what is said.
SHARE = 0.7
# Numbers that differ by less than this part of a limit are on it.
_ROUNDING = 1e-9
#: How a spectral displacement adds to the slip of a block, see :func:`regressor`.
_ADDED = 10.0
#: No line is nearer than this in the mean, as a logarithm.
LEAST_MISSED = 0.1
#: What the numbers are called.
NAMES = {
    "level": "height of the crack over that of the dam",
    "water": "depth of the reservoir over the height of the dam",
    "friction": "coefficient of friction",
    "damping": "damping ratio",
    "rotation": "rotation of the block [rad]",
    "slip": "slip of the block over the spectral displacement",
    "amplification": "acceleration at the crack over that of the ground",
    "period": "first period over the mean period of the motion",
    "margin": "critical over peak acceleration",
    "spectrum": "spectral over peak acceleration",
}


@dataclass(frozen=True)
class Fit:
    """A line through the studied cases.

    Attributes
    ----------
    constant, slopes
        Of the logarithm of the ratio that is foretold over the regressors of numbers, by name.
    spread, widening
        How far the line misses in the mean, and by how much more with the regressor of the first number.
    quantiles
        Of what the line misses over that mean, at evenly spaced shares from 0 to 1.
    ranges
        Least and largest of each number in the cases fitted.
    cases
        How many these are.
    held_back
        Of cases that no fit has seen, by ``"base"`` and ``"height"`` where the crack is: the share within the band, and
        how many they are.
    """

    constant: float
    slopes: Mapping[str, float]
    spread: float
    widening: float
    quantiles: tuple[float, ...]
    ranges: Mapping[str, tuple[float, float]]
    cases: int
    held_back: Mapping[str, tuple[float, int]]

    def at(self, numbers: Mapping[str, float]) -> float:
        """Return the logarithm that the line has."""
        return self.constant + sum(slope * regressor(name, numbers[name]) for name, slope in self.slopes.items())

    def missed(self, numbers: Mapping[str, float]) -> float:
        """Return how far the line misses in the mean."""
        first = next(iter(self.slopes))
        return max(self.spread + self.widening * regressor(first, numbers[first]), LEAST_MISSED)

    def band(self, numbers: Mapping[str, float], share: float = SHARE) -> tuple[float, float]:
        """Return what the middle of this share of like cases lies within."""
        middle, wide = self.at(numbers), self.missed(numbers)
        low, high = (
            math.exp(middle + wide * self._quantile(quantile)) for quantile in (0.5 - share / 2.0, 0.5 + share / 2.0)
        )
        return low, high

    def beyond(self, numbers: Mapping[str, float], value: float) -> float:
        """Return the share of like cases that are larger than a value."""
        shares = np.linspace(0.0, 1.0, len(self.quantiles))
        missed = (math.log(value) - self.at(numbers)) / self.missed(numbers)
        return 1.0 - float(np.interp(missed, self.quantiles, shares))

    def outside(self, numbers: Mapping[str, float]) -> Sentence | None:
        """Name the number that is outside the studied range."""
        for name, (low, high) in self.ranges.items():
            value, slack = numbers[name], _ROUNDING * max(abs(low), abs(high))
            if not low - slack <= value <= high + slack:
                # As many digits as tell the number from both ends.
                ends = {f"{end:.2g}" for end in (low, high)}
                digits = next((count for count in range(2, 16) if f"{value:.{count}g}" not in ends), 16)
                text = f"{{what}} is {{value:.{digits}g}}, studied {{ends:.2g|to}}"
                return Sentence.of(text, what=NAMES[name], value=value, ends=(low, high))
        return None

    def _quantile(self, share: float) -> float:
        place = share * (len(self.quantiles) - 1)
        low = min(int(place), len(self.quantiles) - 2)
        return self.quantiles[low] + (place - low) * (self.quantiles[low + 1] - self.quantiles[low])


def regressor(name: str, number: float) -> float:
    """Return what a line has on its axis for a number.

    The slip of an elastic dam is about that of its block and some spectral displacements more.
    """
    return math.log1p(_ADDED / number) if name == "slip" else math.log(number)


@dataclass(frozen=True)
class Likeness:
    """Measures of a dam, its block and its motion, in SI units.

    Attributes
    ----------
    slip
        Residual slip of the block, without its sign.
    rotation
        Largest rotation of the block.
    first_period, mean_period
        Of the dam with its water, and of the motion.
    peak, spectral, crack
        Peak acceleration of the ground, pseudo-acceleration at the first period, peak acceleration at the crack.
    critical
        Least acceleration of the ground that makes the block slide.
    level, water
        Height of the crack and depth of the reservoir over the height of the dam.
    damping, friction
        Damping ratio of the concrete and coefficient of friction at rest.
    """

    slip: float
    rotation: float
    first_period: float
    mean_period: float
    peak: float
    spectral: float
    crack: float
    critical: float
    level: float
    water: float
    damping: float
    friction: float

    @property
    def displacement(self) -> float:
        """Spectral displacement at the first period [m]."""
        return self.spectral * (self.first_period / (2.0 * math.pi)) ** 2

    @property
    def regime(self) -> Regime:
        """Whether the block slides or holds."""
        return "slides" if self.slip >= LEAST_M else "holds"

    def numbers(self) -> dict[str, float]:
        """Return the dimensionless numbers, by the keys of :data:`NAMES`."""
        return {
            "level": self.level,
            "water": self.water,
            "friction": self.friction,
            "damping": self.damping,
            "rotation": self.rotation,
            "slip": self.slip / self.displacement,
            "amplification": self.crack / self.peak,
            "period": self.first_period / self.mean_period,
            "margin": self.critical / self.peak,
            "spectrum": self.spectral / self.peak,
        }


@cache
def fits() -> dict[str, dict[Regime, Fit]]:
    """Return the fits by model, of blocks that slide and of those that hold.

    The ratio is the slip over that of the block where it slides, over the spectral displacement where it holds.
    """
    document = json.loads(files("heeltoe.models.rigid").joinpath("criterion.json").read_text(encoding="utf-8"))
    return {model: {regime: fit_of(numbers) for regime, numbers in by.items()} for model, by in document.items()}


def fit_of(document: Mapping[str, Any]) -> Fit:
    """Return a fit from its entry in the file."""
    ranges = {name: (low, high) for name, (low, high) in document["ranges"].items()}
    held_back = {place: (share, cases) for place, (share, cases) in document["held_back"].items()}
    return Fit(
        document["constant"],
        document["slopes"],
        document["spread"],
        document["widening"],
        tuple(document["quantiles"]),
        ranges,
        document["cases"],
        held_back,
    )
