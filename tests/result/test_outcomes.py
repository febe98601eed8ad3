"""What is a result and what is none: dams that do not stand, that overturn, that turn too far, that still move."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from heeltoe import Response, flexible, read_case, rigid, verdict
from heeltoe.mechanics.block import build_block
from heeltoe.models.flexible.warnings import judge_outcome
from heeltoe.result.rest import comes_to_rest
from shared.dams import COARSE, FAST, PULSE, example, polygon

# A triangle of 100 m on a base of 45 m, which a full reservoir tips over about the toe of a crack at 20 m.
TIPPING = {
    "section": polygon([(0, 0), (45, 0), (0, 100)]),
    "concrete": {"modulus": "25 GPa", "density": "2400 kg/m^3"},
    "crack": {"elevation": "20 m", "friction": 2.0},
    "reservoir": {"depth": "100 m"},
    "uplift": {"pattern": "triangular"},
    "motion": PULSE,
    "limits": {"residual_slip": "10 m", "opening_upstream": "100 m"},
}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ([], "overturns about its toe under its static loads alone"),
        (["crack.friction=0.5"], "it slides under its static loads alone"),
        (["concrete.density=900 kg/m^3"], "it floats"),
    ],
)
def test_what_does_not_stand_is_no_dam_that_is_shaken(changes, words):
    """Sliding is not all that static loads can do."""
    case = read_case(TIPPING, [*COARSE, *changes])
    for response in (flexible(case), rigid(case)):
        assert response.outcome == "unstable"
        assert words in verdict(response)
        assert not any(check.met for check in response.limits)


def test_a_slip_that_is_no_result_is_not_made_certain():
    """It would cost dozens of runs, and say that a slip that goes on has not converged."""
    response = flexible(read_case(TIPPING, [*COARSE, "flexible.evidence=full"]))
    assert response.outcome == "unstable"
    assert response.evidence is None
    assert not any(notice.field == "flexible.evidence" for notice in response.warnings)


def test_an_overturned_dam_keeps_no_limit():
    response = rigid(example("slender", "limits.residual_slip=10 m"))
    assert response.outcome == "overturned"
    (check,) = response.to_json()["limits"]
    assert check["value"] < check["allowed"]
    assert not check["met"]
    assert "keeps within" not in verdict(response)
    assert verdict(response).endswith("No limit is met: the dam overturns.")


def test_small_rotations_that_are_large_are_no_result():
    small = rigid(example("slender", "analysis.rotation=small"))
    assert small.outcome == "large rotation"
    assert not small.ok
    assert 'the rigid model with analysis.rotation = "finite" says whether one block overturns' in verdict(small)
    assert rigid(example("slender", "motion.pga=0.3 g", "analysis.rotation=small")).ok


@pytest.mark.parametrize(("rotation", "outcome"), [(0.09, "ok"), (0.11, "large rotation")])
def test_rotations_beyond_the_elastic_model(typical_elastic, rotation, outcome):
    block = build_block(example("typical-base", *FAST))
    numbers = {"rotation_max": 0.0, "rotation_min": -rotation, "slip_max": 0.0, "slip_min": 0.0}
    raw = SimpleNamespace(by_name=lambda: numbers)
    raw.end_time = raw.slip = 0.0
    run = SimpleNamespace(summary=raw, summaries=(raw,), outcome="ok")
    result, advice = judge_outcome(typical_elastic.crack.dam, block, run)
    assert result == outcome
    assert (advice is None) == (outcome == "ok")
    assert advice is None or "it rotates by 0.11 rad: the dam rotates by more than 0.1 rad" in str(advice)


@pytest.mark.parametrize("gap", ["gap_heel_m", "gap_toe_m"])
def test_what_still_rocks_is_not_at_rest(typical_elastic: Response, gap):
    h = typical_elastic.histories
    still = {name: np.zeros_like(h[name]) for name in ("slip_m", "gap_heel_m", "gap_toe_m")}
    assert comes_to_rest(typical_elastic.with_crack(histories={**h, **still}))
    rocking = 0.01 * np.maximum(0.0, np.sin(9.0 * h["time_s"]))
    response = typical_elastic.with_crack(histories={**h, **still, gap: rocking})
    assert not comes_to_rest(response)
    face = "upstream" if gap == "gap_heel_m" else "downstream"
    assert f"in the last 1 s its opening at the {face} face changes by 10.0 mm" in verdict(response)


def test_a_rigid_pass_has_its_caveat():
    response = rigid(example("typical-base", "motion.duration=3 s", "limits.residual_slip=10 m"))
    assert all(check.met for check in response.limits)
    assert verdict(response).startswith("As a rigid block, the dam slides")
    assert "As a rigid block it meets all limits; as a dam that vibrates it may not." in verdict(response)


def test_the_event_limit_counts_the_events_that_are_told():
    response = rigid(example("koyna-top", "analysis.event_limit=5"))
    assert response.outcome == "event limit"
    assert response.events == response.events_table().num_rows
