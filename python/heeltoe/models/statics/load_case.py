"""One load case of the static checks: its forces, the state of its crack, its factors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple

import numpy as np

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


@dataclass(frozen=True)
class LoadCase:
    """What one case of loads does to the block above the crack. Per metre of dam, SI.

    Attributes
    ----------
    name
        "usual", "flood", "pseudo-static downstream", "pseudo-static upstream" (the way the block is pushed; with a
        vertical coefficient ", lifting" or ", pressing" stands behind) or "post-seismic".
    loads
        What the criteria take it for: "usual", "unusual", "extreme", "earthquake", "post-earthquake".
    forces
        One by one: horizontal downstream, vertical upward, moment about the heel counter-clockwise; the uplift as it is
        with the crack open as far as found.
    outcome
        "stands", "cracks through", "floats" or "slid off": only the first has stresses.
    normal_force_n, shear_force_n
        Across the crack, uplift taken off, and along it, positive downstream.
    friction
        Coefficient used.
    cohesive_force_n
        Cohesion on what is bonded, closed and in compression.
    sliding_factor
        (cohesive force + friction times normal force) over shear force; None where nothing pushes. Of a crack with
        kinks that along the straight line from heel to toe, or that on its pieces where it is smaller.
    pieces_bear
        What the pieces of a crack with kinks bear: "more" or "less" than friction on that straight line, or "any push"
        until they shear off; "" of a straight crack, where nothing pushes, and of faces that a slip has moved apart.
    sliding_factor_on_pieces
        That on them, where they bear more or less; None elsewhere.
    steepest_rise_rad
        Of the closed pieces, against the straight line, in the direction in which the block is pushed; zero where
        `pieces_bear` is empty.
    overturning_factor, overturning_about
        Stabilising over overturning moments about the end of the contact that the forces push to; each force counts
        as a whole on the side to which it turns the block. None where nothing overturns.
    flotation_factor
        Forces down over forces up; None where nothing pushes up.
    resultant_from_heel_m
        Where the normal force acts; None without one.
    resultant_zone
        "middle third", "middle half", "base" of the contact, or "outside".
    heel_stress_pa, toe_stress_pa
        Normal stress at the ends of what is closed, compression positive, water pressure taken off.
    contact_from_m, contact_to_m
        Where the block can stand, from its heel: all of the crack but what a slip has left.
    cracked_length_m, cracked_from
        How far the contact is open, from "heel" or "toe".
    compressed_length_m
        How much of it is in compression.
    iterations
        Of the search for the cracked length.
    assumptions
        What was taken for granted, a sentence each.
    sources
        Where the forces come from, by their names.
    governs
        Names of the checks of which this is the worse sign of a vertical seismic coefficient; None where there is no
        other sign, and all checks are its own.
    ends_m
        Ends of the contact, each downstream of the heel of the crack and above it: its heel and its toe.
    pressures
        Of the water in the crack as far as it is found open: distance from the heel of the crack [m] and pressure
        [Pa], straight in between; twice the same distance is a jump.
    pieces
        Rectangles and triangles of the section above the crack, counted from its heel, for taking its weight by hand;
        nothing where it is one, or more than anyone adds.
    """

    name: str
    loads: Loads
    forces: tuple[Resultant, ...]
    outcome: str
    normal_force_n: float
    shear_force_n: float
    friction: float
    cohesive_force_n: float
    sliding_factor: float | None
    overturning_factor: float | None
    overturning_about: str
    flotation_factor: float | None
    resultant_from_heel_m: float | None
    resultant_zone: str
    heel_stress_pa: float | None
    toe_stress_pa: float | None
    contact_from_m: float
    contact_to_m: float
    cracked_length_m: float
    cracked_from: str
    compressed_length_m: float
    iterations: int
    assumptions: tuple[Sentence, ...]
    sources: Mapping[str, Sentence]
    ends_m: tuple[tuple[float, float], tuple[float, float]]
    pressures: tuple[tuple[float, float], ...]
    governs: tuple[str, ...] | None = None
    pieces: tuple[Piece, ...] = ()
    pieces_bear: str = ""
    sliding_factor_on_pieces: float | None = None
    steepest_rise_rad: float = 0.0

    def sheet(self, about: str = "heel") -> Sheet:
        """Return the forces one by one with arms, moments and sum about the "heel" or the "toe" of the contact."""
        return sheet(self.forces, self.sources, about, self.ends_m[("heel", "toe").index(about)], self.pieces)

    @property
    def contact_width_m(self) -> float:
        """Length of the contact."""
        return self.contact_to_m - self.contact_from_m

    @property
    def eccentricity_m(self) -> float | None:
        """Distance of the resultant from the middle of the contact, positive downstream; None without one."""
        if self.resultant_from_heel_m is None:
            return None
        return self.resultant_from_heel_m - (self.contact_from_m + self.contact_to_m) / 2.0

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers, strings and lists."""
        written = asdict(self)
        written["pressures"] = [list(point) for point in self.pressures]
        for name in ("sources", "ends_m"):
            del written[name]
        from_heel = sheet(self.forces, self.sources, "heel", (0.0, 0.0))
        written["forces"] = [
            {
                "name": force.name,
                "horizontal_n": force.horizontal,
                "height_m": line.height_m,
                "vertical_n": force.vertical,
                "distance_m": line.distance_m,
                "moment_about_heel_nm": force.moment,
                "moment_about_toe_nm": turned.moment_nm,
                "source": str(line.source),
            }
            for force, line, turned in zip(self.forces, from_heel.lines, self.sheet("toe").lines, strict=True)
        ]
        extra = {"contact_width_m": self.contact_width_m, "eccentricity_m": self.eccentricity_m}
        return {**written, **extra, "assumptions": [str(assumption) for assumption in self.assumptions]}


@dataclass(frozen=True, eq=False)
class Solved:
    """A load case with the state of its crack."""

    load_case: LoadCase
    settled: Settled


#: Coefficient of friction and cohesion [Pa] under a normal stress [Pa].
Borne = Callable[[float], tuple[float, float]]


@dataclass(frozen=True)
class Question:
    """What is known of a load case before it is solved: coefficient of friction, cohesion of the bonded part [Pa]; or
    the law that says both by the mean normal stress [Pa] on what is in compression; whether the faces of the crack
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
    sliding = _sliding(case, settled, (cohesive, friction), shear, closed if question.matches else None)
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
