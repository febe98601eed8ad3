"""Fragility: the probability that a limit is exceeded, given how strong the motion is.

A lognormal curve, ``P = Phi(ln(x / median) / dispersion)``, is fitted by maximum likelihood to which runs exceed the
limit and which do not (Shinozuka et al. 2000; Baker 2015). With fewer than three strengths, or where the runs that
exceed and those that do not do not overlap, there is no curve, only shares with their bounds. Dams that do not stand
before they are shaken have no strength at which they fail: they are a part of their own, and the curve is of the
others.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from typing import Annotated, Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number
from heeltoe.base.distributions import ndtr
from heeltoe.result.outcome import Outcome
from heeltoe.study.answers.confidence import Ends, Knowledge, dispersion_ends, exact_bounds, knowledge_of, median_ends
from heeltoe.study.answers.fit_test import FitTest, fit_test, groups_of
from heeltoe.study.answers.likelihood import SAME, Tally, Witnesses, fit, overlap, within
from heeltoe.study.run.aggregate import SHAKEN, Walk

#: Fewer strengths than these make no curve.
_STRENGTHS = 3


class Share(Block):
    """Runs of one strength, or of about the same where there are many."""

    strength: Annotated[float, Number("Strength of the motions, SI.")]
    runs: Annotated[int, Number("How many runs there are.")]
    exceeding: Annotated[int, Number("How many of them exceed the limit.")]
    share: Annotated[float, Number("Which part that is.")]
    interval: Annotated[
        tuple[float, float], Number("Exact bounds of the share for independent runs (Clopper and Pearson).")
    ]
    fitted: Annotated[float | None, Number("The same by the curve; null without one.")] = None
    fitted_interval: Annotated[tuple[float, float] | None, Number("Interval of that; null where it is not known.")] = (
        None
    )


class NotStanding(Block):
    """The dams that do not stand before they are shaken."""

    count: Annotated[int, Number("How many.")]
    dams: Annotated[int, Number("Number of dams.")]
    runs: Annotated[int, Number("How many runs they have.")]
    share: Annotated[float, Number("Which part of the dams.")]
    interval: Annotated[
        tuple[float, float] | None, Number("Exact bounds of that; null where dams are listed or all stand.")
    ]


class Curve(Block):
    """A fragility curve with its data; `knowledge` is the uncertainty of the curve, None for a single event."""

    model: Annotated[str, Number("The model.")] = ""
    limit: Annotated[str, Number("Name of the limit.")]
    value: Annotated[float, Number("The limit, in SI.")]
    measure: Annotated[str, Number("How strong the motion is by.")]
    confidence: Annotated[float, Number("Probability of the intervals.")]
    median: Annotated[
        float | None, Number("Strength at which half of the dams exceed the limit; null without a curve.")
    ] = None
    dispersion: Annotated[float | None, Number("Standard deviation of the logarithm of that strength.")] = None
    median_interval: Annotated[
        Ends | None, Number("Interval of the median; null for an end that the runs do not give.")
    ] = None
    dispersion_interval: Annotated[Ends | None, Number("Interval of the dispersion, as of the median.")] = None
    record: Annotated[float | None, Number("Part of the dispersion from event to event.")] = None
    other: Annotated[float | None, Number("Part of it that is left where each event has a median of its own.")] = None
    runs: Annotated[int, Number("How many runs are behind the curve.")]
    exceeding: Annotated[int, Number("How many of them exceed the limit.")]
    events: Annotated[int, Number("Number of events.")]
    unknown: Annotated[int, Number("How many runs have no result and are behind no curve.")]
    reached: Annotated[bool, Number("Whether the runs reach up to the median.")] = True
    why: Annotated[str, Number("Why there is no curve; empty where there is one.")] = ""
    interval_why: Annotated[str, Number("Why an interval or an end of one is null; empty where none is.")] = ""
    shares: Annotated[
        tuple[Share, ...], Number("Shares of the runs that exceed, by strength, or by groups of about the same.")
    ] = ()
    gap: Annotated[
        Ends, Number("The strongest motion up to which no run exceeds, and the weakest from which all do, in SI.")
    ] = (None, None)
    fit: Annotated[FitTest | None, Number("A test of whether the curve fits the shares; null without a curve.")] = None
    not_standing: Annotated[
        NotStanding | None, Number("Dams that do not stand before the earthquake; the curve is of the others.")
    ] = None
    knowledge: Knowledge | None = field(default=None, repr=False)

    def probability(self, strength: Floats) -> Floats:
        """Return the probability that the limit is exceeded at some strengths."""
        assert self.median is not None
        assert self.dispersion is not None
        return np.asarray(ndtr(np.log(strength / self.median) / self.dispersion), dtype=np.float64)

    def within(self, strength: Floats) -> tuple[Floats, Floats] | None:
        """Return what the probability lies within at some strengths, each by itself; None where that is not known."""
        if self.knowledge is None:
            return None
        intercept, slope = self.knowledge.region(self.confidence).T[:, :, None]
        chance = ndtr(intercept + slope * np.log(strength))
        return np.asarray(chance.min(axis=0)), np.asarray(chance.max(axis=0))


def not_met(walk: Walk) -> dict[str, dict[str, int]]:
    """Return for each model how many runs do not meet the limits of the case, by the name of the limit: where
    any crack exceeds it, or the dam fails. A run without a result is not counted."""
    limits = walk.limits
    counts = {model: dict.fromkeys(limits, 0) for model in walk.models}
    for runs in walk("model", *walk.judging(limits)):
        judgement, model = runs.judged(walk, limits), runs.model
        for limit, exceeds in judgement.not_met.items():
            for place, name in enumerate(walk.models):
                counts[name][limit] += int(np.count_nonzero((exceeds == 1.0) & (model == place)))
    return counts


def curve(
    limit: str, value: float, measure: str, seen: Tally, *, confidence: float, not_standing: NotStanding | None = None
) -> Curve:
    """Fit a curve.

    Parameters
    ----------
    limit, value, measure
        What is fitted.
    seen
        Which runs of dams that stand exceed the limit, and how strong the motion of each is.
    confidence
        Probability of the intervals.
    not_standing
        The dams that do not stand.
    """
    known = seen.witnesses
    empty = Curve(
        limit=limit,
        value=value,
        measure=measure,
        confidence=confidence,
        runs=seen.runs,
        exceeding=seen.exceeding,
        events=known.events,
        unknown=seen.unknown,
        shares=_shares(known, confidence),
        gap=_gap(known),
        not_standing=not_standing,
    )
    why = _no_curve(known, not_standing)
    if why:
        return replace(empty, why=why)
    logarithm, dispersion = fit(known, np.ones((1, known.runs.size)))[0].tolist()
    if not np.isfinite(dispersion):
        return replace(empty, why="stronger motions exceed it no more often")
    reached = bool(seen.lowest <= np.exp(logarithm) <= seen.highest)
    curve = _with_intervals(
        replace(empty, median=float(np.exp(logarithm)), dispersion=dispersion, reached=reached), known
    )
    test = fit_test(known, logarithm, dispersion, curve.record, curve.other)
    return replace(curve, fit=test, shares=_fitted(curve))


def _no_curve(known: Witnesses, not_standing: NotStanding | None) -> str:
    """Say why no curve can be; empty where one may."""
    runs, hits = float(known.runs.sum()), float(known.exceeding.sum())
    if not runs:
        return "no dam stands" if not_standing and not_standing.count else "no run has a result"
    if not 0.0 < hits < runs:
        return "every run exceeds it" if hits else "no run exceeds it"
    strengths = np.unique(np.rint(known.logarithm / SAME)).size
    if strengths < _STRENGTHS:
        return f"a curve needs motions of three strengths, here there {'is one' if strengths == 1 else 'are two'}"
    if not overlap(known):
        return "the runs that exceed it and those that do not do not overlap: the estimate of the dispersion is zero"
    return ""


def _with_intervals(curve: Curve, known: Witnesses) -> Curve:
    """Return a curve with intervals of its numbers, and the parts of its dispersion."""
    assert curve.median is not None
    assert curve.dispersion is not None
    knowledge = knowledge_of(known, float(np.log(curve.median)), curve.dispersion)
    if knowledge is None:
        return replace(curve, interval_why="one event does not show how events differ")
    region, other = knowledge.region(curve.confidence), within(known, curve.dispersion)
    median, dispersion = median_ends(region), dispersion_ends(region)
    open_end = None in (*median, *dispersion)
    return replace(
        curve,
        median_interval=median,
        dispersion_interval=dispersion,
        record=float(np.sqrt(max(curve.dispersion**2 - other**2, 0.0))),
        other=other,
        interval_why="these runs do not show that stronger motions exceed it more often" if open_end else "",
        knowledge=knowledge,
    )


def _shares(known: Witnesses, confidence: float) -> tuple[Share, ...]:
    """Return which part of the runs exceeds, the weakest motions first."""
    group = groups_of(known)
    columns = (np.exp(group.logarithm).tolist(), group.runs.tolist(), group.exceeding.tolist())
    return tuple(
        Share(
            strength=strength,
            runs=int(runs),
            exceeding=int(hits),
            share=hits / runs,
            interval=exact_bounds(hits, runs, confidence),
        )
        for strength, runs, hits in zip(*columns, strict=True)
    )


def _fitted(curve: Curve) -> tuple[Share, ...]:
    """Return the observed shares of a curve with the probabilities of its fit."""
    strength = np.array([share.strength for share in curve.shares])
    probability, ends = curve.probability(strength).tolist(), curve.within(strength)
    within = [None] * strength.size if ends is None else list(zip(ends[0].tolist(), ends[1].tolist(), strict=True))
    return tuple(
        replace(share, fitted=fitted, fitted_interval=interval)
        for share, fitted, interval in zip(curve.shares, probability, within, strict=True)
    )


def _gap(known: Witnesses) -> Ends:
    """Return the strongest motion up to which no run exceeds, and the weakest from which every run does."""
    over, under = known.exceeding > 0.0, known.exceeding < known.runs
    none = known.logarithm[known.logarithm < known.logarithm[over].min(initial=np.inf) - SAME]
    every = known.logarithm[known.logarithm > known.logarithm[under].max(initial=-np.inf) + SAME]
    return (float(np.exp(none.max())) if none.size else None, float(np.exp(every.min())) if every.size else None)


def counted(walk: Walk, request: Mapping[str, Any]) -> dict[tuple[str, str, float], Tally]:
    """Count which runs of dams that stand exceed the limits that a study asks about, by model, limit and value."""
    limits = walk.asked
    tallies = {(model, *limit): Tally() for model in walk.models for limit in limits}
    measure, ran = walk.measure(request["measure"], request["period"]), set[str]()
    names = dict(limits)
    for runs in walk("model", "event", *SHAKEN, *walk.judging(names)):
        strength, model, event = runs.strength(measure), runs.model, runs.event
        # The crack that exceeds a limit first is the one that counts.
        judgement = runs.judged(walk, names)
        standing = judgement.outcome != Outcome.UNSTABLE
        ran |= {name for place, name in enumerate(walk.models) if (model == place).any()}
        for limit, value in limits:
            exceeds = judgement.exceeds(limit, value)
            for place, name in enumerate(walk.models):
                here = (model == place) & standing
                tallies[name, limit, value].add(strength[here], exceeds[here], event[here])
    return {key: tally for key, tally in tallies.items() if key[0] in ran}


def not_standing(walk: Walk, confidence: float) -> dict[str, NotStanding]:
    """Count for each model the dams that do not stand before they are shaken."""
    models, count = walk.models, walk.dams
    falls, ran = (np.zeros((len(models), count), dtype=bool) for _ in range(2))
    lost = np.zeros(len(models), dtype=np.int64)
    for runs in walk("model", "outcome", "sample"):
        model, sample = runs.model, runs.whole("sample")
        words, code = runs.words("outcome")
        here = np.array(words)[code] == Outcome.UNSTABLE
        ran[model, sample] = True
        falls[model[here], sample[here]] = True
        lost += np.bincount(model[here], minlength=len(models))
    counts = {}
    for place, name in enumerate(models):
        fallen, dams = int(falls[place].sum()), int(ran[place].sum())
        share = fallen / dams if dams else 0.0
        bounds = exact_bounds(fallen, dams, confidence) if fallen and walk.drawn else None
        counts[name] = NotStanding(count=fallen, dams=dams, runs=int(lost[place]), share=share, interval=bounds)
    return counts
