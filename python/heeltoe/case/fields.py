"""Types of the fields of a case that several of its blocks share, and what all blocks have in common."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema

from heeltoe.base.display import Named
from heeltoe.case.quantities import DimensionlessNumber, Duration, Length

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
    model_config = ConfigDict(extra="forbid", frozen=True, use_attribute_docstrings=True, defer_build=True)
