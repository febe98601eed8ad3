"""Formats that are recognised but not read, so that they are not misread as plain columns."""

from __future__ import annotations

import re

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.raw import RawRecord

FORMAT = ""

# Uncorrected data: counts, or samples at unequal steps with the drift of the instrument in them.
_SIGNS = (
    (
        "COSMOS V0 or V1 (uncorrected)",
        pattern(r"\(format v\s?\d\d\.\d\d with \d+ text lines\)", re.IGNORECASE),
    ),
    ("CSMIP V3 (response spectra)", pattern(r"\A.*response and fourier amplitude spectra", re.IGNORECASE)),
    ("CSMIP V3 (response spectra)", pattern(r"\A.*response spectra\b.*\n.*corrected accelerogram", re.IGNORECASE)),
    ("CSMIP V1 (uncorrected) or V2, incomplete,", pattern(r"uncorrected accelerogram data", re.IGNORECASE)),
)


def matches(lines: list[str]) -> bool:
    """Whether the file is in a format that is known but not read."""
    return _name(lines) is not None


def read(lines: list[str], name: str) -> list[RawRecord]:
    """Refuse a file that matches."""
    raise InputError("record-format-later", name, _name(lines))


def _name(lines: list[str]) -> str | None:
    head = "\n".join(line[:200] for line in lines[:60])
    return next((name for name, sign in _SIGNS if sign.search(head)), None)
