"""State of a session: the case as typed, studies, and files on offer."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from heeltoe.case.model import Case
from heeltoe.errors.error import InputError


@dataclass(eq=False)
class Draft:
    """The fields of a case as they were typed.

    Attributes
    ----------
    fields
        As a case file has them.
    errors
        Errors in them.
    case
        The case in force that goes with them: theirs where they are sound, else the last one that was.
    undo, redo
        Fields as they were.
    step
        Edits of one step are taken back together: all letters of a word, all of a drag.
    """

    fields: dict[str, Any]
    errors: list[InputError] = field(default_factory=list)
    case: Case | None = None
    undo: list[dict[str, object]] = field(default_factory=list)
    redo: list[dict[str, object]] = field(default_factory=list)
    step: object = None


@dataclass(eq=False)
class Made:
    """A study of a tab.

    Attributes
    ----------
    number, title
        For the page.
    folder
        Folder of its file, its case, its records and its runs.
    job
        The number of its run.
    """

    number: int
    title: str
    folder: Path
    job: int


@dataclass(frozen=True)
class Offer:
    """A file that may be fetched once.

    Attributes
    ----------
    path
        Where it is.
    name
        Name that the browser shows.
    """

    path: Path
    name: str
