"""Columns of a table by its header: their names, their units, and which are no accelerations."""

from __future__ import annotations

import re

from heeltoe.base.pattern import pattern
from heeltoe.motion.records.words import (
    ACCELERATION,
    DISPLACEMENT,
    INDEX,
    OTHER_AXES,
    PEAK,
    SPECTRAL,
    TIME,
    TIME_IN_WORDS,
    UNIT,
    VELOCITY,
    WAY,
    folded,
)

# A unit with a letter before it is another one (nm/s2), with a number before it a quantity (a peak, not the unit of
# the data), with an operation behind it a part of one (g/10).
_BEFORE, _AFTER = r"(?<![^\W_])(?<![\d.]\s)", r"(?![^\W_])(?!\s*[/*^×])"
# Seconds are sn in Turkish, seg in Spanish and Portuguese, с or сек in Russian.
_S = r"\(?\s*(?:s(?:ec|eg|n|ek)?|сек|с)"
_SQUARE = r"(?:\s*(?:\^|\*\*)?\s*\{?\(?\s*2\)?\}?|\s*/\s*(?:s(?:ec|eg|n|ek)?|сек|с))\s*\)?"
_PER_S2 = rf"(?:\s*/\s*{_S}{_SQUARE}|[\s.*]+s(?:ec)?\s*(?:\^|\*\*)?\{{?-2\}}?)"
_IN_G = r"(?:\b(?:in|en|em|σε|в)\s+|(?:" + UNIT + r")\s*(?:of|de|di)?\s*[:=]?\s*|accel\w*\s*,?\s|ivme\w*\s*,?\s)\s*"
_SQUARED = r"\s*(?:per|/)\s*(?:sec(?:ond)?s?|s)\s*(?:squared|(?:per|/)\s*(?:sec(?:ond)?s?|s)\b|2)"
_UNITS = (
    ("cm/s^2", rf"{_BEFORE}(?:(?:cms?|см){_PER_S2}|gals?|ガル|伽|centimet(?:er|re)s?{_SQUARED}){_AFTER}"),
    ("mm/s^2", rf"{_BEFORE}(?:(?:mms?|мм){_PER_S2}|millimet(?:er|re)s?{_SQUARED}){_AFTER}"),
    ("m/s^2", rf"{_BEFORE}(?:(?:m|м){_PER_S2}|met(?:er|re)s?{_SQUARED}){_AFTER}"),
    ("ft/s^2", rf"{_BEFORE}(?:ft{_PER_S2}|f(?:oo|ee)t{_SQUARED}){_AFTER}"),
    ("in/s^2", rf"{_BEFORE}in(?:ch)?{_PER_S2}{_AFTER}"),
    ("%g", rf"[\[(]\s*%\s*g\s*[\])]|{_IN_G}%\s*g{_AFTER}|[\[(]\s*(?:percent|prozent)\s+g\s*[\])]"),
    ("mg", rf"[\[(]\s*(?:mg|milli-?g)\s*[\])]|{_IN_G}(?:mg|milli-?g){_AFTER}"),
    ("g", rf"[\[(]\s*g(?:'?s)?\s*[\])]|{_IN_G}[\[(]?\s*'?g'?{_AFTER}"),
)
_PATTERNS = tuple((unit, pattern(text)) for unit, text in _UNITS)
_ONE_G = pattern(r"1\s*g\s*=[^)\]]*")
_LENGTH = r"(?:k?m|cm|mm|ft|in)"
_VELOCITY = pattern(rf"{VELOCITY}|[\[(:=]\s*{_LENGTH}\s*/\s*s(?:ec|eg|n)?\s*(?:[\])]|$)")
_DISPLACEMENT = pattern(rf"{DISPLACEMENT}|[\[(:=]\s*{_LENGTH}\s*(?:[\])]|$)")
_CUMULATIVE = pattern(r"\barias|\bhusid|\bcumulati|\bkumulier|\bcumul[eéa]")
_QUANTITIES = (("velocity", _VELOCITY), ("displacement", _DISPLACEMENT), ("cumulative", _CUMULATIVE))
_SERIES = pattern(
    r"\b(velocity|displacement)s?\b\s*(?:$|[\[(:=,;]|time (?:series|history)|series|history|record|data|in\b)"
)
_IN_BRACKETS = pattern(r"\s*[\[(][^\])]*[\])]")
_BRACKETED = pattern(r"[^\s\[(]+(?:\s*[\[(][^\])]*[\])])?")
_TIME_IN_WORDS = pattern(TIME_IN_WORDS)
_TIME, _ACCELERATION, _PEAK, _UNIT = (pattern(word) for word in (TIME, ACCELERATION, PEAK, UNIT))
_INDEX, _OTHER_AXIS, _SPECTRAL = pattern(INDEX), pattern(OTHER_AXES), pattern(SPECTRAL)
# Names of spectra; in small letters alone they may be directions (SE, SD).
_SHORT_SPECTRAL = pattern(r"\s*(?:P?SA|S[aedv]|PSa|PSV|RSA|Se)(?=$|[\s\[(_,])(?!\w)")
_RATES = pattern(r"[^\W_]*\s*[\[(]\s*(?:hz|1/s|rad/s|1/yr|1/a|km)\s*[\])]")
_RUNS_OVER = pattern(rf"(?:{OTHER_AXES})\s*[\[(]\s*(?:s|secs?|seconds?|ms|hz|km|g|sn|с|сек|秒)\s*[\])]")
# No names of columns.
_SENTENCE = pattern(r"(?:or|and|in|of|at|und|oder|et|ou|y|o|e|ve|veya|и|или|και|the|a\b(?=\s))")
_PARTING = (pattern(r"\s*[;\t|]\s*"), pattern(r"\s*,\s*"), pattern(r"\s*[,;\t|]\s*|\s{2,}"))
# A number by itself makes a sentence of a name; 5 % of damping does not.
_NUMBERED = pattern(r"(?<![\w.])\d+(?:[.,]\d+)?(?![\w%])(?!\s*%)")
# A value with its unit, not the unit of the data.
_VALUED = pattern(r"[\[(][^\])]*[\])]\s*[:=]?\s*[-+]?\d")
_LABEL = pattern(r"\s*(?:columns?|fields|spalten|colonnes|columnas|colonne|colunas|sutunlar)\s*[:=]\s*")
# Signs that are no word of a name.
_LONGEST_NAME, _LAST_LINES = 4, 6


def units_in(text: str) -> set[str]:
    """Return the units of acceleration that a text names; what one g is worth is none."""
    bare = _ONE_G.sub("", folded(text))
    return {unit for unit, named in _PATTERNS if named.search(bare)}


def units_of(header: list[str]) -> set[str]:
    """Return the units a header names for its values.

    Lines that speak of units go before lines that speak of acceleration, and those before any brackets; a value with
    its unit beside it, such as a peak, says nothing of the rest.
    """
    lines = [folded(line) for line in header]
    for is_meant in (_UNIT.search, _ACCELERATION.search, lambda line: True):
        units: set[str] = set()
        for line in lines:
            if is_meant(line) and not _VALUED.search(line) and not _PEAK.match(line.strip()):
                units |= units_in(line)
        if units:
            return units
    return set()


def unit_of(header: list[str]) -> str | None:
    """Return the unit a header states, or None where it states none or several: nothing is guessed."""
    units = units_of(header)
    return units.pop() if len(units) == 1 else None


def names_of(header: list[str], width: int) -> list[str] | None:
    """Return the names of the columns, which a late line of the header has; None where none does.

    A sentence of as many words is none: a name is a time or the number of a row in front, and behind it an
    acceleration, a direction, another quantity, or a word with a unit in brackets.
    """
    for line in reversed(header):
        if not line.strip():
            continue
        for names, parted in _splits(line):
            if len(names) == width and _are_names(names, parted):
                return names
    return None


def _splits(line: str) -> list[tuple[list[str], bool]]:
    """The words of a line, parted in all ways that data are, and whether it is more than single blanks that do so."""
    text = _LABEL.sub("", line.strip(), count=1)
    quoted = re.findall(r'"([^"]*)"', line)
    splits = [(quoted, True)] if len(quoted) > 1 else []
    text = text.replace('"', "")
    splits += [([name.strip() for name in parting.split(text) if name.strip()], True) for parting in _PARTING]
    for names in (_BRACKETED.findall(text), text.split()):
        if [name for name, _ in splits if name == names] == []:
            splits.append((names, False))
    return splits


def _are_names(names: list[str], parted: bool) -> bool:
    if any(name[:1] in "[(" for name in names):
        return False
    if any(len(name.split()) > _LONGEST_NAME + name.count("[") + name.count("(") or len(name) > 60 for name in names):
        return False
    if any(re.search(r"[:=]", _IN_BRACKETS.sub("", name)) for name in names):
        return False
    rest = names[1:] if len(names) > 1 and _is_index(names[0]) else names
    if any(_SENTENCE.fullmatch(folded(direction_in(name))) for name in rest):
        return False
    timed = is_time(rest[0])
    behind = rest[1:] if timed and len(rest) > 1 else rest
    if any(is_time(name) and not units_in(name) for name in behind if len(rest) > 1):
        return False
    known = [_is_column(name) for name in behind]
    # Where a time stands in front and more than blanks parts the names, they may be any.
    return all(known) or (parted and (timed or len(rest) == 1) and not _is_prose(behind))


def _is_index(name: str) -> bool:
    return _INDEX.fullmatch(folded(name).strip()) is not None


def _is_column(name: str) -> bool:
    """Whether a name may be that of a column of numbers beside a time."""
    bare = folded(direction_in(name))
    return bool(
        units_in(name)
        or WAY.fullmatch(bare)
        or (_ACCELERATION.match(bare) and len(bare.split()) <= _LONGEST_NAME)
        or quantity_of(name)
        or is_of_a_table(name)
    )


def _is_prose(names: list[str]) -> bool:
    return any(re.search(r"\d{3}|[.!?]$", name) for name in names)


def is_time(name: str) -> bool:
    """Whether a column is called a time."""
    return _TIME.match(folded(name).strip()) is not None


def is_of_a_table(name: str) -> bool:
    """Whether a column is one of a spectrum, a hazard curve or a list, never of a record."""
    bare = folded(name).strip()
    return bool(
        _OTHER_AXIS.match(bare) or _SPECTRAL.match(bare) or _RATES.match(bare) or _SHORT_SPECTRAL.match(name)
    ) and not bare.startswith("n ")


def table_in(header: list[str], width: int) -> str | None:
    """Return the heading that says that a table is no record: of a spectrum, a hazard curve or a list of magnitudes."""
    for line in [line for line in header if line.strip()][-_LAST_LINES:]:
        if _VALUED.search(folded(line)) or re.search(r"[:=]\s*[-+]?\d", line):
            continue
        text = re.sub(r"\bcolumn\s*\d\s*", "", line.rpartition(":")[2])
        for names, _ in _splits(text):
            if not names or any(_NUMBERED.search(direction_in(name)) and not _is_way(name) for name in names):
                continue
            if len(names) == width and any(_is_heading(name, width) for name in names):
                return line.strip()
            # Where names are more or fewer than columns, the first one with its unit says what the table runs over.
            if width > 1 and len(names) > 1 and _RUNS_OVER.fullmatch(folded(names[0]).strip()):
                return line.strip()
    return None


def is_direction(name: str) -> bool:
    """Whether a column is called by its direction."""
    bare = folded(direction_in(name))
    return len(bare) > 1 and WAY.fullmatch(bare) is not None and _ACCELERATION.match(bare) is None


def _is_way(name: str) -> bool:
    return WAY.fullmatch(folded(direction_in(name))) is not None


def _is_heading(name: str, width: int) -> bool:
    """Whether a name of a column is that of a table; above a single column it may be the title of a record."""
    return is_of_a_table(name) and (width > 1 or len(direction_in(name).split()) <= 2)


def time_in(header: list[str]) -> bool:
    """Whether a header names a time."""
    return any(_TIME.search(folded(line)) for line in header)


def surely_time_in(header: list[str]) -> bool:
    """Whether a header names a time by a word; t alone may be a period."""
    return any(_TIME_IN_WORDS.search(folded(line)) for line in header)


def without_index(names: list[str]) -> int:
    """Return how many columns in front number the rows: one or none."""
    return int(len(names) > 1 and _is_index(names[0]))


def direction_in(name: str) -> str:
    """Return the name of a column without its unit."""
    return _IN_BRACKETS.sub("", name).strip()


def quantity_of(name: str) -> str | None:
    """Return "velocity" or "displacement" where a column is called so, or has their unit; else None."""
    if units_in(name):
        return None
    return next((quantity for quantity, pattern in _QUANTITIES if pattern.search(folded(name))), None)


def other_quantity(header: list[str]) -> str | None:
    """Return what the one series of a file is where its header says so, and it is no acceleration."""
    lines = [folded(line) for line in header]
    if any(_ACCELERATION.search(line) or "accel" in line or units_in(line) for line in lines):
        return None
    for line in lines:
        if match := _SERIES.search(line):
            return match[1]
        if _UNIT.search(line) and (quantity := quantity_of(line)):
            return quantity
    return None
