"""The limit on the cracked length is of bonded joints, each by its elevation, in runs, suites and studies."""

from __future__ import annotations

import copy
import json

import numpy as np
import pytest

from heeltoe import InputError, run, run_suite
from heeltoe.result.verdict import verdict
from heeltoe.study.plan.file import Study
from heeltoe.study.plan.plan import plan_of
from heeltoe.views.content.study import study_answer
from shared.dams import BASE, plane_case

# Half a second of shaking, as a record of two strengths.
PULSES = ([0.0, 0.1, 0.3, 0.5, 0.6], [0.0, 0.6, -0.9, 0.9, 0.0])
DAM = {
    "section": {
        "height": "30 m",
        "crest_width": "5 m",
        "neck_height": "25 m",
        "neck_width": "6 m",
        "base_width": "26 m",
    },
    "concrete": {"modulus": "25 GPa"},
    "cracks": [
        {
            "elevation": "6 m",
            "friction": 1.0,
            "bond": {
                "tensile_strength": "0.2 MPa",
                "cohesion": "0.6 MPa",
                "fracture_energy": "200 N/m",
                "shear_energy": "1000 N/m",
            },
        },
        {"elevation": "0 m", "friction": 1.0},
    ],
    "reservoir": {"depth": "26 m"},
    "motion": {"sign": "recorded"},
    "flexible": {"elements_across": 6, "evidence": "none"},
    "analysis": {"silence": "0 s"},
    "limits": {"cracked_length": "0.3 m"},
}


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    place = tmp_path_factory.mktemp("records")
    for name, factor in (("strong", 1.0), ("weak", 0.05)):
        values = factor * np.interp(np.arange(0.0, 0.605, 0.01), *PULSES)
        lines = "\n".join(f"{value:.6f}" for value in values)
        (place / f"{name}.txt").write_text(f"# time step: 0.01 s\n# units: [g]\n{lines}\n")
    return place


def of_record(records, name):
    """The run of one record by itself."""
    fields = copy.deepcopy(DAM)
    fields["motion"]["file"] = str(records / f"{name}.txt")
    return run(plane_case(fields), "flexible")


@pytest.fixture(scope="module")
def strong(records):
    return of_record(records, "strong")


# The right value is the length in the numbers of the joint itself; the crack at the base was 26 m long from the start.
def test_a_run_judges_the_bonded_joint_alone(strong):
    joint = next(crack.joint for crack in strong.cracks if crack.elevation == 6.0)
    (check,) = strong.limits
    assert (check.value, check.elevation_m) == (joint.cracked_length_m, 6.0)
    assert 0.3 < check.value < 26.0
    assert not check.met
    assert "cracked length at the joint at 6 m of" in verdict(strong)


def test_each_of_several_joints_has_its_own_check():
    fields = copy.deepcopy(DAM)
    fields["cracks"][1]["bond"] = fields["cracks"][0]["bond"] | {"tensile_strength": "0.3 MPa"}
    fields["motion"]["points"] = [[f"{t} s", f"{a} g"] for t, a in zip(*PULSES, strict=True)]
    response = run(plane_case(fields), "flexible")
    lengths = {crack.elevation: crack.joint.cracked_length_m for crack in response.cracks}
    assert {check.elevation_m: check.value for check in response.limits} == lengths
    assert len(lengths) == 2


@pytest.mark.slow
def test_a_suite_says_how_far_the_joint_cracks(records, strong):
    fields = copy.deepcopy(DAM)
    fields["motion"]["file"] = str(records / "strong.txt")
    suite = run_suite(plane_case(fields), records, model="flexible", judge="largest")
    (answer,) = suite.suite["models"]
    length = next(check.value for check in strong.limits)
    (joint,) = answer["joints"]
    assert (joint["elevation_m"], joint["records_cracked"]) == (6.0, 1)
    assert joint["statistics"]["largest"] == pytest.approx(length, rel=1e-12)
    assert joint["statistics"]["mean"] == pytest.approx(length / 2.0, rel=1e-12)
    (limit,) = answer["limits"]
    assert (limit["name"], limit["elevation_m"], limit["met"]) == ("cracked_length", 6.0, False)
    assert limit["value"] == pytest.approx(length, rel=1e-12)
    text = str(study_answer(suite, "si"))
    assert "The bonded joint at 6 m cracks in 1 of 2 records" in text
    assert "cracked length at the joint at 6 m" in text
    json.dumps(suite.to_json(), allow_nan=False)


def test_without_a_bonded_joint_there_is_nothing_to_judge(records):
    fields = copy.deepcopy(DAM)
    del fields["cracks"][0]
    fields["motion"]["file"] = str(records / "strong.txt")
    response = run(plane_case(fields), "rigid")
    assert not response.limits
    said = "limits.cracked_length: no effect, because no crack has a bond"
    assert any(said in str(text) for text in response.warnings)
    (answer,) = run_suite(plane_case(fields), records, model="rigid").suite["models"]
    assert (answer["joints"], answer["limits"]) == ([], [])


def test_a_fragility_curve_of_it_needs_a_bond():
    study = Study.of(
        {"case": "dam", "model": "rigid", "fragility": {"limits": {"cracked_length": ["1 m"]}}}, BASE.parent
    )
    with pytest.raises(InputError, match="a bonded joint"):
        plan_of(study, plane_case(BASE))
