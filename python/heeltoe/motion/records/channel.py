"""One channel out of a file of several: by its number, or by its direction."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from heeltoe.errors.error import InputError
from heeltoe.motion.records.raw import RawRecord

# What a message lists of a file with very many.
_LISTED = 12


def numbered(records: list[RawRecord]) -> list[RawRecord]:
    """Return records with a number each where there are several: the stated ones, or else the order in the file."""
    numbers = [record.channel for record in records]
    if len(records) == 1 or (all(numbers) and len(set(numbers)) == len(numbers)):
        return records
    return [replace(record, channel=str(k)) for k, record in enumerate(records, 1)]


def choose(records: list[RawRecord], choice: str | int | None, name: str, field: str) -> RawRecord:
    """Return the record that is wanted.

    Parameters
    ----------
    records
        The channels of the file, numbered.
    choice
        Number of the channel, or its direction as the file states it, whatever the case and with or without "deg". A
        number goes before a direction in degrees.
    name
        Of the file.
    field
        Where the choice stands in a case, for errors.

    Raises
    ------
    InputError
        Where there is none, or more than one.
    """
    if choice is None:
        if len(records) == 1:
            _check_whole(records[0], name, field)
            return records[0]
        raise InputError("several", name, listed(records), things="channels", how=f"in {field}")
    text = str(choice).strip()
    chosen = [record for record in records if (record.channel or "1") == text]
    if not chosen:
        chosen = [record for record in records if _direction(text) in _directions(record.about.get("component", ""))]
    if len(chosen) != 1:
        count = len(chosen) or "none"
        raise InputError("record-channel", field, repr(text[:30]), count=count, name=name, channels=listed(records))
    return chosen[0]


def _check_whole(record: RawRecord, name: str, field: str) -> None:
    """Refuse the only channel left of a file that had more: which one was meant is not known."""
    for lost in record.warnings:
        if lost.code == "record-channels":
            opened = dict(lost.quantities)["opened"]
            raise InputError("record-channels-lost", name, listed([record]), opened=opened, channel_field=field)


def listed(records: list[RawRecord]) -> str:
    """Return the channels with number, direction and peak, in one line."""
    texts = []
    for record in records[:_LISTED]:
        peak = float(np.abs(record.values).max(initial=0.0))
        direction = record.about.get("component") or "no direction"
        texts.append(f"{record.channel or '1'}: {direction}, peak {peak:.4g} {record.unit or '(no unit)'}")
    return "; ".join(texts) + ("; ..." if len(records) > _LISTED else "")


def _directions(component: str) -> set[str]:
    """A direction, and where a code stands behind it in brackets, as in 90 deg (HNE), each of the two by itself."""
    parts = re.fullmatch(r"(.*?)\s*\(([^()]*)\)", component)
    return {_direction(component), *map(_direction, parts.groups() if parts else ())}


def _direction(text: str) -> str:
    """A direction without what is written in different ways: case, blanks, degrees, zeros in front."""
    bare = re.sub(r"\s+|deg(?:rees)?\.?|°", "", text.lower())
    return bare.lstrip("0") or "0" if bare.isdecimal() else bare
