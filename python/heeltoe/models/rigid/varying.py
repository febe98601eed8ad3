"""Which blocks the exact kernel cannot take, since loads, friction or geometry change as they move, and what the other
one needs to know of them."""

from __future__ import annotations

import numpy as np

from heeltoe.case.model import Case
from heeltoe.kernel.block import VARYING, Varying
from heeltoe.mechanics.block import Block, across_crack
from heeltoe.mechanics.drains import close_by_slip
from heeltoe.mechanics.friction import crack_law
from heeltoe.mechanics.loads import face_at, total, uplift_profile, water_above_crack


def varies(case: Case) -> bool:
    """Whether loads, friction or geometry change as the block moves: then there are no closed forms between events."""
    return (
        case.analysis.rotation != "small"
        or case.uplift.during_shaking != "constant"
        or case.crack.law is not None
        or case.crack.roughness is not None
        or any(anchor.yields for anchor in case.anchors)
    )


def by_itself(case: Case) -> bool:
    """Whether the block of a case must run by itself, not side by side with others: something varies as it moves, or
    between the motions of its sequence."""
    return varies(case) or (bool(case.aftershocks) and close_by_slip(case))


def varying(case: Case, block: Block) -> Varying:
    """Gather what changes. Dead loads keep their directions and act on points of the block, which turn with it."""
    section = block.section
    uplift = case.uplift
    moves = ("weight", "uplift", "anchors")
    dead = across_crack(total("dead", (force for force in block.forces if force.name not in moves)), section)
    centroid = section.in_crack_frame(*section.centroid_from_heel)
    water = section.in_crack_frame(face_at(section, block.water.height), block.water.height)
    horizontal = section.in_crack_frame(1.0, 0.0)
    following = across_crack(total("following", block.following), section)
    g, rough = case.gravity, case.crack.roughness
    profile = uplift_profile(case)
    full = 0.0
    if case.reservoir is not None:
        full = case.reservoir.density * g * water_above_crack(case, case.reservoir)
    numbers = {
        "mass": case.concrete.density * section.area,
        # What the water adds falls with the square of the cosine of a rotation; water that runs up a tilted face is not
        # Westergaard's either.
        "inertia": case.concrete.density * section.polar_inertia + block.water.inertia,
        "centroid_along": centroid[0],
        "centroid_across": centroid[1],
        "water_mass": block.water.mass,
        "water_along": water[0],
        "water_across": water[1],
        "horizontal_along": horizontal[0],
        "horizontal_across": horizontal[1],
        "gravity": g,
        "width": block.width,
        "dead_along": dead.horizontal,
        "dead_across": dead.vertical,
        "dead_moment": dead.moment,
        "dead_virial": dead.virial,
        "per_vertical_along": following.horizontal / g,
        "per_vertical_across": following.vertical / g,
        "per_vertical_moment": following.moment / g,
        "per_vertical_virial": following.virial / g,
        "opening": uplift.opening_of_change,
        "full_pressure": full,
    }
    anchors = [
        (
            anchor.distance,
            np.sin(anchor.inclination),
            np.cos(anchor.inclination),
            anchor.prestress,
            anchor.axial_stiffness,
            anchor.shear_stiffness,
            np.inf if anchor.capacity is None else anchor.capacity,
        )
        for anchor in case.anchors_at_crack
    ]
    return Varying(
        numbers=np.array([numbers[name] for name in VARYING]),
        rotation=case.analysis.rotation,
        law=uplift.during_shaking,
        pressure=np.ascontiguousarray(profile),
        anchors=np.array(anchors, dtype=np.float64).reshape(-1, 7),
        friction=None if case.crack.law is None and rough is None else crack_law(case.crack),
        asperities=None if rough is None else np.array([rough.asperity_height, rough.wave_length, rough.wear]),
    )
