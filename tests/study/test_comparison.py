"""Both models side by side, and everything that a run writes."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import Comparison, InputError, compare, flexible, read_case, rigid
from heeltoe.result.write import json_text
from heeltoe.units.sentences import Sentence
from shared.dams import BASE, FAST


@pytest.fixture
def both(typical_both) -> Comparison:
    return typical_both


def slipping(both: Comparison, block: float, dam: float) -> Comparison:
    """The same with other residual slips [m]."""
    one, other = (
        replace(each, summary={**each.summary, "residual_slip_m": slip})
        for each, slip in ((both.rigid, block), (both.flexible, dam))
    )
    return replace(both, rigid=one, flexible=other)


def test_both_models_meet_the_same_motion(both):
    assert both.ok
    assert both.rigid.motion is both.flexible.motion
    assert both.rigid.residual_slip_m == rigid(read_case(BASE, FAST)).residual_slip_m
    assert both.flexible.residual_slip_m == flexible(read_case(BASE, FAST)).residual_slip_m
    assert set(both.seconds) == {"rigid", "flexible"}
    assert all(value > 0.0 for value in both.seconds.values())


def test_json(both):
    data = json.loads(json_text(both.to_json()))
    assert data["model"] == "both"
    assert data["title"] == "Typical dam cracked at its base"
    assert (data["rigid"]["model"], data["flexible"]["model"]) == ("rigid", "flexible")
    slips = [data[model]["residual_slip_m"] for model in ("flexible", "rigid")]
    assert data["ratio"]["residual_slip_m"] == pytest.approx(slips[0] / slips[1], rel=1e-12)
    # This rigid block does not rock: there is nothing to divide by.
    assert data["rigid"]["rocking_upstream_rad"] == 0.0
    assert data["ratio"]["rocking_upstream_rad"] is None


@pytest.mark.parametrize(
    ("block", "dam", "words"),
    [
        (0.036, 0.218, "slides 6.1 times as far"),
        (0.0, 0.100, "Only the flexible dam slides"),
        (0.034, 0.037, "They agree"),
        (0.1, -0.1, "opposite ways"),
        (0.2, 0.1, "slides only 0.5 times what"),
        (2.0, 0.001, "less than a hundredth"),
        (1e-5, 2e-4, "less than a millimetre"),
    ],
)
def test_what_the_difference_means(both, block, dam, words):
    assert words in slipping(both, block, dam).meaning()


def test_without_a_result_there_is_no_ratio(both):
    failed = replace(both, rigid=replace(both.rigid, outcome="paradox", advice=Sentence("stop")))
    assert not failed.ok
    assert "nothing to compare: no result to trust from the rigid model" in failed.meaning()
    assert set(failed.ratio().values()) == {None}


def test_a_case_without_motion():
    triangle = {"polygon": [["0 m", "0 m"], ["9 m", "0 m"], ["0 m", "9 m"]]}
    with pytest.raises(InputError) as refused:
        compare(read_case({"section": triangle, "crack": {"friction": 1.0}}))
    assert refused.value.code == "motion-missing"


def test_a_state_that_is_not_finite_is_null_in_json(both):
    blown = replace(
        both.flexible,
        outcome="blown up",
        advice=Sentence("x"),
        summary={**both.flexible.summary, "residual_slip_m": np.inf},
    )
    data = json.loads(json_text(replace(both, flexible=blown).to_json()), parse_constant=pytest.fail)
    assert data["flexible"]["residual_slip_m"] is None
    assert data["rigid"]["residual_slip_m"] is not None
