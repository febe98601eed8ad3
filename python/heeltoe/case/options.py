"""Choices of models, checks and limits: the blocks of a case beside the dam itself."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Annotated, Literal, Self, get_args

from pydantic import BeforeValidator, Field, model_validator

from heeltoe.case.fields import Count, Fields, Fraction, FrictionCoefficient, Head, TimeSpan, Truth
from heeltoe.case.quantities import (
    AccelerationField,
    DimensionlessNumber,
    Duration,
    Length,
    MemorySize,
    Pressure,
    Rotation,
    Slip,
)
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError, shown

Evidence = Literal["full", "step", "none"]
EVIDENCE = get_args(Evidence)

#: What has not come to rest by then never does [s].
LONGEST_SILENCE = 600.0


class Flexible(Fields):
    """How the flexible model represents the dam, its damping and the contact in the crack."""

    plane: Literal["stress", "strain"] = "stress"
    """Plane stress (dams with open joints between monoliths) or plane strain."""
    elements_across: Annotated[int, Field(strict=True, ge=1, le=200)] = 8
    """Number of elements along the crack; above the base those at its ends are smaller."""
    elements_away: Annotated[int, Field(strict=True, ge=1, le=200)] | None = None
    """Number of elements of the rows far from the crack: fewer elements from row to row, by halves, and even ones
    along the crack. As many as along the crack where it is not given."""
    damping: Literal["relative", "stiffness", "modal", "thesis", "deformation"] = "relative"
    """Rayleigh's on the motion relative to a rigid slide along the crack; its stiffness term alone; one ratio for the
    modes of the intact dam; as in Zhu (2004), Rayleigh's on all motion while the crack sticks; or, for comparison,
    on the deformation of the free parts, which leaves the intact dam's first mode less than it says."""
    damping_on_water: Truth = True
    """Whether the mass term of damping `relative` acts on the virtual water too, or on the concrete alone; the first
    and third mode of the intact dam get their ratio either way."""
    virtual_mass: Literal["complete", "thesis"] = "complete"
    """Virtual water of reservoir and tailwater on both parts of the dam, along the normals of their faces; or, as in
    Zhu (2004), of the reservoir alone, horizontally and above the crack only, its depth counted from the crack."""
    contact: Literal["coulomb", "idce"] = "coulomb"
    """Exact contact on velocity level; or the penalty method of Zhu (2004), for comparison."""
    time_step: TimeSpan | None = None
    """Time step; chosen by the program where it is not given."""
    evidence: Evidence = "full"
    """Comparisons that a result gets: another step, another mesh and the shaking varied by 1 %; another step alone; or
    none. Step and mesh are refined where the result is too uncertain, unless they are given."""
    elements_across_below: Annotated[int, Field(strict=True, ge=1, le=200)] | None = None
    """Number of elements along the crack in the part below, where it differs."""
    mesh_above: str | None = Field(default=None, strict=True, min_length=1)
    """Mesh of the part above the crack from a file, relative to the case file, in place of the program's own."""
    mesh_below: str | None = Field(default=None, strict=True, min_length=1)
    """Mesh of the part below the crack from a file."""
    modes: Count | None = None
    """Number of vibration modes to keep in each part, beside the static shapes of the crack; where it is not given, as
    many as the flexibility of the crack needs."""
    contactors: Annotated[int, Field(strict=True, ge=1, le=5)] = 3
    """Which nodes are watched for contact, after Zhu (2004): 1 those of the upper face, 2 of the lower, 3 of the
    upper and the ends of the lower, 4 the reverse, 5 all."""
    theta: Annotated[DimensionlessNumber, Field(ge=0.5, le=1.0)] = 0.52
    """Weight of the new state within a step of `coulomb`. 0.5 loses no energy, but lets a sliding face flutter where
    the concrete has no damping; 0.52 wears that out and takes some 1e-4 of critical damping from a dam's own modes."""
    penalty_factor: Annotated[DimensionlessNumber, Field(gt=0.0, le=1e12)] = 1000.0
    """`idce`: stiffness of the contact over the largest diagonal term of the dam's."""
    newmark_gamma: Annotated[DimensionlessNumber, Field(ge=0.5, le=1.5)] = 0.7
    """`idce`: Newmark's gamma; more than 0.5 damps fast vibrations. With 0.5 contact creates energy in every impact."""
    newmark_beta: Annotated[DimensionlessNumber, Field(ge=0.25, le=1.0)] | None = None
    """`idce`: Newmark's beta; (gamma + 1/2)^2 / 4 where it is not given."""

    def row_counts(self, *, below: bool = False) -> tuple[int, int]:
        """Return how many elements the rows far from the crack have, and how often these are halved at it: while those
        along it are a multiple of four, and no fewer than are wanted."""
        return self.halved((self.elements_across_below if below else None) or self.elements_across)

    def halved(self, across: int) -> tuple[int, int]:
        """Return the same for a part with a number of elements along its crack."""
        halvings = 0
        while self.elements_away and across % 4 == 0 and across >= 2 * self.elements_away:
            across, halvings = across // 2, halvings + 1
        return across, halvings

    @model_validator(mode="after")
    @gathered
    def _go_together(self) -> Iterator[InputError]:
        if not self.damping_on_water and self.damping != "relative":
            yield InputError("contradiction", "damping_on_water", "false", other=f'damping = "{self.damping}"')

    def with_evidence(self, evidence: str) -> Self:
        """Return the same with other evidence.

        Raises
        ------
        InputError
            Where there is no such.
        """
        if evidence not in EVIDENCE:
            choices = ", ".join(f'"{choice}"' for choice in EVIDENCE)
            raise InputError("not-a-choice", "evidence", shown(evidence), choices=choices)
        return self.model_copy(update={"evidence": evidence})


class Analysis(Fields):
    """When a run ends, and what to do in rare situations."""

    silence: Annotated[Duration, Field(ge=0.0, le=LONGEST_SILENCE)] = Field(default="10 s", validate_default=True)
    """Where the dam still moves when the ground motion ends, the run goes on while the ground stands still, until the
    dam is at rest, for so long at most; "0 s" ends the run with the motion."""
    paradox: Literal["stop", "tangential impact"] = "stop"
    """Where no motion of a rigid block agrees with Coulomb's law (Painlevé's paradox): stop and say so, or
    let an impulse of friction end the slip."""
    event_limit: Count = 1_000_000
    """Number of events after which a run stops."""
    time_limit: TimeSpan = 600.0
    """Refuse a model with elastic parts that would take longer on one core, by an estimate before it begins, and refine
    none beyond."""
    memory_limit: Annotated[MemorySize, Field(gt=0.0)] = 4e9
    """Refuse a model with elastic parts that would take more memory."""
    rotation: Literal["small", "p-delta", "finite"] = "small"
    """Rotation of the rigid block: small; small with the moment of the weight that grows with it (P-Delta); or of any
    size. Only with the last two can the block overturn."""


class Limits(Fields):
    """Limits on the results; verdict and report compare the results with them."""

    residual_slip: Annotated[Slip, Field(ge=0.0)] | None = None
    """Slip that remains, either way."""
    peak_slip: Annotated[Slip, Field(ge=0.0)] | None = None
    """Largest slip on the way, either way."""
    opening_upstream: Annotated[Slip, Field(ge=0.0)] | None = None
    """Opening of the crack at the upstream face."""
    opening_downstream: Annotated[Slip, Field(ge=0.0)] | None = None
    """Opening of the crack at the downstream face."""
    cracked_length: Annotated[Length, Field(ge=0.0)] | None = None
    """Length of each bonded joint that is cracked in the end; of a crack without a bond it limits nothing."""
    rotation: Annotated[Rotation, Field(ge=0.0)] | None = None
    """Rotation of the part above the crack, either way: a plain number in rad, or with its unit."""
    crest_displacement: Annotated[Slip, Field(ge=0.0)] | None = None
    """Horizontal displacement of the crest from where it stands before the earthquake, relative to the ground, either
    way. Single runs of the rigid block and of the elastic dam are judged by it, and of suites and studies none."""
    crest_acceleration: AccelerationField | None = None
    """Horizontal acceleration of the crest with that of the ground, either way; judged as its displacement."""

    @model_validator(mode="after")
    @gathered
    def _accelerate(self) -> Iterator[InputError]:
        if self.crest_acceleration is not None and self.crest_acceleration.value < 0.0:
            yield InputError("out-of-range", "crest_acceleration", str(self.crest_acceleration), bound="at least 0")


#: Of a flood's depth: that there is none.
NO_FLOOD = "none"


class StaticsSection(Fields):
    """A lift joint that the static checks judge beside the crack; what it does not say is as at the crack."""

    elevation: Annotated[Length, Field(ge=0.0)]
    """Height of the joint, which is level, above the lowest point of the section."""
    friction: FrictionCoefficient | None = None
    """Coefficient of friction."""
    bonded: Fraction | None = None
    """Part of its width, from the toe, that is not cracked."""
    cohesion: Annotated[Pressure, Field(ge=0.0, le=1e8)] | None = None
    """Cohesion of the bonded part."""
    tensile_strength: Annotated[Pressure, Field(ge=0.0, le=1e8)] | None = None
    """Tensile strength of the bonded part."""


# Earthquakes that are unusual loads, and those that are extreme ones, by what people call them.
_UNUSUAL = ("obe", "operating basis")
_EXTREME = ("mde", "mce", "see", "maximum design", "maximum credible", "safety evaluation")


class StaticsEarthquake(Fields):
    """An earthquake of the pseudo-static checks."""

    name: Annotated[str, Field(strict=True, min_length=1, max_length=60)]
    """Name of the earthquake: OBE, MDE, MCE, SEE, or a name of your own."""
    seismic_coefficient: Annotated[DimensionlessNumber, Field(gt=0.0, le=3.0)]
    """Its horizontal acceleration in g."""
    vertical_seismic_coefficient: Annotated[DimensionlessNumber, Field(ge=0.0, le=3.0)] = 0.0
    """Its vertical acceleration at the same time in g, up and down."""
    rarity: Literal["unusual", "extreme"] | None = None
    """Whether it is an unusual load, as the operating basis earthquake (OBE) is, or an extreme one, as the maximum
    design, maximum credible and safety evaluation earthquakes (MDE, MCE, SEE) are; a name that says neither needs
    it."""

    @property
    def known_rarity(self) -> Literal["unusual", "extreme"] | None:
        """Load category: as given, or from its name; None where the name has neither word, or both."""
        if self.rarity is not None:
            return self.rarity
        words = f" {' '.join(re.findall('[a-z]+', self.name.lower()))} "
        unusual, extreme = (any(f" {name} " in words for name in names) for names in (_UNUSUAL, _EXTREME))
        return None if unusual == extreme else "unusual" if unusual else "extreme"

    @property
    def is_unusual(self) -> bool:
        """Whether it is an unusual load."""
        return self.known_rarity == "unusual"


def _section_of(value: object) -> object:
    """Return the fields of a section that is given by its elevation alone."""
    return value if isinstance(value, dict | StaticsSection) else {"elevation": value}


def _flood_of(value: object) -> object:
    """Return a depth as it is given; nothing where there is to be no flood."""
    return None if value == NO_FLOOD else value


def _upper(value: object) -> object:
    """Return a name in capitals: criteria are known by any case."""
    return value.upper() if isinstance(value, str) else value


class StaticsChoice(Fields):
    """Strength and load cases of the static checks before, during and after the earthquake."""

    criteria: Annotated[Literal["USACE", "USBR", "FERC", "CDA", "CADAM3D"], BeforeValidator(_upper)] = "USACE"
    """Guideline with the required factors."""
    criteria_file: str | None = Field(default=None, strict=True, min_length=1)
    """Criteria of your own from a file in TOML, relative to the case file, in place of those."""
    structure: Literal["critical", "normal"] = "critical"
    """Critical where a failure would cost lives (FERC: high or significant hazard, otherwise low)."""
    site_information: Literal["well defined", "ordinary", "limited"] = "ordinary"
    """How well strengths are known: well defined by tests, explored in the ordinary way, or hardly."""
    bonded: Fraction = 0.0
    """Part of the crack's width, from the toe, that is not cracked; only there cohesion and tension count."""
    cohesion: Annotated[Pressure, Field(ge=0.0, le=1e8)] = Field(default="0 MPa", validate_default=True)
    """Cohesion of the bonded part."""
    tensile_strength: Annotated[Pressure, Field(ge=0.0, le=1e8)] = Field(default="0 MPa", validate_default=True)
    """Tensile strength of the bonded part; more tension than that lets the crack grow."""
    compressive_strength: Annotated[Pressure, Field(gt=0.0, le=1e9)] | None = None
    """Compressive strength of the concrete; stresses are judged by it where it is given."""
    flood_depth: Annotated[Head | None, BeforeValidator(_flood_of)] = None
    """Reservoir in the flood; without it, or with "none", the flood is not checked."""
    flood_tailwater: Head | None = None
    """Tailwater in the flood; the usual one where it is not given."""
    flood_rarity: Literal["unusual", "extreme"] = "unusual"
    """Whether the flood is an unusual load or, as the probable maximum flood, an extreme one."""
    seismic_coefficient: Annotated[DimensionlessNumber, Field(gt=0.0, le=3.0)] | None = None
    """Horizontal acceleration of the pseudo-static check in g; without it there is no pseudo-static check."""
    vertical_seismic_coefficient: Annotated[DimensionlessNumber, Field(ge=0.0, le=3.0)] = 0.0
    """Vertical acceleration at the same time in g, up and down: each check is judged by the worse way."""
    earthquakes: Annotated[tuple[StaticsEarthquake, ...], Field(max_length=10)] = ()
    """Earthquakes of different rarity, each with pseudo-static checks, in place of `seismic_coefficient`, which is an
    extreme one."""
    uplift_in_earthquake: Literal["criteria", "unchanged", "zero", "full"] = "criteria"
    """Pressure of the water where a pseudo-static load opens the crack: as the criteria have it; as it was (USACE,
    FERC); none (USBR); or at once the reservoir's (ICOLD)."""
    residual_friction: FrictionCoefficient | None = None
    """Coefficient of friction after the earthquake; the kinetic one where it is not given."""
    residual_slip: Annotated[Slip, Field(ge=0.0)] | None = None
    """Slip after the earthquake; that of an analysis where it is not given."""
    drain_diameter: Annotated[Length, Field(gt=0.0, le=10.0)] | None = None
    """Diameter of the drains of a `drained` uplift: slip closes them in proportion, and wholly from one diameter on;
    this acts on the checks after an earthquake and on each further motion of a sequence."""
    closed_drains: Literal["reservoir head", "linear"] = "reservoir head"
    """Uplift where slip has closed the drains: the reservoir's head as far as their line, or linear from heel to toe
    (Ferguson 2023)."""
    sections: tuple[Annotated[StaticsSection, BeforeValidator(_section_of)], ...] = ()
    """Lift joints to judge, the base among them where it is listed: elevations, or tables with the fields that differ
    there."""

    @property
    def has_own_bond(self) -> bool:
        """Whether the static checks count a bond of their own instead of that of the joint."""
        return not self.model_fields_set.isdisjoint(("bonded", "cohesion", "tensile_strength"))

    @property
    def pseudo_static(self) -> tuple[StaticsEarthquake, ...]:
        """The earthquakes of the pseudo-static checks; that of `seismic_coefficient` has no name."""
        if self.seismic_coefficient is None:
            return self.earthquakes
        only = StaticsEarthquake.model_construct(
            name="",
            seismic_coefficient=self.seismic_coefficient,
            vertical_seismic_coefficient=self.vertical_seismic_coefficient,
        )
        return (only,)

    @model_validator(mode="after")
    @gathered
    def _belong_together(self) -> Iterator[InputError]:
        for name in ("cohesion", "tensile_strength"):
            if getattr(self, name) and not self.bonded:
                yield InputError("needs-other", name, other="a part of the crack that is bonded (statics.bonded)")
        if self.flood_tailwater is not None and self.flood_depth is None:
            yield InputError("needs-other", "flood_tailwater", other="flood_depth")
        if self.vertical_seismic_coefficient and self.seismic_coefficient is None:
            yield InputError("needs-other", "vertical_seismic_coefficient", other="seismic_coefficient")
        if self.earthquakes and self.seismic_coefficient is not None:
            yield InputError("fields-conflict", "seismic_coefficient", other="earthquakes")
        called = [earthquake.name.strip().lower() for earthquake in self.earthquakes]
        again = next((title for title in called if called.count(title) > 1), None)
        if again is not None:
            yield InputError("listed-twice", "earthquakes", shown(again))
        for place, earthquake in enumerate(self.earthquakes):
            if earthquake.known_rarity is None:
                yield InputError("earthquake-rarity", f"earthquakes[{place}].name", shown(earthquake.name))
        if self.uplift_in_earthquake != "criteria" and not self.pseudo_static:
            yield InputError("needs-other", "uplift_in_earthquake", other="seismic_coefficient or earthquakes")
        if self.closed_drains != "reservoir head" and self.drain_diameter is None:
            yield InputError("needs-other", "closed_drains", other="drain_diameter")
        if self.flood_rarity == "extreme" and self.flood_depth is None:
            yield InputError("needs-other", "flood_rarity", other="flood_depth")
        elevations = [section.elevation for section in self.sections]
        twice = next((elevation for elevation in elevations if elevations.count(elevation) > 1), None)
        if twice is not None:
            yield InputError("listed-twice", "sections", f"{twice:g} m")
        if self.criteria_file is not None and "criteria" in self.model_fields_set:
            yield InputError("fields-conflict", "criteria", other="criteria_file")
        own = self.criteria_file is not None
        if not own and self.criteria == "USACE" and self.site_information == "limited" and self.structure == "critical":
            # USACE has no factors for these: the site must be explored.
            other = 'structure = "critical" under USACE'
            yield InputError("contradiction", "site_information", shown(self.site_information), other=other)


class Decoupled(Fields):
    """Choices of the decoupled chain: the elastic part below the crack shakes the rigid part above it."""

    vertical: Truth = False
    """The block feels the vertical motion at the crack too."""
    rotation: Truth = False
    """The block feels the rotation of the crack too."""
    upper_part: Literal["rigid body", "mass on the crack"] = "rigid body"
    """How the part above the crack is attached to the part below it: as a rigid body with its lever arm and inertia;
    or, as in Zhu (2004), as the mass of its concrete alone, spread evenly along the crack."""
