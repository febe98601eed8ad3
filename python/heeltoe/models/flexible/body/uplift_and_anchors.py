"""Forces in a crack besides contact, for the kernel: water whose pressure changes, and anchors that stretch."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.geometry.axes import along_and_across
from heeltoe.kernel.dam import CrackAnchor, FollowingWater, RisingWater
from heeltoe.mechanics.drains import with_drainage
from heeltoe.models.flexible.body.loads import crack_point, full_head_profile, uplift_forces
from heeltoe.models.flexible.body.rock import RockBody
from heeltoe.models.flexible.mesh.dam import BodyMesh


def following_water(alone: Case, faces: Sequence[BodyMesh], rock: RockBody | None = None) -> FollowingWater | None:
    """Return the water of a crack, None where its pressure is constant.

    Parameters
    ----------
    alone
        The case with that crack alone.
    faces
        The meshes above and, if there is one, below it, with its face alone.
    rock
        The rock, where the crack is on it.
    """
    if alone.uplift.during_shaking == "constant":
        return None
    full = _across(alone, faces, rock, full_head_profile(alone))
    still = _across(alone, faces, rock)
    return FollowingWater(alone.uplift.during_shaking, alone.uplift.opening_of_change, still, full)


def rising_water(
    alone: Case,
    crack: int,
    faces: Sequence[BodyMesh],
    rock: RockBody | None,
    drainage: Sequence[tuple[float, float, float]],
) -> tuple[RisingWater, ...]:
    """Return how the uplift of a crack changes as its drains close, as :func:`following_water`: between which moments
    [s], and what of the drainage is left after them."""
    result, before = [], alone
    for begin, end, share in drainage:
        after = with_drainage(alone, share)
        change = tuple(b - a for a, b in zip(_across(before, faces, rock), _across(after, faces, rock), strict=True))
        result.append(RisingWater(crack, (begin, end), change))
        before = after
    return tuple(result)


def _across(
    alone: Case, faces: Sequence[BodyMesh], rock: RockBody | None, profile: Floats | None = None
) -> tuple[Floats, ...]:
    """Return the forces of the water on the nodes of either face, across the crack [N]. The rock bears those of a dam
    on it the other way round."""
    result = []
    for side, mesh in enumerate(faces):
        forces = uplift_forces(mesh, alone, above=side == 0, profile=profile)
        turned = along_and_across(forces.reshape(-1, 2)[mesh.crack], alone.cut)
        result.append(np.ascontiguousarray(turned[:, 1]))
    if rock is not None:
        result.append(np.pad(-result[-1], rock.beyond))
    return tuple(result)


def water_on_rock(alone: Case, faces: Sequence[BodyMesh], rock: RockBody) -> Floats:
    """Return what the water in a crack at rest does to the rock below, in the modes of the rock (m,)."""
    across = _across(alone, faces, rock)[-1]
    load: Floats = rock.shapes[:, across.size :] @ across
    return load


def crack_anchors(alone: Case, faces: Sequence[BodyMesh], rock: RockBody | None = None) -> tuple[CrackAnchor, ...]:
    """Return the anchors of a crack that have a stiffness, as :func:`following_water`; prestress alone is a constant
    load."""
    result = []
    for place, anchor in enumerate(alone.anchors_at_crack):
        if not anchor.yields:
            continue
        points = []
        for mesh in faces:
            nodes, shares = crack_point(mesh, alone.cut, anchor.distance)
            points.append(tuple(zip(nodes.tolist(), shares.tolist(), strict=True)))
        if rock is not None:
            points.append(tuple((rock.beyond + node, share) for node, share in points[-1]))
        axis = (math.sin(anchor.inclination), math.cos(anchor.inclination))
        result.append(
            CrackAnchor(
                place,
                tuple(points),
                axis,
                anchor.prestress,
                anchor.axial_stiffness,
                anchor.shear_stiffness,
                math.inf if anchor.capacity is None else anchor.capacity,
            )
        )
    return tuple(result)
