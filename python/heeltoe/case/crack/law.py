"""Friction laws: the block ``[crack.law]``."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, model_validator

from heeltoe.case.fields import Fields, FrictionCoefficient
from heeltoe.case.quantities import Angle, DimensionlessNumber, Length, Pressure, Velocity
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError, shown

LawName = Literal["slip weakening", "speed weakening", "cohesion", "barton-bandis", "lift joint"]

#: What each law needs, and what it may have beside that.
LAW_FIELDS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "slip weakening": (("peak_friction", "residual_friction", "slip"), ("form",)),
    "speed weakening": (("peak_friction", "residual_friction", "speed"), ()),
    "cohesion": (("cohesion", "residual_friction"), ("slip",)),
    "barton-bandis": (("jrc", "jcs", "residual_angle"), ()),
    "lift joint": (("basic_friction", "surface"), ("roughness_friction",)),
}
_STEEPEST_FRICTION = 1.0471976  # 60 degrees


class Law(Fields):
    """A friction law of the crack, in place of its constant coefficients."""

    name: LawName
    """Which law: `slip weakening` and `speed weakening` from a peak to a residual coefficient; `cohesion` that is lost;
    `barton-bandis` and `lift joint`, whose coefficient falls with the normal stress."""
    form: Literal["linear", "exponential"] = "linear"
    """Form of slip weakening: in proportion to the slip, or exponential."""
    peak_friction: FrictionCoefficient | None = None
    """Coefficient of friction before any slip, or at rest."""
    residual_friction: FrictionCoefficient | None = None
    """Coefficient of friction that is left."""
    slip: Annotated[Length, Field(gt=0.0, le=100.0)] | None = None
    """Accumulated slip over which friction or cohesion is lost, or after which exponential weakening has left 1/e;
    cohesion without it is brittle and is lost with the first slip."""
    speed: Annotated[Velocity, Field(gt=0.0, le=100.0)] | None = None
    """Speed of slip at which friction has lost all but 1/e of its total loss."""
    cohesion: Annotated[Pressure, Field(ge=0.0, le=1e8)] | None = None
    """Shear stress that the whole bond bears without a normal one; a corner that lifts breaks the bond."""
    jrc: Annotated[DimensionlessNumber, Field(ge=0.0, le=20.0)] | None = None
    """Joint roughness coefficient, 0 (smooth) to 20, for the length of the crack."""
    jcs: Annotated[Pressure, Field(gt=0.0, le=1e9)] | None = None
    """Compressive strength of the walls of the joint, for the length of the crack."""
    residual_angle: Annotated[Angle, Field(ge=0.0, le=_STEEPEST_FRICTION)] | None = None
    """Residual angle of friction."""
    surface: Literal["monolithic", "water-blasted", "untreated", "plane"] | None = None
    """How the surface of the lift was prepared; on a `plane` one nothing is rough."""
    basic_friction: FrictionCoefficient | None = None
    """Coefficient of friction of the plane surface."""
    roughness_friction: tuple[tuple[Annotated[Pressure, Field(ge=0.0, le=1e9)], FrictionCoefficient], ...] | None = None
    """Coefficient that the roughness of the surface adds: [normal stress, coefficient], linear in between, constant
    beyond."""

    @model_validator(mode="after")
    @gathered
    def _options_of_the_law(self) -> Iterator[InputError]:
        needed, allowed = LAW_FIELDS[self.name]
        stated = {field for field in self.model_fields_set - {"name"} if getattr(self, field) is not None}
        for field in type(self).model_fields:
            if field in stated - {*needed, *allowed}:
                known = ", ".join((*needed, *allowed))
                yield InputError(
                    "option-foreign",
                    field,
                    shown(getattr(self, field)),
                    owner=f'the law "{self.name}"',
                    remedy=f"; that law knows {known}",
                )
            if field in {*needed} - stated:
                yield InputError("option-missing", field, owner=f'the law "{self.name}"')
        peak, residual = self.peak_friction, self.residual_friction
        if peak is not None and residual is not None and peak < residual:
            yield InputError(
                "below-other", "peak_friction", f"{peak:g}", other="residual_friction", least=f"{residual:g}"
            )
        yield from self._rough()

    def _rough(self) -> Iterator[InputError]:
        if self.roughness_friction is None:
            if self.name == "lift joint" and self.surface not in (None, "plane"):
                yield InputError("option-missing", "roughness_friction", owner=f'the law "{self.name}, {self.surface}"')
            return
        if self.surface == "plane":
            yield InputError("contradiction", "surface", shown("plane"), other="roughness_friction")
        stresses = [stress for stress, _ in self.roughness_friction]
        if not stresses or any(a >= b for a, b in pairwise(stresses)):
            yield InputError(
                "not-ascending",
                "roughness_friction",
                shown(stresses),
                what="the normal stresses",
                remedy="the points in order, each stress once",
            )
        basic = self.basic_friction or 0.0
        for (s0, r0), (s1, r1) in pairwise(self.roughness_friction):
            # The strength (mu + r(s)) s must not fall where the crack is pressed harder; its slope is least at the end.
            if s1 > s0 and basic + r1 + s1 * (r1 - r0) / (s1 - s0) < 0.0:
                yield InputError("law-falls", "roughness_friction", f"{s1:g} Pa")
