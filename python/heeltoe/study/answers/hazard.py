"""How often a year a limit is exceeded: a fragility curve over a hazard curve.

The annual rate is the integral of the fragility P over the hazard H [1/year],

    rate = int P(x) |dH(x)|,

P = Phi(ln(x / median) / dispersion), H straight on double logarithmic axes. Of each stretch H = a x^-k it is known in
closed form (with u = ln x, by parts); of a power law altogether it is H(median) exp(k^2 dispersion^2 / 2) (Cornell et
al. 2002, J. Struct. Eng. 128, 526-533).

Which events make it: were all motions like those of one event, the rate would be that of a fragility of its own median,
with the part of the dispersion that is not from event to event. The share of the event is that rate over the sum of
those of all events.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.special import ndtr

from heeltoe.base.arrays import Floats
from heeltoe.study.answers.fragility import Curve
from heeltoe.study.answers.likelihood import Witnesses, offsets

#: Groups of strengths, of which each says how much of the rate it makes.
_GROUPS = 24
#: Shares of what the rate may be by the uncertainty of the fragility curve that its fractiles stay above.
FRACTILES = {"5%": 0.05, "16%": 0.16, "50%": 0.50, "84%": 0.84, "95%": 0.95}
#: Of the dispersion, each of its parts is at least about this much where events are told apart; between so many medians
#: of an event its rate is interpolated.
_LEAST_PART, _OFFSETS = 0.1, 41
#: By how much median and dispersion are moved for the slope of the rate.
_MOVED = 1e-4


def annual(
    curve: Curve, hazard: Mapping[str, Any], seen: Witnesses | None = None, events: Sequence[str] = ()
) -> dict[str, Any]:
    """Return how often a year a limit is exceeded.

    Parameters
    ----------
    curve
        The fragility curve of the limit.
    hazard
        ``strength``, SI, and ``annual_rate`` of the hazard curve, and ``at``, other strengths that are asked of.
    seen, events
        The runs behind the curve, and the names of their events.

    Returns
    -------
    dict
        ``annual_rate`` [1/year] with its interval, from the uncertainty of the curve to first order and not of the
        hazard; ``annual_probability`` with its ``annual_probability_fractiles``; ``return_period_years``;
        ``extrapolated``, the share of the rate from beyond the ends of the hazard curve; ``contribution``, the share
        from each group of strengths; ``by_event``, the median of each event, its share and its part of the rate, the
        largest first; ``at``, the probability of the limit at each strength of the hazard curve, and at
        those that are asked of. None of them where there is no fragility curve.
    """
    strength, rate = np.array(hazard["strength"]), np.array(hazard["annual_rate"])
    document: dict[str, Any] = {"limit": curve.limit, "value": curve.value, "measure": curve.measure, "why": curve.why}
    if curve.median is None or curve.dispersion is None:
        names = ("annual_rate", "annual_rate_interval", "annual_probability", "return_period_years", "extrapolated")
        return {
            **document,
            **dict.fromkeys(names),
            "annual_probability_fractiles": None,
            "contribution": [],
            "by_event": [],
            "at": [],
        }
    total = _total(curve, strength, rate)
    edges = np.geomspace(strength[0], strength[-1], _GROUPS + 1)
    parts = np.diff(_up_to(curve, strength, rate, np.array([0.0, *edges, np.inf])))
    spread = _deviation(curve, strength, rate, total)
    points = np.unique([*strength.tolist(), *hazard.get("at", ())])
    probabilities = curve.probability(points).tolist()
    return {
        **document,
        "annual_rate": total,
        "annual_rate_interval": _interval(curve, total, spread),
        "annual_probability": -math.expm1(-total),
        "annual_probability_fractiles": _fractiles(curve, total, spread),
        "return_period_years": 1.0 / total if total > 0.0 else None,
        "extrapolated": float(parts[0] + parts[-1]) / total if total > 0.0 else 0.0,
        "contribution": [
            {"from": low, "to": high, "share": float(part) / total if total > 0.0 else 0.0}
            for low, high, part in zip(edges[:-1].tolist(), edges[1:].tolist(), parts[1:-1], strict=True)
        ],
        "by_event": [] if seen is None else _by_event(curve, strength, rate, total, seen, events),
        "at": [
            {"strength": at, "annual_rate": exceeded, "probability": probability}
            for at, exceeded, probability in zip(
                points.tolist(), _rates(points, strength, rate), probabilities, strict=True
            )
        ],
    }


def _by_event(
    curve: Curve, strength: Floats, rate: Floats, total: float, seen: Witnesses, events: Sequence[str]
) -> list[dict[str, Any]]:
    """Return how much of the rate each event makes; nothing of a single one."""
    from scipy.interpolate import CubicSpline

    if curve.other is None or total <= 0.0:
        return []
    assert curve.median is not None
    assert curve.dispersion is not None
    # Neither a step nor events that are all alike: the runs of an event are few.
    other = float(np.clip(curve.other, _LEAST_PART * curve.dispersion, (1.0 - _LEAST_PART**2) * curve.dispersion))
    places, chance = offsets(seen, curve.median, math.sqrt(curve.dispersion**2 - other**2), other)
    known = np.linspace(places.min(), places.max(), _OFFSETS)
    alone = [replace(curve, median=curve.median * math.exp(offset), dispersion=other) for offset in known.tolist()]
    rates = np.exp(CubicSpline(known, np.log([_total(event, strength, rate) for event in alone]))(places))
    made = np.sum(chance * rates, axis=1)
    shares = (made / made.sum()).tolist()
    medians = (curve.median * np.exp(np.sum(chance * places, axis=1))).tolist()
    rows = [
        {"event": event, "median": median, "share": share, "annual_rate": share * total}
        for event, median, share in zip(events, medians, shares, strict=True)
    ]
    return sorted(rows, key=lambda row: -row["share"])


def _total(curve: Curve, strength: Floats, rate: Floats) -> float:
    return float(_up_to(curve, strength, rate, np.array([0.0, np.inf]))[-1])


def _up_to(curve: Curve, strength: Floats, rate: Floats, edges: Floats) -> Floats:
    """Return the rate that motions up to some strengths make [1/year], (n,); the edges ascend from zero."""
    logarithm, hazard = np.log(strength), np.log(rate)
    slopes = -np.diff(hazard) / np.diff(logarithm)
    # The first and the last stretch go on beyond the ends.
    ends = np.concatenate([[-np.inf], logarithm[1:-1], [np.inf]])
    with np.errstate(divide="ignore"):
        at = np.log(edges)
    made = np.zeros(edges.size)
    for k, start, stop, log_x, log_h in zip(slopes, ends[:-1], ends[1:], logarithm[:-1], hazard[:-1], strict=True):
        inside = np.clip(at, start, stop)
        made += _stretch(curve, inside, float(k), float(log_h + k * log_x)) - _stretch(
            curve, np.array([start]), float(k), float(log_h + k * log_x)
        )
    return made


def _stretch(curve: Curve, at: Floats, slope: float, level: float) -> Floats:
    """Return the integral of the fragility over ``H = exp(level - slope u)``, up to logarithms of the strength."""
    assert curve.median is not None
    assert curve.dispersion is not None
    middle, spread = math.log(curve.median), curve.dispersion
    below = np.isneginf(at)
    place = np.where(below, 0.0, at)
    # Far above, the hazard is nothing and the fragility one.
    falling = np.where(np.isposinf(at), 0.0, np.exp(level - slope * np.where(np.isfinite(at), at, 0.0)))
    moved = np.exp(level - slope * middle + (slope * spread) ** 2 / 2.0) * ndtr(
        (place - middle) / spread + slope * spread
    )
    return np.where(below, 0.0, moved - ndtr((place - middle) / spread) * falling)


def _rates(points: Floats, strength: Floats, rate: Floats) -> list[float]:
    """Return how often a year some strengths are exceeded: straight on double logarithmic axes, beyond the ends too."""
    at, known, hazard = np.log(points), np.log(strength), np.log(rate)
    stretch = np.clip(np.searchsorted(known, at, side="right") - 1, 0, known.size - 2)
    slope = (hazard[stretch + 1] - hazard[stretch]) / (known[stretch + 1] - known[stretch])
    on_curve = {float(x): float(h) for x, h in zip(strength, rate, strict=True)}
    made = np.exp(hazard[stretch] + slope * (at - known[stretch])).tolist()
    return [on_curve.get(point, value) for point, value in zip(points.tolist(), made, strict=True)]


def _deviation(curve: Curve, strength: Floats, rate: Floats, total: float) -> float | None:
    """Return the standard deviation of the logarithm of the rate, by the covariance of the fragility curve to first
    order; None without one."""
    if curve.covariance is None or total <= 0.0:
        return None
    assert curve.median is not None
    assert curve.dispersion is not None
    moved = [
        replace(curve, median=curve.median * math.exp(_MOVED)),
        replace(curve, dispersion=curve.dispersion * math.exp(_MOVED)),
    ]
    slopes = np.array([math.log(_total(other, strength, rate) / total) / _MOVED for other in moved])
    middle, both, spread = curve.covariance
    variance = float(slopes @ np.array([[middle, both], [both, spread]]) @ slopes)
    return math.sqrt(max(variance, 0.0))


def _interval(curve: Curve, total: float, deviation: float | None) -> list[float] | None:
    """Return what the rate lies within; None without a deviation of its logarithm."""
    if deviation is None:
        return None
    reach = _reach(curve, 0.5 + curve.confidence / 2.0) * deviation
    return [total * math.exp(-reach), total * math.exp(reach)]


def _fractiles(curve: Curve, total: float, deviation: float | None) -> dict[str, float] | None:
    """Return the fractiles of the annual probability; None without a deviation of the logarithm of the rate."""
    if deviation is None:
        return None
    return {name: -math.expm1(-total * math.exp(_reach(curve, share) * deviation)) for name, share in FRACTILES.items()}


def _reach(curve: Curve, share: float) -> float:
    """Return how many standard deviations up a share lies: Student's, since the events are few."""
    from scipy import stats

    return float(stats.t.ppf(share, curve.events - 1))
