"""Fields of a case by their paths: what they hold, without a case."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from heeltoe.case.model import Case
from heeltoe.case.sentences import block_of


@cache
def quantity_of(path: str) -> str | None:
    """Return what a field holds, as a key of :data:`heeltoe.units.parse.DIMENSIONS`; None of one that holds no
    quantity, or that is not there."""
    schema = _schema()
    place: Mapping[str, Any] = schema
    for part in path.split("."):
        name, listed, _ = part.partition("[")
        place = next((block["properties"][name] for block in _meant(place, schema) if name in block["properties"]), {})
        if listed:
            place = next((choice["items"] for choice in _alternatives(place) if "items" in choice), {})
    return next((str(choice["quantity"]) for choice in _alternatives(place) if "quantity" in choice), None)


@cache
def bounds_of(path: str) -> tuple[tuple[str, float], ...]:
    """Return what a field keeps within, in SI units, by the names of comparisons: ``(("ge", 0.0), ("le", 10.0))``."""
    *blocks, name = path.split(".")
    model: type[BaseModel] = Case
    for block in blocks:
        model = block_of(model.model_fields[block].annotation) or model
    limits = list(constraints(model.model_fields[name]))
    kinds = ("ge", "gt", "le", "lt")
    return tuple((kind, float(getattr(limit, kind))) for limit in limits for kind in kinds if hasattr(limit, kind))


def value_of(case: Case, path: str) -> Any:
    """Return what stands in a field of a case, quantities in SI units; None where its block is not there."""
    place: Any = case
    for part in path.split("."):
        name, _, number = part.removesuffix("]").partition("[")
        place = getattr(place, name, None)
        if number:
            place = dict(enumerate(place)).get(int(number)) if number.isdigit() and isinstance(place, tuple) else None
    return place


def constraints(field: object) -> Iterator[object]:
    """Walk all that is said of a field, also of one that may be left out."""
    inner = (field.annotation, *field.metadata) if isinstance(field, FieldInfo) else get_args(field)
    for part in inner:
        yield part
        yield from constraints(part)


@cache
def _schema() -> dict[str, Any]:
    return Case.model_json_schema()


def _alternatives(place: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """Walk what a field may hold, itself or one of several."""
    yield place
    for choice in (*place.get("anyOf", ()), *place.get("allOf", ())):
        yield from _alternatives(choice)


def _meant(place: Mapping[str, Any], schema: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """Walk the blocks of fields that a field may hold."""
    for choice in _alternatives(place):
        block = schema["$defs"][choice["$ref"].rpartition("/")[2]] if "$ref" in choice else choice
        if "properties" in block:
            yield block
