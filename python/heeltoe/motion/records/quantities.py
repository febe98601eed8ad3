"""What the header of a table says of its columns: their names, their units, and which are no accelerations."""

from __future__ import annotations

import re

# A unit with a letter before it is another one (nm/s2), with a number before it a quantity (a peak, not the unit of
# the data), with an operation behind it a part of one (g/10).
_BEFORE, _AFTER = r"(?<![^\W_])(?<![\d.]\s)", r"\b(?!\s*[/*^×])"
_PER_S2 = r"(?:\s*/\s*s(?:ec)?\s*(?:(?:\^|\*\*)?\s*2|/\s*s(?:ec)?)|\s+s(?:\^|\*\*)?-2)"
_UNITS = (
    ("cm/s^2", rf"{_BEFORE}(?:cm{_PER_S2}|gals?){_AFTER}"),
    ("mm/s^2", rf"{_BEFORE}mm{_PER_S2}{_AFTER}"),
    ("m/s^2", rf"{_BEFORE}m{_PER_S2}{_AFTER}"),
    ("ft/s^2", rf"{_BEFORE}ft{_PER_S2}{_AFTER}"),
    ("in/s^2", rf"{_BEFORE}in(?:ch)?{_PER_S2}{_AFTER}"),
    ("g", rf"\[\s*g\s*\]|\(\s*g\s*\)|(?:\bin\s|units?\s*[:=]\s*|accel\w*\s*,?\s)\s*g{_AFTER}"),
)
_ONE_G = re.compile(r"1\s*g\s*=[^)\]]*", re.IGNORECASE)
_LENGTH = r"(?:k?m|cm|mm|ft|in)"
_QUANTITIES = (
    ("velocity", re.compile(rf"\bvel|[\[(:=]\s*{_LENGTH}\s*/\s*s(?:ec)?\s*(?:[\])]|$)", re.IGNORECASE)),
    ("displacement", re.compile(rf"\bdisp|[\[(:=]\s*{_LENGTH}\s*(?:[\])]|$)", re.IGNORECASE)),
)
_SERIES = re.compile(
    r"\b(velocity|displacement)s?\b\s*(?:$|[\[(:=,;]|time (?:series|history)|series|history|record|data|in\b)",
    re.IGNORECASE,
)
_IN_BRACKETS = re.compile(r"\s*[\[(][^\])]*[\])]")
_TIME = re.compile(r"t(?:ime)?\b|sec(?:onds?)?\b|zeit\b|temps\b|tiempo\b|tempo\b", re.IGNORECASE)
_PARTING = re.compile(r"\s*[,;\t|]\s*|\s{2,}")


def units_in(text: str) -> set[str]:
    """Return the units of acceleration that a text names; what one g is worth is none."""
    bare = _ONE_G.sub("", text.replace("²", "2"))
    return {unit for unit, pattern in _UNITS if re.search(pattern, bare, re.IGNORECASE)}


def unit_of(header: list[str]) -> str | None:
    """Return the unit a header states, or None where it states none or several: nothing is guessed.

    Lines that speak of units go before lines that speak of acceleration.
    """
    for word in ("unit", "acc"):
        units: set[str] = set()
        for line in header:
            if word in line.lower():
                units |= units_in(line)
        if units:
            return units.pop() if len(units) == 1 else None
    return None


def names_of(header: list[str], width: int) -> list[str] | None:
    """Return the names of the columns, which a late line of the header parts as the data are; None where none does."""
    for line in reversed(header):
        for names in (_PARTING.split(line.strip()), line.split()):
            if len(names) == width and all(re.search(r"[^\W\d]", name) for name in names):
                return names
    return None


def is_time(name: str) -> bool:
    """Whether a column is called a time."""
    return _TIME.match(name.strip()) is not None


def direction_in(name: str) -> str:
    """Return the name of a column without its unit."""
    return _IN_BRACKETS.sub("", name).strip()


def quantity_of(name: str) -> str | None:
    """Return "velocity" or "displacement" where a column is called so, or has their unit; else None."""
    if units_in(name):
        return None
    return next((quantity for quantity, pattern in _QUANTITIES if pattern.search(name)), None)


def other_quantity(header: list[str]) -> str | None:
    """Return what the one series of a file is where its header says so, and it is no acceleration."""
    if any("acc" in line.lower() or units_in(line) for line in header):
        return None
    for line in header:
        if match := _SERIES.search(line):
            return match[1].lower()
        if "unit" in line.lower() and (quantity := quantity_of(line)):
            return quantity
    return None
