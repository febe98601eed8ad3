"""Roots between two numbers: closed forms, scipy's own search step by step, and what has none."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from heeltoe.base.root import find_root


@pytest.mark.parametrize(
    ("function", "low", "high", "root"),
    [
        (lambda x: x * x - 2.0, 0.0, 3.0, math.sqrt(2.0)),
        (math.cos, 1.0, 2.0, math.pi / 2.0),
        (lambda x: math.exp(-x) - 0.25, 0.0, 50.0, math.log(4.0)),
        # A jump, as that of a dam which overturns from some depth on.
        (lambda x: 1.0 if x < 0.7 else -1.0, 0.0, 5.0, 0.7),
    ],
)
def test_a_root_of_closed_form(function, low, high, root):
    found, steps = find_root(function, low, high, xtol=1e-12, rtol=1e-14)
    assert found == pytest.approx(root, abs=1e-11)
    assert 1 <= steps <= 100


@given(
    st.lists(st.floats(-10.0, 10.0), min_size=2, max_size=6),
    st.floats(-5.0, 0.0),
    st.floats(0.1, 5.0),
    st.sampled_from([(1e-14, 1e-14), (1e-9, 1e-12), (1e-3, 1e-6)]),
)
def test_the_steps_are_those_of_scipy(coefficients, low, length, tolerance):
    def function(x):
        return float(np.polyval(coefficients, x))

    high, (xtol, rtol) = low + length, tolerance
    if function(low) * function(high) >= 0.0:
        return
    try:
        root, report = brentq(function, low, high, xtol=xtol, rtol=rtol, full_output=True)
    except RuntimeError:
        with pytest.raises(RuntimeError, match="no root"):
            find_root(function, low, high, xtol=xtol, rtol=rtol)
        return
    assert find_root(function, low, high, xtol=xtol, rtol=rtol) == (root, report.iterations)


def test_an_end_that_is_a_root():
    assert find_root(lambda x: x - 1.0, 1.0, 2.0, xtol=1e-9, rtol=1e-9) == (1.0, 0)
    assert find_root(lambda x: x - 2.0, 1.0, 2.0, xtol=1e-9, rtol=1e-9) == (2.0, 0)


def test_no_root_between_the_ends():
    with pytest.raises(ValueError, match="one sign"):
        find_root(lambda x: x * x + 1.0, 0.0, 1.0, xtol=1e-9, rtol=1e-9)


def test_a_search_that_does_not_end():
    with pytest.raises(RuntimeError, match="after 100 steps"):
        find_root(lambda x: 1.0 if x < 0.7 else -1.0, 0.0, 1e300, xtol=0.0, rtol=0.0)
