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
    return float(text.replace("−", "-")) if re.search(r"\d", text) else 0.0


@pytest.mark.parametrize("units", ["si", "us"])
@pytest.mark.parametrize("dam", [DAM, DAM | SLOPED], ids=["level", "sloped"])
def test_the_rows_add_up_to_the_numbers_of_the_checks(dam, units):
    found = statics(read_case(dam))
    assert len(found.cases) >= 4
    to = sheet_units(units)
    for case in found.cases:
        rows = np.array([[number(cell) for cell in row[1:6]] for row in lines(case, units).rows])
        forces, told = rows[:-1], rows[-1]
        # Force by force: arms times parts are the moment, as far as the digits go.
        across, height, up, distance, moment = forces.T
        np.testing.assert_allclose(distance * up - height * across, moment, atol=3e-5 * np.abs(rows[:, 4]).max())
        added = forces.sum(axis=0)
        np.testing.assert_allclose(added[[0, 2, 4]], told[[0, 2, 4]], rtol=2e-5, atol=1e-4 * np.abs(told).max())
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
    found = statics(read_case(DAM | {"crack": {"elevation": "0 m", "friction": 0.9}}))
    tried = 0
    for case in found.cases:
        for step in steps(case, found.checks, units):
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
    found = statics(read_case(DAM))
    for case in found.cases:
        own = {
            check.name: check for check in found.checks if check.load_case == case.name and check.required is not None
        }
        told = [step for step in steps(case, found.checks, "si") if step.limit]
        assert len(told) == len(own)
        assert [step.met for step in told].count(False) == sum(not check.met for check in own.values())


def test_a_crack_that_opens_is_in_the_steps():
    found = statics(read_case(DAM, ["statics.seismic_coefficient=0.45", "statics.bonded=0", "statics.cohesion=0 MPa"]))
    opened = [case for case in found.cases if case.cracked_length_m and case.outcome == "stands"]
    assert opened
    for case in opened:
        told = {step.name: step for step in steps(case, found.checks, "si")}
        assert number(told["crack open"].value.split(" ")[0]) == pytest.approx(case.cracked_length_m, rel=1e-4)
        assert told["stress at the tip"].value == "0 kPa"


def test_what_does_not_stand_has_steps_and_figures():
    found = judge(read_case(BASE, ["statics.seismic_coefficient=0.9"]), After(0.1))
    fallen = [case for case in found.governing.statics.cases if case.outcome != "stands"]
    assert fallen
    for case in fallen:
        assert any(
            step.value == case.outcome and step.met is False
            for step in steps(case, found.governing.statics.checks, "si")
        )
        assert statics_figures(found)[f"forces-{slug(case.name)}"].axes


@pytest.fixture(scope="module")
def joints():
    case = read_case(DAM, ["statics.sections=['0 m', '15 m', '30 m']", "crack.friction=0.6"])
    return case, judge(case)


def test_the_uplift_of_a_sheet_says_its_pressures(joints):
    _, found = joints
    usual = found.governing.statics.cases[0]
    said = next(row[-1] for row in lines(usual, "si").rows if row[0] == "uplift")
    told = [(float(place), float(pressure)) for pressure, place in re.findall(r"([\d.]+) at ([\d.]+)", said)]
    points = dict.fromkeys(usual.pressures)
    assert len(told) == len(points) > 2
    for point, (place, pressure) in zip(points, told, strict=True):
        assert (place, 1e3 * pressure) == pytest.approx(point, rel=1e-4)
    assert said.endswith("in kPa and m from the heel of the crack")


def test_the_report_has_every_sheet(joints):
    case, found = joints
    document = statics_document(case, found, {}, command="heeltoe statics x.toml --report")
    text = Reader(html(document)).text
    for word in ("Owner", "Revision", "heeltoe statics x.toml --report", "Not met", "crack at 30 m"):
        assert word in text
    for joint in found.joints:
        for each in joint.statics.cases:
            for row in lines(each, "si").rows:
                assert row[5] in text
    printed = squeezed("".join(page.extract_text() for page in PdfReader(io.BytesIO(pdf(document))).pages))
    for check in found.governing.statics.checks:
        assert check.met or squeezed(str(check.sentence)) in printed


def test_the_report_is_in_units_of_the_united_states_all_through(joints):
    case, found = joints
    text = Reader(html(statics_document(case, found, {}, units="us"))).text
    text = text.replace(case.title, "").partition("Answer")[2]
    assert not re.search(r"\d\s?(mm|m|kN/m|MN/m|[kM]?Pa|kg/m³|m²)(?![\w/²³])", text)
    assert "kip/ft" in text
    assert "psi" in text


def test_figures_of_every_load_case(joints):
    case, found = joints
    figures = statics_figures(found, "us")
    assert {f"forces-{slug(each.name)}" for each in found.governing.statics.cases} < set(figures)
    flood = figures["forces-flood"]
    said = [text.get_text() for axes in flood.axes for text in axes.texts]
    assert any(text.startswith("reservoir ") and "kip/ft" in text for text in said)
    assert any(text.startswith("R ") for text in said)
    every = statics_figures(found, every=True)
    count = sum(len(joint.statics.cases) for joint in found.joints)
    assert len([name for name in every if "forces-" in name]) == count
    others = {f"at-{joint.elevation_m:g}m-forces-flood" for joint in found.ranked[1:]}
    assert others < set(every)
    assert not others & set(figures)
    name = min(others)
    shown = html(statics_document(case, found, {name: every[name]}))
    assert "Flood: forces with their arms" in shown


def test_figures_of_every_section_need_a_place(tmp_path):
    (tmp_path / "dam.json").write_text(json.dumps(DAM))
    done = command("statics", tmp_path / "dam.json", "--every-section")
    assert done.returncode == 2
    assert done.stderr.startswith("heeltoe: --every-section: has no meaning without --out or --report")


@pytest.mark.usefixtures("empty_figures")
def test_the_command_writes_all_of_it(tmp_path):
    place = tmp_path / "dam.json"
    place.write_text(json.dumps(DAM | {"motion": {"points": [["0 s", "0 g"], ["0.2 s", "0.5 g"], ["0.4 s", "0 g"]]}}))
    said = command("statics", place, "--out", tmp_path / "out", "--sheet", "--json", "-")
    assert said.returncode == 0, said.stderr
    assert json.loads(said.stdout)["slip_source"] == "statics.residual_slip"
    assert "M about heel" in said.stderr
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"result.json", "sheet.csv", "checks.csv", "forces-usual.png", "checks.png"} <= names
    # The model asked for says the slip, whatever the case gives, and is named.
    said = command("statics", place, "--model", "rigid", "--pga", "0.6g", "--json", "-")
    assert json.loads(said.stdout)["slip_source"].startswith("rigid model, ")
    assert "PGA 0.6 g" in json.loads(said.stdout)["slip_source"]


def test_a_table_of_checks(tmp_path):
    place = tmp_path / "dam.json"
    place.write_text(json.dumps(DAM))
    said = command("statics", place, "--vary", "crack.friction=0.7,0.9", "--out", tmp_path / "out", "--json", "-")
    found = json.loads(said.stdout)
    assert [run["varied"]["crack.friction"] for run in found["runs"]] == ["0.7", "0.9"]
    factors = [run["least_sliding_factor"] for run in found["runs"]]
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
    said = command("statics", place, *options)
    assert said.returncode == 2
    assert words in said.stderr
    assert len(said.stderr.strip().splitlines()) == 1
