"""Fractiles of runs of which some may have no result."""

from __future__ import annotations

import math
from collections.abc import Sequence

from heeltoe.result.numbers import Distribution

#: The part of the runs that must keep to a limit: one standard deviation above the median of a normal distribution.
JUDGED = 0.84
_LOW, _MIDDLE = 0.16, 0.50
#: Shares that differ by less are the same.
ROUNDING = 1e-9


def fractile(values: Sequence[float | None], share: float) -> float | None:
    """Return the smallest of the values that at least a share of them does not exceed, so that a limit is met by that
    share exactly if it is not below the fractile.

    Parameters
    ----------
    values
        At least one; None counts as larger than all others.
    share
        Above 0, at most 1.

    Returns
    -------
    float or None
        None where more than the rest of the values are None.
    """
    known = sorted(value for value in values if value is not None)
    # Rounding must not ask for one more value than the share is.
    place = math.ceil(share * len(values) - ROUNDING) - 1
    return known[place] if place < len(known) else None


def share_above(values: Sequence[float | None], limit: float) -> float:
    """Return the share of the values above a limit; None counts as above."""
    return sum(value is None or value > limit for value in values) / len(values)


def distribution_of(values: Sequence[float | None]) -> Distribution:
    """Return the distribution of a number, the fractiles in the direction of its mean."""
    way = math.copysign(1.0, sum(value for value in values if value is not None))
    sizes = [None if value is None else way * value for value in values]
    low, middle, high = (
        None if size is None else way * size for size in (fractile(sizes, share) for share in (_LOW, _MIDDLE, JUDGED))
    )
    return Distribution(numbers=list(values), fractile_16=low, fractile_50=middle, fractile_84=high)


def judged_size(sizes: Sequence[float | None]) -> float:
    """Return the size by which limits judge a number: that which 84 % of the runs keep to, or the largest that is known
    where more of them have no result; at least one has."""
    size = fractile(sizes, JUDGED)
    return max(known for known in sizes if known is not None) if size is None else size
