"""Lift joints that are all bonded alike: the block `[joints]` of a case file, read as the list of its cracks."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, TypeVar

from pydantic import Field, ValidationError

from heeltoe.case.crack.bond import Bond
from heeltoe.case.crack.crack import Crack
from heeltoe.case.fields import Fields, FrictionCoefficient
from heeltoe.case.quantities import Length
from heeltoe.case.section import Section
from heeltoe.case.sentences import all_errors
from heeltoe.errors.error import InputError, shown

M = TypeVar("M", bound=Fields)

#: Its name in a file.
JOINTS = "joints"
#: What it says, in words.
JOINTS_MEANING = (
    "Lift joints at equal distances, all with the same bond, in place of `crack` and `cracks`: a file has them as one "
    "block, a case as the list of its cracks from the crest down."
)
#: More joints are a slip of the pen: lifts of 1.5 m in a dam of 150 m.
MOST_JOINTS = 100
# A joint nearer to the crest than this part of a lift leaves no lift above it.
_LEAST_LIFT = 0.5
# Levels that differ by less than this part of a lift are one.
_ROUNDING = 1e-9
_LEVELS = ("every", "lowest", "highest")


class Joints(Fields):
    """Lift joints at equal distances, all with the same bond."""

    every: Annotated[Length, Field(ge=0.1, le=1e3)]
    """Height of a lift, from joint to joint."""
    lowest: Annotated[Length, Field(ge=0.0)] = Field(default="0 m", validate_default=True)
    """Height of the lowest joint above the lowest point of the section; 0 is the base."""
    highest: Annotated[Length, Field(ge=0.0)] | None = None
    """No joint is higher than this; without it joints go up to half a lift below the crest."""
    friction: FrictionCoefficient | None = None
    """Coefficient of friction of the cracked part, at rest and sliding."""
    static_friction: FrictionCoefficient | None = None
    """Coefficient of friction at rest, where it differs from that of sliding."""
    kinetic_friction: FrictionCoefficient | None = None
    """Coefficient of friction while sliding."""
    bond: Bond
    """The bond of each joint."""


def joints_as_cracks(fields: dict[str, object]) -> dict[str, object]:
    """Return the fields of a case with its block of joints as the list of its cracks; other fields unchanged.

    Raises
    ------
    InputError
        Where a crack stands beside the block, or something in it cannot be used.
    """
    if fields.get(JOINTS) is None:
        return fields
    for beside in ("crack", "cracks", "further_cracks"):
        if beside in fields:
            raise InputError("fields-conflict", JOINTS, other=beside)
    block = fields[JOINTS]
    if not isinstance(block, Mapping):
        raise InputError("wrong-type", JOINTS, shown(block), expected="a block of fields, [joints]")
    own = {name: value for name, value in block.items() if name not in _LEVELS}
    joints = _checked(Joints, block)
    # What a crack says of its friction and bond together.
    _checked(Crack, own)
    rest = {name: value for name, value in fields.items() if name != JOINTS}
    levels = _levels(joints, fields.get("section"))
    return rest | {"cracks": [{"elevation": f"{level!r} m"} | own for level in levels]}


def _checked(model: type[M], block: Mapping[str, object]) -> M:
    try:
        return model.model_validate(block)
    except ValidationError as complaint:
        errors = all_errors(complaint, model)
    for error in errors:
        error.field = f"{JOINTS}.{error.field}"
    raise errors[0].with_others(errors[1:])


def _levels(joints: Joints, section: Any) -> list[float]:
    """Return the heights of joints from the crest down [m]."""
    highest = _highest(joints, section)
    count = math.floor((highest - joints.lowest) / joints.every + _ROUNDING) + 1
    if count > MOST_JOINTS:
        raise InputError(
            "too-many",
            f"{JOINTS}.every",
            f"{count} joints",
            most=f"{MOST_JOINTS}: give higher lifts, or joints.lowest and joints.highest around those that matter",
        )
    if count < 1:
        raise InputError(
            "above-other", f"{JOINTS}.lowest", f"{joints.lowest:g} m", other="the highest joint", most=f"{highest:g} m"
        )
    return [joints.lowest + place * joints.every for place in reversed(range(count))]


def _highest(joints: Joints, section: Any) -> float:
    """Return up to where there are joints [m]: with a section that is itself wrong there is one."""
    if joints.highest is not None:
        return joints.highest
    try:
        levels = [z for _, z in Section.model_validate(section).vertices()]
    except ValidationError:
        return joints.lowest
    return max(levels) - min(levels) - _LEAST_LIFT * joints.every
