"""The rock below a meshed dam, ready for the kernel: under a crack at its base, or one body with its lowest part."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from heeltoe.base.arrays import Floats
from heeltoe.base.cache import Kept
from heeltoe.case.dam import Rock
from heeltoe.case.model import Case
from heeltoe.case.surroundings import LEVEL
from heeltoe.errors.error import InputError
from heeltoe.mechanics.beam import band_of
from heeltoe.models.flexible.body.bonded import BondedDam
from heeltoe.models.flexible.body.elastic import Body, Dam, base_shapes, dofs, held_alone, side_by_side
from heeltoe.models.flexible.body.modes import Modes
from heeltoe.models.flexible.surroundings.reduction import congruent
from heeltoe.models.flexible.surroundings.response import base_nodes
from heeltoe.models.flexible.surroundings.rock import (
    BEYOND,
    EXTENT,
    ReducedRock,
    RockMaterial,
    halvings,
    reduced_rock,
)

# Nodes are one but for this part of the width.
_SAME = 1e-10


_KEPT: Kept[ReducedRock] = Kept(8)


@dataclass(frozen=True, eq=False)
class RockBody:
    """The rock in its modes; m modes, k nodes.

    Attributes
    ----------
    omega_squared, damping
        As those of :class:`heeltoe.models.flexible.surroundings.rock.ReducedRock`, (m,) and (m, m).
    shapes
        (m, 2 k) motion of the nodes of the surface, all downstream, then all upward; (m, k) across the valley.
    points
        (k, 2) where these are, x and z [m].
    error
        That of the rock in few unknowns, see there.
    pressed
        (m,) what the water in the crack at rest does to it.
    beyond
        How many of them are beyond the heel, and beyond the toe.
    """

    omega_squared: Floats
    damping: Floats
    shapes: Floats
    points: Floats
    error: float
    pressed: Floats
    beyond: int = 2 * BEYOND


@dataclass(frozen=True, eq=False)
class Founded:
    """A dam whose lowest part is bonded to the rock and one body with it; m modes of both, h of the part on a base that
    is still.

    Attributes
    ----------
    modes
        Of both; their shapes are those of the nodes of the part.
    held
        (h, m) share of each mode of both in those of the part on a base that is still.
    bent
        (m, m) stiffness of the concrete that the motion of its base bends [1/s2].
    rock
        (m, m) damping of the rock [1/s].
    displacements
        Of all parts under the static loads, the cracks bonded, one after the other [m].
    settled
        (m,) state of the rock then.
    error
        As that of :class:`RockBody`.
    """

    modes: Modes
    held: Floats
    bent: Floats
    rock: Floats
    displacements: Floats
    settled: Floats
    error: float


def founded(case: Case, bonded: BondedDam, *, larger: float = 1.0, shapes_of: float | None = None) -> Founded | None:
    """Return a dam whose lowest part, below all cracks, is one body with the rock; None on a rigid plane, or where the
    dam is cracked at its base.

    The part moves by its modes on a base that is still and by its static shapes for the motion of the nodes of that
    base (Craig and Bampton 1968), which the rock shares with it. The earthquake acts on the mass of the part alone.

    Parameters
    ----------
    case
        With `rock`.
    bonded
        The dam on a rigid plane.
    larger
        Factor on the extent of the rock that is meshed, and on the band in which it answers well.
    shapes_of
        As that of :func:`rock_body`.
    """
    lowest, held = bonded.bodies[-1], bonded.modes[-1]
    if case.foundation is None or not lowest.mesh.fixed.size:
        return None
    nodes = base_nodes(lowest)
    rock = rock_below(lowest.mesh.nodes[nodes], case, larger, shapes_of)
    load = np.concatenate([body.load for body in bonded.bodies])
    # Of the whole dam, for the settlement, and of the part alone.
    every = base_shapes(bonded, load.size - lowest.load.size + dofs(nodes)) @ rock.shapes
    spring = np.diag(rock.omega_squared) + congruent(side_by_side(bonded, "stiffness"), every)
    settled = np.linalg.solve(spring, every.T @ load)
    below = base_shapes(Dam((lowest,), held_alone(lowest)), dofs(nodes)) @ rock.shapes
    count = held.omega_squared.size
    mass = np.eye(count + settled.size)
    mass[:count, count:] = held.shapes.T @ (lowest.mass @ below)
    mass[count:, :count] = mass[:count, count:].T
    mass[count:, count:] += congruent(lowest.mass, below)
    bent = congruent(lowest.stiffness, below)
    stiffness = np.diag(np.concatenate([held.omega_squared, rock.omega_squared]))
    stiffness[count:, count:] += bent
    squares, vectors = eigh(stiffness, mass)
    own, moved = vectors[:count], vectors[count:]
    modes = Modes(squares, held.shapes @ own + below @ moved, 0, squares.size, held.total + settled.size, True)
    return Founded(
        modes,
        own,
        congruent(bent, moved),
        congruent(rock.damping, moved),
        np.concatenate(bonded.bent) + every @ settled,
        moved.T @ settled,
        rock.error,
    )


def rock_body(
    case: Case, lowest: Body, *, larger: float = 1.0, shapes_of: float | None = None, across: bool = False
) -> RockBody | None:
    """Return the rock below the part of the dam that stands on it by a crack; None on a rigid plane, and where the dam
    is bonded to the rock.

    Parameters
    ----------
    case
        With `rock`.
    lowest
        The part above the crack at the base.
    larger
        Factor on the extent of the rock that is meshed, and on the band in which it answers well.
    shapes_of
        Modulus [Pa] of rock that is the same in all else, whose shapes this rock takes; its own where it is not given.
    across
        Whether it moves across the valley, one component of each node, and not in the section.

    Raises
    ------
    InputError
        Where the base is not level.
    """
    if case.foundation is None or lowest.mesh.fixed.size:
        return None
    cut = case.single_crack_cases[-1].cut
    base = lowest.mesh.nodes[lowest.mesh.faces[-1]]
    rise = float(np.ptp(base[:, 1]))
    if rise > LEVEL * cut.crack_width:
        raise InputError("rock-level", "rock", f"{rise:.3g} m")
    # As long as the edges along the rock's own base.
    finer = 2 ** halvings(len(base) // 2)
    first, last = (base[2] - base[0]) / finer, (base[-1] - base[-3]) / finer
    ahead = [base[0] - (BEYOND - k / 2.0) * first for k in range(2 * BEYOND)]
    behind = [base[-1] + (k + 1) / 2.0 * last for k in range(2 * BEYOND)]
    points = np.vstack([*ahead, base, *behind])
    reduced = rock_below(points, case, larger, shapes_of, beyond=2 * BEYOND, across=across)
    count = reduced.omega_squared.size
    components = len(reduced.mirror)
    shapes = reduced.shapes.T.reshape(count, -1, components).swapaxes(1, 2).reshape(count, -1)
    still = np.zeros(count)
    return RockBody(reduced.omega_squared, reduced.damping, np.ascontiguousarray(shapes), points, reduced.error, still)


def rock_below(
    points: Floats,
    case: Case,
    larger: float = 1.0,
    shapes_of: float | None = None,
    *,
    beyond: int = 0,
    across: bool = False,
) -> ReducedRock:
    """Return the rock of a case below nodes (x, z), `beyond` of which lie beyond the heel, and as many beyond the toe,
    in the section or `across` the valley.

    The same rock lies below dams that differ in all else, and below the meshes of a dam, of which coarser ones tie its
    base to fewer nodes. Rock with the shapes of another modulus answers well up to a frequency that goes with the root
    of its own."""
    known = case if shapes_of is None else case.on_rock(shapes_of)
    assert case.foundation is not None
    assert known.foundation is not None
    material, extent, highest = rock_material(known.foundation), larger * EXTENT, larger * band_of(known)
    inner = points[beyond : len(points) - beyond]
    finer = 2 ** halvings(len(inner) // 2)
    places = np.arange(finer * (len(inner) - 1) + 1) / finer
    between = [np.interp(places, np.arange(len(inner)), axis) for axis in inner.T]
    base = np.vstack([points[:beyond], np.column_stack(between), points[len(points) - beyond :]])
    # Meshes have the same places but for rounding.
    fine = float(f"{_SAME * np.ptp(base[:, 0]):.0e}")
    base = fine * np.round(base / fine)
    below = _KEPT.get(
        (base.tobytes(), material, extent, highest, across),
        lambda: reduced_rock(base, material, highest=highest, extent=extent, across=across),
    )
    if shapes_of is not None:
        below = below.stiffer(case.foundation.modulus / shapes_of)
    return below if finer == 1 else below.followed(base, points)


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
