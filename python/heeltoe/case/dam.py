"""Dam, water, loads and anchors: blocks of the case file.

All lengths, densities and so on are plain SI numbers here; the units are in the types of
:mod:`heeltoe.case.quantities`. What needs the geometry (is the crack in the section, is the water below the crest)
is checked by :func:`heeltoe.case.read.read_case`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, model_validator

from heeltoe.case.fields import Fields, Fraction, Head, Truth
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
from heeltoe.errors.error import InputError, shown

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
    compressible: Truth | None = None
    """Sound travels in the water before an elastic dam, and leaves along the reservoir and through its floor, unless
    this is false: then the water is a mass that moves with the face."""
    wave_speed: Annotated[Velocity, Field(ge=100.0, le=1e5)] = Field(default="1440 m/s", validate_default=True)
    """Speed of sound in compressible water."""
    floor_reflection: Annotated[DimensionlessNumber, Field(ge=0.0, le=1.0)] = 0.9
    """Part of a pressure wave that the floor under compressible water throws back: 1 a rigid floor, 0.9 sound rock
    without sediment, less where there is some (Fenves and Chopra 1984)."""


class Reservoir(Water):
    """Still water upstream, which may stand above the crest."""

    nappe: Literal["none", "weight", "falling"] = "none"
    """Weight of the water above the crest: none; all of it; or linear from all of it at the upstream edge of the crest
    to none at the downstream edge."""


class Rock(Fields):
    """The rock below an elastic dam: a half-plane that the dam moves, and into which waves leave."""

    modulus: Annotated[Pressure, Field(ge=1e8, le=1e15)]
    """Young's modulus, dynamic."""
    poisson: Annotated[DimensionlessNumber, Field(ge=0.0, lt=0.5)] = 0.25
    """Poisson's ratio."""
    density: Annotated[Density, Field(ge=1000.0, le=5000.0)] = Field(default="2650 kg/m^3", validate_default=True)
    """Density of the rock."""
    damping: Annotated[DimensionlessNumber, Field(ge=0.0, le=0.2)] = 0.02
    """Damping ratio of the material at 5 Hz, in proportion to the stiffness; what leaves as waves comes on top."""
    radiation: Truth = True
    """Waves leave the rock; without it springs hold it far away, and nothing but its material damps."""
    bears_uplift: Truth = True
    """The water in a crack at the base presses on the rock as on the dam; without it the rock has settled to that
    water before."""
    massless: Truth = False
    """The rock has no mass, and so no waves, as in older practice; damping of the rock is its material's alone."""


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
    """Equivalent-fluid density for the horizontal pressure of silt (submerged)."""
    vertical_density: Annotated[Density, Field(ge=0.0, le=5e3)] = Field(default="920 kg/m^3", validate_default=True)
    """Density of the silt on a sloping face (submerged)."""


class Anchor(Fields):
    """An anchor or a row of bars across the crack, per metre of dam: by its place on the crack, or by its two ends."""

    distance: Annotated[Length, Field(ge=0.0)] | None = None
    """From the heel along the crack; the anchor moves where the crack is moved."""
    inclination: Annotated[Angle, Field(ge=-STEEPEST_ANCHOR, le=STEEPEST_ANCHOR)] = Field(
        default="0 deg", validate_default=True
    )
    """Angle of the axis to the normal of the crack; positive where the upper end leans downstream."""
    head_x: Length | None = None
    """x of the upper end; both ends replace `distance` and `inclination`."""
    head_elevation: Length | None = None
    """Elevation of the upper end above the lowest point of the section."""
    foot_x: Length | None = None
    """x of the lower end."""
    foot_elevation: Length | None = None
    """Elevation of the lower end; negative in the rock."""
    prestress: Annotated[LineForce, Field(ge=0.0, le=1e9)] = Field(default="0 kN/m", validate_default=True)
    """Tension while the crack is closed and has not slipped."""
    axial_stiffness: Annotated[Stiffness, Field(ge=0.0, le=1e13)] = Field(default="0 MN/m/m", validate_default=True)
    """Tension it gains by opening along its axis: its EA over its free length. It takes no compression."""
    shear_stiffness: Annotated[Stiffness, Field(ge=0.0, le=1e13)] = Field(default="0 MN/m/m", validate_default=True)
    """Resistance it gains by slip, as a dowel."""
    capacity: Annotated[LineForce, Field(gt=0.0, le=1e9)] | None = None
    """Force it is good for, tension and resistance to slip together; more is warned about."""

    @model_validator(mode="after")
    @gathered
    def _sound(self) -> Iterator[InputError]:
        ends = [name for name in ANCHOR_ENDS if getattr(self, name) is not None]
        if ends:
            yield from (
                InputError(
                    "missing", name, remedy="give distance, or head_x, head_elevation, foot_x and foot_elevation"
                )
                for name in ANCHOR_ENDS
                if name not in ends
            )
            crack = [name for name in ("distance", "inclination") if name in self.model_fields_set]
            yield from (InputError("fields-conflict", name, other=ends[0]) for name in crack)
        elif self.distance is None:
            yield InputError(
                "missing", "distance", remedy="give distance, or head_x, head_elevation, foot_x and foot_elevation"
            )
        if not (self.prestress or self.yields):
            field = "distance" if not ends else ends[0]
            yield InputError("needs-other", field, other="prestress, axial_stiffness or shear_stiffness")

    @property
    def yields(self) -> bool:
        """Whether its force changes as the crack moves."""
        return bool(self.axial_stiffness or self.shear_stiffness)

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
    """Return the name of a pattern of uplift; other words unchanged."""
    return "cut-off" if name == "cut-off triangular" else name


class Uplift(Fields):
    """Water pressure in the crack. Without water above the crack only a `profile` gives any."""

    pattern: Annotated[UpliftPattern, BeforeValidator(pattern_of)] = "triangular"
    """`uniform`: the heel's head over the whole width; `triangular`: to the tailwater's at the toe;
    `cut-off`: to it at `extent`; `drained`: heel, drain, toe; `profile`: your own."""
    intensity: Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)] = 1.0
    """Factor on the pressure."""
    extent: Annotated[DimensionlessNumber, Field(gt=0.0, le=1.0)] | None = None
    """`cut-off`: part of the crack width, from the heel, that is under pressure."""
    drain_position: Annotated[DimensionlessNumber, Field(gt=0.0, lt=1.0)] | None = None
    """`drained`: distance of the drains from the heel, as a part of the crack width."""
    drain_x: Length | None = None
    """`drained`, in place of `drain_position`: x of vertical drains in the section; they stay there when the crack is
    moved."""
    drain_efficiency: Fraction | None = None
    """`drained`: 0 leaves the heel's head at the drains, 1 brings it down to the tailwater's; USBR assumes 2/3 for
    drains that work."""
    points: tuple[tuple[Fraction, Head], ...] | None = None
    """`profile`: [distance from the heel as a part of the width, head of water], from 0 to 1; linear in between, the
    same distance twice is a jump."""
    during_shaking: Literal["constant", "zero while open", "full while open", "follows opening"] = "constant"
    """Pressure where the crack opens in the earthquake: constant (USACE); zero (USBR); the reservoir's; or lower, as
    the same water fills a wider crack (after Javanmardi and others 2005)."""
    opening: Annotated[Length, Field(ge=1e-6, le=0.1)] | None = None
    """How far the crack opens until the pressure has vanished, is the reservoir's, or has fallen to half; a tenth of
    a millimetre where it is not given."""

    @model_validator(mode="after")
    @gathered
    def _options_of_the_pattern(self) -> Iterator[InputError]:
        for option, pattern in {**UPLIFT_OPTIONS, "drain_x": "drained"}.items():
            value = getattr(self, option)
            if value is not None and pattern != self.pattern:
                yield InputError(
                    "option-foreign",
                    option,
                    shown(value),
                    owner=f'the pattern "{self.pattern}"',
                    remedy=f' or choose the pattern "{pattern}"',
                )
            replaced = option in DRAINS and any(getattr(self, name) is not None for name in DRAINS)
            if value is None and pattern == self.pattern and not replaced and option != "drain_x":
                yield InputError("option-missing", option, owner=f'the pattern "{pattern}"')
        if self.drain_position is not None and self.drain_x is not None:
            yield InputError("fields-conflict", "drain_position", other="drain_x")
        if self.points is not None:
            fractions = [fraction for fraction, _ in self.points]
            if len(fractions) < 2 or fractions[0] != 0.0 or fractions[-1] != 1.0 or fractions != sorted(fractions):
                yield InputError(
                    "not-ascending",
                    "points",
                    shown(fractions),
                    what="the distances",
                    remedy="them from the heel at 0 to the toe at 1",
                )
        if self.during_shaking == "constant" and self.opening is not None:
            yield InputError("needs-other", "opening", other="a during_shaking that changes the pressure")
        if self.during_shaking in ("zero while open", "follows opening") and self.pattern == "none":
            yield InputError("contradiction", "during_shaking", shown(self.during_shaking), other='pattern = "none"')

    @property
    def opening_of_change(self) -> float:
        """Opening over which the pressure changes [m]."""
        return 1e-4 if self.opening is None else self.opening
