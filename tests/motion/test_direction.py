"""The two horizontal components rotated into along the stream and across the valley."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import InputError, read_case
from heeltoe.case.shaking import resolve_components
from heeltoe.motion.direction import direction_of, rotated
from heeltoe.motion.ground_motion import GroundMotion
from models.rigid.test_varying import rectangle

G = 9.80665


@pytest.mark.parametrize(
    ("component", "name", "degrees"),
    [
        ("180", "a", 180.0),
        ("90 DEG", "a", 90.0),
        ("ELC-270", "a", 270.0),
        ("164 (S16E)", "a", 164.0),
        ("S16E", "a", 164.0),
        ("N 74 W", "a", -74.0),
        ("S00E (NS)", "a", 180.0),
        ("S69W", "a", 249.0),
        ("N-S", "a", 0.0),
        ("EW", "a", 90.0),
        ("North", "a", 0.0),
        ("90 deg (HNE)", "a", 90.0),
        ("HNE", "a", 90.0),
        ("", "RSN6_IMPVALL-ELC180", 180.0),
        ("", "cpm-090", 90.0),
        ("UP", "a", None),
        ("Channel 2", "a", None),
        ("CHN 1: 90 DEG", "a", 90.0),
        ("HN1", "a", None),
        ("DAY-LN", "a", None),
        ("", "quake-400", None),
        ("", "made-2000", None),
    ],
)
def test_directions_are_those_of_headers_and_names(component, name, degrees):
    motion = replace(GroundMotion.from_points([0.0, 1.0], [0.0, 1.0], name=name), component=component)
    found = direction_of(motion)
    assert found is None if degrees is None else math.degrees(found) == pytest.approx(degrees, abs=1e-12)


@pytest.mark.parametrize("azimuth", [0.0, 30.0, 137.0, 270.0])
@pytest.mark.parametrize("directions", [(0.0, 90.0), (0.0, 270.0), (200.0, 290.0)])
def test_a_ground_that_moves_in_one_direction_is_seen_there(azimuth, directions):
    # The ground accelerates to the azimuth of 50 degrees: each component has its share by the cosine.
    time, values = [0.0, 1.0, 2.0], np.array([0.0, 2.0, -1.0])
    one, other = (
        GroundMotion.from_points(time, values * math.cos(math.radians(50.0 - direction))) for direction in directions
    )
    turns = math.radians(directions[0]), math.radians(directions[1])
    along, across = rotated(one, other, turns, math.radians(azimuth))
    # Left of the stream is a right angle against the clock.
    assert along.acceleration == pytest.approx(values * math.cos(math.radians(50.0 - azimuth)), abs=1e-14)
    assert across.acceleration == pytest.approx(values * math.cos(math.radians(50.0 - azimuth + 90.0)), abs=1e-14)


def test_components_of_unequal_steps_and_lengths_are_joined():
    one = GroundMotion.from_points([0.0, 1.0, 2.0], [0.0, 2.0, 0.0])
    other = GroundMotion.from_points([0.0, 1.5, 3.0], [0.0, 3.0, 0.0])
    along, across = rotated(one, other, (0.0, math.pi / 2.0), math.pi / 4.0)
    assert along.time.tolist() == [0.0, 1.0, 1.5, 2.0, 3.0]
    half = math.sqrt(0.5)
    assert along.acceleration == pytest.approx(half * np.array([0.0, 4.0, 4.0, 2.0, 0.0]), abs=1e-14)
    assert across.acceleration == pytest.approx(half * np.array([0.0, 0.0, -2.0, -2.0, 0.0]), abs=1e-14)


WAVES = np.random.default_rng(5).normal(size=(2, 400)) * np.sin(np.linspace(0.0, np.pi, 400))


def pair(directory, ends=("000", "090"), **about):
    """Write two components and return a slab under them."""
    for end, values in zip(ends, WAVES, strict=True):
        numbers = "\n".join(f"{0.3 * value:.7f}" for value in values)
        head = "".join(f"# {name}: {text}\n" for name, text in about.items())
        (directory / f"quake-{end}.txt").write_text(f"{head}# time step: 0.01 s\n# units: [g]\n{numbers}\n")
    one, other = (str(directory / f"quake-{end}.txt") for end in ends)
    return rectangle(20.0, 1.0, 0.4, motion={"file": one, "cross_valley": {"file": other}})


def motions(directory, case, **changes):
    """Return the motions along and across of a case."""
    read = read_case(case, {f"motion.{name}": value for name, value in changes.items()})
    along, _, across = resolve_components(read.motion, read.gravity, directory)
    assert across is not None
    return along, across


def test_the_stream_has_the_peak_and_the_other_component_goes_with_it(tmp_path):
    case = pair(tmp_path)
    plain = motions(tmp_path, case, azimuth="30 deg")
    scaled = motions(tmp_path, case, azimuth="30 deg", pga="0.5 g")
    assert scaled[0].pga == pytest.approx(0.5 * G, rel=1e-14)
    factor = 0.5 * G / plain[0].pga
    assert scaled[1].acceleration == pytest.approx(factor * plain[1].acceleration, rel=1e-12)
    expected = 0.3 * G * (math.cos(math.radians(30.0)) * WAVES[0] + math.sin(math.radians(30.0)) * WAVES[1])
    assert plain[0].acceleration == pytest.approx(expected, abs=1e-6 * G)
    assert "rotated" in " ".join(plain[0].processing)


def test_a_stream_along_a_component_leaves_it_as_it_is(tmp_path):
    case = pair(tmp_path)
    plain = motions(tmp_path, case)
    same = motions(tmp_path, case, azimuth="0 deg")
    assert np.array_equal(same[0].acceleration, plain[0].acceleration)
    # East is to the right of north.
    assert np.array_equal(same[1].acceleration, -plain[1].acceleration)
    other = motions(tmp_path, case, azimuth="90 deg")
    assert np.array_equal(other[0].acceleration, plain[1].acceleration)


def test_a_step_that_scales_one_component_scales_both(tmp_path):
    case = pair(tmp_path)
    plain = motions(tmp_path, case, azimuth="30 deg")
    steps = [{"step": "scale-to-arias", "intensity": "5 m/s"}]
    scaled = motions(tmp_path, case, azimuth="30 deg", processing=steps)
    factor = scaled[0].pga / plain[0].pga
    assert factor != pytest.approx(1.0, abs=0.1)
    assert scaled[1].acceleration == pytest.approx(factor * plain[1].acceleration, rel=1e-9)


def test_a_stated_direction_wins(tmp_path):
    case = pair(tmp_path)
    named = motions(tmp_path, case, azimuth="30 deg")
    stated = motions(tmp_path, case, azimuth="90 deg", direction="60 deg", **{"cross_valley.direction": "150 deg"})
    assert stated[0].acceleration == pytest.approx(named[0].acceleration, abs=1e-12)


def test_a_share_of_the_peak_along_the_stream(tmp_path):
    case = pair(tmp_path)
    along, across = motions(tmp_path, case, pga="0.4 g", **{"cross_valley.pga": "30 %"})
    assert along.pga == pytest.approx(0.4 * G, rel=1e-14)
    assert across.pga == pytest.approx(0.3 * along.pga, rel=1e-14)
    assert "30 % of the horizontal one" in " ".join(across.processing)
    read = read_case(case, {"motion.cross_valley.pga": "30 %"})
    assert read_case(read.model_dump(mode="json", exclude_unset=True)).motion.cross_valley.pga == 0.3
    for bad in ("-30 %", "0 %", "30"):
        with pytest.raises(InputError) as refused:
            motions(tmp_path, case, **{"cross_valley.pga": bad})
        assert refused.value.field == "motion.cross_valley.pga"
    with pytest.raises(InputError, match='"-30 %" is out of range; give a value above 0 % and up to 1000 %'):
        motions(tmp_path, case, **{"cross_valley.pga": "-30 %"})


def test_what_cannot_be_rotated_is_refused(tmp_path):
    case = pair(tmp_path)
    refusals = [
        ({"azimuth": "30 deg", "cross_valley": "none"}, "needs-other", "motion.azimuth"),
        ({"direction": "30 deg"}, "needs-other", "motion.direction"),
        ({"cross_valley.direction": "30 deg"}, "needs-other", "motion.cross_valley.direction"),
        (
            {"azimuth": "30 deg", "cross_valley.direction": "80 deg"},
            "another-kind",
            "motion.cross_valley.direction",
        ),
        ({"azimuth": "3000 deg"}, "out-of-range", "motion.azimuth"),
    ]
    for changes, code, field in refusals:
        with pytest.raises(InputError) as refused:
            motions(tmp_path, case, **changes)
        assert (refused.value.code, refused.value.field) == (code, field), changes
    unnamed = pair(tmp_path, ("n", "e"))
    with pytest.raises(InputError, match=r"motion\.direction: is required but missing") as refused:
        motions(tmp_path, unnamed, azimuth="30 deg")
    assert 'motion.direction = "180 deg"' in refused.value.remedy
