"""Many sections from one case: each as by itself, the governing one first."""

from __future__ import annotations

import json

import pytest

import heeltoe
from heeltoe import InputError
from heeltoe.models.statics.joints import at_section
from shared.statics import dam

LISTED = {"sections": ["0 m", {"elevation": "20 m", "friction": 1.2}, "60 m"]}


def test_each_section_is_judged_as_by_itself():
    case = dam(statics=LISTED)
    result = heeltoe.statics_of_sections(case)
    assert [joint.elevation_m for joint in result.joints] == [0.0, 20.0, 60.0]
    for joint, crack in zip(
        result.joints,
        ({"friction": 0.9}, {"friction": 1.2, "elevation": "20 m"}, {"friction": 0.9, "elevation": "60 m"}),
        strict=True,
    ):
        alone = heeltoe.statics(dam(crack=crack))
        assert [check.value for check in joint.statics.checks] == [check.value for check in alone.checks]
    assert json.loads(json.dumps(result.to_json()))["governing_elevation_m"] == result.governing.elevation_m


def test_the_smallest_margin_governs():
    # mu (W - U) / P at 0, 20 and 60 m, z = 100 - elevation: 0.9, 1.2, 0.9 times (9.6 z^2 - 4 z h) / 5 h^2
    result = heeltoe.statics_of_sections(dam(statics=LISTED))
    factors = [
        mu * (9.6e-3 * z**2 - 4e-3 * z * h) / (5e-3 * h**2)
        for mu, z, h in ((0.9, 100, 90), (1.2, 80, 70), (0.9, 40, 30))
    ]
    joint, check = result.governing_of("sliding factor")
    assert (joint.elevation_m, check.margin) == (0.0, pytest.approx(min(factors) / 2.0))
    assert [item.elevation_m for item in result.ranked] == [0.0, 20.0, 60.0]
    assert result.governing is result.joints[0]
    assert not result.ok
    # What leaves the middle third least far inside.
    joint, check = result.governing_of("resultant")
    assert check.margin == min(item.governing_of("resultant").margin for item in result.joints)
    assert result.governing_of("compression") is None


def test_without_a_list_it_is_the_crack():
    case = dam(crack={"friction": 0.9, "elevation": "10 m"})
    result = heeltoe.statics_of_sections(case)
    assert [joint.elevation_m for joint in result.joints] == [10.0]
    assert result.governing.statics.checks == heeltoe.statics(case).checks


def test_a_lift_joint_is_level_and_the_crack_keeps_its_slope():
    case = dam(
        crack={"friction": 0.9, "elevation": "10 m", "inclination": "5 deg"}, statics={"sections": ["10m", "20m"]}
    )
    slopes = [joint.case.crack.inclination for joint in heeltoe.statics_of_sections(case).joints]
    assert slopes == [pytest.approx(0.0872665), 0.0]


def test_a_joint_may_be_judged_by_a_run_of_its_own():
    seen = []

    def judge(case, place):
        seen.append(case.crack.elevation)
        return heeltoe.statics(case, 0.01 * len(seen))

    result = heeltoe.statics_of_sections(dam(statics=LISTED), judge)
    assert seen == [0.0, 20.0, 60.0]
    assert [joint.statics.slip_m for joint in result.joints] == [0.01, 0.02, 0.03]


@pytest.mark.parametrize(
    ("statics", "said"),
    [
        (
            {"sections": ["0 m", "100 m"]},
            "statics.sections[1].elevation: 100 m is out of range; give a value from 0 m to below the crest at 100 m",
        ),
        ({"sections": ["5 m", "5 m"]}, "statics.sections: 5 m is listed twice; list it once"),
        ({"sections": [5]}, 'statics.sections[0].elevation: 5 has no unit; write for example "5 m"'),
    ],
)
def test_sections_that_cannot_be(statics, said):
    with pytest.raises(InputError) as error:
        dam(statics=statics)
    assert str(error.value) == said


def test_what_has_no_place_at_a_section_is_refused_there():
    case = dam(anchors=[{"distance": "70 m", "prestress": "1 MN/m"}], statics={"sections": ["0 m", "50 m"]})
    with pytest.raises(InputError, match=r"^statics\.sections\[1\]: at 50 m the case does not fit: anchors\[0\]"):
        heeltoe.statics_of_sections(case)


def test_anchors_and_drains_count_at_the_joints_that_they_cross():
    anchor = {"head_x": "0 m", "head_elevation": "100 m", "foot_x": "4 m", "foot_elevation": "10 m"}
    drains = {"pattern": "drained", "drain_x": "30 m", "drain_efficiency": 0.6}
    case = dam(anchors=[anchor | {"prestress": "1 MN/m"}], uplift=drains, statics={"sections": ["0 m", "20 m", "70 m"]})
    result = heeltoe.statics_of_sections(case)
    # Straight from the crest to 10 m up: 80 of 90 m below its head it is 80/90 of 4 m away, 30 m below a third of it.
    places = {20.0: 80.0 / 90.0 * 4.0, 70.0: 30.0 / 90.0 * 4.0}
    for joint in result.joints:
        lines = {line.name: line for line in joint.statics.cases[0].sheet().lines}
        held = lines["anchors"].vertical_n
        codes = [warning.name for warning in joint.statics.warnings]
        assert ("off-the-dam anchor" in codes) is (joint.elevation_m not in places)
        if joint.elevation_m in places:
            assert lines["anchors"].distance_m == pytest.approx(places[joint.elevation_m])
        assert held == pytest.approx(-1e6 * 90.0 / (90.0**2 + 4.0**2) ** 0.5 if joint.elevation_m in places else 0.0)
        # Drains 30 m from the heel cross joints that are wider: of 80, 64 and 24 m the last is not.
        assert ("off-the-dam drains" in codes) is (joint.elevation_m == 70.0)
        assert len(joint.statics.cases[0].pressures) == (2 if joint.elevation_m == 70.0 else 3)


def test_a_joint_without_drains_opens_as_one_without_any():
    """From the tip of its crack pressure goes straight to the toe, past where drains would be."""
    given = {
        "concrete": {"density": "2000 kg/m^3"},
        "crack": {"friction": 0.9, "elevation": "50 m"},
    }
    drains = {"pattern": "drained", "drain_x": "60 m", "drain_efficiency": 0.6}
    missed, without = (
        heeltoe.statics(dam("98 m", uplift=uplift, **given)).cases[0] for uplift in (drains, {"pattern": "triangular"})
    )
    assert without.cracked_length_m > 1.0
    assert missed.cracked_length_m == pytest.approx(without.cracked_length_m)
    assert missed.pressures == without.pressures


def test_checks_of_the_crack_alone_say_so():
    texts = [str(warning) for warning in heeltoe.statics(dam(statics=LISTED)).warnings]
    assert any("statics.sections: these checks are of the crack alone" in text for text in texts)
    assert at_section(dam(statics=LISTED), dam(statics=LISTED).statics.sections[0]).statics.sections == ()
