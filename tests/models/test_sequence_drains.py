"""Between the motions of a sequence slip closes drains, and the next motion finds the uplift that is left."""

from dataclasses import replace

import numpy as np
import pytest

import heeltoe
from heeltoe.case.toml_writer import case_text
from heeltoe.mechanics.block import build_block
from heeltoe.models.flexible.model import run_flexible
from heeltoe.models.rigid.many import rigid_many
from heeltoe.models.run import MODELS, earthquake
from heeltoe.study.plan.file import read_study
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run import batches as parts
from shared.dams import BASE, FAST, plane_case
from shared.studies import study_file

POINTS = [["0 s", "0 g"], ["0.1 s", "0.9 g"], ["0.35 s", "-0.7 g"], ["0.5 s", "0 g"]]
OTHER = [["0 s", "0 g"], ["0.15 s", "-0.8 g"], ["0.4 s", "0.6 g"], ["0.6 s", "0 g"]]
EFFICIENCY, DIAMETER = 0.6, 0.5
DRAINS = {"uplift": {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": EFFICIENCY}}
WEAKENING = {
    "crack.friction": None,
    "crack.law": {"name": "slip weakening", "peak_friction": 1.0, "residual_friction": 0.8, "slip": "50 mm"},
}
CHANGES = {
    "exact": {},
    "by integration": {"analysis.rotation": "finite"},
    "by a law": WEAKENING,
    "of water that follows": {"uplift.during_shaking": "zero while open"},
}


def sequence(*changes, base=BASE, points=OTHER):
    motions = {
        "motion": {"points": POINTS, "pga": None, "duration": None},
        "aftershocks": [{"points": points, "pause": "5 s"}, {"points": POINTS, "reverse": True}],
    }
    drains = {**DRAINS, "statics.drain_diameter": f"{DIAMETER} m"}
    return plane_case(base, [motions, "crack.friction=0.8", drains, *changes])


def alone(case, points, share, *changes):
    """The block in one motion alone, with so much of its drainage."""
    changed = case.with_({"aftershocks": [], "uplift.drain_efficiency": EFFICIENCY * share})
    return heeltoe.rigid(changed.with_({"motion": {"points": points, "pga": None, "duration": None}}, *changes))


@pytest.mark.parametrize("kind", [kind for kind in CHANGES if kind != "by a law"])
def test_a_block_at_rest_goes_on_as_one_with_the_drains_that_are_left(kind):
    case = sequence(CHANGES[kind])
    response = heeltoe.rigid(case)
    slip, shares = 0.0, []
    for stage, points in zip(response.sequence[:2], (POINTS, OTHER), strict=True):
        shares.append(max(0.0, 1.0 - abs(slip) / DIAMETER))
        assert stage.at_rest
        expected = alone(case, points, shares[-1]).residual_slip_m
        assert stage.slip_m == pytest.approx(expected, rel=1e-10, abs=1e-12)
        slip += expected
    # Some of the drainage is left, so that how much of it counts.
    assert 0.2 < shares[1] < 0.8
    assert response.summary["drainage_by_motion"][:2] == pytest.approx(shares, rel=1e-10)
    assert response.energy.residual < 1e-12
    assert abs(response.sequence[1].slip_m / alone(case, OTHER, 1.0).residual_slip_m - 1.0) > 0.02


def test_what_slip_has_worn_is_carried_over():
    """A law that has lost all it can in the first motion is its residual friction in the next."""
    worn, constant = sequence(WEAKENING), sequence()
    response = heeltoe.rigid(worn)
    share = response.summary["drainage_by_motion"][1]
    assert response.sequence[0].slip_m > 0.05
    assert response.sequence[0].slip_m < heeltoe.rigid(constant).sequence[0].slip_m
    assert response.sequence[1].slip_m == pytest.approx(alone(constant, OTHER, share).residual_slip_m, rel=1e-9)
    path = response.histories["slip_path_m"]
    assert np.all(np.diff(path) >= 0.0)
    assert path[-1] == response.summary["friction_law"]["slip_path_m"]


def test_ledger_histories_and_events_are_those_of_the_whole():
    response = heeltoe.rigid(sequence())
    time, slip = response.histories["time_s"], response.histories["slip_m"]
    assert np.all(np.diff(time) >= 0.0)
    assert {history.size for history in response.histories.values()} == {time.size}
    assert len(response.mode) == time.size
    assert np.all(np.diff(response.event_log["time_s"]) >= 0.0)
    assert response.summary["events"] == len(response.event_log["kind"])
    assert slip[-1] == response.residual_slip_m
    assert sum(response.summary["time_by_mode_s"].values()) == pytest.approx(response.end_time_s)
    assert sum(response.summary["slip_by_mode_m"].values()) == pytest.approx(response.residual_slip_m)


def test_drains_that_stay_open_change_nothing():
    """To the last bit."""
    weak = [["0 s", "0 g"], ["0.15 s", "-0.1 g"], ["0.4 s", "0.05 g"], ["0.6 s", "0 g"]]
    aftershocks = [{"points": weak, "pause": "5 s"}, {"points": weak, "reverse": True}]
    strong = sequence({"motion.points": weak, "aftershocks": aftershocks}, "crack.friction=1.5")
    response = heeltoe.rigid(strong)
    plain = heeltoe.rigid(strong.with_({"statics.drain_diameter": None}))
    assert response.summary["drainage_by_motion"] == [1.0, 1.0, 1.0]
    assert plain.summary["drainage_by_motion"] is None
    for name, values in plain.histories.items():
        assert np.array_equal(values, response.histories[name])


def test_the_chain_follows_its_drains_too():
    case = sequence({"crack.elevation": "40 m", "statics.drain_diameter": "50 mm"}, base="examples/typical-base.toml")
    response = heeltoe.decoupled(case)
    assert response.summary["drainage_by_motion"][1] < 1.0
    assert response.summary["drainage_by_motion"][1] == pytest.approx(response.sequence[0].static["drainage"], abs=1e-3)
    assert response.energy.residual < 1e-12


def test_many_runs_and_spreads_follow_them_too():
    case = sequence()
    response = heeltoe.rigid(case)
    spread = heeltoe.with_spread(response, case, 3).spread["residual_slips_m"]
    assert spread[1] == pytest.approx(response.residual_slip_m, rel=1e-12)
    slips = rigid_many([case], [response.motion])["slip"]
    assert slips[0] == pytest.approx(response.residual_slip_m, rel=1e-12)


def test_a_run_that_ends_early_tells_of_the_motions_it_has_met():
    steep = [["0 s", "0 g"], ["0.5 s", "3 g"], ["1.2 s", "3 g"], ["1.3 s", "0 g"]]
    water = {"reservoir": {"depth": "1 m"}, "motion.points": steep}
    response = heeltoe.rigid(sequence(water, "crack.friction=3", base="examples/slender.toml"))
    assert response.outcome != "ok"
    assert response.summary["drainage_by_motion"] == [1.0]


def elastic(points, *changes):
    case = sequence({"motion.points": points}, *FAST, "flexible.evidence=none", *changes, points=OTHER)
    return case.with_({"motion.duration": None, "analysis.silence": "10 s"})


def test_the_water_rises_under_an_elastic_dam_while_the_ground_stands_still():
    """Then it is pressed onto its crack as one with those drains from the beginning, and as by hand."""
    weak = [["0 s", "0 g"], ["0.1 s", "0.01 g"], ["0.2 s", "0 g"]]
    case = elastic(weak, "crack.friction=1.5")
    shaken = earthquake(case)
    result = run_flexible(case, replace(shaken, drainage=((1.0, 3.0, 0.0),)))
    closed = case.with_("uplift.drain_efficiency=0")
    beside = run_flexible(closed, shaken)
    before, after = np.searchsorted(result.histories["time_s"], [0.9, 5.0])
    pressed = result.histories["normal_force_n"]
    assert pressed[after] == pytest.approx(beside.histories["normal_force_n"][after], rel=2e-4)
    by_hand = build_block(case).normal_force - build_block(closed).normal_force
    assert pressed[before] - pressed[after] == pytest.approx(by_hand, rel=1e-3)
    assert result.energy.residual < 1e-12


@pytest.mark.slow
def test_an_elastic_dam_is_run_again_with_the_drains_that_are_left():
    case = elastic(POINTS, "statics.drain_diameter=2 m", "crack.friction=1")
    response = heeltoe.flexible(case)
    shares = response.summary["drainage_by_motion"]
    assert shares[0] == 1.0
    assert 0.1 < shares[2] < shares[1] < 0.95
    for stage, share in zip(response.sequence[:2], shares[1:], strict=True):
        assert stage.static["drainage"] == pytest.approx(share, abs=1e-3)
    assert {"sequence-drains-close"} <= {warning.code for warning in response.warnings}
    open_ = heeltoe.flexible(case.with_({"statics.drain_diameter": None}))
    # One that goes on longer in silence has slightly other steps.
    assert open_.sequence[0].slip_m == pytest.approx(response.sequence[0].slip_m, rel=0.01)
    assert abs(response.sequence[1].slip_m / open_.sequence[1].slip_m - 1.0) > 0.02
    spread = heeltoe.with_spread(response, case, 3).spread
    assert spread["residual_slips_m"][1] == pytest.approx(response.residual_slip_m, rel=1e-9)
    # Each of its runs finds the drains that its own slips leave.
    ground = earthquake(case)
    motion = replace(ground.motion, acceleration=spread["scales"][2] * ground.motion.acceleration)
    stronger = MODELS["flexible"](case, replace(ground, motion=motion), None)
    assert stronger.summary["drainage_by_motion"][2] < shares[2]
    assert spread["residual_slips_m"][2] == pytest.approx(stronger.residual_slip_m, rel=1e-4)


@pytest.mark.slow
def test_a_study_of_elastic_dams_follows_the_drains_of_each_run(tmp_path):
    case = elastic(POINTS, "statics.drain_diameter=2 m")
    fields = case.model_dump(mode="json", exclude_unset=True)
    text = 'case = "case.toml"\nmodel = "flexible"\n[vary]\n"crack.friction" = [0.9, 1.0]\n'
    plan = plan_of(read_study(study_file(tmp_path, text, case=case_text(fields))))
    result = parts.run_part(plan, 0, plan.count).to_pylist()
    assert len(result) == 2
    for row in result:
        by_hand = heeltoe.flexible(case.with_({"crack.friction": row["crack.friction"]}))
        assert by_hand.summary["drainage_by_motion"][2] < 0.95
        assert row["residual_slip_m"] == by_hand.residual_slip_m
    again = parts.run_part(plan, 0, plan.count, threads=2).to_pylist()
    assert [row["residual_slip_m"] for row in again] == [row["residual_slip_m"] for row in result]


def test_water_that_follows_the_opening_keeps_its_drains_and_says_so():
    response = heeltoe.flexible(elastic(POINTS, {"uplift.during_shaking": "zero while open"}))
    assert response.summary["drainage_by_motion"] is None
    assert "sequence-drains" in {warning.code for warning in response.warnings}
