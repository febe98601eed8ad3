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
#: Meaning of the field.
FIT_MEANING = "File that `heeltoe law fit` has written, law-fit.toml: friction and its band, in place of both."
_A_FIT = "law-fit.toml, which `heeltoe law fit TESTS.csv --out FOLDER` writes"


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
        Where the file has no friction, or one stands beside it.
    """
    crack = fields.get("crack")
    if not isinstance(crack, Mapping) or crack.get("fit") is None:
        return fields
    name = crack["fit"]
    beside = next((field for field in FRICTION if crack.get(field) is not None), None)
    if beside is not None:
        raise InputError("fields-conflict", f"crack.{beside}", other="fit")
    if not isinstance(name, str) or not name or directory is None:
        raise InputError("wrong-type", "crack.fit", shown(name), expected="the path of a file in quotes")
    read = read_fields(directory / os.path.expanduser(name), _A_FIT).get("crack")
    given = {field: read[field] for field in _GIVEN if field in read} if isinstance(read, Mapping) else {}
    if not any(field in given for field in FRICTION):
        raise InputError("fit-empty", "crack.fit", shown(name))
    own = {field: value for field, value in crack.items() if field != "fit" and value is not None}
    return {**fields, "crack": {**given, **own}}
