"""Where the stresses of a part are read over a run, and how they follow from its modes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.models.flexible.body.elastic import Body, stress_rows
from heeltoe.models.flexible.body.modes import Modes
from heeltoe.models.flexible.mesh.dam import BodyMesh

#: A stress without a bound is read no nearer to its place than this part of the width of the dam there.
APART = 1.0 / 8.0
# A face that turns by less at a corner [rad] is bent: a curve in pieces.
_CORNER = 0.09
_ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class StressPlaces:
    """Where the stresses of a body with m modes are read: at p corners of its elements.

    Within an element the stresses that its 2 x 2 Gauss points give are straight along every line from side to side, so
    that its largest tension is at a corner.

    Attributes
    ----------
    nodes
        (p,) of the mesh.
    rows
        (p, m, 3) stresses xx, zz and xz [Pa] by a unit of each mode; rigid ones give none.
    bounded
        (p,) whether the stress there has a bound as the mesh gets finer, see :func:`bounded`.
    apart
        How near to the crack they are read at least [m].
    """

    nodes: Integers
    rows: Floats
    bounded: NDArray[np.bool_]
    apart: float


@dataclass(frozen=True, eq=False)
class StressRows:
    """Rows of the parts for the kernel, and the steps between two states whose stresses are computed."""

    parts: tuple[Floats, ...]
    stride: int


def stress_places(body: Body, modes: Modes) -> StressPlaces:
    """Return where the stresses of a body are read."""
    mesh = body.mesh
    nodes = np.unique(mesh.elements[:, :4])
    result = (stress_rows(body, nodes) @ modes.shapes).reshape(nodes.size, 3, -1)
    # Rounding of the shapes, times a slip of metres, is no stress.
    result[..., : modes.rigid] = 0.0
    rows = np.ascontiguousarray(result.swapaxes(1, 2))
    return StressPlaces(nodes, rows, bounded(mesh, mesh.nodes[nodes]), APART * min(map(_crack_width, _cracks(mesh))))


def bounded(mesh: BodyMesh, points: Floats) -> NDArray[np.bool_]:
    """Return which points (p, 2) are far enough from where an elastic stress grows without bound with a finer mesh.

    That is along the crack, whose nodes carry forces of contact one by one, at the ends of a base that is held, and
    where a face turns inwards. "Far enough" is :data:`APART` of the width of the dam at that height, of the crack from
    the crack.
    """
    far = np.ones(len(points), dtype=np.bool_)
    for crack in _cracks(mesh):
        far &= _from_crack(crack, points) >= APART * _crack_width(crack) * (1.0 - _ROUNDING)
    for corner in _corners(mesh):
        width = _width(mesh, float(corner[1]))
        far &= np.hypot(*(points - corner).T) >= APART * width * (1.0 - _ROUNDING)
    return far


def _cracks(mesh: BodyMesh) -> list[Floats]:
    """Return heel and toe of the cracks of a part, (2, 2) each."""
    return [mesh.nodes[face[[0, -1]]] for face in mesh.faces]


def _crack_width(ends: Floats) -> float:
    return float(np.hypot(*(ends[1] - ends[0])))


def _from_crack(ends: Floats, points: Floats) -> Floats:
    """Return how far points are from a straight crack [m]."""
    heel, toe = ends
    along = toe - heel
    share = np.clip((points - heel) @ along / (along @ along), 0.0, 1.0)
    apart: Floats = np.hypot(*(points - heel - share[:, None] * along).T)
    return apart


def _corners(mesh: BodyMesh) -> Floats:
    """Return the ends of held edges, and the corners of the faces that turn inwards, shape (k, 2)."""
    result = []
    if mesh.fixed.size:
        base = mesh.nodes[mesh.fixed]
        result += [base[base[:, 0].argmin()], base[base[:, 0].argmax()]]
    # Going up, the concrete is on the right hand of the upstream face and on the left of the downstream one.
    for path, side in ((mesh.upstream, 1.0), (mesh.downstream, -1.0)):
        face = mesh.nodes[path[::2]]
        way = np.diff(face, axis=0)
        before, after = way[:-1], way[1:]
        turn = np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
        result += list(face[1:-1][side * turn > _CORNER])
    return np.array(result).reshape(-1, 2)


def _width(mesh: BodyMesh, height: float) -> float:
    """Return how wide the part is at a height [m]."""
    ends = []
    for path in (mesh.upstream, mesh.downstream):
        x, z = mesh.nodes[path].T
        order = np.argsort(z, kind="stable")
        ends.append(float(np.interp(height, z[order], x[order])))
    return ends[1] - ends[0]
