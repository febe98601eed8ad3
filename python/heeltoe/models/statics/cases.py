"""The load cases of the static checks: usual, flood, pseudo-static both ways, after the earthquake."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product

from heeltoe.case.crack.kinks import climbs
from heeltoe.case.dam import Reservoir, Water
from heeltoe.case.model import Case
from heeltoe.case.options import StaticsEarthquake
from heeltoe.errors.sanitize import plain
from heeltoe.mechanics.block import across_crack
from heeltoe.mechanics.drains import drainage_left, with_drainage
from heeltoe.mechanics.friction import peak_of, residual_of
from heeltoe.mechanics.loads import Resultant, concrete_mass, scaled, static_forces, total
from heeltoe.mechanics.virtual_water import moving_force
from heeltoe.models.statics.contact import Contact
from heeltoe.models.statics.criteria import Loads
from heeltoe.models.statics.load_case import LoadCase, Question, Solved, solve_case
from heeltoe.models.statics.own_criteria import rules_of
from heeltoe.models.statics.sheet import sources_of, sources_of_inertia
from heeltoe.models.statics.spectral import SpectralDemand
from heeltoe.models.statics.water import StillWater, still_water, water_in_earthquake
from heeltoe.units.sentences import Sentence

# Sources of slips that no run has found.
NO_SLIP, OWN_SLIP = "no slip is given, taken as zero", "statics.residual_slip"
_NO_RUN = (NO_SLIP, OWN_SLIP)


def usual(case: Case) -> Solved:
    """Return the case of the loads that are always there."""
    return _still("usual", "usual", case, ())


def flood(case: Case) -> Solved:
    """Return the case of the flood; the ice is gone then."""
    choice = case.statics
    assert choice.flood_depth is not None
    text = f"reservoir {{depth_m:g m}} deep, an {choice.flood_rarity} load"
    assumptions = [Sentence.of(text, depth_m=choice.flood_depth)]
    over = choice.flood_depth - (case.cut.crest_elevation - case.cut.base_elevation)
    if over > 0.0:
        nappe = case.reservoir.nappe if case.reservoir else "none"
        text = 'the water {over_m:.3g m} above the crest presses on it by reservoir.nappe = "{nappe}"'
        assumptions.append(Sentence.of(text, over_m=over, nappe=nappe))
    if case.ice is not None:
        assumptions.append(Sentence("no ice in the flood"))
    return _still("flood", choice.flood_rarity, flooded(case), tuple(assumptions))


def flooded(case: Case) -> Case:
    """Return the case with the water of its flood, and without ice."""
    choice = case.statics
    assert choice.flood_depth is not None
    risen = at_depth(case, choice.flood_depth)
    if choice.flood_tailwater is not None:
        below = case.tailwater or Water.model_validate({"depth": "0 m"})
        risen = risen.model_copy(update={"tailwater": below.model_copy(update={"depth": choice.flood_tailwater})})
    return risen.model_copy(update={"ice": None})


def at_depth(case: Case, depth: float) -> Case:
    """Return the case with another depth of the reservoir [m]; fresh water where it had none."""
    above = case.reservoir or Reservoir.model_validate({"depth": "0 m"})
    return case.model_copy(update={"reservoir": above.model_copy(update={"depth": depth})})


def pseudo_static(case: Case, before: Solved) -> tuple[Solved, ...]:
    """Return the cases of earthquakes that push the block downstream and upstream with their seismic coefficients.

    The concrete's inertia acts at its centroid, the water's pressure on the faces, both the same way; the vertical
    coefficient lifts the block or presses it down, a case each, which says what checks it governs. `before` is the
    usual case: the crack that it has opened is open already and no longer bonded.
    """
    contact, water, source = _in_earthquake(case, before)
    solved: list[Solved] = []
    ways = (("downstream", -1.0), ("upstream", 1.0))
    for earthquake, (way, sign) in product(case.statics.pseudo_static, ways):
        horizontal, vertical = earthquake.seismic_coefficient, earthquake.vertical_seismic_coefficient
        called = f"{plain(earthquake.name)}, " if earthquake.name else ""
        loads, taken = _rarity(case, earthquake)
        tried = []
        for name, up in ((", lifting", -1.0), (", pressing", 1.0)) if vertical else (("", 0.0),):
            ground = sign * horizontal, up * vertical
            question = Question(
                f"{called}pseudo-static {way}{name}",
                loads,
                case.crack.apparent_friction,
                bond_of(case).cohesion,
                (Sentence(f"uplift: {source}"), *taken, *_about_bond(case)),
                sources_of(case) | sources_of_inertia(case, *ground),
                peak_of(case.crack),
            )
            tried.append(solve_case(question, case, (*_dry(case), *_inertia(case, *ground)), contact, water))
        solved += governing(tried) if vertical else tried
    return tuple(solved)


def response_spectrum(case: Case, before: Solved, demand: SpectralDemand) -> tuple[Solved, ...]:
    """Return the cases of an earthquake by its response spectrum, pushing the block downstream and upstream.

    `before` is the usual case, as in :func:`pseudo_static`.
    """
    contact, water, source = _in_earthquake(case, before)
    name = "response spectrum"
    modes = tuple(
        Sentence.of(
            "{which} mode with water and rock {period_s:.3g} s, {damping:.3g} of damping: {acceleration:.3g} g by "
            "{spectrum}, whose zero period has {zero:.3g} g",
            which=which,
            period_s=mode.period_s,
            damping=mode.damping_ratio,
            acceleration=mode.pseudo_acceleration_m_s2 / case.gravity,
            spectrum=plain(demand.spectrum),
            zero=demand.peak_ground_acceleration_m_s2 / case.gravity,
        )
        for which, mode in (("first", demand.first_mode), ("second", demand.second_mode))
        if mode is not None
    )
    taken = (
        Sentence(f"uplift: {source}"),
        *modes,
        Sentence(
            "higher modes follow the ground at once (static correction); what goes with the ground is summed (Gupta "
            "1990), the rest joins it by the root of the sum of squares, with the signs of the first mode; no vertical "
            "motion"
        ),
    )
    solved = []
    for way, sign in (("downstream", 1.0), ("upstream", -1.0)):
        question = Question(
            f"{name} {way}",
            "earthquake",
            case.crack.apparent_friction,
            bond_of(case).cohesion,
            (*taken, *_about_bond(case)),
            sources_of(case) | {name: Sentence("first mode and static correction, concrete and water together")},
            peak_of(case.crack),
        )
        force = scaled(name, demand.push(), sign)
        solved.append(solve_case(question, case, (*_dry(case), force), contact, water))
    return tuple(solved)


def _in_earthquake(case: Case, before: Solved) -> tuple[Contact, StillWater, str]:
    """Return what is bonded of the crack, and the water in it, while an earthquake pushes; and whose rule that is."""
    law, source = rules_of(case).uplift
    still = _contact(case)
    opened = before.settled.heel_crack, before.settled.toe_crack
    contact = replace(
        still,
        bonded_from=max(still.bonded_from, still.start + opened[0]),
        bonded_to=still.end - opened[1],
    )
    water = water_in_earthquake(before.settled.profile, still_water(case, still.start, still.end), opened, law)
    return contact, water, source


def _rarity(case: Case, earthquake: StaticsEarthquake) -> tuple[Loads, tuple[Sentence, ...]]:
    """Return the load category of an earthquake by the criteria, and a remark on it.

    USACE EM 1110-2-2100 (2005) has the operating basis earthquake among the unusual loads and the maximum design
    earthquake among the extreme ones; criteria of the user's own may tell them apart, the others do not.
    """
    if not earthquake.is_unusual:
        return "earthquake", ()
    if case.statics.criteria_file is not None or case.statics.criteria == "USACE":
        return "unusual", (Sentence.of("{name} is an unusual load", name=plain(earthquake.name)),)
    text = f"{case.statics.criteria} has one set of factors for every earthquake"
    return "earthquake", (Sentence(text),)


def post_seismic(case: Case, slip: float, source: str, ligament: tuple[float, float] | None = None) -> Solved | None:
    """Return the usual loads on the block where the earthquake has left it; None where it has slid off its crack.

    Parameters
    ----------
    case
        As before the earthquake.
    slip
        Residual slip, positive downstream [m].
    source
        Where the slip comes from.
    ligament
        From where to where a bonded joint still holds [m from the heel]; None of a crack.
    """
    width, size, choice = case.cut.crack_width, abs(slip), case.statics
    if size >= width:
        return None
    friction = choice.residual_friction if choice.residual_friction is not None else case.crack.mu_kinetic
    way, kind = (
        "downstream" if slip >= 0.0 else "upstream",
        "kinetic" if choice.residual_friction is None else "residual",
    )
    law = residual_of(case.crack) if choice.residual_friction is None else None
    falling = _falls(case, slip)
    if falling and law is None and choice.residual_friction is None:
        friction = math.tan(max(math.atan(friction) - falling, 0.0))
        kind = "kinetic, on a flank of the asperities that falls in the direction of the push, tan(φ - i)"
    words = f"friction {friction:g}, {kind}" if law is None else "friction that all slip leaves, by crack.law"
    bond = bond_of(case)
    held = None if ligament is None else (max(ligament[0], bond.start), ligament[1])
    assumptions = [Sentence.of("slip {slip_m:.4f m} {way}: {source}", slip_m=size, way=way, source=source)]
    if held is None and case.crack.bond is not None and source in _NO_RUN:
        lost = "whether the earthquake breaks the joint is not known without its run: no cohesion, no tensile strength"
        assumptions.append(Sentence(f"{words}; {lost}"))
    elif held is None:
        assumptions.append(Sentence(f"{words}; the crack has slid: no cohesion, no tensile strength"))
    else:
        text = (
            "{words}; the joint holds over {left_m:.3f m} of its {width_m:.3f m}; there alone count the static "
            f"cohesion and tensile strength of {bond.source}"
        )
        left = max(0.0, held[1] - held[0])
        assumptions.append(Sentence.of(text, words=words, left_m=left, width_m=width))
    if size:
        text = (
            "the block stands on {left_m:.3f m} of its {width_m:.3f m}, whether or not the ground goes on beyond the "
            "toe; uplift acts as its pattern on what is left, free water on the rest"
        )
        assumptions.append(Sentence.of(text, left_m=width - size, width_m=width))
    if case.uplift.pattern == "drained" and size:
        if choice.drain_diameter is None:
            assumptions.append(Sentence("drains as before: statics.drain_diameter is not given"))
        else:
            share = drainage_left(case, slip)
            text = "slip over a drain diameter of {diameter_m:g m} leaves {share:.3g} of the drainage"
            if choice.closed_drains == "linear":
                text += "; closed drains leave the uplift linear from heel to toe"
            assumptions.append(Sentence.of(text, diameter_m=choice.drain_diameter, share=share))
            case = with_drainage(case, share)
    if case.anchors and size:
        assumptions.append(Sentence("prestress of the anchors as before the slip"))
    start, end = (0.0, width - size) if slip >= 0.0 else (size, width)
    contact = Contact(start, end, bonded_from=end)
    if held is not None:
        contact = Contact(start, end, held[0], bond.tensile_strength, held[1])
    water = still_water(case, start, end)
    matches = not size
    if not matches and climbs(case.crack.kinks):
        text = (
            "after the slip the two faces no longer match, and the block touches a few places of them: it is judged on "
            "the straight line from heel to toe, and its kinks count for nothing"
        )
        assumptions.append(Sentence(text))
    cohesion = 0.0 if held is None else bond.cohesion
    question = Question(
        "post-seismic", "post-earthquake", friction, cohesion, tuple(assumptions), sources_of(case), law, matches
    )
    return solve_case(question, case, _dry(case), contact, water)


def _falls(case: Case, slip: float) -> float:
    """Return the angle of the flank of a rough crack on which a slip leaves the block [rad], where that falls in the
    direction in which the static loads push; zero where it rises or the crack is smooth. It is that of a new crack: a
    worn flank is flatter, and bears more."""
    rough = case.crack.roughness
    if rough is None or not slip:
        return 0.0
    # Downstream of a valley a flank rises for half a wave, and then falls.
    place = slip % rough.wave_length / rough.wave_length
    pushed = total("all", [across_crack(force, case.cut) for force in _dry(case)]).horizontal
    falls = 0.5 < place < 1.0 if pushed >= 0.0 else 0.0 < place < 0.5
    return rough.angle if falls else 0.0


@dataclass(frozen=True)
class JointBond:
    """Bond of a joint that the checks count before the earthquake, from a place to the toe.

    Attributes
    ----------
    start
        Where it begins, from the heel [m].
    tensile_strength, cohesion
        Static [Pa].
    source
        Field that gives it.
    """

    start: float
    tensile_strength: float
    cohesion: float
    source: str


def bond_of(case: Case) -> JointBond:
    """Return the bond that the checks count, in all load cases by one rule: that of ``[statics]`` where the case gives
    one of its fields, else that of ``[crack.bond]`` over the whole joint."""
    width, choice, bond, law = case.cut.crack_width, case.statics, case.crack.bond, case.crack.law
    if bond is not None and not choice.has_own_bond:
        return JointBond(0.0, bond.tensile_strength, bond.cohesion, "crack.bond")
    # The cohesion of a law is that of the whole crack, unless the case says how much of it is bonded.
    whole = law is not None and law.cohesion is not None and "bonded" not in choice.model_fields_set
    bonded = 1.0 if whole else choice.bonded
    return JointBond((1.0 - bonded) * width, choice.tensile_strength, choice.cohesion, "statics")


def _about_bond(case: Case) -> tuple[Sentence, ...]:
    """Say what counts of the bond of a joint."""
    bond, width = case.crack.bond, case.cut.crack_width
    if bond is None:
        return ()
    counted = bond_of(case)
    if counted.source == "crack.bond":
        text = (
            "the joint of {width_m:.3f m} is bonded: static cohesion {cohesion_pa:.4g MPa} and tensile strength "
            "{tension_pa:.4g MPa} of crack.bond"
        )
        return (Sentence.of(text, width_m=width, cohesion_pa=counted.cohesion, tension_pa=counted.tensile_strength),)
    text = "bonded, cohesion and tensile_strength of statics go before those of crack.bond: bonded over {left_m:.3f m}"
    return (Sentence.of(text, left_m=width - counted.start),)


def _contact(case: Case) -> Contact:
    bond = bond_of(case)
    return Contact(0.0, case.cut.crack_width, bond.start, bond.tensile_strength)


def _dry(case: Case) -> tuple[Resultant, ...]:
    """Return all forces but those of the water in the crack."""
    return tuple(force for force in static_forces(case) if force.name != "uplift")


def _inertia(case: Case, horizontal: float, vertical: float) -> tuple[Resultant, ...]:
    """Return the forces of a ground acceleration in g, downstream and upward."""
    weight = concrete_mass(case) * case.gravity
    place = case.above.centroid_from_heel
    forces = [
        Resultant.at("inertia", (-weight * horizontal, -weight * vertical), place),
        moving_force(case, horizontal * case.gravity),
    ]
    sides = {"reservoir": case.reservoir, "nappe": case.reservoir, "tailwater": case.tailwater}
    for force in static_forces(case):
        side = sides.get(force.name)
        if side is not None and side.follows_vertical_motion and vertical:
            forces.append(scaled(f"{force.name} in vertical motion", force, vertical))
    return tuple(forces)


def _still(name: str, loads: Loads, case: Case, assumptions: tuple[Sentence, ...]) -> Solved:
    """Return a case of still water on the crack as it is before the earthquake."""
    contact = _contact(case)
    water = still_water(case, contact.start, contact.end)
    friction, cohesion = case.crack.apparent_friction, bond_of(case).cohesion
    taken = (*assumptions, *_about_bond(case))
    question = Question(name, loads, friction, cohesion, taken, sources_of(case), peak_of(case.crack))
    return solve_case(question, case, _dry(case), contact, water)


_OUTCOMES = ("stands", "cracks through", "floats")


def _smallest(value: float | None) -> float:
    """Return what grows as a factor falls; nothing that pushes is nothing to fear."""
    return -math.inf if value is None else -value


def _eccentricity(load_case: LoadCase) -> float:
    return math.inf if load_case.eccentricity_m is None else abs(load_case.eccentricity_m) / load_case.contact_width_m


def _stress(load_case: LoadCase) -> float:
    if load_case.heel_stress_pa is None or load_case.toe_stress_pa is None:
        return math.inf
    return max(load_case.heel_stress_pa, load_case.toe_stress_pa)


# What is the worse the larger it is, by the names of the checks.
_WORSE: dict[str, Callable[[LoadCase], float]] = {
    "equilibrium": lambda load_case: float(_OUTCOMES.index(load_case.outcome)),
    "sliding factor": lambda load_case: _smallest(load_case.sliding_factor),
    "overturning factor": lambda load_case: _smallest(load_case.overturning_factor),
    "flotation factor": lambda load_case: _smallest(load_case.flotation_factor),
    "resultant": _eccentricity,
    "compression": _stress,
}


def governing(tried: Sequence[Solved]) -> tuple[Solved, ...]:
    """Return the same load cases, each with the checks that it governs: those of which it is the worst, the first of
    them where several are as bad."""
    governed: list[list[str]] = [[] for _ in tried]
    for name, worse in _WORSE.items():
        values = [worse(solved.load_case) for solved in tried]
        governed[values.index(max(values))].append(name)
    return tuple(
        replace(solved, load_case=replace(solved.load_case, governs=tuple(names)))
        for solved, names in zip(tried, governed, strict=True)
    )
