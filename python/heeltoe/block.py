"""The rigid block: the part of the dam above the crack as masses, distances and generalised forces.

Everything is per metre of dam. The reference point stands at the height of the centre of the horizontal mass
(concrete and virtual water) and horizontally at the centroid of the concrete; there, for small rotations,
translation and rotation do not couple although the two masses differ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case_model import Case
from heeltoe.loads import Resultant, VirtualMass, concrete_mass, static_forces, total, virtual_mass
from heeltoe.section import CutSection, cut


@dataclass(frozen=True)
class CriticalAccelerations:
    """Ground accelerations [m/s2] at which a block at rest starts to move, as magnitudes.

    "Downstream" is the motion of the block: the ground then accelerates upstream. A negative value means that the
    static loads alone start that motion.
    """

    sliding_downstream: float
    sliding_upstream: float
    rocking_downstream: float
    rocking_upstream: float

    @property
    def sliding(self) -> float:
        """The smaller of the two for sliding."""
        return min(self.sliding_downstream, self.sliding_upstream)

    @property
    def rocking(self) -> float:
        """The smaller of the two for rocking."""
        return min(self.rocking_downstream, self.rocking_upstream)


@dataclass(frozen=True)
class Block:
    """A block on its crack, ready for the kernel.

    Attributes
    ----------
    mass_horizontal, mass_vertical
        Concrete with virtual water; concrete alone [kg/m].
    inertia
        Polar inertia about the reference point [kg m2/m].
    height
        Height of the reference point above the crack [m].
    heel_distance, toe_distance
        Horizontal distance from the reference point to heel and toe [m].
    static
        Sum of the static loads; its moment is about the heel [N/m, N m/m].
    static_moment
        Moment of the static loads about the reference point, counter-clockwise [N m/m].
    forces
        The loads one by one.
    water
        Virtual water.
    friction_static, friction_kinetic, restitution
        Of the crack.
    gravity
        One g of the case [m/s2].
    section
        The part above the crack.
    """

    mass_horizontal: float
    mass_vertical: float
    inertia: float
    height: float
    heel_distance: float
    toe_distance: float
    static: Resultant
    static_moment: float
    forces: tuple[Resultant, ...]
    water: VirtualMass
    friction_static: float
    friction_kinetic: float
    restitution: float
    gravity: float
    section: CutSection

    @property
    def width(self) -> float:
        """Width of the crack [m]."""
        return self.heel_distance + self.toe_distance

    @property
    def normal_force(self) -> float:
        """Effective weight on the crack, water pressure taken off [N/m]."""
        return -self.static.vertical

    @property
    def sliding_safety_factor(self) -> float | None:
        """Friction there is over friction needed under the static loads; None where none is needed."""
        needed = abs(self.static.horizontal)
        return self.friction_static * self.normal_force / needed if needed > 0.0 else None

    @property
    def resultant_position(self) -> float | None:
        """Where the resultant of the static loads meets the crack, from the heel [m]; None without a normal force."""
        return -self.static.moment / self.normal_force if self.normal_force > 0.0 else None

    def critical_accelerations(self) -> CriticalAccelerations:
        """Accelerations at which rest ends, each motion by itself.

        At rest ``T = m_y a - P`` and the moments about the corners give
        ``B N_h = M0 + H T + B_t N0`` and ``B N_t = B_h N0 - M0 - H T``; sliding starts where ``|T| = mu N0`` (Zhu
        2004, 4.3.12), rocking where a normal force vanishes (the limits behind 4.3.14).
        """
        push, weight, mass = self.static.horizontal, self.normal_force, self.mass_horizontal
        friction = self.friction_static * weight
        heel = (self.static_moment + self.toe_distance * weight) / self.height
        toe = (self.heel_distance * weight - self.static_moment) / self.height
        return CriticalAccelerations(
            sliding_downstream=(friction - push) / mass,
            sliding_upstream=(friction + push) / mass,
            rocking_downstream=(heel - push) / mass,
            rocking_upstream=(toe + push) / mass,
        )

    def parameters(self) -> NDArray[np.float64]:
        """Return the numbers the kernel takes, shape (18,), in the order of ``_kernel.BLOCK_FIELDS``."""
        values = {
            "mass_horizontal": self.mass_horizontal,
            "mass_vertical": self.mass_vertical,
            "inertia": self.inertia,
            "height": self.height,
            "heel_distance": self.heel_distance,
            "toe_distance": self.toe_distance,
            "static_horizontal": self.static.horizontal,
            "static_vertical": self.static.vertical,
            "static_moment": self.static_moment,
            "per_horizontal_horizontal": -self.mass_horizontal,
            "per_vertical_vertical": -self.mass_vertical,
            "friction_static": self.friction_static,
            "friction_kinetic": self.friction_kinetic,
            "restitution": self.restitution,
        }
        return np.array([values.get(name, 0.0) for name in _kernel.BLOCK_FIELDS])


def build_block(case: Case) -> Block:
    """Cut the section at the crack and gather masses and static loads of the part above it.

    Returns
    -------
    Block

    Raises
    ------
    InputError
        Where the crack does not cut the section in two.
    """
    section = cut(case)
    concrete = concrete_mass(case, section)
    water = virtual_mass(case, section)
    mass = concrete + water.mass
    centroid = (section.centroid[0] - section.heel[0], section.centroid[1] - section.heel[1])
    height = (concrete * centroid[1] + water.mass * water.height) / mass
    inertia = (
        case.concrete.density * section.polar_inertia
        + concrete * (centroid[1] - height) ** 2
        + water.mass * (water.height - height) ** 2
    )
    forces = static_forces(case, section)
    static = total("static loads", forces)
    return Block(
        mass_horizontal=mass,
        mass_vertical=concrete,
        inertia=inertia,
        height=height,
        heel_distance=centroid[0],
        toe_distance=section.crack_width - centroid[0],
        static=static,
        static_moment=static.moment_about(centroid[0], height),
        forces=forces,
        water=water,
        friction_static=case.crack.mu_static,
        friction_kinetic=case.crack.mu_kinetic,
        restitution=case.crack.restitution,
        gravity=case.gravity,
        section=section,
    )
