"""What acts in the crack beside contact, for the kernel: water whose pressure follows the opening, and anchors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.geometry.axes import along_and_across
from heeltoe.kernel.dam import RisingWater
from heeltoe.mechanics.drains import with_drainage
from heeltoe.models.flexible.body.elastic import Body
from heeltoe.models.flexible.body.loads import crack_point, full_head_profile, uplift_forces
from heeltoe.models.flexible.body.rock import RockBody


@dataclass(frozen=True, eq=False)
class FollowingWater:
    """Water in the crack whose pressure changes as the crack opens.

    Attributes
    ----------
    law
        A choice of ``uplift.during_shaking`` other than "constant".
    opening
        Over which it changes [m].
    still, full
        Forces of each node of the upper and, if there is one, of the lower face, across the crack, positive away from
        the lower part: at the static pressure and at that of the reservoir at the heel, (k,) each [N].
    """

    law: str
    opening: float
    still: tuple[Floats, ...]
    full: tuple[Floats, ...]


@dataclass(frozen=True)
class CrackAnchor:
    """An anchor with stiffness.

    Attributes
    ----------
    points
        Where it crosses the upper and, if there is one, the lower face: nodes of the crack from 0 with their shares.
    axis
        Direction along and across the crack.
    prestress, axial_stiffness, shear_stiffness
        Tension at the start [N], what it gains by opening along its axis and resistance by slip [N/m].
    """

    points: tuple[tuple[tuple[int, float], ...], ...]
    axis: tuple[float, float]
    prestress: float
    axial_stiffness: float
    shear_stiffness: float


def following_water(case: Case, bodies: tuple[Body, ...], rock: RockBody | None = None) -> FollowingWater | None:
    """Return the water of a case, None where its pressure is constant."""
    if case.uplift.during_shaking == "constant":
        return None
    full = _across(case, bodies, rock, full_head_profile(case))
    still = _across(case, bodies, rock)
    return FollowingWater(case.uplift.during_shaking, case.uplift.opening_of_change, still, full)


def rising_water(
    case: Case, bodies: tuple[Body, ...], rock: RockBody | None, drainage: Sequence[tuple[float, float, float]]
) -> tuple[RisingWater, ...]:
    """Return how the uplift of a case changes as its drains close: between which moments [s], and what of the drainage
    is left after them."""
    result, before = [], case
    for begin, end, share in drainage:
        after = with_drainage(case, share)
        change = tuple(b - a for a, b in zip(_across(before, bodies, rock), _across(after, bodies, rock), strict=True))
        result.append(RisingWater((begin, end), change))
        before = after
    return tuple(result)


def _across(
    case: Case, bodies: tuple[Body, ...], rock: RockBody | None, profile: Floats | None = None
) -> tuple[Floats, ...]:
    """Return the forces of the water on the nodes of either face, across the crack [N]. The rock bears those of a dam
    on it the other way round; to what it bears at rest it has settled, and it moves by their changes."""
    result = []
    for place, body in enumerate(bodies):
        forces = uplift_forces(body.mesh, case, above=place == 0, profile=profile)
        turned = along_and_across(forces.reshape(-1, 2)[body.mesh.crack], case.cut)
        result.append(np.ascontiguousarray(turned[:, 1]))
    if rock is not None:
        result.append(np.pad(-result[-1], rock.beyond))
    return tuple(result)


def crack_anchors(case: Case, bodies: tuple[Body, ...], rock: RockBody | None = None) -> tuple[CrackAnchor, ...]:
    """Return the anchors of a case that have a stiffness; prestress alone is a constant load."""
    result = []
    for anchor in case.anchors_at_crack:
        if not anchor.yields:
            continue
        points = []
        for body in bodies:
            nodes, shares = crack_point(body.mesh, case.cut, anchor.distance)
            points.append(tuple(zip(nodes.tolist(), shares.tolist(), strict=True)))
        if rock is not None:
            points.append(tuple((rock.beyond + node, share) for node, share in points[-1]))
        axis = (math.sin(anchor.inclination), math.cos(anchor.inclination))
        result.append(
            CrackAnchor(tuple(points), axis, anchor.prestress, anchor.axial_stiffness, anchor.shear_stiffness)
        )
    return tuple(result)
