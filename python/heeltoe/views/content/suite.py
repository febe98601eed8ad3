"""A suite of records: what the dam does in each earthquake, the numbers over them, and the limits."""

from __future__ import annotations

from collections.abc import Iterator

from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.judge import LIMITS
from heeltoe.result.outcome import Outcome
from heeltoe.study.answers.suite import SuiteLimit, SuiteModel
from heeltoe.units.sentences import quantity
from heeltoe.units.write import NOTHING, digits, length, measured
from heeltoe.views.content.study_subject import StudySubject
from heeltoe.views.content.tree import Block, Code, Inline, Notes, Section, Strong, Table, paragraph
from heeltoe.views.words.numbers import Amount, in_one_unit
from heeltoe.views.words.studies import JUDGED, STATISTICS

# The demands that are lengths people look for.
_DEMANDS = {f"{name}_m": limit.label for name, limit in LIMITS.items() if limit.unit == "m"}
_ACCELERATION = "crest_acceleration_g"


# Traits of records beside their motion: headings, how each is written, and in how many of its SI unit.
_ABOUT = {
    "magnitude": ("M", ".3g", 1.0),
    "distance_m": ("distance", ".3g km", 1e3),
    "vs30_m_s": ("Vs30", ".3g m/s", 1.0),
    "pulse_period_s": ("pulse", ".3g s", 1.0),
    "hazard_share": ("of the hazard", ".2f", 1.0),
    "azimuth_deg": ("worst azimuth", ".3g deg", 1.0),
    "cross_valley_factor": ("with / without across", ".3g", 1.0),
}


def suite_answer(subject: StudySubject) -> list[Block]:
    """Return what a suite says: a sentence and the limits for each model, then its records."""
    suite = subject.results.suite
    if suite is None:
        return []
    blocks: list[Block] = []
    for row in suite.models:
        sentences = [_governing(row, subject.units), _numbers(row, subject.units), *_joints(row, subject.units)]
        blocks.append(paragraph(Strong(f"Answer, {row.model} model. "), " ".join(filter(None, sentences))))
        judged = _judged(row, suite.judge)
        missed = [_limit(check, judged, subject.units) for check in row.limits if not check.met]
        kept = [_limit(check, judged, subject.units) for check in row.limits if check.met]
        if missed:
            blocks.append(Notes("failure", "Limits not met", tuple((text,) for text in missed)))
        if kept:
            blocks.append(paragraph(Strong("Limits met. "), " ".join(kept)))
        blocks.append(_records(row, subject.units))
    return blocks


def suite(subject: StudySubject) -> Section | None:
    """Return the section with records, numbers over them and figures, of a suite."""
    answer = subject.results.suite
    if answer is None:
        return None
    blocks: list[Block] = []
    for row in answer.models:
        blocks.append(_statistics(row, subject.units))
    judged = (
        f"The limits of the case are judged by {JUDGED[answer.judge]}. " if len(answer.models[0].records) > 1 else ""
    )
    blocks.append(
        paragraph(
            "The number of a record is that of its worse sign. A record without a result counts as infinitely far. "
            f"{judged}EN 1998-1:2004, 4.3.3.4.3(3), takes the "
            "mean of seven or more records and the largest of fewer; ASCE/SEI 7-16, 16.4, the mean of eleven."
        )
    )
    return Section("The suite of records", (*blocks, *subject.figure("suite", "suite-spectra")))


def _governing(row: SuiteModel, units: str) -> str:
    """Say which record governs, and what it does."""
    worst = next(record for record in row.records if record.governs)
    count = len(row.records)
    signs = ", each by its worse sign," if any(r.other_sign_residual_slip_m is not None for r in row.records) else ""
    if worst.azimuth_deg is not None:
        signs = ", each by its worst direction,"
    end = f"where the run ends “{worst.outcome}”"
    if worst.residual_slip_m is not None:
        end = f"with a residual slip of {length(worst.residual_slip_m, units)}"
    if count == 1:
        return f"The one record{signs} is {worst.motion}, {worst.sign}, {end}."
    return f"{worst.motion}, {worst.sign}, governs among {count} records{signs.rstrip(',')}, {end}."


def _numbers(row: SuiteModel, units: str) -> str:
    """Say the numbers over the records, of several."""
    if len(row.records) == 1:
        return ""
    numbers = row.statistics[RESIDUAL_SLIP.key]
    if numbers["mean"] is None:
        return "Not every record has a result, so that there is no mean."
    (texts,) = in_one_unit([[Amount(numbers[name], zero="0") for name in ("mean", "median", "84%")]], units)
    return f"The mean is {texts[0]}, the median {texts[1]}; 84 % stay below {texts[2]}."


def _joints(row: SuiteModel, units: str) -> Iterator[str]:
    """Say of each bonded joint whether it cracks, and how far."""
    count = len(row.records)
    for joint in row.joints:
        name = "The bonded joint"
        if len(row.joints) > 1 or (row.limits and any(check.elevation_m is not None for check in row.limits)):
            name += f" at {quantity(joint.elevation_m, '.4g m', units)}"
        cracked, largest = joint.records_cracked, joint.statistics["largest"]
        reach = "not every record has a result" if largest is None else f"over {length(largest, units)}"
        if count > 1:
            at_most = "" if largest is None else " at most"
            yield f"{name} cracks in {cracked} of {count} records{f', {reach}{at_most}' if largest != 0.0 else ''}."
        else:
            yield f"{name} cracks {reach}." if cracked else f"{name} does not crack."


def _judged(row: SuiteModel, judge: str) -> str:
    return JUDGED[judge] if len(row.records) > 1 else "that of the record"


def _limit(check: SuiteLimit, judged: str, units: str) -> str:
    """Say how a number over the records stands to a limit."""
    label, allowed = check.label, measured(check.allowed, check.unit, units)
    if check.elevation_m is not None:
        label += f" at the joint at {quantity(check.elevation_m, '.4g m', units)}"
    if check.value is None:
        return f"The {label}: {judged} is not finite, {allowed} is allowed."
    used = "" if check.utilisation is None else f" ({100.0 * check.utilisation:.0f} %)"
    number = measured(check.value, check.unit, units)
    if not check.certain:
        number += f" ± {measured(check.uncertainty, check.unit, units)}, which decides,"
    return f"The {label}: {judged} is {number} of {allowed} allowed{used}."


def _records(row: SuiteModel, units: str) -> Table:
    """Return the table of the records, the worst first."""
    ranked = sorted(row.records, key=lambda r: (r.governs, r.residual_slip_m is None, r.residual_slip_m or 0.0))
    cells = [
        (
            Amount(record.residual_slip_m, zero="0"),
            Amount(record.other_sign_residual_slip_m, zero="0"),
        )
        for record in reversed(ranked)
    ]
    rows: list[tuple[Inline, ...]] = []
    known = {key: column for key, column in _ABOUT.items() if any(record[key] is not None for record in ranked)}
    for record, (slip, other) in zip(reversed(ranked), in_one_unit(cells, units), strict=True):
        ended = "" if record.outcome == Outcome.OK else f" ({record.outcome})"
        rows.append(
            (
                Code(record.motion),
                *(
                    NOTHING if record[key] is None else quantity(record[key] / of, form, units)
                    for key, (_, form, of) in known.items()
                ),
                digits(record.pga_g, 3),
                record.sign + ended,
                slip,
                other,
            )
        )
    head = ("record", *(column[0] for column in known.values()), "PGA [g]", "worse sign", "slip", "other sign")
    caption = f"The records, {row.model} model, the worst first: residual slips, either way."
    return Table(head, tuple(rows), caption, f"l{'r' * len(known)}rlrr")


def _statistics(row: SuiteModel, units: str) -> Table:
    """Return the table of the numbers over the records."""
    numbers = row.statistics
    # Of one record all of them are its own.
    shown = STATISTICS if len(row.records) > 1 else {"largest": "the record"}
    known = {key: label for key, label in _DEMANDS.items() if key in numbers}
    texts = in_one_unit([[Amount(numbers[key][name], zero="0") for name in shown] for key in known], units)
    rows = tuple((label, *cells) for label, cells in zip(known.values(), texts, strict=True))
    if _ACCELERATION in numbers:
        shakes = [numbers[_ACCELERATION][name] for name in shown]
        rows += (("crest acceleration", *(NOTHING if g is None else measured(g, "g", units) for g in shakes)),)
    over = f"Over {len(row.records)} records" if len(shown) > 1 else "The record"
    caption = f"{over}, {row.model} model, {'each ' * (len(shown) > 1)}by its worse sign."
    return Table(("", *shown.values()), rows, caption, "l" + "r" * len(shown))
