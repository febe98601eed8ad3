"""The longest time step that follows what acts in the crack beside contact."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.kernel.dam import CrackAnchor
from heeltoe.models.flexible.body.bond import node_lengths
from heeltoe.models.flexible.body.reduced import FlexibleDam, ReducedBody

# Up to dt^2 stiffness / mass = 4 / (4 theta - 1) a spring is stable, at this it is followed with an error of 4 %.
_FOLLOWED = 1.0


def longest_step(
    dam: FlexibleDam, theta: float, step: float, across: tuple[ReducedBody, ...] = ()
) -> tuple[float, str]:
    """Return a step [s], `step` or a shorter one, that follows water, bonds and anchors, and the field that asks for
    it; `across` are the parts across the valley, where the ground shakes that way.

    Each is a spring of stiffness k between the faces. With W, the velocities of the crack nodes by unit impulses on
    them within a step of dt, ``dt^2 W k`` has no eigenvalue above 1. Shorter steps have a larger W: a body answers
    more freely at once.
    """

    places = range(len(dam.lines))

    def largest(rate: Callable[[FlexibleDam, int, float, float], float]) -> float:
        return max(rate(dam, place, theta, step) for place in places)

    # Rock answers about as the part above it does.
    both = 1.0 if dam.rock is None else 2.0
    for _ in range(20):
        springs = [
            ("uplift.opening", both * largest(_water_rate)),
            ("crack.bond", largest(_bond_rate)),
            # An anchor is one spring at all cracks that it crosses.
            ("anchors", both * sum(_anchors_rate(dam, place, theta, step) for place in places)),
        ]
        if across:
            springs += [
                ("crack.bond", max(_bond_rate_across(dam, across, place, theta, step) for place in places)),
                ("anchors", both * sum(_dowels_rate(dam, across, place, theta, step) for place in places)),
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


def _faces(dam: FlexibleDam, place: int) -> list[tuple[ReducedBody, int]]:
    """Return the parts of the dam above and, if there is one, below a crack, with the first node of its face."""
    line, parts = dam.lines[place], dam.reduced[place : place + 2]
    return list(zip(parts, (line.upper[0], line.lower[0]), strict=False))


def _faces_across(dam: FlexibleDam, across: tuple[ReducedBody, ...], place: int) -> list[tuple[ReducedBody, int]]:
    """Return the same of the parts across the valley."""
    line = dam.lines[place]
    return list(zip(across[place : place + 2], (line.upper[0], line.lower[0]), strict=False))


def _water_rate(dam: FlexibleDam, place: int, theta: float, step: float) -> float:
    water = dam.lines[place].water
    if water is None:
        return 0.0
    rate = 0.0
    for (body, first), still, full in zip(_faces(dam, place), water.still, water.full, strict=False):
        change = full - still if water.law == "full while open" else still
        root = np.sqrt(np.abs(change) / water.opening)
        own = body.position.size // 2 + first
        across = _answer(body, theta, step)[own : own + root.size, own : own + root.size]
        rate += float(np.linalg.eigvalsh(root[:, None] * across * root)[-1])
    return rate


def _bond_rate(dam: FlexibleDam, place: int, theta: float, step: float) -> float:
    """Return the largest eigenvalue of W k with the slopes k by which the nodes of a joint soften [1/s2]."""
    line = dam.lines[place]
    if line.bond is None:
        return 0.0
    tensile, cohesion, opening, shear, factor, first = line.bond
    lengths = _lengths(dam, place)
    rate = 0.0
    for direction, (strength, energy) in enumerate(((cohesion, shear), (tensile, opening))):
        root = np.sqrt(lengths * (factor * strength) ** 2 / (2.0 * first * energy))
        bodies = [(body, direction * (body.position.size // 2) + node) for body, node in _faces(dam, place)]
        rate = max(rate, _softening(dam, place, bodies, root, theta, step))
    return rate


def _bond_rate_across(
    dam: FlexibleDam, across: tuple[ReducedBody, ...], place: int, theta: float, step: float
) -> float:
    """Return the same across the valley, where a joint softens as along it."""
    bond = dam.lines[place].bond
    if bond is None:
        return 0.0
    _, cohesion, _, shear, factor, first = bond
    root = np.sqrt(_lengths(dam, place) * (factor * cohesion) ** 2 / (2.0 * first * shear))
    return _softening(dam, place, _faces_across(dam, across, place), root, theta, step)


def _lengths(dam: FlexibleDam, place: int) -> Floats:
    (above, top), count = _faces(dam, place)[0], dam.lines[place].upper[1]
    return node_lengths(above.position[top : top + count])


def _softening(
    dam: FlexibleDam, place: int, bodies: list[tuple[ReducedBody, int]], root: Floats, theta: float, step: float
) -> float:
    """Return the largest eigenvalue of W k of faces that begin at these components of bodies, from the roots of k."""
    count = dam.lines[place].upper[1]
    if dam.lines[place].lower[1] not in (0, count):
        # Faces of unlike meshes: the lower one answers about as the upper one does.
        bodies = [bodies[0]] * 2
    answer = np.zeros((count, count))
    for body, own in bodies:
        answer += _answer(body, theta, step)[own : own + count, own : own + count]
    return float(np.linalg.eigvalsh(root[:, None] * answer * root)[-1])


def _anchors_rate(dam: FlexibleDam, place: int, theta: float, step: float) -> float:
    faces = _faces(dam, place)
    return max((_anchor_rate(faces, anchor, theta, step) for anchor in dam.lines[place].anchors), default=0.0)


def _anchor_rate(faces: list[tuple[ReducedBody, int]], anchor: CrackAnchor, theta: float, step: float) -> float:
    answer = np.zeros((2, 2))
    for (body, first), point in zip(faces, anchor.points, strict=False):
        count = body.position.size // 2
        weights = np.zeros((2, 2 * count))
        for node, share in point:
            weights[0, first + node] += share
            weights[1, count + first + node] += share
        answer += weights @ _answer(body, theta, step) @ weights.T
    axis = np.array(anchor.axis)
    stiffness = anchor.axial_stiffness * np.outer(axis, axis) + anchor.shear_stiffness * np.diag([1.0, 0.0])
    return float(np.abs(np.linalg.eigvals(answer @ stiffness)).max())


def _dowels_rate(dam: FlexibleDam, across: tuple[ReducedBody, ...], place: int, theta: float, step: float) -> float:
    """Return the largest rate of the anchors of a crack across the valley, where they resist slip as along it."""
    faces, rate = _faces_across(dam, across, place), 0.0
    for anchor in dam.lines[place].anchors:
        answer = 0.0
        for (body, first), point in zip(faces, anchor.points, strict=False):
            weights = np.zeros(body.position.size)
            for node, share in point:
                weights[first + node] += share
            answer += float(weights @ _answer(body, theta, step) @ weights)
        rate = max(rate, anchor.shear_stiffness * answer)
    return rate
