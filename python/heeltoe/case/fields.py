"""Types of the fields of a case that several of its blocks share, and what all blocks have in common."""

from __future__ import annotations

import ast
import inspect
import sys
from functools import cache
from itertools import pairwise
from typing import Annotated, Any, Literal, get_args, get_origin

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    WithJsonSchema,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from heeltoe.base.display import Named
from heeltoe.case.quantities import DimensionlessNumber, Duration, Length

#: The word for a field without a value.
NONE = "none"

Fraction = Annotated[DimensionlessNumber, Field(ge=0.0, le=1.0)]
FrictionCoefficient = Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)]
# Limits far from anything that is built or happens: beyond them is a slip of the pen, or an overflow later.
Time = Annotated[Duration, Field(ge=0.0, le=1e5)]
TimeSpan = Annotated[Duration, Field(gt=0.0, le=1e5)]
Head = Annotated[Length, Field(ge=0.0, le=1e4)]
LARGEST_ACCELERATION = 98.0665
"""Ten g [m/s^2]; no record comes near."""

# Channels of a file have numbers and directions; TOML tells 1 from "1", people do not.
Channel = Annotated[
    str,
    BeforeValidator(lambda value: str(value) if isinstance(value, int) and not isinstance(value, bool) else value),
    Field(strict=True, min_length=1),
    WithJsonSchema({"type": ["string", "integer"], "minLength": 1}),
]

# Steeper than 45 degrees, with its rounding, a crack makes a wedge of the dam and no block.
STEEPEST = 0.7853982

Truth = Annotated[bool, Field(strict=True)]
Count = Annotated[int, Field(strict=True, ge=1, le=10**12)]


class Fields(Named, BaseModel):
    """A block of fields: no unknown ones, no changes later; the texts below them go into the JSON schema."""

    # The validator of a block by itself is made when it is asked for; that of a case has all of its blocks.
    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)

    @model_validator(mode="before")
    @classmethod
    def _leave_out(cls, fields: Any) -> Any:
        """Leave out an optional field that is "none": TOML and the command line have no null."""
        if not isinstance(fields, dict):
            return fields
        return {name: value for name, value in fields.items() if not (value == NONE and _can_be_none(cls, name))}

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        result = handler(schema)
        properties = handler.resolve_ref_schema(result)["properties"]
        for name, text in field_texts(cls).items():
            properties[cls.model_fields[name].alias or name]["description"] = text
        return result


@cache
def _can_be_none(block: type[BaseModel], name: str) -> bool:
    """Whether a field has no value by default, and "none" is no value of its own."""
    field = block.model_fields.get(name)
    return field is not None and field.default is None and NONE not in _words(field.annotation)


def _words(annotation: Any) -> set[Any]:
    """Return the words that an annotation allows."""
    if get_origin(annotation) is Literal:
        return set(get_args(annotation))
    return {word for part in get_args(annotation) for word in _words(part)}


@cache
def _classes_in(module: str) -> dict[str, ast.ClassDef]:
    """Return the classes of a module as written, by name."""
    written = ast.parse(inspect.getsource(sys.modules[module])).body
    return {node.name: node for node in written if isinstance(node, ast.ClassDef)}


@cache
def field_texts(block: type[BaseModel]) -> dict[str, str]:
    """Return the texts below the fields of a block, by name. They are read from its source on the first call, so that a
    run does not wait for them."""
    texts: dict[str, str] = {}
    for kind in reversed(block.__mro__):
        if issubclass(kind, Fields) and kind is not Fields:
            for field, text in pairwise(_classes_in(kind.__module__)[kind.__name__].body):
                match field, text:
                    case ast.AnnAssign(target=ast.Name(name)), ast.Expr(ast.Constant(str(words))):
                        texts[name] = inspect.cleandoc(words)
    return texts
