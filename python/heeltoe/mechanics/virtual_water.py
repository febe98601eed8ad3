"""The water that moves with a dam: Westergaard's on a vertical face, less on a slope; per metre of dam.

With a vertical face Westergaard (1931) has the pressure of ``7/8 rho sqrt(D (D - eta))`` times the acceleration of the
face, eta from the bottom of water of depth D. On a face that leans back from the water by the angle psi from the
vertical, what a horizontal acceleration presses with is less, by Zangar (1952) nearly in proportion:

    r(psi) = 1 - psi / 90 degrees

the straight line between the ends of his curve, whose coefficient falls from 0.73 at a vertical to 0 at a horizontal
face. (The print was not at hand; potential flow against a face of constant slope has 0.89, 0.79, 0.69, 0.54, 0.39 and
0.21 at 10, 20, 30, 45, 60 and 75 degrees, and 1.12 at an overhang of 10.) Each piece of a face counts by its own slope.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.geometry.section import CutSection


@dataclass(frozen=True)
class VirtualMass:
    """Water that moves horizontally with the dam: mass [kg/m], height of its centre above the heel [m], and whether
    some of it stands before a slope."""

    mass: float
    height: float
    sloped: bool = False


def slope_factor(batter: float) -> float:
    """Return the pressure on a sloped face over that on a vertical one, both moving horizontally.

    Parameters
    ----------
    batter
        Tangent of the angle by which the face leans back from the water; negative where it hangs over.
    """
    return 1.0 - math.atan(batter) / (math.pi / 2.0)


def virtual_mass(case: Case) -> VirtualMass:
    """Return the water of reservoir and tailwater that moves horizontally with the part above the crack.

    With h of water above the crack before a vertical face it is ``7/12 rho sqrt(D) h^(3/2)``, its centre 0.4 h above
    the crack.
    """
    found = [
        _before(case.cut, case.reservoir, case.cut.upstream_face, 1.0),
        _before(case.cut, case.tailwater, case.cut.downstream_face, -1.0),
    ]
    there = [water for water in found if water.mass > 0.0]
    if len(there) < 2:
        return there[0] if there else VirtualMass(0.0, 0.0)
    mass = math.fsum(water.mass for water in there)
    height = math.fsum(water.mass * water.height for water in there) / mass
    return VirtualMass(mass, height, any(water.sloped for water in there))


def _before(section: CutSection, water: Water | None, face: Floats, side: float) -> VirtualMass:
    """Return the water before one face; `side` is 1 with the concrete on the right of the way up, -1 on the left."""
    if water is None or section.base_elevation + water.depth <= face[0, 1]:
        return VirtualMass(0.0, 0.0)
    along = np.diff(face, axis=0)
    surface = section.base_elevation + water.depth
    wet = np.maximum(surface - face[:, 1], 0.0)
    upright = np.abs(along[:, 0]) <= 1e-9 * np.abs(along[:, 1])
    sloped = not upright[wet[:-1] != wet[1:]].all()
    if side > 0.0 and not sloped:
        depth = float(wet[0])
        return VirtualMass(7.0 / 12.0 * water.density * math.sqrt(water.depth) * depth**1.5, 0.4 * depth)
    mass = moment = 0.0
    for (dx, dz), lower, upper in zip(along.tolist(), wet[:-1].tolist(), wet[1:].tolist(), strict=True):
        if lower != upper:
            # Of sqrt(d) over the depths d of the edge, and of d sqrt(d).
            factor = 7.0 / 8.0 * water.density * math.sqrt(water.depth) * slope_factor(side * dx / dz)
            mass += factor * (lower**1.5 - upper**1.5) * 2.0 / 3.0
            moment += factor * (lower**2.5 - upper**2.5) * 2.0 / 5.0
    return VirtualMass(mass, surface - section.heel[1] - moment / mass, sloped)
