"""Fields of a case by their paths: what they hold, without a case."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any, get_args, get_origin

from pydantic import BaseModel, WithJsonSchema
from pydantic.fields import FieldInfo

from heeltoe.case.lists import block_path, place_in_list
from heeltoe.case.model import Case
from heeltoe.case.sentences import kinds_in


@cache
def quantity_of(path: str) -> str | None:
    """Return what a field holds, as a key of :data:`heeltoe.units.parse.DIMENSIONS`; None of one that holds no
    quantity or several of them, or that is not there."""
    field = _field_at(path)
    quantities = quantities_of(field) if field is not None and is_list(field) == path.endswith("]") else []
    return quantities[0] if len(quantities) == 1 else None


@cache
def bounds_of(path: str) -> tuple[tuple[str, float], ...]:
    """Return the bounds of a field, in SI units, by the names of comparisons: ``(("ge", 0.0), ("le", 10.0))``."""
    kinds = ("ge", "gt", "le", "lt")
    limits = list(constraints(_field_at(path)))
    return tuple((kind, float(getattr(limit, kind))) for limit in limits for kind in kinds if hasattr(limit, kind))


def _field_at(path: str) -> FieldInfo | None:
    """Return the field at a path, of which lists have their place; None where there is none, or its block may be of
    several kinds."""
    block: type[BaseModel] | None = Case
    field = None
    for part in block_path(path).split("."):
        name, place, _ = part.partition("[")
        field = None if block is None else block.model_fields.get(name)
        if field is None:
            return None
        kinds = list(kinds_in(field.annotation))
        block = kinds[0] if len(kinds) == 1 and is_list(field) == bool(place) else None
    return field


def is_list(field: FieldInfo) -> bool:
    """Whether a field holds a list."""
    return any(get_origin(annotation) is tuple for annotation in (field.annotation, *get_args(field.annotation)))


def quantities_of(field: object) -> list[str]:
    """Return the quantities that a field holds, in their order."""
    schemas = [limit.json_schema or {} for limit in constraints(field) if isinstance(limit, WithJsonSchema)]
    return [str(schema["quantity"]) for schema in schemas if "quantity" in schema]


def value_of(case: Case, path: str) -> Any:
    """Return what stands in a field of a case, quantities in SI units; None where its block is not there."""
    place: Any = case
    if (crack := place_in_list(path)) is not None:
        alone = case.single_crack_cases
        return value_of(alone[crack], f"crack{path.partition(']')[2]}") if crack < len(alone) else None
    for part in path.split("."):
        name, _, number = part.removesuffix("]").partition("[")
        place = getattr(place, name, None)
        if number:
            place = dict(enumerate(place)).get(int(number)) if number.isdigit() and isinstance(place, tuple) else None
    return place


def constraints(field: object) -> Iterator[object]:
    """Walk all metadata of a field, also of an optional one."""
    inner = (field.annotation, *field.metadata) if isinstance(field, FieldInfo) else get_args(field)
    for part in inner:
        yield part
        yield from constraints(part)
