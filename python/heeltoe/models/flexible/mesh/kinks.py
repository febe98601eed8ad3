"""A mesh whose crack is straight, drawn over to one with kinks.

Corners of elements on the crack are shifted along it until every kink has one, and up or down onto its line; the rest
follows by a share that falls to nothing at the distance of the crest, the base or the next crack. Both parts have the
same number of elements across, so that the nodes of both faces meet. Edges of elements remain straight."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.crack.kinks import climbs, corners
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.geometry.axes import in_x_and_z, places
from heeltoe.models.flexible.mesh.checks import check_elements
from heeltoe.models.flexible.mesh.dam import BodyMesh, DamMesh
from heeltoe.models.flexible.mesh.rows import straighten

# An angle of less is that of a straight crack [rad].
_NO_ANGLE = 1e-9


def kinked(mesh: DamMesh, case: Case) -> DamMesh:
    """Return a mesh with the kinks of each crack.

    Raises
    ------
    InputError
        Where its elements cannot follow.
    """
    parts = list(mesh.parts)
    for place, alone in enumerate(case.single_crack_cases):
        if climbs(alone.crack.kinks):
            # Both parts that meet there; the mesh of the lower one has this crack first.
            for part, face in ((place, -1), (place + 1, 0)):
                parts[part] = _drawn(parts[part], parts[part].faces[face], alone)
    return mesh if mesh.lower is None else DamMesh(tuple(parts[:-1]), parts[-1])


def angles(mesh: BodyMesh, face: Integers, alone: Case) -> list[float]:
    """Return the angles of the segments of a crack's face to the straight line from heel to toe [rad], of the case with
    this crack `alone`; none where it is straight."""
    if not alone.crack.kinks:
        return []
    t, n = np.diff(places(mesh.nodes[face], alone.cut), axis=0).T
    result = np.arctan2(n, t)
    result[np.abs(result) < _NO_ANGLE] = 0.0
    return result.tolist() if result.any() else []


def _drawn(mesh: BodyMesh, face: Integers, alone: Case) -> BodyMesh:
    section = alone.cut
    line = np.array(corners(section, alone.crack.kinks))
    width, across = section.crack_width, (face.size - 1) // 2
    even = np.linspace(0.0, width, across + 1)
    wanted = np.interp(even, width * np.array(_steps(line[:, 0] / width, across)) / across, line[:, 0])
    shift = np.column_stack([wanted - even, np.interp(wanted, line[:, 0], line[:, 1])])
    at = places(mesh.nodes, section)
    # Between the faces at the same distance from the crack, as a part of what is between them.
    up, down = (places(mesh.nodes[path], section) for path in (mesh.upstream, mesh.downstream))
    others = [abs(at[item, 1]).min() for item in mesh.faces if not np.array_equal(item, face)]
    far = min(abs(up[:, 1]).max(), abs(down[:, 1]).max(), *others)
    left, right = (np.interp(abs(at[:, 1]), *_ordered(side)) for side in (up, down))
    part = np.clip((at[:, 0] - left) / np.maximum(right - left, 1e-12 * width), 0.0, 1.0)
    share = np.clip(1.0 - abs(at[:, 1]) / far, 0.0, 1.0)
    moved = share[:, None] * np.column_stack([np.interp(part * width, even, item) for item in shift.T])
    nodes = mesh.nodes + in_x_and_z(moved, section)
    straighten(nodes, mesh.elements)
    try:
        check_elements(nodes, mesh.elements, "crack.kinks")
    except InputError:
        raise InputError("kinks-mesh", "crack.kinks", f"{len(alone.crack.kinks)}") from None
    return replace(mesh, nodes=nodes)


def _ordered(face: Floats) -> tuple[Floats, Floats]:
    """Return distances of a face from the crack, ascending, and its places along it."""
    distance, along = abs(face[:, 1]), face[:, 0]
    order = np.argsort(distance, kind="stable")
    return distance[order], along[order]


def _steps(fractions: Floats, across: int) -> list[int]:
    """Return at which corner of an element each corner of the line is, each at another one.

    Raises
    ------
    InputError
        Where there are too few.
    """
    count = len(fractions)
    if count - 1 > across:
        raise InputError("kinks-mesh", "crack.kinks", f"{count - 2}")
    steps = [0]
    for place, fraction in enumerate(fractions[1:], start=1):
        steps.append(min(max(steps[-1] + 1, round(fraction * across)), across - (count - 1 - place)))
    return steps
