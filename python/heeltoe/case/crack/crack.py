"""The crack, and further ones beside it: the blocks ``[crack]`` and ``[[further_cracks]]``."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, model_validator

from heeltoe.case.crack.law import Law
from heeltoe.case.crack.roughness import Roughness
from heeltoe.case.dam import UPLIFT_OPTIONS, Uplift
from heeltoe.case.fields import STEEPEST, Fields, Fraction, FrictionCoefficient
from heeltoe.case.quantities import Angle, DimensionlessNumber, Length
from heeltoe.case.sentences import gathered
from heeltoe.errors import InputError, shown

#: Angle of friction along the mean plane of a crack [rad] that asperities and friction may have together.
STEEPEST_STRENGTH = math.radians(85.0)
# Fields that say what friction a crack has.
_COEFFICIENTS = ("friction", "static_friction", "kinetic_friction")
_FRICTION = (*_COEFFICIENTS, "law")


class Crack(Fields):
    """The crack: a line through the section, straight or with kinks, with Coulomb friction or by a law."""

    elevation: Annotated[Length, Field(ge=0.0)] = Field(default="0 m", validate_default=True)
    """Height of the crack at the upstream face above the lowest point of the section."""
    inclination: Annotated[Angle, Field(ge=-STEEPEST, le=STEEPEST)] = Field(default="0 deg", validate_default=True)
    """Angle of the crack to the horizontal; positive where it rises downstream."""
    kinks: tuple[tuple[Length, Length], ...] = ()
    """Corners of a crack that is not straight: [distance from the heel along the straight line from heel to toe, height
    above that line]. Of the models the flexible one alone knows them."""
    friction: FrictionCoefficient | None = None
    """Coefficient of friction, at rest and sliding."""
    static_friction: FrictionCoefficient | None = None
    """Coefficient of friction at rest, where it differs from that of sliding."""
    kinetic_friction: FrictionCoefficient | None = None
    """Coefficient of friction while sliding."""
    law: Law | None = None
    """A friction law, in place of the coefficients."""
    roughness: Roughness | None = None
    """Asperities that the block climbs and wears; the coefficients are those of their flanks then."""
    restitution: Fraction = 0.5
    """Newton's coefficient of restitution of a corner that strikes: 0 stays down, 1 loses nothing.
    The default is that of Zhu (2004)."""

    @model_validator(mode="after")
    @gathered
    def _one_friction(self) -> Iterator[InputError]:
        yield from _frictions_agree(self)

    @model_validator(mode="after")
    @gathered
    def _rough(self) -> Iterator[InputError]:
        if self.roughness is None:
            return
        if self.law is not None:
            yield InputError("rough-law", "roughness", shown(self.law.name))
        steep = math.atan(self.mu_static) + self.roughness.angle
        if steep >= STEEPEST_STRENGTH:
            yield InputError("rough-locks", "roughness.asperity_height", f"{math.degrees(steep):.3g} degrees")

    @property
    def apparent_friction(self) -> float:
        """Coefficient of friction along the mean plane before any slip; zero where a law says it."""
        if self.roughness is None:
            return self.mu_static
        # The tangent of the sum of both angles, by arithmetic alone: many cracks at once have arrays here.
        slope = self.roughness.slope
        return (self.mu_static + slope) / (1.0 - self.mu_static * slope)

    @property
    def mu_static(self) -> float:
        """Coefficient of friction at rest; zero where a law says it."""
        return self._coefficient(self.static_friction)

    @property
    def mu_kinetic(self) -> float:
        """Coefficient of friction while sliding; zero where a law says it."""
        return self._coefficient(self.kinetic_friction)

    def told(self) -> str:
        """Return its friction in words."""
        return f"friction {self.mu_kinetic:g}" if self.law is None else f"friction by {self.law.name}"

    def _coefficient(self, own: float | None) -> float:
        """Return the one of its own, or the one for both; zero where the case says neither."""
        given = self.friction if own is None else own
        return 0.0 if given is None else given


def _frictions_agree(crack: Crack | FurtherCrack) -> Iterator[InputError]:
    """Walk what is wrong with the friction that a crack gives: one coefficient for both, or one of each, or a law."""
    if crack.law is not None:
        for name in _COEFFICIENTS:
            if getattr(crack, name) is not None:
                yield InputError("fields-conflict", name, other="law")
        return
    pair = {"static_friction": crack.static_friction, "kinetic_friction": crack.kinetic_friction}
    given = {name: value for name, value in pair.items() if value is not None}
    if crack.friction is not None and given:
        yield InputError("fields-conflict", "friction", other=next(iter(given)))
    if crack.friction is None and len(given) < 2:
        yield InputError("friction-missing", next((name for name in pair if given and name not in given), "friction"))
    elif given and crack.friction is None and given["static_friction"] < given["kinetic_friction"]:
        static, kinetic = given["static_friction"], given["kinetic_friction"]
        yield InputError("friction-order", "static_friction", f"{static:g}", kinetic=f"{kinetic:g}")


class FurtherCrack(Fields):
    """One more crack, above or below that of `[crack]`; what it does not say of friction and uplift is as there. The
    flexible model knows any number of cracks, the rigid model two; the static checks judge each as a section."""

    elevation: Annotated[Length, Field(ge=0.0)]
    """Height of the crack at the upstream face above the lowest point of the section."""
    inclination: Annotated[Angle, Field(ge=-STEEPEST, le=STEEPEST)] = Field(default="0 deg", validate_default=True)
    """Angle of the crack to the horizontal; positive where it rises downstream."""
    kinks: tuple[tuple[Length, Length], ...] = ()
    """Its corners, as `crack.kinks` has them; none of a straight crack."""
    friction: FrictionCoefficient | None = None
    """Coefficient of friction, at rest and sliding."""
    static_friction: FrictionCoefficient | None = None
    """Coefficient of friction at rest, where it differs from that of sliding."""
    kinetic_friction: FrictionCoefficient | None = None
    """Coefficient of friction while sliding."""
    law: Law | None = None
    """A friction law of its own, in place of the coefficients."""
    uplift: Literal["none", "uniform", "triangular"] | None = None
    """Pattern of the uplift in it, as `uplift.pattern` has it, where it is another one."""
    uplift_intensity: Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)] | None = None
    """Factor on the pressure in it, where it is another one."""

    @model_validator(mode="after")
    @gathered
    def _one_friction(self) -> Iterator[InputError]:
        if self._given():
            yield from _frictions_agree(self)

    def beside(self, crack: Crack) -> Crack:
        """Return it as a crack of its own."""
        own = {name: getattr(self, name) for name in _FRICTION} if self._given() else {}
        place = {name: getattr(self, name) for name in ("elevation", "inclination", "kinks")}
        return crack.model_copy(update=place | own)

    def _given(self) -> bool:
        """Whether it has a friction of its own."""
        return any(getattr(self, name) is not None for name in _FRICTION)

    def wet(self, uplift: Uplift) -> Uplift:
        """Return the uplift in it."""
        changes: dict[str, object] = {}
        if self.uplift is not None and self.uplift != uplift.pattern:
            changes = dict.fromkeys((*UPLIFT_OPTIONS, "drain_x")) | {"pattern": self.uplift}
        if self.uplift_intensity is not None:
            changes["intensity"] = self.uplift_intensity
        return uplift.model_copy(update=changes)
