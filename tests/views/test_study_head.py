"""Reports of suites and studies begin as those of runs do: title block, lines to sign, revisions, and the dam."""

from __future__ import annotations

from pathlib import Path

import pytest

import heeltoe
from heeltoe import read_case
from heeltoe.study.plan.file import Study
from heeltoe.study.run.run import run_study
from heeltoe.views.content.study import study_document, study_subject
from heeltoe.views.content.tree import FigureBlock, Section, Table
from heeltoe.views.report.write import build_report
from shared.dams import BASE

PROJECT = {
    "title": "Old mill dam",
    "project": {
        "name": "Safety review",
        "author": "A. Engineer",
        "revision": 2,
        "revisions": [{"revision": 1, "change": "first issue"}, {"revision": 2, "change": "uplift measured"}],
    },
}
RECORD = "elcentro-1940-180-nga"


@pytest.fixture(scope="module")
def case():
    return read_case(BASE, [PROJECT, {"motion.duration": "4 s"}])


def studied(case, place, what):
    if what == "suite":
        return heeltoe.run_suite(case, RECORD, model="rigid", pga="0.3 g", out=place)
    study = {"case": "dam", "model": "rigid", "vary": {"crack.friction": [0.9, 1.0]}}
    return run_study(Study.of(study, Path()), place, case=case)


# The right head is that of the report of a single run of the same case.
@pytest.mark.parametrize("what", [pytest.param("suite", marks=pytest.mark.slow), "study"])
def test_the_head_is_that_of_a_run(case, tmp_path, what):
    run = build_report(case, heeltoe.run(case, "rigid"), units="si", command="")
    results = studied(case, tmp_path / what, what)
    document = study_document(study_subject(results, BASE.parent, "si", "", None))
    assert document.title == run.title == "Old mill dam"
    assert document.about == run.about
    assert dict(document.about)["Approved by"] == ""
    assert isinstance(document.blocks[0], Table)
    assert document.blocks[0] == run.blocks[0]
    assert document.footer.startswith("Safety review · revision 2 · heeltoe ")


@pytest.mark.slow
@pytest.mark.parametrize("what", ["suite", "study"])
def test_the_dam_stands_below_its_heading(case, tmp_path, what):
    results = studied(case, tmp_path / what, what)
    document = study_document(study_subject(results, BASE.parent, "si", "", None))
    heading = "The dam" if what == "suite" else "Fields varied"
    (section,) = [block for block in document.blocks if isinstance(block, Section) and block.title == heading]
    (figure,) = [block for block in section.blocks if isinstance(block, FigureBlock)]
    # A figure that floats goes to the top of a page, above the heading.
    assert figure.held
    assert len(section.blocks) > 1


def test_the_head_follows_the_case_when_a_study_is_asked_again(case, tmp_path):
    study = Study.of({"case": "dam", "model": "rigid", "vary": {"crack.friction": [0.9, 1.0]}}, Path())
    run_study(study, tmp_path / "again", case=case)
    signed = case.with_({"project.approver": "B. Chief"})
    results = run_study(study, tmp_path / "again", case=signed, resume=True)
    document = study_document(study_subject(results, BASE.parent, "si", "", None))
    assert dict(document.about)["Approved by"] == "B. Chief"
