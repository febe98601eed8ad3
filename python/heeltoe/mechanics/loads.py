"""Static forces on the part of a dam above the crack; per metre of dam. The numbers of a case may be columns."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from heeltoe.base.arrays import Floats, larger, smaller, where
from heeltoe.case.crack.kinks import climbs, corners
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
    lift_moment
        What the vertical forces add to the moment; the horizontal ones add the rest [N m/m].
    """

    name: str
    horizontal: float
    vertical: float
    moment: float
    virial: float = 0.0
    lift_moment: float = 0.0

    @classmethod
    def at(cls, name: str, forces: tuple[float, float], place: tuple[float, float]) -> Resultant:
        """Return the force of a horizontal and a vertical part that act at one place (x, z) from the heel."""
        (across, up), (x, z) = forces, place
        return cls(name, across, up, x * up - z * across, x * across + z * up, x * up)

    def moment_about(self, x: float, z: float) -> float:
        """Return the moment [N m/m] about a point `x` downstream of the heel and `z` above the crack [m]."""
        return self.moment - x * self.vertical + z * self.horizontal


def total(name: str, forces: Iterable[Resultant]) -> Resultant:
    """Return the sum of some forces under a new name."""
    horizontal = vertical = moment = virial = lift_moment = 0.0
    for force in forces:
        horizontal += force.horizontal
        vertical += force.vertical
        moment += force.moment
        virial += force.virial
        lift_moment += force.lift_moment
    return Resultant(name, horizontal, vertical, moment, virial, lift_moment)


def scaled(name: str, force: Resultant, factor: float) -> Resultant:
    """Return a multiple of a force under a new name."""
    numbers = (force.horizontal, force.vertical, force.moment, force.virial, force.lift_moment)
    return Resultant(name, *(factor * number for number in numbers))


def static_forces(case: Case) -> tuple[Resultant, ...]:
    """Return weight, reservoir, tailwater and uplift, with zeros for missing ones, then nappe, ice, silt and
    prestress of the anchors where there are any."""
    forces = [
        weight(case),
        reservoir_pressure(case),
        tailwater_pressure(case),
        uplift(case),
    ]
    over = np.any(nappe_heads(case)[0] > 0.0)
    for cause, force in ((over, nappe), (case.ice, ice), (case.silt, silt), (case.anchors, prestress)):
        if cause:
            forces.append(force(case))
    return tuple(forces)


def concrete_mass(case: Case) -> float:
    """Return the mass of the concrete above the crack [kg/m]."""
    return case.concrete.density * case.above.area


def weight(case: Case) -> Resultant:
    """Return the weight of the concrete above the crack."""
    force = -concrete_mass(case) * case.gravity
    section = case.above
    x, z = section.centroid_from_heel
    return Resultant("weight", 0.0, force, force * x, force * z, force * x)


def reservoir_pressure(case: Case) -> Resultant:
    """Return the force of the reservoir on the upstream face above the crack, with its weight on a slope."""
    return _face_pressure("reservoir", case, case.reservoir, upstream=True)


def tailwater_pressure(case: Case) -> Resultant:
    """Return the force of the tailwater on the downstream face above the crack, with its weight on slopes."""
    return _face_pressure("tailwater", case, case.tailwater, upstream=False)


def nappe_heads(case: Case) -> tuple[float, float]:
    """Return the heads that press on the crest at its upstream and its downstream edge [m]; zero where water does not
    stand above it, or by the choice of the case does not press."""
    water = case.reservoir
    if water is None or water.nappe == "none":
        return 0.0, 0.0
    section = case.cut
    head = larger(0.0, section.base_elevation + water.depth - section.crest_elevation)
    return head, head if water.nappe == "weight" else 0.0 * head


def nappe(case: Case) -> Resultant:
    """Return the weight of the water above the crest, as far as it presses on it."""
    section, (h0, h1) = case.cut, nappe_heads(case)
    unit = case.gravity * (case.reservoir.density if case.reservoir else 0.0)
    top, end = section.upstream_edges[-1], section.downstream_edges[-1]
    width = end.x1 - top.x1
    force = -unit * width * (h0 + h1) / 2.0
    moment = -unit * width * _mean_product(top.x1, end.x1, h0, h1)
    return Resultant("nappe", 0.0, force, moment, top.z1 * force, moment)


def ice(case: Case) -> Resultant:
    """Return the push of the ice; zero where it acts below the crack."""
    if case.ice is None or case.reservoir is None:
        return Resultant("ice", 0.0, 0.0, 0.0)
    section = case.cut
    height = section.base_elevation + case.reservoir.depth - case.ice.depth - section.crack_elevation
    push = where(height >= 0.0, case.ice.force, 0.0)
    height = larger(height, 0.0)
    return Resultant("ice", push, 0.0, -push * height, push * face_at(section, height))


def silt(case: Case) -> Resultant:
    """Return the force of the silt on the upstream face above the crack, beyond that of the water it stands in."""
    if case.silt is None:
        return Resultant("silt", 0.0, 0.0, 0.0)
    densities = (case.silt.horizontal_density, case.silt.vertical_density)
    return _face_fluid("silt", case, case.silt.depth, densities, upstream=True)


def prestress(case: Case) -> Resultant:
    """Return the prestress of all anchors on the part above the crack, which they pull towards the part below."""
    forces = []
    for anchor in case.anchors_at_crack:
        along, across = -math.sin(anchor.inclination), -math.cos(anchor.inclination)
        x, z = case.cut.from_crack_frame(along, across)
        pull, turning = anchor.prestress, anchor.prestress * across * anchor.distance
        lift = pull * z * case.cut.from_crack_frame(anchor.distance, 0.0)[0]
        forces.append(Resultant("anchors", pull * x, pull * z, turning, lift_moment=lift))
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
    return np.array(_uplift_points(case))


def _uplift_points(case: Case) -> list[tuple[float, float]]:
    """Return the points of :func:`uplift_profile`."""
    uplift = case.uplift_at_crack
    heel, toe = _pressure(case, case.reservoir), _pressure(case, case.tailwater, toe=True)
    extent, position, efficiency = (
        0.0 if option is None else option for option in (uplift.extent, uplift.drain_position, uplift.drain_efficiency)
    )
    drains = toe + (1.0 - efficiency) * (heel - toe)
    own = case.gravity * crack_water_density(case)
    points: dict[str, list[tuple[float, float]]] = {
        "none": [(0.0, 0.0), (1.0, 0.0)],
        "uniform": [(0.0, heel), (1.0, heel)],
        "triangular": [(0.0, heel), (1.0, toe)],
        "cut-off": [(0.0, heel), (extent, toe), (1.0, toe)],
        "drained": [(0.0, heel), (position, drains), (1.0, toe)],
        "profile": [(fraction, own * head) for fraction, head in uplift.points or ()],
    }
    width = case.cut.crack_width
    return [(fraction * width, pressure * uplift.intensity) for fraction, pressure in points[uplift.pattern]]


def crack_water_density(case: Case) -> float:
    """Return the density of the water that heads in the crack count in [kg/m3]: that of the reservoir, without one that
    of the tailwater."""
    water = case.reservoir or case.tailwater
    return 1000.0 if water is None else water.density


def uplift(case: Case) -> Resultant:
    """Return the force of the water in the crack, which is normal to it, or to each of its pieces."""
    return in_crack(case, _uplift_points(case))


def in_crack(case: Case, points: Iterable[tuple[float, float]]) -> Resultant:
    """Return the force of water in the crack: `points` are distances from the heel along the straight line to the toe
    [m] and pressures [Pa], straight in between."""
    if climbs(case.crack.kinks):
        return _on_pieces(case, tuple(points))
    section, force, moment = case.cut, 0.0, 0.0
    for (x0, p0), (x1, p1) in pairwise(points):
        force += (x1 - x0) * (p0 + p1) / 2.0
        moment += (x1 - x0) * _mean_product(x0, x1, p0, p1)
    horizontal, vertical = section.from_crack_frame(0.0, force)
    # What is at a distance along the crack is downstream of the heel by its cosine.
    cosine, _ = section.from_crack_frame(1.0, 0.0)
    return Resultant("uplift", horizontal, vertical, moment, lift_moment=moment * cosine * cosine)


def _on_pieces(case: Case, points: tuple[tuple[float, float], ...]) -> Resultant:
    """Integrate piece by piece a pressure that is normal to a crack with kinks."""
    section = case.cut
    distances, heights = zip(*corners(section, case.crack.kinks), strict=True)
    horizontal = vertical = moment = lifting = 0.0
    for (start, p0), (end, p1) in pairwise(points):
        cuts = [start, *(distance for distance in distances if start < distance < end), end]
        for t0, t1 in pairwise(cuts if end > start else ()):
            q0, q1 = (float(np.interp(t, (start, end), (p0, p1))) for t in (t0, t1))
            (x0, z0), (x1, z1) = (
                section.from_crack_frame(t, float(np.interp(t, distances, heights))) for t in (t0, t1)
            )
            # The normal into the part above, as long as the piece.
            mean = (q0 + q1) / 2.0
            horizontal -= mean * (z1 - z0)
            vertical += mean * (x1 - x0)
            lifting += _mean_product(x0, x1, q0, q1) * (x1 - x0)
            moment += _mean_product(x0, x1, q0, q1) * (x1 - x0) + _mean_product(z0, z1, q0, q1) * (z1 - z0)
    return Resultant("uplift", horizontal, vertical, moment, lift_moment=lifting)


def water_above_crack(case: Case, water: Water | None, *, toe: bool = False) -> float:
    """Return how high water of the case stands above the heel, or the toe [m]; zero where it does not reach it."""
    if water is None:
        return 0.0
    section = case.cut
    return larger(0.0, section.base_elevation + water.depth - (section.toe if toe else section.heel)[1])


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
    edges, side = (section.upstream_edges, 1.0) if upstream else (section.downstream_edges, -1.0)
    # Counted from the heel, also where the toe is lower.
    surface = section.base_elevation + depth - section.crack_elevation
    horizontal = vertical = moment = virial = lifting = 0.0
    for edge in edges:
        # The wet part; along it the pressure is linear.
        z0, z1 = smaller(edge.z0, surface), smaller(edge.z1, surface)
        x0, x1 = edge.x0 + edge.slope * (z0 - edge.z0), edge.x1 + edge.slope * (z1 - edge.z1)
        h0, h1 = surface - z0, surface - z1
        # The normal into the concrete, as long as the edge, times the densities.
        across, down = densities[0] * (z1 - z0), densities[1] * (x1 - x0)
        mean, mean_x, mean_z = (h0 + h1) / 2.0, _mean_product(x0, x1, h0, h1), _mean_product(z0, z1, h0, h1)
        horizontal += mean * across
        vertical -= mean * down
        moment -= mean_x * down + mean_z * across
        lifting -= mean_x * down
        virial += mean_x * across - mean_z * down
    weight = case.gravity * side
    return Resultant(name, weight * horizontal, weight * vertical, weight * moment, weight * virial, weight * lifting)


def face_at(section: CutSection, height: float) -> float:
    """Return where the upstream face is at a height above the heel, downstream of the heel [m]."""
    place = 0.0
    for edge in section.upstream_edges:
        rises = edge.slope * (larger(smaller(height, edge.z1), edge.z0) - edge.z0)
        place += where(height >= edge.z1, edge.x1 - edge.x0, rises)
    return place


def _mean_product(f0: float, f1: float, g0: float, g1: float) -> float:
    """Return the mean of the product of two linear functions over a piece, from the values at its ends."""
    return (f0 * (2.0 * g0 + g1) + f1 * (g0 + 2.0 * g1)) / 6.0
