"""One load case of the static checks: its forces, the state of its crack, its factors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, NamedTuple

import numpy as np

from heeltoe.base.blocks import Block, Number, plain_json
from heeltoe.case.model import Case
from heeltoe.geometry.pieces import Piece, pieces
from heeltoe.mechanics.block import ROUNDING_OF_FORCES, across_crack
from heeltoe.mechanics.loads import Resultant, in_crack, total
from heeltoe.models.statics.contact import Contact, Settled, settle
from heeltoe.models.statics.criteria import Loads
from heeltoe.models.statics.pieces import borne, pieces_between, steepest
from heeltoe.models.statics.sheet import Sheet, sheet
from heeltoe.models.statics.water import StillWater
from heeltoe.units.sentences import Sentence

_NEWTON, _MOMENT = "N per metre of dam", "N m per metre of dam"


class ForceNumbers(Block):
    """A force on the block, with its arms from the heel of the crack."""

    name: Annotated[str, Number("Source of the force.")]
    horizontal_n: Annotated[float, Number("Its horizontal part, positive downstream.", _NEWTON)]
    height_m: Annotated[
        float | None,
        Number("At which that acts; null where there is none, or where the pieces of the force are a couple.", "m"),
    ]
    vertical_n: Annotated[float, Number("Its vertical part, positive upward.", _NEWTON)]
    distance_m: Annotated[float | None, Number("At which that acts, downstream of the heel; null as above.", "m")]
    moment_about_heel_nm: Annotated[
        float, Number("Moment about the heel of the crack, positive counter-clockwise.", _MOMENT)
    ]
    moment_about_toe_nm: Annotated[float, Number("Moment about the toe of the contact.", _MOMENT)]
    source: Annotated[Sentence, Number("Where the force comes from.")]


class LoadCase(Block):
    """Effect of one load case on the block above the crack. Per metre of dam, SI.

    Attributes
    ----------
    sources
        Where the forces come from, by their names.
    ends_m
        Ends of the contact, each downstream of the heel of the crack and above it: its heel and its toe.
    """

    name: Annotated[
        str,
        Number(
            '"usual", "flood", "pseudo-static downstream", "pseudo-static upstream" (the way the block is pushed; with '
            'a vertical coefficient ", lifting" or ", pressing" stands behind) or "post-seismic".'
        ),
    ]
    loads: Annotated[
        Loads,
        Number('Load category of the criteria: "usual", "unusual", "extreme", "earthquake", "post-earthquake".'),
    ]
    forces: Annotated[
        tuple[Resultant, ...], Number("One by one; the uplift as it is with the crack open as far as found.")
    ]
    outcome: Annotated[str, Number('"stands", "cracks through", "floats" or "slid off": only the first has stresses.')]
    normal_force_n: Annotated[float, Number("Force across the crack, uplift taken off.", _NEWTON)]
    shear_force_n: Annotated[float, Number("Force along the crack, positive downstream.", _NEWTON)]
    friction: Annotated[float, Number("Coefficient used.")]
    cohesive_force_n: Annotated[
        float, Number("Cohesive force on the part that is bonded, closed and in compression.", _NEWTON)
    ]
    sliding_factor: Annotated[
        float | None,
        Number(
            "(cohesive force + friction times normal force) over shear force; null without a push. For a crack "
            "with kinks, the smaller of the factor along the straight line from heel to toe and the factor on "
            "its pieces."
        ),
    ]
    friction_factor: Annotated[
        float | None, Number("The same without the cohesive force: by friction alone; null where nothing pushes.")
    ]
    overturning_factor: Annotated[
        float | None,
        Number(
            "Stabilising over overturning moments about the end of the contact that the forces push to, each force as "
            "a whole on the side to which it turns the block; null where nothing overturns."
        ),
    ]
    overturning_about: Annotated[str, Number("About which end: heel or toe.")]
    flotation_factor: Annotated[float | None, Number("Forces down over forces up; null where nothing pushes up.")]
    resultant_from_heel_m: Annotated[float | None, Number("Where the normal force acts; null without one.", "m")]
    resultant_zone: Annotated[str, Number('"middle third", "middle half", "base" of the contact, or "outside".')]
    heel_stress_pa: Annotated[
        float | None,
        Number("Effective normal stress at the heel of the closed part: compression positive.", "Pa"),
    ]
    toe_stress_pa: Annotated[
        float | None,
        Number("Effective normal stress at the toe of the closed part: compression positive.", "Pa"),
    ]
    contact_from_m: Annotated[float, Number("Where the contact begins, from the heel of the crack.", "m")]
    contact_to_m: Annotated[float, Number("Where it ends: the whole crack but what a slip has left.", "m")]
    cracked_length_m: Annotated[float, Number("How far the contact is open.", "m")]
    cracked_from: Annotated[str, Number("From which end it is open: heel or toe.")]
    compressed_length_m: Annotated[float, Number("How much of it is in compression.", "m")]
    iterations: Annotated[int, Number("Iterations of the search for the cracked length.")]
    assumptions: Annotated[tuple[Sentence, ...], Number("Assumptions, a sentence each.")]
    sources: Mapping[str, Sentence]
    ends_m: tuple[tuple[float, float], tuple[float, float]]
    pressures: Annotated[
        tuple[tuple[float, float], ...],
        Number(
            "Pressure of the water in the open part of the crack: distance from the heel [m] and pressure [Pa], "
            "linear in between; the same distance twice is a jump."
        ),
    ]
    governs: Annotated[
        tuple[str, ...] | None,
        Number(
            "Names of the checks of which this is the worse sign of a vertical seismic coefficient; null where there "
            "is no other sign, and all checks are its own."
        ),
    ] = None
    pieces: Annotated[
        tuple[Piece, ...],
        Number(
            "Rectangles and triangles of the section above the crack, counted from its heel, for taking its weight by "
            "hand; nothing where it is one, or more than anyone adds."
        ),
    ] = ()
    pieces_bear: Annotated[
        str,
        Number(
            'Resistance of the pieces of a crack with kinks: "more" or "less" than friction on that straight line, or '
            '"any push" until they shear off; "" for a straight crack, without a push, and for faces that a slip has '
            "moved apart."
        ),
    ] = ""
    sliding_factor_on_pieces: Annotated[
        float | None, Number("That on them, where they bear more or less; null elsewhere.")
    ] = None
    steepest_rise_rad: Annotated[
        float,
        Number(
            "Steepest rise of the closed pieces against the straight line, in the direction of the push; zero "
            "where `pieces_bear` is empty.",
            "rad",
        ),
    ] = 0.0

    def sheet(self, about: str = "heel") -> Sheet:
        """Return the forces one by one with arms, moments and sum about the "heel" or the "toe" of the contact."""
        return sheet(self.forces, self.sources, about, self.ends_m[("heel", "toe").index(about)], self.pieces)

    @property
    def contact_width_m(self) -> Annotated[float, Number("Length of the contact.", "m")]:
        """Length of the contact [m]."""
        return self.contact_to_m - self.contact_from_m

    @property
    def eccentricity_m(
        self,
    ) -> Annotated[
        float | None,
        Number("Distance of the resultant from the middle of the contact, positive downstream; null without one.", "m"),
    ]:
        """Distance of the resultant from the middle of the contact [m]."""
        if self.resultant_from_heel_m is None:
            return None
        return self.resultant_from_heel_m - (self.contact_from_m + self.contact_to_m) / 2.0

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers, strings and lists."""
        from_heel = sheet(self.forces, self.sources, "heel", (0.0, 0.0))
        forces = [
            ForceNumbers(
                name=force.name,
                horizontal_n=force.horizontal,
                height_m=line.height_m,
                vertical_n=force.vertical,
                distance_m=line.distance_m,
                moment_about_heel_nm=force.moment,
                moment_about_toe_nm=turned.moment_nm,
                source=line.source,
            )
            for force, line, turned in zip(self.forces, from_heel.lines, self.sheet("toe").lines, strict=True)
        ]
        return {**super().to_json(), "forces": plain_json(forces)}


@dataclass(frozen=True, eq=False)
class Solved:
    """A load case with the state of its crack."""

    load_case: LoadCase
    settled: Settled


#: Coefficient of friction and cohesion [Pa] under a normal stress [Pa].
Borne = Callable[[float], tuple[float, float]]


@dataclass(frozen=True)
class Question:
    """A load case before it is solved: coefficient of friction, cohesion of the bonded part [Pa]; or
    the law that says both by the mean normal stress [Pa] on the compressed part; whether the faces of the crack
    still match."""

    name: str
    loads: Loads
    friction: float
    cohesion: float
    assumptions: tuple[Sentence, ...]
    sources: Mapping[str, Sentence] = field(default_factory=dict)
    law: Borne | None = None
    matches: bool = True


class _Sliding(NamedTuple):
    """The sliding factor, and what of it is known of a crack with kinks; see :class:`LoadCase`."""

    factor: float | None = None
    bear: str = ""
    on_pieces: float | None = None
    rise: float = 0.0


def solve_case(
    question: Question, case: Case, forces: tuple[Resultant, ...], contact: Contact, water: StillWater
) -> Solved:
    """Find the state of the crack and the factors.

    Parameters
    ----------
    question
        What is known of the load case before.
    case
        The dam; its crack is looked at along the straight line from heel to toe.
    forces
        All but that of the water in the crack.
    contact, water
        Where the block can stand, and the water there.
    """
    section = case.above
    settled = settle(contact, across_crack(total(question.name, forces), section), water)
    forces = (*forces, in_crack(case, settled.profile.tolist()))
    across = [across_crack(force, section) for force in forces]
    shear = math.fsum(force.horizontal for force in across)
    if abs(shear) <= ROUNDING_OF_FORCES * math.fsum(abs(force.horizontal) + abs(force.vertical) for force in across):
        shear = 0.0
    closed = (contact.start + settled.heel_crack, contact.end - settled.toe_crack)
    pressed = _in_compression(closed, settled)
    bonded = max(pressed[0], contact.bonded_from), min(pressed[1], contact.bonded_to)
    friction, cohesion = question.friction, question.cohesion
    if question.law is not None:
        length = max(0.0, pressed[1] - pressed[0])
        friction, cohesion = question.law(max(0.0, settled.normal) / length if length else 0.0)
    cohesive = cohesion * max(0.0, bonded[1] - bonded[0])
    sliding, by_friction = (
        _sliding(case, settled, (held, friction), shear, closed if question.matches else None)
        for held in (cohesive, 0.0)
    )
    about = "heel" if shear < 0.0 else "toe"
    down = -math.fsum(min(0.0, force.vertical) for force in across)
    up = math.fsum(max(0.0, force.vertical) for force in across)
    load_case = LoadCase(
        name=question.name,
        loads=question.loads,
        forces=forces,
        outcome=settled.outcome,
        normal_force_n=settled.normal,
        shear_force_n=shear,
        friction=friction,
        cohesive_force_n=cohesive,
        sliding_factor=sliding.factor,
        friction_factor=by_friction.factor,
        overturning_factor=_overturning(across, contact.start if about == "heel" else contact.end, about),
        overturning_about=about,
        flotation_factor=down / up if up else None,
        resultant_from_heel_m=settled.position,
        resultant_zone=_zone(settled.position, contact),
        heel_stress_pa=settled.heel_stress,
        toe_stress_pa=settled.toe_stress,
        contact_from_m=contact.start,
        contact_to_m=contact.end,
        cracked_length_m=settled.heel_crack + settled.toe_crack,
        cracked_from="toe" if settled.toe_crack else "heel",
        compressed_length_m=max(0.0, pressed[1] - pressed[0]),
        iterations=settled.iterations,
        assumptions=question.assumptions,
        sources=question.sources,
        ends_m=(section.from_crack_frame(contact.start, 0.0), section.from_crack_frame(contact.end, 0.0)),
        pressures=tuple((float(x), float(p)) for x, p in settled.profile),
        pieces=pieces(section.polygon - np.array(section.heel)),
        pieces_bear=sliding.bear,
        sliding_factor_on_pieces=sliding.on_pieces,
        steepest_rise_rad=sliding.rise,
    )
    return Solved(load_case, settled)


def along_line(solved_case: LoadCase) -> float | None:
    """Return the sliding factor by friction along the straight line from heel to toe, whatever the pieces of a crack
    with kinks bear; None where nothing pushes."""
    return _along(
        solved_case.cohesive_force_n, solved_case.friction, solved_case.normal_force_n, solved_case.shear_force_n
    )


def _along(cohesive: float, friction: float, normal: float, shear: float) -> float | None:
    return (cohesive + friction * max(0.0, normal)) / abs(shear) if shear else None


def _sliding(
    case: Case,
    settled: Settled,
    strength: tuple[float, float],
    shear: float,
    closed: tuple[float, float] | None,
) -> _Sliding:
    """Return what cohesive force and coefficient of friction make of a force along the crack, which is closed between
    two places; None where its faces do not match."""
    cohesive, friction = strength
    along = _along(cohesive, friction, settled.normal, shear)
    if along is None:
        return _Sliding()
    pieces = [] if closed is None else pieces_between(case, *closed)
    way = math.copysign(1.0, shear)
    held = borne(pieces, friction, settled, way)
    if held is None:
        return _Sliding(along)
    rise = steepest(pieces, way)
    if math.isinf(held):
        return _Sliding(along, "any push", None, rise)
    on_pieces = (cohesive + held) / abs(shear)
    return _Sliding(min(along, on_pieces), "less" if on_pieces < along else "more", on_pieces, rise)


def _in_compression(closed: tuple[float, float], settled: Settled) -> tuple[float, float]:
    """Return from where to where the closed part is in compression; nothing unless it stands."""
    low, high = closed
    heel, toe = settled.heel_stress, settled.toe_stress
    if heel is None or toe is None or (heel <= 0.0 and toe <= 0.0):
        return low, low
    # The tip of a crack without strength is at zero, to rounding.
    crossing = low + (high - low) * heel / (heel - toe) if min(heel, toe) < 0.0 else low
    return (crossing, high) if heel < 0.0 else (low, crossing) if toe < 0.0 else (low, high)


def _overturning(across: Iterable[Resultant], pivot: float, about: str) -> float | None:
    """Return stabilising over overturning moments about a point of the crack."""
    # Counter-clockwise moments keep the block from turning about its toe, and turn it about its heel.
    sign = 1.0 if about == "toe" else -1.0
    moments = [sign * force.moment_about(pivot, 0.0) for force in across]
    overturning = -math.fsum(min(0.0, moment) for moment in moments)
    return math.fsum(max(0.0, moment) for moment in moments) / overturning if overturning else None


def _zone(position: float | None, contact: Contact) -> str:
    if position is None:
        return "outside"
    share = abs(position - (contact.start + contact.end) / 2.0) / contact.width
    for zone, reach in (("middle third", 1.0 / 6.0), ("middle half", 1.0 / 4.0), ("base", 1.0 / 2.0)):
        if share <= reach * (1.0 + 1e-9):
            return zone
    return "outside"
