"""One slip for one crack: the run, the static checks and the report say the same, of the better model."""

import pytest

from heeltoe import read_case, run
from heeltoe.models.statics.after import joints_after
from heeltoe.study.small.run_table import parse_axes
from heeltoe.study.small.statics import After, judge, statics_table
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from shared.dams import BLOCK, ROOT, plane_case
from shared.report_reader import Reader

ANCHOR = {"head_x": "3 m", "head_elevation": "100 m", "foot_x": "4 m", "foot_elevation": "-10 m", "prestress": "1 MN/m"}
CHANGES = [
    "flexible.elements_across=4",
    "flexible.evidence=none",
    "motion.duration=8s",
    "statics.criteria=USACE",
    "statics.residual_friction=1.0",
]


@pytest.fixture(scope="module")
def dam():
    changes = [*CHANGES, {"anchors": [ANCHOR]}, {"statics.sections": [{"elevation": "0 m"}, {"elevation": "90 m"}]}]
    case = plane_case(ROOT / "examples" / "two-cracks.toml", changes)
    return case, run(case)


def test_run_and_static_checks_say_one_slip_for_each_crack(dam):
    case, response = dam
    slips = {crack.elevation: crack.residual_slip_m for crack in response.cracks}
    assert all(abs(slip) > 1e-3 for slip in slips.values())
    for result in (judge(case), joints_after(case, lambda: response.responses)):
        assert {joint.elevation_m: joint.statics.slip_m for joint in result.joints} == slips
        assert all("flexible model" in joint.statics.slip_source for joint in result.joints)


@pytest.mark.slow
def test_a_joint_that_is_no_crack_says_that_it_was_run_alone(dam):
    case, response = dam
    more = case.with_({"statics.sections": [{"elevation": "0 m"}, {"elevation": "40 m"}]})
    base, joint = judge(more).joints
    assert base.statics.slip_m == {crack.elevation: crack.residual_slip_m for crack in response.cracks}[0.0]
    assert joint.statics.slip_source.endswith("run with this joint as the only crack")
    _, unrun = joints_after(more, lambda: response.responses).joints
    assert unrun.statics.slip_source == "this joint is no crack of the run, and has not slipped"
    assert unrun.statics.slip_m == 0.0


def test_the_friction_of_a_joint_that_is_a_further_crack_is_its_own(dam):
    case, _ = dam
    joints = {joint.elevation_m: joint for joint in judge(case, After(0.1)).joints}
    assert joints[90.0].case.crack.friction == 1.0
    assert joints[0.0].case.crack.friction == 1.2


@pytest.mark.slow
def test_the_report_checks_every_section(dam):
    case, response = dam
    text = " ".join(Reader(html(build_report(case, response))).text.split())
    assert "at 2 sections; the section at" in text
    assert "heeltoe.statics_of_sections" not in text


def test_a_table_of_choices_of_the_checks_runs_the_earthquake_once():
    words = []
    axes = parse_axes(["statics.residual_friction=0.2,0.3,0.4"])
    table = statics_table(BLOCK, [], axes, After(model="rigid"), words.append)
    assert len(table.dams) == 3
    assert words.count("running the earthquake") == 1
    slip = read_case(BLOCK).with_({"statics.residual_friction": 0.2})
    assert {dam.joints[0].statics.slip_m for dam in table.dams} == {judge(slip).joints[0].statics.slip_m}


def test_the_checks_run_the_friction_that_the_crack_states_and_no_other():
    case, made = read_case(BLOCK), {}
    alone, response = judge(case, After(model="auto"), made=made), run(case)
    ((best,),) = made.values()
    assert response.friction_effect is not None
    assert best.friction_effect is None
    assert alone.joints[0].statics.slip_m == best.residual_slip_m == response.residual_slip_m
