"""Lines of a table of numbers to lines that are parted by blanks, whatever they were parted by before."""

from __future__ import annotations

import re

from heeltoe.errors import InputError
from heeltoe.motion.records.raw import unglued

_SEPARATORS = str.maketrans({",": " ", ";": " ", "\t": " ", '"': None})
_DECIMAL_COMMA = re.compile(r"\d,\d")
_CELL = re.compile(r"\s*[-+]?\d+(?:,\d+)?(?:[eE][-+]?\d+)?\s*")
# 1,250 is 1250 to some, and 1.25 to others; 0,250 is clear, since no thousands begin with a zero.
_THOUSANDS = re.compile(r"\s*[-+]?[1-9]\d{0,2},\d{3}\s*")


def parted(line: str) -> str:
    """Return a line with blanks for its separators, without quotes; a sign right behind a digit parts as well."""
    return unglued(line.translate(_SEPARATORS))


def is_data(line: str) -> bool:
    """Whether a line starts with something that wants to be a number; a NaN does, or it would pass for a header."""
    word = parted(line).split()[:1]
    return bool(word) and re.match(r"[-+]?(?:\.?\d|(?:nan|inf)$)", word[0], re.IGNORECASE) is not None


def with_points(lines: list[str], name: str, first_line: int) -> list[str]:
    """Return lines of data with points for decimal commas, which semicolons or tabs beside them give away.

    Parameters
    ----------
    lines
        Lines of data.
    name
        Of the file, for errors.
    first_line
        Number of the first of them in the file, for errors.

    Raises
    ------
    InputError
        Where a comma may mean one thing or another.
    """
    texts = [line.split("#")[0].replace('"', "") for line in lines]
    if not any(_has_decimal_comma(text) for text in texts):
        return lines
    surely = False
    for number, (line, text) in enumerate(zip(lines, texts, strict=True), first_line):
        cells = [cell for cell in re.split(r"[;\t]", text) if cell.strip()]
        if not all(_CELL.fullmatch(cell) for cell in cells):
            raise InputError("record-comma", name, repr(line.strip()[:30]), line=number)
        surely = surely or any("," in cell and not _THOUSANDS.fullmatch(cell) for cell in cells)
    if not surely:
        raise InputError("record-comma", name, repr(lines[0].strip()[:30]), line=first_line)
    return [text.replace(",", ".") for text in texts]


def _has_decimal_comma(text: str) -> bool:
    text = text.strip()
    return (";" in text or "\t" in text) and _DECIMAL_COMMA.search(text) is not None
