"""The water that moves with a dam: Westergaard's on a vertical face, less on a slope; per metre of dam.

With a vertical face Westergaard (1931) has the pressure of ``7/8 rho sqrt(D (D - eta))`` times the acceleration of the
face, eta from the bottom of water of depth D. On a face that leans back from the water by the angle psi from the
vertical, what a horizontal acceleration presses with is less, by Zangar (1952) nearly in proportion:

    r(psi) = 1 - psi / 90 degrees

the straight line between the ends of his curve, whose coefficient falls from 0.735 at a vertical to 0 at a horizontal
face. (The print was not at hand; potential flow against a face of constant slope has 0.89, 0.79, 0.69, 0.54, 0.39 and
0.21 at 10, 20, 30, 45, 60 and 75 degrees, and 1.12 at an overhang of 10.) Each piece of a face counts by its own slope.

Seen from its own centre the profile has a second moment, which a turning dam feels beside the mass at the centre.
Before a vertical face with h of water above the crack, and d the depth below the surface,

    m_w = 7/12 rho sqrt(D) h^(3/2),    0.6 h below the surface,    12/175 m_w h^2 = 0.0686 m_w h^2,

the integrals of ``sqrt(d)`` times 1, d and ``(d - 0.6 h)^2`` from 0 to h. They are the same for a crack at a height,
whose h is less than D. Zhu (2004) has the mass in one point. Zangar's pressure, the other choice, is in
:mod:`heeltoe.mechanics.zangar`; a block feels its horizontal part. Where water stands above the crest D is its whole
depth, and only the face moves it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import arctan, larger, ratio, where
from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.geometry.section import Edge
from heeltoe.mechanics.loads import Resultant, total
from heeltoe.mechanics.zangar import Zangar, zangar


@dataclass(frozen=True)
class VirtualMass:
    """Water that moves horizontally with the dam.

    Attributes
    ----------
    mass
        [kg/m].
    height
        Of its centre above the heel [m].
    inertia
        Rotational inertia about its centre [kg m2/m].
    sloped
        Whether some of it stands before a slope.
    """

    mass: float
    height: float
    inertia: float = 0.0
    sloped: bool = False


def slope_factor(batter: float) -> float:
    """Return the pressure on a sloped face over that on a vertical one, both moving horizontally.

    Parameters
    ----------
    batter
        Tangent of the angle by which the face leans back from the water; negative where it hangs over.
    """
    return 1.0 - arctan(batter) / (math.pi / 2.0)


def virtual_mass(case: Case) -> VirtualMass:
    """Return the water of reservoir and tailwater that moves horizontally with the part above the crack.

    Of a side with `virtual_mass_rotates` it has the inertia of its profile, of one without that of a point.
    """
    section = case.cut
    up = _before(case, case.reservoir, section.upstream_edges, 1.0)
    down = _before(case, case.tailwater, section.downstream_edges, -1.0)
    if up is None or down is None:
        return up or down or VirtualMass(0.0, 0.0)
    mass = up.mass + down.mass
    both = ratio(up.mass * up.height + down.mass * down.height, mass)
    height = where(down.mass > 0.0, where(up.mass > 0.0, both, down.height), up.height)
    apart = up.mass * (up.height - height) ** 2 + down.mass * (down.height - height) ** 2
    return VirtualMass(mass, height, up.inertia + down.inertia + apart, up.sloped | down.sloped)


def moving_force(case: Case, acceleration: float) -> Resultant:
    """Return what the water of reservoir and tailwater presses on the part above the crack with, beyond its weight,
    while the ground accelerates downstream [m/s2].

    Westergaard's water moves horizontally alone; Zangar's presses along the normals of the faces.
    """
    section, forces = case.cut, []
    for water, edges, side in (
        (case.reservoir, section.upstream_edges, 1.0),
        (case.tailwater, section.downstream_edges, -1.0),
    ):
        if water is not None and water.hydrodynamic == "zangar":
            sums = zangar(case, water, upstream=side > 0.0)
            turned = acceleration * sums.turning
            moment = turned + acceleration * sums.first
            across, up = -acceleration * sums.mass, acceleration * sums.lift
            forces.append(Resultant("hydrodynamic", across, up, moment, lift_moment=turned))
        elif moved := _before(case, water, edges, side):
            forces.append(Resultant.at("hydrodynamic", (-moved.mass * acceleration, 0.0), (0.0, moved.height)))
    return total("hydrodynamic", forces)


def _before(case: Case, water: Water | None, edges: Sequence[Edge], side: float) -> VirtualMass | None:
    """Return the water before one face, None without any above its foot; `side` is 1 with the concrete on the right of
    the way up, -1 on the left."""
    if water is None:
        return None
    section = case.cut
    surface = section.base_elevation + water.depth - section.crack_elevation
    wet = [(edge, larger(surface - edge.z0, 0.0), larger(surface - edge.z1, 0.0)) for edge in edges]
    wet = [edge for edge in wet if np.any(edge[1] != edge[2])]
    if not wet:
        return None
    sloped = False
    for edge, lower, upper in wet:
        sloped = sloped | ((abs(edge.slope) > 1e-9) & (lower != upper))
    if water.hydrodynamic == "zangar":
        return _zangar(zangar(case, water, upstream=side > 0.0), water, sloped=sloped)
    # Water above the crest meets no face there.
    over = wet[-1][2] > 0.0
    depth, root, turning = larger(surface, 0.0), water.density * water.depth**0.5, float(water.virtual_mass_rotates)
    # Before a vertical upstream face, whose foot is the heel.
    mass = 7.0 / 12.0 * root * depth**1.5
    upright = VirtualMass(mass, 0.4 * depth, turning * 12.0 / 175.0 * mass * depth**2)
    if side > 0.0 and not np.any(sloped | over):
        return upright
    mass = moment = second = 0.0
    for edge, lower, upper in wet:
        # Of sqrt(d) over the depths d of the edge, of d sqrt(d), and of d^2 sqrt(d).
        factor = 7.0 / 8.0 * root * slope_factor(side * edge.slope)
        mass += factor * (lower**1.5 - upper**1.5) * 2.0 / 3.0
        moment += factor * (lower**2.5 - upper**2.5) * 2.0 / 5.0
        second += factor * (lower**3.5 - upper**3.5) * 2.0 / 7.0
    centre = ratio(moment, mass)
    height, inertia = surface - centre, turning * (second - moment * centre)
    summed = sloped | over | (side < 0.0)
    return VirtualMass(
        where(summed, mass, upright.mass),
        where(summed, height, upright.height),
        where(summed, inertia, upright.inertia),
        sloped,
    )


def _zangar(sums: Zangar, water: Water, *, sloped: bool) -> VirtualMass:
    height = ratio(sums.first, sums.mass)
    inertia = float(water.virtual_mass_rotates) * (sums.second - sums.first * height)
    return VirtualMass(sums.mass, height, inertia, sloped)
