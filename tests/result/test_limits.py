"""Results beside what the user allows: the number to trust is judged, and how certain that is."""

from __future__ import annotations

import tomllib
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import GroundMotion, flexible, read_case, verdict
from heeltoe.case.options import Limits
from heeltoe.result.limits import check_limits
from heeltoe.result.response import Response
from shared.dams import BASE, FAST, plane_case
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
    "flexible": {"elements_across": 6},
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


def test_where_single_runs_scatter_the_mean_is_judged():
    time = np.linspace(0.0, 2.0, 201)
    motion = GroundMotion.from_points(time, 5.0 * np.sin(2.0 * np.pi * 2.0 * time))
    result = flexible(plane_case(SCATTERS), motion)
    worth = result.evidence["residual_slip_m"]
    assert result.evidence["value_is"] == "mean"
    (check,) = result.limits
    assert check.value == abs(worth["value"]) != abs(worth["run"])
    assert check.uncertainty == worth["uncertainty"] > 0.0


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
