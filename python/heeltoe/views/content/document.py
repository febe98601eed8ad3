"""A report from a subject: the sections in their order."""

from __future__ import annotations

from heeltoe.errors.sanitize import plain
from heeltoe.kernel.build import build_info
from heeltoe.views.content.checks import static_checks
from heeltoe.views.content.evidence import evidence
from heeltoe.views.content.input import defaults, input_hash, input_section, named, rerun, revisions
from heeltoe.views.content.limitations import limitations
from heeltoe.views.content.limits import limits
from heeltoe.views.content.method import method
from heeltoe.views.content.motion import ground_motion
from heeltoe.views.content.one_unit import with_one_unit
from heeltoe.views.content.question import question
from heeltoe.views.content.results import results
from heeltoe.views.content.subject import Subject
from heeltoe.views.content.tree import Block, Document, References, Section, without_gaps


def run_sections(subject: Subject) -> tuple[Block, ...]:
    """Return what a run did in words and numbers: the report without input, method and appendices."""
    sections = (
        question(subject),
        ground_motion(subject),
        results(subject),
        evidence(subject),
        limits(subject),
    )
    return with_one_unit(sections, subject.numbers)


def document(subject: Subject) -> Document:
    """Return the whole report."""
    models = " and ".join(run.model for run in subject.runs)
    hashed = input_hash(subject.case, subject.first.response.components)
    sections = (
        question(subject),
        limits(subject),
        input_section(subject),
        ground_motion(subject),
        results(subject),
        evidence(subject),
        static_checks(subject),
        limitations(subject),
        method(subject),
        Section("References", (References(subject.references),)),
        rerun(subject),
        defaults(subject),
    )
    blocks = without_gaps(revisions(subject.case), *sections)
    return Document(
        title=subject.title,
        subtitle=f"The dam in the earthquake, by {models}",
        footer=" · ".join([*named(subject.case), f"heeltoe {build_info()['heeltoe']}", f"input {hashed[:12]}"]),
        blocks=with_one_unit(blocks, subject.numbers),
        about=tuple((label, plain(words)) for label, words in subject.case.project.rows()),
    )
