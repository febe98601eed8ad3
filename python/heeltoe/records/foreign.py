"""Formats that are told apart but not read yet, so that they are not misread as plain columns."""

from __future__ import annotations

import re

_SIGNS = (
    (
        "COSMOS or CSMIP V2",
        re.compile(r"corrected accelerogram.*\bchan|points of accel(?:eration)? data", re.IGNORECASE),
    ),
    (
        "COSMOS or CSMIP",
        re.compile(r"\(format v\d\d\.\d\d with \d+ text lines\)|uncorrected accelerogram data", re.IGNORECASE),
    ),
    ("USGS SMC", re.compile(r"^\s*\d?\s*(?:un)?corrected accelerogram\s*$", re.IGNORECASE | re.MULTILINE)),
    ("K-NET or KiK-net", re.compile(r"^origin time\s+\d{4}/\d\d/\d\d", re.IGNORECASE | re.MULTILINE)),
)


def recognised(lines: list[str]) -> str | None:
    """Return the name of a format that is known but not read, or None."""
    head = "\n".join(line[:200] for line in lines[:60])
    return next((name for name, sign in _SIGNS if sign.search(head)), None)
