"""The median is NumPy's to the last bit."""

import math

import numpy as np
import pytest

from heeltoe.base.arrays import median


@pytest.mark.parametrize("size", [1, 2, 7, 1000])
def test_the_median_is_that_of_numpy(size):
    values = np.random.default_rng(size).normal(size=size)
    assert median(values) == np.median(values)


def test_the_median_of_what_is_no_number_is_none():
    assert math.isnan(median(np.array([1.0, np.nan, 2.0])))
