"""Static forces on the part of a dam above the crack; per metre of dam."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.geometry.section import CutSection


@dataclass(frozen=True)
class Resultant:
    """A force and its moment.

    Parameters
    ----------
    name
        What exerts it.
    horizontal
        Positive downstream [N/m].
    vertical
        Positive upward [N/m].
    moment
        About the heel, counter-clockwise positive with x downstream and z up [N m/m].
    virial
        Sum of the forces times their places from the heel: where the places turn by a small angle about the heel and
        the forces keep their directions, the moment falls by that angle times this [N m/m].
    """

    name: str
    horizontal: float
    vertical: float
    moment: float
    virial: float = 0.0

    def moment_about(self, x: float, z: float) -> float:
        """Return the moment [N m/m] about a point `x` downstream of the heel and `z` above the crack [m]."""
        return self.moment - x * self.vertical + z * self.horizontal


def total(name: str, forces: Iterable[Resultant]) -> Resultant:
    """Return the sum of some forces under a new name."""
    forces = tuple(forces)
    return Resultant(
        name,
        math.fsum(force.horizontal for force in forces),
        math.fsum(force.vertical for force in forces),
        math.fsum(force.moment for force in forces),
        math.fsum(force.virial for force in forces),
    )


def static_forces(case: Case) -> tuple[Resultant, ...]:
    """Return weight, reservoir, tailwater and uplift, with zeros for what is not there, then ice, silt and prestress
    of the anchors where there are any."""
    forces = [
        weight(case),
        reservoir_pressure(case),
        tailwater_pressure(case),
        uplift(case),
    ]
    for there, force in ((case.ice, ice), (case.silt, silt), (case.anchors, prestress)):
        if there:
            forces.append(force(case))
    return tuple(forces)


def concrete_mass(case: Case) -> float:
    """Return the mass of the concrete above the crack [kg/m]."""
    return case.concrete.density * case.cut.area


def weight(case: Case) -> Resultant:
    """Return the weight of the concrete above the crack."""
    force = -concrete_mass(case) * case.gravity
    section = case.cut
    x, z = section.centroid[0] - section.heel[0], section.centroid[1] - section.heel[1]
    return Resultant("weight", 0.0, force, force * x, force * z)


def reservoir_pressure(case: Case) -> Resultant:
    """Return the force of the reservoir on the upstream face above the crack, with its weight on a slope."""
    return _face_pressure("reservoir", case, case.reservoir, upstream=True)


def tailwater_pressure(case: Case) -> Resultant:
    """Return the force of the tailwater on the downstream face above the crack, with its weight on slopes."""
    return _face_pressure("tailwater", case, case.tailwater, upstream=False)


def ice(case: Case) -> Resultant:
    """Return the push of the ice; zero where it acts below the crack."""
    if case.ice is None or case.reservoir is None:
        return Resultant("ice", 0.0, 0.0, 0.0)
    section = case.cut
    height = section.base_elevation + case.reservoir.depth - case.ice.depth - section.crack_elevation
    push = case.ice.force if height >= 0.0 else 0.0
    return Resultant("ice", push, 0.0, -push * max(height, 0.0), push * face_at(section, max(height, 0.0)))


def silt(case: Case) -> Resultant:
    """Return the force of the silt on the upstream face above the crack, beyond that of the water it stands in."""
    if case.silt is None:
        return Resultant("silt", 0.0, 0.0, 0.0)
    densities = (case.silt.horizontal_density, case.silt.vertical_density)
    return _face_fluid("silt", case, case.silt.depth, densities, upstream=True)


def prestress(case: Case) -> Resultant:
    """Return the prestress of all anchors on the part above the crack, which they pull towards the part below."""
    forces = []
    for anchor in case.anchors:
        along, across = -math.sin(anchor.inclination), -math.cos(anchor.inclination)
        x, z = case.cut.from_crack_frame(along, across)
        forces.append(
            Resultant(
                "anchors", anchor.prestress * x, anchor.prestress * z, anchor.prestress * across * anchor.distance
            )
        )
    return total("anchors", forces)


def uplift_profile(case: Case) -> Floats:
    """Return the pressure in the crack, straight between its points.

    Heads count from the crack. At the drains the head is ``tail + (1 - efficiency) (heel - tail)``: USBR,
    Design of Gravity Dams (1976), section 3-9, has efficiency 2/3; USACE, EM 1110-2-2200 (1995), the same
    form with K = 1 - efficiency for a crack that reaches the drains.

    Returns
    -------
    ndarray, shape (k, 2)
        Distance from the heel [m], ascending, and pressure times the intensity [Pa]; twice the same distance
        is a jump.
    """
    pattern = case.uplift
    heel, toe = _pressure(case, case.reservoir), _pressure(case, case.tailwater, toe=True)
    drains = toe + (1.0 - (pattern.drain_efficiency or 0.0)) * (heel - toe)
    own = case.gravity * (case.reservoir.density if case.reservoir else 1000.0)
    points: dict[str, list[tuple[float, float]]] = {
        "none": [(0.0, 0.0), (1.0, 0.0)],
        "uniform": [(0.0, heel), (1.0, heel)],
        "triangular": [(0.0, heel), (1.0, toe)],
        "cut-off": [(0.0, heel), (pattern.extent or 1.0, toe), (1.0, toe)],
        "drained": [(0.0, heel), (pattern.drain_position or 0.0, drains), (1.0, toe)],
        "profile": [(fraction, own * head) for fraction, head in pattern.points or ()],
    }
    return np.array(points[pattern.pattern]) * [case.cut.crack_width, pattern.intensity]


def uplift(case: Case) -> Resultant:
    """Return the force of the water in the crack, which is normal to it."""
    profile = uplift_profile(case)
    x, pressure = profile.T
    length = np.diff(x)
    force = float(np.sum(length * (pressure[:-1] + pressure[1:]))) / 2.0
    horizontal, vertical = case.cut.from_crack_frame(0.0, force)
    return Resultant(
        "uplift",
        horizontal,
        vertical,
        float(np.sum(length * _mean_product(x[:-1], x[1:], pressure[:-1], pressure[1:]))),
    )


def water_above_crack(case: Case, water: Water | None, *, toe: bool = False) -> float:
    """Return how high water of the case stands above the heel, or the toe [m]; zero where it does not reach it."""
    if water is None:
        return 0.0
    section = case.cut
    return max(0.0, section.base_elevation + water.depth - (section.toe if toe else section.heel)[1])


def _pressure(case: Case, water: Water | None, *, toe: bool = False) -> float:
    """Return the pressure of still water at the heel, or at the toe [Pa]."""
    return water.density * case.gravity * water_above_crack(case, water, toe=toe) if water else 0.0


def _face_pressure(name: str, case: Case, water: Water | None, *, upstream: bool) -> Resultant:
    """Return the force of still water on a face above the crack."""
    if water is None:
        return Resultant(name, 0.0, 0.0, 0.0)
    return _face_fluid(name, case, water.depth, (water.density, water.density), upstream=upstream)


def _face_fluid(name: str, case: Case, depth: float, densities: tuple[float, float], *, upstream: bool) -> Resultant:
    """Integrate edge by edge the pressure of a fluid that has one density sideways and one in its weight."""
    section = case.cut
    # Going up the upstream face, the concrete is on the right hand.
    face, side = (section.upstream_face, 1.0) if upstream else (section.downstream_face, -1.0)
    # Counted from the heel, also where the toe is lower.
    surface = section.base_elevation + depth - section.crack_elevation
    start, end = face[:-1] - section.heel, face[1:] - section.heel
    # The wet part of each edge, from fraction a to b of its length; along it the pressure is linear.
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = np.clip((surface - start[:, 1]) / (end[:, 1] - start[:, 1]), 0.0, 1.0)
    wet_start, wet_end = start[:, 1] < surface, end[:, 1] < surface
    a = np.where(wet_start, 0.0, np.where(wet_end, crossing, 1.0))
    b = np.where(wet_end, 1.0, np.where(wet_start, crossing, 1.0))
    lower, upper = start + a[:, None] * (end - start), start + b[:, None] * (end - start)
    h0, h1 = surface - lower[:, 1], surface - upper[:, 1]
    along = upper - lower
    # The normal into the concrete, as long as the edge, times the weight of a unit of the fluid.
    normal = case.gravity * side * np.column_stack([densities[0] * along[:, 1], -densities[1] * along[:, 0]])
    lever = _mean_product(lower[:, 0], upper[:, 0], h0, h1) * normal[:, 1]
    lever -= _mean_product(lower[:, 1], upper[:, 1], h0, h1) * normal[:, 0]
    virial = _mean_product(lower[:, 0], upper[:, 0], h0, h1) * normal[:, 0]
    virial += _mean_product(lower[:, 1], upper[:, 1], h0, h1) * normal[:, 1]
    horizontal, vertical = (h0 + h1) / 2.0 @ normal
    return Resultant(name, float(horizontal), float(vertical), float(np.sum(lever)), float(np.sum(virial)))


def face_at(section: CutSection, height: float) -> float:
    """Return where the upstream face is at a height above the heel, downstream of the heel [m]."""
    face = section.upstream_face - section.heel
    return float(np.interp(height, face[:, 1], face[:, 0]))


def _mean_product(f0: Floats, f1: Floats, g0: Floats, g1: Floats) -> Floats:
    """Return the mean of the product of two linear functions over pieces, from the values at their ends."""
    return (2.0 * f0 * g0 + f0 * g1 + f1 * g0 + 2.0 * f1 * g1) / 6.0
