"""Files of several channels: which there are, and which one is meant."""

from __future__ import annotations

import numpy as np
import pytest
from pydantic import ValidationError

from heeltoe import InputError
from heeltoe.case.motion import Motion
from heeltoe.case.shaking import resolve
from shared.record_samples import GAL, WAVE, G, channels, cosmos, csmip, knet, read

THREE = csmip({" 90 DEG": GAL, "UP": -0.5 * GAL, "  0 DEG": 0.8 * GAL})


def test_all_channels_are_read_for_a_look():
    three = channels(THREE)
    assert [motion.channel for motion in three] == ["1", "2", "3"]
    assert [motion.component for motion in three] == ["90 DEG", "UP", "0 DEG"]
    assert [motion.name for motion in three] == ["a-chan1", "a-chan2", "a-chan3"]
    for motion, factor in zip(three, (1.0, -0.5, 0.8), strict=True):
        assert motion.acceleration == pytest.approx(factor * G * WAVE, abs=6e-6)
        assert motion.warnings == ()
    both = channels(cosmos() + cosmos("velocity") + cosmos(values=0.5 * GAL, number=2, direction="Up"))
    assert [(motion.channel, motion.component) for motion in both] == [("1", "360 deg"), ("2", "Up")]
    assert both[1].acceleration == pytest.approx(0.5 * G * WAVE, abs=6e-8)


def test_velocity_may_follow_without_a_header_of_its_own():
    series = cosmos("velocity").split('"|":\n')[1].split("\n", 2)[2]
    motion = read(cosmos().replace("End-of-data for Chan  1 acceleration\n", "") + series)
    assert motion.time.size == 160
    assert motion.warnings == ()


@pytest.mark.parametrize(
    ("channel", "factor"),
    [
        (1, 1.0),
        ("1", 1.0),
        (" 2 ", -0.5),
        ("up", -0.5),
        ("Up", -0.5),
        (90, 1.0),
        ("90", 1.0),
        ("90deg", 1.0),
        ("090 Degrees", 1.0),
        ("90°", 1.0),
        ("0", 0.8),
        ("000", 0.8),
    ],
)
def test_a_channel_is_chosen_by_number_or_direction(channel, factor):
    assert read(THREE, channel=channel).acceleration == pytest.approx(factor * G * WAVE, abs=6e-6)


def test_without_a_choice_the_channels_are_listed():
    with pytest.raises(InputError) as caught:
        read(THREE, field="motion.vertical")
    peaks = [f"{factor * np.abs(GAL).max():.4g}" for factor in (1.0, 0.5, 0.8)]
    assert str(caught.value) == (
        f"a.V2: has several channels (1: 90 DEG, peak {peaks[0]} cm/s^2; 2: UP, peak {peaks[1]} cm/s^2; "
        f"3: 0 DEG, peak {peaks[2]} cm/s^2); choose one in motion.vertical.channel"
    )


def test_a_choice_that_means_no_channel_or_several_is_refused():
    with pytest.raises(InputError, match=r"motion\.channel: 'N45E' means none of the channels of a\.V2 \(1: 90 DEG"):
        read(THREE, channel="N45E")
    with pytest.raises(InputError, match="'UP' means 2 of the channels"):
        read(csmip({"UP": GAL, "UP ": GAL}), channel="UP")
    with pytest.raises(InputError, match=r"'2' means none of the channels of a\.txt"):
        read("# units: [g]\n0 0.1\n0.01 0.2\n", "a.txt", channel=2)


def test_a_file_of_one_channel_needs_no_choice_and_takes_the_right_one():
    for channel in (None, 1, "n-s"):
        assert read(knet(), channel=channel).channel == ""


def test_channels_without_numbers_are_counted_and_long_lists_are_cut():
    unnumbered = "".join(cosmos(number="?", direction=f"{k} deg") for k in range(40, 54))
    assert [motion.channel for motion in channels(unnumbered)] == [str(k) for k in range(1, 15)]
    assert read(unnumbered, channel="14").component == "53 deg"
    assert read(unnumbered, channel="45").channel == "6"
    with pytest.raises(InputError, match=r"12: 51 deg, peak [\d.]+ cm/s\^2; \.\.\.\)"):
        read(unnumbered)
    twice = cosmos() + cosmos(values=0.5 * GAL)
    assert [motion.channel for motion in channels(twice)] == ["1", "2"]


def test_a_channel_whose_accelerations_are_lost_is_missed():
    first, second, third, rest = THREE.split("POINTS OF ACCEL DATA")
    lost = f"{first}POINTS OF ACCEL DATA{second}POINTS OF DATA{third}POINTS OF ACCEL DATA{rest}"
    assert [motion.channel for motion in channels(lost)] == ["1", "3"]
    assert all("opens 3 channels and has accelerations of 2" in str(motion.warnings[-1]) for motion in channels(lost))


def test_a_case_names_its_channels(tmp_path):
    (tmp_path / "three.V2").write_text(THREE)
    motion = Motion(file="three.V2", channel=" 0 deg", vertical={"file": "three.V2", "channel": 2})
    horizontal, vertical = resolve(motion, G, tmp_path)
    assert (horizontal.name, horizontal.component) == ("three-chan3", "0 DEG")
    assert (vertical.name, vertical.component) == ("three-chan2", "UP")
    assert vertical.acceleration == pytest.approx(-0.5 * G * WAVE, abs=6e-6)
    with pytest.raises(InputError, match=r"choose one in motion\.vertical\.channel"):
        resolve(Motion(file="three.V2", channel=1, vertical={"file": "three.V2"}), G, tmp_path)
    with pytest.raises(InputError, match=r"^motion\.vertical\.channel: '4' means none"):
        resolve(Motion(file="three.V2", channel=1, vertical={"file": "three.V2", "channel": 4}), G, tmp_path)


def test_a_channel_belongs_to_a_file_and_is_a_text_or_a_whole_number():
    with pytest.raises(ValidationError, match="does not belong to a motion given by points"):
        Motion(points=[["0 s", "0 g"], ["1 s", "0.1 g"]], channel=1)
    for value in (True, 1.5, ""):
        with pytest.raises(ValidationError):
            Motion(file="x", channel=value)
    assert Motion(file="x", channel=90).model_dump(mode="json")["channel"] == "90"
