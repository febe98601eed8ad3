"""Tables of the kernels, whose columns have names."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from heeltoe.arrays import Floats


def columns(names: Sequence[str], table: Floats) -> dict[str, Floats]:
    """Return the columns by name; none of a table that was not asked for."""
    return dict(zip(names, np.ascontiguousarray(table.reshape(-1, len(names)).T), strict=True))
