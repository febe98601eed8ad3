"""One name with its meaning."""

from __future__ import annotations

import re
from dataclasses import dataclass

#: Kinds of names, in the order in which they are listed, by what a list of them is called.
KINDS = {
    "field of a case": "Fields of a case",
    "field of a study": "Fields of a study",
    "key of the JSON": "Keys of the JSON",
    "column of the histories": "Columns of the histories",
    "column of the events": "Columns of the events",
    "column of a study": "Columns of the runs of a study",
    "outcome of a run": "Outcomes of a run",
}


@dataclass(frozen=True)
class Meaning:
    """Meaning of a name.

    Attributes
    ----------
    name
        Path of the field or key, or name of the column; ``[]`` stands for a place in a list, ``*`` for any name.
    kind
        One of :data:`KINDS`.
    meaning
        In a sentence or two.
    holds
        What it holds, with an example or its unit.
    default
        What holds where nothing is said; empty where there is none.
    limits
        What it keeps within; empty where nothing is out of range.
    found_in
        Of a field, which models read it; of a key, which command writes it; of a column, which file has it.
    not_with
        Of a field, what it cannot be combined with, and which models do not support it.
    page
        Where the documentation has more, as ``rigid.md#impact``; empty where it has not.
    parts
        Names of the fields of a block.
    like
        Another block with the same fields; empty where there is none.
    hidden
        Whether lists leave it out unless they show everything: fields of the thesis, and fields of a block that is
        like another.
    """

    name: str
    kind: str
    meaning: str
    holds: str
    default: str = ""
    limits: str = ""
    found_in: str = ""
    not_with: str = ""
    page: str = ""
    parts: tuple[str, ...] = ()
    like: str = ""
    hidden: bool = False

    @property
    def last(self) -> str:
        """The last part of its name."""
        return self.name.rpartition(".")[2].removesuffix("[]")

    @property
    def short(self) -> str:
        """Its first sentence."""
        return re.split(r"(?<=[a-z0-9)`])[.;:] ", self.meaning)[0].rstrip(".")
