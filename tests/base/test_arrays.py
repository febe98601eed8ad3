"""Functions that NumPy has too give its answers to the last bit."""

import math

import numpy as np
import pytest

from heeltoe.base.arrays import among, distinct, median


@pytest.mark.parametrize("size", [1, 2, 7, 1000])
def test_the_median_is_that_of_numpy(size):
    values = np.random.default_rng(size).normal(size=size)
    assert median(values) == np.median(values)


def test_the_median_of_what_is_no_number_is_none():
    assert math.isnan(median(np.array([1.0, np.nan, 2.0])))


@pytest.mark.parametrize("values", [[], [3.0], [2.0, 1.0, 2.0, 2.0, -1.0], [0.0, -0.0, 1e-300, 0.0]])
def test_the_different_numbers_are_those_of_numpy(values):
    assert distinct(np.array(values)).tolist() == np.unique(np.array(values)).tolist()


@pytest.mark.parametrize("others", [[5.0], [3.0, 1.0, 2.0], [2.0, 2.0, -1.0, 0.0]])
def test_the_numbers_among_others_are_those_of_numpy(others):
    values = np.array([-2.0, -1.0, 2.0, 2.0, 2.5, 3.0, 9.0, -0.0])
    assert among(values, np.array(others)).tolist() == np.isin(values, others).tolist()
