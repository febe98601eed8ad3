"""Numbers, input and sentences of the report, in SI and in US customary units."""

from __future__ import annotations

import pytest

from heeltoe.case.combinations import unsupported_features
from heeltoe.case.project import Project
from heeltoe.result.verdict import verdict
from heeltoe.units.write import digits
from heeltoe.views.content.one_unit import with_one_unit
from heeltoe.views.content.tree import Document, Table, glued
from heeltoe.views.report.html import html
from heeltoe.views.report.typst_pdf import source
from heeltoe.views.report.write import build_report
from heeltoe.views.words.fields import shown
from heeltoe.views.words.numbers import Numbers, kind
from heeltoe.views.words.response import crack_rows
from shared.dams import example
from shared.evidence import scattered, scattered_below


def test_numbers_stay_with_their_units():
    text = glued("it slides 0.16 to 57.2 mm in 5 of 12 cases, ends at 0.268 m/s, 66 %")
    assert text == "it slides 0.16 to 57.2\u00a0mm in 5 of 12 cases, ends at 0.268\u00a0m/s, 66\u00a0%"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("100.0 m", "100 m"),
        ("0.01 m", "10 mm"),
        ("20000000000.0 Pa", "20 GPa"),
        ("0.08726646259971647 rad", "5°"),
        ("0.4 g", "0.4 g"),
        ("2650.0 kg/m^3", "2650 kg/m³"),
        ("150000.0 N/m", "150 kN/m"),
        (None, "none"),
        (True, "yes"),
        (0.143, "0.143"),
        ([["0.0 m", "0.0 m"], ["80.0 m", "0.0 m"]], "(0 m, 0 m), (80 m, 0 m)"),
        ({"step": "band-pass", "low": "0.1 Hz", "high": None}, "step band-pass, low 0.1 Hz"),
        (list(range(20)), "0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 and 8 more"),
        ("4e+09 B", "4 GB"),
        ("2.5e+06 B", "2.5 MB"),
        ("512.0 B", "512 B"),
    ],
)
def test_input_is_shown_with_units(value, text):
    assert shown(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("91.44 m", "300 ft"),
        ("0.0254 m", "1 in"),
        ("0.0 m", "0 ft"),
        ("20000000000.0 Pa", "2901 ksi"),
        ("2400.0 kg/m^3", "149.8 lb/ft³"),
        ("9.80665 m/s^2", "32.17 ft/s²"),
        ("150000.0 N/m", "10.28 kip/ft"),
        ("0.4 g", "0.4 g"),
        ([["0.0 m", "30.48 m"]], "(0 ft, 100 ft)"),
    ],
)
def test_input_is_shown_in_units_of_the_united_states(value, text):
    assert shown(value, "us") == text


def test_numbers_are_written_as_people_read_them():
    assert [digits(x, 4) for x in (0.0, 1.5, 0.10314805, 12345.6, 5.55e-16, 3e8, 883)] == [
        "0", "1.5", "0.1031", "12350", "5.55·10⁻¹⁶", "3.00·10⁸", "883"
    ]  # fmt: skip
    assert kind("energy.input_j") == "energy"
    assert kind("spread.residual_slip_m.mean") == "displacement"
    numbers = Numbers({"a_m": float("nan"), "b": {"c_m": -0.0}})
    assert numbers("a_m") == numbers("x.y_m") == "–"
    assert numbers("b.c_m", sign=-1.0).text == "0.00 mm"


def test_a_quantity_has_one_unit_in_a_table():
    numbers = Numbers({"a_m": 1.571, "b_m": 0.0032, "c_m": 0.0, "d_n": 2e3})
    rows = tuple((name, numbers(name)) for name in ("a_m", "b_m", "c_m", "d_n"))
    assert [cell.text.split()[-1] for _, cell in rows] == ["m", "mm", "mm", "kN/m"]
    (table,) = with_one_unit((Table(("", "value"), rows),), numbers)
    assert [cell.text for _, cell in table.rows] == ["1.571 m", "0.00320 m", "0 m", "2 kN/m"]


def test_the_title_block_stands_in_both_files():
    project = Project.model_validate({"client": "Owner & Sons", "revision": 2})
    about = tuple(project.rows())
    assert len(about) == 7
    document = Document("Dam", "", "", (), about)
    page = html(document)
    for text in (page, source(document)):
        assert "Client" in text
        assert "Checked by" in text
    assert "Owner &amp; Sons" in page
    assert tuple(Project().rows()) == ()


def test_the_table_of_revisions_stands_on_page_one(typical_both):
    lines = '[{revision = "A", change = "first issue"}, {revision = 1, change = "new record", author = "N. N."}]'
    case = example("typical-base", f"project.revisions={lines}")
    report = build_report(case, typical_both, figures={})
    table = report.blocks[0]
    assert isinstance(table, Table)
    # No one has checked them: there is no such column, and no title block, for which there are no words.
    assert table.head == ("Revision", "Change", "Prepared")
    assert table.rows == (("A", "first issue", ""), ("1", "new record", "N. N."))
    assert report.about == ()
    assert "new record" in html(report)
    assert "new record" in source(report)


def test_the_report_says_what_its_models_leave_out(typical_both):
    case = example("typical-base", "project.name=Review", "project.revision=3")
    report = build_report(case, typical_both, figures={})
    text = html(report)
    assert "Limitations of this analysis" in text
    assert "the dam does not vibrate" in text
    assert "linear elastic" in text
    # Read from the table of what goes with what.
    for model in ("rigid", "flexible"):
        for feature in unsupported_features(model):
            assert feature in text
    assert report.footer.startswith("Review · revision 3 · heeltoe")


def test_a_report_says_that_the_answer_is_a_distribution(typical_both):
    text = html(build_report(example("typical-base"), scattered(typical_both, [0.1] * 40 + [0.3] * 60), figures={}))
    assert "means over 100 runs with the shaking varied, each with its standard error" in text
    # The block beside it was not varied.
    assert "How much the result of the rigid block depends" in text


def test_a_report_names_the_crack_whose_numbers_are_means(typical_both):
    case, response = example("two-cracks"), scattered_below(typical_both, [0.1] * 40 + [0.3] * 60)
    text = html(build_report(case, response, figures={}))
    assert "Single runs scatter at the crack at 0 m: the numbers to trust there are means" in text
    assert "Slips, openings and rotations of the crack at 0 m are means over runs that scatter." in text
    assert [row[0] for row in crack_rows(response, "si")] == ["0 m (leads)", "0 m (means)"]
    assert verdict(response).count("in the mean") == 1
