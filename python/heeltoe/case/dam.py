"""What the user says about a dam, its crack, its water and what holds it: blocks of the case file.

All lengths, densities and so on are plain SI numbers here; the units are in the types of
:mod:`heeltoe.case.quantities`. What needs the geometry (is the crack in the section, is the water below the crest)
is checked by :func:`heeltoe.case.read.read_case`."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, model_validator

from heeltoe.case.fields import STEEPEST, Fields, Fraction, FrictionCoefficient, Head, Truth
from heeltoe.case.quantities import (
    Angle,
    Density,
    DimensionlessNumber,
    Length,
    LineForce,
    Pressure,
    Stiffness,
    Velocity,
)
from heeltoe.case.sentences import gathered
from heeltoe.errors import InputError, shown

#: The fields of an anchor that is given by its ends.
ANCHOR_ENDS = ("head_x", "head_elevation", "foot_x", "foot_elevation")
#: Of an anchor to the normal of the crack [rad].
STEEPEST_ANCHOR = 1.2


class Concrete(Fields):
    """The concrete. The rigid model needs its density alone."""

    density: Annotated[Density, Field(ge=100.0, le=2e4)] = Field(default="2400 kg/m^3", validate_default=True)
    """Density of the concrete; the default is that of mass concrete without tests (USACE EM 1110-2-2200)."""
    modulus: Annotated[Pressure, Field(gt=0.0, le=1e18)] | None = None
    """Young's modulus, dynamic; for the flexible model, which has no default for it."""
    poisson: Annotated[DimensionlessNumber, Field(ge=0.0, lt=0.5)] = 0.2
    """Poisson's ratio."""
    damping: Annotated[DimensionlessNumber, Field(ge=0.0, lt=1.0)] = 0.05
    """Damping ratio."""
    tensile_strength: Annotated[Pressure, Field(gt=0.0, le=1e8)] | None = None
    """Tensile strength, static; the largest tension of the flexible model is judged by it where it is given."""
    dynamic_tension: Annotated[DimensionlessNumber, Field(ge=1.0, le=3.0)] = 1.5
    """Tensile strength in an earthquake over the static one (Raphael, ACI Journal 81-17, 1984)."""


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
    """Of slip weakening: in proportion to the slip, or exponentially."""
    peak_friction: FrictionCoefficient | None = None
    """Coefficient of friction before any slip, or at rest."""
    residual_friction: FrictionCoefficient | None = None
    """Coefficient of friction that is left."""
    slip: Annotated[Length, Field(gt=0.0, le=100.0)] | None = None
    """Way, to and fro, over which friction or cohesion is lost, or of which exponential weakening leaves 1/e; cohesion
    without it is brittle and goes with the first slip."""
    speed: Annotated[Velocity, Field(gt=0.0, le=100.0)] | None = None
    """Speed of the slip that leaves 1/e of what friction loses with it."""
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
    """What the roughness of the surface adds: [normal stress, coefficient], straight in between, level beyond."""

    @model_validator(mode="after")
    @gathered
    def _options_of_the_law(self) -> Iterator[InputError]:
        needed, allowed = LAW_FIELDS[self.name]
        given = {field for field in self.model_fields_set - {"name"} if getattr(self, field) is not None}
        for field in type(self).model_fields:
            if field in given - {*needed, *allowed}:
                known = ", ".join((*needed, *allowed))
                yield InputError("law-option-foreign", field, shown(getattr(self, field)), law=self.name, known=known)
            if field in {*needed} - given:
                yield InputError("law-option-missing", field, law=self.name)
        peak, residual = self.peak_friction, self.residual_friction
        if peak is not None and residual is not None and peak < residual:
            yield InputError("law-order", "peak_friction", f"{peak:g}", residual=f"{residual:g}")
        yield from self._rough()

    def _rough(self) -> Iterator[InputError]:
        if self.roughness_friction is None:
            if self.name == "lift joint" and self.surface not in (None, "plane"):
                yield InputError("law-option-missing", "roughness_friction", law=f"{self.name}, {self.surface}")
            return
        if self.surface == "plane":
            yield InputError("contradiction", "surface", shown("plane"), other="roughness_friction")
        stresses = [stress for stress, _ in self.roughness_friction]
        if not stresses or any(a >= b for a, b in pairwise(stresses)):
            yield InputError("law-points", "roughness_friction", shown(stresses))
        basic = self.basic_friction or 0.0
        for (s0, r0), (s1, r1) in pairwise(self.roughness_friction):
            # The strength (mu + r(s)) s must not fall where the crack is pressed harder; its slope is least at the end.
            if s1 > s0 and basic + r1 + s1 * (r1 - r0) / (s1 - s0) < 0.0:
                yield InputError("law-falls", "roughness_friction", f"{s1:g} Pa")


class Crack(Fields):
    """The crack: a straight line through the section, with Coulomb friction or by a law."""

    elevation: Annotated[Length, Field(ge=0.0)] = Field(default="0 m", validate_default=True)
    """Height of the crack at the upstream face above the lowest point of the section."""
    inclination: Annotated[Angle, Field(ge=-STEEPEST, le=STEEPEST)] = Field(default="0 deg", validate_default=True)
    """Angle of the crack to the horizontal; positive where it rises downstream."""
    friction: FrictionCoefficient | None = None
    """Coefficient of friction, at rest and sliding."""
    static_friction: FrictionCoefficient | None = None
    """Coefficient of friction at rest, where it differs from that of sliding."""
    kinetic_friction: FrictionCoefficient | None = None
    """Coefficient of friction while sliding."""
    law: Law | None = None
    """A friction law, in place of the coefficients."""
    restitution: Fraction = 0.5
    """Newton's coefficient of restitution of a corner that strikes: 0 stays down, 1 loses nothing.
    The default is that of Zhu (2004)."""

    @model_validator(mode="after")
    @gathered
    def _one_friction(self) -> Iterator[InputError]:
        if self.law is None:
            yield from _frictions_agree(self)
            return
        names = ("friction", "static_friction", "kinetic_friction")
        yield from (
            InputError("fields-conflict", name, other="law") for name in names if getattr(self, name) is not None
        )

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
    """Walk what is wrong with the coefficients that a crack gives: one for both, or one of each."""
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
    flexible model alone knows several cracks; the static checks judge each as a section."""

    elevation: Annotated[Length, Field(ge=0.0)]
    """Height of the crack at the upstream face above the lowest point of the section."""
    inclination: Annotated[Angle, Field(ge=-STEEPEST, le=STEEPEST)] = Field(default="0 deg", validate_default=True)
    """Angle of the crack to the horizontal; positive where it rises downstream."""
    friction: FrictionCoefficient | None = None
    """Coefficient of friction, at rest and sliding."""
    static_friction: FrictionCoefficient | None = None
    """Coefficient of friction at rest, where it differs from that of sliding."""
    kinetic_friction: FrictionCoefficient | None = None
    """Coefficient of friction while sliding."""
    uplift: Literal["none", "uniform", "triangular"] | None = None
    """Pattern of the uplift in it, as `uplift.pattern` has it, where it is another one."""
    uplift_intensity: Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)] | None = None
    """Factor on the pressure in it, where it is another one."""

    @model_validator(mode="after")
    @gathered
    def _frictions(self) -> Iterator[InputError]:
        if self.friction is not None or self.static_friction is not None or self.kinetic_friction is not None:
            yield from _frictions_agree(self)

    def beside(self, crack: Crack) -> Crack:
        """Return it as a crack of its own."""
        names = ("friction", "static_friction", "kinetic_friction")
        given = {name: getattr(self, name) for name in names}
        own = given if any(value is not None for value in given.values()) else {}
        return crack.model_copy(update={"elevation": self.elevation, "inclination": self.inclination, **own})

    def wet(self, uplift: Uplift) -> Uplift:
        """Return the uplift in it."""
        changes: dict[str, object] = {}
        if self.uplift is not None and self.uplift != uplift.pattern:
            changes = dict.fromkeys((*UPLIFT_OPTIONS, "drain_x")) | {"pattern": self.uplift}
        if self.uplift_intensity is not None:
            changes["intensity"] = self.uplift_intensity
        return uplift.model_copy(update=changes)


class Water(Fields):
    """Still water on one side of the dam."""

    depth: Head
    """From the lowest point of the section to the water surface."""
    density: Annotated[Density, Field(ge=100.0, le=2e4)] = Field(default="1000 kg/m^3", validate_default=True)
    """Density of the water."""
    follows_vertical_motion: Truth = False
    """Its pressure on the faces grows and falls with the vertical motion, by the factor 1 + a_v / g, as under a
    column of water that moves with the ground."""
    virtual_mass_rotates: Truth = True
    """The virtual water of a rigid block resists its rotation as Westergaard's profile does along the face; or, as in
    Zhu (2004), as one mass at the height of its centre."""
    hydrodynamic: Literal["westergaard", "zangar"] = "westergaard"
    """Pressure of the water that moves with a rigid block, and of the pseudo-static checks: Westergaard's, less in
    proportion before each slope of the face; or Zangar's for a face of one slope."""


class Reservoir(Water):
    """Still water upstream, which may stand above the crest."""

    nappe: Literal["none", "weight", "falling"] = "none"
    """What water above the crest presses on it with: nothing; its full weight; or a weight that falls from the full one
    at the upstream edge of the crest to nothing at the downstream edge."""


class Ice(Fields):
    """Push of an ice cover on the upstream face, at all times."""

    force: Annotated[LineForce, Field(gt=0.0, le=1e8)]
    """Push downstream."""
    depth: Head = Field(default="0.3 m", validate_default=True)
    """Where it acts, below the water surface."""


class Silt(Fields):
    """Silt upstream, as a fluid that adds to the water's pressure (USBR, Design of Small Dams, 3rd edition, 8.9)."""

    depth: Head
    """From the lowest point of the section to the top of the silt."""
    horizontal_density: Annotated[Density, Field(ge=0.0, le=5e3)] = Field(default="360 kg/m^3", validate_default=True)
    """Of the fluid whose pressure is that of the silt sideways, the water taken off."""
    vertical_density: Annotated[Density, Field(ge=0.0, le=5e3)] = Field(default="920 kg/m^3", validate_default=True)
    """Of the silt that stands on a slope of the face, the water taken off."""


class Anchor(Fields):
    """An anchor or a row of bars across the crack, per metre of dam: by its place on the crack, or by its two ends."""

    distance: Annotated[Length, Field(ge=0.0)] | None = None
    """From the heel along the crack; the anchor moves where the crack is moved."""
    inclination: Annotated[Angle, Field(ge=-STEEPEST_ANCHOR, le=STEEPEST_ANCHOR)] = Field(
        default="0 deg", validate_default=True
    )
    """Of its axis to the normal of the crack; positive where its upper end leans downstream."""
    head_x: Length | None = None
    """Of its upper end, in place of `distance` and `inclination`, as are the next three: x of the section."""
    head_elevation: Length | None = None
    """Of its upper end, above the lowest point of the section."""
    foot_x: Length | None = None
    """Of its lower end."""
    foot_elevation: Length | None = None
    """Of its lower end; below zero in the rock."""
    prestress: Annotated[LineForce, Field(ge=0.0, le=1e9)] = Field(default="0 kN/m", validate_default=True)
    """Tension while the crack is closed and has not slipped."""
    axial_stiffness: Annotated[Stiffness, Field(ge=0.0, le=1e13)] = Field(default="0 MN/m/m", validate_default=True)
    """Tension it gains by opening along its axis: its EA over its free length. It takes no compression."""
    shear_stiffness: Annotated[Stiffness, Field(ge=0.0, le=1e13)] = Field(default="0 MN/m/m", validate_default=True)
    """Resistance it gains by slip, as a dowel."""
    capacity: Annotated[LineForce, Field(gt=0.0, le=1e9)] | None = None
    """Tension it is good for; more is warned about."""

    @model_validator(mode="after")
    @gathered
    def _sound(self) -> Iterator[InputError]:
        given = [name for name in ANCHOR_ENDS if getattr(self, name) is not None]
        if given:
            yield from (InputError("anchor-form", name) for name in ANCHOR_ENDS if name not in given)
            crack = [name for name in ("distance", "inclination") if name in self.model_fields_set]
            yield from (InputError("fields-conflict", name, other=given[0]) for name in crack)
        elif self.distance is None:
            yield InputError("anchor-form", "distance")
        if not (self.prestress or self.axial_stiffness or self.shear_stiffness):
            field = "distance" if not given else given[0]
            yield InputError("needs-other", field, other="prestress, axial_stiffness or shear_stiffness")

    @property
    def ends(self) -> tuple[tuple[float, float], tuple[float, float]] | None:
        """Head and foot (x, elevation) [m]; None of an anchor that is given by its place on the crack."""
        if self.head_x is None or self.head_elevation is None or self.foot_x is None or self.foot_elevation is None:
            return None
        return (self.head_x, self.head_elevation), (self.foot_x, self.foot_elevation)


UpliftPattern = Literal["none", "uniform", "triangular", "cut-off", "drained", "profile"]

#: Which option belongs to which pattern, and is needed there.
UPLIFT_OPTIONS = {
    "extent": "cut-off",
    "drain_position": "drained",
    "drain_efficiency": "drained",
    "points": "profile",
}

#: Two ways to say where drains are.
DRAINS = ("drain_position", "drain_x")


def pattern_of(name: object) -> object:
    """Return what a pattern of uplift is called here; anything else as it is."""
    return "cut-off" if name == "cut-off triangular" else name


class Uplift(Fields):
    """Water pressure in the crack. Without water above the crack only a `profile` gives any."""

    pattern: Annotated[UpliftPattern, BeforeValidator(pattern_of)] = "triangular"
    """`uniform`: the heel's head over the whole width; `triangular`: to the tailwater's at the toe;
    `cut-off`: to it at `extent`; `drained`: heel, drain, toe; `profile`: your own."""
    intensity: Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)] = 1.0
    """Factor on the pressure."""
    extent: Annotated[DimensionlessNumber, Field(gt=0.0, le=1.0)] | None = None
    """Of `cut-off`: the part of the crack width, from the heel, that is under pressure."""
    drain_position: Annotated[DimensionlessNumber, Field(gt=0.0, lt=1.0)] | None = None
    """Of `drained`: distance of the drains from the heel, as a part of the crack width."""
    drain_x: Length | None = None
    """Of `drained`, in place of `drain_position`: x of vertical drains in the section, which stay where they are when
    the crack is moved."""
    drain_efficiency: Fraction | None = None
    """Of `drained`: 0 leaves the heel's head at the drains, 1 brings it down to the tailwater's; USBR assumes
    2/3 for drains that work."""
    points: tuple[tuple[Fraction, Head], ...] | None = None
    """Of `profile`: [distance from the heel as a part of the width, head of water], from 0 to 1; straight in
    between, twice the same distance is a jump."""
    during_shaking: Literal["constant", "zero while open", "full while open", "follows opening"] = "constant"
    """What the pressure does where the crack opens in the earthquake: stays (USACE); vanishes (USBR); becomes the
    reservoir's; or falls as the water that is there fills the wider crack (after Javanmardi and others 2005)."""
    opening: Annotated[Length, Field(ge=1e-6, le=0.1)] | None = None
    """How far the crack opens until the pressure has vanished, is the reservoir's, or has fallen to half; a tenth of
    a millimetre where it is not given."""

    @model_validator(mode="after")
    @gathered
    def _options_of_the_pattern(self) -> Iterator[InputError]:
        for option, pattern in {**UPLIFT_OPTIONS, "drain_x": "drained"}.items():
            value = getattr(self, option)
            if value is not None and pattern != self.pattern:
                yield InputError("uplift-option-foreign", option, shown(value), pattern=self.pattern, owner=pattern)
            replaced = option in DRAINS and any(getattr(self, each) is not None for each in DRAINS)
            if value is None and pattern == self.pattern and not replaced and option != "drain_x":
                yield InputError("uplift-option-missing", option, pattern=pattern)
        if self.drain_position is not None and self.drain_x is not None:
            yield InputError("fields-conflict", "drain_position", other="drain_x")
        if self.points is not None:
            fractions = [fraction for fraction, _ in self.points]
            if len(fractions) < 2 or fractions[0] != 0.0 or fractions[-1] != 1.0 or fractions != sorted(fractions):
                yield InputError("uplift-profile", "points", shown(fractions))
        if self.during_shaking == "constant" and self.opening is not None:
            yield InputError("needs-other", "opening", other="a during_shaking that changes the pressure")
        if self.during_shaking in ("zero while open", "follows opening") and self.pattern == "none":
            yield InputError("contradiction", "during_shaking", shown(self.during_shaking), other='pattern = "none"')

    @property
    def opening_of_change(self) -> float:
        """Opening over which the pressure changes [m]."""
        return 1e-4 if self.opening is None else self.opening
