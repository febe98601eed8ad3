"""The answers of a study in its report: results, fragility, measures of strength, what the slip depends on."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from heeltoe.errors.sanitize import plain
from heeltoe.result.contract import HEADLINES, OPENINGS, RESIDUAL_SLIP
from heeltoe.result.crest import CREST_PEAKS
from heeltoe.result.judge import LIMITS
from heeltoe.result.outcome import Outcome
from heeltoe.study.answers.answers import MODES
from heeltoe.study.answers.comparison import TraitLine
from heeltoe.study.answers.fragility import Curve, Share
from heeltoe.study.answers.hazard import FRACTILES, AnnualRate
from heeltoe.study.answers.sensitivity import Sobol, Tornado
from heeltoe.units.sentences import counted
from heeltoe.units.write import NOTHING, digits, measured, scaled
from heeltoe.views.content.study_subject import StudySubject
from heeltoe.views.content.tree import Block, Code, Inline, Section, Strong, Table, paragraph
from heeltoe.views.words.numbers import Amount, in_one_unit, kind
from heeltoe.views.words.studies import ABOUT_CRACKS, TRAITS, ends_of, left_out, limit_of, limits_of, strength_scale

_SHARES = (("50%", "half stay below"), ("84%", "84 % stay below"), ("95%", "95 % stay below"), ("largest", "largest"))
_NAMES = {"pga": "PGA", "pgv": "PGV", "sa": "SA", "arias": "Arias intensity", "housner intensity": "Housner intensity"}
_SHOWN = (RESIDUAL_SLIP.key, OPENINGS[0].key, "rocking_upstream_rad")


def answer(subject: StudySubject) -> list[Block]:
    """Return what the study says in a few sentences, model by model."""
    blocks: list[Block] = []
    for row in subject.results.summary:
        slip = row[RESIDUAL_SLIP.key]
        sentence = _sliding(row)
        if slip["50%"] is not None:
            (amounts,) = in_one_unit(
                [[Amount(slip[key], zero="0") for key in ("50%", "84%", "largest")]], subject.units
            )
            of = " of the crack that leads" if subject.results.walk.cracks > 1 else ""
            sentence += f"; the residual slip{of}, positive downstream, has the median {amounts[0]}, 84 % stay below "
            sentence += f"{amounts[1]}, and the farthest run ends at {amounts[2]}"
        sentence = " ".join(
            (
                *_do_not_stand(subject, row["model"]),
                f"{sentence}.",
                *_not_kept(subject, row),
                *_exceeded(subject, row["model"]),
                *_probabilities_of_a_year(subject, row["model"]),
            )
        )
        blocks.append(paragraph(Strong(f"Answer, {row['model']} model. "), sentence.strip()))
    return blocks


def _sliding(summary: dict[str, Any]) -> str:
    """Say which part of the runs slides, of those that have a result."""
    runs = summary["runs"]
    known = sum(count for name, count in summary["outcomes"].items() if Outcome(name).has_result)
    if not known:
        return f"None of {runs:,} runs has a result"
    share = summary["share_that_slides"] * runs / known
    those = f"{runs:,} runs" if known == runs else f"the {known:,} runs with a result, of {runs:,},"
    return f"{_percent(share)} of {those} slide more than a joint meter reads"


def _limits(subject: StudySubject) -> dict[str, str]:
    """Return the limits of the base case in words, by their names."""
    return {
        name: f"{LIMITS[name].label} of {measured(value, LIMITS[name].unit, subject.units)}"
        for name, value in subject.results.walk.limits.items()
    }


def _not_kept(subject: StudySubject, summary: dict[str, Any]) -> list[str]:
    """Say how many runs do not meet each limit of the base case."""
    where = ", at one crack at least" if subject.results.walk.cracks > 1 else ""
    return [
        f"{summary['limits_not_met'][name]:,} of {summary['runs']:,} runs exceed the {limit} that the case "
        f"allows{where}."
        for name, limit in _limits(subject).items()
    ]


def _do_not_stand(subject: StudySubject, model: str) -> list[str]:
    """Say how many dams do not stand before they are shaken."""
    study = subject.results
    if not subject.study["fragility"] or not study.not_standing[model].count:
        return []
    fallen = study.not_standing[model]
    bounds = "" if fallen.interval is None else f"; {_percents(fallen.interval)}"
    do = "does" if fallen.count == 1 else "do"
    return [
        f"{fallen.count:,} of {counted(fallen.dams, 'dam')} ({_percent(fallen.share)}{bounds}) {do} not stand before "
        "the earthquake; the curves are of the others."
    ]


def _exceeded(subject: StudySubject, model: str) -> list[str]:
    sentences = []
    for row in subject.results.fragility if subject.study["fragility"] else ():
        if row["model"] != model:
            continue
        what = _article(limit_of(row["limit"], row["value"], subject.units, " of"))
        where = " at any crack" if subject.results.walk.cracks > 1 else ""
        if row["median"] is None:
            sentences += [f"{_upper(what)}{where}: {text}." for text in _without_curve(row, subject.units)]
            continue
        middle, ends = _median(row, subject.units)
        guess = "" if row["reached"] else ", which no motion here has"
        sentences.append(f"Half of the dams exceed {what}{where} at {_article(_named(row))} of {middle}{ends}{guess}.")
        sentences += _misfit(row, subject.units)
    return sentences


def _without_curve(row: Curve, units: str) -> list[str]:
    """Say what is known of a limit that has no curve: the share of the runs, and between which strengths half of the
    dams come to exceed it."""
    scale, shares = strength_scale(row["measure"], units), row["shares"]
    if not shares:
        return [row["why"]]
    at = f" at {_article(_named(row))} of {scaled(shares[0]['strength'], scale)}"
    runs = f"{row['exceeding']:,} of {row['runs']:,} runs exceed it"
    if len(shares) == 1:
        part = _percent(shares[0]["share"])
        bounds = _percents(shares[0]["interval"])
        if row["events"] < row["runs"]:
            bounds += f" if runs were independent; they are of {counted(row['events'], 'event')}"
        return [f"{runs}{at}, {part} ({bounds}); no curve: {row['why']}"]
    low, high = row["gap"]
    if low is None or high is None:
        return [f"{runs}; no curve: {row['why']}"]
    between = f"no run exceeds it up to {scaled(low, scale)}, every run does from {scaled(high, scale)}"
    return [f"{between}, and half of the dams somewhere between; no curve: {row['why']}"]


def _misfit(row: Curve, units: str) -> list[str]:
    """Say where a curve does not fit the runs."""
    fit = row["fit"]
    if fit is None or fit["fits"]:
        return []
    at = scaled(fit["strength"], strength_scale(row["measure"], units))
    return [
        f"This curve does not fit the runs (p = {fit['p']:.2g}): at {at} {_percent(fit['share'])} of them exceed, "
        f"{_percent(fit['fitted'])} by the curve."
    ]


def results(subject: StudySubject) -> Section:
    """Return the section on how runs ended, how far they slide and by which mode."""
    summary, n = subject.results.summary, subject.numbers
    places = range(len(summary))
    head = ("", *(row["model"] for row in summary))
    align = "l" + "r" * len(summary)
    outcomes = sorted({name for row in summary for name in row["outcomes"]})
    ended: list[tuple[Inline, ...]] = [("all runs", *(f"{row['runs']:,}" for row in summary))]
    ended += [(name, *(f"{row['outcomes'].get(name, 0):,}" for row in summary)) for name in outcomes]
    labels = {headline.key: headline.label for headline in HEADLINES}
    crest = [(key, key.rpartition("_")[0].replace("_", " ")) for key in CREST_PEAKS if subject.results.walk.crest]
    rows: list[tuple[Inline, ...]] = [
        ("that slide", *(_percent(row["share_that_slides"]) for row in summary)),
        ("that slide farther than the crack is long", *(f"{row['slid_off']:,}" for row in summary)),
        *(
            (f"that exceed the {limit} allowed", *(f"{row['limits_not_met'][name]:,}" for row in summary))
            for name, limit in _limits(subject).items()
        ),
        ("not determined: bounces amplify the last digit", *(f"{row['undetermined']:,}" for row in summary)),
        *(
            (
                f"{of}{labels[key]}: {what}",
                *(n(f"summary.{place}.{at}{key}.{name}", _QUANTITIES[key]) for place in places),
            )
            for of, at in _of_cracks(subject.results.walk.cracks)
            for key in _SHOWN
            for name, what in _SHARES
        ),
        *(
            (f"{label}: {what}", *(n(f"summary.{place}.{key}.{name}", kind(key)) for place in places))
            for key, label in crest
            for name, what in _SHARES
        ),
        *(
            (f"most of the slip by {mode.replace('_', '-')}", *(_share(row, mode) for row in summary))
            for mode in MODES
            if any(row["dominant_mode"].get(mode) for row in summary)
        ),
    ]
    cracks = f"; {ABOUT_CRACKS}" if subject.results.walk.cracks > 1 else ""
    return Section(
        "Results",
        (
            Table(head, tuple(ended), "How the runs ended.", align),
            Table(head, tuple(rows), f"How the numbers are distributed; slip positive downstream{cracks}.", align),
            *subject.figure("bands", "slips", "modes"),
        ),
    )


_QUANTITIES = {
    RESIDUAL_SLIP.key: "displacement",
    OPENINGS[0].key: "displacement",
    "rocking_upstream_rad": "rotation",
}


def _of_cracks(count: int) -> list[tuple[str, str]]:
    """Return what stands before the labels of the numbers of each crack, and before their names in a summary."""
    return [(f"crack {k + 1}, ", f"cracks.{k}.") for k in range(count)] if count > 1 else [("", "")]


def _share(row: dict[str, Any], mode: str) -> str:
    return _percent(row["dominant_mode"][mode]) if row["dominant_mode"] else NOTHING


def fragility(subject: StudySubject) -> Section | None:
    """Return the section with the fragility curves, where the study asks for some."""
    asked = subject.study["fragility"]
    if asked is None:
        return None
    curves = subject.results.fragility
    rows: list[tuple[Inline, ...]] = []
    for curve, label in zip(curves, _labels(subject, curves), strict=True):
        exceeding = f"{curve['exceeding']:,} of {curve['runs']:,}"
        if curve["median"] is None:
            rows.append((label, "no curve", "", "", "", "", exceeding))
            continue
        median, within = _median(curve, subject.units)
        median += ("" if curve["reached"] else " *") + within
        spread = f"{curve['dispersion']:.2f}{_ends(curve['dispersion_interval'], '{:.2f}'.format)}"
        parts = (_part(curve[name]) for name in ("record", "other"))
        fit = f"{'yes' if curve['fit']['fits'] else 'no'}, p = {curve['fit']['p']:.2g}"
        rows.append((label, median, spread, *parts, fit, exceeding))
    head = (
        "exceeded",
        f"median {_named(asked)}",
        "dispersion",
        "from event to event",
        "other",
        "fits",
        "runs that exceed",
    )
    table = Table(head, tuple(rows), "Fragility.", "lllllrr", (2.9, 2.9, 2.4, 1.5, 1.4, 2.0, 1.8))
    blocks = (paragraph(_about_curves(subject, curves)), table, *_shares(subject, curves))
    return Section("Fragility", (*blocks, *subject.figure("fragility")))


def _about_curves(subject: StudySubject, curves: Sequence[Curve]) -> str:
    """Return what fragility curves are, and which of them is less than that."""
    asked, labels = subject.study["fragility"], _labels(subject, curves)
    text = " ".join(text for model in subject.results.walk.models for text in _do_not_stand(subject, model))
    text += (
        f" Lognormal curves of greatest likelihood over {_named(asked)}. In brackets what median and dispersion lie "
        f"within with {asked['confidence']:.0%}, by profile likelihood, as far as events differ. Dams that have "
        "failed exceed every limit."
    )
    whys: dict[str, list[str]] = {}
    for curve, label in zip(curves, labels, strict=True):
        if curve["median"] is None:
            whys.setdefault(f"no curve: {curve['why']}", []).append(label)
        elif curve["interval_why"]:
            whys.setdefault(f"not all ends of the intervals are known: {curve['interval_why']}", []).append(label)
    text += "".join(f" {_upper(', '.join(those))}: {why}." for why, those in whys.items())
    if any(curve["median"] is not None and not curve["reached"] for curve in curves):
        text += " * stronger or weaker than any motion here: a guess."
    if any(curve["fit"] and not curve["fit"]["fits"] for curve in curves):
        text += " A curve that does not fit says less than the shares of the runs below."
    unknown = max((curve["unknown"] for curve in curves), default=0)
    if unknown:
        text += f" {unknown:,} runs without a result are behind no curve."
    return text.strip()


def _shares(subject: StudySubject, curves: Sequence[Curve]) -> list[Block]:
    """Return for each model which share of the runs exceeds each limit, strength by strength."""
    tables: list[Block] = []
    asked, labels = subject.study["fragility"], _labels(subject, curves)
    for model in subject.results.walk.models:
        own = {label: curve for curve, label in zip(curves, labels, strict=True) if curve["model"] == model}
        if not any(curve["shares"] for curve in own.values()):
            continue
        scale = strength_scale(asked["measure"], subject.units)
        rows: list[tuple[Inline, ...]] = []
        for column in zip(*(curve["shares"] for curve in own.values()), strict=True):
            cells = [
                f"{_percent(share['share'])} ({_percents(share['interval'])}){_by_curve(share)}" for share in column
            ]
            rows.append((scaled(column[0]["strength"], scale), f"{column[0]['runs']:,}", *cells))
        of = f", {model} model" if len(subject.results.walk.models) > 1 else ""
        caption = (
            f"Shares of the runs that exceed{of}, with the bounds that independent runs have with "
            f"{asked['confidence']:.0%} (Clopper and Pearson); behind them, what the curve has."
        )
        tables.append(Table((_named(asked), "runs", *own), tuple(rows), caption, "rr" + "r" * len(own)))
    return tables


def _by_curve(share: Share) -> str:
    return "" if share["fitted"] is None else f"; {_percent(share['fitted'])}"


def hazard_section(subject: StudySubject) -> Section | None:
    """Return the section on how often a year each limit is exceeded, where the study has a hazard curve."""
    annual = subject.results.hazard
    if annual is None:
        return None
    labels = _labels(subject, annual)
    rows: list[tuple[Inline, ...]] = []
    for row, label in zip(annual, labels, strict=True):
        if row["annual_rate"] is None:
            rows.append((label, "no rate", "", "", "", ""))
            continue
        scale = strength_scale(row["measure"], subject.units)
        most = max(row["contribution"], key=lambda part: part["share"])
        around = f"{scaled(most['from'], scale)} to {scaled(most['to'], scale)}"
        interval, least = row["annual_rate_interval"], "" if _bounded(row) else "at least "
        within = NOTHING if interval is None else f"{interval[0]:.1e} to {interval[1]:.1e}"
        rows.append((label, f"{least}{row['annual_probability']:.2e}", within, _at_most(row), _years(row), around))
    study = subject.study["fragility"]
    text = (
        "The annual rate is the fragility curve over the hazard curve, which is straight on double logarithmic axes; "
        "of motions stronger than its last as many count as exceed the limit at that, of weaker ones none. “At most” "
        "has those, too. "
        f"The interval is that of the fragility curve with {study['confidence']:.0%}, by profile likelihood; the "
        "hazard is taken as known."
    )
    known = [(row, label) for row, label in zip(annual, labels, strict=True) if row["annual_rate"] is not None]
    text += "".join(f" {_upper(label)}: {_beyond(row)}." for row, label in known if not _bounded(row))
    parts = [part for model in subject.results.walk.models for part in _with_fallen(subject, model)]
    head = (
        "exceeded",
        "probability a year",
        "rate within",
        "at most",
        "return period",
        f"most at a {_named(study)} of",
    )
    table = Table(head, tuple(rows), "How often a year the limits are exceeded.", "lrrrrr")
    blocks = (
        paragraph(" ".join([text, *parts])),
        table,
        *_fractiles(annual, labels),
        *_by_event(subject, annual, labels),
        *_at_strengths(subject, annual, labels),
        *subject.figure("hazard"),
    )
    return Section("Annual probability", blocks)


#: Bounds of a rate that lie no further apart than this part are one number.
_CLOSE = 0.1


def _bounded(row: AnnualRate) -> bool:
    """Return whether what motions beyond the hazard curve add to a rate hardly matters."""
    low, high = row["annual_rate_bounds"]
    return high is not None and high <= (1.0 + _CLOSE) * low


def _at_most(row: AnnualRate) -> str:
    high = row["annual_rate_bounds"][1]
    return "no bound" if high is None else f"{high:.1e}"


def _beyond(row: AnnualRate) -> str:
    """Say what part of a rate would be made by motions beyond the ends of the hazard curve, and what to do."""
    bound = row["bounds_why"] or f"with motions beyond the hazard curve it is up to {_at_most(row)} a year"
    share = row["extrapolated"]
    part = "nearly all" if share > 0.995 else _percent(share)
    return f"{bound}; if the curve went on as it begins, {part} would come from beyond its ends: extend it"


def _with_fallen(subject: StudySubject, model: str) -> list[str]:
    """Say how dams that do not stand enter the annual rates."""
    if not subject.results.not_standing[model].count:
        return []
    rates = [row for row in subject.results.hazard or () if row["model"] == model and row["annual_rate"] is not None]
    if not rates:
        return []
    fallen = rates[0]["not_standing_rate"]
    alone = " and ".join(f"{row['standing_rate']:.1e}" for row in rates)
    return [
        "Dams that do not stand exceed every limit in every motion of the hazard curve, which makes "
        f"{fallen:.1e} a year of each rate; dams that stand by themselves have {alone} a year."
    ]


def _labels(subject: StudySubject, rows: Sequence[Curve | AnnualRate]) -> list[str]:
    """Return the limits of rows in words, with the model where there are several."""
    limits = limits_of([(row["limit"], row["value"]) for row in rows], subject.units)
    several = len(subject.results.walk.models) > 1
    return [limits[row["limit"], row["value"]] + (f", {row['model']}" if several else "") for row in rows]


def _fractiles(annual: Sequence[AnnualRate], labels: Sequence[str]) -> tuple[Block, ...]:
    """Return the fractiles of the annual probabilities by the uncertainty of the fragility curves."""
    rows: list[tuple[Inline, ...]] = [
        (label, *(f"{row['annual_probability_fractiles'][name]:.2e}" for name in FRACTILES))
        for row, label in zip(annual, labels, strict=True)
        if row["annual_probability_fractiles"]
    ]
    caption = "Fractiles of the annual probabilities by the uncertainty of the fragility curves."
    head = ("exceeded", *(f"{100.0 * share:.0f} %" for share in FRACTILES.values()))
    return (Table(head, tuple(rows), caption, "l" + "r" * len(FRACTILES)),) if rows else ()


def _by_event(subject: StudySubject, annual: Sequence[AnnualRate], labels: Sequence[str]) -> tuple[Block, ...]:
    """Return which events make the annual rates, those that make most of the first one above."""
    known = {label: row for row, label in zip(annual, labels, strict=True) if row["by_event"]}
    if not known:
        return ()
    scale = strength_scale(annual[0]["measure"], subject.units)
    parts = [{part["event"]: part for part in row["by_event"]} for row in known.values()]
    shown = list(parts[0])[:SHOWN_EVENTS]
    rows: list[tuple[Inline, ...]] = [
        (
            plain(event),
            *(f"{_percent(own[event]['share'])}; {scaled(own[event]['median'], scale)}" for own in parts),
        )
        for event in shown
    ]
    some = f"the {len(shown)} that make most of {len(parts[0]):,}" if len(shown) < len(parts[0]) else "all of them"
    caption = (
        f"Events, {some}: the share of the annual rate of dams that stand that motions like theirs make; behind it the "
        f"{_named(subject.study['fragility'])} at which half of the dams exceed the limit in them."
    )
    return (Table(("event", *known), tuple(rows), caption, "l" + "r" * len(known)),)


def _at_strengths(subject: StudySubject, annual: Sequence[AnnualRate], labels: Sequence[str]) -> tuple[Block, ...]:
    """Return the probability of each limit in motions of the strengths of the hazard curve, with their return periods,
    and which share of its annual rate motions up to there make."""
    known = {label: row for row, label in zip(annual, labels, strict=True) if row["at"]}
    if not known:
        return ()
    scale = strength_scale(annual[0]["measure"], subject.units)
    rows: list[tuple[Inline, ...]] = []
    for place, point in enumerate(next(iter(known.values()))["at"]):
        years = NOTHING if point["annual_rate"] is None else f"{digits(1.0 / point['annual_rate'], 3)} years"
        cells = [
            f"{_percent(row['at'][place]['probability'])}; {_percent(_made_up_to(row, point['strength']))}"
            for row in known.values()
        ]
        rows.append((scaled(point["strength"], scale), years, *cells))
    caption = (
        "Probability that a limit is exceeded in a motion of this strength; behind it, the share of the annual rate "
        "that motions up to there make."
    )
    head = (_named(subject.study["fragility"]), "return period", *known)
    return (Table(head, tuple(rows), caption, "l" + "r" * (1 + len(known))),)


def _made_up_to(row: AnnualRate, strength: float) -> float:
    """Return which share of an annual rate motions up to a strength make, of those within the hazard curve."""
    parts = row["contribution"]
    edges = [parts[0]["from"], *(part["to"] for part in parts)]
    made = np.concatenate([[0.0], np.cumsum([part["share"] for part in parts])])
    return float(np.interp(math.log(strength), np.log(edges), made))


def _years(row: AnnualRate) -> str:
    years = row["return_period_years"]
    return NOTHING if years is None or years >= _ENDLESS else f"{digits(years, 2)} years"


#: No one counts in more years.
_ENDLESS = 1e8


def _probabilities_of_a_year(subject: StudySubject, model: str) -> list[str]:
    """Say how often a year each limit is exceeded."""
    sentences = []
    for row in subject.results.hazard or ():
        if row["model"] != model or row["annual_rate"] is None:
            continue
        what = _article(limit_of(row["limit"], row["value"], subject.units, " of"))
        interval = row["annual_rate_interval"]
        within = "" if interval is None else f" ({interval[0]:.1e} to {interval[1]:.1e})"
        years = "" if _years(row) == NOTHING else f", once in {_years(row)}"
        low, high = row["annual_rate_bounds"]
        rate = f"with {low:.1e} a year{within}{years}"
        if not _bounded(row):
            rate = (
                f"at least {low:.1e} times a year{within}" if high is None else f"{low:.1e} to {high:.1e} times a year"
            )
            rate += f": {_beyond(row)}"
        sentences.append(f"With the hazard of the site {what} is exceeded {rate}.")
    return [*sentences, *(_with_fallen(subject, model) if sentences else ())]


#: Events that a table shows.
SHOWN_EVENTS = 12
#: Dams of a portfolio that its table and its figure show.
SHOWN_DAMS = 25


def portfolio(subject: StudySubject) -> list[Block]:
    """Return the dams of a table by their ranks, a table for each model."""
    blocks: list[Block] = []
    for row in subject.results.portfolio or ():
        worst, count = row.dams[:SHOWN_DAMS], len(row.dams)
        limits = [limit_of(limit.limit, limit.value, subject.units) for limit in row.limits]
        one = row.motions == 1
        shown = ("largest",) if one else ("median", "84%", "largest")
        cells = [[Amount(dam.residual_slip_m[name], zero="0") for name in shown] for dam in worst]
        rows: list[tuple[Inline, ...]] = [
            (
                str(dam.rank),
                dam.name,
                *(
                    _exceeds(share, ends, one=one)
                    for share, ends in zip(dam.exceeds, dam.exceeds_interval, strict=True)
                ),
                *texts,
            )
            for dam, texts in zip(worst, in_one_unit(cells, subject.units), strict=True)
        ]
        heads = [limit if one else f"P({limit})" for limit in limits]
        head = ("rank", "dam", *heads, *(("residual slip",) if one else ("half stay below", "84 %", "largest")))
        by = f"by the {'mean ' * (not one)}residual slip"
        if limits:
            by = f"{'by whether they exceed' if one else 'by the share of the motions that exceed'} the {limits[0]}"
        some = f"the {len(worst)} worst of {count:,} dams" if count > len(worst) else f"{count:,} dams"
        over = "in one motion, which has no median" if one else "over the motions"
        signs = "its worse sign" if one else "the worse sign of each"
        caption = f"Ranks {by}, {row.model} model: {some}; residual slips {over}, by {signs}."
        blocks.append(Table(head, tuple(rows), caption, "rl" + "r" * (len(head) - 2)))
    return blocks


def _exceeds(share: float, ends: Sequence[float], *, one: bool) -> str:
    """Write the share of the motions in which a limit is exceeded; of one motion whether it is."""
    return f"{_percent(share)} ({_percents(ends)})" if not one else "exceeded" if share else "kept"


def portfolio_section(subject: StudySubject) -> Section | None:
    """Return the section on the dams of a table, where the study has one."""
    if subject.results.portfolio is None:
        return None
    text = (
        "Each motion counts by its worse sign at each of its strengths. A run without a result counts as infinitely "
        "far; a dash stands for a number that is not finite. The file portfolio.csv has all dams."
    )
    return Section("The portfolio", (paragraph(text), *portfolio(subject), *subject.figure("ranks")))


def measures_compared(subject: StudySubject) -> Section | None:
    """Return the section that compares measures of the strength of motions, where there are several motions."""
    if len({motion["name"] for motion in subject.results.manifest["motions"]}) < 2:
        return None
    blocks: list[Block] = []
    for model, comparison in subject.results.compared().items():
        measures = comparison.measures
        if not measures:
            continue
        traits = [name for name in TRAITS if any(measure.sufficiency.get(name) for measure in measures)]
        rows = tuple(
            (measure.measure, f"{measure.efficiency:.2f}", *(_p(measure.sufficiency[name]) for name in traits))
            for measure in measures
        )
        without = left_out(comparison, subject.units)
        caption = f"Measures of strength, {model} model, over {comparison.runs:,} runs; {without}."
        head = ("measure", "scatter", *(f"p, {TRAITS[name]}" for name in traits))
        blocks.append(Table(head, rows, caption, "l" + "r" * (len(head) - 1)))
    if not blocks:
        return None
    text = (
        "How well each measure foretells the residual slip: the scatter is the standard deviation of the logarithm of "
        "the slip about a line over the logarithm of the measure; less is better. A small p says that what is left "
        "over depends on something else of the events; with few events a large one says little."
    )
    return Section("Measures of strength compared", (paragraph(text), *blocks))


def hangs_on(subject: StudySubject) -> Section | None:
    """Return the section on the sensitivity of the slip, where the study is made for it."""
    method, study = subject.study["method"], subject.results
    if method == "sensitivity":
        blocks = [_sobol(model, numbers) for model, numbers in study.sensitivity().items()]
    elif method == "one at a time":
        blocks = [_tornado(model, numbers, subject.units) for model, numbers in study.tornado().items()]
    else:
        return None
    return Section("Fields that decide the slip", (*blocks, *subject.figure("sobol", "tornado")))


def _sobol(model: str, numbers: Sobol) -> Block:
    if not numbers.indices:
        return paragraph(f"No indices of the {model} model: the slip does not vary.")
    rows: tuple[tuple[Inline, ...], ...] = tuple(
        (Code(index.name), _within(index.first, index.first_interval), _within(index.total, index.total_interval))
        for index in numbers.indices
    )
    left = f"; {numbers.left_out:,} left out with a run without a slip" if numbers.left_out else ""
    caption = f"Sobol’s indices, {model} model, {numbers.confidence:.0%} intervals, over {numbers.rows:,} rows{left}."
    return Table(("field", "by itself", "with all others"), rows, caption, "lrr")


def _tornado(model: str, numbers: Tornado, units: str) -> Block:
    if numbers["base"] is None:
        return paragraph(
            f"No motion gave every dam of the {model} model a slip: nothing can be held against each other."
        )
    amounts = [
        [(Amount(slip, zero="0"), f" ({value})") for slip, value in ends_of(field, units)]
        for field in numbers["fields"]
    ]
    # The case as it is, below the table, has its units.
    *written, (base,) = in_one_unit([*amounts, (Amount(numbers["base"], zero="0"),)], units)
    rows: tuple[tuple[Inline, ...], ...] = tuple(
        (Code(field["name"]), *cells) for field, cells in zip(numbers["fields"], written, strict=True)
    )
    left = f"; {numbers['left_out']:,} left out" if numbers["left_out"] else ""
    caption = (
        f"Mean residual slip, {model} model, over {numbers['motions']:,} motions at their strengths{left}; "
        f"{base} as the case is."
    )
    return Table(("field", "from", "to"), rows, caption, "lrr")


def _within(value: float, interval: Sequence[float]) -> str:
    return f"{value:.2f} ({interval[0]:.2f} to {interval[1]:.2f})"


def _p(line: TraitLine | None) -> str:
    return NOTHING if line is None else f"{line.p:.2f}"


def _part(value: float | None) -> str:
    return NOTHING if value is None else f"{value:.2f}"


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"


def _named(asked: Mapping[str, Any]) -> str:
    period = asked.get("period")
    name = _NAMES.get(asked["measure"], str(asked["measure"]))
    return f"{name} at {period}" if period else name


def _article(name: str) -> str:
    return f"{'an' if name.startswith(('A', 'SA', 'o')) else 'a'} {name}"


def _median(row: Curve, units: str) -> tuple[str, str]:
    """Write the median strength of a curve, and what it lies within."""
    scale = strength_scale(row["measure"], units)
    return scaled(row["median"], scale), _ends(row["median_interval"], lambda value: scaled(value, scale))


def _ends(ends: Sequence[float | None] | None, write: Callable[[float], str]) -> str:
    """Write what a number lies within, in brackets; a side without an end as one."""
    if ends is None:
        return ""
    low, high = ends
    if low is None or high is None:
        return (
            " (no bounds)"
            if low is high
            else f" (above {write(low)})"
            if low is not None
            else f" (below {write(high or 0.0)})"
        )
    return f" ({write(low)} to {write(high)})"


def _percents(ends: Sequence[float]) -> str:
    """Write between which shares something lies."""
    low, high = (f"{100.0 * end:.2g}" if 0.0 < end < 0.995 else f"{100.0 * end:.3g}" for end in ends)
    return f"{low} to {high} %"


def _upper(text: str) -> str:
    return text[:1].upper() + text[1:]
