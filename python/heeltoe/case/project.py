"""The title block of a report: project, author and checker."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import date
from typing import Annotated

from pydantic import BeforeValidator, Field, WithJsonSchema

from heeltoe.case.fields import Fields

# A revision may be a number, and TOML has dates.
Words = Annotated[
    str,
    BeforeValidator(
        lambda value: str(value) if isinstance(value, date | int) and not isinstance(value, bool) else value
    ),
    Field(strict=True),
    WithJsonSchema({"type": ["string", "integer"]}),
]


class Revision(Fields):
    """A line of the table of revisions of a report."""

    revision: Words = ""
    """Its number or letter."""
    date: Words = ""
    """When it was made."""
    change: Words = ""
    """The change and its reason."""
    author: Words = ""
    """Author of the revision."""
    checker: Words = ""
    """Checker of the revision."""
    approver: Words = ""
    """Approver of the revision."""


class Project(Fields):
    """The title block of a report, as free words; no number depends on it."""

    name: Words = ""
    """Name of the project."""
    client: Words = ""
    """For whom it is."""
    author: Words = ""
    """Author of the report."""
    checker: Words = ""
    """Checker of the report; without it the title block has a line to sign on."""
    approver: Words = ""
    """Approver of the report; without it the title block has a line to sign on."""
    date: Words = ""
    """Date of the report."""
    revision: Words = ""
    """Revision of the report."""
    revisions: tuple[Revision, ...] = ()
    """All revisions of the report, for the table on its page one."""

    def rows(self) -> Iterator[tuple[str, str]]:
        """Return label and words of each entry; nothing where none is given."""
        if any(getattr(self, name) for name in _LABELS.values()):
            for label, name in _LABELS.items():
                yield label, getattr(self, name)

    def history(self) -> tuple[tuple[str, ...], ...]:
        """Return the table of revisions, its head first; nothing where none is given. Columns without a word are left
        out."""
        lines = [revision.model_dump() for revision in self.revisions]
        names = [name for name in _COLUMNS if any(line[name] for line in lines)]
        if not names:
            return ()
        return (tuple(_COLUMNS[name] for name in names), *(tuple(line[name] for name in names) for line in lines))


_COLUMNS = {
    "revision": "Revision",
    "date": "Date",
    "change": "Change",
    "author": "Prepared",
    "checker": "Checked",
    "approver": "Approved",
}
_LABELS = {
    "Project": "name",
    "Client": "client",
    "Prepared by": "author",
    "Checked by": "checker",
    "Approved by": "approver",
    "Date": "date",
    "Revision": "revision",
}
