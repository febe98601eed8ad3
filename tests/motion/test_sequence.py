"""Motions one after the other are each what they were, with the ground at rest in between."""

import numpy as np
import pytest

from heeltoe.motion.ground_motion import GroundMotion, integrals
from heeltoe.motion.sequence import joined

A = GroundMotion.from_points([0.0, 0.1, 0.3], [0.0, 2.0, 0.0], name="a")
B = GroundMotion.from_points([0.0, 0.25, 0.5], [1.0, -3.0, 0.5], name="b")
UP = GroundMotion.from_points([0.0, 0.2, 0.6], [0.0, 0.5, 0.0], name="up")


def test_each_motion_is_what_it_was():
    result, up, cross = joined([(A, None, None), (B, None, None), (A, None, None)], [0.3, 0.5, 0.2], [1.0, 0.5])
    assert up is None
    assert cross is None
    assert result.name == "a and 2 aftershocks"
    assert [(part.name, part.begins, part.ends) for part in result.parts] == [
        ("a", 0.0, 0.3),
        ("b", pytest.approx(1.3), pytest.approx(1.8)),
        ("a", pytest.approx(2.3), pytest.approx(2.5)),
    ]
    assert result.duration == result.parts[-1].ends
    inside = np.linspace(0.0, 0.3, 50)
    assert np.interp(inside, result.time, result.acceleration) == pytest.approx(
        np.interp(inside, A.time, A.acceleration)
    )
    # At its jumps b is not zero beside them.
    inside = np.linspace(1e-6, 0.5 - 1e-6, 50)
    there = np.interp(1.3 + inside, result.time, result.acceleration)
    assert there == pytest.approx(np.interp(inside, B.time, B.acceleration), abs=1e-9)
    assert np.interp([0.5, 1.2999, 1.8001, 2.0], result.time, result.acceleration) == pytest.approx([0.0] * 4, abs=1e-9)
    velocity = sum(integrals(item.time, item.acceleration)[0][-1] for item in (A, B, A.cut(0.2)))
    assert integrals(result.time, result.acceleration)[0][-1] == pytest.approx(velocity, rel=1e-12)
    # What the ground moves is that of each earthquake from rest, whatever it leaves.
    assert (result.pgv, result.pgd) == pytest.approx((B.pgv, B.pgd), rel=1e-12)
    assert result.end_velocity == pytest.approx(A.cut(0.2).end_velocity, rel=1e-12)


def test_a_vertical_motion_shakes_with_its_own_horizontal_one():
    across, up, _ = joined([(A, None, None), (B, UP, None)], [0.3, 0.5], [1.0])
    assert up is not None
    assert across.duration == up.duration
    # It is longer than its horizontal one, and ends with it.
    assert np.interp([0.2, 1.2, 1.5, 1.8 - 1e-9], up.time, up.acceleration) == pytest.approx([0.0, 0.0, 0.5, 0.125])
    across, up, _ = joined([(B, UP, None), (A, None, None)], [0.5, 0.3], [1.0])
    assert np.interp([0.2, 0.6, 1.6], up.time, up.acceleration) == pytest.approx([0.5, 0.0, 0.0])
    assert up.duration == across.duration == pytest.approx(1.8)
    assert [part.name for part in up.parts] == ["up"]
    assert (up.pgv, up.pgd) == pytest.approx((UP.cut(0.5).pgv, UP.cut(0.5).pgd))
