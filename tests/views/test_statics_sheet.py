"""The calculation sheet: rows that add up, steps that follow from them by hand, and the same numbers in every face."""

from __future__ import annotations

import io
import json
import re

import numpy as np
import pytest
from pypdf import PdfReader

from heeltoe import read_case, statics
from heeltoe.study.small.statics import After, judge
from heeltoe.views.content.statics import statics_document
from heeltoe.views.figures.statics.all import slug, statics_figures
from heeltoe.views.report.html import html
from heeltoe.views.report.typst_pdf import pdf
from heeltoe.views.words.sheet import lines, sheet_units, steps
from shared.command import command
from shared.dams import BASE
from shared.report_reader import Reader, squeezed

DAM = {
    "title": "Dam of 45 m",
    "project": {"client": "Owner", "revision": "B"},
    "section": {
        "polygon": [
            ["-3 m", "0 m"],
            ["36 m", "0 m"],
            ["5 m", "39 m"],
            ["5 m", "45 m"],
            ["0 m", "45 m"],
            ["0 m", "20 m"],
        ]
    },
    "concrete": {"density": "2400 kg/m^3"},
    "crack": {"elevation": "0 m", "friction": 0.9},
    "reservoir": {"depth": "41 m"},
    "tailwater": {"depth": "4 m"},
    "ice": {"force": "100 kN/m", "depth": "0.3 m"},
    "silt": {"depth": "8 m"},
    "anchors": [{"distance": "3 m", "prestress": "800 kN/m", "inclination": "10 deg"}],
    "uplift": {"pattern": "drained", "drain_position": 0.12, "drain_efficiency": 0.6},
    "statics": {
        "flood_depth": "44.5 m",
        "flood_tailwater": "7 m",
        "seismic_coefficient": 0.2,
        "vertical_seismic_coefficient": 0.05,
        "residual_slip": "60 mm",
        "drain_diameter": "80 mm",
        "compressive_strength": "20 MPa",
        "bonded": 0.6,
        "cohesion": "0.3 MPa",
    },
}
SLOPED = {"crack": {"elevation": "6 m", "inclination": "6 deg", "friction": 0.9}}


def number(text: str) -> float:
    """Read a number as people write it; a dash is nothing."""
    return float(text) if re.search(r"\d", text) else 0.0


@pytest.mark.parametrize("units", ["si", "us"])
@pytest.mark.parametrize("dam", [DAM, DAM | SLOPED], ids=["level", "sloped"])
def test_the_rows_add_up_to_the_numbers_of_the_checks(dam, units):
    result = statics(read_case(dam))
    assert len(result.cases) >= 4
    to = sheet_units(units)
    for case in result.cases:
        rows = np.array([[number(cell) for cell in row[1:6]] for row in lines(case, units).rows])
        forces, answer = rows[:-1], rows[-1]
        # Force by force: arms times parts are the moment, as far as the digits go.
        across, height, up, distance, moment = forces.T
        np.testing.assert_allclose(distance * up - height * across, moment, atol=3e-5 * np.abs(rows[:, 4]).max())
        added = forces.sum(axis=0)
        np.testing.assert_allclose(added[[0, 2, 4]], answer[[0, 2, 4]], rtol=2e-5, atol=1e-4 * np.abs(answer).max())
        # And what a checker gets of them.
        angle = np.arctan2(*np.subtract(case.ends_m[1], case.ends_m[0])[::-1])
        normal = added[0] * np.sin(angle) - added[2] * np.cos(angle)
        shear = added[0] * np.cos(angle) + added[2] * np.sin(angle)
        assert normal * to.force == pytest.approx(case.normal_force_n, rel=1e-4)
        assert shear * to.force == pytest.approx(case.shear_force_n, rel=1e-3)
        place = -added[4] / normal * to.length + case.contact_from_m
        assert place == pytest.approx(case.resultant_from_heel_m, rel=1e-3)
        held = case.friction * normal + case.cohesive_force_n / to.force
        assert held / abs(shear) == pytest.approx(case.sliding_factor, rel=1e-3)


@pytest.mark.parametrize("about", ["heel", "toe"])
def test_moments_about_either_end_add_up(about):
    for case in statics(read_case(DAM)).cases:
        rows = [number(row[5]) for row in lines(case, "si", about).rows]
        assert sum(rows[:-1]) == pytest.approx(rows[-1], abs=1e-5 * max(map(abs, rows)))


@pytest.mark.parametrize("units", ["si", "us"])
def test_the_numbers_of_a_step_give_what_it_says(units):
    """Each step is put into a calculator as it stands."""
    names = {"−": "-", "·": "*", "(1": "*(1"}
    result = statics(read_case(DAM | {"crack": {"elevation": "0 m", "friction": 0.9}}))
    tried = 0
    for case in result.cases:
        for step in steps(case, result.checks, units):
            text = step.worked
            if re.search(r"[a-z]", text):
                continue
            for shown, typed in names.items():
                text = text.replace(shown, typed)
            worked = eval(text.replace(" *(1", "*(1"), {})
            assert worked == pytest.approx(number(step.value.split(" ")[0]), rel=2e-4, abs=1e-3), step
            tried += 1
    assert tried > 40


def test_every_check_has_its_step():
    result = statics(read_case(DAM))
    for case in result.cases:
        own = {
            check.name: check for check in result.checks if check.load_case == case.name and check.required is not None
        }
        answer = [step for step in steps(case, result.checks, "si") if step.limit]
        assert len(answer) == len(own)
        assert [step.met for step in answer].count(False) == sum(not check.met for check in own.values())


def test_a_crack_that_opens_is_in_the_steps():
    result = statics(read_case(DAM, ["statics.seismic_coefficient=0.45", "statics.bonded=0", "statics.cohesion=0 MPa"]))
    opened = [case for case in result.cases if case.cracked_length_m and case.outcome == "stands"]
    assert opened
    for case in opened:
        answer = {step.name: step for step in steps(case, result.checks, "si")}
        assert number(answer["crack open"].value.split(" ")[0]) == pytest.approx(case.cracked_length_m, rel=1e-4)
        assert answer["stress at the tip"].value == "0 kPa"


def test_what_does_not_stand_has_steps_and_figures():
    result = judge(read_case(BASE, ["statics.seismic_coefficient=0.9"]), After(0.1))
    fallen = [case for case in result.governing.statics.cases if case.outcome != "stands"]
    assert fallen
    for case in fallen:
        assert any(
            step.value == case.outcome and step.met is False
            for step in steps(case, result.governing.statics.checks, "si")
        )
        assert statics_figures(result)[f"forces-{slug(case.name)}"].axes


@pytest.fixture(scope="module")
def joints():
    case = read_case(DAM, ["statics.sections=['0 m', '15 m', '30 m']", "crack.friction=0.6"])
    return case, judge(case)


def test_the_uplift_of_a_sheet_says_its_pressures(joints):
    _, result = joints
    usual = result.governing.statics.cases[0]
    message = next(row[-1] for row in lines(usual, "si").rows if row[0] == "uplift")
    answer = [(float(place), float(pressure)) for pressure, place in re.findall(r"([\d.]+) at ([\d.]+)", message)]
    points = dict.fromkeys(usual.pressures)
    assert len(answer) == len(points) > 2
    for point, (place, pressure) in zip(points, answer, strict=True):
        assert (place, 1e3 * pressure) == pytest.approx(point, rel=1e-4)
    assert message.endswith("in kPa and m from the heel of the crack")


@pytest.mark.slow
def test_the_report_has_every_sheet(joints):
    case, result = joints
    document = statics_document(case, result, {}, command="heeltoe statics x.toml --report")
    text = Reader(html(document)).text
    for word in ("Owner", "Revision", "heeltoe statics x.toml --report", "Not met", "crack at 30 m"):
        assert word in text
    for joint in result.joints:
        for item in joint.statics.cases:
            for row in lines(item, "si").rows:
                assert row[5] in text
    printed = squeezed("".join(page.extract_text() for page in PdfReader(io.BytesIO(pdf(document))).pages))
    for check in result.governing.statics.checks:
        assert check.met or squeezed(str(check.sentence)) in printed


def test_numbers_that_are_copied_from_the_pdf_are_numbers(joints):
    """As pypdf extracts them: no cell of a table of forces is any other than Python's float reads."""
    case, result = joints
    document = statics_document(case, result, {})
    text = "\n".join(page.extract_text() for page in PdfReader(io.BytesIO(pdf(document))).pages)
    assert not re.search(r"[\u2010-\u2015\u2212]\d", text)
    rows = [row for item in result.governing.statics.cases for row in lines(item, "si").rows]
    negative = {cell for row in rows for cell in row[1:6] if number(cell) < 0.0}
    assert len(negative) > 5
    copied = set(re.findall(r"(?<![\w.])-\d[\d.]*", text))
    assert negative <= copied


def test_the_report_is_in_units_of_the_united_states_all_through(joints):
    case, result = joints
    text = Reader(html(statics_document(case, result, {}, units="us"))).text
    text = text.replace(case.title, "").partition("Answer")[2]
    assert not re.search(r"\d\s?(mm|m|kN/m|MN/m|[kM]?Pa|kg/m³|m²)(?![\w/²³])", text)
    assert "kip/ft" in text
    assert "psi" in text


@pytest.mark.slow
def test_figures_of_every_load_case(joints):
    case, result = joints
    figures = statics_figures(result, "us")
    assert {f"forces-{slug(item.name)}" for item in result.governing.statics.cases} < set(figures)
    flood = figures["forces-flood"]
    message = [text.get_text() for axes in flood.axes for text in axes.texts]
    assert any(text.startswith("reservoir ") and "kip/ft" in text for text in message)
    assert any(text.startswith("R ") for text in message)
    every = statics_figures(result, every=True)
    count = sum(len(joint.statics.cases) for joint in result.joints)
    assert len([name for name in every if "forces-" in name]) == count
    others = {f"at-{joint.elevation_m:g}m-forces-flood" for joint in result.ranked[1:]}
    assert others < set(every)
    assert not others & set(figures)
    name = min(others)
    shown = html(statics_document(case, result, {name: every[name]}))
    assert "Flood: forces with their arms" in shown


def test_figures_of_every_section_need_a_place(tmp_path):
    (tmp_path / "dam.json").write_text(json.dumps(DAM))
    done = command("statics", tmp_path / "dam.json", "--every-section")
    assert done.returncode == 2
    assert done.stderr.startswith("heeltoe: --every-section: has no meaning without --out or --report")


@pytest.mark.slow
@pytest.mark.usefixtures("empty_figures")
def test_the_command_writes_all_of_it(tmp_path):
    place = tmp_path / "dam.json"
    place.write_text(json.dumps(DAM | {"motion": {"points": [["0 s", "0 g"], ["0.2 s", "0.5 g"], ["0.4 s", "0 g"]]}}))
    process = command("statics", place, "--out", tmp_path / "out", "--sheet", "--json", "-")
    assert process.returncode == 0, process.stderr
    assert json.loads(process.stdout)["slip_source"] == "statics.residual_slip"
    assert "M about heel" in process.stderr
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"result.json", "sheet.csv", "checks.csv", "forces-usual.png", "checks.png"} <= names
    # The model asked for says the slip, whatever the case gives, and is named.
    process = command("statics", place, "--model", "rigid", "--pga", "0.6g", "--json", "-")
    assert json.loads(process.stdout)["slip_source"].startswith("rigid model, ")
    assert "PGA 0.6 g" in json.loads(process.stdout)["slip_source"]


def test_a_table_of_checks(tmp_path):
    place = tmp_path / "dam.json"
    place.write_text(json.dumps(DAM))
    process = command("statics", place, "--vary", "crack.friction=0.7,0.9", "--out", tmp_path / "out", "--json", "-")
    answer = json.loads(process.stdout)
    assert [run["varied"]["crack.friction"] for run in answer["runs"]] == ["0.7", "0.9"]
    factors = [run["least_sliding_factor"] for run in answer["runs"]]
    assert factors[0] < factors[1]
    assert {path.name for path in (tmp_path / "out").iterdir()} >= {"result.json", "table.csv", "table.parquet"}


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--slip", "0.1m", "--model", "rigid"), "contradicts --model rigid"),
        (("--model", "rigd"), "--model"),
        (("--model", "rigid"), "motion"),
        (("--vary", "crack.friction=1,2", "--report"), "--report"),
        (("--vary", "crack.friction"), "--vary"),
    ],
)
def test_what_does_not_go_together_is_refused(tmp_path, options, words):
    place = tmp_path / "dam.json"
    place.write_text(json.dumps(DAM))
    process = command("statics", place, *options)
    assert process.returncode == 2
    assert words in process.stderr
    assert len(process.stderr.strip().splitlines()) == 1
