"""The rigid block: the part of the dam above the crack as masses, distances and generalised forces.

Everything is per metre of dam. The reference point stands at the height of the centre of the horizontal mass
(concrete and virtual water) and horizontally at the centroid of the concrete; there, for small rotations,
translation and rotation do not couple although the two masses differ. On an inclined crack they do, and the reference
point is the centroid of the concrete.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Annotated

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block as NumbersBlock
from heeltoe.base.blocks import Number
from heeltoe.case.crack.kinks import climbs
from heeltoe.case.model import Case
from heeltoe.errors.error import expect
from heeltoe.geometry.section import CutSection
from heeltoe.kernel.block import BLOCK
from heeltoe.mechanics.friction import coefficients, friction_of, law_of
from heeltoe.mechanics.loads import Resultant, concrete_mass, face_at, static_forces, total
from heeltoe.mechanics.virtual_water import VirtualMass, virtual_mass
from heeltoe.units.sentences import Sentence

#: A sum of forces that is a smaller part of them is none.
ROUNDING_OF_FORCES = 1e-13


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
    """A block on its crack, ready for the kernel. "Along" and "across" count from the crack, which may be inclined: on
    a level one they are downstream and upwards.

    Attributes
    ----------
    mass_horizontal, mass_vertical
        That moves along the crack: concrete with virtual water; and across it: concrete, and on an inclined crack its
        share of the water [kg/m].
    coupling
        Of the motions along and across, along and rotation, across and rotation by the water, which moves horizontally
        [kg/m, kg, kg]; zero on a level crack.
    inertia
        Polar inertia about the reference point [kg m2/m].
    height
        Of the reference point across the crack [m].
    heel_distance, toe_distance
        From the reference point to heel and toe along the crack [m].
    static
        Sum of the static loads along and across; its moment is about the heel [N/m, N m/m].
    static_moment
        Moment of the static loads about the reference point, counter-clockwise [N m/m].
    per_horizontal, per_vertical
        Loads (along, across, moment about the reference point) per unit of ground acceleration [kg/m, kg/m, kg].
    forces
        The loads one by one, horizontal and vertical.
    following
        Those of them that follow the vertical motion.
    water
        Virtual water.
    friction_static, friction_kinetic, restitution, rocking_loss
        Of the crack; by a friction law, what it bears under the static loads before any slip, and after all of it.
    gravity
        One g of the case [m/s2].
    section
        The part above the crack.
    case
        That it was made of, which says what changes as it moves.
    """

    mass_horizontal: float
    mass_vertical: float
    coupling: tuple[float, float, float]
    inertia: float
    height: float
    heel_distance: float
    toe_distance: float
    static: Resultant
    static_moment: float
    per_horizontal: tuple[float, float, float]
    per_vertical: tuple[float, float, float]
    forces: tuple[Resultant, ...]
    following: tuple[Resultant, ...]
    water: VirtualMass
    friction_static: float
    friction_kinetic: float
    restitution: float
    rocking_loss: float
    gravity: float
    section: CutSection
    case: Case = field(repr=False)

    def __repr__(self) -> str:
        factor = self.sliding_safety_factor
        return (
            f"<Block: {self.concrete_mass:.4g} kg/m of concrete and {self.water.mass:.4g} kg/m of water on a crack of "
            f"{self.width:.4g} m, friction {self.friction_kinetic:g}, "
            f"{'no force along it' if factor is None else f'sliding factor {factor:.3f}'}>"
        )

    @property
    def width(self) -> float:
        """Width of the crack [m]."""
        return self.heel_distance + self.toe_distance

    @property
    def concrete_mass(self) -> float:
        """Mass of the concrete alone [kg/m]; `mass_vertical` has water in it where the crack is inclined."""
        weight = next(force for force in self.forces if force.name == "weight")
        return -weight.vertical / self.gravity

    @property
    def normal_force(self) -> float:
        """Effective weight on the crack, water pressure taken off [N/m]."""
        return -self.static.vertical

    @property
    def sliding_safety_factor(self) -> float | None:
        """Friction there is over friction needed under the static loads; None where none is needed, zero where the
        water lifts the block."""
        needed = abs(self.static.horizontal)
        # Equal water on both sides leaves the rounding of its forces.
        rounding = ROUNDING_OF_FORCES * sum([abs(force.horizontal) + abs(force.vertical) for force in self.forces])
        return self.friction_static * max(0.0, self.normal_force) / needed if needed > rounding else None

    @property
    def resultant_position(self) -> float | None:
        """Where the resultant of the static loads meets the crack, from the heel [m]; None without a normal force."""
        return -self.static.moment / self.normal_force if self.normal_force > 0.0 else None

    def critical_accelerations(self, up: float = 0.0) -> CriticalAccelerations:
        """Horizontal accelerations at which rest ends, each motion by itself, while the ground accelerates upward by
        `up` [m/s2]; they are linear in it.

        At rest under the loads (F, N, M) along, across and about the reference point, which are linear in the ground
        acceleration, ``T = -F`` and the moments about the corners give ``B N_h = M - H F - B_t N`` and
        ``B N_t = -M + H F - B_h N``; sliding starts where ``|T| = mu N`` (Zhu 2004, 4.3.12), rocking where a normal
        force vanishes (the limits behind 4.3.14). Where an acceleration cannot do it the limit is infinite.
        """
        static = (self.static.horizontal, self.static.vertical, self.static_moment)
        along, across, moment = [load + up * rate for load, rate in zip(static, self.per_vertical, strict=True)]
        rates = self.per_horizontal

        def limit(shear: float, normal: float, turning: float, sign: float) -> float:
            """Return the magnitude at which a sum of the loads, these many of each, vanishes."""
            value = shear * along + normal * across + turning * moment
            rate = sign * (shear * rates[0] + normal * rates[1] + turning * rates[2])
            return -value / rate if rate < 0.0 else math.inf

        mu, height = self.friction_static, self.height
        return CriticalAccelerations(
            sliding_downstream=limit(-1.0, -mu, 0.0, -1.0),
            sliding_upstream=limit(1.0, -mu, 0.0, 1.0),
            rocking_downstream=limit(-height, -self.toe_distance, 1.0, -1.0),
            rocking_upstream=limit(height, -self.heel_distance, -1.0, 1.0),
        )

    def parameters(self) -> Floats:
        """Return the numbers the kernel takes, shape (21,), in the order of :data:`heeltoe.kernel.BLOCK`."""
        return np.array(self.numbers())

    def numbers(self) -> tuple[float, ...]:
        """Return the same one by one."""
        values = (
            self.mass_horizontal,
            self.mass_vertical,
            self.inertia,
            self.height,
            self.heel_distance,
            self.toe_distance,
            self.static.horizontal,
            self.static.vertical,
            self.static_moment,
            *self.per_horizontal,
            *self.per_vertical,
            self.friction_static,
            self.friction_kinetic,
            self.restitution,
            *self.coupling,
            self.rocking_loss,
        )
        assert len(values) == len(BLOCK)
        return values


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
    expect(case, Case, "a case", "case")
    section = case.above
    concrete = concrete_mass(case)
    offset = section.in_crack_frame(*section.centroid_from_heel)
    inertia = case.concrete.density * section.polar_inertia
    forces = static_forces(case)
    water = virtual_mass(case)
    static = across_crack(total("static loads", forces), section)
    sides = {"reservoir": case.reservoir, "tailwater": case.tailwater, "nappe": case.reservoir}
    hanging = [name for name, side in sides.items() if side is not None and side.follows_vertical_motion]
    following = tuple(force for force in forces if force.name in hanging)
    pressed = across_crack(total("following", following), section)
    if section.level:
        mass = concrete + water.mass
        height = (concrete * offset[1] + water.mass * water.height) / mass
        inertia += concrete * (offset[1] - height) ** 2 + water.mass * (water.height - height) ** 2 + water.inertia
        masses = (mass, concrete, inertia)
        coupling = (0.0, 0.0, 0.0)
        horizontal, vertical = (-mass, 0.0, 0.0), (0.0, -concrete, 0.0)
    else:
        # The reference point is the centroid of the concrete; the water moves sideways, by its height alone.
        height = offset[1]
        e, n = section.in_crack_frame(1.0, 0.0)
        x, z = section.in_crack_frame(face_at(section, water.height), water.height)
        arm = n * (x - offset[0]) - e * (z - height)
        moved = water.mass
        masses = (concrete + moved * e * e, concrete + moved * n * n, inertia + moved * arm * arm + water.inertia)
        coupling = (moved * e * n, moved * e * arm, moved * n * arm)
        horizontal = (-(concrete + moved) * e, -(concrete + moved) * n, -moved * arm)
        up = section.in_crack_frame(0.0, 1.0)
        vertical = (-concrete * up[0], -concrete * up[1], 0.0)
    at_rest, sliding = friction_of(case.crack, -static.vertical, section.crack_width)
    g = case.gravity
    pressure = (pressed.horizontal / g, pressed.vertical / g, pressed.moment_about(offset[0], height) / g)
    return Block(
        mass_horizontal=masses[0],
        mass_vertical=masses[1],
        coupling=coupling,
        inertia=masses[2],
        height=height,
        heel_distance=offset[0],
        toe_distance=section.crack_width - offset[0],
        static=static,
        static_moment=static.moment_about(offset[0], height),
        per_horizontal=horizontal,
        per_vertical=(vertical[0] + pressure[0], vertical[1] + pressure[1], vertical[2] + pressure[2]),
        forces=forces,
        following=following,
        water=water,
        friction_static=at_rest,
        friction_kinetic=sliding,
        restitution=case.crack.restitution,
        rocking_loss=case.crack.rocking_loss,
        gravity=case.gravity,
        section=section,
        case=case,
    )


def without_bond(block: Block) -> Block:
    """Return a block with no cohesion of a friction law in its friction at rest."""
    law = block.case.crack.law
    if law is None or law.cohesion is None:
        return block
    at_rest, _ = coefficients(law_of(law), block.normal_force / block.width)
    return replace(block, friction_static=at_rest)


def instability(block: Block) -> Sentence | None:
    """Say what moves a block under its static loads alone, and by how much; None where it stands."""
    if block.normal_force <= 0.0:
        return Sentence("the water pressure below the dam is more than its weight: it floats")
    reasons = []
    factor = block.sliding_safety_factor
    # The steps of a crack may hold what friction on the straight line from heel to toe does not.
    if factor is not None and factor < 1.0 and not climbs(block.case.crack.kinks):
        text = "it slides under its static loads alone (sliding safety factor {factor:.3f})"
        reasons.append(Sentence.of(text, factor=factor))
    position = block.resultant_position
    if position is not None and not 0.0 <= position <= block.width:
        text = (
            "it overturns about its {corner} under its static loads alone (resultant {position_m:.2f m} from the heel, "
            "crack {width_m:.2f m} wide)"
        )
        corner = "toe" if position > block.width else "heel"
        reasons.append(Sentence.of(text, corner=corner, position_m=position, width_m=block.width))
    if len(reasons) > 1:
        return Sentence.of("{sliding} and {overturning}", sliding=reasons[0], overturning=reasons[1])
    return reasons[0] if reasons else None


def across_crack(force: Resultant, section: CutSection) -> Resultant:
    """Return a force by its components along and across the crack."""
    along, across = section.in_crack_frame(force.horizontal, force.vertical)
    return Resultant(force.name, along, across, force.moment, force.virial)


class CriticalAccelerationsInG(NumbersBlock):
    """Ground accelerations at which the block at rest starts to move; infinite where none does it."""

    sliding: Annotated[float, Number("The smaller one of both ways of sliding.", "g")]
    rocking: Annotated[float, Number("The smaller one of both ways of rocking.", "g")]
    sliding_downstream: Annotated[float, Number("At which it starts to slide downstream.", "g")]
    sliding_upstream: Annotated[float, Number("At which it starts to slide upstream.", "g")]
    rocking_downstream: Annotated[float, Number("At which it starts to rock about its toe.", "g")]
    rocking_upstream: Annotated[float, Number("At which it starts to rock about its heel.", "g")]


class StaticState(NumbersBlock):
    """The state under the static loads, before the earthquake."""

    critical_acceleration_g: Annotated[
        CriticalAccelerationsInG, Number("Ground accelerations at which the block at rest starts to move.", "g")
    ]
    critical_acceleration_per_vertical: Annotated[
        dict[str, float],
        Number("By how much these grow with each g of upward ground acceleration, by their names."),
    ]
    sliding_safety_factor: Annotated[
        float | None,
        Number(
            "Available friction over the force along the crack, or along the straight line from heel to toe of one "
            "with kinks."
        ),
    ]
    resultant_from_heel_m: Annotated[
        float | None, Number("Where the resultant of all forces meets the crack, from the heel.", "m")
    ]
    normal_force_n: Annotated[float, Number("Force across the crack, uplift taken off.", "N per metre of dam")]
    horizontal_force_n: Annotated[float, Number("Force along the crack, positive downstream.", "N per metre of dam")]
    concrete_mass_kg: Annotated[float, Number("Mass of the concrete above the crack.", "kg per metre of dam")]
    virtual_mass_kg: Annotated[float, Number("Mass of the water that moves with it.", "kg per metre of dam")]


def static_state(block: Block) -> StaticState:
    """Return the state under the static loads, by the names of the contract."""
    critical, lifted = (vars(block.critical_accelerations(up)) for up in (0.0, block.gravity))
    limits = {name: value / block.gravity for name, value in critical.items()}
    return StaticState(
        critical_acceleration_g=CriticalAccelerationsInG(
            sliding=min(limits["sliding_downstream"], limits["sliding_upstream"]),
            rocking=min(limits["rocking_downstream"], limits["rocking_upstream"]),
            **limits,
        ),
        # By how much more for each g of upward acceleration; what no acceleration does, none changes.
        critical_acceleration_per_vertical={
            name: (lifted[name] - value) / block.gravity if math.isfinite(value) else 0.0
            for name, value in critical.items()
        },
        sliding_safety_factor=block.sliding_safety_factor,
        resultant_from_heel_m=block.resultant_position,
        normal_force_n=block.normal_force,
        horizontal_force_n=block.static.horizontal,
        concrete_mass_kg=block.concrete_mass,
        virtual_mass_kg=block.water.mass,
    )
