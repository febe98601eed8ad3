"""Tables as pandas has them, which nothing else here needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from heeltoe.errors.error import package


def dataframe(columns: Mapping[str, object]) -> Any:
    """Return columns of equal length as a ``pandas.DataFrame``.

    Raises
    ------
    InputError
        Where pandas is not installed.
    """
    with package("to_pandas", "pandas"):
        from pandas import DataFrame
    return DataFrame(dict(columns))


def dataframe_of_rows(rows: Sequence[Mapping[str, object]]) -> Any:
    """Return rows with the same columns as :func:`dataframe` does."""
    return dataframe({name: [row[name] for row in rows] for name in rows[0]})
