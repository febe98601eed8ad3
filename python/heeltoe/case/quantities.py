"""Quantities as fields of a case: read from texts with units to SI numbers, and written back with their unit. The JSON
schema says which quantity a field holds."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import BeforeValidator, PlainSerializer, PlainValidator, WithJsonSchema

from heeltoe.case.sentences import collected
from heeltoe.units.parse import DIMENSIONS, Acceleration, parse, parse_acceleration


def _quantity(dimension: str, example: str = "", kind: str = "") -> tuple[Any, ...]:
    """Return how a number of a dimension is read, written with its SI unit, so that a case written as JSON is a case
    that can be read, and described; of some `kind` of it with errors of its own."""
    unit = DIMENSIONS[dimension].unit
    return (
        BeforeValidator(collected(lambda value: parse(value, kind or dimension, ""))),
        PlainSerializer(lambda value: f"{value!r} {unit}", return_type=str, when_used="json-unless-none"),
        _schema(dimension, example=example),
    )


def _schema(dimension: str, type_: object = "string", example: str = "") -> WithJsonSchema:
    return WithJsonSchema(
        {"type": type_, "quantity": dimension, "examples": [example or DIMENSIONS[dimension].example]}
    )


def _rotation(value: object) -> float:
    """Return a rotation [rad]; a plain number, also as a text, is one in rad."""
    try:
        with_unit = isinstance(value, str) and not math.isfinite(float(value))
    except ValueError:
        with_unit = True
    return parse(value, "angle" if with_unit else "number", "")


def _peak(value: object) -> Acceleration | float:
    """Return a peak acceleration, or the share of another one that a text with a per cent sign is."""
    if isinstance(value, float) or (isinstance(value, str) and value.rstrip().endswith("%")):
        return parse(value, "number", "")
    return parse_acceleration(value, "")


Length = Annotated[float, *_quantity("length")]
"""A length [m]."""
Slip = Annotated[float, *_quantity("length", str(DIMENSIONS["slip"].example), "slip")]
"""A length of a slip or an opening [m]."""
Density = Annotated[float, *_quantity("density")]
"""A density [kg/m^3]."""
Pressure = Annotated[float, *_quantity("pressure")]
"""A pressure or modulus [Pa]."""
Duration = Annotated[float, *_quantity("duration")]
"""A time [s]."""
Velocity = Annotated[float, *_quantity("velocity")]
"""A velocity, or an Arias intensity [m/s]."""
Frequency = Annotated[float, *_quantity("frequency")]
"""A frequency [Hz]."""
Angle = Annotated[float, *_quantity("angle")]
"""An angle [rad]."""
Rotation = Annotated[
    float,
    BeforeValidator(collected(lambda value: _rotation(value))),
    PlainSerializer(lambda value: f"{value!r} rad", return_type=str, when_used="json-unless-none"),
    _schema("angle", ["number", "string"], "0.01 rad"),
]
"""A rotation [rad]: a plain number, or an angle with its unit."""
WearCoefficient = Annotated[float, *_quantity("wear coefficient")]
"""A wear coefficient [m^2/J]."""
MemorySize = Annotated[float, *_quantity("memory")]
"""A size of memory [B]."""
LineForce = Annotated[float, *_quantity("line force")]
"""A force per metre of dam [N/m]."""
FractureEnergy = Annotated[float, *_quantity("fracture energy")]
"""An energy for each area that cracks [N/m]."""
Stiffness = Annotated[float, *_quantity("stiffness")]
"""A force per metre of dam and metre of displacement [N/m^2]."""
Gravity = Annotated[float, *_quantity("acceleration", "9.81 m/s^2")]
"""The acceleration of gravity [m/s^2]."""
DimensionlessNumber = Annotated[
    float, BeforeValidator(collected(lambda value: parse(value, "number", ""))), _schema("number", ["number", "string"])
]
"""A number without unit; ``"5 %"`` is 0.05."""
AccelerationField = Annotated[
    Acceleration,
    PlainValidator(collected(lambda value: parse_acceleration(value, ""))),
    PlainSerializer(str, return_type=str, when_used="json-unless-none"),
    _schema("acceleration"),
]
"""An :class:`Acceleration`."""
PeakField = Annotated[
    Acceleration | float,
    PlainValidator(collected(lambda value: _peak(value))),
    PlainSerializer(
        lambda peak: f"{100.0 * peak:.15g} %" if isinstance(peak, float) else str(peak),
        return_type=str,
        when_used="json-unless-none",
    ),
    _schema("acceleration"),
]
"""An :class:`Acceleration`, or a share of another peak: ``"30 %"`` is 0.3."""
