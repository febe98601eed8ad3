"""A dam cracked at two levels as two rigid blocks: the blocks of either crack alone, and all that a case may say."""

from __future__ import annotations

import re

import numpy as np
import pytest

from heeltoe import run
from heeltoe.case.combinations import check
from heeltoe.errors.error import InputError
from heeltoe.mechanics.block import build_block
from heeltoe.models.rigid.stack import place_of, walk_two_blocks
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.study.small.spread import with_spread
from shared.dams import example

CASE = example("two-cracks")
HEADLINES = ("residual_slip_m", "peak_slip_downstream_m", "largest_gap_heel_m", "largest_gap_toe_m", "impacts")


def shaken(case, size=4.0, up=0.0):
    """Run a case through waves that come and go."""
    time = np.arange(800) * 0.01
    waves = np.exp(-(((time - 2.5) / 1.2) ** 2)) * (np.sin(9.0 * time) + 0.5 * np.sin(23.0 * time))
    across = GroundMotion(time=time, acceleration=size * waves, name="waves")
    vertical = GroundMotion(time=time, acceleration=up * np.roll(waves, 30), name="up") if up else None
    return run(case, "rigid", across, vertical)


def cracks(base=1.2, neck=1.0, level=60.0, **more):
    """Return the typical dam with another crack."""
    further = [{"elevation": f"{level} m", "friction": neck}]
    return CASE.with_({"crack.friction": base, "further_cracks": further, **more})


@pytest.mark.parametrize("up", [0.0, 1.0])
@pytest.mark.parametrize(("bonded", "base", "neck"), [(0, 0.9, 9.0), (1, 9.0, 0.9)])
def test_a_bonded_crack_leaves_what_the_other_does_alone(bonded, base, neck, up):
    case = cracks(base, neck)
    response = shaken(case, 2.5, up)
    alone = shaken(case.single_crack_cases[1 - bonded], 2.5, up)
    assert response.cracks[bonded]["events"] == 0
    assert abs(alone.residual_slip_m) > 0.01
    for name in HEADLINES:
        assert response.cracks[1 - bonded][name] == pytest.approx(alone.summary[name], abs=1e-10), name
    assert response.energy.friction_j == pytest.approx(alone.energy.friction_j, rel=1e-10)


def test_water_presses_on_both_faces_of_the_upper_crack():
    # Its uplift carries the upper block, and is nothing to both of them together.
    wet, dry = cracks(), cracks()
    wet = wet.with_({"further_cracks": [{"elevation": "60 m", "friction": 1.0, "uplift_intensity": 1.0}]})
    dry = dry.with_({"further_cracks": [{"elevation": "60 m", "friction": 1.0, "uplift": "none"}]})
    upper, lower = (
        np.array([build_block(single_crack_case).static.vertical for single_crack_case in case.single_crack_cases])
        for case in (wet, dry)
    )
    assert upper[0] > lower[0]
    assert upper[1] == lower[1]


@pytest.mark.parametrize("inclination", [0.0, 8.0, -6.0])
def test_the_place_of_the_upper_block_leaves_the_weight_of_the_lower_one(inclination):
    further = [{"elevation": "60 m", "friction": 1.0, "inclination": f"{inclination} deg", "uplift": "none"}]
    case = CASE.with_({"reservoir": None, "uplift.pattern": "none", "further_cracks": further})
    upper, lower = (build_block(single_crack_case) for single_crack_case in case.single_crack_cases)
    along, across, turned = place_of(lower, upper)
    sine, cosine = np.sin(turned), np.cos(turned)
    x, z = upper.static.horizontal, upper.static.vertical
    # The upper block's loads as the lower one feels them: along and across its crack, and about its reference point.
    passed = np.array([cosine * x - sine * z, sine * x + cosine * z])
    assert passed[0] == pytest.approx(lower.static.horizontal, abs=1e-9 * abs(z))
    alone = passed[1] - lower.static.vertical
    section = case.single_crack_cases[0].outline.area - upper.section.area
    assert alone == pytest.approx(CASE.concrete.density * section * case.gravity, rel=1e-9)
    moment = along * passed[1] - across * passed[0] + upper.static_moment
    centre = (lower.concrete_mass * 0.0 - upper.concrete_mass * along) / (lower.concrete_mass - upper.concrete_mass)
    assert lower.static_moment - moment == pytest.approx(-alone * centre, rel=1e-6)


def test_both_blocks_move_and_all_that_a_response_says_agrees():
    response = shaken(cracks(0.9, 0.8), size=9.0, up=2.0)
    assert response.ok
    assert response.model == "rigid"
    assert [item["elevation_m"] for item in response.cracks] == [60.0, 0.0]
    upper, lower = response.cracks
    assert abs(upper["residual_slip_m"]) > 0.01
    assert abs(lower["residual_slip_m"]) > 0.01
    slips = [abs(item["residual_slip_m"]) for item in response.cracks]
    leads = slips.index(max(slips))
    assert response.governing_crack == response.asked == leads
    assert abs(response.residual_slip_m) == max(slips)
    assert response.energy.residual < 1e-12
    for loss in ("friction_j", "impact_j"):
        assert sum(item["crack_energy"][loss] for item in response.cracks) == pytest.approx(
            getattr(response.energy, loss)
        )
    assert list(response.others) == [f"crack-{2 - leads}"]
    assert response.others[f"crack-{2 - leads}"].residual_slip_m == response.cracks[1 - leads].residual_slip_m
    assert response.histories is response.cracks[leads].histories
    levels = [f"{item['elevation_m']:g} m" for item in response.cracks]
    assert f"the dam above the crack at {levels[leads]} slides" in response.to_json()["verdict"]
    assert f"At the crack at {levels[1 - leads]} it slides" in response.to_json()["verdict"]


def test_below_what_moves_them_nothing_moves():
    response = shaken(CASE, size=0.5)
    for crack in response.cracks:
        assert crack["residual_slip_m"] == crack["largest_gap_heel_m"] == crack["largest_gap_toe_m"] == 0.0
        assert crack["events"] == 0
    assert response.energy.input_j == 0.0


def test_the_spread_is_that_of_the_crack_asked_of():
    case = cracks(0.9, 0.8)
    response = shaken(case)
    spread = with_spread(response, case, 3)
    assert all(other.spread is None for other in spread.others.values())
    spread = spread.spread
    assert spread["failed"] == 0
    assert spread["residual_slips_m"][1] == pytest.approx(response.residual_slip_m, rel=1e-12)
    assert spread["residual_slips_m"][0] != spread["residual_slips_m"][2]


def test_the_kernel_counts_from_the_ground_up():
    case = cracks(0.9, 9.0)
    response = shaken(case)
    _, raw = walk_two_blocks(case, run_earthquake(response))
    assert raw.cracks[0].summary.slip == response.cracks[1]["residual_slip_m"]


def run_earthquake(response):
    """Return what has shaken a response."""
    from heeltoe.motion.earthquake import Earthquake

    return Earthquake(response.motion, response.vertical, response.motion.duration).silent(response.silence_s).shaking


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"further_cracks": [{"elevation": "60 m"}, {"elevation": "90 m"}]},
            "further_cracks: the rigid model does not support three cracks (3)",
        ),
        (
            {"analysis.rotation": "finite"},
            'analysis.rotation: the rigid model does not support rotation beyond small angles ("finite") with several',
        ),
        (
            {"reservoir.virtual_mass_rotates": False},
            "reservoir.virtual_mass_rotates: the rigid model does not support virtual water that does not rotate",
        ),
        ({"reservoir.hydrodynamic": "zangar"}, "reservoir.hydrodynamic: the rigid model does not support Zangar"),
    ],
)
def test_what_two_blocks_cannot_use_is_refused_by_name(changes, said):
    with pytest.raises(InputError, match=re.escape(said)):
        run(CASE.with_(changes), "rigid")


def test_two_blocks_refuse_by_themselves_what_they_cannot_use():
    # Whatever an elastic dam with several cracks may learn.
    alone = CASE.single_crack_cases[1]
    held = alone.with_({"anchors": [{"distance": "5 m", "prestress": "1 MN/m"}]}).anchors
    later = alone.with_({"aftershocks": [{"file": "elcentro-1940-180-nga"}]}).aftershocks
    law = {"name": "cohesion", "cohesion": "0.1 MPa", "residual_friction": 0.8}
    laws = alone.with_({"crack": {"elevation": "0 m", "law": law}}).crack
    open_water = alone.with_({"uplift.during_shaking": "zero while open"}).uplift
    for name, given, field in (
        ("anchors", held, "anchors"),
        ("aftershocks", later, "aftershocks"),
        ("crack", laws, "crack.law"),
        ("uplift", open_water, "uplift.during_shaking"),
    ):
        with pytest.raises(InputError, match=re.escape(field)):
            check(CASE.model_copy(update={name: given}), "rigid")


def test_a_dam_that_does_not_stand_says_at_which_crack():
    response = shaken(cracks(1.2, 0.1))
    assert response.outcome == "unstable"
    assert not response.summary
    assert str(response.advice).startswith("at the crack at 60 m: it slides under its static loads alone")


def test_a_block_that_turns_too_far_is_named():
    response = shaken(cracks(3.0, 3.0, level=92.0, reservoir=None, **{"uplift.pattern": "none"}), size=60.0)
    assert response.outcome != "ok"
    assert "at the crack at 92 m: it rotates by" in str(response.advice)


def test_too_many_events_say_so():
    response = shaken(cracks(0.9, 0.8, **{"analysis.event_limit": 5}), size=9.0)
    assert response.outcome == "event limit"
    assert "at the crack at 0 m: stopped at" in str(response.advice)
