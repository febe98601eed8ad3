"""Cracks: the list `[[cracks]]`, or the blocks `[crack]` and `[[further_cracks]]`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from heeltoe.case.crack.band import Band
from heeltoe.case.crack.bond import Bond
from heeltoe.case.crack.law import Law
from heeltoe.case.crack.roughness import Roughness
from heeltoe.case.dam import UPLIFT_OPTIONS, Uplift
from heeltoe.case.fields import STEEPEST, Fields, Fraction, FrictionCoefficient
from heeltoe.case.quantities import Angle, DimensionlessNumber, Length
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError, shown

#: Largest sum of the angles of friction and of the asperities along the mean plane of a crack [rad].
STEEPEST_STRENGTH = math.radians(85.0)
_COEFFICIENTS = ("friction", "static_friction", "kinetic_friction")
#: A part above a crack that no neighbour stops.
FREE = "free"
#: Fields that state the friction of a crack.
FRICTION = (*_COEFFICIENTS, "law")


def _both_sides(value: object) -> object:
    """Return the gaps on both sides of a part that slides across the valley."""
    if value == FREE:
        return None
    return (value, value) if isinstance(value, str | int | float) else value


class CrackFields(Fields):
    """Fields of every crack."""

    elevation: Annotated[Length, Field(ge=0.0)] = Field(default="0 m", validate_default=True)
    """Height of the crack at the upstream face above the lowest point of the section."""
    inclination: Annotated[Angle, Field(ge=-STEEPEST, le=STEEPEST)] = Field(default="0 deg", validate_default=True)
    """Angle of the crack to the horizontal; positive where it rises downstream."""
    kinks: tuple[tuple[Length, Length], ...] = ()
    """Corners of a crack that is not straight: [distance from the heel along the straight line from heel to toe, height
    above that line]. Only the flexible model supports them."""
    friction: FrictionCoefficient | None = None
    """Coefficient of friction, at rest and sliding."""
    static_friction: FrictionCoefficient | None = None
    """Coefficient of friction at rest, where it differs from that of sliding."""
    kinetic_friction: FrictionCoefficient | None = None
    """Coefficient of friction while sliding."""
    law: Law | None = None
    """A friction law, in place of the coefficients."""
    bond: Bond | None = None
    """The bond of a joint that is not cracked before the earthquake. The flexible model cracks it step by
    step; a rigid block bears it as a whole or loses it."""
    restitution: Fraction | None = None
    """Newton's coefficient of restitution of a corner that strikes: 0 stays down, 1 loses nothing."""
    uplift: Literal["none", "uniform", "triangular"] | None = None
    """Pattern of uplift of one of several cracks, where it differs from `uplift.pattern`."""
    uplift_intensity: Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)] | None = None
    """Factor on the uplift of one of several cracks, where it differs from `uplift.intensity`."""

    @model_validator(mode="after")
    @gathered
    def _one_friction(self) -> Iterator[InputError]:
        if self.law is not None:
            for name in _COEFFICIENTS:
                if getattr(self, name) is not None:
                    yield InputError("fields-conflict", name, other="law")
            return
        if self.friction_is_inherited:
            return
        pair = {"static_friction": self.static_friction, "kinetic_friction": self.kinetic_friction}
        stated = {name: value for name, value in pair.items() if value is not None}
        if self.friction is not None and stated:
            yield InputError("fields-conflict", "friction", other=next(iter(stated)))
        if self.friction is None and len(stated) < 2:
            missing = next((name for name in pair if stated and name not in stated), "friction")
            yield InputError("missing", missing, remedy="give friction, or both static_friction and kinetic_friction")
        elif stated and self.friction is None and stated["static_friction"] < stated["kinetic_friction"]:
            static, kinetic = stated["static_friction"], stated["kinetic_friction"]
            yield InputError(
                "below-other", "static_friction", f"{static:g}", other="kinetic_friction", least=f"{kinetic:g}"
            )

    @model_validator(mode="after")
    @gathered
    def _bond_within_the_line(self) -> Iterator[InputError]:
        wrong = self.bond_misfit()
        if wrong is not None:
            yield wrong

    def bond_misfit(self, crack: str = "") -> InputError | None:
        """Return what is wrong with a bond beside the friction; friction that is inherited is not known here."""
        if self.bond is None or self.law is not None:
            return None
        least = max(self.mu_static, self.mu_kinetic) * self.bond.tensile_strength
        if self.bond.cohesion >= least:
            return None
        return InputError("bond-apex", f"{crack}bond.cohesion", f"{self.bond.cohesion:g} Pa", least=f"{least:g} Pa")

    @property
    def friction_is_inherited(self) -> bool:
        """Whether the friction is that of the first crack."""
        return False

    @property
    def mu_static(self) -> float:
        """Coefficient of friction at rest; zero where a law gives the friction."""
        return self._coefficient(self.static_friction)

    @property
    def mu_kinetic(self) -> float:
        """Coefficient of friction while sliding; zero where a law gives the friction."""
        return self._coefficient(self.kinetic_friction)

    def _coefficient(self, own: float | None) -> float:
        value = self.friction if own is None else own
        return 0.0 if value is None else value

    def uplift_of(self, uplift: Uplift) -> Uplift:
        """Return the uplift of this crack: the one of the case, changed as the crack states."""
        changes: dict[str, object] = {}
        if self.uplift is not None and self.uplift != uplift.pattern:
            changes = dict.fromkeys((*UPLIFT_OPTIONS, "drain_x")) | {"pattern": self.uplift}
        if self.uplift_intensity is not None:
            changes["intensity"] = self.uplift_intensity
        return uplift.model_copy(update=changes)


class Crack(CrackFields):
    """A line through the section, straight or with kinks, with Coulomb friction or a friction law."""

    restitution: Fraction = 0.5
    """Newton's coefficient of restitution of a corner that strikes: 0 stays down, 1 loses nothing.
    The default is that of Zhu (2004)."""
    side_gap: Annotated[
        tuple[Annotated[Length, Field(ge=0.0, le=10.0)], Annotated[Length, Field(ge=0.0, le=10.0)]] | None,
        BeforeValidator(_both_sides),
        WithJsonSchema({"type": ["string", "array", "null"], "quantity": "length", "examples": ["3 mm"]}),
    ] = None
    """How far the part above can slide across the valley until its neighbours stop it, to the left and to the right
    bank: the sum of the joints between it and either abutment. One length counts for both sides, "0 mm" holds it,
    "free" has no neighbours. A neighbour on one side alone: "10 m" for the other."""
    rocking_loss: Fraction = 0.0
    """Part of the velocity of rocking that an impact from one corner to the other takes beyond the law of impacts. With
    `restitution = 0` that law is Housner's for a slender block, and tests on concrete found 0.03 to 0.05."""
    roughness: Roughness | None = None
    """Asperities that the block climbs and wears; the coefficients are then those of the flanks."""
    band: Band | None = None
    """Other frictions: a run for each, and which of them the limits judge."""
    fit: str | None = Field(default=None, strict=True, min_length=1)
    """File that `heeltoe law fit` has written, law-fit.toml, relative to the case file; read once, into the friction
    and `band`."""

    @model_validator(mode="after")
    @gathered
    def _fit_read(self) -> Iterator[InputError]:
        if self.fit is not None:
            # The contents of a file replace these fields before they are read.
            yield InputError("section-file-unread", "fit", shown(self.fit))

    @model_validator(mode="after")
    @gathered
    def _around_the_friction(self) -> Iterator[InputError]:
        if self.band is None:
            return
        crack = "the friction of the crack"
        for name in ("slip_weakening", "speed_weakening"):
            fall = getattr(self.band, name)
            if fall is not None and self.law is not None:
                yield InputError(
                    "option-foreign",
                    f"band.{name}",
                    owner="a crack with a friction law, which falls by itself",
                    remedy=", or give crack.friction instead of the law",
                )
            elif fall is not None and fall.residual_friction > self.mu_static:
                field, residual = f"band.{name}.residual_friction", f"{fall.residual_friction:g}"
                yield InputError("above-other", field, residual, other=crack, most=f"{self.mu_static:g}")
        if self.law is None:
            low, high = self.band.low, self.band.high
            if low is not None and low > self.mu_kinetic:
                yield InputError("above-other", "band.low", f"{low:g}", other=crack, most=f"{self.mu_kinetic:g}")
            if high is not None and high < self.mu_static:
                yield InputError("below-other", "band.high", f"{high:g}", other=crack, least=f"{self.mu_static:g}")

    @model_validator(mode="after")
    @gathered
    def _rough(self) -> Iterator[InputError]:
        if self.roughness is None:
            return
        steep = math.atan(self.mu_static) + self.roughness.angle
        if steep >= STEEPEST_STRENGTH:
            yield InputError("rough-locks", "roughness.asperity_height", f"{math.degrees(steep):.3g} degrees")

    @property
    def apparent_friction(self) -> float:
        """Coefficient of friction along the mean plane before any slip; zero where a law gives it."""
        if self.roughness is None:
            return self.mu_static
        # The tangent of the sum of both angles, by arithmetic alone: the fields may be columns of many dams.
        slope = self.roughness.slope
        return (self.mu_static + slope) / (1.0 - self.mu_static * slope)

    def friction_text(self) -> str:
        """Return its friction in words."""
        return f"friction {self.mu_kinetic:g}" if self.law is None else f"friction by {self.law.name}"


class FurtherCrack(CrackFields):
    """One of several cracks, above or below the others. Friction and restitution that it does not state are those of
    the first crack of the file, uplift that it does not state is that of `[uplift]`. The flexible model supports any
    number of cracks, the rigid model two; the static checks judge each crack as a section."""

    elevation: Annotated[Length, Field(ge=0.0)]
    """Height of the crack at the upstream face above the lowest point of the section."""

    @property
    def friction_is_inherited(self) -> bool:
        """Whether the friction is that of the first crack."""
        return all(getattr(self, name) is None for name in FRICTION)

    def beside(self, first: Crack) -> Crack:
        """Return it as an independent crack, with the fields that it takes from the first one."""
        own = {
            name: getattr(self, name)
            for name in ("elevation", "inclination", "kinks", "uplift", "uplift_intensity", "bond")
        }
        if not self.friction_is_inherited:
            own |= {name: getattr(self, name) for name in FRICTION}
        if self.restitution is not None:
            own["restitution"] = self.restitution
        return first.model_copy(update=own)
