"""Quantiles of numbers that are walked through, never held, are those of NumPy to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe.study.plan import rank_correlation
from heeltoe.study.plan.rank_correlation import quantiles

SHARES = (0.0, 0.05, 0.16, 0.5, 0.84, 0.95, 1.0)


def numbers(kind, random):
    normal = random.standard_normal(5000)
    return {
        "normal": normal,
        "of all sizes": normal * 10.0 ** random.integers(-300, 300, 5000),
        "mostly zero": np.where(random.random(5000) < 0.7, 0.0, normal),
        "zeros of either sign": np.where(random.random(5000) < 0.5, 0.0, -0.0),
        "few": np.rint(normal),
        "close": 1.0 + 1e-15 * random.integers(0, 9, 5000),
        "smallest": 5e-324 * random.integers(-9, 9, 5000),
    }[kind]


KINDS = ("normal", "of all sizes", "mostly zero", "zeros of either sign", "few", "close", "smallest")


@pytest.mark.parametrize("held", [0, 1000, 1 << 22])
@pytest.mark.parametrize("between", [True, False])
@pytest.mark.parametrize("kind", KINDS)
def test_they_are_those_of_numpy(kind, between, held, monkeypatch):
    monkeypatch.setattr(rank_correlation, "_HELD", held)
    random = np.random.default_rng(1)
    values, group = numbers(kind, random), random.integers(0, 4, 5000)
    group[group == 2] = 3
    pieces = np.array_split(np.arange(5000), 11)
    result = quantiles(lambda: ((group[piece], values[piece]) for piece in pieces), 5, SHARES, between=between)
    for place in range(5):
        here = values[group == place]
        if not here.size:
            assert np.isnan(result[place]).all()
            continue
        method = "linear" if between else "inverted_cdf"
        assert result[place].tolist() == np.quantile(here, SHARES, method=method).tolist()


def test_what_is_infinite_is_the_largest():
    walk = [(np.zeros(4, dtype=np.int64), np.array([1.0, np.inf, 2.0, np.inf]))]
    assert quantiles(lambda: walk, 1, (0.16, 0.5, 0.84), between=False).tolist() == [[1.0, 2.0, np.inf]]


def test_one_number_and_none():
    assert quantiles(lambda: [(np.array([1]), np.array([3.5]))], 2, (0.1, 0.9)).tolist()[1] == [3.5, 3.5]
    assert np.isnan(quantiles(list, 2, (0.5,))).all()
