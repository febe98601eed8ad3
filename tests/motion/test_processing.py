"""Measures and processing, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from heeltoe.case.processing import BandPass, Baseline
from heeltoe.case.read import read_case
from heeltoe.case.shaking import resolve
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import (
    arias_intensity,
    cumulative_absolute_velocity,
    fourier_amplitudes,
    husid_time,
    level_of,
    mean_period,
    measures,
    significant_duration,
    uniform,
    velocity_displacement,
)
from heeltoe.motion.processing import (
    band_pass,
    baseline,
    cut_significant,
    cut_to_window,
    process,
    scale_time,
    scale_to_arias,
    scale_to_spectrum,
    taper,
)
from heeltoe.motion.spectrum import response_spectrum
from shared.dams import PLAIN as DAM

G = 9.81


def points(*pairs):
    return GroundMotion.from_points(*zip(*pairs, strict=True))


def sine(frequency=2.0, duration=20.0, dt=0.01, size=1.0):
    time = dt * np.arange(round(duration / dt) + 1)
    return GroundMotion("sine", time, size * np.sin(2.0 * np.pi * frequency * time))


RAMP = points((0.0, 0.0), (3.0, 3.0))
BOX = points((0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (3.0, 2.0), (3.0, 0.0), (4.0, 0.0))


def test_arias_intensity():
    # The integral of t^2 from 0 to 3 is 9; that of a box of 2 over 2 s is 8.
    assert arias_intensity(RAMP, G) == pytest.approx(np.pi / (2.0 * G) * 9.0, rel=1e-14)
    assert arias_intensity(BOX, G) == pytest.approx(np.pi / (2.0 * G) * 8.0, rel=1e-14)
    # A piece that changes sign: t^2 from -1 to 2.
    assert arias_intensity(points((0.0, -1.0), (3.0, 2.0)), G) == pytest.approx(np.pi / (2.0 * G) * 3.0, rel=1e-14)


def test_significant_duration():
    # t^3 / 27 is a share of p at 3 cbrt(p).
    assert husid_time(RAMP, 0.05) == pytest.approx(3.0 * np.cbrt(0.05), rel=1e-14)
    assert significant_duration(RAMP) == pytest.approx(3.0 * (np.cbrt(0.95) - np.cbrt(0.05)), rel=1e-14)
    assert significant_duration(BOX) == pytest.approx(0.9 * 2.0, rel=1e-14)
    assert husid_time(BOX, 1.0) == pytest.approx(3.0)


def test_cumulative_absolute_velocity():
    assert cumulative_absolute_velocity(RAMP) == pytest.approx(4.5)
    assert cumulative_absolute_velocity(points((0.0, -1.0), (3.0, 2.0))) == pytest.approx(0.5 + 2.0)
    assert cumulative_absolute_velocity(BOX) == pytest.approx(4.0)


def test_fourier_amplitudes_and_mean_period():
    # A sine of amplitude 1 over T whole seconds has a line of T / 2.
    motion = sine(2.0, 20.0)
    frequency, amplitude = fourier_amplitudes(GroundMotion("s", motion.time[:-1], motion.acceleration[:-1]))
    assert frequency[amplitude.argmax()] == pytest.approx(2.0)
    assert amplitude.max() == pytest.approx(10.0, rel=1e-9)
    assert frequency[-1] == pytest.approx(50.0)
    assert mean_period(sine(2.0, 40.0)) == pytest.approx(0.5, rel=0.01)
    # Two sines of one amplitude: the mean of their periods; what is slower than 4 s does not count.
    two = sine(1.0, 80.0)
    both = two.acceleration + sine(4.0, 80.0).acceleration + 5.0 * sine(0.1, 80.0).acceleration
    assert mean_period(GroundMotion("two", two.time, both)) == pytest.approx(0.625, rel=0.02)


def test_uneven_steps_are_refined_exactly():
    uneven = points((0.0, 0.0), (0.02, 1.0), (0.05, -1.0), (0.06, 0.0))
    even = uniform(uneven)
    assert even.dt == pytest.approx(0.01)
    assert arias_intensity(even) == pytest.approx(arias_intensity(uneven), rel=1e-13)
    for motion in (BOX, points((0.0, 0.0), (1.0, 1.0), (1.0 + np.pi * 1e-7, 0.0))):
        with pytest.raises(InputError) as caught:
            uniform(motion)
        assert caught.value.code == "order-uniform"


def test_all_measures():
    result = measures(sine(), G)
    assert all(name.rsplit("_", 1)[1] in ("s", "s2", "m") for name in result)
    assert len(result) == 10
    # No samples, no Fourier transform; no shaking, no duration of it.
    assert set(result) - set(measures(BOX, G)) == {"mean_period_s"}
    still = measures(points((0.0, 0.0), (1.0, 0.0)))
    assert "significant_duration_s" not in still
    assert measures(BOX)["end_velocity_m_s"] == pytest.approx(4.0)
    assert measures(BOX)["end_displacement_m"] == pytest.approx(4.0 + 4.0)


@st.composite
def motions(draw):
    pairs = draw(st.lists(st.tuples(st.floats(0.001, 1.0), st.floats(-10.0, 10.0)), min_size=6, max_size=40))
    return GroundMotion("any", np.cumsum([dt for dt, _ in pairs]), np.array([a for _, a in pairs]))


@given(motions(), st.integers(2, 5), st.booleans())
def test_baseline_ends_at_rest_for_any_steps(motion, order, displacement):
    corrected = baseline(motion, order, displacement=displacement)
    velocity, place = velocity_displacement(corrected)
    size = motion.pgv + motion.duration * motion.pga + 1e-12
    assert abs(velocity[-1]) < 1e-11 * size
    if displacement:
        assert abs(place[-1]) < 1e-11 * size * max(1.0, motion.duration)


def test_baseline_takes_out_a_drift_and_nothing_else():
    clean = sine(2.0, 20.0)
    assert abs(clean.end_velocity) < 1e-12
    share = clean.time / clean.duration
    # Its velocity drifts by t^2 / 2, a polynomial of degree 2; what the sine looks like to it is small.
    drifting = GroundMotion("drift", clean.time, clean.acceleration + 0.05 * share)
    corrected = baseline(drifting, 2)
    assert corrected.acceleration == pytest.approx(clean.acceleration, abs=0.02)
    assert "end velocity zero (was 0.5 m/s)" in corrected.processing[-1]
    # Degree 1 takes the mean acceleration out, so that it can be done by hand.
    assert baseline(RAMP, 1).acceleration == pytest.approx([-1.5, 1.5])


def of_the_record(filtered, motion):
    """What of a filtered motion stands where the record is."""
    first = round(filtered.lead / motion.dt)
    return filtered.acceleration[first : first + motion.time.size]


def test_band_pass():
    slow, middle, fast = (sine(f, 60.0, size=1.0).acceleration for f in (0.05, 2.0, 40.0))
    motion = GroundMotion("three", sine(1.0, 60.0).time, slow + middle + fast)
    inside = slice(1500, -1500)
    passed = band_pass(motion, 0.5, 10.0)
    assert of_the_record(passed, motion)[inside] == pytest.approx(middle[inside], abs=2e-3)
    assert "bandpass 0.5 to 10 Hz" in passed.processing[-1]
    high, low = band_pass(motion, low=0.5), band_pass(motion, high=10.0)
    assert of_the_record(high, motion)[inside] == pytest.approx((middle + fast)[inside], abs=2e-3)
    assert of_the_record(low, motion)[inside] == pytest.approx((slow + middle)[inside], abs=2e-3)
    # Two passes: half at the corner, by |H|^2 of any Butterworth filter.
    corner = band_pass(sine(2.0, 60.0), low=2.0)
    assert np.abs(corner.acceleration[3000:-3000]).max() == pytest.approx(0.5, abs=5e-3)


def test_a_band_pass_keeps_what_the_filter_puts_beside_the_record():
    """A pulse one way, more than the filter lets through: cut off at the ends of the record, the ground runs away."""
    time = 0.01 * np.arange(4001)
    pulse = GroundMotion("pulse", time, np.exp(-(((time - 10.0) / 2.0) ** 2)))
    passed = band_pass(pulse, low=0.1)
    assert abs(passed.end_velocity) < 1e-4 * passed.pgv
    assert abs(velocity_displacement(passed)[1][-1]) < 0.01 * passed.pgd
    # With five times the zeros, all of them kept.
    padded = GroundMotion("padded", 0.01 * np.arange(64001), np.pad(pulse.acceleration, 30000))
    assert passed.pgd == pytest.approx(band_pass(padded, low=0.1).pgd, rel=0.01)
    # Not all of the zeros stay: 60 s on either side of 40 s.
    assert passed.duration < 160.0
    own = GroundMotion("cut off", time, of_the_record(passed, pulse))
    assert own.pgd > 2.0 * passed.pgd


def shaking():
    """A record that starts and ends at rest, of no mean worth a word."""
    time = 0.01 * np.arange(3001)
    wave = np.hanning(3001) * (np.sin(9.0 * time) + 0.4 * np.sin(2.3 * time + 1.0))
    return GroundMotion("shaking", time, wave)


@pytest.mark.parametrize(("level", "trend"), [(9.80665, 0.0), (-0.3, 0.0), (0.0, 0.02), (1.0, -0.05)])
def test_a_band_pass_makes_no_shock_of_the_edges_of_an_offset(level, trend):
    """The record without offset and trend is the right value; padded with zeros, an offset makes it another."""
    clean = shaking()
    lifted = GroundMotion("lifted", clean.time, clean.acceleration + level + trend * (clean.time - 15.0))
    right, passed = band_pass(clean, 0.1, 25.0), band_pass(lifted, 0.1, 25.0)
    assert (passed.pgv, passed.pgd) == pytest.approx((right.pgv, right.pgd), rel=1e-6)
    if level:
        assert f"level of {level:.4g} m/s2" in passed.processing[0]
        edges = GroundMotion("edges", 0.01 * np.arange(27001), np.pad(clean.acceleration + level, 12000))
        assert band_pass(edges, 0.1, 25.0).pgd > 1.1 * right.pgd


def test_a_pulse_to_one_side_is_no_offset():
    """Its mean is a tenth of its peak: taken out, it would leave a box behind."""
    time = 0.01 * np.arange(4001)
    pulse = GroundMotion("pulse", time, np.exp(-(((time - 20.0) / 1.5) ** 2)))
    level, trend = level_of(pulse)
    assert abs(level) < 1e-4 < 1e-2 < pulse.acceleration.mean()
    assert abs(trend) < 1e-9


def test_what_a_filter_leaves_beside_a_record_is_said():
    said = band_pass(shaking(), 0.1, 25.0).processing[0]
    assert "s of zeros on either side, of which" in said
    share = float(said.rsplit("with up to ", 1)[1].split(" ")[0])
    assert 0.0 < share < 0.05


def test_a_record_that_is_cut_off_as_it_shakes_fades_to_its_next_change_of_sign():
    """Cut at its largest value: an edge of 1 m/s2 that ends there is what the filter would make a shock of."""
    time = 0.01 * np.arange(2001)
    begun = GroundMotion("begun", time, np.cos(2.0 * np.pi * time) * np.exp(-0.2 * time))
    passed = band_pass(begun, 0.1)
    first = round(passed.lead / 0.01)
    assert abs(passed.acceleration[first]) < 0.2
    # From a quarter of a period on it is the record.
    assert np.corrcoef(passed.acceleration[first + 25 : first + 500], begun.acceleration[25:500])[0, 1] > 0.97


def test_a_record_with_gravity_in_it_is_recognised(tmp_path):
    clean = shaking()
    for name, level in (("gravity", 1.0), ("offset", 0.02), ("none", 0.0)):
        rows = "\n".join(f"{t:.2f} {0.1 * a + level:.6f}" for t, a in zip(clean.time, clean.acceleration, strict=True))
        (tmp_path / f"{name}.txt").write_text(f"time [s] acceleration [g]\n{rows}\n")

    def resolved(name, *steps):
        case = read_case(DAM | {"motion": {"file": f"{name}.txt", "processing": list(steps)}})
        return resolve(case.motion, case.gravity, tmp_path)[0]

    passing = {"step": "band-pass", "low": "0.1 Hz", "high": "25 Hz"}
    with pytest.raises(InputError, match=r"motion: gravity rests at 1 g: gravity is in it.*band-pass"):
        resolved("gravity")
    through = resolved("gravity", passing)
    assert "motion-gravity" in {notice.name for notice in through.warnings}
    assert through.pgd == pytest.approx(resolved("none", passing).pgd, rel=1e-3)
    notices = {notice.name for notice in resolved("offset", passing).warnings}
    assert "motion-flaw offset" in notices
    assert not {"motion-flaw offset", "motion-gravity"} & {notice.name for notice in resolved("none").warnings}


def test_seconds_before_a_record_keep_its_times_and_its_other_component(tmp_path):
    record = "\n".join(f"{v:.6f}" for v in sine(0.7, 10.0, size=0.2).acceleration)
    for name in ("a", "b"):
        (tmp_path / f"{name}.txt").write_text(f"# units: m/s2\n# dt: 0.01\n{record}\n")
    filtered = {"step": "band-pass", "low": "0.5 Hz"}
    motion = {"file": "a.txt", "processing": [filtered], "duration": "8 s", "vertical": {"file": "b.txt"}}
    case = read_case(DAM | {"motion": motion})
    across, up = resolve(case.motion, case.gravity, tmp_path)
    assert across.lead == up.lead > 3.0
    assert across.duration == up.duration == pytest.approx(8.0 + across.lead)
    assert up.acceleration[0] == 0.0
    assert np.interp(up.lead + 1.0, up.time, up.acceleration) == pytest.approx(0.2 * np.sin(1.4 * np.pi), abs=1e-4)
    # A window says its times by the record too; from its start it keeps the seconds before it.
    passed = band_pass(sine(0.7, 10.0), low=0.5)
    assert cut_to_window(passed, 0.0, 4.0).duration == pytest.approx(4.0 + passed.lead)
    window = cut_to_window(passed, 1.0, 4.0)
    assert (window.duration, window.lead) == (pytest.approx(3.0), 0.0)
    assert window.acceleration[0] == pytest.approx(np.interp(1.0 + passed.lead, passed.time, passed.acceleration))


def test_taper():
    flat = GroundMotion("flat", 0.01 * np.arange(1001), np.ones(1001))
    both = taper(flat, 0.1)
    assert both.acceleration[[0, 50, 100, 500, 900, 950, 1000]] == pytest.approx([0.0, 0.5, 1.0, 1.0, 1.0, 0.5, 0.0])
    assert taper(flat, 0.1, "end").acceleration[[0, 950, 1000]] == pytest.approx([1.0, 0.5, 0.0])
    assert taper(flat, 0.1, "start").acceleration[[0, 50, 1000]] == pytest.approx([0.0, 0.5, 1.0])


def test_cut_to_a_window():
    cut = cut_to_window(RAMP, 1.0, 2.5)
    assert (cut.time[0], cut.duration) == (0.0, 1.5)
    assert cut.acceleration == pytest.approx([1.0, 2.5])
    assert cut.is_cut
    rest = cut_to_window(RAMP, 1.0)
    assert rest.duration == 2.0
    assert not rest.is_cut
    # The value after a jump is that with which the motion begins.
    assert cut_to_window(BOX, 1.0).acceleration[:2] == pytest.approx([2.0, 2.0])


def test_cut_to_the_significant_duration():
    cut = cut_significant(RAMP)
    assert cut.duration == pytest.approx(significant_duration(RAMP), rel=1e-14)
    assert arias_intensity(cut) == pytest.approx(0.9 * arias_intensity(RAMP), rel=1e-13)
    assert cut.acceleration == pytest.approx([3.0 * np.cbrt(0.05), 3.0 * np.cbrt(0.95)])
    assert arias_intensity(cut_significant(BOX, 0.2, 0.7)) == pytest.approx(0.5 * arias_intensity(BOX), rel=1e-13)
    whole = cut_significant(sine(), 0.0, 1.0)
    assert arias_intensity(whole) == pytest.approx(arias_intensity(sine()), rel=1e-12)


def test_scaling():
    assert arias_intensity(scale_to_arias(RAMP, 1.2, G), G) == pytest.approx(1.2, rel=1e-14)
    scaled = scale_to_spectrum(sine(), 0.7, 5.0, 0.02)
    assert response_spectrum(scaled, [0.7], 0.02).pseudo_acceleration == pytest.approx(5.0, rel=1e-12)
    slower = scale_time(sine(2.0), 2.0, allow=True)
    assert mean_period(slower) == pytest.approx(1.0, rel=0.02)
    assert "no earthquake was recorded like that" in str(slower.warnings[-1])


ZERO = points((0.0, 0.0), (1.0, 0.0))


@pytest.mark.parametrize(
    ("do", "code"),
    [
        (lambda: baseline(RAMP, 0), "out-of-range"),
        (lambda: baseline(RAMP, 1, displacement=True), "out-of-range"),
        (lambda: band_pass(sine()), "order-corner-missing"),
        (lambda: band_pass(sine(), 0.0, 10.0), "order-corner"),
        (lambda: band_pass(sine(), 0.1, 50.0), "order-corner"),
        (lambda: band_pass(sine(), 10.0, 0.1), "out-of-range"),
        (lambda: band_pass(sine(), 0.1, 10.0, 0), "out-of-range"),
        (lambda: band_pass(BOX, 0.1), "order-uniform"),
        (lambda: taper(sine(), 0.6), "out-of-range"),
        (lambda: cut_significant(sine(), 0.9, 0.1), "out-of-range"),
        (lambda: cut_significant(ZERO), "order-zero"),
        (lambda: cut_to_window(sine(), 3.0, 2.0), "order-window"),
        (lambda: scale_to_arias(ZERO, 1.0), "order-zero"),
        (lambda: scale_to_arias(RAMP, 0.0), "out-of-range"),
        (lambda: scale_to_spectrum(ZERO, 1.0, 1.0), "order-zero"),
        (lambda: scale_to_spectrum(RAMP, 1.0, -1.0), "out-of-range"),
        (lambda: scale_time(RAMP, 1.1), "order-time"),
        (lambda: scale_time(RAMP, 0.0, allow=True), "out-of-range"),
        (lambda: mean_period(sine(size=0.0)), "order-zero"),
    ],
)
def test_refused(do, code):
    with pytest.raises(InputError) as caught:
        do()
    assert caught.value.code == code


WAVE = [["0 s", "0 g"], ["0.5 s", "0.2 g"], ["1 s", "0.1 g"], ["1.5 s", "-0.1 g"], ["2 s", "0 g"]]


def test_a_case_processes_before_it_scales(tmp_path):
    steps = [
        {"step": "baseline", "order": 1},
        {"step": "band-pass", "low": "0.05 Hz", "high": "900 mHz"},
        {"step": "taper", "share": "10 %"},
        {"step": "cut", "start": 0.01, "end": 0.99},
        {"step": "scale-to-arias", "intensity": "1 m/s"},
        {"step": "scale-to-spectrum", "period": "0.5 s", "acceleration": "0.5 g"},
        {"step": "scale-time", "factor": 1.1, "allow": True},
    ]
    case = read_case(DAM | {"motion": {"points": WAVE, "pga": "0.3 g", "processing": steps}})
    assert case.motion is not None
    motion, _ = resolve(case.motion, case.gravity, tmp_path)
    assert motion.pga == pytest.approx(0.3 * case.gravity, rel=1e-12)
    message = [
        "baseline",
        "bandpass",
        "cosine taper",
        "cut to",
        "an Arias",
        "pseudo-acc",
        "time stretched",
        "to a peak",
    ]
    assert [part in line for part, line in zip(message, motion.processing, strict=True)] == [True] * 8
    # A case written out is a case that can be read.
    again = read_case(case.model_dump(mode="json", exclude_none=True))
    assert again.motion == case.motion


@pytest.mark.parametrize(
    ("step", "said"),
    [
        ({"low": "1 Hz"}, 'motion.processing[1].step: is required but missing; add for example step = "baseline"'),
        ({"step": "bandpass"}, 'motion.processing[1].step: "bandpass" is not a choice; choose "baseline", "band-pass"'),
        ({"step": "band-pass", "lo": "1 Hz"}, 'motion.processing[1].lo: no such field; did you mean "low"?'),
        ({"step": "band-pass", "low": "1 rad/s"}, 'motion.processing[1].low: "1 rad/s" is not a frequency'),
        (
            {"step": "scale-to-arias"},
            'motion.processing[1].intensity: is required but missing; add for example intensity = "0.5 m/s"',
        ),
        ("taper", 'motion.processing[1]: "taper" is of the wrong type; give a block of fields'),
    ],
)
def test_mistakes_in_steps_are_said_with_their_place(step, said):
    with pytest.raises(InputError) as caught:
        read_case(DAM | {"motion": {"points": WAVE, "processing": [{"step": "baseline"}, step]}})
    assert str(caught.value).startswith(said)


def test_steps_that_cannot_be_done_are_said_with_their_place():
    steps = (Baseline(step="baseline"), BandPass(step="band-pass", low="0.1 Hz", high="80 Hz"))
    with pytest.raises(InputError, match=r"^motion.processing\[1\].high: 80 Hz is not between 0 Hz and .* 50 Hz;"):
        process(sine(), steps, field="motion.processing")
    with pytest.raises(InputError, match=r"^processing\[0\]: sine is zero throughout"):
        process(sine(size=0.0), [read_step({"step": "scale-to-arias", "intensity": "1 m/s"})])


def read_step(fields):
    case = read_case(DAM | {"motion": {"points": WAVE, "processing": [fields]}})
    assert case.motion is not None
    return case.motion.processing[0]
