"""What the crack and both elastic parts did, frame by frame: the raw material of figures, VTK files and animation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.elastic import stresses
from heeltoe.flexible_parts import FlexibleDam

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CrackHistory:
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
        (f, c) status of each watched node, counting ``_kernel.CONTACT_STATUSES``.
    modes
        (f, m) amplitudes of the modes of the upper and, if there is one, of the lower part.
    dam
        The dam they belong to.
    """

    time: Floats
    upper_position: Floats
    lower_position: Floats | None
    force: Floats
    status: NDArray[np.uint8]
    modes: tuple[Floats, ...]
    dam: FlexibleDam

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

    def deepest_penetration(self) -> float:
        """Return the largest depth [m] to which any node of either face is in the other, watched or not."""
        found = [self.gaps()]
        if self.lower_position is not None:
            found.append(-_gaps(self.lower_position, self.upper_position))
        return max(0.0, *(float(-np.nanmin(gaps)) for gaps in found))

    def status_names(self) -> list[str]:
        """Return the names that `status` counts."""
        return list(_kernel.CONTACT_STATUSES)


def _gaps(own: Floats, other: Floats) -> Floats:
    """Return how far the nodes of one face are above the other, NaN beyond its ends; shapes (f, 2, k)."""
    found = np.empty((len(own), own.shape[2]))
    for frame, (mine, theirs) in enumerate(zip(own, other, strict=True)):
        found[frame] = mine[1] - np.interp(mine[0], theirs[0], theirs[1], left=np.nan, right=np.nan)
    return found
