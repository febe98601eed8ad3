"""The report of the static checks: the answer, the sections, the checks, and sheets that can be followed by hand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.kernel.build import build_info
from heeltoe.models.statics.joints import Joint, Joints
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.units.sentences import quantity
from heeltoe.views.content.checks import answer_of, load_cases, missed_of, remarks, section_table
from heeltoe.views.content.drawings import drawing
from heeltoe.views.content.input import case_table, named, rerun_section, revisions
from heeltoe.views.content.one_unit import with_one_unit
from heeltoe.views.content.tree import (
    Block,
    Document,
    FigureBlock,
    Inline,
    Notes,
    References,
    Section,
    Strong,
    Table,
    glued,
    paragraph,
    without_gaps,
)
from heeltoe.views.words.numbers import Numbers
from heeltoe.views.words.sheet import Step, lines, sheet_units, steps
from heeltoe.views.words.statics import basis, check_cells, section_warnings

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Of the width of a page: the forces with their origin, and the steps.
_FORCES = (2.3, 1.6, 1.3, 1.7, 1.3, 2.1, 4.2)
_STEPS = (2.6, 2.75, 5.35, 2.8, 1.35, 0.6)
# Static checks that are not met and have room on page one.
MOST_MISSED = 6


@dataclass(frozen=True, eq=False)
class _Subject:
    """Subject of the report."""

    answer: Joints
    figures: Mapping[str, FigureBlock]
    units: str
    command: str = ""

    @property
    def references(self) -> tuple[str, ...]:
        """Sources of the criteria and methods, numbered."""
        return tuple(dict.fromkeys(text for joint in self.answer.joints for text in joint.statics.references))

    def at(self, joint: Joint) -> str:
        """Say where a section is."""
        return quantity(joint.elevation_m, ".5g m", self.units)


def statics_document(
    case: Case, joints: Joints, figures: Mapping[str, Figure], *, units: str = "si", command: str = ""
) -> Document:
    """Return what the report of static checks says, apart from how it looks.

    Parameters
    ----------
    case
        What was asked.
    joints
        The checks.
    figures
        Of the governing section, or of every section, which are changed here to what a report needs.
    units
        ``"si"`` or ``"us"``.
    command
        What was typed to get it.
    """
    from heeltoe.views.figures.statics.all import forces_name

    cases = {
        forces_name(joints, joint, load_case): load_case.name
        for joint in joints.joints
        for load_case in joint.statics.cases
    }
    # The section stands on page one below what is said of it, not above the title.
    drawn = {name: drawing(name, figures[name], _caption(name, cases)) for name in figures}
    shown = {name: replace(figure, held=name == "section") for name, figure in drawn.items()}
    subject = _Subject(joints, shown, units, command)
    several = len(joints.joints) > 1
    sections = (
        _answer(subject),
        _input(case, units),
        _checks(subject, joints.governing),
        *(_sheets(subject, joint) for joint in joints.ranked),
        _method(subject),
        Section("References", (References(subject.references),)),
        _rerun(subject),
    )
    what = f"Static checks at {len(joints.joints)} sections" if several else "Static checks"
    return Document(
        title=plain(case.title) or "Untitled case",
        subtitle=f"{what} by {joints.joints[0].statics.criteria}",
        footer=" · ".join([*named(case), f"heeltoe {build_info()['heeltoe']}", "static checks"]),
        blocks=without_gaps(revisions(case), *sections),
        about=tuple((label, plain(words)) for label, words in case.project.rows()),
    )


def statics_sections(joints: Joints, units: str) -> tuple[Block, ...]:
    """Return what the checks of the governing section rest on, its load cases, the checks and assumptions."""
    subject, joint = _Subject(joints, {}, units), joints.governing
    numbers = Numbers(joint.statics.to_json(), units)
    cases = with_one_unit((load_cases(joint.statics, numbers, ""),), numbers)
    return (*cases, _checks(subject, joint), _basis(subject, joint), References(subject.references))


def sheet_sections(joints: Joints, units: str) -> tuple[Section, ...]:
    """Return the calculation sheets of all sections."""
    return tuple(_sheets(_Subject(joints, {}, units), joint) for joint in joints.ranked)


def _basis(subject: _Subject, joint: Joint) -> Table:
    return Table(
        ("", "value"),
        tuple((label.capitalize(), glued(text)) for label, text in basis(joint.statics, subject.units)),
        f"Basis of the checks, crack at {subject.at(joint)}.",
        "ll",
    )


def _caption(name: str, cases: Mapping[str, str]) -> str:
    if name == "section":
        return "Section of the dam with its crack, water levels and the usual forces."
    if name == "checks":
        return "How far each check is met: from 1 on it is."
    case = cases[name]
    return (
        f"{case[0].upper()}{case[1:]}: forces with their arms from the heel, water pressures, resultant R; below, the "
        "stress on what is closed."
    )


def _answer(subject: _Subject) -> Section:
    """Return page one: the verdict, what is not met, the section, every section of many."""
    joints, units = subject.answer, subject.units
    items = missed_of(joints, units, MOST_MISSED)
    warnings = tuple((glued(text),) for text in section_warnings(joints.joints, units))
    blocks = (
        paragraph(Strong("Answer. "), answer_of(joints, units)),
        Notes("failure", "Not met", tuple(items)) if items else None,
        section_table(joints, units) if len(joints.joints) > 1 else None,
        subject.figures.get("section"),
        Notes("warning", "Before using these numbers", warnings) if warnings else None,
        _basis(subject, joints.governing),
    )
    return Section("Answer", without_gaps(*blocks))


def _input(case: Case, units: str) -> Section:
    system = "US" if units == "us" else "SI"
    text = f"Fields of the case, in {system} units, per {'foot' if system == 'US' else 'metre'} of dam:"
    return Section("Input", (paragraph(text), case_table(case, units, "Given by the case.")))


def _checks(subject: _Subject, joint: Joint) -> Section:
    """Return the checks of the section that governs, and what they take for granted."""
    checked, references = joint.statics, subject.references

    def number(source: str) -> str:
        return f"[{references.index(source) + 1}]" if source in references else "–"

    rows: list[tuple[Inline, ...]] = [
        (*check_cells(check), "yes" if check.met else "NO", number(check.source)) for check in checked.checks
    ]
    table = Table(
        ("load case", "check", "is", "required", "met", "source"),
        tuple(rows),
        f"Checks, crack at {subject.at(joint)}; B: width of the contact, f: compressive strength.",
        "llrrlr",
    )
    blocks = (table, subject.figures.get("checks"), remarks(checked, subject.units, number))
    return Section("Checks", without_gaps(*blocks))


def _sheets(subject: _Subject, joint: Joint) -> Section:
    """Return the calculation sheets of a section, load case by load case."""
    from heeltoe.views.figures.statics.all import forces_name

    blocks: list[Block] = []
    for case in joint.statics.cases:
        figure = subject.figures.get(forces_name(subject.answer, joint, case)) if subject.figures else None
        inner = without_gaps(_forces(subject, case), _steps(subject, case, joint), figure)
        blocks.append(Section(f"{case.name[0].upper()}{case.name[1:]}", inner))
    return Section(f"Calculation sheets, crack at {subject.at(joint)}", tuple(blocks))


def _forces(subject: _Subject, load_case: LoadCase) -> Table:
    written = lines(load_case, subject.units)
    rows = [tuple(map(glued, row)) for row in written.rows]
    rows[-1] = (*rows[-1][:-1], "")
    last: tuple[Inline, ...] = tuple(Strong(cell) if cell else "" for cell in rows[-1])
    name = load_case.name[0].upper() + load_case.name[1:]
    caption = (
        f"{name}: H positive downstream, V upward, M = x\u00a0V\u00a0−\u00a0z\u00a0H counter-clockwise; arms from the "
        "heel of the contact."
    )
    return Table(written.head, (*rows[:-1], last), caption, "lrrrrrl", _FORCES)


def _steps(subject: _Subject, load_case: LoadCase, joint: Joint) -> Table:
    rows: list[tuple[Inline, ...]] = []
    for step in steps(load_case, joint.statics.checks, subject.units):
        rows.append((step.name, step.formula, step.worked, glued(step.value), glued(step.limit), _verdict(step)))
    names = sheet_units(subject.units).names
    caption = f"From the sums to the factors, in {names[0]}, {names[1]} and {names[3]}."
    return Table(
        ("step", "how", "numbers", "is", "required", "met"), tuple(rows), caption, "lllrrl", _STEPS, whole=True
    )


def _verdict(step: Step) -> str:
    return "" if step.met is None else "yes" if step.met else "NO"


def _method(subject: _Subject) -> Section:
    """Return how the steps hang together."""
    texts = (
        "Limit equilibrium of the part of the dam above the crack, per unit of its length. The stress on the closed "
        "part, of length L, is linear: σ = N/L (1 ∓ 6 e'/L) at its ends, e' the distance of the resultant from its "
        "middle, compression positive, water pressure taken off. Where an end of it is in more tension than it "
        "bears, it opens up to the first place whose tip holds, and the water follows as the criteria say; N and e' "
        "change with that length, which is found by Brent's method. The uplift of a sheet is that with the crack open "
        "as far as found: with its force and arm the steps can be followed without iterating.",
        "A force that acts on a slope has two arms, one for each of its parts. In the overturning factor each force "
        "counts as a whole on the side to which it turns the block. B is the width of the contact, c the length that "
        "is open, C the cohesive force, μ the coefficient of friction. The tip of a crack holds where its stress is no "
        "more tension than the tensile strength.",
    )
    return Section("How it is computed", tuple(paragraph(text) for text in texts))


def _rerun(subject: _Subject) -> Section:
    promise = "With the input above, this command writes this report again:"
    return rerun_section(promise, subject.command or "heeltoe statics CASE.toml --report", build_info())
