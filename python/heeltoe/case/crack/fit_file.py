"""The friction of a crack from a file that `heeltoe law fit` has written: `crack.fit`."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from heeltoe.case.crack.crack import FRICTION
from heeltoe.case.fields_file import read_fields
from heeltoe.errors.error import InputError, shown

#: Fields that a crack may take from such a file.
_GIVEN = (*FRICTION, "band")
# Blocks that a case or a study has, and a fit has not.
_OF_OTHERS = {"section": "is a case file", "case": "is a study", "cases": "is a study"}


def with_fit_read(fields: Mapping[str, object], directory: Path | None) -> Mapping[str, object]:
    """Return the fields of a case with the friction and its band in the place of the file that its crack names, if it
    names one; a band of the case goes before that of the file.

    Parameters
    ----------
    fields
        Fields of a case, its cracks as blocks.
    directory
        Where the path of the file starts; None where none is to be read.

    Raises
    ------
    InputError
        Where the file cannot be read, is a case or has no friction of a crack, or where a friction stands beside it.
    """
    crack = fields.get("crack")
    if not isinstance(crack, Mapping) or crack.get("fit") is None:
        return fields
    name = crack["fit"]
    beside = next((field for field in FRICTION if crack.get(field) is not None), None)
    if beside is not None:
        raise InputError("fields-conflict", f"crack.{beside}", other="fit")
    if not isinstance(name, str) or not name:
        raise InputError("wrong-type", "crack.fit", shown(name), expected="the path of a file in quotes")
    if directory is None:
        raise InputError("section-file-unread", "crack.fit", shown(name))
    given = _given(directory / os.path.expanduser(name), shown(name))
    own = {field: value for field, value in crack.items() if field != "fit" and value is not None}
    return {**fields, "crack": {**given, **own}}


def _given(path: Path, name: str) -> dict[str, object]:
    """Return the friction and its band that a file gives, in which nothing else of a case may stand."""
    try:
        read = read_fields(path)
    except InputError as error:
        reason = "is not there" if error.code == "source-missing" else error.problem
        raise InputError("fit-file", "crack.fit", name, reason=reason) from None
    other = next((block for block in _OF_OTHERS if block in read), None)
    if other is not None:
        raise InputError("fit-file", "crack.fit", name, reason=f"{_OF_OTHERS[other]}, not a fit")
    crack = read.get("crack")
    given = {field: crack[field] for field in _GIVEN if field in crack} if isinstance(crack, Mapping) else {}
    if not any(field in given for field in FRICTION):
        raise InputError("fit-file", "crack.fit", name, reason="has no friction of a crack")
    return given
