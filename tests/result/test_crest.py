"""The motion of the crest: that of a block in closed form, of an elastic dam beside it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from heeltoe import GroundMotion, flexible, rigid
from heeltoe.result.crest import ACCELERATION, DISPLACEMENT, band_weights, crest_series, in_band
from shared.dams import BASE, COARSE, plane_case

TIME = np.arange(0.0, 3.0 + 1e-9, 0.005)
SHAKES = GroundMotion.from_points(TIME, 6.0 * np.sin(2.0 * np.pi * 2.0 * TIME))


def test_a_parabola_has_its_own_acceleration_and_the_ground():
    time = np.arange(4001) * 1e-4
    series = crest_series(1e-4, 7.0 + 1.5 * time**2, np.full(4001, 2.0))
    assert series.displacement[0] == 0.0
    # Far from its ends, which have no acceleration of their own.
    assert series.acceleration[2000] == pytest.approx(5.0, rel=1e-6)
    assert series.ground == pytest.approx(2.0)


@pytest.mark.parametrize("step", [1e-3, 2e-4])
@pytest.mark.parametrize("frequency", [2.0, 20.0, 40.0, 50.0, 70.0, 120.0])
def test_the_band_is_that_of_a_butterworth_filter_forward_and_backward(step, frequency):
    """1 / (1 + (f/50)^8), but for the tangents by which a filter of steps bends frequencies."""
    time = np.arange(0.0, 2.0, step)
    passed = in_band(np.sin(2.0 * np.pi * frequency * time), step)
    inner = np.abs(time - 1.0) < 0.5
    ratio = np.tan(np.pi * frequency * step) / np.tan(np.pi * 50.0 * step)
    assert np.abs(passed[inner]).max() == pytest.approx(1.0 / (1.0 + ratio**8), rel=0.02)


def test_a_blow_comes_through_as_scipy_filters_it():
    blow = np.zeros(1001)
    blow[500] = 1.0
    reference = sosfiltfilt(butter(4, 50.0, fs=1000.0, output="sos"), blow)
    assert in_band(blow, 1e-3) == pytest.approx(reference, abs=1e-5 * reference.max())


@pytest.mark.parametrize("size", [1, 100, 1846, 1847, 9000])
def test_a_record_goes_through_the_band_in_pieces_as_in_one(size):
    weights = band_weights(1e-3)
    both = np.concatenate([weights[:0:-1], weights])
    shakes = np.random.default_rng(size).normal(size=size)
    held = np.pad(shakes, weights.size - 1, mode="edge")
    assert in_band(shakes, 1e-3) == pytest.approx(np.convolve(held, both, "valid"), abs=1e-13)


@pytest.mark.parametrize("model", [rigid, flexible])
def test_the_peak_is_the_same_for_every_output_step(model):
    """The peak of the fine histories that a filter of scipy leaves, whatever is shown."""
    # Steps that make a millisecond.
    case = plane_case(BASE, [*COARSE, "analysis.silence=0s", "flexible.time_step=0.2 ms"])
    shown = {step: model(case, SHAKES, output_step=step) for step in (0.02, 0.005, 0.001)}
    peaks = [response.crest for response in shown.values()]
    assert len({peak.to_json()["acceleration_g"] for peak in peaks}) == 1
    assert len({peak.to_json()["displacement_m"] for peak in peaks}) == 1
    fine = shown[0.001].histories
    own = np.gradient(np.gradient(fine[DISPLACEMENT], 0.001), 0.001)
    both = sosfiltfilt(butter(4, 50.0, fs=1000.0, output="sos"), own + fine["ground_acceleration_m_s2"])
    # Of moments a millisecond apart the differences blur what is faster than 50 Hz.
    assert peaks[0].acceleration_g == pytest.approx(np.abs(both[50:-50]).max() / 9.80665, rel=0.05)


def test_the_crest_of_a_block_goes_with_its_slip_and_turn():
    case = plane_case(BASE)
    response = rigid(case, SHAKES)
    h, height = response.histories, case.cut.height
    assert h["rotation_rad"].min() < 0.0 < h["slip_m"].max()
    assert h[DISPLACEMENT] == pytest.approx(h["slip_m"] - h["rotation_rad"] * height, abs=1e-12)
    assert response.crest.residual_displacement_m == pytest.approx(response.residual_slip_m, abs=1e-9)
    # While a block slides without turning, its crest has the acceleration of slip and ground.
    inner = np.flatnonzero((h["rotation_rad"] == 0.0) & (np.arange(h["time_s"].size) % 2 == 0))[1:-1]
    smooth = [k for k in inner if len({response.mode[j] for j in (k - 1, k, k + 1)}) == 1]
    both = (h["slip_acceleration_m_s2"] + h["ground_acceleration_m_s2"])[smooth]
    assert len(smooth) > 50
    assert np.median(np.abs(h[ACCELERATION][smooth] - both)) < 0.02


def test_the_crest_of_a_stiff_elastic_dam_that_sticks_shakes_as_the_ground():
    stiff = plane_case(BASE, ["concrete.modulus=2000 GPa", "crack.friction=3", "flexible.evidence=none"])
    # One that begins at once would let the dam swing in its own period, too.
    gentle = GroundMotion.from_points(TIME, 0.6 * np.sin(2.0 * np.pi * TIME) * np.sin(np.pi * TIME / TIME[-1]) ** 2)
    response = flexible(stiff, gentle)
    assert response.crest.amplification == pytest.approx(1.0, abs=0.02)
    assert response.crest.displacement_m < 1e-3


def test_the_peak_of_the_crest_does_not_hang_on_where_a_motion_has_its_points():
    """A pulse by its corners, and with every point between them on the same lines."""
    corners, values = np.array([0.0, 0.2, 0.5, 1.0, 2.0]), np.array([0.0, 6.0, -5.0, 0.0, 0.0])
    case = plane_case(BASE, "crack.friction=3")
    coarse = rigid(case, GroundMotion.from_points(corners, values)).crest.displacement_m
    fine = np.unique(np.concatenate([corners, np.arange(0.0, 2.0, 1e-3)]))
    response = rigid(case, GroundMotion.from_points(fine, np.interp(fine, corners, values)))
    peak = response.crest.displacement_m
    at_corners = np.interp(corners, response.histories["time_s"], response.histories[DISPLACEMENT])
    assert peak > 1.2 * np.abs(at_corners).max()
    assert coarse == pytest.approx(peak, rel=2e-3)
