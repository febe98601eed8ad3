"""The Python interface: one call, one immutable result, exports that agree."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pyarrow.parquet as pq
import pytest

import heeltoe
from heeltoe import GroundMotion, InputError, read_case, rigid, rigid_many, verdict
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.record import Of
from shared.dams import ALL_EXAMPLES, BASE, BLOCK, ENDS
from shared.dams import KOYNA_TOP as KOYNA


@pytest.fixture(scope="module")
def rocking():
    """A response with everything in it: sliding, rocking, drift, impacts."""
    return rigid(read_case(KOYNA, ["motion.pga=1.2g"]))


@pytest.mark.parametrize("path", ALL_EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(path):
    case = read_case(path)
    if case.crack.kinks:
        with pytest.raises(InputError, match="does not support kinks"):
            rigid(case)
        return
    response = rigid(case)
    assert response.ok
    assert response.title
    assert response.energy.residual < 1e-9
    assert verdict(response)
    json.dumps(response.to_json(), allow_nan=False)


def test_numbers_agree_with_histories_and_events(rocking):
    h = rocking.histories
    assert h["slip_m"][-1] == pytest.approx(rocking.residual_slip_m, rel=1e-12)
    # Extremes are those of the motion, not of the samples.
    assert 0.0 <= rocking.peak_slip_downstream_m - h["slip_m"].max() < 1e-3
    assert 0.0 <= rocking.rocking_upstream_rad - h["rotation_rad"].max() < 1e-4
    assert 0.0 <= rocking.rocking_downstream_rad + h["rotation_rad"].min() < 1e-4
    assert h["gap_heel_m"].min() >= 0.0
    assert h["gap_toe_m"].min() >= 0.0
    parts = rocking.slip_by_mode_m
    assert sum(parts.values()) == pytest.approx(rocking.residual_slip_m, rel=1e-12)
    assert sum(rocking.time_by_mode_s.values()) == pytest.approx(30.0, rel=1e-12)
    assert rocking.opening_downstream_m == pytest.approx(rocking.rocking_upstream_rad * rocking.crack_width_m)
    log = rocking.event_log
    assert len(log["time_s"]) == rocking.events
    assert (np.diff(log["time_s"]) >= 0.0).all()
    strikes = [kind for kind in log["kind"] if "strike" in kind]
    assert len(strikes) == rocking.impacts
    assert sum(log["energy_lost_j"]) == pytest.approx(rocking.energy.impact_j, rel=1e-9)


def test_mode_of_each_moment_agrees_with_its_state(rocking):
    h = rocking.histories
    for mode, heel, toe in zip(rocking.mode, h["gap_heel_m"], h["gap_toe_m"], strict=True):
        if mode == "rest" or mode.startswith("slide "):
            assert heel == toe == 0.0
        elif "on heel" in mode:
            assert heel == 0.0
        elif "on toe" in mode:
            assert toe == 0.0


def test_friction_stays_in_its_cone(rocking):
    h = rocking.histories
    normal = h["normal_force_heel_n"] + h["normal_force_toe_n"]
    assert (np.abs(h["friction_force_n"]) <= normal * (1.0 + 1e-9) + 1e-3).all()


def test_a_finer_output_is_the_same_motion():
    case = read_case(KOYNA, ["motion.pga=1.2g", "motion.duration=5s"])
    coarse, fine = rigid(case), rigid(case, output_step=0.001)
    assert fine.residual_slip_m == coarse.residual_slip_m
    every = fine.histories["slip_m"][::10]
    assert every == pytest.approx(coarse.histories["slip_m"], abs=1e-12)


def test_results_cannot_be_changed(rocking):
    with pytest.raises(TypeError):
        rocking.summary["residual_slip_m"] = 0.0
    with pytest.raises(AttributeError):
        rocking.title = "mine"
    with pytest.raises(AttributeError, match="no attribute 'residual_slide'"):
        _ = rocking.residual_slide


def test_exports_agree(rocking, tmp_path):
    rocking.write_histories(tmp_path / "h.parquet")
    rocking.write_events(tmp_path / "e.csv")
    table = pq.read_table(tmp_path / "h.parquet")
    assert table["slip_m"].to_numpy() == pytest.approx(rocking.histories["slip_m"])
    assert table["mode"].to_pylist() == list(rocking.mode)
    assert len((tmp_path / "e.csv").read_text().splitlines()) == rocking.events + 1


def test_references_are_those_of_the_options_used(rocking):
    assert any("Westergaard" in item for item in rocking.citation())
    dry = rigid(read_case(BLOCK))
    assert not any("Westergaard" in item for item in dry.citation())


def test_gravity_of_the_case_scales_the_slip():
    one, other = rigid(read_case(BLOCK)), rigid(read_case(BLOCK, ["gravity=9.81m/s^2"]))
    assert other.residual_slip_m / one.residual_slip_m == pytest.approx(9.81 / 9.80665, rel=1e-12)


def test_a_reversed_record_on_a_symmetric_block_mirrors_the_result():
    one, other = rigid(read_case(BLOCK)), rigid(read_case(BLOCK, ["motion.reverse=true"]))
    assert other.residual_slip_m == pytest.approx(-one.residual_slip_m, rel=1e-14)
    assert other.peak_slip_downstream_m == pytest.approx(-one.peak_slip_upstream_m, rel=1e-14)
    # It stops at the very end of the run, and is seen to.
    assert one.final_mode == other.final_mode == "rest"


def test_still_moving_in_the_end_is_a_warning():
    response = rigid(read_case(BASE, ["motion.duration=2.1s", ENDS]))
    assert response.final_mode == "slide downstream"
    assert any("still moves when the ground motion ends" in item for item in map(str, response.warnings))
    assert "still moves" in verdict(response)


def test_after_the_record_the_ground_stands_still():
    motion = GroundMotion.from_points([0.0, 1.0], [3.0, 3.0])
    shaking = Earthquake(motion, None, 5.0).shaking
    assert shaking.time.tolist() == [0.0, 1.0, 1.0, 5.0]
    assert shaking.horizontal.tolist() == [3.0, 3.0, 0.0, 0.0]
    assert shaking.up is None


def test_two_directions_share_moments_and_keep_jumps():
    across = GroundMotion.from_points([0.0, 1.0, 1.0, 2.0], [0.0, 1.0, -1.0, 0.0])
    up = GroundMotion.from_points([0.0, 0.5, 3.0], [0.0, 5.0, 0.0])
    shaking = Earthquake(across, up, 4.0).shaking
    assert shaking.time.tolist() == [0.0, 0.5, 1.0, 1.0, 2.0, 3.0, 4.0]
    assert shaking.horizontal == pytest.approx([0.0, 0.5, 1.0, -1.0, 0.0, 0.0, 0.0])
    assert shaking.up == pytest.approx([0.0, 5.0, 4.0, 4.0, 2.0, 0.0, 0.0])


def test_vertical_motion_changes_the_result():
    plain = rigid(read_case(BASE))
    shaken = rigid(read_case(BASE, ['motion.vertical.file="elcentro-1940-up-nga"']))
    assert shaken.residual_slip_m != plain.residual_slip_m
    assert shaken.vertical is not None
    assert shaken.to_json()["vertical_motion"]["name"] == "elcentro-1940-up-nga"
    assert shaken.energy.residual < 1e-9


def test_many_runs_equal_single_ones():
    cases = [read_case(KOYNA, [f"crack.friction={mu}"]) for mu in (0.7, 0.9, 1.1)]
    motion = rigid(cases[0]).motion
    table = rigid_many([heeltoe.build_block(case) for case in cases], [motion], progress=True)
    for k, case in enumerate(cases):
        assert table["slip"][k] == rigid(case, motion).residual_slip_m


def test_a_floating_and_an_overturning_dam_are_told_apart():
    section = {"polygon": [["0 m", "0 m"], ["20 m", "0 m"], ["20 m", "60 m"], ["0 m", "60 m"]]}
    motion = {"points": [["0 s", "0.1 g"], ["1 s", "0.1 g"]]}

    def advice(**fields):
        response = rigid(read_case({"section": section, "crack": {"friction": 1.0}, "motion": motion, **fields}))
        assert response.outcome == "unstable"
        assert not response.summary
        assert "No result to trust" in verdict(response)
        json.dumps(response.to_json(), allow_nan=False)
        return str(response.advice)

    light = {"density": "900 kg/m^3"}
    text = advice(concrete=light, reservoir={"depth": "60 m"}, uplift={"pattern": "uniform"})
    assert "it floats" in text
    text = advice(crack={"friction": 2.0}, reservoir={"depth": "55 m"})
    assert "overturns about its toe" in text
    assert "sliding safety factor 0." in advice(crack={"friction": 0.2}, reservoir={"depth": "40 m"})


@pytest.mark.parametrize(
    ("friction", "words"), [(0.9, None), (0.4, "% of the width of its crack"), (0.1, "has left what it stood on")]
)
def test_a_block_that_leaves_its_place_is_a_warning(friction, words):
    pushed = 'motion.points=[["0 s", "-1 g"], ["0.3 s", "-1 g"], ["0.3 s", "0 g"], ["4 s", "0 g"]]'
    case = read_case(
        BLOCK,
        [f"crack.friction={friction}", pushed, "motion.duration=4s", "crack.restitution=0"],
    )
    response = rigid(case)
    starts = ("the block slides", "the part above the crack slides")
    message = [text for text in map(str, response.warnings) if text.startswith(starts)]
    assert (words is None and not message) or words in message[0]
    # To 10 % of the width nothing is said.
    assert (response.peak_slip_downstream_m <= 0.1) == (words is None)


def test_slip_in_the_air_is_a_warning():
    # The dam of the thesis that hops: none of its slip is there where impacts do not rebound.
    bouncing, still = (rigid(read_case(KOYNA, [f"crack.restitution={e}", "crack.friction=1.5"])) for e in (0.5, 0.0))
    assert any("happens in the air" in text for text in map(str, bouncing.warnings))
    assert not any("happens in the air" in text for text in map(str, still.warnings))
    assert abs(still.residual_slip_m) < 0.1 * abs(bouncing.residual_slip_m)


def test_numbers_of_the_summary_are_attributes(rocking):
    """Each is the number of that name, and a number that a model does not give is no attribute of its response."""
    named = [name for name in dir(type(rocking)) if isinstance(getattr(type(rocking), name), Of)]
    assert set(named) == set(rocking.summary)
    for name in rocking.summary:
        assert getattr(rocking, name) == rocking.summary[name]
    assert not hasattr(rocking, "crack_level")
    never = replace(rocking, outcome="unstable").with_crack(of_crack=None)
    with pytest.raises(AttributeError, match=r"without a run.* has no 'residual_slip_m'"):
        _ = never.residual_slip_m
