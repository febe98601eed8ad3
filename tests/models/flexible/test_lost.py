"""A part that turns off any scale is lost whichever way it turns: the mirror image of a run ends as it does."""

from __future__ import annotations

import pytest

from heeltoe import GroundMotion, flexible
from shared.dams import plane_case

DAM = {
    "section": {"polygon": [["0 m", "0 m"], ["0.2 m", "0 m"], ["0.2 m", "0.8 m"], ["0 m", "0.8 m"]]},
    "concrete": {"modulus": "20 GPa"},
    "crack": {"friction": 5.0},
    "flexible": {"elements_across": 1, "evidence": "none"},
    "analysis": {"silence": "0 s"},
}


def test_a_toe_that_opens_off_any_scale_ends_the_run_as_a_heel_does():
    ends = []
    for push in (-30.0, 30.0):
        response = flexible(plane_case(DAM), GroundMotion.from_points([0.0, 6.0], [push, push]))
        assert response.outcome == "lost"
        assert max(response.opening_upstream_m, response.opening_downstream_m) > 100.0 * 0.2
        ends.append(response.end_time_s)
    assert ends[0] == pytest.approx(ends[1], rel=1e-3)
    assert ends[1] < 5.0
