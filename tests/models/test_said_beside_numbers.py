"""What a result says beside its numbers: slides that do not end, bounces that decide, tension that nothing judges."""

import pytest

import heeltoe
from heeltoe import GroundMotion, InputError, flexible, rigid, rigid_many, verdict
from heeltoe.models.run import earthquake
from shared.dams import BASE, COARSE, ENDS, FAST, example, plane_case


def codes(response):
    return [notice.name for notice in response.warnings]


def test_a_crack_whose_kinetic_friction_does_not_hold_the_water_says_so():
    weak = ["crack.static_friction=1.0", "crack.kinetic_friction=0.6", "motion.pga=0.02g"]
    assert "slides-on" in codes(rigid(plane_case(BASE, weak)))
    assert "slides-on" not in codes(rigid(plane_case(BASE, [*weak[:1], "crack.kinetic_friction=0.95", weak[2]])))


def test_a_law_whose_residual_friction_does_not_hold_the_water_says_so_at_rest():
    law = {"crack.law": {"name": "slip weakening", "peak_friction": 1.0, "residual_friction": 0.5, "slip": "10 mm"}}
    response = rigid(plane_case(BASE, [{"crack.friction": None}, law, "motion.pga=0.02g"]))
    assert response.residual_slip_m == 0.0
    assert "slides-on" in codes(response)


def test_bounces_that_amplify_the_last_digit_are_not_determined():
    motion = earthquake(example("typical-base", "motion.pga=1.8g")).motion
    bouncy = rigid(example("typical-height", "crack.restitution=0.9"), motion)
    assert "not-determined" in codes(bouncy)
    calm = rigid(example("slender", "crack.restitution=0.5"))
    assert "not-determined" not in codes(calm)


def test_tension_without_a_strength_is_said_to_be_unjudged():
    changes = [*COARSE, "motion.duration=4s", "motion.pga=0.8g"]
    response = flexible(plane_case(BASE, changes))
    assert response.tension.stress_pa > 1e6
    assert "tension-unjudged" in codes(response)
    judged = flexible(plane_case(BASE, [*changes, "concrete.tensile_strength=9 MPa"]))
    assert "tension-unjudged" not in codes(judged)


def test_a_modulus_that_is_not_that_of_concrete_is_said_under_every_model():
    assert "value-unusual" in codes(rigid(plane_case(BASE, ["concrete.modulus=25 MPa", "motion.duration=3s"])))


def test_an_elastic_dam_that_slides_far_says_so():
    changes = [*COARSE, "motion.duration=6s", "motion.pga=2.5g", "crack.friction=0.75"]
    response = flexible(plane_case(BASE, changes))
    assert response.ok
    assert abs(response.residual_slip_m) > 0.1 * 80.0
    assert "slid-far" in codes(response)


def test_a_number_of_threads_that_is_none_is_refused_by_name():
    motion = GroundMotion.from_points([0.0, 1.0], [0.0, 1.0])
    with pytest.raises(InputError, match="threads"):
        rigid_many([plane_case(BASE)], [motion], threads=-3)


def test_the_uncertainty_is_never_less_than_two_meshes_that_agree_by_chance_may_hide():
    response = flexible(plane_case(BASE, [*FAST, "flexible.evidence=step"]))
    worth = response.evidence.residual_slip_m
    assert worth.uncertainty >= max(0.03 * abs(worth.value), 5e-5)


def test_motions_after_an_overturning_are_said_to_be_unknown():
    pulse = {"motion": {"points": [["0 s", "-1.5 g"], ["1.2 s", "-1.5 g"], ["1.2 s", "0 g"], ["2 s", "0 g"]]}}
    after = {"aftershocks": [{"points": [["0 s", "0 g"], ["0.3 s", "0.2 g"], ["0.6 s", "0 g"]], "pause": "5 s"}]}
    case = example("slender", "analysis.rotation=finite", "crack.friction=3", pulse, after)
    response = heeltoe.rigid(case)
    assert response.outcome == "overturned"
    assert "sequence-ends" in codes(response)
    assert not response.sequence[-1].static["ok"]
    assert "nothing stands after it" in response.sequence[-1].static["missed"][0]


DOWELS = {"distance": "40 m", "shear_stiffness": "30 MN/m/m", "capacity": "2.5 MN/m"}


@pytest.mark.parametrize("model", [rigid, flexible])
def test_a_dowel_is_judged_by_tension_and_shear_together(model):
    changes = [*FAST, "crack.friction=0.8", "motion.pga=0.6g", {"anchors": [DOWELS]}]
    result = model(plane_case(BASE, changes))
    (borne,) = result.anchors
    assert borne.peak_tension_n == 0.0
    assert borne.peak_force_n == pytest.approx(30e6 * result.peak_slip_downstream_m, rel=1e-3)
    assert borne.peak_force_n > 2.5e6
    assert "anchor-fails overloaded" in codes(result)
    assert "anchor-unlimited" not in codes(result)


def test_an_anchor_without_a_capacity_is_said_to_be_judged_by_nothing():
    changes = [*FAST, {"anchors": [{key: DOWELS[key] for key in ("distance", "shear_stiffness")}]}]
    response = rigid(plane_case(BASE, changes))
    assert "anchor-unlimited" in codes(response)


def test_a_slip_that_few_tendons_bear_is_said_in_the_run():
    anchors = {"anchors": [{"distance": "5 m", "prestress": "1 MN/m", "capacity": "2 MN/m"}]}
    for strength, crossed in (("0.8g", True), ("0.1g", False)):
        response = rigid(plane_case(BASE, [anchors, f"motion.pga={strength}"]))
        assert (response.peak_slip_downstream_m > 0.01) == crossed
        assert ("anchors-cross-slip" in codes(response)) == crossed


def test_anchors_that_a_slip_has_crossed_are_counted_with_and_without():
    anchors = {"anchors": [{"distance": "5 m", "prestress": "3 MN/m"}]}
    case = plane_case(BASE, [anchors, "crack.friction=1.2"])
    (notice,) = [warning for warning in heeltoe.statics(case, 0.113).warnings if warning.name == "anchors-after-slip"]
    bare = heeltoe.statics(plane_case(BASE, ["crack.friction=1.2"]), 0.113)
    quantities = dict(notice.quantities)
    assert quantities["bare_factor"] == bare.cases[-1].sliding_factor
    assert quantities["bare_factor"] < quantities["factor"]
    assert "anchors-after-slip" not in codes(heeltoe.statics(case, 0.001))


@pytest.mark.slow
def test_a_kinked_crack_at_rest_makes_no_energy():
    case = example("stepped-crack", "motion.pga=0.001g", "motion.duration=2s", "flexible.evidence=none", ENDS)
    still = GroundMotion.from_points([0.0, 1.0], [0.0, 0.0])
    energy = flexible(case, still).energy
    assert (energy.friction_j, energy.impact_j) == (0.0, 0.0)


def test_what_a_chain_owes_to_its_restitution_is_said_with_both_slips():
    changes = ["flexible.elements_across=3", "motion.duration=8s"]
    response = heeltoe.decoupled(example("koyna-top", *changes))
    dead = heeltoe.decoupled(example("koyna-top", *changes, "crack.restitution=0"))
    decides = abs(response.residual_slip_m - dead.residual_slip_m) > max(0.25 * abs(response.residual_slip_m), 1e-3)
    notices = [warning for warning in response.warnings if warning.name == "restitution-decides"]
    assert bool(notices) == decides
    assert decides
    assert dict(notices[0].quantities)["dead_slip_m"] == pytest.approx(dead.residual_slip_m, rel=1e-12)
    assert "restitution-decides" not in codes(dead)


def test_a_block_that_slides_on_has_no_residual_slip():
    """By hand: friction 0.6 holds less than the static loads ask for, so that the block accelerates for ever."""
    weak = ["crack.static_friction=1.0", "crack.kinetic_friction=0.6", "motion.pga=0.5g", "motion.duration=5s"]
    response = rigid(plane_case(BASE, [*weak, "limits.residual_slip=100 m"]))
    assert response.outcome == "keeps sliding"
    assert not response.ok
    (check,) = response.limits
    assert (check.value, check.met, check.certain) == (None, False, True)
    text = verdict(response)
    assert "it does not slow down in 10 s after the ground motion" in text
    assert text.endswith("No limit is met: the dam does not slow down on still ground.")
    assert "±" not in text
    # Without a free motion nothing shows it.
    assert rigid(plane_case(BASE, [*weak, ENDS])).outcome == "ok"


def test_warnings_come_by_gravity_and_those_of_fields_last():
    case = plane_case(BASE, [*FAST, "motion.pga=0.8g", "analysis.event_limit=100", "statics.criteria=FERC"])
    for response in (flexible(case), rigid(case)):
        rank = ["grave", "caution", "note"]
        of_fields = [warning.name.startswith("fields-") for warning in response.warnings]
        assert of_fields == sorted(of_fields)
        ranks = [
            rank.index(warning.severity) for warning in response.warnings if not warning.name.startswith("fields-")
        ]
        assert ranks == sorted(ranks)
        # What the static checks read is no field without an effect.
        assert not any("statics.criteria" in str(warning) for warning in response.warnings)


def test_periods_name_the_part_between_two_cracks():
    periods = heeltoe.dam_periods(example("two-cracks"))
    low, high = sorted(crack.elevation for crack in example("two-cracks").cracks)
    assert list(periods.parts)[:2] == [f"above {high:g} m", f"{low:g} to {high:g} m"]
    assert periods.part_names("us") == ["above 295.3 ft", "0 to 295.3 ft"]
    one = heeltoe.dam_periods(example("koyna-top"))
    assert list(one.parts) == ["above the crack", "below the crack"]
    assert one.below is not None


def test_a_later_motion_has_no_peak_upstream_that_is_downstream():
    response = heeltoe.rigid(example("aftershocks"))
    assert response.sequence[0].residual_slip_m > 0.0
    assert all(stage.peak_slip_upstream_m <= 0.0 for stage in response.sequence)
