"""Static, pseudo-static and post-seismic checks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from heeltoe.units.sentences import quantity
from heeltoe.units.write import NOTHING
from heeltoe.views.content.subject import Labels, Subject
from heeltoe.views.content.tree import Block, Inline, Notes, Section, Strong, Table, glued, paragraph
from heeltoe.views.words.numbers import Numbers, Value
from heeltoe.views.words.statics import section_rows, verdict_of

if TYPE_CHECKING:
    from heeltoe.models.statics.checks import Check
    from heeltoe.models.statics.joints import Joints
    from heeltoe.models.statics.model import Statics

# Told where cohesion is counted.
_ALONE = "friction_factor"
_CASES: Labels = (
    ("Normal force", "normal_force_n", None),
    ("Force along the crack, + downstream", "shear_force_n", None),
    ("Coefficient of friction", "friction", None),
    ("Cohesive force", "cohesive_force_n", None),
    ("Sliding factor", "sliding_factor", None),
    ("The same by friction alone", _ALONE, None),
    ("The same on the pieces of the crack", "sliding_factor_on_pieces", None),
    ("Overturning factor", "overturning_factor", None),
    ("Flotation factor", "flotation_factor", None),
    ("Resultant from the heel", "resultant_from_heel_m", "length"),
    ("Stress at the heel, compression +", "heel_stress_pa", None),
    ("Stress at the toe, compression +", "toe_stress_pa", None),
    ("Contact width B", "contact_width_m", "length"),
    ("Crack open", "cracked_length_m", "length"),
    ("Width in compression", "compressed_length_m", "length"),
)
_LEVELS = {
    "sliding": "sliding factor 1",
    "sliding_required": "sliding factor that is required",
    "overturning": "crack opens through",
    "flotation": "block floats",
}
# Tables for each have so many columns at most; there are five load cases at most.
_SHARES = "lrrrrr"


def static_checks(subject: Subject) -> Section | None:
    """Return the section of the static checks; None where there are none."""
    result, joints = subject.statics, subject.joints
    if result is None or joints is None or not result.checks:
        return None
    blocks: list[Block] = []
    if len(joints.joints) > 1:
        blocks += [paragraph(answer_of(joints, subject.units)), section_table(joints, subject.units)]
    blocks += [
        paragraph(
            f"Judged by {result.criteria}: {result.structure} structure, {result.site_information} site information.",
            *(
                (" Slip of the post-seismic case: ", _slip(subject), f" ({result.slip_source}).")
                if result.slip_source
                else ()
            ),
        )
    ]
    if result.warnings:
        shown = {warning.name for run in subject.runs for warning in run.response.warnings}
        own = [warning.text(subject.units) for warning in result.warnings if warning.name not in shown]
        blocks += [Notes("warning", "About the static checks", tuple((text,) for text in own))] if own else []
    blocks += [
        load_cases(result, subject.numbers, "statics."),
        _checks(subject, result),
        _missed(result, subject.units),
        remarks(result, subject.units, partial(source_number, subject)),
        _levels(subject),
    ]
    return Section("Static checks", tuple(blocks))


def missed_checks(checks: Sequence[Check], units: str, most: int) -> list[tuple[Inline, ...]]:
    """Return a line for each check that is not met, `most` of them, and one that counts the others."""
    missed = [check for check in checks if not check.met]
    items: list[tuple[Inline, ...]] = [
        (Strong("Static check. "), glued(f"{check.sentence.text(units)}.")) for check in missed[:most]
    ]
    if len(missed) > most:
        items.append((f"{len(missed) - most} more of {len(checks)} static checks; their section lists them.",))
    return items


def missed_of(joints: Joints, units: str, most: int) -> list[tuple[Inline, ...]]:
    """Return a line for each check of the section that governs that is not met, `most` of them, and one that counts
    those at other sections."""
    governing = joints.governing
    items = missed_checks(governing.statics.checks, units, most)
    if len(joints.joints) > 1 and items:
        where = quantity(governing.elevation_m, ".5g m", units)
        items = [(Strong(f"Static check at {where}. "), *rest) for _, *rest in items[:most]] + items[most:]
    others = sum(not check.met for joint in joints.ranked if joint is not governing for check in joint.statics.checks)
    if others:
        items.append((f"{others} more static checks at other sections; the table of sections counts them.",))
    return items


def answer_of(joints: Joints, units: str) -> str:
    """Say how many checks are met, and what governs."""
    joint, worst = joints.governing, joints.governing.governing
    checks = [check for section in joints.joints for check in section.statics.checks]
    missed = sum(not check.met for check in checks)
    sentence = verdict_of(joint.statics)
    if len(joints.joints) > 1:
        sentence = f"{missed} of {len(checks)} checks fail" if missed else f"all {len(checks)} checks are met"
        where = quantity(joint.elevation_m, ".5g m", units)
        sentence += f" at {len(joints.joints)} sections; the section at {where} governs"
    if worst is not None and worst.margin is not None:
        sentence += (
            f". The governing check is the {worst.name} ({worst.load_case}): {worst.margin:.2f} of the required value"
        )
    return glued(f"{sentence[0].upper()}{sentence[1:]}.")


def section_table(joints: Joints, units: str) -> Table:
    """Return the table of the sections."""
    head, rows = section_rows(joints, units)
    caption = (
        "Sections, the governing one first. Margin: value over required value of the governing check; sliding, "
        "overturning: smallest factors of all load cases; open: longest crack."
    )
    return Table(head, tuple(rows), caption, "rllrrrrr")


def source_number(subject: Subject, source: str) -> str:
    """Return the number of a source in the list of references."""
    references = subject.references
    return f"[{references.index(source) + 1}]" if source in references else NOTHING


def _slip(subject: Subject) -> Inline:
    return subject.numbers("statics.slip_m")


def load_cases(checked: Statics, numbers: Numbers, prefix: str) -> Table:
    """Return the table of the load cases; `prefix` is where the static checks stand in the JSON of the numbers."""
    rows: list[tuple[Inline, ...]] = [("Outcome", *(case.outcome for case in checked.cases))]
    for label, key, kind in _CASES:
        if key == _ALONE and not any(case.cohesive_force_n for case in checked.cases):
            continue
        cells = [numbers(f"{prefix}cases.{place}.{key}", kind) for place in range(len(checked.cases))]
        if any(isinstance(cell, Value) and cell.number for cell in cells):
            rows.append((label, *cells))
    rows.append(("Overturning about the", *(case.overturning_about for case in checked.cases)))
    rows.append(("Resultant in", *(case.resultant_zone or NOTHING for case in checked.cases)))
    head = ("", *(case.name for case in checked.cases))
    per = "per foot of dam" if numbers.units.name == "us" else "per metre of dam"
    return Table(head, tuple(rows), f"Load cases, {per}.{entered(checked, numbers.units.name)}", _SHARES[: len(head)])


def entered(checked: Statics, units: str) -> str:
    """Say that the usual loads are those with water in what they open, where that makes them others than a run of the
    earthquake has before it; nothing where it does not."""
    usual = next((case for case in checked.cases if case.name == "usual"), None)
    if usual is None or not usual.cracked_length_m:
        return ""
    opened = quantity(usual.cracked_length_m, ".3g m", units)
    return (
        f" The usual loads open {opened} of the crack, and water enters it: their uplift and their factors are not "
        "those of runs of the earthquake, which keep the uplift of the case."
    )


def _checks(subject: Subject, checked: Statics) -> Table:
    n = subject.numbers
    rows: list[tuple[Inline, ...]] = []
    for place, check in enumerate(checked.checks):
        key = f"statics.checks.{place}."
        unit = {"resultant": " of width", "compression": " of strength"}.get(check.name, "")
        value, required = (_with(n(key + name), unit) for name in ("value", "required"))
        sign = "≥ " if check.at_least else "≤ "
        bound = _with(required, "", sign)
        rows.append(
            (
                check.load_case,
                check.name,
                value,
                bound,
                "yes" if check.met else "NO",
                source_number(subject, check.source),
            )
        )
    head = ("load case", "check", "value", "required", "met", "source")
    return Table(head, tuple(rows), "Static checks; factors have no unit.", "llrrlr")


def _with(cell: Inline, unit: str, sign: str = "") -> Inline:
    return Value(cell.key, cell.number, f"{sign}{cell.text}{unit}") if isinstance(cell, Value) else cell


def _missed(checked: Statics, units: str) -> Block:
    """Say in words which checks are not met, and by how much."""
    items: list[tuple[Inline, ...]] = [(f"{check.sentence.text(units)}.",) for check in checked.checks if not check.met]
    if not items:
        return paragraph("All static checks are met.")
    return Notes("warning", f"Not met: {len(items)} of {len(checked.checks)} static checks", tuple(items))


def remarks(checked: Statics, units: str, number_of: Callable[[str], str]) -> Notes:
    """Gather what the load cases take for granted, and what there is to say about the required values."""
    notes: dict[str, list[str]] = {}
    for check in checked.checks:
        number = number_of(check.source)
        for text in filter(None, check.note.split("; ")):
            if number not in notes.setdefault(text, []):
                notes[text].append(number)
    places: dict[str, list[str]] = {}
    for load_case in checked.cases:
        for taken in load_case.assumptions:
            places.setdefault(taken.text(units), []).append(load_case.name)
    # The ways of the earthquake share nearly all.
    remarks = [f"{of[0] if len(of) == 1 else of[0].split()[0]}: {text}." for text, of in places.items()]
    remarks += [f"{', '.join(sorted(numbers))}: {note}." for note, numbers in notes.items()]
    return Notes("note", "Taken for granted", tuple((text,) for text in remarks))


def _levels(subject: Subject) -> Table:
    n = subject.numbers
    rows: list[tuple[Inline, ...]] = []
    for name, label in _LEVELS.items():
        cell = n(f"statics.critical_water_level_m.{name}", "length")
        rows.append((label, "none" if cell == NOTHING else cell))
    assert subject.statics is not None
    highest = quantity(subject.statics.highest_water_level_m, ".4g m", subject.units)
    caption = f"Water levels at which the usual loads get critical, looked for up to {highest}."
    return Table(("", "depth of the reservoir"), tuple(rows), caption, "lr")
