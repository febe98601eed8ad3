"""What the user says about a dam, its crack, its water and the earthquake: the models behind the case file.

All lengths, densities and so on are plain SI numbers here; the units are in the types of
:mod:`heeltoe.units.parse`. What needs the geometry (is the crack in the section, is the water below the crest)
is checked by :func:`heeltoe.case.read.read_case`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import shapely
from pydantic import BeforeValidator, Field, PrivateAttr, model_validator

from heeltoe.case.fields import (
    LARGEST_ACCELERATION,
    STEEPEST,
    Block,
    Channel,
    Fraction,
    FrictionCoefficient,
    Head,
    Time,
    TimeSpan,
    Truth,
)
from heeltoe.case.options import Analysis, Decoupled, Flexible, Limits, Statics
from heeltoe.case.processing import ProcessingStep
from heeltoe.case.sentences import collected
from heeltoe.errors import InputError, shown
from heeltoe.geometry.section import CutSection, cut, outline
from heeltoe.shown import Shown
from heeltoe.units.parse import (
    STANDARD_GRAVITY,
    AccelerationField,
    Angle,
    Density,
    DimensionlessNumber,
    Gravity,
    Length,
    LineForce,
    Pressure,
    Stiffness,
    acceleration_unit,
)


class Section(Block):
    """The section of the dam: five dimensions, or any polygon; x points downstream, z up.

    The dimensions describe a dam with a vertical upstream face at x = 0. Its downstream face runs straight
    from the base to the neck and straight on to the crest (Zhu 2004); without a neck it is one straight line.
    """

    height: Annotated[Length, Field(gt=0.0)] | None = None
    """From the base to the crest."""
    crest_width: Annotated[Length, Field(ge=0.0)] | None = None
    """Width at the crest."""
    neck_height: Annotated[Length, Field(gt=0.0)] | None = None
    """From the base to the neck, where the slope of the downstream face changes."""
    neck_width: Annotated[Length, Field(gt=0.0)] | None = None
    """Width at the neck."""
    base_width: Annotated[Length, Field(gt=0.0)] | None = None
    """Width at the base."""
    polygon: tuple[tuple[Length, Length], ...] | None = None
    """Corners [x, z] in order around the section, either way."""

    @model_validator(mode="after")
    @collected
    def _one_form(self) -> Self:
        form = {"height": self.height, "crest_width": self.crest_width, "base_width": self.base_width}
        neck = {"neck_height": self.neck_height, "neck_width": self.neck_width}
        given = [name for name, value in (form | neck).items() if value is not None]
        if self.polygon is not None and given:
            raise InputError("fields-conflict", given[0], other="polygon")
        if self.polygon is not None:
            return self
        # Half a neck is a slip of the pen, no neck is a plain trapezoid.
        wanted = form | neck if neck.keys() & set(given) else form
        for name, value in wanted.items():
            if value is None:
                raise InputError("section-incomplete", name, fields=", ".join(wanted))
        if self.neck_height is not None and self.height is not None and self.neck_height > self.height:
            raise InputError("neck-above-crest", "neck_height", f"{self.neck_height:g} m", height=f"{self.height:g} m")
        return self

    def vertices(self) -> tuple[tuple[float, float], ...]:
        """Return the corners (x, z) [m] around the section, as given or counter-clockwise from the heel."""
        if self.polygon is not None:
            return self.polygon
        # The validator has seen that these are there.
        assert self.height is not None
        assert self.crest_width is not None
        assert self.base_width is not None
        neck = () if self.neck_width is None or self.neck_height is None else ((self.neck_width, self.neck_height),)
        return (0.0, 0.0), (self.base_width, 0.0), *neck, (self.crest_width, self.height), (0.0, self.height)


class Concrete(Block):
    """The concrete. The rigid model needs its density alone."""

    density: Annotated[Density, Field(ge=100.0, le=2e4)] = Field(default="2400 kg/m^3", validate_default=True)
    """Mass concrete without tests: 150 lb/ft^3 (USACE EM 1110-2-2200)."""
    modulus: Annotated[Pressure, Field(gt=0.0, le=1e18)] | None = None
    """Young's modulus, dynamic; for the flexible model, which has no default for it."""
    poisson: Annotated[DimensionlessNumber, Field(ge=0.0, lt=0.5)] = 0.2
    """Poisson's ratio."""
    damping: Annotated[DimensionlessNumber, Field(ge=0.0, lt=1.0)] = 0.05
    """Damping ratio."""


class Crack(Block):
    """The crack: a straight line through the section, with Coulomb friction."""

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
    restitution: Fraction = 0.5
    """Newton's coefficient of restitution of a corner that strikes: 0 stays down, 1 loses nothing.
    The default is that of Zhu (2004)."""

    @model_validator(mode="after")
    @collected
    def _one_friction(self) -> Self:
        pair = {"static_friction": self.static_friction, "kinetic_friction": self.kinetic_friction}
        given = [name for name, value in pair.items() if value is not None]
        if self.friction is not None and given:
            raise InputError("fields-conflict", "friction", other=given[0])
        if self.friction is None and len(given) < 2:
            missing = next((name for name in pair if given and name not in given), "friction")
            raise InputError("friction-missing", missing)
        if self.mu_static < self.mu_kinetic:
            raise InputError("friction-order", "static_friction", f"{self.mu_static:g}", kinetic=f"{self.mu_kinetic:g}")
        return self

    @property
    def mu_static(self) -> float:
        """Coefficient of friction at rest."""
        return self.static_friction if self.static_friction is not None else self.friction or 0.0

    @property
    def mu_kinetic(self) -> float:
        """Coefficient of friction while sliding."""
        return self.kinetic_friction if self.kinetic_friction is not None else self.friction or 0.0


class Water(Block):
    """Still water on one side of the dam."""

    depth: Head
    """From the lowest point of the section to the water surface."""
    density: Annotated[Density, Field(ge=100.0, le=2e4)] = Field(default="1000 kg/m^3", validate_default=True)
    """Density of the water."""
    follows_vertical_motion: Truth = False
    """Its pressure on the faces grows and falls with the vertical motion, by the factor 1 + a_v / g, as under a
    column of water that moves with the ground."""


class Ice(Block):
    """Push of an ice cover on the upstream face, at all times."""

    force: Annotated[LineForce, Field(gt=0.0, le=1e8)]
    """Push downstream."""
    depth: Head = Field(default="0.3 m", validate_default=True)
    """Where it acts, below the water surface."""


class Silt(Block):
    """Silt upstream, as a fluid that adds to the water's pressure (USBR, Design of Small Dams, 3rd edition, 8.9)."""

    depth: Head
    """From the lowest point of the section to the top of the silt."""
    horizontal_density: Annotated[Density, Field(ge=0.0, le=5e3)] = Field(default="360 kg/m^3", validate_default=True)
    """Of the fluid whose pressure is that of the silt sideways, the water taken off."""
    vertical_density: Annotated[Density, Field(ge=0.0, le=5e3)] = Field(default="920 kg/m^3", validate_default=True)
    """Of the silt that stands on a slope of the face, the water taken off."""


class Anchor(Block):
    """An anchor or a row of bars across the crack, per metre of dam."""

    distance: Annotated[Length, Field(ge=0.0)]
    """From the heel along the crack."""
    inclination: Annotated[Angle, Field(ge=-1.2, le=1.2)] = Field(default="0 deg", validate_default=True)
    """Of its axis to the normal of the crack; positive where its upper end leans downstream."""
    prestress: Annotated[LineForce, Field(ge=0.0, le=1e9)] = Field(default="0 kN/m", validate_default=True)
    """Tension while the crack is closed and has not slipped."""
    axial_stiffness: Annotated[Stiffness, Field(ge=0.0, le=1e13)] = Field(default="0 MN/m/m", validate_default=True)
    """Tension it gains by opening along its axis: its EA over its free length. It takes no compression."""
    shear_stiffness: Annotated[Stiffness, Field(ge=0.0, le=1e13)] = Field(default="0 MN/m/m", validate_default=True)
    """Resistance it gains by slip, as a dowel."""
    capacity: Annotated[LineForce, Field(gt=0.0, le=1e9)] | None = None
    """Tension it is good for; more is warned about."""

    @model_validator(mode="after")
    @collected
    def _does_something(self) -> Self:
        if not (self.prestress or self.axial_stiffness or self.shear_stiffness):
            raise InputError("needs-other", "distance", other="prestress, axial_stiffness or shear_stiffness")
        return self


UpliftPattern = Literal["none", "uniform", "triangular", "cut-off", "drained", "profile"]

# Which option belongs to which pattern, and is needed there.
_UPLIFT_OPTIONS = {
    "extent": "cut-off",
    "drain_position": "drained",
    "drain_efficiency": "drained",
    "points": "profile",
}


class Uplift(Block):
    """Water pressure in the crack. Without water above the crack only a `profile` gives any."""

    pattern: Annotated[
        UpliftPattern, BeforeValidator(lambda name: "cut-off" if name == "cut-off triangular" else name)
    ] = "triangular"
    """`uniform`: the heel's head over the whole width; `triangular`: to the tailwater's at the toe;
    `cut-off`: to it at `extent`; `drained`: heel, drain, toe; `profile`: your own."""
    intensity: Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)] = 1.0
    """Factor on the pressure."""
    extent: Annotated[DimensionlessNumber, Field(gt=0.0, le=1.0)] | None = None
    """Of `cut-off`: the part of the crack width, from the heel, that is under pressure."""
    drain_position: Annotated[DimensionlessNumber, Field(gt=0.0, lt=1.0)] | None = None
    """Of `drained`: distance of the drains from the heel, as a part of the crack width."""
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
    """How far the crack opens until the pressure has vanished, is the reservoir's, or has fallen to half; 0.1 mm
    where it is not given."""

    @model_validator(mode="after")
    @collected
    def _options_of_the_pattern(self) -> Self:
        for option, pattern in _UPLIFT_OPTIONS.items():
            value = getattr(self, option)
            if value is not None and pattern != self.pattern:
                raise InputError("uplift-option-foreign", option, shown(value), pattern=self.pattern, owner=pattern)
            if value is None and pattern == self.pattern:
                raise InputError("uplift-option-missing", option, pattern=pattern)
        if self.points is not None:
            fractions = [fraction for fraction, _ in self.points]
            if len(fractions) < 2 or fractions[0] != 0.0 or fractions[-1] != 1.0 or fractions != sorted(fractions):
                raise InputError("uplift-profile", "points", shown(fractions))
        if self.during_shaking == "constant" and self.opening is not None:
            raise InputError("needs-other", "opening", other="a during_shaking that changes the pressure")
        if self.during_shaking in ("zero while open", "follows opening") and self.pattern == "none":
            raise InputError("contradiction", "during_shaking", shown(self.during_shaking), other='pattern = "none"')
        return self

    @property
    def opening_of_change(self) -> float:
        """Opening over which the pressure changes [m]."""
        return 1e-4 if self.opening is None else self.opening


class Shaking(Block):
    """A ground motion in one direction: from a record, or drawn by points."""

    file: str | None = Field(default=None, strict=True, min_length=1)
    """A record: its file, relative to the case file, or its name in the catalogue; or a motion made to order, such
    as synthetic:M6.5,20km,seed=3."""
    channel: Channel | None = None
    """Which channel of a file of several, by number or by direction: 1, "90 deg", "up"."""
    points: tuple[tuple[Time, AccelerationField], ...] | None = None
    """[time, acceleration] in order of time, straight in between; twice the same time is a jump."""
    pga: AccelerationField | None = None
    """Scale the motion to this peak, taken without sign."""
    reverse: Truth = False
    """Change the sign of the motion."""
    unit: str | None = Field(default=None, strict=True)
    """Unit of the numbers in a file that does not state it: g, cm/s^2, m/s^2, ..."""
    time_step: TimeSpan | None = None
    """Time between the numbers of a file that does not state it."""
    processing: tuple[ProcessingStep, ...] = ()
    """Steps of processing in their order, before the motion is scaled to `pga`."""

    @model_validator(mode="after")
    @collected
    def _one_source(self) -> Self:
        if self.file is not None and self.points is not None:
            raise InputError("fields-conflict", "file", other="points")
        if self.file is None and self.points is None:
            raise InputError("motion-source", "")
        if self.points is not None:
            times = [time for time, _ in self.points]
            if len(times) < 2 or times[0] == times[-1] or any(b < a for a, b in pairwise(times)):
                raise InputError("motion-points", "points", shown(times))
            for place, (_, value) in enumerate(self.points):
                if abs(value.si(STANDARD_GRAVITY)) > LARGEST_ACCELERATION:
                    raise InputError("acceleration-range", f"points[{place}][1]", str(value))
            for option in ("channel", "unit", "time_step"):
                if getattr(self, option) is not None:
                    raise InputError("motion-file-option", option)
        if self.unit is not None:
            acceleration_unit(self.unit, "unit")
        # The case's own g plays no part in what is plausible.
        if self.pga is not None and not 0.0 < self.pga.si(STANDARD_GRAVITY) <= LARGEST_ACCELERATION:
            raise InputError("pga-range", "pga", str(self.pga))
        return self


class Motion(Shaking):
    """The ground motion: horizontal, positive downstream, and vertical on request, positive up."""

    duration: TimeSpan | None = None
    """Length of the run; the whole record where it is not given."""
    allow_zero: Truth = False
    """Accept a motion that is zero throughout, which is otherwise taken for a mistake."""
    vertical: Shaking | None = None
    """The vertical motion, positive up."""


class Case(Shown, Block):
    """One dam, one crack, one earthquake. Per metre of dam, SI units."""

    title: str = Field(default="", strict=True)
    """What the results are called."""
    gravity: Annotated[Gravity, Field(ge=0.01, le=1e4)] = Field(default="9.80665 m/s^2", validate_default=True)
    """One g, of the weight and of motions given in g."""
    section: Section
    """The section of the dam."""
    # A factory, since the defaults with units take pint, which is slow to load, to read.
    concrete: Concrete = Field(default_factory=Concrete)
    """The concrete."""
    crack: Crack
    """The crack."""
    reservoir: Water | None = None
    """The water upstream."""
    tailwater: Water | None = None
    """The water downstream."""
    ice: Ice | None = None
    """The ice upstream."""
    silt: Silt | None = None
    """The silt upstream."""
    anchors: tuple[Anchor, ...] = ()
    """Anchors and bars across the crack."""
    uplift: Uplift = Uplift()
    """The water in the crack."""
    motion: Motion | None = None
    """The earthquake; statics needs none."""
    flexible: Flexible = Flexible()
    """Choices of the flexible model."""
    decoupled: Decoupled = Decoupled()
    """Choices of the decoupled chain."""
    statics: Statics = Field(default_factory=Statics)
    """Static checks."""
    limits: Limits = Limits()
    """What is allowed."""
    analysis: Analysis = Analysis()
    """Choices for rare situations."""

    @model_validator(mode="after")
    @collected
    def _agree(self) -> Self:
        if self.reservoir is None:
            for name in ("ice", "silt"):
                if getattr(self, name) is not None:
                    raise InputError("needs-other", name, other="a reservoir")
            if self.uplift.during_shaking == "full while open":
                raise InputError("needs-other", "uplift.during_shaking", other="a reservoir")
        elif self.ice is not None and self.ice.depth >= self.reservoir.depth:
            raise InputError("ice-depth", "ice.depth", f"{self.ice.depth:g} m", depth=f"{self.reservoir.depth:g} m")
        for name in ("reservoir", "tailwater"):
            water = getattr(self, name)
            if water and water.follows_vertical_motion and self.motion and not self.motion.vertical:
                raise InputError("needs-other", f"{name}.follows_vertical_motion", other="motion.vertical")
        if self.statics.drain_diameter is not None and self.uplift.pattern != "drained":
            raise InputError("needs-other", "statics.drain_diameter", other='uplift.pattern = "drained"')
        return self

    _base_directory: Path = PrivateAttr(default_factory=Path)

    @property
    def base_directory(self) -> Path:
        """Where relative paths of motions start: the directory of the case file, or the current one."""
        return self._base_directory

    @cached_property
    def outline(self) -> shapely.Polygon:
        """The whole section, counter-clockwise [m].

        Raises
        ------
        InputError
            Where the corners are too few, or the outline crosses or touches itself.
        """
        return outline(self.section.vertices(), "section" if self.section.polygon is None else "section.polygon")

    @cached_property
    def cut(self) -> CutSection:
        """The part of the section above the crack.

        Raises
        ------
        InputError
            Where the crack does not cut the section in two along one line.
        """
        return cut(self.outline, self.crack.elevation, self.crack.inclination)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Return a copy with other fields; a cut made before holds for the same section and crack only."""
        copy = super().model_copy(update=update, deep=deep)
        if update and not update.keys().isdisjoint({"section", "crack"}):
            for made in ("outline", "cut"):
                copy.__dict__.pop(made, None)
        return copy

    def based_in(self, directory: Path) -> Case:
        """Return the same case with another base directory."""
        copy = self.model_copy()
        copy._base_directory = directory
        return copy
