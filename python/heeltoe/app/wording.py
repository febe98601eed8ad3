"""Sentences on a result in the words of the page, which names its buttons in place of the command line."""

from __future__ import annotations

from heeltoe.warnings.notice import AS_ELASTIC, Notice

_STATICS = "the list of static checks below"
# The longer before what they begin with.
_MEANT = {
    f"{AS_ELASTIC}, and the dam is elastic": "see the elastic dam beside it",
    AS_ELASTIC: "see the elastic dam beside it",
    "flexible.evidence is none": "run without evidence, for which there is a button",
    "heeltoe statics --slip": _STATICS,
    "heeltoe statics": _STATICS,
}


def meant(notice: Notice, units: str) -> str:
    """Return the sentence of a warning."""
    return in_words_of_the_page(notice.text(units))


def in_words_of_the_page(text: str) -> str:
    """Return a sentence that names buttons, and no commands."""
    for command, button in _MEANT.items():
        text = text.replace(command, button)
    return text
