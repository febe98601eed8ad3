"""What stands in the title block of a report: whose project it is, who made the report and who checked it."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import Field

from heeltoe.case.fields import Fields


class Project(Fields):
    """The title block of a report, as free words; no number depends on it."""

    name: str = Field(default="", strict=True)
    """What the project is called."""
    client: str = Field(default="", strict=True)
    """For whom it is."""
    author: str = Field(default="", strict=True)
    """Who made the report."""
    checker: str = Field(default="", strict=True)
    """Who checked it; left empty, the title block has a line to sign on."""
    date: str = Field(default="", strict=True)
    """Of the report."""
    revision: str = Field(default="", strict=True)
    """Of the report."""

    def rows(self) -> Iterator[tuple[str, str]]:
        """Return label and words of each entry; nothing where none is given."""
        if any(self.model_dump().values()):
            for label, name in _LABELS.items():
                yield label, getattr(self, name)


_LABELS = {
    "Project": "name",
    "Client": "client",
    "Made by": "author",
    "Checked by": "checker",
    "Date": "date",
    "Revision": "revision",
}
