"""Every user-facing error, declared once with its remedy and rendered in one place.

An :class:`InputError` is what a user did that can be put right by the user. It carries the field (or file) it is
about, the value that was found, and the remedy, and renders as one line:

    reservoir.depth: 120 m is above the crest at 100 m; give a depth between 0 m and 100 m
"""

from __future__ import annotations

# Code -> (what is wrong, what to do). The braces are filled from the context the raiser gives; {value} is always there.
CATALOGUE: dict[str, tuple[str, str]] = {}


class HeeltoeError(Exception):
    """Base of every error that heeltoe raises on purpose."""


class InputError(HeeltoeError):
    """Input that cannot be used, with the field, the value and the remedy.

    Parameters
    ----------
    code
        Key of :data:`CATALOGUE`.
    field
        Where it stands: a path into the case (``crack.friction``) or a file name.
    value
        What was found there, as the user wrote it.
    **context
        Whatever else the texts of the catalogue name.
    """

    def __init__(self, code: str, field: str, value: object = "", **context: object) -> None:
        self.code = code
        self.field = field
        self.value = value
        problem, remedy = CATALOGUE[code]
        context["value"] = value
        self.problem = problem.format(**context)
        self.remedy = remedy.format(**context)
        super().__init__(str(self))

    def __str__(self) -> str:
        return f"{self.field}: {self.problem}; {self.remedy}"
