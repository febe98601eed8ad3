"""Texts of strangers made harmless: titles, names in records, names of files, which anybody may have written."""

from __future__ import annotations

import unicodedata

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
