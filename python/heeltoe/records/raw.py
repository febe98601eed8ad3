"""What a reader returns: numbers as they stand in the file, with what the file says about them."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from heeltoe.errors import InputError

Floats = NDArray[np.float64]


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
    """

    values: Floats
    time: Floats | None = None
    time_step: float | None = None
    unit: str | None = None
    about: dict[str, str] = field(default_factory=dict)
    processing: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def numbers(lines: list[str], name: str, first_line: int) -> Floats:
    """Read all numbers of some lines, any white space between them, Fortran's D exponents and glued columns too.

    Parameters
    ----------
    lines
        Lines that hold nothing but numbers.
    name
        Of the file, for errors.
    first_line
        Number of the first of them in the file, for errors.

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
        for word in unglued(line).split():
            try:
                if "_" in word or not word.isascii():
                    raise ValueError
                values.append(float(word))
            except ValueError:
                raise InputError("record-number", name, repr(word[:30]), line=number) from None
    return np.array(values)


def unglued(line: str) -> str:
    """Part columns that touch (8F10.5, E15.7: a sign right behind a digit) and turn Fortran's D exponents into E."""
    return re.sub(r"(?<=[\d.])(?=[-+])", " ", re.sub(r"(?<=[\d.])[dD](?=[-+]?\d)", "e", line))
