"""The blocks of many dams in one step, from columns of numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.case.columns import Columns, Rows, by_columns
from heeltoe.case.model import Case
from heeltoe.kernel.block import BLOCK
from heeltoe.mechanics.block import build_block


def block_columns(case: Case, columns: Columns) -> Floats:
    """Return the numbers of the blocks of many dams, as the kernels take them.

    A row equals ``build_block(case.with_(...)).parameters()`` to rounding. It is all there is of a block unless
    something changes as it moves (:func:`heeltoe.models.rigid.varying.varies`, which no column changes); that needs
    single cases. About 10 bytes a row and column are taken for a while: make a million rows in pieces of some ten
    thousand.

    Parameters
    ----------
    case
        What all rows have in common.
    columns
        Of the fields :data:`heeltoe.case.columns.COLUMNS`, (n,) each: SI numbers, or words in ``uplift.pattern``.

    Returns
    -------
    ndarray
        (n, 21) in the order of :data:`heeltoe.kernel.block.BLOCK`; one row where there are no columns.

    Raises
    ------
    InputError
        As of a single case, for the first row that is none; where a field can be no column, or columns differ in
        length.
    """
    return _numbers(by_columns(case, columns))


def sound_blocks(case: Case, columns: Columns) -> tuple[Floats, NDArray[np.bool_]]:
    """Return what :func:`block_columns` does, with NaN in the rows that are no cases, and which rows are (n,)."""
    rows = by_columns(case, columns, every=True)
    return _numbers(rows), rows.sound


def sound_vectors(case: Case, columns: Columns, vector: Callable[[Case], Iterable[Any]]) -> Floats:
    """Return a vector (3,) of each dam, (n, 3), that is (3, n) of a case of columns; NaN in the rows that are no
    cases."""
    return _table(by_columns(case, columns, every=True), vector, 3)


def _numbers(rows: Rows) -> Floats:
    return _table(rows, lambda many: build_block(many).numbers(), len(BLOCK))


def _table(rows: Rows, numbers: Callable[[Case], Iterable[Any]], count: int) -> Floats:
    table = np.full((rows.sound.size, count), np.nan)
    for here, many in rows.parts:
        for place, value in enumerate(numbers(many)):
            table[here, place] = value
    return table


def crack_widths(blocks: Floats) -> Floats:
    """Return the widths (n,) of the cracks [m] of blocks (n, 21)."""
    widths: Floats = blocks[:, BLOCK.index("heel_distance")] + blocks[:, BLOCK.index("toe_distance")]
    return widths
