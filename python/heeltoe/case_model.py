"""What the user says about a dam, its crack, its water and the earthquake: the models behind the case file.

All lengths, densities and so on are plain SI numbers here; the units are in the types of
:mod:`heeltoe.quantities`. What needs the geometry (is the crack in the section, is the water below the crest)
is checked in :mod:`heeltoe.section`."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PrivateAttr, WithJsonSchema, model_validator

from heeltoe.case_errors import collected, shown
from heeltoe.errors import InputError
from heeltoe.processing_steps import ProcessingStep
from heeltoe.quantities import (
    STANDARD_GRAVITY,
    AccelerationField,
    Density,
    DimensionlessNumber,
    Duration,
    Gravity,
    Length,
    Pressure,
    acceleration_unit,
)

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

Truth = Annotated[bool, Field(strict=True)]
Count = Annotated[int, Field(strict=True, ge=1)]


class Block(BaseModel):
    """A block of fields: no unknown ones, no changes later; the texts below them go into the JSON schema."""

    model_config = ConfigDict(extra="forbid", frozen=True, use_attribute_docstrings=True)


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
    """The crack: a horizontal line through the section, with Coulomb friction."""

    elevation: Annotated[Length, Field(ge=0.0)] = Field(default="0 m", validate_default=True)
    """Height of the crack above the lowest point of the section."""
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
        return self


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


class Flexible(Block):
    """How the flexible model represents the dam, its damping and the contact in the crack."""

    plane: Literal["stress", "strain"] = "stress"
    """Plane stress (dams with open joints between monoliths) or plane strain."""
    elements_across: Annotated[int, Field(strict=True, ge=1, le=200)] = 8
    """Number of elements along the crack."""
    damping: Literal["deformation", "thesis", "modal"] = "deformation"
    """Rayleigh on deformation only; as in Zhu (2004), on all motion while the crack sticks; or one ratio for
    every deformation mode."""
    virtual_mass: Literal["complete", "thesis"] = "complete"
    """Virtual water on both parts of the dam; or, as in Zhu (2004), above the crack only, its depth counted
    from the crack."""
    contact: Literal["coulomb", "idce"] = "coulomb"
    """Exact contact on velocity level; or the penalty method of Zhu (2004), for comparison."""
    time_step: TimeSpan | None = None
    """Time step; chosen by the program where it is not given."""
    convergence_check: Truth = True
    """Run again at half the step and say how much changes; without a given step, halve it until little does."""
    elements_across_below: Annotated[int, Field(strict=True, ge=1, le=200)] | None = None
    """Number of elements along the crack in the part below, where it differs."""
    mesh_above: str | None = Field(default=None, strict=True, min_length=1)
    """Mesh of the part above the crack from a file, relative to the case file, in place of the program's own."""
    mesh_below: str | None = Field(default=None, strict=True, min_length=1)
    """Mesh of the part below the crack from a file."""
    modes: Count | None = None
    """Number of vibration modes to keep in each part, beside the static shapes of the crack; all, where the mesh
    is small enough, if not given."""
    contactors: Annotated[int, Field(strict=True, ge=1, le=5)] = 3
    """Which nodes are watched for contact, after Zhu (2004): 1 those of the upper face, 2 of the lower, 3 of the
    upper and the ends of the lower, 4 the reverse, 5 all."""
    theta: Annotated[DimensionlessNumber, Field(ge=0.5, le=1.0)] = 0.52
    """Weight of the new state within a step of `coulomb`. 0.5 loses no energy, but lets a sliding face flutter where
    the concrete has no damping; 0.52 wears that out and takes some 1e-4 of critical damping from a dam's own modes."""
    penalty_factor: Annotated[DimensionlessNumber, Field(gt=0.0, le=1e12)] = 1000.0
    """Of `idce`: stiffness of the contact over the largest diagonal term of the dam's."""
    newmark_gamma: Annotated[DimensionlessNumber, Field(ge=0.5, le=1.5)] = 0.7
    """Of `idce`: Newmark's gamma; more than 0.5 damps fast vibrations. With 0.5 contact makes energy at every blow."""
    newmark_beta: Annotated[DimensionlessNumber, Field(ge=0.25, le=1.0)] | None = None
    """Of `idce`: Newmark's beta; (gamma + 1/2)^2 / 4 where it is not given."""


class Analysis(Block):
    """What to do in rare situations."""

    paradox: Literal["stop", "tangential impact"] = "stop"
    """Where no motion of a rigid block agrees with Coulomb's law (Painlevé's paradox): stop and say so, or
    let an impulse of friction end the slip."""
    event_limit: Count = 1_000_000
    """Stop after so many events."""


class Case(Block):
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
    uplift: Uplift = Uplift()
    """The water in the crack."""
    motion: Motion | None = None
    """The earthquake; statics needs none."""
    flexible: Flexible = Flexible()
    """Choices of the flexible model."""
    analysis: Analysis = Analysis()
    """Choices for rare situations."""

    _base_directory: Path = PrivateAttr(default_factory=Path)

    @property
    def base_directory(self) -> Path:
        """Where relative paths of motions start: the directory of the case file, or the current one."""
        return self._base_directory

    def based_in(self, directory: Path) -> Case:
        """Return the same case with another base directory."""
        copy = self.model_copy()
        copy._base_directory = directory
        return copy
