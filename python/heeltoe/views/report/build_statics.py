"""Static, pseudo-static and post-seismic checks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from heeltoe.units.sentences import quantity
from heeltoe.units.write import NOTHING
from heeltoe.views.report.content import Block, Code, Inline, Notes, Section, Strong, Table, glued, paragraph
from heeltoe.views.report.subject import Subject
from heeltoe.views.words.numbers import Value

if TYPE_CHECKING:
    from heeltoe.models.statics.checks import Check
    from heeltoe.models.statics.model import Statics

_CASES: tuple[tuple[str, str, str | None], ...] = (
    ("Normal force", "normal_force_n", None),
    ("Force along the crack, + downstream", "shear_force_n", None),
    ("Coefficient of friction", "friction", None),
    ("Cohesive force", "cohesive_force_n", None),
    ("Sliding factor", "sliding_factor", None),
    ("The same on the pieces of the crack", "sliding_factor_on_pieces", None),
    ("Overturning factor", "overturning_factor", None),
    ("Flotation factor", "flotation_factor", None),
    ("Resultant from the heel", "resultant_from_heel_m", "length"),
    ("Stress at the heel, compression +", "heel_stress_pa", None),
    ("Stress at the toe, compression +", "toe_stress_pa", None),
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
# Where there are several.
_OF_ONE = (" This is the crack of [crack]; ", Code("heeltoe statics"), " judges every crack as a section.")


def static_checks(subject: Subject) -> Section | None:
    """Return the section of the static checks; None where there are none."""
    found = subject.statics
    if found is None or not found.checks:
        return None
    blocks: list[Block] = [
        paragraph(
            f"Judged by {found.criteria}: {found.structure} structure, {found.site_information} site information.",
            *(
                (" Slip of the post-seismic case: ", _slip(subject), f" ({found.slip_source}).")
                if found.slip_source
                else ()
            ),
            *(_OF_ONE if subject.case.further_cracks else ()),
        )
    ]
    if found.warnings:
        shown = {each.code for run in subject.runs for each in run.response.warnings}
        own = [each.text(subject.units) for each in found.warnings if each.code not in shown]
        blocks += [Notes("warning", "About the static checks", tuple((text,) for text in own))] if own else []
    blocks += [
        _cases(subject, found),
        _checks(subject, found),
        _missed(found, subject.units),
        remarks(found, subject.units, partial(source_number, subject)),
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


def source_number(subject: Subject, source: str) -> str:
    """Return the number of a source in the list of references."""
    references = subject.references
    return f"[{references.index(source) + 1}]" if source in references else NOTHING


def _slip(subject: Subject) -> Inline:
    return subject.numbers("statics.slip_m")


def _cases(subject: Subject, found: Statics) -> Table:
    n = subject.numbers
    rows: list[tuple[Inline, ...]] = [("Outcome", *(each.outcome for each in found.cases))]
    for label, key, kind in _CASES:
        cells = [n(f"statics.cases.{place}.{key}", kind) for place in range(len(found.cases))]
        if any(isinstance(cell, Value) and cell.number for cell in cells):
            rows.append((label, *cells))
    rows.append(("Resultant in", *(each.resultant_zone or NOTHING for each in found.cases)))
    head = ("", *(each.name for each in found.cases))
    return Table(head, tuple(rows), f"Load cases, {subject.per_width}.", _SHARES[: len(head)])


def _checks(subject: Subject, found: Statics) -> Table:
    n = subject.numbers
    rows: list[tuple[Inline, ...]] = []
    for place, check in enumerate(found.checks):
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


def _missed(found: Statics, units: str) -> Block:
    """Say in words which checks are not met, and by how much."""
    items: list[tuple[Inline, ...]] = [(f"{check.sentence.text(units)}.",) for check in found.checks if not check.met]
    if not items:
        return paragraph("All static checks are met.")
    return Notes("warning", f"Not met: {len(items)} of {len(found.checks)} static checks", tuple(items))


def remarks(found: Statics, units: str, number_of: Callable[[str], str]) -> Notes:
    """Gather what the load cases take for granted, and what there is to say about the required values."""
    notes: dict[str, list[str]] = {}
    for check in found.checks:
        number = number_of(check.source)
        for text in filter(None, check.note.split("; ")):
            if number not in notes.setdefault(text, []):
                notes[text].append(number)
    said: dict[str, list[str]] = {}
    for each in found.cases:
        for taken in each.assumptions:
            said.setdefault(taken.text(units), []).append(each.name)
    # The ways of the earthquake share nearly all.
    remarks = [f"{of[0] if len(of) == 1 else of[0].split()[0]}: {text}." for text, of in said.items()]
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
