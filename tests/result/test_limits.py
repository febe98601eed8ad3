"""Results beside what the user allows: the number to trust is judged, and how certain that is."""

from __future__ import annotations

import tomllib
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import GroundMotion, flexible, read_case, verdict
from heeltoe.case.options import Limits
from heeltoe.result.judge import LimitCheck
from heeltoe.result.limits import check_limits, judge_response
from heeltoe.result.numbers import SignNumbers
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from shared.dams import BASE, FAST, plane_case
from shared.evidence import scattered
from shared.responses import with_numbers

NUMBERS = {
    "residual_slip_m": -0.060,
    "peak_slip_downstream_m": 0.02,
    "peak_slip_upstream_m": -0.070,
    "opening_upstream_m": 0.010,
    "opening_downstream_m": 0.0,
}
# Its slip depends on the last per cent of the shaking.
SCATTERS = {
    "section": {"height": "30 m", "crest_width": "4 m", "base_width": "24 m"},
    "concrete": {"modulus": "20 GPa"},
    "crack": {"friction": 0.7},
    "reservoir": {"depth": "24 m"},
    "flexible": {"elements_across": 6, "time_step": "0.2 ms"},
    "limits": {"residual_slip": "1 m"},
}


@pytest.fixture(scope="module")
def response() -> Response:
    return flexible(read_case(BASE, [*FAST, "flexible.evidence=step"]))


def judged(response: Response, limit: str, *, evidence: bool = True):
    result = with_numbers(response, **NUMBERS)
    worth = result.evidence.residual_slip_m
    answer = {name: replace(worth, value=value, uncertainty=0.011) for name, value in NUMBERS.items()}
    result = with_numbers(result, evidence=replace(result.evidence, **answer) if evidence else None)
    return check_limits(Limits(residual_slip=limit, peak_slip="100 mm"), result)


@pytest.mark.parametrize(
    ("limit", "met", "certain", "words"),
    [
        ("100 mm", True, True, "All limits are met."),
        (
            "65 mm",
            True,
            False,
            "All limits are met, but not for certain: its residual slip of 60.0 mm ± 11.0 mm may "
            "be more than the 65.0 mm allowed.",
        ),
        (
            "55 mm",
            False,
            False,
            "A limit is not met, though not for certain: its residual slip of 60.0 mm ± 11.0 mm is "
            "more than the 55.0 mm allowed.",
        ),
        (
            "40 mm",
            False,
            True,
            "A limit is not met: its residual slip of 60.0 mm is more than the 40.0 mm allowed.",
        ),
    ],
)
def test_a_limit_within_the_uncertainty_is_not_met_or_missed_for_certain(response, limit, met, certain, words):
    slip, peak = judged(response, limit)
    assert (slip.met, slip.certain) == (met, certain)
    assert (peak.value, peak.met, peak.certain) == (0.070, True, True)
    result = replace(response, limits=(slip, peak))
    assert verdict(result).endswith(words)
    (message, _) = result.to_json()["limits"]
    assert (message["met"], message["certain"], message["uncertainty"]) == (met, certain, 0.011)


def test_without_evidence_nothing_is_said_of_certainty(response):
    slip, _ = judged(response, "60.001 mm", evidence=False)
    assert (slip.met, slip.certain, slip.uncertainty) == (True, True, 0.0)


def test_where_single_runs_scatter_a_fractile_is_judged():
    time = np.linspace(0.0, 2.0, 201)
    motion = GroundMotion.from_points(time, 5.0 * np.sin(2.0 * np.pi * 2.0 * time))
    result = flexible(plane_case(SCATTERS), motion)
    worth = result.evidence["residual_slip_m"]
    assert result.evidence["value_is"] == "mean"
    (check,) = result.limits
    assert check.value == abs(worth["distribution"]["fractile_84"]) > abs(worth["value"])
    assert (check.exceeding, check.met) == (0.0, True)
    assert check.uncertainty > worth["uncertainty"] > 0.0


def test_rotation_and_crest_have_limits_with_units_and_utilisation():
    limits = {"rotation": "0.05 mrad", "crest_displacement": "1 m", "crest_acceleration": "0.2 g"}
    result = flexible(read_case({**tomllib.loads(BASE.read_text()), "limits": limits}, FAST[:-1]))
    turn, far, hard = result.limits
    assert [check.unit for check in result.limits] == ["rad", "m", "g"]
    assert turn.value == max(result.rocking_downstream_rad, result.rocking_upstream_rad)
    assert (far.value, hard.value) == (result.crest.displacement_m, result.crest.acceleration_g)
    assert hard.utilisation == pytest.approx(hard.value / 0.2)
    assert (hard.met, far.met) == (False, True)
    assert "its crest acceleration of" in verdict(result)


# Slips of a hundred runs, 1 to 100 mm, upstream, in no order.
RUNS = [-0.001 * (1 + 37 * place % 100) for place in range(100)]


@pytest.mark.parametrize(
    ("limit", "met", "exceeding", "words"),
    [
        (
            "90 mm",
            True,
            0.10,
            "All limits are met. Limits are judged on what 84 % of the runs with the shaking varied by 1 % keep to: "
            "10 % of the runs exceed the limit of residual slip.",
        ),
        (
            "70 mm",
            False,
            0.30,
            "A limit is not met: its residual slip of 84.0 mm is more than the 70.0 mm allowed. Limits are judged on "
            "what 84 % of the runs with the shaking varied by 1 % keep to: 30 % of the runs exceed the limit of "
            "residual slip.",
        ),
    ],
)
def test_a_slip_that_scatters_is_judged_by_what_84_per_cent_of_the_runs_keep_to(response, limit, met, exceeding, words):
    result = scattered(with_numbers(response, **NUMBERS), RUNS)
    limits = Limits(residual_slip=limit)
    (check,) = check_limits(limits, result)
    assert check.value == pytest.approx(0.084)
    assert (check.met, check.certain) == (met, True)
    assert check.exceeding == pytest.approx(exceeding)
    assert verdict(replace(result, limits=(check,))).endswith(words)
    # The mean of all has the standard error of 0.002 m, the fractile of a normal sample 1.5 times as much.
    assert check.uncertainty == pytest.approx(np.sqrt(0.003**2 + (1.5**2 - 1.0) * 0.002**2))
    (same,) = judge_response(limits, result)[0].met.values()
    assert same == check.met


def test_runs_without_a_result_exceed_every_limit(response):
    """By hand: with 16 of 100 lost, 84 % keep to the largest that is known; with 17, no limit is met."""
    known = sorted(RUNS)[::-1]
    for lost, met in ((16, True), (17, False)):
        result = scattered(with_numbers(response, **NUMBERS), known[: 100 - lost] + [None] * lost)
        (check,) = check_limits(Limits(residual_slip="90 mm"), result)
        assert check.value == pytest.approx(0.001 * (100 - lost))
        assert check.exceeding == pytest.approx(lost / 100.0)
        assert check.met == met


def exceeded(name, share):
    """Return a limit that this share of the runs exceed; none is known of one that is not judged by them."""
    return LimitCheck(name=name, value=2.0 if share else 0.5, allowed=1.0, failed=False, exceeding=share)


@pytest.mark.parametrize(
    ("shares", "words"),
    [
        ({"residual_slip": 1.0, "peak_slip": 1.0, "rotation": 1.0}, "all runs exceed each of them."),
        (
            {"residual_slip": 0.3, "peak_slip": 1.0, "rotation": 0.3},
            "30 % of the runs exceed the limits of residual slip and rotation; all runs exceed the limit of peak slip.",
        ),
        ({"residual_slip": 0.0}, "no run exceeds the limit of residual slip."),
    ],
)
def test_a_verdict_names_equal_shares_of_runs_once(response, shares, words):
    runs = "what 84 % of the runs with the shaking varied by 1 % keep to: "
    checks = [exceeded(name, share) for name, share in shares.items()]
    assert verdict(replace(response, limits=tuple(checks))).endswith(f". Limits are judged on {runs}{words}")
    # The crest has one run.
    checks.append(exceeded("crest_displacement", None))
    text = verdict(replace(response, limits=tuple(checks)))
    assert ". Limits are" not in text
    assert f"{'limits' if len(shares) > 1 else 'limit'} of residual slip" in text
    assert f" {'are' if len(shares) > 1 else 'is'} judged on {runs}{words}" in text


def test_a_verdict_has_mean_and_fractiles_and_says_what_is_not_converged(response):
    result = scattered(with_numbers(response, **NUMBERS), RUNS)
    text = verdict(result)
    assert "slides 50.5 mm in the mean (numerically ± 3.0 mm) upstream" in text.replace("3.00", "3.0")
    assert (
        "Single runs scatter: with the shaking varied by 1 %, 16 and 84 % of them keep to 16.0 mm and 84.0 mm, "
        "respectively."
    ) in text
    assert "not converged" not in text
    doubtful = with_numbers(result, evidence=replace(result.evidence, converged=False))
    assert "in the mean (not converged, numerically ± 3" in verdict(doubtful)


def test_a_single_run_beside_a_mean_is_called_one(response):
    way = SignNumbers(
        sign="recorded",
        governs=True,
        outcome=Outcome.OK,
        elevation_m=0.0,
        residual_slip_m=0.04,
        opening_m=0.0,
        limits_not_met=0,
    )
    both = replace(with_numbers(response, **NUMBERS), signs=(way, replace(way, sign="reversed", governs=False)))
    assert "This is for the motion as recorded; reversed it slides 40.0 mm." in verdict(both)
    text = verdict(scattered(both, RUNS))
    assert "This is for the motion as recorded; reversed a single run slides 40.0 mm." in text
