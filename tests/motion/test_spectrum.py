"""Response spectra against closed forms; what peers find and why it differs is in benchmarks/spectra_peers.py."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from heeltoe import GroundMotion, InputError, read_record
from heeltoe.motion.spectrum import response_spectrum


def motion(time, values):
    return GroundMotion.from_points(time, values, name="m")


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.2, 0.7])
@pytest.mark.parametrize("period", [0.05, 0.5, 3.0])
def test_a_constant_acceleration_overshoots(period, damping):
    """u_max = a / w^2 (1 + exp(-zeta pi / sqrt(1 - zeta^2))), half a damped period after the start."""
    spectrum = response_spectrum(motion([0.0, 50.0], [2.0, 2.0]), [period], damping)
    w = 2.0 * np.pi / period
    exact = 2.0 / w**2 * (1.0 + np.exp(-damping * np.pi / np.sqrt(1.0 - damping**2)))
    assert spectrum.displacement[0] == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("period", [0.11, 0.9, 4.0])
def test_a_ramp_without_damping(period):
    """u = -(s / w^2) (t - sin(w t) / w) under the ramp, free vibration after it."""
    w, slope, end = 2.0 * np.pi / period, 1.7, 2.3
    u = slope / w**2 * (end - np.sin(w * end) / w)
    v = slope / w**2 * (1.0 - np.cos(w * end))
    spectrum = response_spectrum(motion([0.0, end], [0.0, slope * end]), [period], 0.0)
    assert spectrum.displacement[0] == pytest.approx(max(u, np.hypot(u, v / w)), rel=1e-9)


@pytest.mark.parametrize("ratio", [0.3, 0.8, 1.7])
def test_a_half_sine_without_damping(ratio):
    """Shock spectrum of a half sine of length d, T = d / ratio.

    In free vibration after the pulse u_max w^2 / A = 2 b / (1 - b^2) cos(pi / (2 b)), b = T / (2 d); for T < 2 d the
    largest value may lie inside the pulse instead, and is found on the closed form of the motion there.
    """
    d = 0.7
    period = d / ratio
    t = np.linspace(0.0, d, 60_001)
    spectrum = response_spectrum(motion(t, np.sin(np.pi * t / d)), [period], 0.0)
    w, p = 2.0 * np.pi / period, np.pi / d
    fine = np.linspace(0.0, d, 4_000_001)
    inside = np.abs((np.sin(p * fine) - p / w * np.sin(w * fine)) / (1.0 - (p / w) ** 2)).max()
    b = p / w
    after = abs(2.0 * b / (1.0 - b**2) * np.cos(np.pi / (2.0 * b)))
    assert spectrum.displacement[0] * w**2 == pytest.approx(max(inside, after), rel=1e-9)


def test_limits():
    time = np.arange(400) * 0.01
    ground = 3.0 * np.sin(np.arange(400) * 0.3) * np.hanning(400)
    m = motion(time, ground)
    spectrum = response_spectrum(m, [0.0, 1e-4, 500.0])
    assert spectrum.pseudo_acceleration[0] == m.pga
    # A stiff oscillator moves with the ground; a soft one stays behind, so that it moves by the ground's displacement.
    assert spectrum.pseudo_acceleration[1] == pytest.approx(m.pga, rel=1e-4)
    assert spectrum.displacement[2] == pytest.approx(m.pgd, rel=0.05)
    # Without damping total and pseudo-acceleration are one.
    bare = response_spectrum(m, [0.1, 1.0], 0.0)
    assert bare.total_acceleration == pytest.approx(bare.pseudo_acceleration, rel=1e-9)


@given(
    st.lists(st.floats(-5.0, 5.0), min_size=3, max_size=25),
    st.floats(0.02, 5.0),
    st.floats(0.0, 0.9),
    st.integers(2, 6),
)
def test_refining_scaling_and_reversing(values, period, damping, parts):
    m = motion(np.arange(len(values)) * 0.05, values)
    if m.pga < 1e-3:
        return
    one = response_spectrum(m, [period], damping)
    for other, factor in ((m.resampled(0.05 / parts), 1.0), (m.reversed(), 1.0), (m.scaled(3.0), 3.0)):
        two = response_spectrum(other, [period], damping)
        assert two.displacement[0] == pytest.approx(factor * one.displacement[0], rel=1e-9, abs=1e-12)
        assert two.total_acceleration[0] == pytest.approx(factor * one.total_acceleration[0], rel=1e-9, abs=1e-9)


def test_jumps_and_unequal_steps():
    jump = motion([0.0, 0.3, 0.3, 1.0], [1.0, 1.0, -2.0, 0.0])
    steep = motion([0.0, 0.3, 0.3 + 1e-9, 1.0], [1.0, 1.0, -2.0, 0.0])
    a, b = response_spectrum(jump), response_spectrum(steep)
    assert a.displacement == pytest.approx(b.displacement, rel=1e-8)


def test_real_records(records):
    for name in ("taft-1952-s69e-caltech", "elcentro-1940-ns-nga2", "pacoima-1971-s16e-nga2"):
        m = read_record(records / f"{name}.txt")
        spectrum = response_spectrum(m)
        fine = response_spectrum(m.resampled(m.dt / 8))
        assert spectrum.displacement == pytest.approx(fine.displacement, rel=1e-8)
        assert spectrum.total_acceleration == pytest.approx(fine.total_acceleration, rel=1e-7)


def test_what_is_out_of_range_is_refused():
    m = motion([0.0, 1.0], [1.0, 1.0])
    with pytest.raises(InputError, match="damping"):
        response_spectrum(m, [1.0], 1.0)
    for periods in ([-1.0], [np.nan], [np.inf]):
        with pytest.raises(InputError, match="periods"):
            response_spectrum(m, periods)
