"""The slip of a block that turns by any angle: continuous, one with the way of its base, the same mirrored."""

import math

import numpy as np
import pytest

from heeltoe import build_block, read_case
from heeltoe.kernel.block import run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.rigid.varying import varying
from shared.random_blocks import draw

WIDTH, HEIGHT = 1.0, 2.0
#: Thrown up with its toe higher by this angle, it turns through the upright and lands on its toe.
TILT, RATE, RISE, LIFT = 0.25, -1.5, 1.5, 0.05


def thrown(restitution=0.0, sign=1.0):
    """Return the run of a block in flight, its centroid moving up and down alone, and the moments; mirrored for -1."""
    corners = [["0 m", "0 m"], ["1 m", "0 m"], ["1 m", "2 m"], ["0 m", "2 m"]]
    crack = {"friction": 0.8, "restitution": restitution}
    case = read_case({"section": {"polygon": corners}, "crack": crack, "analysis": {"rotation": "finite"}})
    sine, cosine = math.sin(TILT), math.cos(TILT)
    sideways = (0.5 * WIDTH * sine + 0.5 * HEIGHT * cosine) * RATE
    gaps, rates = [LIFT, LIFT + WIDTH * sine], [RISE, RISE + WIDTH * cosine * RATE]
    if sign < 0.0:
        gaps, rates = gaps[::-1], rates[::-1]
    moments = np.linspace(0.0, 4.0, 4001)
    still = Shaking(np.array([0.0, 4.0]), np.zeros(2), None, None)
    block = build_block(case)
    start = [[0.0, *gaps], [sign * sideways, *rates]]
    run = run_block(block.parameters(), still, moments, start=start, varying=varying(case, block))
    return run, moments


def test_the_slip_in_flight_is_that_of_the_lower_corner():
    # The centroid stays over one place: X_h + B/2 (cos - 1) - H sin is constant, and so is X_t - B/2 (cos - 1) - H sin.
    run, moments = thrown()
    h = run.histories
    flies = moments < run.events.time[run.events.approach_velocity_toe < 0.0][0]
    theta = np.arcsin((h.gap_toe - h.gap_heel)[flies] / WIDTH)
    assert theta[0] > 0.2
    assert theta[-1] < -0.15
    way = 0.5 * WIDTH * np.sign(theta) * (np.cos(theta) - 1.0) - 0.5 * HEIGHT * np.sin(theta)
    assert h.slip[flies] == pytest.approx(way[0] - way, abs=1e-12)
    # Its velocity and acceleration are those of the slip; the acceleration alone changes at once where it is upright.
    step = moments[1]
    smooth = np.sign(theta[2:]) == np.sign(theta[:-2])
    for rate, value in (("slip_velocity", "slip"), ("slip_acceleration", "slip_velocity")):
        slope = np.gradient(getattr(h, value)[flies], step)[1:-1]
        assert getattr(h, rate)[flies][1:-1][smooth] == pytest.approx(slope[smooth], abs=1e-5)
    struck = int(np.flatnonzero(run.events.approach_velocity_toe < 0.0)[0])
    last = np.flatnonzero(flies)[-1]
    assert run.events.approach_slip_velocity[struck] == pytest.approx(h.slip_velocity[last], abs=0.02)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_slip_never_jumps_and_its_parts_add_up(restitution):
    run, moments = thrown(restitution)
    h, one = run.histories, run.summary
    assert run.outcome == "ok"
    assert run.times_of("toe strikes")
    fastest = np.maximum(np.abs(h.slip_velocity[1:]), np.abs(h.slip_velocity[:-1]))
    assert (np.abs(np.diff(h.slip)) <= 1.05 * fastest * moments[1] + 2e-5).all()
    parts = one.slip_sliding + one.slip_slide_rocking + one.slip_drifting
    assert parts == pytest.approx(one.slip, abs=1e-13)
    assert one.slip_min == pytest.approx(h.slip.min(), abs=1e-6)
    assert one.slip_max == pytest.approx(h.slip.max(), abs=1e-6)
    assert one.energy_residual < 1e-11


def test_a_mirrored_flight_slips_the_other_way():
    (one, _), (other, _) = thrown(0.5), thrown(0.5, sign=-1.0)
    assert other.histories.slip == pytest.approx(-one.histories.slip, abs=1e-9)
    assert other.summary.slip_drifting == pytest.approx(-one.summary.slip_drifting, abs=1e-9)
    assert one.summary.slip_drifting != 0.0


def test_random_blocks_of_any_rotation_slip_by_the_sum_of_their_modes():
    drifted = 0
    for seed in range(120):
        drawn = draw(seed)
        if drawn.case.analysis.rotation != "finite":
            continue
        one = drawn.run().summary
        parts = one.slip_sliding + one.slip_slide_rocking + one.slip_drifting
        assert parts == pytest.approx(one.slip, abs=1e-11 * drawn.block.width), seed
        drifted += one.slip_drifting != 0.0
    assert drifted > 10
