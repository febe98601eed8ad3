"""Quantities as fields of a case: read from texts with units to SI numbers, and written back with their unit. The JSON
schema says which quantity a field holds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

from pydantic import BeforeValidator, PlainSerializer, PlainValidator, WithJsonSchema

from heeltoe.case.sentences import collected
from heeltoe.units.parse import DIMENSIONS, Acceleration, parse, parse_acceleration


def _validator(dimension: str) -> Callable[[object], float]:
    return collected(lambda value: parse(value, dimension, ""))


def _schema(dimension: str, type_: object = "string", example: object = None) -> WithJsonSchema:
    return WithJsonSchema(
        {"type": type_, "quantity": dimension, "examples": [example or DIMENSIONS[dimension].example]}
    )


def _written(dimension: str) -> PlainSerializer:
    """Write the SI value with its unit, so that a case written as JSON is a case that can be read."""
    unit = DIMENSIONS[dimension].unit
    return PlainSerializer(lambda value: f"{value!r} {unit}", return_type=str, when_used="json-unless-none")


Length = Annotated[float, BeforeValidator(_validator("length")), _written("length"), _schema("length")]
"""A length [m]."""
Density = Annotated[float, BeforeValidator(_validator("density")), _written("density"), _schema("density")]
"""A density [kg/m^3]."""
Pressure = Annotated[float, BeforeValidator(_validator("pressure")), _written("pressure"), _schema("pressure")]
"""A pressure or modulus [Pa]."""
Duration = Annotated[float, BeforeValidator(_validator("duration")), _written("duration"), _schema("duration")]
"""A time [s]."""
Velocity = Annotated[float, BeforeValidator(_validator("velocity")), _written("velocity"), _schema("velocity")]
"""A velocity, or an Arias intensity [m/s],."""
Frequency = Annotated[float, BeforeValidator(_validator("frequency")), _written("frequency"), _schema("frequency")]
"""A frequency [Hz]."""
Angle = Annotated[float, BeforeValidator(_validator("angle")), _written("angle"), _schema("angle")]
"""An angle [rad]."""
WearCoefficient = Annotated[
    float, BeforeValidator(_validator("wear coefficient")), _written("wear coefficient"), _schema("wear coefficient")
]
"""A wear coefficient [m^2/J]."""
MemorySize = Annotated[float, BeforeValidator(_validator("memory")), _written("memory"), _schema("memory")]
"""A size of memory [B]."""
LineForce = Annotated[float, BeforeValidator(_validator("line force")), _written("line force"), _schema("line force")]
"""A force per metre of dam [N/m]."""
FractureEnergy = Annotated[
    float, BeforeValidator(_validator("fracture energy")), _written("fracture energy"), _schema("fracture energy")
]
"""An energy for each area that cracks [N/m]."""
Stiffness = Annotated[float, BeforeValidator(_validator("stiffness")), _written("stiffness"), _schema("stiffness")]
"""A force per metre of dam and metre of displacement [N/m^2]."""
Gravity = Annotated[
    float,
    BeforeValidator(_validator("acceleration")),
    _written("acceleration"),
    _schema("acceleration", example="9.81 m/s^2"),
]
"""The acceleration of gravity [m/s^2]."""
DimensionlessNumber = Annotated[float, BeforeValidator(_validator("number")), _schema("number", ["number", "string"])]
"""A number without unit; ``"5 %"`` is 0.05."""
AccelerationField = Annotated[
    Acceleration,
    PlainValidator(collected(lambda value: parse_acceleration(value, ""))),
    PlainSerializer(str, return_type=str, when_used="json-unless-none"),
    _schema("acceleration"),
]
"""An :class:`Acceleration`."""
