"""Words on studies that several places use: limits, and names of motions beside their strength."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from heeltoe.motion.intensity import MEASURES
from heeltoe.result.contract import JOINT_METER_M
from heeltoe.result.judge import LIMITS
from heeltoe.study.answers.comparison import Compared
from heeltoe.study.answers.sensitivity import FieldEffect
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.systems import Scale, unit_system
from heeltoe.units.write import length, lengths
from heeltoe.views.words.fields import shown_values

#: As headings.
TRAITS = {
    "mean_period_s": "period",
    "significant_duration_s": "duration",
    "magnitude": "magnitude",
    "distance_m": "distance",
}

#: Numbers over the records of a suite, as headings, and as a limit is judged by them.
STATISTICS = {"mean": "mean", "median": "median", "84%": "84 % stay below", "largest": "largest"}
JUDGED = {
    "mean": "the mean of the records",
    "median": "the median of the records",
    "84%": "what 84 % of the records stay below",
    "largest": "the largest of the records",
}

#: Where dams have several.
ABOUT_CRACKS = (
    "cracks count from the crest down; what names no crack is of the one that slips most, and a limit is exceeded "
    "where any crack does"
)


def limit_of(limit: str, value: float, units: str = "si", of: str = "") -> str:
    """Write a limit with its amount; `of` stands between them."""
    unit = LIMITS[limit].unit
    amount = length(value, units) if unit == "m" else f"{value:.3g} {unit}"
    return f"{LIMITS[limit].label}{of} {amount}"


def limits_of(limits: Sequence[tuple[str, float]], units: str = "si") -> dict[tuple[str, float], str]:
    """Write the limits of one table, lengths in one unit."""
    texts = {limit: limit_of(*limit, units) for limit in limits}
    of_length = [limit for limit in texts if LIMITS[limit[0]].unit == "m"]
    amounts = lengths([value for _, value in of_length], units)
    for limit, amount in zip(of_length, amounts, strict=True):
        number, unit = amount.split()
        texts[limit] = f"{LIMITS[limit[0]].label} {number.rstrip('0').rstrip('.') if '.' in number else number} {unit}"
    return texts


def left_out(counts: Compared, units: str) -> str:
    """Say how many runs measures of strength are not compared by."""
    read_to = length(JOINT_METER_M, units)
    return f"{counts.at_rest:,} that slide no {read_to} and {counts.unknown:,} without a slip left out"


def strength_scale(measure: str, units: str = "si") -> Scale:
    """Return the unit in which people read how strong motions are: accelerations in g everywhere."""
    unit = MEASURES[measure][0] if measure in MEASURES else "m/s^2"
    if unit == "m/s^2":
        return Scale(1.0 / STANDARD_GRAVITY, "g")
    return unit_system(units).scale({"m/s": "velocity", "m": "length"}[unit])


def values_phrase(values: Any, units: str = "si", path: str = "") -> str:
    """Write a list of values of a field, or a distribution, as people read it."""
    name = path.rpartition(".")[2]
    if isinstance(values, list):
        return ", ".join(shown_values(values, units, name))
    options = {key.rstrip("_"): value for key, value in values.items() if value is not None}
    texts = dict(zip(options, shown_values(list(options.values()), units, name), strict=True))
    kind = texts.pop("distribution")
    ends = [f"from {texts.pop('from')} to {texts.pop('to')}"] if "from" in texts else []
    return ", ".join([kind, *ends, *(f"{name} {text}" for name, text in texts.items())])


def ends_of(field: FieldEffect, units: str) -> list[tuple[float, str]]:
    """Return the least and the largest slip [m] that values of a field make, and those values as people read them."""
    ends = sorted(field["values"], key=lambda end: end["demand"])
    least, *_, most = [ends[0], *ends]
    texts = shown_values([end["value"] for end in (least, most)], units, field["name"].rpartition(".")[2])
    return [(end["demand"], text) for end, text in zip((least, most), texts, strict=True)]
