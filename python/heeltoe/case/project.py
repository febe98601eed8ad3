"""What stands in the title block of a report: whose project it is, who made the report and who checked it."""

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


class Project(Fields):
    """The title block of a report, as free words; no number depends on it."""

    name: Words = ""
    """What the project is called."""
    client: Words = ""
    """For whom it is."""
    author: Words = ""
    """Who made the report."""
    checker: Words = ""
    """Who checked it; left empty, the title block has a line to sign on."""
    approver: Words = ""
    """Who approved it; left empty, the title block has a line to sign on."""
    date: Words = ""
    """Of the report."""
    revision: Words = ""
    """Of the report."""

    def rows(self) -> Iterator[tuple[str, str]]:
        """Return label and words of each entry; nothing where none is given."""
        if any(self.model_dump().values()):
            for label, name in _LABELS.items():
                yield label, getattr(self, name)


_LABELS = {
    "Project": "name",
    "Client": "client",
    "Prepared by": "author",
    "Checked by": "checker",
    "Approved by": "approver",
    "Date": "date",
    "Revision": "revision",
}
