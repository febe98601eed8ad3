"""What the words say of an elastic dam: neither more nor less than it does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from heeltoe import Response, flexible, verdict
from heeltoe.result.rest import comes_to_rest
from heeltoe.units.write import angle, length
from shared.dams import BASE, FAST, plane_case
from shared.responses import with_numbers


@pytest.fixture
def response(typical_elastic) -> Response:
    return typical_elastic


def verdict_of(response: Response, **summary: object) -> str:
    return verdict(with_numbers(response, **summary))


def with_slip(response: Response, *slips: float) -> Response:
    """The same with a slip that goes straight from value to value [m]."""
    time = response.histories["time_s"]
    slip = np.interp(time, np.linspace(0.0, time[-1], len(slips)), slips)
    closed = {name: np.zeros_like(time) for name in ("gap_heel_m", "gap_toe_m")}
    return response.with_crack(histories={**response.histories, **closed, "slip_m": slip})


def test_slides(response):
    assert verdict(response).startswith(f"The dam slides {1e3 * response.residual_slip_m:.1f} mm downstream.")
    back = verdict_of(response, residual_slip_m=-0.02, peak_slip_upstream_m=-0.03)
    assert "slides 20.0 mm upstream, after up to 30.0 mm on the way." in back


def test_elastic_to_and_fro_is_no_sliding(response):
    small = {"peak_slip_upstream_m": -2e-5, "peak_slip_downstream_m": 9e-5, "residual_slip_m": 5e-5}
    assert verdict_of(response, **small).startswith("The dam does not slide. ")
    back = {"peak_slip_upstream_m": -2e-4, "peak_slip_downstream_m": 9e-4, "residual_slip_m": 5e-5}
    assert "does not slide: its crack shifts by up to 0.90 mm and comes back." in verdict_of(response, **back)


def with_times(response: Response, **seconds: float) -> Response:
    """The same with these times by mode, else at rest [s]."""
    times = dict.fromkeys(response.time_by_mode_s, 0.0) | {"rest": 3.0} | seconds
    return with_numbers(response, time_by_mode_s=times)


def test_a_crack_that_never_lets_go_creeps(response):
    assert "creeps" in verdict(with_times(response))
    assert "while the rest holds" in verdict(with_times(response))
    # A hundredth of a second in which half of the crack lets go is no sliding yet, three are.
    for seconds, word in ((0.01, "creeps"), (0.03, "slides")):
        assert word in verdict(with_times(response, sliding=seconds))


def test_a_crack_that_opens_in_part_does_not_rock(response):
    assert "No rocking: the opening" in verdict(with_times(response, sliding=1.0, rocking=0.01))
    rocks = verdict(with_times(response, sliding=1.0, rocking=0.4, slide_rocking=0.23))
    assert "It rocks, standing on one end of the crack, for 0.63 s in all." in rocks
    assert "No rocking" not in rocks


def test_a_quiet_dam_stays_where_it_is():
    quiet = [*FAST, "motion.pga=0.05g", "reservoir.depth=20m"]
    text = verdict(flexible(plane_case(BASE, quiet)))
    assert text.startswith("The dam does not slide.")
    assert "It has come to rest in the end." in text
    assert "strike" not in text


def test_openings_and_strikes(response):
    text = verdict_of(response, opening_upstream_m=0.012, opening_downstream_m=5e-5, impacts=1)
    assert "opens up to 12.0 mm at the upstream face, the part above it rotates" in text
    assert "nodes of the crack strike once at" in text
    assert "strike 7 times, the fastest at" in verdict_of(response, impacts=7)
    assert "strike" not in verdict_of(response, impacts=0)
    nothing = {"opening_upstream_m": 0.0, "opening_downstream_m": 0.0}
    assert "stays closed at both faces" in verdict_of(response, **nothing)
    assert "less than anyone could measure" in verdict_of(response, **{**nothing, "opening_upstream_m": 9e-5})
    times = {**response.time_by_mode_s, "drifting": 0.25}
    assert "For 0.25 s in all it touches nothing." in verdict_of(response, time_by_mode_s=times)


def test_at_rest_or_not(response):
    # At rest is what does not move any more, whatever its crack looks like.
    still = with_slip(response, 0.0, 0.1, 0.1, 0.1)
    assert comes_to_rest(still)
    assert "It has come to rest in the end." in verdict(still)
    moving = with_slip(response, 0.0, 0.3)
    assert not comes_to_rest(moving)
    assert "in the last 1 s its slip changes by 100.0 mm" in verdict(moving)
    away = moving.with_crack(static=replace(moving.static, sliding_safety_factor=0.9))
    assert "It slides away" in verdict(away)


@pytest.mark.parametrize(
    ("metres", "words"),
    [
        (12.345, "12.35 m"),
        (1.0, "1.00 m"),
        (0.5782, "578.2 mm"),
        (0.001, "1.0 mm"),
        (-0.0015, "-1.5 mm"),
        (0.00043, "0.43 mm"),
        (1e-5, "0.01 mm"),
        (1e-7, "under 0.01 mm"),
        (0.0, "0.00 mm"),
    ],
)
def test_lengths(metres, words):
    assert length(metres) == words


@pytest.mark.parametrize(
    ("metres", "words"),
    [
        (12.345, "40.50 ft"),
        (1.0, "39.37 in"),
        (-0.5782, "-22.76 in"),
        (0.001, "0.0394 in"),
        (1e-5, "0.0004 in"),
        (1e-7, "under 0.0004 in"),
        (0.0, "0 in"),
    ],
)
def test_lengths_in_units_of_the_united_states(metres, words):
    assert length(metres, "us") == words


def test_verdicts_in_units_of_the_united_states(response):
    text = verdict(response, "us")
    assert f"slides {length(response.residual_slip_m, 'us')} downstream" in text
    assert "ft/s" in text
    assert " mm" not in text
    assert " m/s" not in text


def test_angles():
    assert angle(2.467e-4) == "0.247 mrad"
    assert angle(5.95e-3) == "5.95 mrad"
