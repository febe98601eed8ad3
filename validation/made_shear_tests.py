"""Shear tests made from a law with known numbers and normal scatter."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from heeltoe.mechanics.law_fit import LawFits, fit_laws
from heeltoe.mechanics.shear_tests import Curve, ShearTest

#: Normal stresses of the tests [Pa], standard deviation of their strengths [Pa] and frictions.
STRESSES = np.repeat(np.linspace(0.1e6, 2e6, 8), 3)
SCATTER, SCATTER_FRICTION = 0.06e6, 0.03
SPEEDS = np.tile([0.001, 0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0], 3)
WALLS, ROUGHNESS, ANGLE = 20e6, 10.0, math.radians(30.0)


def shear_test(normal: float, peak: float = math.nan, residual: float = math.nan, **more: object) -> ShearTest:
    """Return a test that says no more than it is given."""
    fields: dict[str, object] = {
        "specimen": "A",
        "surface": "",
        "stage": 1,
        "speed_m_s": math.nan,
        "size_m": math.nan,
        "wall_strength_pa": math.nan,
        **more,
    }
    return ShearTest(normal_pa=normal, peak_pa=peak, residual_pa=residual, **fields)  # type: ignore[arg-type]


def bilinear(s: float) -> float:
    """Two lines that meet at 0.8 MPa, after Patton."""
    return 1.6 * s if s < 0.8e6 else 1.6 * 0.8e6 + 0.6 * (s - 0.8e6)


def barton(s: float) -> float:
    """The equation of Barton and Choubey, written by hand."""
    return s * math.tan(ANGLE + math.radians(ROUGHNESS) * math.log10(WALLS / s))


def _peaks(
    strength: Callable[[float], float], random: np.random.Generator, wall_strength_pa: float = math.nan
) -> list[ShearTest]:
    return [shear_test(s, strength(s) + SCATTER * random.normal(), wall_strength_pa=wall_strength_pa) for s in STRESSES]


def _with_residuals(random: np.random.Generator) -> list[ShearTest]:
    def scattered(strength: float) -> float:
        return strength + SCATTER * random.normal()

    return [shear_test(s, scattered(barton(s)), scattered(s * math.tan(ANGLE))) for s in STRESSES]


def curves(
    random: np.random.Generator, fall: float, form: str = "linear", specimens: int = 8, scatter: float = 0.02
) -> list[ShearTest]:
    """Return curves of specimens that differ, from a friction of 1.0 down by a fall within 20 mm."""
    slip = np.linspace(0.0, 0.06, 60)
    tests = []
    for number in range(specimens):
        peak = 1.0 + 2.5 * scatter * random.normal()
        lost = fall * (1.0 + 5.0 * scatter * random.normal())
        way = 0.02 * math.exp(7.5 * scatter * random.normal())
        share = np.minimum(slip / way, 1.0) if form == "linear" else 1.0 - np.exp(-slip / way)
        ratio = peak - lost * share + scatter * random.normal(size=slip.size)
        first, last = 1e6 * float(ratio[:5].mean()), 1e6 * float(ratio[-20:].mean())
        tests.append(shear_test(1e6, first, last, specimen=str(number), curve=Curve(slip, ratio)))
    return tests


def speeds(random: np.random.Generator, fall: float) -> list[ShearTest]:
    """Return frictions at several speeds, from 1.0 down by a fall that 0.1 m/s leaves 1/e of."""
    return [
        shear_test(
            1e6,
            residual=1e6 * (1.0 - fall * (1.0 - math.exp(-v / 0.1)) + SCATTER_FRICTION * random.normal()),
            speed_m_s=v,
        )
        for v in SPEEDS
    ]


@dataclass(frozen=True)
class Made:
    """Tests by a law, with its name in the fits and its numbers."""

    law: str
    make: Callable[[np.random.Generator], Sequence[ShearTest]]
    numbers: dict[str, float]


_FALL = {"peak_friction": 1.0, "residual_friction": 0.7, "slip": 0.02}
MADE = {
    "constant": Made("constant", lambda random: _peaks(lambda s: 0.9 * s, random), {"friction": 0.9}),
    "Coulomb": Made(
        "cohesion",
        lambda random: _peaks(lambda s: 0.9 * s + 0.4e6, random),
        {"residual_friction": 0.9, "cohesion": 0.4e6},
    ),
    "bilinear": Made(
        "bilinear",
        lambda random: _peaks(bilinear, random),
        {"steep_friction": 1.6, "flat_friction": 0.6, "break_stress": 0.8e6},
    ),
    "Barton-Bandis, walls measured": Made(
        "barton-bandis",
        lambda random: _peaks(barton, random, wall_strength_pa=WALLS),
        {"jrc": ROUGHNESS, "residual_angle": ANGLE},
    ),
    "Barton-Bandis, residual strengths": Made(
        "barton-bandis", _with_residuals, {"jrc": ROUGHNESS, "jcs": WALLS, "residual_angle": ANGLE}
    ),
    "slip weakening, linear": Made("slip weakening", lambda random: curves(random, 0.3), _FALL),
    "slip weakening, exponential": Made("slip weakening", lambda random: curves(random, 0.3, "exponential"), _FALL),
    "speed weakening": Made(
        "speed weakening",
        lambda random: speeds(random, 0.15),
        {"peak_friction": 1.0, "residual_friction": 0.85, "speed": 0.1},
    ),
}


def covered(made: Made, fits: LawFits) -> dict[str, bool]:
    """Return whether the interval of each number has the true one."""
    fit = next(fit for fit in fits.fits if fit.law.startswith(made.law))
    found = {number.name: number for number in fit.parameters}
    return {name: name in found and found[name].low <= true <= found[name].high for name, true in made.numbers.items()}


def coverage(made: Made, draws: int, seed: int = 1) -> dict[str, int]:
    """Return in how many draws the interval of each number has the true one."""
    random = np.random.default_rng(seed)
    counts = dict.fromkeys(made.numbers, 0)
    for _ in range(draws):
        for name, hit in covered(made, fit_laws(made.make(random))).items():
            counts[name] += hit
    return counts


def falls_found(make: Callable[[np.random.Generator], Sequence[ShearTest]], draws: int, seed: int = 2) -> int:
    """Return in how many draws a fall is found."""
    random = np.random.default_rng(seed)
    return sum(any(fall.found for fall in fit_laws(make(random)).falls) for _ in range(draws))
