"""Columns made of their bytes are those that Arrow makes itself."""

import numpy as np
import pyarrow as pa

from heeltoe.base.table import column, table


def test_columns_are_those_that_arrow_makes():
    numbers, missing = np.array([1.5, np.nan, -0.0]), np.array([False, True, False])
    words = ["rest", "", "glissement à l'aval"]
    columns = {"number": np.arange(6.0)[::-2], "node": np.arange(3, dtype=np.int32), "mode": words}
    made = table({**columns, "gap": column(numbers, missing)})
    made.validate(full=True)
    assert made.equals(pa.table({**columns, "gap": pa.array(numbers, mask=missing)}))
    assert column(numbers, missing).null_count == 1
    assert len(table({"mode": [], "number": np.zeros(0)})) == 0
