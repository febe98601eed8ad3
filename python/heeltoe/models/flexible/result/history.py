"""Frames of the crack and both elastic parts: the raw material of figures, VTK files and animation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.frozen import ReadOnlyArrays
from heeltoe.base.table import column, table
from heeltoe.kernel.dam import CONTACT_STATUSES
from heeltoe.models.flexible.body.elastic import stresses
from heeltoe.models.flexible.body.reduced import FlexibleDam

if TYPE_CHECKING:
    import pyarrow as pa

#: Status of a node that is not watched.
UNWATCHED = -1
#: Less damage of a bond is rounding.
LEAST_DAMAGE = 1e-9


@dataclass(frozen=True, eq=False)
class CrackHistory(ReadOnlyArrays):
    """Frames of a run of the flexible model.

    Attributes
    ----------
    time
        (f,) moments [s].
    upper_position, lower_position
        (f, 2, k) where the nodes of the upper and the lower face are, along the crack from the heel and across it
        from the crack [m]; the second is None on a rigid plane.
    force
        (f, 2, k) forces by which the lower face pushes the nodes of the upper one, along and across the crack, mean
        since the frame before [N].
    status
        (f, c) status of each watched node, counting :data:`heeltoe.kernel.CONTACT_STATUSES`.
    modes
        (f, m) amplitudes of the modes of each part, from the crest down.
    dam
        The dam they belong to.
    contactors
        Which nodes are watched, 1 to 5 as in ``flexible.contactors`` of the case.
    place
        Which of the dam's cracks it is, from the crest down.
    damage
        (f, c) of the bond of each watched node: 0 intact, below 1 softening, 1 broken; None of a crack that is no
        bonded joint.
    water
        (f, w) velocities of the modes of compressible water; None without.
    pressures
        (4, p) extremes of its pressure over the run, :func:`heeltoe.models.flexible.result.water.extremes_of_water`.
    """

    time: Floats
    upper_position: Floats
    lower_position: Floats | None
    force: Floats
    status: NDArray[np.uint8]
    modes: tuple[Floats, ...]
    dam: FlexibleDam
    contactors: int = 3
    place: int = 0
    damage: Floats | None = None
    water: Floats | None = None
    pressures: Floats | None = None

    def __repr__(self) -> str:
        nodes = self.upper_position.shape[-1]
        return f"<CrackHistory: {self.time.size} frames of {nodes} nodes, up to {self.time[-1]:.4g} s>"

    def frame_at(self, time: float) -> int:
        """Return the frame nearest to a moment [s]."""
        return int(np.argmin(np.abs(self.time - time)))

    def displacements(self, frame: int) -> tuple[Floats, ...]:
        """Return the displacements (n, 2) [m] of all nodes of each part, x downstream and z up."""
        return tuple(
            (basis.shapes @ amplitude[frame]).reshape(-1, 2)
            for basis, amplitude in zip(self.dam.modes, self.modes, strict=True)
        )

    def stresses(self, frame: int) -> tuple[Floats, ...]:
        """Return the stresses (n, 3) sxx, szz, sxz [Pa] at all nodes of each part; tension is positive."""
        return tuple(
            stresses(body, displacement.reshape(-1))
            for body, displacement in zip(self.dam.bodies, self.displacements(frame), strict=True)
        )

    def gaps(self) -> Floats:
        """Return the gap (f, k) [m] at each node of the upper face; NaN where it is beyond the end of the lower."""
        if self.lower_position is None:
            return self.upper_position[:, 1]
        return _gaps(self.upper_position, self.lower_position)

    @property
    def faces(self) -> tuple[Floats, ...]:
        """Positions of the nodes of the upper and, if there is one, of the lower face."""
        return (self.upper_position,) if self.lower_position is None else (self.upper_position, self.lower_position)

    @property
    def drawn(self) -> tuple[Floats, ...]:
        """Where the nodes of the faces are in the mesh (k, 2) [m]."""
        above, below = self.dam.bodies[self.place].mesh, self.dam.below(self.place)
        upper = above.nodes[above.faces[-1]]
        if below is not None:
            return upper, below.mesh.nodes[below.mesh.faces[0]]
        return (upper,) if self.dam.rock is None else (upper, self.dam.rock.points)

    def node_gaps(self) -> tuple[Floats, ...]:
        """Return the gap (f, k) [m] from the nodes of each face to the other; NaN where they are beyond its end."""
        if self.lower_position is None:
            return (self.gaps(),)
        return self.gaps(), -_gaps(self.lower_position, self.upper_position)

    def deepest_penetration(self) -> float:
        """Return the largest depth [m] to which any node of either face is in the other, watched or not."""
        return max(0.0, *(float(-np.nanmin(gaps)) for gaps in self.node_gaps()))

    def forces(self) -> Floats:
        """Return `force` with the first frame, which has no time before it, filled from the static state."""
        result = self.force.copy()
        result[0] = self.dam.crack_forces[self.place]
        return result

    def node_status(self) -> tuple[NDArray[np.int8], ...]:
        """Return `status` (f, k) for the nodes of each face, -1 where they are not watched."""
        counts = [face.shape[2] for face in self.faces]
        watched = watched_nodes(counts, self.contactors)
        total = sum(nodes.size for _, nodes in watched)
        if total != self.status.shape[1]:
            raise ValueError(f"contactors {self.contactors} are {total} nodes, the history has {self.status.shape[1]}")
        result = tuple(np.full((len(self.time), count), UNWATCHED, dtype=np.int8) for count in counts)
        first = 0
        for face, nodes in watched:
            result[face][:, nodes] = self.status[:, first : first + nodes.size]
            first += nodes.size
        return result

    def node_damage(self) -> tuple[Floats, ...]:
        """Return `damage` (f, k) at the places of the nodes of each face, straight from node to node of the upper one;
        of a bonded joint."""
        if self.damage is None:
            raise ValueError("no bonded joint")
        upper = self.drawn[0]
        along, *others = (np.hypot(*(face - upper[0]).T) for face in self.drawn)
        own = self.damage[:, : along.size]
        return (own, *(np.array([np.interp(at, along, row) for row in own]) for at in others))

    def status_names(self) -> list[str]:
        """Return the names that `status` counts."""
        return list(CONTACT_STATUSES)


def crack_table(history: CrackHistory) -> pa.Table:
    """Return what the nodes of the crack did as a table with one row for each frame and node.

    Columns, with null, never NaN, where there is nothing to say:

    - ``time_s``;
    - ``node``, counted from the heel on each face, and ``x_m``, where it is drawn, in the coordinates of the case;
    - ``side``: upper or lower face, the latter not on a rigid plane;
    - ``along_m`` and ``across_m``: where the node is, along the crack from the heel and across it from the crack;
    - ``force_along_n`` and ``force_across_n``: forces by which the lower face pushes the nodes of the upper one, mean
      since the frame before, in the first frame of the static state; null for nodes of the lower face;
    - ``gap_m`` to the other face; null beyond its end;
    - ``status``: a name of :meth:`CrackHistory.status_names`; null where the node is not watched.
    """
    counts = [face.shape[2] for face in history.faces]
    # Single nodes of the lower face, which need not stand below those of the upper, have no force of their own.
    force = [history.forces(), *(np.full_like(face, np.nan) for face in history.faces[1:])]
    return table(
        {
            "time_s": np.repeat(history.time, sum(counts)),
            "node": _every_frame(history, [np.arange(count, dtype=np.int32) for count in counts]),
            "x_m": _every_frame(history, [points[:, 0] for points in history.drawn]),
            "side": _named(_every_frame(history, [np.full(count, k) for k, count in enumerate(counts)]), _SIDES),
            "along_m": _rows([face[:, 0] for face in history.faces]),
            "across_m": _rows([face[:, 1] for face in history.faces]),
            "force_along_n": _nullable(_rows([item[:, 0] for item in force])),
            "force_across_n": _nullable(_rows([item[:, 1] for item in force])),
            "gap_m": _nullable(_rows(history.node_gaps())),
            "status": _named(_rows(history.node_status()), history.status_names()),
        }
    )


_SIDES = ["upper", "lower"]


def _rows(values: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """Return values (f, k) of each face, frame by frame, upper face first."""
    return np.hstack(values).reshape(-1)


def _every_frame(history: CrackHistory, values: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """Return values (k,) of each face, the same in all frames."""
    return np.tile(np.concatenate(values), len(history.time))


def _nullable(values: Floats) -> pa.Array:
    return column(values, np.isnan(values))


def _named(numbers: NDArray[Any], names: list[str]) -> pa.Array:
    """Return the names that numbers count, null for negative ones."""
    import pyarrow as pa

    return pa.DictionaryArray.from_arrays(column(numbers, numbers < 0), column(names)).cast(pa.string())


def watched_nodes(nodes: list[int], contactors: int) -> list[tuple[int, Integers]]:
    """Return the nodes that are watched, face by face, in the order of the kernel (Zhu 2004, section 6.3)."""
    every = [(face, np.arange(count)) for face, count in enumerate(nodes)]
    if len(nodes) == 1:
        return every
    ends = [(face, np.array([0, count - 1])) for face, count in enumerate(nodes)]
    return {
        1: [every[0]],
        2: [every[1]],
        3: [every[0], ends[1]],
        4: [every[1], ends[0]],
        5: every,
    }[contactors]


def _gaps(own: Floats, other: Floats) -> Floats:
    """Return how far the nodes of one face are above the other, NaN beyond its ends; shapes (f, 2, k)."""
    result = np.empty((len(own), own.shape[2]))
    for frame, (mine, theirs) in enumerate(zip(own, other, strict=True)):
        result[frame] = mine[1] - np.interp(mine[0], theirs[0], theirs[1], left=np.nan, right=np.nan)
    return result


def node_lengths(along: Floats) -> Floats:
    """Return the lengths over which an even stress gives the nodes of a face their forces.

    Of an element of length L the ends have L/6, the node in its middle 2 L/3 (Simpson's rule).

    Parameters
    ----------
    along
        (k,) places of the nodes, ends and middles in turn.
    """
    sizes = along[2::2] - along[:-2:2]
    lengths = np.zeros(along.size)
    lengths[:-2:2] += sizes / 6.0
    lengths[1::2] += 2.0 * sizes / 3.0
    lengths[2::2] += sizes / 6.0
    return lengths
