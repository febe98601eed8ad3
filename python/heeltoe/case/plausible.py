"""In which range a number of a case is seldom a mistake: one rule for all of them, which `heeltoe explain` shows.

A number outside is allowed, and warned of: as a rule it is one in another unit.
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Plausible(NamedTuple):
    """The range of a field: its ends, with their unit as people write it, the template of a sentence about a number
    outside, and the name of the number in it. Numbers are SI, but for peaks in g."""

    low: float
    high: float
    unit: str
    sentence: str
    quantity: str


_WATER = Plausible(950.0, 1300.0, "kg/m^3", "{density_kg_m3:g kg/m^3} is unusual for water", "density_kg_m3")

#: By the path of the field.
PLAUSIBLE = {
    "gravity": Plausible(
        9.7,
        10.0,
        "m/s^2",
        "{gravity_m_s2:.4g m/s^2} is not that of the earth, 9.807 m/s^2: check its unit",
        "gravity_m_s2",
    ),
    # From a weir to the highest gravity dam, 285 m; without water it is a block in a laboratory.
    "section.height": Plausible(3.0, 350.0, "m", "{height_m:.3g m} is unusual for a dam: check its unit", "height_m"),
    "concrete.density": Plausible(
        1800.0, 3200.0, "kg/m^3", "{density_kg_m3:g kg/m^3} is unusual for concrete", "density_kg_m3"
    ),
    "concrete.modulus": Plausible(5e9, 6e10, "Pa", "{modulus_pa:.4g GPa} is not that of concrete", "modulus_pa"),
    "concrete.damping": Plausible(
        0.0, 0.15, "", "{damping:.2g %} is more than a dam has on its rock: a ratio of 5 % is 0.05", "damping"
    ),
    # From fresh water to a flood full of silt.
    "reservoir.density": _WATER,
    "tailwater.density": _WATER,
    # A peak above 3 g is warned of whether or not its peak is stated.
    "motion.pga": Plausible(0.05, math.inf, "g", "{peak_g:.2g g} is hardly felt by a dam: check its unit", "peak_g"),
}
