"""Titles in any script: fonts that have the letters, and what to do where none has them."""

from __future__ import annotations

import textwrap
import unicodedata
from functools import lru_cache

from matplotlib import font_manager

PLAIN = "DejaVu Sans"
"""Comes with matplotlib; Latin, Greek, Cyrillic, Arabic letters and more."""
# Fonts that people have for other scripts, by the beginning of the file's name in lower case.
_FILES = (
    "notosans",
    "sourcehan",
    "wqy",
    "droidsans",
    "arialuni",
    "msyh",
    "msgothic",
    "malgun",
    "nirmala",
    "pingfang",
    "hiragino",
    "applesdgothic",
    "unifont",
    "freesans",
)
_MISSING = "\N{WHITE SQUARE}"
_CUT = "..."


def readable(text: str) -> tuple[str, list[str]]:
    """Return a text that can be drawn without complaint, and the fonts to draw it with.

    Letters that no font here has become squares. Line breaks and other control characters become blanks.
    """
    text = "".join(" " if unicodedata.category(c) in ("Cc", "Cf", "Cs", "Co", "Cn") else c for c in text)
    wanted = {ord(c) for c in text} - _letters(font_manager.findfont(PLAIN))
    families = [PLAIN]
    if wanted:
        for path, family in _other_fonts():
            found = wanted & _letters(path)
            if found:
                families.append(family)
                wanted -= found
            if not wanted:
                break
    return "".join(_MISSING if ord(c) in wanted else c for c in text), families


def wrapped(text: str, width: int, most: int = 2) -> str:
    """Break a text into at most so many lines of so many columns; East Asian letters take two. What is left is cut."""
    lines: list[str] = []
    for word in textwrap.wrap(text, width, break_long_words=False) or [""]:
        while columns(word) > width:
            fits = next(k for k in range(len(word), 0, -1) if columns(word[:k]) <= width)
            lines.append(word[:fits])
            word = word[fits:]
        lines.append(word)
    if len(lines) > most:
        last = lines[most - 1]
        while columns(last + _CUT) > width:
            last = last[:-1]
        lines = [*lines[: most - 1], last.rstrip() + _CUT]
    return "\n".join(lines)


def columns(text: str) -> int:
    """Return how many columns a text takes."""
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in text)


@lru_cache(maxsize=32)
def _letters(path: str) -> frozenset[int]:
    return frozenset(font_manager.get_font(path).get_charmap())


@lru_cache(maxsize=1)
def _other_fonts() -> tuple[tuple[str, str], ...]:
    """Return file and family of the fonts for other scripts that are installed; those that matplotlib has not met yet
    are made known to it."""
    found = []
    for path in sorted(font_manager.findSystemFonts()):
        name = path.replace("\\", "/").rpartition("/")[2].lower()
        if not name.startswith(_FILES) or any(style in name for style in ("bold", "italic", "light", "black", "thin")):
            continue
        try:
            family = font_manager.get_font(path).family_name
        except (OSError, RuntimeError):
            # Not a font that can be read; there are others.
            continue
        if all(entry.fname != path for entry in font_manager.fontManager.ttflist):
            font_manager.fontManager.addfont(path)
        found.append((path, family))
    return tuple(found)
