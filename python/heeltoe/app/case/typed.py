"""What is typed into the fields of a form, as a case file would have it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from heeltoe.app.case.fields import Field, unit_of

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_WHOLE = re.compile(r"[+-]?\d{1,15}")
_TRUTHS = {"yes": True, "no": False}


def typed(given: object, field: Field, units: str) -> Any:
    """Return what stands in the case where this is typed; None where nothing is.

    A number without a unit is in the units that are chosen. What cannot be read stays as it is, for the readers of the
    package to say why."""
    if isinstance(given, list):
        return _list(given, field, units)
    if isinstance(given, Mapping) and field.kind == "block":
        return _block(given, field, units)
    if not isinstance(given, str):
        return given
    text = given.strip()
    if field.kind == "text":
        return given if text else None
    if not text:
        return None
    if field.kind == "whole" and _WHOLE.fullmatch(text):
        return int(text)
    if field.kind == "truth":
        return _TRUTHS.get(text, text)
    if field.kind == "quantity" and _NUMBER.fullmatch(text):
        unit = unit_of(field, units)
        return f"{text} {unit}" if unit else float(text)
    return text


def _list(given: list[Any], field: Field, units: str) -> Any:
    if field.kind == "pairs":
        rows = [
            [_cell(cell, inner, units) for cell, inner in zip(row, field.inner, strict=False)]
            if isinstance(row, list)
            else row
            for row in given
        ]
        return rows or None
    if field.kind == "blocks":
        return [_block(each, field, units) if isinstance(each, Mapping) else each for each in given] or None
    return given


def _cell(given: object, field: Field, units: str) -> Any:
    found = typed(given, field, units)
    # A cell that is empty is one that is missing, and must not move the next one to its place.
    return "" if found is None else found


def _block(given: Mapping[str, Any], field: Field, units: str) -> dict[str, Any]:
    fields = dict(field.blocks).get(str(given.get("step")), ()) if field.blocks else field.inner
    known = {each.path.rpartition(".")[2]: each for each in fields}
    made = {name: typed(value, known[name], units) if name in known else value for name, value in given.items()}
    return {name: value for name, value in made.items() if value is not None}
