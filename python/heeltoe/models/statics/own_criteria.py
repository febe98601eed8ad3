"""Criteria of a user's own, from a file in TOML, and those of the documents: what judges a case.

    title = "Our authority, guideline 12 (2024)"
    uplift_in_earthquake = "unchanged"

    [sliding]
    usual = 1.5
    unusual = 1.3
    earthquake = 1.0
    source = "table 3"

Tables are named by the checks; of sliding there may be one with cohesion beside one without.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, get_args

from heeltoe.case.fields_file import read_fields
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import plain
from heeltoe.models.statics.criteria import CRITERIA, UPLIFT_IN_EARTHQUAKE, Criterion, Loads, chosen

_FIELD = "statics.criteria_file"
_LOADS: tuple[str, ...] = get_args(Loads)
# Table of the file -> check, and whether it is for resistance with cohesion.
_TABLES: dict[str, tuple[str, bool | None]] = {
    "sliding": ("sliding", None),
    "sliding-with-cohesion": ("sliding", True),
    "sliding-without-cohesion": ("sliding", False),
    "overturning": ("overturning", None),
    "flotation": ("flotation", None),
    "resultant": ("resultant", None),
    "compression": ("compression", None),
}
_LAWS = ("unchanged", "zero", "full")
_CHOSEN = {
    "unchanged": "unchanged by the earthquake, as the case asks (USACE, FERC)",
    "zero": "zero where the earthquake opens the crack, as the case asks (USBR)",
    "full": "at once the reservoir's where the earthquake opens the crack, as the case asks (ICOLD 1986)",
}


@dataclass(frozen=True)
class Rules:
    """Criteria that judge a case.

    Attributes
    ----------
    name
        Of the criteria: their documents' short name, or the title of the user's own.
    rows
        All their rows.
    uplift
        What the water does where the earthquake opens the crack, and where that stands.
    """

    name: str
    rows: tuple[Criterion, ...]
    uplift: tuple[str, str]


def rules_of(case: Case) -> Rules:
    """Return what judges a case: the criteria that it names, or those in its file.

    Raises
    ------
    InputError
        Where the file cannot be used: file and field, value, remedy.
    """
    choice = case.statics
    if choice.criteria_file is None:
        rules = Rules(choice.criteria, CRITERIA[choice.criteria], UPLIFT_IN_EARTHQUAKE[choice.criteria])
    else:
        path = case.base_directory / choice.criteria_file
        rules = _in_file(path, choice.criteria_file, _stamp(path))
    law = choice.uplift_in_earthquake
    return rules if law == "criteria" else Rules(rules.name, rules.rows, (law, _CHOSEN[law]))


def criteria_of(case: Case, loads: Loads, *, cohesion: bool) -> tuple[Criterion, ...]:
    """Return the rows that hold for a case of loads."""
    choice = case.statics
    rows = rules_of(case).rows
    return chosen(rows, loads, cohesion=cohesion, structure=choice.structure, site_information=choice.site_information)


def _stamp(path: Path) -> tuple[int, int] | None:
    """Return what is another where a file was written again."""
    try:
        stamp = path.stat()
    except (OSError, ValueError):
        return None
    return stamp.st_mtime_ns, stamp.st_size


@lru_cache(maxsize=16)
def _in_file(path: Path, name: str, stamp: tuple[int, int] | None) -> Rules:
    """Return what a file says, which is read once for all load cases and sections; again where it was written."""
    return _read(read_fields(path, "criteria in TOML, relative to the case file"), name)


def _read(fields: Mapping[str, object], name: str) -> Rules:
    """Return what a file says."""
    title = fields.get("title", name)
    law = fields.get("uplift_in_earthquake", "unchanged")
    if not isinstance(title, str):
        raise InputError("wrong-type", f"{name}: title", shown(title), expected="a text")
    if law not in _LAWS:
        choices = ", ".join(f'"{law}"' for law in _LAWS)
        raise InputError("not-a-choice", f"{name}: uplift_in_earthquake", shown(law), choices=choices)
    title, name, rows = plain(title), plain(name), []
    for table, values in fields.items():
        if table in ("title", "uplift_in_earthquake"):
            continue
        if table not in _TABLES or not isinstance(values, Mapping):
            raise InputError("not-a-choice", f"{name}: {table}", table, choices=f"one of {', '.join(_TABLES)}")
        rows += _rows(table, values, title, name)
    if not rows:
        raise InputError(
            "empty", _FIELD, name, what="criteria", expected="a table, for example [sliding] with usual = 1.5"
        )
    if "sliding" in fields and {"sliding-with-cohesion", "sliding-without-cohesion"} & fields.keys():
        raise InputError("fields-conflict", f"{name}: sliding", other="sliding-with-cohesion or -without-cohesion")
    return Rules(title, tuple(rows), (law, f"{title}: {law} where the earthquake opens the crack"))


def _rows(table: str, values: Mapping[str, Any], title: str, name: str) -> list[Criterion]:
    check, cohesion = _TABLES[table]
    source = values.get("source", table)
    if not isinstance(source, str):
        raise InputError("wrong-type", f"{name}: {table}.source", shown(source), expected="a text")
    criteria = []
    for loads, value in values.items():
        if loads == "source":
            continue
        if loads not in _LOADS:
            raise InputError("not-a-choice", f"{name}: {table}.{loads}", loads, choices=f"one of {', '.join(_LOADS)}")
        number = isinstance(value, int | float) and not isinstance(value, bool)
        # Of the width, the resultant can be half away from the middle.
        most = 0.5 if check == "resultant" else 1.0 if check == "compression" else 100.0
        if not number or not 0.0 < value <= most:
            raise InputError(
                "out-of-range", f"{name}: {table}.{loads}", shown(value), bound=f"above 0 and up to {most:g}"
            )
        note = f"of the user's own criteria, {name}"
        criteria.append(Criterion(loads, check, float(value), title, plain(source), note, cohesion))  # type: ignore[arg-type]
    return criteria
