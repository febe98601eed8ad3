"""The bond of a joint as the kernel takes it, and the mesh that its process zone asks for.

A crack with the fracture energy G_f in concrete of modulus E and strength f_t softens over the length

    l = E G_f / f_t^2.

Where the elements along the joint are longer than a third of it, the tensile strength is lowered to

    f = sqrt(E G_f / 3 h),

so that the crack takes the energy that it should (Bazant and Oh 1983). Where the joint softens along two lines, G_f
here is the energy of the first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.crack.bond import Bond
from heeltoe.case.model import Case

#: Elements that a process zone needs at least.
ELEMENTS_IN_ZONE = 3.0
# Shares of an edge of three nodes, as a uniform stress makes forces on them.
_SHARES = np.array([1.0, 4.0, 1.0]) / 6.0


@dataclass(frozen=True)
class ZoneMesh:
    """How a mesh resolves the process zone of a joint.

    Attributes
    ----------
    zone
        Length of the process zone [m].
    element
        Longest element along the joint [m].
    strength
        Tensile strength that the model takes [Pa].
    """

    zone: float
    element: float
    strength: float

    @property
    def is_coarse(self) -> bool:
        """Whether the strength had to be lowered."""
        return self.element > self.zone / ELEMENTS_IN_ZONE


def zone_mesh(bond: Bond, modulus: float, along: Floats) -> ZoneMesh:
    """Return how nodes at these places ``along`` a joint (k,) [m], three to an element, resolve its process zone."""
    strength = bond.dynamic_factor * bond.tensile_strength
    energy = bond.first_share * bond.fracture_energy
    zone = modulus * energy / strength**2
    element = float(np.diff(along[::2]).max())
    lowered = math.sqrt(modulus * energy / (ELEMENTS_IN_ZONE * element)) / bond.dynamic_factor
    return ZoneMesh(zone, element, min(bond.tensile_strength, lowered))


def kernel_bond(alone: Case, along: Floats) -> tuple[float, float, float, float, float, float] | None:
    """Return the bond of a crack as the kernel takes it, of the case with it ``alone``; None of a crack."""
    bond = alone.crack.bond
    if bond is None:
        return None
    strength = zone_mesh(bond, alone.concrete.modulus or 0.0, along).strength
    return (strength, bond.cohesion, bond.fracture_energy, bond.shear_energy, bond.dynamic_factor, bond.first_share)


def node_lengths(along: Floats) -> Floats:
    """Return the length of a joint that each of its nodes stands for (k,) [m], three nodes to an element."""
    lengths = np.zeros_like(along)
    for first in range(0, along.size - 2, 2):
        lengths[first : first + 3] += _SHARES * (along[first + 2] - along[first])
    return lengths
