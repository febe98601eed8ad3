"""Criteria of a user's own from a file, and what the documents cap."""

from __future__ import annotations

import pytest

import heeltoe
from heeltoe import InputError, read_case
from heeltoe.models.statics import own_criteria
from shared.command import command
from shared.statics import TRIANGLE, check, dam

OWN = """
title = "Our authority, guideline 12"
uplift_in_earthquake = "zero"

[sliding]
usual = 1.5
post-earthquake = 1.1
source = "table 3"

[overturning]
usual = 1.2

[resultant]
usual = 0.2

[compression]
usual = 0.25
"""


def case_of(tmp_path, text=OWN, **statics):
    (tmp_path / "own.toml").write_text(text)
    fields = {
        "gravity": "10 m/s^2",
        "section": {"polygon": TRIANGLE},
        "crack": {"friction": 0.9},
        "reservoir": {"depth": "90 m"},
        "statics": {"criteria_file": "own.toml", "compressive_strength": "4 MPa"} | statics,
    }
    return read_case(fields).based_in(tmp_path)


def test_a_file_judges_in_place_of_the_documents(tmp_path):
    result = heeltoe.statics(case_of(tmp_path))
    assert result.criteria == "Our authority, guideline 12"
    sliding = check(result, "usual", "sliding factor")
    assert (sliding.required, sliding.source) == (1.5, "Our authority, guideline 12, table 3")
    # 5120 against 1215 + 1920 about the toe
    overturning = check(result, "usual", "overturning factor")
    assert (overturning.value, overturning.met) == (pytest.approx(5120.0 / 3135.0), True)
    # 6.917 m of 80 is 0.0865 from the middle
    resultant = check(result, "usual", "resultant")
    assert "inside the middle 40 % of Our authority" in str(resultant.sentence)
    assert not check(result, "usual", "compression").met
    assert result.critical_water_level_m["sliding_required"] is not None
    assert [item.name for item in result.checks if item.required is None] == ["equilibrium"]


def test_the_file_is_read_once_and_again_when_it_was_written(tmp_path, monkeypatch):
    read = []
    known = own_criteria.read_fields
    monkeypatch.setattr(own_criteria, "read_fields", lambda *given: read.append(given) or known(*given))
    case = case_of(tmp_path, "[sliding]\nusual = 1.25\nearthquake = 1.0\n", seismic_coefficient=0.1)
    assert check(heeltoe.statics(case), "usual", "sliding factor").required == 1.25
    assert len(read) == 1
    (tmp_path / "own.toml").write_text("[sliding]\nusual = 1.375\n")
    assert check(heeltoe.statics(case), "usual", "sliding factor").required == 1.375
    assert len(read) == 2


def test_what_no_row_asks_for_is_not_judged(tmp_path):
    result = heeltoe.statics(case_of(tmp_path, "[flotation]\nusual = 1.2\n"))
    assert [item.name for item in result.checks] == ["equilibrium", "flotation factor"]
    assert result.critical_water_level_m["sliding_required"] is None
    assert result.criteria == "own.toml"
    idle = [str(warning) for warning in result.warnings if warning.code == "fields-idle"]
    assert any("statics.compressive_strength" in item for item in idle)


def test_cohesion_may_have_factors_of_its_own(tmp_path):
    text = "[sliding-with-cohesion]\nusual = 3.0\n[sliding-without-cohesion]\nusual = 1.4\n"
    bonded = {"bonded": 1.0, "cohesion": "0.1 MPa"}
    assert check(heeltoe.statics(case_of(tmp_path, text)), "usual", "sliding factor").required == 1.4
    assert check(heeltoe.statics(case_of(tmp_path, text, **bonded)), "usual", "sliding factor").required == 3.0


def test_the_file_says_what_the_water_does(tmp_path):
    result = heeltoe.statics(case_of(tmp_path, seismic_coefficient=0.1))
    texts = [str(text) for item in result.cases for text in item.assumptions if "uplift" in str(text)]
    assert texts
    assert all("guideline 12: zero where" in item for item in texts)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("title = 3\n", "own.toml: title: 3 is of the wrong type; give a text"),
        ("[sliding]\nusual = 0\n", "own.toml: sliding.usual: 0 is out of range; give a value above 0 and up to 100"),
        (
            '[sliding]\nusual = "2"\n',
            'own.toml: sliding.usual: "2" is out of range; give a value above 0 and up to 100',
        ),
        (
            "[resultant]\nusual = 0.7\n",
            "own.toml: resultant.usual: 0.7 is out of range; give a value above 0 and up to 0.5",
        ),
        (
            "[sliding]\nusual = nan\n",
            "own.toml: sliding.usual: NaN is out of range; give a value above 0 and up to 100",
        ),
        (
            "[slidding]\nusual = 2\n",
            "own.toml: slidding: slidding is not a choice; choose one of sliding, sliding-with-cohesion, "
            "sliding-without-cohesion, overturning, flotation, resultant, compression",
        ),
        (
            "[sliding]\nflood = 2\n",
            "own.toml: sliding.flood: flood is not a choice; choose one of usual, unusual, extreme, "
            "earthquake, post-earthquake",
        ),
        ("[sliding]\nusual = 2\nsource = 3\n", "own.toml: sliding.source: 3 is of the wrong type; give a text"),
        (
            'uplift_in_earthquake = "none"\n[sliding]\nusual = 2\n',
            'own.toml: uplift_in_earthquake: "none" is not a choice; choose "unchanged", "zero", "full"',
        ),
        (
            'title = "empty"\n',
            "statics.criteria_file: own.toml has no criteria; give a table, for example [sliding] with usual = 1.5",
        ),
        (
            "[sliding]\nusual = 2\n[sliding-with-cohesion]\nusual = 3\n",
            'own.toml: sliding: cannot stand beside "sliding-with-cohesion or -without-cohesion"; keep one of them',
        ),
    ],
)
def test_what_is_wrong_with_a_file_is_said_in_a_line(tmp_path, text, said):
    with pytest.raises(InputError) as error:
        heeltoe.statics(case_of(tmp_path, text))
    assert str(error.value) == said


def test_a_file_that_is_not_there(tmp_path):
    case = case_of(tmp_path)
    (tmp_path / "own.toml").unlink()
    with pytest.raises(InputError, match=r"own\.toml: there is no such file; give the path of criteria in TOML"):
        heeltoe.statics(case)


def test_a_file_and_a_document_do_not_judge_together():
    with pytest.raises(InputError, match=r"statics\.criteria: cannot stand beside \"criteria_file\""):
        dam(statics={"criteria": "FERC", "criteria_file": "own.toml"})
    case = dam(statics={"criteria_file": "own.toml"}).with_("statics.criteria=FERC")
    assert (case.statics.criteria, case.statics.criteria_file) == ("FERC", None)


def test_the_command_takes_a_file_from_where_one_stands(tmp_path):
    (tmp_path / "own.toml").write_text(OWN)
    made = command("new", "dam", cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    process = command("statics", "dam.toml", "--criteria", "own.toml", "--slip", "0m", "--json", "-", cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    assert '"criteria": "Our authority, guideline 12"' in process.stdout


def test_usbr_caps_what_strong_concrete_may_bear():
    # 1500 psi are 10.342 MPa: a third of 20 MPa is less, a third of 60 MPa more.
    for strength, share in ((20.0, 1.0 / 3.0), (60.0, 10.342135 / 60.0)):
        choice = {"criteria": "USBR", "compressive_strength": f"{strength} MPa"}
        outcome = check(heeltoe.statics(dam(statics=choice)), "usual", "compression")
        assert outcome.required == pytest.approx(share, rel=1e-6)


def test_ferc_has_no_second_table_for_low_hazard():
    low = {"criteria": "FERC", "structure": "normal"}
    outcome = check(heeltoe.statics(dam(statics=low)), "usual", "sliding factor")
    assert (outcome.required, outcome.source.endswith("table 2")) == (2.0, True)
