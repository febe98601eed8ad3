"""The rock below a meshed dam, tied to the crack at its base by contact, ready for the kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.cache import Kept
from heeltoe.case.dam import Rock
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.models.flexible.body.elastic import Body
from heeltoe.models.flexible.surroundings.rock import EXTENT, ReducedRock, RockMaterial, reduced_rock

# Frequency [Hz] up to which the rock answers well.
_HIGHEST = 15.0
# The level surface goes on beyond heel and toe by so many edges of the mesh, on which a dam that slides stands.
_BEYOND = 1
# A base that rises by no more than this part of its width is level.
_LEVEL = 1e-6


_KEPT: Kept[ReducedRock] = Kept(8)


@dataclass(frozen=True, eq=False)
class RockBody:
    """The rock in its modes; m modes, k nodes.

    Attributes
    ----------
    omega_squared, damping
        As those of :class:`heeltoe.models.flexible.surroundings.rock.ReducedRock`, (m,) and (m, m).
    shapes
        (m, 2 k) motion of the nodes of the surface, all downstream, then all upward.
    points
        (k, 2) where these are, x and z [m].
    """

    omega_squared: Floats
    damping: Floats
    shapes: Floats
    points: Floats


def rock_body(case: Case, lowest: Body, *, larger: float = 1.0) -> RockBody | None:
    """Return the rock below the part of the dam that stands on it by a crack; None on a rigid plane.

    Parameters
    ----------
    case
        With `rock`.
    lowest
        The part above the crack at the base.
    larger
        Factor on the extent of the rock that is meshed.

    Raises
    ------
    InputError
        Where the base is not level.
    """
    if case.rock is None:
        return None
    cut = case.single_crack_cases[-1].cut
    base = lowest.mesh.nodes[lowest.mesh.faces[-1]]
    rise = float(np.ptp(base[:, 1]))
    if rise > _LEVEL * cut.crack_width:
        raise InputError("rock-level", "rock", f"{rise:.3g} m")
    first, last = base[2] - base[0], base[-1] - base[-3]
    ahead = [base[0] - (_BEYOND - k / 2.0) * first for k in range(2 * _BEYOND)]
    behind = [base[-1] + (k + 1) / 2.0 * last for k in range(2 * _BEYOND)]
    points = np.vstack([*ahead, base, *behind])
    material = rock_material(case.rock)
    extent = larger * EXTENT
    # The same rock lies below dams that differ in all else.
    key = (points.tobytes(), material, extent)
    reduced = _KEPT.get(key, lambda: reduced_rock(points, material, highest=_HIGHEST, extent=extent))
    count = reduced.omega_squared.size
    shapes = reduced.shapes.T.reshape(count, -1, 2).swapaxes(1, 2).reshape(count, -1)
    return RockBody(reduced.omega_squared, reduced.damping, np.ascontiguousarray(shapes), points)


def rock_material(rock: Rock) -> RockMaterial:
    """Return the rock of a case as a material."""
    return RockMaterial(
        rock.modulus,
        rock.poisson,
        rock.density,
        damping=rock.damping,
        radiation=rock.radiation,
        massless=rock.massless,
    )
