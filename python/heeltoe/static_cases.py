"""The load cases of the static checks: usual, flood, pseudo-static both ways, after the earthquake."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from heeltoe.case_model import Case, Water
from heeltoe.crack_water import CrackWater, Floats, force_and_moment, still_water, water_in_earthquake
from heeltoe.criteria import UPLIFT_IN_EARTHQUAKE, Loads
from heeltoe.loads import Resultant, concrete_mass, static_forces, total, virtual_mass
from heeltoe.section import CutSection
from heeltoe.static_sections import Contact, Settled, settle


@dataclass(frozen=True)
class LoadCase:
    """What one case of loads does to the block above the crack. Per metre of dam, SI.

    Attributes
    ----------
    name
        "usual", "flood", "pseudo-static downstream", "pseudo-static upstream" (the way the block is pushed) or
        "post-seismic".
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
        (cohesive force + friction times normal force) over shear force; None where nothing pushes.
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
    assumptions: tuple[str, ...]

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
        forces = [
            {
                "name": force.name,
                "horizontal_n": force.horizontal,
                "vertical_n": force.vertical,
                "moment_about_heel_nm": force.moment,
            }
            for force in self.forces
        ]
        extra = {"contact_width_m": self.contact_width_m, "eccentricity_m": self.eccentricity_m}
        return {**asdict(self), "forces": forces, **extra, "assumptions": list(self.assumptions)}


@dataclass(frozen=True, eq=False)
class Solved:
    """A load case with the state of its crack."""

    load_case: LoadCase
    settled: Settled


def usual(case: Case, section: CutSection) -> Solved:
    """Return the case of the loads that are always there."""
    return _still("usual", "usual", case, section, ())


def flood(case: Case, section: CutSection) -> Solved:
    """Return the case of the flood; the ice is gone then."""
    choice = case.statics
    assert choice.flood_depth is not None
    risen = at_depth(case, choice.flood_depth)
    if choice.flood_tailwater is not None:
        risen = risen.model_copy(update={"tailwater": _water(case.tailwater, choice.flood_tailwater)})
    said = [f"reservoir {choice.flood_depth:g} m deep, an {choice.flood_rarity} load"]
    if case.ice is not None:
        risen = risen.model_copy(update={"ice": None})
        said.append("no ice in the flood")
    return _still("flood", choice.flood_rarity, risen, section, tuple(said))


def at_depth(case: Case, depth: float) -> Case:
    """Return the case with another depth of the reservoir [m]; fresh water where it had none."""
    return case.model_copy(update={"reservoir": _water(case.reservoir, depth)})


def pseudo_static(case: Case, section: CutSection, before: Solved) -> tuple[Solved, Solved]:
    """Return the cases of a seismic coefficient that pushes the block downstream and upstream.

    The concrete's inertia acts at its centroid, Westergaard's water on the upstream face, both the same way; the
    vertical coefficient acts up or down, whichever leaves the smaller sliding factor. `before` is the usual case: the
    crack that it has opened is open already and no longer bonded.
    """
    horizontal = case.statics.seismic_coefficient
    assert horizontal is not None
    vanishes, source = UPLIFT_IN_EARTHQUAKE[case.statics.criteria]
    still = _contact(case, section)
    opened = before.settled.heel_crack
    contact = Contact(still.start, still.end, max(still.bonded_from, still.start + opened), still.tensile_strength)
    water = water_in_earthquake(before.settled.profile, still.start, still.end, opened, vanishes=vanishes)
    vertical = case.statics.vertical_seismic_coefficient
    found = []
    for way, sign in (("downstream", -1.0), ("upstream", 1.0)):
        tried = []
        for up in (-1.0, 1.0) if vertical else (0.0,):
            forces = (*_dry(case, section), *_inertia(case, section, sign * horizontal, up * vertical))
            said = [f"uplift: {source}"]
            if vertical:
                said.append(f"vertical coefficient {'down' if up > 0.0 else 'up'}ward on the block, the worse way")
            strength = (case.crack.mu_static, case.statics.cohesion)
            tried.append(
                _solved(f"pseudo-static {way}", "earthquake", section, forces, contact, water, strength, tuple(said))
            )
        found.append(min(tried, key=lambda each: _or_infinite(each.load_case.sliding_factor)))
    return found[0], found[1]


def post_seismic(case: Case, section: CutSection, slip: float, source: str) -> Solved | None:
    """Return the usual loads on the block where the earthquake has left it; None where it has slid off its crack.

    Parameters
    ----------
    case, section
        As before the earthquake.
    slip
        Residual slip, positive downstream [m].
    source
        Where the slip comes from.
    """
    width, size, choice = section.crack_width, abs(slip), case.statics
    if size >= width:
        return None
    friction = choice.residual_friction if choice.residual_friction is not None else case.crack.mu_kinetic
    said = [
        f"slip {slip:.6g} m {'downstream' if slip >= 0.0 else 'upstream'}: {source}".replace("slip -", "slip "),
        f"friction {friction:g}, {'residual' if choice.residual_friction is not None else 'kinetic'}; "
        "the crack has slid: no cohesion, no tensile strength",
    ]
    if size:
        said.append(
            f"the block stands on {width - size:.6g} m of its {width:.6g} m, whether or not the ground goes on beyond "
            "the toe; uplift acts as its pattern on what is left, free water on the rest"
        )
    if case.uplift.pattern == "drained" and size:
        if choice.drain_diameter is None:
            said.append("drains as before: statics.drain_diameter is not given")
        else:
            share = max(0.0, 1.0 - size / choice.drain_diameter)
            said.append(f"slip over a drain diameter of {choice.drain_diameter:g} m leaves {share:.3g} of the drainage")
            efficiency = share * (case.uplift.drain_efficiency or 0.0)
            case = case.model_copy(update={"uplift": case.uplift.model_copy(update={"drain_efficiency": efficiency})})
    if case.anchors and size:
        said.append("prestress of the anchors as before the slip")
    start, end = (0.0, width - size) if slip >= 0.0 else (size, width)
    contact = Contact(start, end, bonded_from=end)
    water = still_water(case, section, start, end)
    strength = (friction, 0.0)
    return _solved(
        "post-seismic", "post-earthquake", section, _dry(case, section), contact, water, strength, tuple(said)
    )


def _water(water: Water | None, depth: float) -> Water:
    return (water or Water.model_validate({"depth": "1 m"})).model_copy(update={"depth": depth})


def _contact(case: Case, section: CutSection) -> Contact:
    width = section.crack_width
    return Contact(0.0, width, (1.0 - case.statics.bonded) * width, case.statics.tensile_strength)


def _dry(case: Case, section: CutSection) -> tuple[Resultant, ...]:
    """Return all forces but those of the water in the crack."""
    return tuple(force for force in static_forces(case, section) if force.name != "uplift")


def _inertia(case: Case, section: CutSection, horizontal: float, vertical: float) -> tuple[Resultant, ...]:
    """Return the forces of a ground acceleration in g, downstream and upward."""
    g, mass, moved = case.gravity, concrete_mass(case, section), virtual_mass(case, section)
    x, z = section.centroid[0] - section.heel[0], section.centroid[1] - section.heel[1]
    push, lift = -mass * g * horizontal, -mass * g * vertical
    water = -moved.mass * g * horizontal
    forces = [
        Resultant("inertia", push, lift, x * lift - z * push),
        Resultant("hydrodynamic", water, 0.0, -moved.height * water),
    ]
    for force, side in zip(static_forces(case, section)[1:3], (case.reservoir, case.tailwater), strict=True):
        if side is not None and side.follows_vertical_motion and vertical:
            forces.append(
                Resultant(
                    f"{force.name} in vertical motion",
                    vertical * force.horizontal,
                    vertical * force.vertical,
                    vertical * force.moment,
                )
            )
    return tuple(forces)


def _still(name: str, loads: Loads, case: Case, section: CutSection, said: tuple[str, ...]) -> Solved:
    """Return a case of still water on the crack as it is before the earthquake."""
    contact = _contact(case, section)
    water = still_water(case, section, contact.start, contact.end)
    strength = (case.crack.mu_static, case.statics.cohesion)
    return _solved(name, loads, section, _dry(case, section), contact, water, strength, said)


def _solved(
    name: str,
    loads: Loads,
    section: CutSection,
    forces: tuple[Resultant, ...],
    contact: Contact,
    water: CrackWater,
    strength: tuple[float, float],
    said: tuple[str, ...],
) -> Solved:
    """Find the state of the crack and the factors; `strength` is friction and cohesion."""
    settled = settle(contact, _across(total(name, forces), section), water)
    forces = (*forces, _uplift(settled.profile, section))
    across = [_across(force, section) for force in forces]
    shear = math.fsum(force.horizontal for force in across)
    friction, cohesion = strength
    closed = (contact.start + settled.heel_crack, contact.end - settled.toe_crack)
    pressed = _in_compression(closed, settled)
    cohesive = cohesion * max(0.0, pressed[1] - max(pressed[0], contact.bonded_from))
    about = "heel" if shear < 0.0 else "toe"
    down = -math.fsum(min(0.0, force.vertical) for force in across)
    up = math.fsum(max(0.0, force.vertical) for force in across)
    load_case = LoadCase(
        name=name,
        loads=loads,
        forces=forces,
        outcome=settled.outcome,
        normal_force_n=settled.normal,
        shear_force_n=shear,
        friction=friction,
        cohesive_force_n=cohesive,
        sliding_factor=(cohesive + friction * max(0.0, settled.normal)) / abs(shear) if shear else None,
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
        assumptions=said,
    )
    return Solved(load_case, settled)


def _across(force: Resultant, section: CutSection) -> Resultant:
    """Return a force by its components along and across the crack."""
    along, across = section.in_crack_frame(force.horizontal, force.vertical)
    return Resultant(force.name, along, across, force.moment)


def _uplift(profile: Floats, section: CutSection) -> Resultant:
    force, moment = force_and_moment(profile)
    return Resultant("uplift", *section.from_crack_frame(0.0, force), moment)


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


def _or_infinite(value: float | None) -> float:
    return math.inf if value is None else value
