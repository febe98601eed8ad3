"""Exact quantiles of numbers that are walked through again and again, never held: memory does not grow with them.

A number is found from its first bits to its last: each walk counts how many begin with the bits that are known, and by
the next of them. Once few enough numbers begin so, the last walk holds these.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers

#: Bits that each walk finds, and the first one where there are few groups.
_BITS, _FIRST, _FEW = 13, 17, 32
#: Numbers that are held together at most.
_HELD = 1 << 22
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
    table, zeros = _first(walk, groups, _FIRST if groups <= _FEW else _BITS)
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
    group, rank = np.broadcast_to(filled[None, :, None], ranks.shape).ravel(), ranks.ravel()
    # Most numbers may be zero: of those that begin like it, it is the least.
    before = table[:, : table.shape[1] // 2].sum(axis=1)
    other = (rank < before[group]) | (rank >= (before + zeros)[group])
    values = np.zeros(rank.size)
    if other.any():
        values[other] = _values_at(walk, table, group[other], rank[other])
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


def _first(walk: Walk, groups: int, bits: int) -> tuple[Integers, Integers]:
    """Count the numbers of each group by their first bits, and those that are zero."""
    counts, zeros = np.zeros(groups << bits, dtype=np.int64), np.zeros(groups, dtype=np.int64)
    for group, values in walk():
        if not group.size:
            continue
        least, most = int(group.min()), int(group.max()) + 1
        first = (_keys(values) >> np.uint64(64 - bits)).astype(np.int64)
        cells = slice(least << bits, most << bits)
        counts[cells] += np.bincount(((group - least) << bits) | first, minlength=(most - least) << bits)
        zeros += np.bincount(group[values == 0.0], minlength=groups)
    return counts.reshape(groups, -1), zeros


def _values_at(walk: Walk, table: Integers, group: Integers, rank: Integers) -> Floats:
    """Return the numbers of these ranks, from zero, in these groups; `table` counts their first bits."""
    bits = table.shape[1].bit_length() - 1
    row, prefix, shift = group, np.zeros(rank.size, dtype=np.uint64), 64 - bits
    while True:
        upto = np.cumsum(table, axis=1)
        digit = np.array([np.searchsorted(upto[k], below, side="right") for k, below in zip(row, rank, strict=True)])
        rank = rank - np.where(digit > 0, upto[row, np.maximum(digit - 1, 0)], 0)
        prefix = (prefix << np.uint64(bits)) | digit.astype(np.uint64)
        if not shift:
            return _values(prefix)
        # Several ranks of a group, and several groups, may begin alike: each pair is counted once.
        starts, start = np.unique(prefix, return_inverse=True)
        pairs, one, pair = np.unique(group * starts.size + start, return_index=True, return_inverse=True)
        begun = _Begun(walk, starts, pairs, shift)
        if table[row[one], digit[one]].sum() <= _HELD:
            return _values(begun.ranked(pair, rank))
        row, bits = pair, min(_BITS, shift)
        table = begun.counted(bits)
        shift -= bits


@dataclass(frozen=True)
class _Begun:
    """The numbers that begin, but for `shift` last bits, with one of some prefixes `starts`, in one of some groups; the
    `pairs` of both are counted group by group."""

    walk: Walk
    starts: Keys
    pairs: Integers
    shift: int

    def __iter__(self) -> Iterator[tuple[Integers, Keys]]:
        """Walk through the places of their pairs and the numbers."""
        for group, values in self.walk():
            keys = _keys(values)
            begun = keys >> np.uint64(self.shift)
            start = np.minimum(np.searchsorted(self.starts, begun), self.starts.size - 1)
            alike = np.flatnonzero(self.starts[start] == begun)
            pair = group[alike] * self.starts.size + start[alike]
            place = np.minimum(np.searchsorted(self.pairs, pair), self.pairs.size - 1)
            chosen = self.pairs[place] == pair
            yield place[chosen], keys[alike[chosen]]

    def counted(self, bits: int) -> Integers:
        """Count them by the next bits."""
        counts = np.zeros(self.pairs.size << bits, dtype=np.int64)
        for place, keys in self:
            following = (keys >> np.uint64(self.shift - bits)) & np.uint64((1 << bits) - 1)
            counts += np.bincount((place << bits) | following.astype(np.int64), minlength=counts.size)
        return counts.reshape(self.pairs.size, -1)

    def ranked(self, pair: Integers, rank: Integers) -> Keys:
        """Return those of some ranks among their pairs."""
        places, keys = (np.concatenate(parts) for parts in zip(*self, strict=True))
        ends = np.cumsum(np.bincount(places, minlength=self.pairs.size))
        keys = keys[np.argsort(places, kind="stable")]
        for place, part in enumerate(np.split(keys, ends[:-1])):
            part.partition(np.unique(rank[pair == place]))
        return np.asarray(keys[ends[pair] - np.bincount(places, minlength=self.pairs.size)[pair] + rank])
