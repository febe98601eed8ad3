"""Texts of strangers: titles, names in records and of files, made harmless; names of ours that were nearly hit."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable

LONGEST = 200
"""More letters than this say nothing more."""
# What letters of some scripts need between them.
_JOINERS = "\u200c\u200d"


def plain(text: object, longest: int = LONGEST) -> str:
    """Return a text in one line that moves no cursor, turns no writing round and ends where it is too long.

    Controls (escape codes, NUL) and halves of letters become ``\\x1b`` and the like; what formats invisibly, as U+202E
    does, and line breaks go. JSON keeps texts as they are.
    """
    words = harmless(" ".join(str(text).split()))
    return words if len(words) <= longest else f"{words[: longest - 3]}..."


def harmless(text: str) -> str:
    """Return a text as :func:`plain` does, at any length and with its line breaks."""
    return text if text.isprintable() else "".join(map(_letter, text))


def _letter(letter: str) -> str:
    if letter in "\n\t":
        return letter
    kind = unicodedata.category(letter)
    if kind in ("Cc", "Cs"):
        return letter.encode("unicode_escape").decode("ascii")
    if kind in ("Zl", "Zp"):
        return " "
    return "" if kind == "Cf" and letter not in _JOINERS else letter


def near(name: str, known: Iterable[str]) -> str:
    """Return ``, did you mean "..."?`` for a name that is not known, or nothing where none that is known is near."""
    # Not at the top: what imports the package need not wait for it.
    from difflib import get_close_matches

    names = list(known)
    matches = (
        get_close_matches(name, names, n=1)
        or [candidate for candidate in names if name and candidate.startswith(f"{name}_")][:1]
    )
    return f', did you mean "{matches[0]}"?' if matches else ""
