"""A table has one unit for each quantity; of a study too, everything is in the units that are asked for."""

from __future__ import annotations

import re
from io import StringIO

import pytest
from matplotlib.text import Text
from rich.console import Console

from heeltoe import read_case, run_study
from heeltoe.units.write import lengths
from heeltoe.views.content.study import study_document, study_subject
from heeltoe.views.content.tree import Section, Table
from heeltoe.views.figures.studies.all import study_figures
from heeltoe.views.report.html import html
from heeltoe.views.terminal.study import print_study
from heeltoe.views.words.fields import fields
from heeltoe.views.words.numbers import Amount, Numbers, in_one_unit
from heeltoe.views.words.studies import limits_of, values_phrase
from shared.studies import BLOCK, study_file

SI = re.compile(r"\d ?\[?(?:m|mm|kN|MN|kPa|MPa|GPa|kg|m/s)(?:[ ,;.)\]/]|$)", re.MULTILINE)
# Slips from fractions of a millimetre to metres; what varies has a unit, and so has every measure.
STUDY = """
case = "case.toml"
method = "one at a time"
[vary]
"crack.friction" = [0.1, 0.8]
"concrete.density" = ["2300 kg/m^3", "2600 kg/m^3"]
"reservoir.depth" = ["0.3 m", "1.2 m"]
[motions]
both_signs = false
folder = "quakes"
scale = { measure = "pgv", values = ["0.1 m/s", "0.4 m/s", "3 m/s"] }
[fragility]
limits = { residual_slip = ["1 mm", "1.5 m"] }
measure = "arias"
"""
CASE = BLOCK + '\n[reservoir]\ndepth = "1 m"\n'


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    return run_study(study_file(folder, STUDY, case=CASE), folder / "out"), folder


def printed(found, units):
    console = Console(file=StringIO(), width=100)
    print_study(found, console, units, details=True)
    return console.file.getvalue()


def tables(blocks):
    for block in blocks:
        if isinstance(block, Section):
            yield from tables(block.blocks)
        elif isinstance(block, Table):
            yield block


def test_lengths_of_a_table():
    assert lengths([0.0032, 0.5]) == ["3.2 mm", "500.0 mm"]
    assert lengths([0.0032, 1.2, 0.0, 2e-9]) == ["0.00320 m", "1.200 m", "0 m", "under 0.00001 m"]
    assert lengths([0.0254, 30.48], "us") == ["0.083 ft", "100.0 ft"]
    rows = [("a", Amount(0.0032), Amount(None)), ("b", (Amount(1.2), " (x)"), Amount(0.0, zero="0"))]
    rows.append(("c", Amount(2e-3, "rotation"), Amount(1.5, "rotation")))
    assert in_one_unit(rows, "si") == [
        ["a", "0.00320 m", "-"],
        ["b", "1.200 m (x)", "0"],
        ["c", "0.00200 rad", "1.500 rad"],
    ]
    # What has one unit already stays as it is.
    assert in_one_unit(rows[:1], "si") == [["a", "3.2 mm", "-"]]


@pytest.mark.parametrize(
    ("units", "summary", "tornado", "speed"), [("si", "m", "mm", "m/s"), ("us", "ft", "in", "ft/s")]
)
def test_tables_of_a_study_on_the_screen(study, units, summary, tornado, speed):
    text = printed(study[0], units)
    lines = text.splitlines()
    result = {
        "summary": {line.split()[-1] for line in lines if re.match(r"(residual slip|opening).*:.*[1-9]", line)},
        "tornado": set(re.findall(r"[\d.]+ (\w+) \(", text.partition("Fields that decide the slip")[2])),
    }
    assert result == {"summary": {summary}, "tornado": {tornado}}, text
    assert set(re.findall(r"[\d.]+ (m/s|ft/s|mm/s|in/s)", text)) == {speed}
    assert re.search(rf"; [\d.]+ {tornado} as the case is", " ".join(text.split()))
    if units == "us":
        assert not SI.search(text), text
        assert text.count("lb/ft³") == 2


@pytest.mark.slow
@pytest.mark.parametrize("units", ["si", "us"])
def test_a_study_s_figures_and_report_have_its_units(study, units):
    result, folder = study
    figures = study_figures(result, units)
    assert set(figures) == {"bands", "fragility", "slips", "modes", "tornado"}
    message = {name: "\n".join(t.get_text() for t in f.findobj(Text)) for name, f in figures.items()}
    speed = "ft/s" if units == "us" else "m/s"
    for name in ("bands", "fragility", "modes"):
        assert f"Arias intensity [{speed}]" in message[name]
    answer = study_document(study_subject(result, folder, units, "", None))
    page = " ".join(re.sub(r"<style>.*?</style>|<svg.*?</svg>|<[^>]+>", " ", html(answer), flags=re.DOTALL).split())
    page = page.replace("\u2060", "").replace("\xa0", " ")
    # What a field means is said as its documentation says it.
    page = page.rpartition("Appendix: the base case")[0]
    assert re.search(rf"at an Arias intensity of [\d.]+ {speed}", page)
    assert f"scaled to PGV: {'0.3281' if units == 'us' else '0.1'} {speed}" in page
    if units == "us":
        for text in (*message.values(), page):
            assert not SI.search(text), text
    for table in tables(answer.blocks):
        # Values of what varies stand in brackets behind the slips that they make.
        cells = " ".join(re.sub(r"\(.*?\)", "", str(getattr(cell, "text", cell))) for row in table.rows for cell in row)
        assert len(set(re.findall(r"\d (mm|m|in|ft)(?![\w/])", cells))) <= 1, cells


def test_figures_are_scaled_with_their_units(study):
    at = {units: study_figures(study[0], units)["fragility"].axes[0].get_xlim()[1] for units in ("si", "us")}
    assert at["us"] == pytest.approx(at["si"] / 0.3048)


def test_limits_and_values_of_a_table():
    limits = [("residual_slip", 0.01), ("peak_slip", 1.5), ("rotation", 0.01)]
    assert list(limits_of(limits).values()) == ["residual slip 0.01 m", "peak slip 1.5 m", "rotation 0.01 rad"]
    assert limits_of(limits[:1])[limits[0]] == "residual slip 10 mm"
    assert values_phrase(["0.3 m", "1.2 m"]) == "0.3 m, 1.2 m"
    assert values_phrase({"distribution": "uniform", "from_": "0.2 m", "to": "3 m"}, "us") == (
        "uniform, from 0.6562 ft to 9.843 ft"
    )


@pytest.mark.parametrize(
    ("units", "said"),
    [
        ("si", {"1.5 m", "0.25 m", "0.03 m", "1.2 m", "20 GPa", "2 MPa", "0.1 MPa"}),
        ("us", {"4.921 ft", "0.8202 ft", "1.181 in", "47.24 in", "2901 ksi", "290.1 psi", "14.5 psi"}),
    ],
)
def test_input_has_one_unit_for_each_quantity(units, said):
    changes = ["tailwater.depth=0.25m", "reservoir.depth=1.5m", "limits.residual_slip=30mm", "limits.peak_slip=1200mm"]
    changes += [
        "concrete.modulus=20GPa",
        "concrete.tensile_strength=2MPa",
        "statics.cohesion=0.1MPa",
        "statics.bonded=0.5",
    ]
    case = read_case("examples/block.toml", changes)
    rows = {path: text for path, text, *_ in fields(case, case.model_dump(mode="json"), units=units, given=True)}
    assert said <= set(rows.values()), rows


def test_a_stress_that_rounding_leaves_is_none_beside_others_too():
    numbers = Numbers({"heel_stress_pa": -4.7e-10, "toe_stress_pa": 1.25e6})
    values = [numbers("heel_stress_pa"), numbers("toe_stress_pa")]
    assert [value.text for value in numbers.alike(values)] == ["0 MPa", "1.250 MPa"]
