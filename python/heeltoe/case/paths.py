"""Fields of a case by their paths: what they hold, without a case."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

from heeltoe.case.model import Case


@cache
def quantity_of(path: str) -> str | None:
    """Return what a field holds, as a key of :data:`heeltoe.units.parse.DIMENSIONS`; None of one that holds no
    quantity, or that is not there."""
    schema = _schema()
    place: Mapping[str, Any] = schema
    for name in path.split("."):
        place = next((each["properties"][name] for each in _meant(place, schema) if name in each["properties"]), {})
    return next((str(each["quantity"]) for each in _alternatives(place) if "quantity" in each), None)


def value_of(case: Case, path: str) -> Any:
    """Return what stands in a field of a case, quantities in SI units; None where its block is not there."""
    place: Any = case
    for name in path.split("."):
        place = getattr(place, name, None)
    return place


@cache
def _schema() -> dict[str, Any]:
    return Case.model_json_schema()


def _alternatives(place: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """Walk what a field may hold, itself or one of several."""
    yield place
    for each in (*place.get("anyOf", ()), *place.get("allOf", ())):
        yield from _alternatives(each)


def _meant(place: Mapping[str, Any], schema: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """Walk the blocks of fields that a field may hold."""
    for each in _alternatives(place):
        found = schema["$defs"][each["$ref"].rpartition("/")[2]] if "$ref" in each else each
        if "properties" in found:
            yield found
