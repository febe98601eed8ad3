"""Lines of a record: what is looked for in them, and how columns are parted."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from heeltoe.base.pattern import pattern

# Columns that touch, or an exponent of Fortran's.
_GLUED = pattern(r"[\d.][-+dD]")
_WORD, _NO_NUMBER = pattern(r"[^\W\d_]{2}"), pattern(r"[-+]?(?:nan|inf(?:inity)?)", re.IGNORECASE)
# Length of a line; longer ones are data or damage.
_MOST = 40
_SEPARATORS = str.maketrans({",": " ", ";": " ", "\t": " ", '"': None})


def labelled(lines: list[str], lines_looked_at: int) -> dict[str, str]:
    """Return the texts behind the first colon of the first lines, by the text before it in small letters."""
    pairs = (line[:400].partition(":") for line in lines[:lines_looked_at])
    header: dict[str, str] = {}
    for label, colon, value in pairs:
        if colon:
            header.setdefault(plain(label).lower(), value.strip())
    return header


def plain(text: str) -> str:
    """Return a line of a header without the blanks that fill its columns."""
    return " ".join(text.split())


def find_match(pattern: re.Pattern[str], lines: Iterable[str]) -> re.Match[str] | None:
    """Return the match of the first line that begins with a pattern; None where none does."""
    return next((match for line in lines if (match := pattern.match(line))), None)


def find_text(pattern: re.Pattern[str], lines: Iterable[str]) -> str:
    """Return the first group of the first line that begins with a pattern; empty where none does."""
    match = find_match(pattern, lines)
    return match[1] if match else ""


def find_data(lines: list[str], start: int = 0) -> int:
    """Return the index of the first line of numbers from a line on; behind the last one where there is none."""
    return next((k for k in range(start, len(lines)) if is_data(lines[k][:200])), len(lines))


def find_line(lines: list[str], pattern: re.Pattern[str], start: int, stop: int) -> int:
    """Return the index of the first line between two that begins with a pattern; the second one where none does."""
    return next((k for k in range(start, stop) if pattern.match(lines[k][:200])), stop)


def split_at(lines: list[str], starts: list[int]) -> Iterator[tuple[int, int]]:
    """Walk the first and the last index of each part of a file that holds several, one behind the other."""
    return zip(starts, [*starts[1:], len(lines)], strict=True)


def parted(line: str) -> str:
    """Return a line with blanks for its separators, without quotes; a sign right behind a digit parts as well."""
    return unglued(line.translate(_SEPARATORS))


def parted_all(lines: list[str]) -> list[str]:
    """Return lines as :func:`parted` does; those of most files are parted together."""
    together = "\n".join(lines).translate(_SEPARATORS)
    if _GLUED.search(together) is None and together.count("\n") == len(lines) - 1:
        return together.split("\n")
    return list(map(parted, lines))


def is_data(line: str) -> bool:
    """Whether a line starts with something that wants to be a number; a NaN does, or it would pass for a header."""
    word = parted(line).split()[:1]
    return bool(word) and re.match(r"[-+]?(?:\.?\d|(?:nan|inf)$)", word[0], re.IGNORECASE) is not None


def is_row(line: str) -> bool:
    """Whether a line starts as data do, and has no word of letters; a sentence may begin with a number."""
    words = parted(line).split()
    return is_data(line) and not any(_WORD.search(word) and not _NO_NUMBER.fullmatch(word) for word in words[:_MOST])


def unglued(line: str) -> str:
    """Part columns that touch (8F10.5, E15.7: a sign right behind a digit) and turn Fortran's D exponents into E."""
    if _GLUED.search(line) is None:
        return line
    return re.sub(r"(?<=[\d.])(?=[-+])", " ", re.sub(r"(?<=[\d.])[dD](?=[-+]?\d)", "e", line))
