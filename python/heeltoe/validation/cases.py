"""The reference cases by name, with what each declares."""

from __future__ import annotations

from heeltoe.errors import InputError
from heeltoe.validation import of_dams, of_statics
from heeltoe.validation.blocks import of_blocks
from heeltoe.validation.declared import Declared
from heeltoe.validation.row import Row

CASES: dict[str, Declared] = {**of_blocks.CASES, **of_dams.CASES, **of_statics.CASES}


def run_case(name: str) -> list[Row]:
    """Return the rows of one case.

    Raises
    ------
    InputError
        Where there is no case of that name.
    Skipped
        Where a record it needs is not there.
    """
    if name not in CASES:
        raise InputError("no-such-validation", "NAME", name, names=", ".join(CASES))
    return list(CASES[name].rows())
