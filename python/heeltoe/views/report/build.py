"""A report from a subject: the sections in their order."""

from __future__ import annotations

from heeltoe.plain import plain
from heeltoe.result.write import build_info
from heeltoe.views.report.build_evidence import evidence
from heeltoe.views.report.build_input import defaults, given_input, input_hash, rerun
from heeltoe.views.report.build_method import method
from heeltoe.views.report.build_motion import ground_motion
from heeltoe.views.report.build_question import question
from heeltoe.views.report.build_results import results
from heeltoe.views.report.build_statics import static_checks
from heeltoe.views.report.build_verdict import limits
from heeltoe.views.report.content import Document, References, Section, without_gaps
from heeltoe.views.report.one_unit import one_unit_each
from heeltoe.views.report.subject import Subject


def document(subject: Subject) -> Document:
    """Return the whole report."""
    models = " and ".join(run.model for run in subject.runs)
    hashed = input_hash(subject.case, (subject.first.response.motion, subject.first.response.vertical))
    sections = (
        question(subject),
        given_input(subject),
        ground_motion(subject),
        method(subject),
        results(subject),
        evidence(subject),
        static_checks(subject),
        limits(subject),
        Section("References", (References(subject.references),)),
        rerun(subject),
        defaults(subject),
    )
    blocks = without_gaps(*sections)
    return Document(
        title=subject.title,
        subtitle=f"What the dam does in the earthquake, by {models}",
        footer=f"heeltoe {build_info()['heeltoe']} · input {hashed[:12]}",
        blocks=one_unit_each(blocks, subject.numbers),
        about=tuple((label, plain(words)) for label, words in subject.case.project.rows()),
    )
