"""Two models on one case: which is judged, what stands beside it, and what their difference means."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import InputError, Response, flexible, read_case, rigid, run, verdict
from heeltoe.result.contract import HEADLINES
from heeltoe.result.write import json_text
from heeltoe.units.sentences import Sentence
from shared.dams import BASE, FAST, example, plane_case
from shared.responses import with_numbers


@pytest.fixture
def both(typical_both) -> Response:
    return typical_both


def saying(response: Response, **values: float) -> Response:
    """The same with some headline numbers, and nothing in all others."""
    nothing = {item.key: 0.0 for item in HEADLINES}
    return with_numbers(response, **(nothing | values))


def slipping(both: Response, block: float, dam: float, **more: float) -> Response:
    """Both with other residual slips [m], and the dam with more."""
    return replace(saying(both, residual_slip_m=dam, **more), beside=saying(both.beside, residual_slip_m=block))


def test_both_models_meet_the_same_motion(both):
    assert both.ok
    assert both.beside.motion is both.motion
    assert both.beside.residual_slip_m == rigid(read_case(BASE, FAST)).residual_slip_m
    assert both.residual_slip_m == flexible(plane_case(BASE, FAST)).residual_slip_m
    assert all(response.seconds > 0.0 for response in both.responses)


def test_json(both):
    data = json.loads(json_text(both.to_json()))
    assert data["title"] == "Typical dam cracked at its base"
    assert (data["model"], data["beside"]["model"]) == ("flexible", "rigid")
    assert data["chosen"]["asked"] == data["beside"]["chosen"]["asked"] == "both"
    slips = [item["residual_slip_m"] for item in (data, data["beside"])]
    assert data["ratio"]["residual_slip_m"] == pytest.approx(slips[0] / slips[1], rel=1e-12)
    # This rigid block does not rock: there is nothing to divide by.
    assert data["beside"]["rocking_upstream_rad"] == 0.0
    assert data["ratio"]["rocking_upstream_rad"] is None


@pytest.mark.parametrize(
    ("name", "changes", "models"),
    [
        ("typical-base", [], ["rigid", "flexible"]),
        ("typical-height", [], ["decoupled", "flexible"]),
        ("block", [], ["rigid"]),
    ],
)
def test_the_model_that_fits_the_case(name, changes, models):
    """What the case has the data for: a modulus makes it elastic, a crack at a height shakes the block by its part
    below; the limits are judged with the better model alone."""
    limit = "limits.residual_slip=1 mm"
    result = run(example(name, *FAST, "motion.duration=0.4 s", limit, *changes))
    assert [response.model for response in result.responses] == models
    assert [bool(response.limits) for response in result.responses] == [
        response is result for response in result.responses
    ]
    data = result.to_json()
    assert data["chosen"]["asked"] == "auto"
    assert "concrete.modulus" in data["chosen"]["why"]


@pytest.mark.parametrize(
    ("block", "dam", "words"),
    [
        (0.036, 0.218, "slides 6.1 times as far"),
        (0.0, 0.100, "Only the flexible dam slides"),
        (0.034, 0.037, "They agree in slips, rotations and openings"),
        # Both little, but no agreement.
        (0.0014, 0.0046, "slides 3.3 times as far"),
        (0.1, -0.1, "opposite ways"),
        (0.2, 0.1, "slides only 0.5 times what"),
        (2.0, 0.001, "less than a hundredth"),
        (2e-4, 9e-4, "less than a millimetre"),
    ],
)
def test_what_the_difference_means(both, block, dam, words):
    assert words in slipping(both, block, dam).meaning()


def test_brief_meaning_gives_no_reason(both):
    """By hand: the sentences of the full one without what follows their colons and without the source."""
    assert slipping(both, 0.1, 0.2).meaning(brief=True) == (
        "The flexible dam slides 2 times as far. Trust the flexible model."
    )
    assert slipping(both, 2e-4, 9e-4).meaning(brief=True) == slipping(both, 2e-4, 9e-4).meaning()


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"opening_upstream_m": 0.01}, "differ in the opening at the upstream face (10.0 mm of the flexible dam, 0"),
        ({"rocking_downstream_rad": 1.1e-3}, "differ in the rotation downstream (1.1 mrad of the flexible dam, 0"),
        ({"peak_slip_upstream_m": -0.01}, "differ in the peak slip upstream (10.0 mm of the flexible dam, 0.00 mm"),
        ({"peak_slip_downstream_m": 0.05}, "They end alike, but differ in the peak slip downstream"),
        # The length that differs most, not the first one.
        ({"peak_slip_upstream_m": -0.01, "opening_upstream_m": 0.03}, "They end alike, but differ in the opening at"),
        ({"opening_upstream_m": 0.6e-3}, "differ in the opening at the upstream face (0.60 mm of the flexible dam, 0"),
        # No inspection tells these.
        ({"opening_upstream_m": 0.4e-3, "rocking_upstream_rad": 0.2e-3}, "They agree in slips, rotations and openings"),
    ],
)
def test_models_agree_only_where_all_does(both, more, words):
    assert words in slipping(both, 0.034, 0.037, **more).meaning()


def test_without_a_result_there_is_no_ratio(both):
    failed = replace(both, beside=replace(both.beside, outcome="paradox", advice=Sentence("stop")))
    # The better model has its result all the same.
    assert failed.ok
    assert "nothing to compare: no result to trust from the rigid model" in failed.meaning()
    assert set(failed.ratio().values()) == {None}


def test_a_case_without_motion():
    triangle = {"polygon": [["0 m", "0 m"], ["9 m", "0 m"], ["0 m", "9 m"]]}
    with pytest.raises(InputError) as refused:
        run(read_case({"section": triangle, "crack": {"friction": 1.0}}), "both")
    assert refused.value.code == "motion-missing"


def test_a_state_that_is_not_finite_is_null_in_json(both):
    blown = replace(with_numbers(both, residual_slip_m=np.inf), outcome="blown up", advice=Sentence("x"))
    data = json.loads(json_text(blown.to_json()), parse_constant=pytest.fail)
    assert data["residual_slip_m"] is None
    assert data["beside"]["residual_slip_m"] is not None


@pytest.mark.parametrize("elevation", [0, pytest.param(30, marks=pytest.mark.slow)])
def test_what_a_rigid_block_passes_and_the_dam_fails(elevation):
    """Its own limit of 50 mm, by the model that is run by itself."""
    quick = ("flexible.elements_across=4", "flexible.evidence=none", "motion.duration=12 s")
    case = example("lift-joint", *quick, f"crack.elevation={elevation} m")
    assert all(check.met for check in rigid(case).limits)
    response = run(case)
    assert response.model == "flexible"
    assert not any(check.met for check in response.limits)
    assert "A limit is not met: its" in verdict(response)
