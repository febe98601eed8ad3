"""The longest time step that follows what acts in the crack beside contact."""

from __future__ import annotations

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.body.bond import node_lengths
from heeltoe.models.flexible.body.inside import CrackAnchor, FollowingWater
from heeltoe.models.flexible.body.reduced import FlexibleDam, ReducedBody

# Up to dt^2 stiffness / mass = 4 / (4 theta - 1) a spring is stable, at this it is followed with an error of 4 %.
_FOLLOWED = 1.0


def longest_step(dam: FlexibleDam, theta: float, step: float) -> tuple[float, str]:
    """Return a step [s], `step` or a shorter one, that follows water and anchors, and the field that asks for it.

    Each is a spring of stiffness k between the faces. With W, the velocities of the crack nodes by unit impulses on
    them within a step of dt, ``dt^2 W k`` has no eigenvalue above 1. Shorter steps have a larger W: a body answers
    more freely at once.
    """
    bodies = dam.reduced
    # Rock answers about as the part above it does.
    both = 1.0 if dam.rock is None else 2.0
    for _ in range(20):
        springs = [
            ("uplift.opening", both * _water_rate(bodies, dam.water, theta, step)),
            ("crack.bond", max((_bond_rate(dam, place, theta, step) for place in range(len(dam.lines))), default=0.0)),
            ("anchors", both * max((_anchor_rate(bodies, anchor, theta, step) for anchor in dam.anchors), default=0.0)),
        ]
        field, rate = max(springs, key=lambda spring: spring[1])
        if step * step * rate <= _FOLLOWED:
            break
        step /= 2.0
    return step, field


def _answer(body: ReducedBody, theta: float, step: float) -> Floats:
    weight = 1.0 / (1.0 + theta * step * body.damping_free + (theta * step) ** 2 * body.omega_squared)
    result: Floats = (body.shapes.T * weight) @ body.shapes
    return result


def _water_rate(bodies: tuple[ReducedBody, ...], water: FollowingWater | None, theta: float, step: float) -> float:
    if water is None:
        return 0.0
    rate = 0.0
    for body, still, full in zip(bodies, water.still, water.full, strict=False):
        change = full - still if water.law == "full while open" else still
        root = np.sqrt(np.abs(change) / water.opening)
        count = root.size
        across = _answer(body, theta, step)[count:, count:]
        rate += float(np.linalg.eigvalsh(root[:, None] * across * root)[-1])
    return rate


def _bond_rate(dam: FlexibleDam, place: int, theta: float, step: float) -> float:
    """Return the largest eigenvalue of W k with the slopes k by which the nodes of a joint soften [1/s2]."""
    line = dam.lines[place]
    if line.bond is None:
        return 0.0
    tensile, cohesion, opening, shear, factor, first = line.bond
    above = dam.reduced[place]
    half, (_, count) = above.position.size // 2, line.upper
    top = half - count
    lengths = node_lengths(above.position[top:half])
    rate = 0.0
    for direction, (strength, energy) in enumerate(((cohesion, shear), (tensile, opening))):
        root = np.sqrt(lengths * (factor * strength) ** 2 / (2.0 * first * energy))
        answer = np.zeros((count, count))
        bodies = [(above, top)]
        if line.lower[1] == count:
            bodies.append((dam.reduced[place + 1], 0))
        elif line.lower[1]:
            # Faces of unlike meshes: the lower one answers about as the upper one does.
            bodies.append((above, top))
        for body, start in bodies:
            own = direction * (body.position.size // 2) + start
            answer += _answer(body, theta, step)[own : own + count, own : own + count]
        rate = max(rate, float(np.linalg.eigvalsh(root[:, None] * answer * root)[-1]))
    return rate


def _anchor_rate(bodies: tuple[ReducedBody, ...], anchor: CrackAnchor, theta: float, step: float) -> float:
    answer = np.zeros((2, 2))
    for body, point in zip(bodies, anchor.points, strict=False):
        count = body.position.size // 2
        weights = np.zeros((2, 2 * count))
        for node, share in point:
            weights[0, node] += share
            weights[1, count + node] += share
        answer += weights @ _answer(body, theta, step) @ weights.T
    axis = np.array(anchor.axis)
    stiffness = anchor.axial_stiffness * np.outer(axis, axis) + anchor.shear_stiffness * np.diag([1.0, 0.0])
    return float(np.abs(np.linalg.eigvals(answer @ stiffness)).max())
