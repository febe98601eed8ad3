"""Typed blocks of a result: every number stands once, with its type, its unit and its meaning in its annotation.

JSON, JSON schema, ``heeltoe explain``, tables of the documentation, editors and type checkers read them there::

    class Penetration(Block):
        watched: Annotated[float, Number("Deepest of a watched node into the other face.", "m")]

What follows from other fields is a property with such an annotation, and stands behind them.
"""

from __future__ import annotations

import re
import types
from collections.abc import ItemsView, Iterator, Mapping
from dataclasses import dataclass, field, fields
from functools import cache
from inspect import get_annotations
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    Self,
    Union,
    dataclass_transform,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np

from heeltoe.base.frozen import FrozenList

#: So many places of a list of numbers stand in a table.
LISTED = 6


@dataclass(frozen=True)
class Number:
    """Content of a field of a block.

    Attributes
    ----------
    meaning
        In a sentence.
    unit
        Its unit in the JSON, as ``m`` or ``rad/s²``; empty of counts, shares, words and blocks.
    optional
        Whether the key is left out of the JSON where there is no value, rather than null.
    """

    meaning: str
    unit: str = ""
    optional: bool = False

    @property
    def full(self) -> str:
        """Name of its row in a table: its meaning up to a colon or semicolon."""
        return re.split("[:;] ", self.meaning)[0].removesuffix(".")


@dataclass_transform(kw_only_default=True, frozen_default=True, eq_default=False, field_specifiers=(field,))
class Block(Mapping[str, Any]):
    """A block of a result: an immutable record, which reads by its JSON names, too (``block["watched"]``)."""

    def __new__(cls, **_: Any) -> Self:
        """Make the class a dataclass before its first object: making all of them takes longer than a rigid run."""
        if "__dataclass_fields__" not in cls.__dict__:
            made(cls)
        return super().__new__(cls)

    def __iter__(self) -> Iterator[str]:
        return iter([name for name, _ in self.items()])

    def __len__(self) -> int:
        return len(self.items())

    def items(self) -> ItemsView[str, Any]:
        """Return names and values; optional ones that are None are left out."""
        values = {}
        for name, optional in _optional(type(self)).items():
            value = getattr(self, name)
            if value is not None or not optional:
                values[name] = value
        return values.items()

    def __getitem__(self, name: str) -> Any:
        optional = _optional(type(self))[name]
        value = getattr(self, name)
        if optional and value is None:
            raise KeyError(name)
        return value

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """Return the names of its fields, in their order."""
        return tuple(entry.name for entry in entries(cls))

    def to_json(self) -> dict[str, Any]:
        """Return a dictionary of plain numbers, words, lists and dictionaries."""
        return {name: value if type(value) in _PLAIN else plain_json(value) for name, value in self.items()}


def made(kind: type[Block]) -> Any:
    """Return a kind of block as the dataclass that it is from its first use on, its bases first."""
    for owner in reversed(kind.__mro__):
        if issubclass(owner, Block) and owner is not Block and "__dataclass_fields__" not in owner.__dict__:
            if any("list[" in str(hint) for hint in get_annotations(owner).values()):
                owner.__post_init__ = _freeze_lists  # type: ignore[attr-defined]
            dataclass(frozen=True, kw_only=True, eq=False)(owner)
    return kind


def _freeze_lists(block: Block) -> None:
    for name in _lists(type(block)):
        value = getattr(block, name)
        if type(value) is list:
            object.__setattr__(block, name, FrozenList(value))


def plain_json(value: Any) -> Any:
    """Return a value of a block as JSON has it."""
    if hasattr(value, "to_json"):
        return value.to_json()
    if isinstance(value, Mapping):
        return {name: plain_json(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain_json(item) for item in value]
    if isinstance(value, np.ndarray):
        return value.tolist()
    return value


class Entry(NamedTuple):
    """A field of a block: its name, its type without its annotation, and what that says of it."""

    name: str
    type: Any
    number: Number


@cache
def entries(kind: type) -> tuple[Entry, ...]:
    """Return what the JSON has of a block, in its order: fields, then properties, with a :class:`Number`."""
    # In the order of the fields of a dataclass, which the kind need not be yet.
    entries = get_type_hints(kind, include_extras=True)
    for name, thing in (item for owner in reversed(kind.__mro__) for item in vars(owner).items()):
        if isinstance(thing, property) and str(thing.fget.__annotations__.get("return")).startswith("Annotated"):
            entries[name] = get_type_hints(thing.fget, include_extras=True)["return"]
    rows = []
    for name, hint in entries.items():
        numbers = [extra for extra in get_args(hint)[1:] if isinstance(extra, Number)] if _annotated(hint) else []
        if numbers:
            rows.append(Entry(name, get_args(hint)[0], numbers[0]))
    return tuple(rows)


@cache
def _lists(kind: type) -> tuple[str, ...]:
    """Return the fields of a block that may hold a list."""
    return tuple(item.name for item in fields(made(kind)) if "list[" in str(item.type))


@cache
def _optional(kind: type) -> dict[str, bool]:
    return {entry.name: entry.number.optional for entry in entries(kind)}


def _annotated(hint: Any) -> bool:
    return get_origin(hint) is Annotated


@cache
def ending_of(unit: str) -> str:
    """Return how the name of a number of this unit ends."""
    ending = unit.partition(" per ")[0].lower().replace("n m", "nm").replace("²", "2")
    return "_" + re.sub("[ /]", "_", ending) if unit else ""


def numbers_in(kind: type, above: str = "") -> Iterator[tuple[str, str, str]]:
    """Walk label, path and unit of all numbers of a block, with those of the blocks that it always has; of a list those
    of its first :data:`LISTED` places."""
    for name, hint, number in entries(kind):
        path, label = f"{above}{name}", number.full[:1].upper() + number.full[1:]
        kinds = set(get_args(hint)) if get_origin(hint) in (Union, types.UnionType) else {hint}
        if isinstance(hint, type) and issubclass(hint, Block):
            yield from numbers_in(hint, f"{path}.")
        elif kinds & {float, int}:
            yield label, path, number.unit
        elif kinds & {list[float], list[int]}:
            yield from ((f"{label}, {place + 1}", f"{path}.{place}", number.unit) for place in range(LISTED))


def described(kind: type, above: str = "") -> Iterator[tuple[str, Number]]:
    """Walk the paths of all keys of a block with their content; ``[]`` is a place in a list, ``*`` any name."""
    for entry in entries(kind):
        path = f"{above}{entry.name}"
        yield path, entry.number
        for inner, place in _blocks_in(entry.type):
            yield from described(inner, f"{path}{place}.")


def _blocks_in(hint: Any) -> Iterator[tuple[type, str]]:
    """Walk the blocks that a type holds, and how a path leads on to them."""
    if isinstance(hint, type) and issubclass(hint, Block):
        yield hint, ""
        return
    origin, inner = get_origin(hint), get_args(hint)
    if origin in (Union, types.UnionType):
        for part in inner:
            yield from _blocks_in(part)
    elif origin in (list, tuple):
        yield from ((block, f"[]{place}") for block, place in _blocks_in(inner[0]))
    elif origin in (dict, Mapping):
        yield from ((block, f".*{place}") for block, place in _blocks_in(inner[1]))


_PLAIN = {float: "number", int: "integer", str: "string", bool: "boolean", types.NoneType: "null"}


def json_schema(hint: Any, number: Number | None = None) -> dict[str, Any]:
    """Return the JSON schema of a type: of a block with units and meanings."""
    origin, inner = get_origin(hint), get_args(hint)
    schema: dict[str, Any]
    if origin is Annotated:
        schema = json_schema(inner[0])
    elif hint in _PLAIN:
        schema = {"type": _PLAIN[hint]}
    elif origin is Literal:
        schema = {"enum": list(inner)}
    elif origin in (Union, types.UnionType):
        schema = {"anyOf": [json_schema(part) for part in inner]}
    elif origin in (list, tuple):
        schema = {"type": "array", "items": json_schema(inner[0])}
    elif origin in (dict, Mapping):
        schema = {"type": "object", "additionalProperties": json_schema(inner[1])}
    elif isinstance(hint, type) and issubclass(hint, Block):
        rows = entries(hint)
        schema = {
            "type": "object",
            "properties": {entry.name: json_schema(entry.type, entry.number) for entry in rows},
            "required": [entry.name for entry in rows if not entry.number.optional],
        }
    else:
        schema = {}
    if number is not None:
        schema |= {"description": number.meaning} | ({"unit": number.unit} if number.unit else {})
    return schema
