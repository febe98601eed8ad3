"""Tables of Arrow, made of the bytes of their columns: Arrow's own conversion loads pandas, where that is installed, to
see whether a column is one of its, which takes half a second."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Bools

if TYPE_CHECKING:
    import pyarrow as pa


def table(columns: Mapping[str, pa.Array | NDArray[Any] | Sequence[str]]) -> pa.Table:
    """Return a table of columns by their names."""
    import pyarrow as pa

    made = [values if isinstance(values, pa.Array) else column(values) for values in columns.values()]
    return pa.Table.from_arrays(made, names=list(columns))


def column(values: NDArray[Any] | Sequence[str], missing: Bools | None = None) -> pa.Array:
    """Return numbers (n,), null where they are `missing`, or words, as a column."""
    import pyarrow as pa

    if isinstance(values, np.ndarray):
        there = None if missing is None else pa.py_buffer(np.packbits(~missing, bitorder="little"))
        numbers = pa.py_buffer(np.ascontiguousarray(values))
        return pa.Array.from_buffers(pa.from_numpy_dtype(values.dtype), values.size, [there, numbers])
    words = [word.encode() for word in values]
    ends = pa.py_buffer(np.cumsum([0, *map(len, words)], dtype=np.int32))
    return pa.Array.from_buffers(pa.string(), len(words), [None, ends, pa.py_buffer(b"".join(words))])
