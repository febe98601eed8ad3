"""The bond of the joint below a rigid block, judged by equilibrium: a block that is bonded moves with the ground.

With the forces N across and V along a joint of width B, and their moment M about its middle, the stresses are those of
a beam,

    sigma = N / B +- 6 M / B^2,    tau = V / B,

at heel and toe. The bond breaks all at once, when one of them has no tension left or the joint no shear strength:
sigma = -f_t, or |tau| = c + mu N / B. A block has no stresses that could break it step by step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.case.crack.bond import Bond
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block
from heeltoe.mechanics.loads import Resultant
from heeltoe.result.numbers import BlockBond

#: What breaks a bond, in the order of the margins.
_BREAKS_BY = ("tension at the heel", "tension at the toe", "shear downstream", "shear upstream")


@dataclass(frozen=True, eq=False)
class JointForces:
    """Load of a bonded block on its joint (n,): normal force, shear downstream [N/m], and their moment about
    the middle of the joint, counter-clockwise [N m/m]."""

    normal: Floats
    shear: Floats
    moment: Floats


@dataclass(frozen=True, eq=False)
class BondedBlock:
    """How the bond below a block fares in a motion.

    Attributes
    ----------
    block
        As the kernel takes it: where the bond holds to the end, with its static loads in the middle of the joint.
    shaking
        What the kernel takes of the motion: none of it while the bond holds.
    until
        How long it holds [s]; infinite where it holds to the end.
    numbers
        What is said of it.
    """

    block: Block
    shaking: Shaking
    until: float
    numbers: BlockBond

    @property
    def holds(self) -> bool:
        """Whether it holds to the end."""
        return self.until == np.inf


def joint_forces(block: Block, horizontal: Floats, up: Floats, turning: Floats) -> JointForces:
    """Return the forces on the joint of a bonded block under accelerations of the ground (n,) [m/s2, rad/s2]."""
    offset = block.heel_distance - 0.5 * block.width
    static = (block.static.horizontal, block.static.vertical, block.static_moment)
    with_turn, across_turn, turn = block.coupling
    # A turn about the middle of the joint moves the reference point by these.
    arms = np.array([-block.height, offset, 1.0])
    masses = np.array(
        [
            [block.mass_horizontal, with_turn, across_turn],
            [with_turn, block.mass_vertical, turn],
            [across_turn, turn, block.inertia],
        ]
    )
    along, across, moment = (
        load + of_horizontal * horizontal + of_vertical * up - of_turning * turning
        for load, of_horizontal, of_vertical, of_turning in zip(
            static, block.per_horizontal, block.per_vertical, masses @ arms, strict=True
        )
    )
    return JointForces(-across, along, moment + offset * across - block.height * along)


def bonded_block(block: Block, shaking: Shaking) -> BondedBlock | None:
    """Return how long the bond below a block holds, and what is left of the motion for it then; None of a crack."""
    bond = block.case.crack.bond
    if bond is None:
        return None
    friction, factor = block.friction_static, bond.dynamic_factor
    forces = _forces_at(block, shaking, shaking.time)
    margins = _margins(block, forces, factor * bond.tensile_strength, factor * bond.cohesion, friction)
    still = joint_forces(block, *(np.zeros(1) for _ in range(3)))
    at_rest = _margins(block, still, bond.tensile_strength, bond.cohesion, friction)[:, 0]
    if at_rest.min() < 0.0:
        until, place = 0.0, int(np.argmin(at_rest))
        forces, factor = still, 1.0
    else:
        until, place = _first_zero(shaking.time, margins)
        forces = _forces_at(block, shaking, np.append(shaking.time[shaking.time < until], min(until, shaking.end)))
    holds = until == np.inf
    tension, shear = _used(block, forces, bond, factor, friction)
    numbers = BlockBond(
        breaks_s=None if holds else until,
        breaks_by=None if holds else _BREAKS_BY[place],
        tensile_strength_used=tension,
        shear_strength_used=shear,
    )
    return BondedBlock(_pressed(block) if holds else block, _still_until(shaking, until), until, numbers)


def held_histories(
    block: Block, shaking: Shaking, moments: Floats, until: float
) -> tuple[NDArray[np.bool_], dict[str, Floats]]:
    """Return at which moments a bond holds, and the forces on the joint then, by their names in the histories [N/m]:
    what they are at heel and toe together makes normal force and moment."""
    forces = _forces_at(block, shaking, moments)
    tilt = forces.moment / block.width
    return moments < until, {
        "friction_force_n": -forces.shear,
        "normal_force_heel_n": 0.5 * forces.normal + tilt,
        "normal_force_toe_n": 0.5 * forces.normal - tilt,
    }


def _forces_at(block: Block, shaking: Shaking, moments: Floats) -> JointForces:
    """Return the forces at some moments; at those of the motion itself both values of a jump count."""

    def at(component: Floats | None) -> Floats:
        if component is None:
            return np.zeros(moments.size)
        return component if moments is shaking.time else np.interp(moments, shaking.time, component)

    return joint_forces(block, at(shaking.horizontal), at(shaking.up), at(shaking.turning))


def _margins(block: Block, forces: JointForces, tension: float, cohesion: float, friction: float) -> Floats:
    """Return what is left of the strength by each of the ways in which it breaks (4, n) [Pa]; all are linear in the
    forces."""
    normal, shear = forces.normal / block.width, forces.shear / block.width
    bending = 6.0 * forces.moment / block.width**2
    line = cohesion + friction * normal
    return np.array([tension + normal + bending, tension + normal - bending, line - shear, line + shear])


def _first_zero(time: Floats, margins: Floats) -> tuple[float, int]:
    """Return when the first margin has gone [s], and which; infinite where none goes."""
    gone = np.flatnonzero(margins.min(axis=0) < 0.0)
    if not gone.size:
        return np.inf, 0
    last = int(gone[0])
    ways = np.flatnonzero(margins[:, last] < 0.0)
    if last == 0:
        return 0.0, int(np.argmin(margins[:, 0]))
    before, after = margins[ways, last - 1], margins[ways, last]
    shares = before / (before - after)
    first = int(np.argmin(shares))
    return float(time[last - 1] + shares[first] * (time[last] - time[last - 1])), int(ways[first])


def _used(block: Block, forces: JointForces, bond: Bond, factor: float, friction: float) -> tuple[float, float]:
    """Return the largest shares of the tensile and of the shear strength that are used."""
    tension, cohesion = factor * bond.tensile_strength, factor * bond.cohesion
    heel, toe, *_ = _margins(block, forces, 0.0, 0.0, 0.0)
    # The line ends where the cohesion is friction times the tensile strength; there the tension breaks the bond.
    line = np.maximum(cohesion + friction * forces.normal / block.width, 1e-9 * cohesion)
    used = float((np.abs(forces.shear) / block.width / line).max())
    return float(max(0.0, -min(heel.min(), toe.min()) / tension)), used


def _pressed(block: Block) -> Block:
    """Return a block whose static loads press it on its joint in the middle, so that it stands in any case."""
    weight = max(block.normal_force, block.concrete_mass * block.gravity)
    arm = block.heel_distance - 0.5 * block.width
    # About the reference point the moment of a force that goes through the middle of the joint.
    return replace(
        block, static=Resultant("bonded", 0.0, -weight, -weight * 0.5 * block.width), static_moment=weight * arm
    )


def _still_until(shaking: Shaking, until: float) -> Shaking:
    """Return a motion that is still up to a moment [s], and jumps there to its value."""
    if until <= 0.0:
        return shaking
    early, late = shaking.time < until, shaking.time > until
    jump = [until, until] if until < shaking.end else []

    def cut(component: Floats) -> Floats:
        begins = np.interp(until, shaking.time, component)
        return np.concatenate([np.zeros(int(early.sum())), [0.0, begins][: len(jump)], component[late]])

    up, turning = (None if component is None else cut(component) for component in (shaking.up, shaking.turning))
    time = np.concatenate([shaking.time[early], jump, shaking.time[late]])
    return replace(shaking, time=time, horizontal=cut(shaking.horizontal), up=up, turning=turning, before=None)
