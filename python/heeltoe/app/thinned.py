"""Histories with no more moments than a screen can show."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from heeltoe.arrays import Floats


def thinned(rows: Sequence[Floats], bins: int) -> NDArray[np.int64]:
    """Return which moments of some histories to draw, so that no peak of any of them is lost.

    Parameters
    ----------
    rows
        Of equal length, on the same moments.
    bins
        Into how many stretches the moments are divided: of each the first is kept, and where every row is largest and
        least; the last of all, too.
    """
    count = len(rows[0])
    width = -(-count // bins)
    if width <= 2:
        return np.arange(count)
    whole = count - count % width
    starts = np.arange(0, count, width)
    found = [starts, np.array([count - 1])]
    for row in rows:
        table = row[:whole].reshape(-1, width)
        found += [starts[: len(table)] + table.argmax(axis=1), starts[: len(table)] + table.argmin(axis=1)]
        if whole < count:
            found.append(whole + np.array([row[whole:].argmax(), row[whole:].argmin()]))
    return np.unique(np.concatenate(found))
