"""Fractiles of lists made by hand."""

from __future__ import annotations

import pytest

from heeltoe.result.distribution import distribution_of, fractile, judged_size, share_above

FIVE = [3.0, 1.0, 5.0, 2.0, 4.0]


@pytest.mark.parametrize(
    ("share", "value"), [(0.2, 1.0), (0.21, 2.0), (0.4, 2.0), (0.5, 3.0), (0.8, 4.0), (0.84, 5.0), (1.0, 5.0)]
)
def test_a_fractile_is_the_smallest_value_that_such_a_share_does_not_exceed(share, value):
    assert fractile(FIVE, share) == value
    # So a limit there is met by that share, and one just below is not.
    assert share_above(FIVE, value) <= 1.0 - share + 1e-12
    assert share_above(FIVE, value - 0.5) > 1.0 - share


def test_runs_without_a_result_are_farther_than_all_others():
    lost = [*FIVE[:4], None]
    assert (fractile(lost, 0.8), fractile(lost, 0.81)) == (5.0, None)
    assert share_above(lost, 5.0) == 0.2
    assert judged_size(lost) == 5.0


def test_fractiles_go_the_way_of_the_mean():
    upstream = distribution_of([-value for value in FIVE])
    assert (upstream.fractile_16, upstream.fractile_50, upstream.fractile_84) == (-1.0, -3.0, -5.0)
    both = distribution_of([-1.0, 2.0, 4.0])
    assert (both.fractile_16, both.fractile_50, both.fractile_84) == (-1.0, 2.0, 4.0)
