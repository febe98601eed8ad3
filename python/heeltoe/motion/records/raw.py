"""Raw record of a reader: numbers as they stand in the file, with the statements of the file about them."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import unglued
from heeltoe.motion.records.stated import Written
from heeltoe.units.parse import acceleration_unit
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

# Doubts about a record whose numbers differ from those that its header states.
COUNT = "states {stated:g} values and has {found:d}: all of them are used"
PEAK = "states a peak of {stated:g} and has {found:.6g}: what it has is used"

# A last line is cut off, or a first value counts as a header; more values than these, or this share, are neither.
_FEW, _FAR_COUNT = 8, 0.05
#: A number of Fortran's, for patterns that ignore case; see :func:`real`.
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[ED][-+]?\d+)?"


@dataclass
class RawRecord:
    """A record as it stands in its file.

    Attributes
    ----------
    values
        (n,) acceleration in `unit`.
    time
        (n,) moments [s]; None where the samples are `time_step` apart.
    time_step
        Step [s]; None where the file does not state one.
    unit
        Unit of the values as the file states it; None where it does not.
    about
        event, station, component, date as far as stated.
    processing
        What the file says was done to the record.
    warnings
        What does not fit together in the file.
    channel
        Number of the channel as the file states it; empty where it does not.
    uncorrected
        Why the record is not to be used as it stands; empty where it is.
    counts_samples
        Whether the file numbers its values where others say their times.
    format
        Of the file.
    peaks, durations
        Numbers that the file states of them, to be held against what was read; the durations in s.
    named_units
        Units the file names where it does not say which one is that of the values.
    begins
        When the first value was taken, by the clock of the file [s since 1970]; None where it does not state it.
    factor
        Factor of the header, without saying whether the values contain it.
    """

    values: Floats
    time: Floats | None = None
    time_step: float | None = None
    unit: str | None = None
    about: dict[str, str] = field(default_factory=dict)
    processing: tuple[str, ...] = ()
    warnings: tuple[Notice, ...] = ()
    channel: str = ""
    uncorrected: str = ""
    counts_samples: bool = False
    format: str = ""
    peaks: tuple[Written, ...] = ()
    durations: tuple[Written, ...] = ()
    named_units: frozenset[str] = frozenset()
    factor: float | None = None
    begins: float | None = None


def numbers(lines: list[str], name: str, first_line: int, width: int = 0) -> Floats:
    """Read all numbers of some lines, any white space between them, Fortran's D exponents and glued columns too.

    Parameters
    ----------
    lines
        Lines that hold nothing but numbers.
    name
        Of the file, for errors.
    first_line
        Number of the first of them in the file, for errors.
    width
        Width of Fortran's columns where it is known. Positive numbers that fill theirs leave no gap (8F10.6 of 100.5).

    Raises
    ------
    InputError
        Where a word is not a number.
    """
    text = " ".join(lines)
    # Python reads 1_0 as ten, and digits of any script; in a record both are damage.
    if text.isascii() and "_" not in text:
        try:
            return np.array(text.split(), dtype=np.float64)
        except ValueError:
            pass
    values: list[float] = []
    for number, line in enumerate(lines, first_line):
        words = unglued(line).split()
        if width and any(word.count(".") > 1 for word in words):
            words = [line[k : k + width].strip() for k in range(0, len(line.rstrip()), width)]
        for word in words:
            try:
                if "_" in word or not word.isascii():
                    raise ValueError
                values.append(float(word))
            except ValueError:
                raise InputError("record-number", name, repr(word[:30]), line=number) from None
    return np.array(values)


def table(lines: list[str], name: str, first_line: int, width: int) -> Floats:
    """Read lines of `width` numbers each to one row for each column; empty lines are left out; see :func:`numbers`."""
    for number, line in enumerate(lines, first_line):
        words = len(unglued(line).split())
        if words not in (0, width):
            raise InputError("record-ragged", name, f"{words} columns", line=number, width=width)
    return np.ascontiguousarray(numbers(lines, name, first_line).reshape(-1, width).T)


def real(text: str) -> float:
    """Return the number that a text of the pattern :data:`NUMBER` is."""
    return float(text.upper().replace("D", "E"))


def leading(text: str) -> str:
    """Return the number with which a text begins, as it is written there; empty where it does not."""
    match = re.match(rf"\s*({NUMBER})", text, re.IGNORECASE)
    return match[1] if match else ""


def stated(text: str) -> float | None:
    """Return the number with which a text begins; None where it does not."""
    written = leading(text)
    return real(written) if written else None


def breaks_off(name: str) -> Notice:
    """Return the warning of a file that ends too early."""
    return doubtful(name, "breaks off before its end: all behind this channel is missing")


def doubtful(name: str, doubt: str, **quantities: object) -> Notice:
    """Return the warning that a record is doubtful, by a template of the quantities."""
    return Notice("record-doubtful", name=name, doubt=Sentence.of(doubt, **quantities))


def check_series(
    values: Floats, name: str, count: float | None, peak: str = "", share: float = 1e-3
) -> tuple[Notice, ...]:
    """Return warnings where a file states another count or peak than its values have; without a count or a peak, that
    is not compared. See :func:`counted` and :func:`peaked`."""
    notices = counted(values, count, name) if count is not None else ()
    return notices + (peaked(values, peak, name, share) if peak else ())


def counted(values: Floats, stated: float, name: str) -> tuple[Notice, ...]:
    """Return a warning where a file states another number of values than it has.

    Raises
    ------
    InputError
        Where the two are so far apart that a part of the file is missing.
    """
    if values.size == stated:
        return ()
    if not abs(values.size - stated) <= max(_FEW, _FAR_COUNT * max(values.size, stated)):
        raise InputError("record-count-far", name, values.size, stated=f"{stated:g}")
    return (doubtful(name, COUNT, stated=stated, found=values.size),)


def peaked(values: Floats, stated: str, name: str, share: float = 1e-3) -> tuple[Notice, ...]:
    """Return a warning where the peak of the values is not the stated one.

    Parameters
    ----------
    values
        The values.
    stated
        The peak as the file writes it, in the unit of the values; its last digit may be rounded.
    name
        Of the file.
    share
        Share of the peak by which the two may differ beyond that.
    """
    peak = abs(real(stated))
    peak_here = float(np.abs(values).max(initial=0.0))
    last_digit = 0.0 if stated.upper().isupper() else 10.0 ** -len(stated.partition(".")[2])
    # A value that is not a number is refused later, by its place.
    if not abs(peak_here - peak) > last_digit + share * peak:
        return ()
    return (doubtful(name, PEAK, stated=peak, found=peak_here),)


def word_of_unit(word: str) -> str | None:
    """Return the unit a word of a header stands for; None where it is no unit, and the user must tell.

    A unit of another quantity is returned too: the user is told that it is none of acceleration.
    """
    unit = re.sub(r"/s(?:/s|\*\*2|2)$", "/s^2", word.lower().strip().rstrip(".").replace("sec", "s"))
    try:
        acceleration_unit(unit, "")
    except InputError as error:
        return unit if error.code == "wrong-quantity" else None
    return unit
