"""Titles in any script: fonts that have the letters, and what to do where none has them."""

from __future__ import annotations

import re
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
# Between words, of which an acceleration is one: "0.4 g".
_BLANK = re.compile(r"(?<!\d)\s+|\s+(?!g\b)")


def readable(text: str) -> tuple[str, list[str]]:
    """Return a text that can be drawn without complaint, and the fonts to draw it with.

    Letters that no font here has become squares. Line breaks and other control characters become blanks.
    """
    text = "".join(" " if unicodedata.category(c) in ("Cc", "Cf", "Cs", "Co", "Cn") else c for c in text)
    wanted = {ord(c) for c in text} - _letters(font_manager.findfont(PLAIN))
    families = [PLAIN]
    if wanted:
        for path, family in _other_fonts():
            covered = wanted & _letters(path)
            if covered:
                families.append(family)
                wanted -= covered
            if not wanted:
                break
    return "".join(_MISSING if ord(c) in wanted else c for c in text), families


def wrapped(text: str, width: float, most: int = 2) -> str:
    """Break a text into a number of lines at most, as wide as `width` times the size of its letters; the rest is
    cut."""
    lines = [""]
    for word in _BLANK.split(text):
        joined = f"{lines[-1]} {word}".strip()
        if ems(joined) <= width:
            lines[-1] = joined
            continue
        if lines[-1]:
            lines.append("")
        # A word of more than a line, as languages without blanks have it.
        for letter in word:
            if ems(lines[-1] + letter) > width:
                lines.append("")
            lines[-1] += letter
    if len(lines) > most:
        last = lines[most - 1]
        while ems(last + _CUT) > width:
            last = last[:-1]
        lines = [*lines[: most - 1], last.rstrip() + _CUT]
    return "\n".join(lines)


def ems(text: str) -> float:
    """Return how wide a text is, in sizes of its letters; of those that the plain font lacks each takes a whole one."""
    return sum(_width(letter) for letter in text)


@lru_cache(maxsize=4096)
def _width(letter: str) -> float:
    path = font_manager.findfont(PLAIN)
    if ord(letter) not in _letters(path):
        return 1.0
    font = font_manager.get_font(path)
    font.set_size(100.0, 72.0)
    # In units of 1/65536 of a pixel.
    return float(font.load_char(ord(letter)).linearHoriAdvance) / 65536.0 / 100.0


@lru_cache(maxsize=32)
def _letters(path: str) -> frozenset[int]:
    return frozenset(font_manager.get_font(path).get_charmap())


@lru_cache(maxsize=1)
def _other_fonts() -> tuple[tuple[str, str], ...]:
    """Return file and family of the fonts for other scripts that are installed; those that matplotlib has not met yet
    are made known to it."""
    fonts = []
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
        fonts.append((path, family))
    return tuple(fonts)
