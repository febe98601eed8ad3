"""How often a year a limit is exceeded: a fragility curve over a hazard curve.

The annual rate is the integral of the fragility P over the hazard H [1/year], straight on double logarithmic axes,
from its weakest motion x1 to its strongest xn, and what stronger motions make at least:

    rate = int_x1^xn P(x) |dH(x)| + P(xn) H(xn).

Nothing is known of the hazard beyond its ends, so that what motions from there may add is bounded and not counted: all
of the stronger ones may exceed the limit, H(xn) at most; the weaker ones make what a hazard curve that goes on as it
begins would give, if that keeps the whole below H(x1), and have no bound otherwise. For a power law altogether the rate
is H(median) exp(k^2 dispersion^2 / 2) (Cornell et al. 2002, J. Struct. Eng. 128, 526-533).

Dams that do not stand, a share p0, exceed every limit in every motion: of all dams the rate is
p0 H(x1) + (1 - p0) rate.

Which events make it: were all motions like those of one event, the rate would be that of a fragility of its own median,
with the part of the dispersion that is not from event to event. The share of the event is that rate over the sum of
those of all events.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Annotated, Any

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.blocks import Block, Number
from heeltoe.base.distributions import log_ndtr, ndtr
from heeltoe.study.answers.fragility import Curve
from heeltoe.study.answers.likelihood import Witnesses, offsets

#: Groups of strengths, of which each says how much of the rate it makes.
_GROUPS = 24
#: Shares of what the rate may be by the uncertainty of the fragility curve that its fractiles stay above.
FRACTILES = {"5%": 0.05, "16%": 0.16, "50%": 0.50, "84%": 0.84, "95%": 0.95}
#: Of the dispersion, each of its parts is at least about this much where events are told apart; between so many medians
#: of an event its rate is interpolated.
_LEAST_PART, _OFFSETS = 0.1, 41
#: Nodes of Gauss and Legendre in a piece of the hazard curve; pieces are so short that the hazard falls by no more than
#: a factor of e in one.
_NODES = 10
#: No logarithm is taken of less.
_LEAST = 1e-300


@dataclass(frozen=True, eq=False)
class Motions:
    """The motions that a hazard curve has, as nodes of an integral.

    Attributes
    ----------
    logarithm, rate
        (n,) strengths, and how many motions a year each stands for.
    group
        (n,) of :data:`_GROUPS` in which it lies.
    edges
        Edges of the groups, SI.
    ends, rates
        Logarithms of the weakest and the strongest motion, and how often a year they are exceeded.
    slope
        Slope of the first stretch.
    """

    logarithm: Floats
    rate: Floats
    group: Integers
    edges: Floats
    ends: tuple[float, float]
    rates: tuple[float, float]
    slope: float

    def counted(self, intercept: Floats, slope: Floats) -> Floats:
        """Return the rate of some curves ``Phi(intercept + slope ln x)``, (r,) [1/year]; of motions beyond the
        strongest as many exceed as at that."""
        inside = ndtr(intercept[:, None] + slope[:, None] * self.logarithm) @ self.rate
        return np.asarray(inside + ndtr(intercept + slope * self.ends[1]) * self.rates[1], dtype=np.float64)

    def weaker(self, intercept: float, slope: float) -> float:
        """Return the rate of a curve in weaker motions [1/year] if the hazard went on as it begins; it may be
        infinite."""
        # By parts, with the integral of a power law times the density of a normal distribution.
        at = intercept + slope * self.ends[0]
        steep = self.slope / slope
        logarithm = steep * at + steep**2 / 2.0 + float(log_ndtr(at + steep))
        moved = math.exp(logarithm) if logarithm < 700.0 else math.inf
        return max(moved - float(ndtr(at)), 0.0) * self.rates[0]


def motions_of(strength: Floats, rate: Floats, width: float) -> Motions:
    """Return the motions of a hazard curve.

    Parameters
    ----------
    strength, rate
        The hazard curve, SI and 1/year.
    width
        In how much of the logarithm of the strength a fragility curve rises.
    """
    known, hazard = np.log(strength), np.log(rate)
    edges = np.geomspace(strength[0], strength[-1], _GROUPS + 1)
    cuts = np.unique(np.concatenate([known, np.log(edges[1:-1])]))
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    nodes, rates = list[Floats](), list[Floats]()
    for start, stop in pairwise(cuts.tolist()):
        stretch = int(np.searchsorted(known, start, side="right")) - 1
        length, fall = known[stretch + 1] - known[stretch], hazard[stretch] - hazard[stretch + 1]
        # Parts of the stretch, by which even one that is all but upright has the rate of its ends.
        first, last = (start - known[stretch]) / length, (stop - known[stretch]) / length
        ends = np.linspace(first, last, math.ceil((last - first) * max(fall, length / width)) + 1)
        half = (ends[1:] - ends[:-1]) / 2.0
        at = (ends[:-1] + half)[:, None] + half[:, None] * node
        nodes.append((known[stretch] + at * length).ravel())
        rates.append((half[:, None] * weight * fall * np.exp(hazard[stretch] - fall * at)).ravel())
    logarithm = np.concatenate(nodes)
    group = np.clip(np.searchsorted(np.log(edges), logarithm, side="right") - 1, 0, _GROUPS - 1)
    return Motions(
        *(logarithm, np.concatenate(rates), group, edges),
        ends=(float(known[0]), float(known[-1])),
        rates=(float(rate[0]), float(rate[-1])),
        slope=float((hazard[0] - hazard[1]) / (known[1] - known[0])),
    )


class EventRate(Block):
    """Share of an event in a rate."""

    event: Annotated[str, Number("Name of the event.")]
    median: Annotated[float, Number("Strength at which half of the dams exceed the limit in its motions, in SI.")]
    share: Annotated[float, Number("Share of the rate of standing dams that motions like its own make.")]
    annual_rate: Annotated[float, Number("That part of the rate.")]


class RateAt(Block):
    """Probability of a limit in motions of one strength."""

    strength: Annotated[float, Number("Strength of the motion, in SI.")]
    annual_rate: Annotated[float | None, Number("How often a year it is exceeded at the site; null beyond the curve.")]
    probability: Annotated[float, Number("Probability that the limit is exceeded in such a motion.")]


class AnnualRate(Block):
    """How often a year a limit is exceeded; without a fragility curve nothing but why."""

    model: Annotated[str, Number("The model.")] = ""
    limit: Annotated[str, Number("Name of the limit.")]
    value: Annotated[float, Number("The limit, in SI.")]
    measure: Annotated[str, Number("Strength of the motions by which the curves go.")]
    why: Annotated[str, Number("Why there is no rate; empty where there is one.")]
    annual_rate: Annotated[
        float | None,
        Number(
            "How often a year the limit is exceeded in motions of the hazard curve, by all dams; null without a "
            "fragility curve."
        ),
    ] = None
    annual_rate_bounds: Annotated[
        list[float | None] | None,
        Number(
            "The same at least and at most, with motions beyond the ends of the hazard curve; null where that has no "
            "bound."
        ),
    ] = None
    bounds_why: Annotated[str, Number("Why there is no upper bound; empty where there is one.")] = ""
    annual_rate_interval: Annotated[
        list[float] | None,
        Number("Interval of the rate by the uncertainty of the fragility curve; null of a single event."),
    ] = None
    extrapolated: Annotated[
        float | None,
        Number(
            "Share of the rate of standing dams from beyond the ends of the hazard curve, if that went on as it begins."
        ),
    ] = None
    standing_rate: Annotated[float | None, Number("The rate of the dams that stand.")] = None
    not_standing_rate: Annotated[float | None, Number("The part of the rate that is of dams that do not stand.")] = None
    annual_probability: Annotated[float | None, Number("Probability that it is exceeded at least once in a year.")] = (
        None
    )
    annual_probability_fractiles: Annotated[
        Mapping[str, float] | None,
        Number(
            "Fractiles of the annual probability by the uncertainty of the fragility curve, by name (5%, 16%, 50%, "
            "84%, 95%); null without an interval."
        ),
    ] = None
    return_period_years: Annotated[float | None, Number("Years between exceedances in the mean.")] = None
    contribution: Annotated[list[Mapping[str, float]], Number("Shares of the rate by the strength of the motions.")] = (
        field(default_factory=list)
    )
    by_event: Annotated[
        list[EventRate],
        Number("How much of the rate each event makes, the most first; none of a single event."),
    ] = field(default_factory=list)
    at: Annotated[
        list[RateAt], Number("The limit at each strength of the hazard curve, and at those of hazard.at.")
    ] = field(default_factory=list)


def annual(
    curve: Curve, hazard: Mapping[str, Any], seen: Witnesses | None = None, events: Sequence[str] = ()
) -> AnnualRate:
    """Return how often a year a limit is exceeded.

    Parameters
    ----------
    curve
        The fragility curve of the limit.
    hazard
        ``strength``, SI, and ``annual_rate`` of the hazard curve, and ``at``, other strengths that are asked of.
    seen, events
        The runs behind the curve, and the names of their events.
    """
    strength, rate = np.array(hazard["strength"]), np.array(hazard["annual_rate"])
    bare = AnnualRate(model=curve.model, limit=curve.limit, value=curve.value, measure=curve.measure, why=curve.why)
    if curve.median is None or curve.dispersion is None:
        return bare
    motions = motions_of(strength, rate, curve.dispersion)
    slope = 1.0 / curve.dispersion
    intercept = -math.log(curve.median) * slope
    fallen = 0.0 if curve.not_standing is None else curve.not_standing.share
    standing = float(motions.counted(np.array([intercept]), np.array([slope]))[0])
    total = fallen * motions.rates[0] + (1.0 - fallen) * standing
    low, high = _share_ends(curve)
    chance = fallen + (1.0 - fallen) * ndtr(intercept + slope * motions.logarithm)
    parts = np.bincount(motions.group, chance * motions.rate, _GROUPS)
    points = np.unique([*strength.tolist(), *hazard.get("at", ())])
    probabilities = (fallen + (1.0 - fallen) * curve.probability(points)).tolist()
    most, why, beyond = _beyond(motions, intercept, slope, standing)
    first = motions.rates[0]
    return replace(
        bare,
        annual_rate=total,
        annual_rate_bounds=[total, None if most is None else fallen * first + (1.0 - fallen) * most],
        bounds_why=why,
        annual_rate_interval=_interval(curve, motions, (low, high), curve.confidence),
        extrapolated=beyond,
        standing_rate=standing,
        not_standing_rate=fallen * first,
        annual_probability=-math.expm1(-total),
        annual_probability_fractiles=_fractiles(curve, motions, total),
        return_period_years=1.0 / total if total > 0.0 else None,
        contribution=[
            {"from": start, "to": stop, "share": float(part) / total if total > 0.0 else 0.0}
            for start, stop, part in zip(motions.edges[:-1].tolist(), motions.edges[1:].tolist(), parts, strict=True)
        ],
        by_event=[] if seen is None else _by_event(curve, (strength, rate), standing, seen, events),
        at=[
            RateAt(strength=at, annual_rate=exceeded, probability=probability)
            for at, exceeded, probability in zip(
                points.tolist(), _rates(points, strength, rate), probabilities, strict=True
            )
        ],
    )


def _beyond(motions: Motions, intercept: float, slope: float, counted: float) -> tuple[float | None, str, float]:
    """Return what the rate of standing dams may be at most with motions beyond the ends, None where that has no bound
    and why, and the share from beyond the ends."""
    first, last = motions.rates
    stronger = float(ndtr(intercept + slope * motions.ends[1])) * last
    weaker = motions.weaker(intercept, slope)
    inside = counted - stronger
    beyond = stronger + weaker
    share = 1.0 if math.isinf(beyond) else beyond / (inside + beyond) if inside + beyond > 0.0 else 0.0
    most = inside + last + weaker
    if most <= first:
        return most, "", share
    why = (
        "weaker motions than the hazard curve has exceed the limit, too, and it does not say how many a year there are"
    )
    return None, why, share


def _share_ends(curve: Curve) -> tuple[float, float]:
    """Return what the share of dams that do not stand lies within."""
    fallen = curve.not_standing
    if fallen is None:
        return 0.0, 0.0
    return fallen.interval or (fallen.share, fallen.share)


def _of_region(curve: Curve, motions: Motions, confidence: float) -> tuple[float, float] | None:
    """Return between which rates of standing dams the curves of a region lie; None where none is known."""
    if curve.knowledge is None:
        return None
    rates = motions.counted(*curve.knowledge.region(confidence).T)
    return float(rates.min()), float(rates.max())


def _interval(curve: Curve, motions: Motions, fallen: tuple[float, float], confidence: float) -> list[float] | None:
    """Return what the rate of all dams lies within; None of a single event."""
    rates = _of_region(curve, motions, confidence)
    if rates is None:
        return None
    return [share * motions.rates[0] + (1.0 - share) * rate for share, rate in zip(fallen, rates, strict=True)]


def _fractiles(curve: Curve, motions: Motions, total: float) -> dict[str, float] | None:
    """Return the fractiles of the annual probability; None of a single event."""
    if curve.knowledge is None:
        return None
    share = 0.0 if curve.not_standing is None else curve.not_standing.share
    found = {}
    for name, part in FRACTILES.items():
        rate = total
        if part != 0.5:
            ends = _interval(curve, motions, (share, share), round(abs(2.0 * part - 1.0), 9))
            assert ends is not None
            rate = ends[int(part > 0.5)]
        found[name] = -math.expm1(-rate)
    return found


def _by_event(
    curve: Curve, hazard: tuple[Floats, Floats], total: float, seen: Witnesses, events: Sequence[str]
) -> list[EventRate]:
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
    alone = motions_of(*hazard, other).counted(
        -(math.log(curve.median) + known) / other, np.full(known.size, 1.0 / other)
    )
    rates = np.exp(CubicSpline(known, np.log(np.maximum(alone, _LEAST)))(places))
    made = np.sum(chance * rates, axis=1)
    shares = (made / made.sum()).tolist()
    medians = (curve.median * np.exp(np.sum(chance * places, axis=1))).tolist()
    rows = [
        EventRate(event=event, median=median, share=share, annual_rate=share * total)
        for event, median, share in zip(events, medians, shares, strict=True)
    ]
    return sorted(rows, key=lambda row: -row.share)


def _rates(points: Floats, strength: Floats, rate: Floats) -> list[float | None]:
    """Return how often a year some strengths are exceeded: straight on double logarithmic axes; None beyond its
    ends."""
    made = np.exp(np.interp(np.log(points), np.log(strength), np.log(rate))).tolist()
    on_curve = dict(zip(strength.tolist(), rate.tolist(), strict=True))
    within = (points >= strength[0]) & (points <= strength[-1])
    return [
        on_curve.get(point, value) if inside else None
        for point, value, inside in zip(points.tolist(), made, within.tolist(), strict=True)
    ]
