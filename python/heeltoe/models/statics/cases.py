"""The load cases of the static checks: usual, flood, pseudo-static both ways, after the earthquake."""

from __future__ import annotations

import math
from dataclasses import replace

from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.mechanics.loads import Resultant, concrete_mass, static_forces
from heeltoe.mechanics.virtual_water import virtual_mass
from heeltoe.models.statics.checks import check_case
from heeltoe.models.statics.contact import Contact
from heeltoe.models.statics.criteria import UPLIFT_IN_EARTHQUAKE, Loads
from heeltoe.models.statics.load_case import Given, Solved, solve_case
from heeltoe.models.statics.sheet import sources_of, sources_of_inertia
from heeltoe.models.statics.water import still_water, water_in_earthquake
from heeltoe.units.sentences import Sentence


def usual(case: Case) -> Solved:
    """Return the case of the loads that are always there."""
    return _still("usual", "usual", case, ())


def flood(case: Case) -> Solved:
    """Return the case of the flood; the ice is gone then."""
    choice = case.statics
    assert choice.flood_depth is not None
    risen = at_depth(case, choice.flood_depth)
    if choice.flood_tailwater is not None:
        risen = risen.model_copy(update={"tailwater": _water(case.tailwater, choice.flood_tailwater)})
    text = f"reservoir {{depth_m:g m}} deep, an {choice.flood_rarity} load"
    said = [Sentence.of(text, depth_m=choice.flood_depth)]
    if case.ice is not None:
        risen = risen.model_copy(update={"ice": None})
        said.append(Sentence("no ice in the flood"))
    return _still("flood", choice.flood_rarity, risen, tuple(said))


def at_depth(case: Case, depth: float) -> Case:
    """Return the case with another depth of the reservoir [m]; fresh water where it had none."""
    return case.model_copy(update={"reservoir": _water(case.reservoir, depth)})


def pseudo_static(case: Case, before: Solved) -> tuple[Solved, ...]:
    """Return the cases of a seismic coefficient that pushes the block downstream and upstream.

    The concrete's inertia acts at its centroid, Westergaard's water on the upstream face, both the same way; the
    vertical coefficient acts up or down, whichever leaves more checks unmet, or the smaller sliding factor where both
    leave as many. Where the other leaves one unmet that this meets, it is a case of its own. `before` is the usual
    case: the crack that it has opened is open already and no longer bonded.
    """
    horizontal = case.statics.seismic_coefficient
    assert horizontal is not None
    vanishes, source = UPLIFT_IN_EARTHQUAKE[case.statics.criteria]
    still = _contact(case)
    opened = before.settled.heel_crack
    contact = replace(
        still,
        bonded_from=max(still.bonded_from, still.start + opened),
        bonded_to=still.end - before.settled.toe_crack,
    )
    water = water_in_earthquake(before.settled.profile, still.start, still.end, opened, vanishes=vanishes)
    vertical = case.statics.vertical_seismic_coefficient
    found: list[Solved] = []
    for way, sign in (("downstream", -1.0), ("upstream", 1.0)):
        tried = []
        for up in (-1.0, 1.0) if vertical else (0.0,):
            forces = (*_dry(case), *_inertia(case, sign * horizontal, up * vertical))
            said = [Sentence(f"uplift: {source}")]
            if vertical:
                way_up = "down" if up > 0.0 else "up"
                said.append(Sentence(f"vertical coefficient {way_up}ward on the block"))
            sources = sources_of(case) | sources_of_inertia(case, sign * horizontal, up * vertical)
            given = Given(
                f"pseudo-static {way}", "earthquake", case.crack.mu_static, case.statics.cohesion, tuple(said), sources
            )
            tried.append(solve_case(given, case.cut, forces, contact, water))
        found += _worse(case, tried)
    return tuple(found)


def _worse(case: Case, tried: list[Solved]) -> list[Solved]:
    """Return the worse direction of the vertical coefficient, and the other if it misses what that one meets."""

    def missed(each: Solved) -> set[str]:
        return {check.name for check in check_case(each.load_case, case.statics) if not check.met}

    first, *others = sorted(tried, key=lambda each: (-len(missed(each)), _or_infinite(each.load_case.sliding_factor)))
    return [first, *(each for each in others if missed(each) - missed(first))]


def post_seismic(case: Case, slip: float, source: str) -> Solved | None:
    """Return the usual loads on the block where the earthquake has left it; None where it has slid off its crack.

    Parameters
    ----------
    case
        As before the earthquake.
    slip
        Residual slip, positive downstream [m].
    source
        Where the slip comes from.
    """
    width, size, choice = case.cut.crack_width, abs(slip), case.statics
    if size >= width:
        return None
    friction = choice.residual_friction if choice.residual_friction is not None else case.crack.mu_kinetic
    way, kind = (
        "downstream" if slip >= 0.0 else "upstream",
        "kinetic" if choice.residual_friction is None else "residual",
    )
    said = [
        Sentence.of("slip {slip_m:.4f m} {way}: {source}", slip_m=size, way=way, source=source),
        Sentence(f"friction {friction:g}, {kind}; the crack has slid: no cohesion, no tensile strength"),
    ]
    if size:
        text = (
            "the block stands on {left_m:.3f m} of its {width_m:.3f m}, whether or not the ground goes on beyond the "
            "toe; uplift acts as its pattern on what is left, free water on the rest"
        )
        said.append(Sentence.of(text, left_m=width - size, width_m=width))
    if case.uplift.pattern == "drained" and size:
        if choice.drain_diameter is None:
            said.append(Sentence("drains as before: statics.drain_diameter is not given"))
        else:
            share = max(0.0, 1.0 - size / choice.drain_diameter)
            text = "slip over a drain diameter of {diameter_m:g m} leaves {share:.3g} of the drainage"
            said.append(Sentence.of(text, diameter_m=choice.drain_diameter, share=share))
            efficiency = share * (case.uplift.drain_efficiency or 0.0)
            case = case.model_copy(update={"uplift": case.uplift.model_copy(update={"drain_efficiency": efficiency})})
    if case.anchors and size:
        said.append(Sentence("prestress of the anchors as before the slip"))
    start, end = (0.0, width - size) if slip >= 0.0 else (size, width)
    contact = Contact(start, end, bonded_from=end)
    water = still_water(case, start, end)
    given = Given("post-seismic", "post-earthquake", friction, 0.0, tuple(said), sources_of(case))
    return solve_case(given, case.cut, _dry(case), contact, water)


def _water(water: Water | None, depth: float) -> Water:
    return (water or Water.model_validate({"depth": "1 m"})).model_copy(update={"depth": depth})


def _contact(case: Case) -> Contact:
    width = case.cut.crack_width
    return Contact(0.0, width, (1.0 - case.statics.bonded) * width, case.statics.tensile_strength)


def _dry(case: Case) -> tuple[Resultant, ...]:
    """Return all forces but those of the water in the crack."""
    return tuple(force for force in static_forces(case) if force.name != "uplift")


def _inertia(case: Case, horizontal: float, vertical: float) -> tuple[Resultant, ...]:
    """Return the forces of a ground acceleration in g, downstream and upward."""
    g, mass, moved = case.gravity, concrete_mass(case), virtual_mass(case)
    section = case.cut
    x, z = section.centroid[0] - section.heel[0], section.centroid[1] - section.heel[1]
    push, lift = -mass * g * horizontal, -mass * g * vertical
    water = -moved.mass * g * horizontal
    forces = [
        Resultant.at("inertia", (push, lift), (x, z)),
        Resultant.at("hydrodynamic", (water, 0.0), (0.0, moved.height)),
    ]
    for force, side in zip(static_forces(case)[1:3], (case.reservoir, case.tailwater), strict=True):
        if side is not None and side.follows_vertical_motion and vertical:
            forces.append(
                Resultant(
                    f"{force.name} in vertical motion",
                    vertical * force.horizontal,
                    vertical * force.vertical,
                    vertical * force.moment,
                    lift_moment=vertical * force.lift_moment,
                )
            )
    return tuple(forces)


def _still(name: str, loads: Loads, case: Case, said: tuple[Sentence, ...]) -> Solved:
    """Return a case of still water on the crack as it is before the earthquake."""
    contact = _contact(case)
    water = still_water(case, contact.start, contact.end)
    given = Given(name, loads, case.crack.mu_static, case.statics.cohesion, said, sources_of(case))
    return solve_case(given, case.cut, _dry(case), contact, water)


def _or_infinite(value: float | None) -> float:
    return math.inf if value is None else value
