"""Exact quantiles of numbers that are walked through again and again, never held: memory does not grow with them.

A number is found from its first bits to its last: each walk counts how many begin with the bits that are known, and by
the next of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers

#: Bits that each walk finds.
_BITS = 13
_SIGN = np.uint64(1) << np.uint64(63)

#: Walks through groups from zero, and the number of each.
Walk = Callable[[], Iterable[tuple[Integers, Floats]]]
Keys = NDArray[np.uint64]


def quantiles(walk: Walk, groups: int, shares: Sequence[float], *, between: bool = True) -> Floats:
    """Return the quantiles of the numbers of each group, the bits that :func:`numpy.quantile` gives.

    Parameters
    ----------
    walk
        Called several times, gives the same numbers each time; infinite ones are allowed where they are not taken
        between, what is not a number is not.
    groups
        How many there are.
    shares
        From 0 to 1.
    between
        Take them on the straight line between the numbers to either side, otherwise the first that so many are not
        above (``"inverted_cdf"``).

    Returns
    -------
    ndarray, shape (groups, shares)
        Not a number for a group without numbers.
    """
    table = _first(walk, groups)
    size = table.sum(axis=1)
    filled, results = np.flatnonzero(size), np.full((groups, len(shares)), np.nan)
    if not filled.size:
        return results
    last = (size[filled] - 1)[:, None]
    if between:
        at = np.asarray(shares) * last
        below = np.floor(at).astype(np.int64)
        above = np.minimum(below + 1, last)
    else:
        at = np.asarray(shares) * size[filled][:, None] - 1.0
        below = above = np.clip(np.ceil(at), 0, None).astype(np.int64)
    ranks = np.stack([below, above])
    values = _values_at(walk, table, np.broadcast_to(filled[None, :, None], ranks.shape).ravel(), ranks.ravel())
    low, high = values.reshape(ranks.shape)
    results[filled] = _line(low, high, at - below) if between else low
    return results


def _line(low: Floats, high: Floats, part: Floats) -> Floats:
    step = high - low
    return np.asarray(np.where(part >= 0.5, high - step * (1.0 - part), low + step * part), dtype=np.float64)


def _keys(values: Floats) -> Keys:
    """Return whole numbers that are in the order of the values."""
    bits = (values + 0.0).view(np.uint64)  # minus zero is zero
    return np.where(bits & _SIGN, ~bits, bits | _SIGN)


def _values(keys: Keys) -> Floats:
    return np.where(keys & _SIGN, keys ^ _SIGN, ~keys).view(np.float64)


def _first(walk: Walk, groups: int) -> Integers:
    counts = np.zeros(groups << _BITS, dtype=np.int64)
    for group, values in walk():
        first = (_keys(values) >> np.uint64(64 - _BITS)).astype(np.int64)
        counts += np.bincount((group << _BITS) | first, minlength=counts.size)
    return counts.reshape(groups, -1)


def _values_at(walk: Walk, table: Integers, group: Integers, rank: Integers) -> Floats:
    """Return the numbers of these ranks, from zero, in these groups; `table` counts their first bits."""
    row, prefix, shift, bits = group, np.zeros(rank.size, dtype=np.uint64), 64 - _BITS, _BITS
    while True:
        upto = np.cumsum(table, axis=1)[row]
        digit = (upto <= rank[:, None]).sum(axis=1)
        before = np.take_along_axis(upto, np.maximum(digit - 1, 0)[:, None], axis=1)[:, 0]
        rank = rank - np.where(digit > 0, before, 0)
        prefix = (prefix << np.uint64(bits)) | digit.astype(np.uint64)
        if not shift:
            return _values(prefix)
        bits = min(_BITS, shift)
        # Several ranks of a group, and several groups, may begin alike: each pair is counted once.
        starts, start = np.unique(prefix, return_inverse=True)
        pairs, row = np.unique(group * starts.size + start, return_inverse=True)
        table = _next(walk, starts, pairs, shift, bits)
        shift -= bits


def _next(walk: Walk, starts: Keys, pairs: Integers, shift: int, bits: int) -> Integers:
    """Count the next bits of the numbers that begin with one of some prefixes, in one of some groups."""
    counts = np.zeros(pairs.size << bits, dtype=np.int64)
    for group, values in walk():
        keys = _keys(values)
        begun = keys >> np.uint64(shift)
        start = np.minimum(np.searchsorted(starts, begun), starts.size - 1)
        alike = np.flatnonzero(starts[start] == begun)
        pair = group[alike] * starts.size + start[alike]
        place = np.minimum(np.searchsorted(pairs, pair), pairs.size - 1)
        chosen = pairs[place] == pair
        following = (keys[alike[chosen]] >> np.uint64(shift - bits)) & np.uint64((1 << bits) - 1)
        counts += np.bincount((place[chosen] << bits) | following.astype(np.int64), minlength=counts.size)
    return counts.reshape(pairs.size, -1)
