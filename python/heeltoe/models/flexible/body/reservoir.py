"""Compressible water before a meshed dam, tied to the wet faces of all of its parts, ready for the kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.elastic import Body, dofs
from heeltoe.models.flexible.body.modes import Modes
from heeltoe.models.flexible.surroundings.water import NEAR, ReducedWater, reduced_water


@dataclass(frozen=True, eq=False)
class WaterBody:
    """The compressible water of a dam, of reservoir and tailwater side by side; w modes.

    Attributes
    ----------
    omega_squared, damping_floor, damping_far, ground
        As those of :class:`heeltoe.models.flexible.surroundings.water.ReducedWater`.
    coupling
        (w, 2 n) of each part of the dam, from the crest down: columns of its displacements, x and z in turn.
    faces
        Of each side the nodes of the parts along its face and the pressure there by the modes: places (part, node) from
        below, shape (k, 2), and (k, w) [Pa s/m].
    """

    omega_squared: Floats
    damping_floor: Floats
    damping_far: Floats
    ground: Floats
    coupling: tuple[Floats, ...]
    faces: tuple[WetFace, ...]

    @cached_property
    def wet_rows(self) -> Floats:
        """The pressures at the nodes of all faces that are below the surface, face by face from below, as stresses
        (p, w, 3): xx and zz by the velocity of each mode, no shear."""
        pressures = np.concatenate([face.pressure[face.wet] for face in self.faces])
        return np.stack([pressures, pressures, np.zeros_like(pressures)], axis=2)

    def rows(self, place: int, modes: Modes) -> Floats:
        """Return what the modes (m,) of a part are to those of the water, shape (w, m)."""
        return np.ascontiguousarray(self.coupling[place] @ modes.shapes)


@dataclass(frozen=True, eq=False)
class WetFace:
    """A face before compressible water.

    Attributes
    ----------
    side
        Name of the block of the case, ``"reservoir"`` or ``"tailwater"``.
    points
        (k, 2) nodes x and z from below [m].
    pressure
        (k, w) pressure beyond that at rest by the velocities of the modes.
    still
        (k,) that at rest [Pa]; zero above the surface.
    """

    side: str
    points: Floats
    pressure: Floats
    still: Floats

    @property
    def wet(self) -> Integers:
        """Which nodes are below the surface."""
        return np.flatnonzero(self.still > 0.0)


def water_body(case: Case, bodies: Sequence[Body], highest: float, *, longer: float = 1.0) -> WaterBody | None:
    """Return the compressible water before the parts of a dam, from the crest down; None where there is none.

    Parameters
    ----------
    case
        With sound in the water of reservoir or tailwater.
    bodies
        The parts of the dam.
    highest
        Frequency [Hz] up to which the water answers well.
    longer
        Factor on the length of the near field.
    """
    waters: list[tuple[ReducedWater, str, list[tuple[int, Integers]]]] = []
    base = case.cut.base_elevation
    for side, water in (("reservoir", case.reservoir), ("tailwater", case.tailwater)):
        if water is None or not case.has_sound(side) or water.depth <= 0.0:
            continue
        paths = [(place, _path(body, side)) for place, body in reversed(list(enumerate(bodies)))]
        wet = [(place, path) for place, path in paths if bodies[place].mesh.nodes[path[0], 1] < base + water.depth]
        reduced = reduced_water(
            [bodies[place].mesh.nodes[path] for place, path in wet],
            water.depth,
            wave_speed=water.wave_speed,
            reflection=water.floor_reflection,
            density=water.density,
            highest=highest,
            floor=base,
            upstream=side == "reservoir",
            near=longer * NEAR,
        )
        waters.append((reduced, side, wet))
    if not waters:
        return None
    counts = [reduced.omega_squared.size for reduced, _, _ in waters]
    firsts = np.cumsum([0, *counts])
    coupling = [np.zeros((firsts[-1], body.mesh.nodes.size)) for body in bodies]
    faces = []
    for (reduced, side, wet), first, last in zip(waters, firsts, firsts[1:], strict=False):
        own_water = case.reservoir if side == "reservoir" else case.tailwater
        assert own_water is not None
        unit_weight, surface = own_water.density * case.gravity, base + own_water.depth
        column = 0
        for place, path in wet:
            own = reduced.coupling[:, column : column + 2 * path.size]
            coupling[place][first:last, dofs(path)] += own
            column += 2 * path.size
        pressure = np.zeros((reduced.pressure.shape[0], firsts[-1]))
        pressure[:, first:last] = reduced.pressure
        points = np.vstack([bodies[place].mesh.nodes[path] for place, path in wet])
        faces.append(WetFace(side, points, pressure, unit_weight * np.maximum(surface - points[:, 1], 0.0)))
    return WaterBody(
        np.concatenate([reduced.omega_squared for reduced, _, _ in waters]),
        block_diag(*(reduced.damping_floor for reduced, _, _ in waters)),
        block_diag(*(reduced.damping_far for reduced, _, _ in waters)),
        np.vstack([reduced.ground for reduced, _, _ in waters]),
        tuple(coupling),
        tuple(faces),
    )


def _path(body: Body, side: str) -> Integers:
    """Return the nodes of a face from below."""
    path = body.mesh.upstream if side == "reservoir" else body.mesh.downstream
    z = body.mesh.nodes[path, 1]
    return path if z[0] < z[-1] else path[::-1]
