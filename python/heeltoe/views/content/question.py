"""Page one: the question, the answer, what failed, what to be warned of, the numbers that matter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from heeltoe.result.contract import HEADLINES
from heeltoe.result.outcome import Outcome
from heeltoe.result.rest import comes_to_rest
from heeltoe.result.verdict import advice, limited, verdict
from heeltoe.units.sentences import written
from heeltoe.units.write import NOTHING, digits, measured
from heeltoe.views.content.checks import missed_of
from heeltoe.views.content.subject import Run, Subject
from heeltoe.views.content.tree import (
    Block,
    Code,
    Inline,
    Notes,
    Section,
    Strong,
    Table,
    glued,
    paragraph,
    without_gaps,
)
from heeltoe.views.words.response import listed
from heeltoe.warnings.notice import Notice

# Static checks that are not met and have room on page one; the others are counted there.
_MOST_MISSED = 3
_MAGNITUDES = (
    "Openings and rotations are magnitudes; rotation downstream, about the toe, opens the crack at the upstream face."
)


def question(subject: Subject) -> Section:
    """Return the first section: question, answer, warnings and key numbers."""
    answers: list[Block] = [_question(subject)]
    result = subject.result
    if result.ok:
        answers.append(paragraph(Strong("Answer. "), glued(verdict(result, subject.units))))
    if result.ok and result.beside is not None and result.beside.ok:
        label = f"{subject.runs[0].name.capitalize()} beside it. "
        answers.append(paragraph(Strong(label), glued(result.meaning(subject.units))))
    if result.ok and not result.limits:
        answers.append(
            paragraph(
                "Whether that is safe enough is not judged: the case sets no limits under ", Code("[limits]"), "."
            )
        )
    shown = subject.figure("summary")[:1]
    # The picture before the warnings: it stays on page one, however many these are.
    blocks = (_failures(subject), *answers, _not_met(subject), *shown, _warnings(subject), _numbers(subject))
    return Section("Question and answer", without_gaps(*blocks))


def _question(subject: Subject) -> Block:
    motion = subject.first.prefix + "motion."
    n = subject.numbers
    where = "each of its cracks" if subject.case.further_cracks else "its crack"
    before, after, asked = "How does the part of “", f"” above {where} move", "does it"
    bonded = sum(alone.crack.bond is not None for alone in subject.case.single_crack_cases)
    if bonded:
        before, after = ("Does the joint of “" if bonded == 1 else "Do the joints of “"), "” crack"
        asked = "how far, and does the part above then"
    return paragraph(
        Strong("Question. "),
        before,
        subject.title,
        f"{after} in the ground motion ",
        Code(subject.first.response.motion.name),
        ", ",
        n(motion + "pga_g"),
        " at its peak and ",
        n(motion + "duration_s"),
        f" long: {asked} slide, rock about its heel or its toe, lift off, and where does it come to rest?",
    )


def _failures(subject: Subject) -> Block | None:
    """Say what failed, and why."""
    failed = [run.response for run in subject.runs if not run.response.ok]
    if not failed:
        return None
    items: list[tuple[Inline, ...]] = [
        (
            Strong(f"{run.model[0].upper()}{run.model[1:]}, outcome “{run.response.outcome}”: "),
            f"{advice(run.response, subject.units)}.",
        )
        for run in subject.runs
        if not run.response.ok
    ]
    rest = [run for run in subject.runs if run.response.ok]
    if rest:
        items.append((f"There is nothing to compare; what {rest[0].model} found stands below.",))
    elif failed[0].summary:
        items.append(("Numbers below are those of the moment at which the run stopped; they are no result.",))
    return Notes("failure", "No result to trust", tuple(items))


def _not_met(subject: Subject) -> Block | None:
    """Say which limits and static checks are not met."""
    units = subject.units
    items: list[tuple[Inline, ...]] = []
    for check in subject.result.limits:
        if not check.met:
            value = "" if check.value is None else f" of {measured(check.value, check.unit, units)}"
            doubt = "" if check.certain else f" ± {measured(check.uncertainty, check.unit, units)}"
            used = "" if check.utilisation is None else f", {100.0 * check.utilisation:.0f} % of it"
            text = f"{limited(check, units)}{value}{doubt}, {measured(check.allowed, check.unit, units)} allowed{used}"
            text += f"{', by a dam that has failed' if check.failed else ''}."
            items.append((Strong("Limit. "), glued(text)))
    if subject.joints is not None:
        items += missed_of(subject.joints, units, _MOST_MISSED)
    return Notes("failure", "Not met", tuple(items)) if items else None


def warnings(subject: Subject) -> tuple[str, ...]:
    """Return every warning once; those of one of two models say whose they are."""
    responses = [run.response for run in subject.runs]
    if subject.statics is not None:
        responses = [replace(response, warnings=tuple(_beside_statics(response.warnings))) for response in responses]
    return tuple(listed(responses, subject.units))


def _beside_statics(notices: Sequence[Notice]) -> Iterator[Notice]:
    """Return warnings for a report that has the static checks, which make use of their own fields."""
    for notice in notices:
        quantities = dict(notice.quantities)
        if notice.code != "fields-unused":
            yield notice
            continue
        fields = [path for path in quantities["fields"].split(", ") if not path.startswith("statics.")]
        if fields:
            yield Notice(notice.code, **{**quantities, "fields": ", ".join(fields)})


def _warnings(subject: Subject) -> Block | None:
    notes = warnings(subject)
    return Notes("warning", "Before using these numbers", tuple((glued(text),) for text in notes)) if notes else None


def _numbers(subject: Subject) -> Block:
    if subject.result.several and subject.result.summary:
        return _numbers_of_cracks(subject)
    both = len(subject.runs) > 1
    rows: list[tuple[Inline, ...]] = []
    if any(run.response.summary for run in subject.runs):
        for headline in HEADLINES:
            row = subject.row(headline.full.capitalize(), headline.key, sign=headline.way)
            rows.append(row + ((_ratio(subject, headline.key),) if both else ()))
        rows.append(("At the end of the run", *map(_end, subject.runs), *([""] if both else [])))
    if any(run.response.summary.get("joint") for run in subject.runs):
        rows.append(subject.row("Cracked length of the joint", "joint.cracked_length_m") + (("",) if both else ()))
    tensions = [run.response.summary.get("tension") for run in subject.runs]
    if any(tensions):
        rows.append(subject.row("Largest tension in the concrete", "tension.stress_pa") + (("",) if both else ()))
    if any(tension and tension["strength"] for tension in tensions):
        bears = subject.row("Strength in an earthquake", "tension.strength.dynamic_pa")
        rows.append(bears + (("",) if both else ()))
    static = subject.row("Sliding safety factor before it, uplift of the case", "static.sliding_safety_factor")
    rows.append(static + (("",) if both else ()))
    more = ("flexible / rigid",) if both else ()
    if both and not subject.ran("rigid"):
        more = ("flexible / block",)
    return Table(
        subject.head(*more),
        tuple(rows),
        f"Key numbers, {subject.per_width}. {_MAGNITUDES}",
        subject.align(len(more)),
    )


def _numbers_of_cracks(subject: Subject) -> Block:
    """Return the key numbers at each of several cracks, the one that leads first."""
    result, run = subject.result, subject.first
    places = sorted(range(len(result.cracks)), key=lambda place: place != result.asked)
    blank = ("",) * (len(places) - 1)
    rows: list[tuple[Inline, ...]] = [
        (
            headline.full.capitalize(),
            *(subject.numbers(f"{run.prefix}cracks.{place}.{headline.key}", sign=headline.way) for place in places),
        )
        for headline in HEADLINES
    ]
    bonds = [getattr(result.cracks[place], "joint", None) for place in places]
    if any(bonds):
        lengths = (
            subject.numbers(f"{run.prefix}cracks.{place}.joint.cracked_length_m") if bond else NOTHING
            for place, bond in zip(places, bonds, strict=True)
        )
        rows.append(("Cracked length of the joint", *lengths))
    factors = [result.cracks[place].static.sliding_safety_factor for place in places]
    rows.append(
        (
            "Sliding safety factor before it, uplift of the case",
            *(NOTHING if at is None else digits(at, 4) for at in factors),
        )
    )
    rows.append(("At the end of the run", _end(run), *blank))
    tension = result.summary.get("tension")
    if tension:
        rows.append((*subject.row("Largest tension in the concrete", "tension.stress_pa"), *blank))
    if tension and tension["strength"]:
        rows.append((*subject.row("Strength in an earthquake", "tension.strength.dynamic_pa"), *blank))
    head = (
        "",
        *(written("crack at {at_m:.4g m}", subject.units, at_m=result.cracks[place].elevation) for place in places),
    )
    caption = f"Key numbers, {subject.per_width}; the crack that slips most first. {_MAGNITUDES}"
    return Table(head, tuple(rows), caption, "l" + "r" * len(places))


def _ratio(subject: Subject, key: str) -> Inline:
    return subject.numbers(f"ratio.{key}", "ratio")


def _end(run: Run) -> str:
    if not run.response.summary:
        return NOTHING
    seconds = digits(run.response.end_time_s, 4)
    if not run.response.ok:
        return f"stopped at {seconds} s"
    if run.response.outcome == Outcome.OVERTURNED:
        return f"overturned at {seconds} s"
    return "at rest" if comes_to_rest(run.response) else f"still moving at {seconds} s"
