"""An elastic dam cut by a crack: how it is run, what it did."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.arrays import Floats
from heeltoe.kernel.columns import columns

if TYPE_CHECKING:
    from heeltoe._kernel import CrackAnchor, FollowingWater, ReducedBody, StressRows

#: Names of what an elastic dam does, how its run ends, and what the nodes of its crack do.
DAM_STATES = tuple(_kernel.CRACK_STATES)
DAM_OUTCOMES = tuple(_kernel.CRACK_OUTCOMES)
CONTACT_STATUSES = tuple(_kernel.CONTACT_STATUSES)
#: What ends runs on other threads than the main one.
Ending = _kernel.Ending


@dataclass(frozen=True, eq=False)
class DamRun:
    """What an elastic dam did; f frames, k nodes on the crack, m modes.

    Attributes
    ----------
    summary
        Numbers by name.
    tension
        Largest tension of each anchor with stiffness [N].
    frames
        Columns (f,) by name.
    upper, lower
        (f, 2 k) where the nodes of either face are, all along the crack, then all across it [m].
    force
        (f, 2 k) mean forces on the nodes of the upper face since the frame before [N].
    status
        (f, c) of each watched node, counting :data:`CONTACT_STATUSES`.
    modes
        (f, m) amplitudes of the modes of the upper and of the lower part.
    extremes
        Of the stresses of each part, columns (p,) by name: largest principal stress, when, and the stress then; least
        principal stress, and when. Empty where none are wanted.
    """

    summary: Mapping[str, float]
    tension: tuple[float, ...]
    frames: Mapping[str, Floats]
    upper: Floats
    lower: Floats
    force: Floats
    status: NDArray[np.uint8]
    modes: tuple[Floats, Floats]
    extremes: tuple[Mapping[str, Floats], ...]

    @property
    def outcome(self) -> str:
        """By name."""
        return DAM_OUTCOMES[int(self.summary["outcome"])]

    @property
    def final_state(self) -> str:
        """By name."""
        return DAM_STATES[int(self.summary["final_state"])]


@dataclass(frozen=True, eq=False)
class AtRest:
    """An elastic dam before the earthquake, its crack let go; k nodes on the crack, m modes.

    Attributes
    ----------
    slip
        Since the crack was bonded [m].
    open_contacts
        How many of the watched nodes are open.
    modes
        (m,) amplitudes of the upper and of the lower part.
    force
        (2, k) forces on the nodes of the upper face, along and across the crack [N].
    """

    slip: float
    open_contacts: int
    modes: tuple[Floats, Floats]
    force: Floats


class CrackedDam:
    """Two elastic parts with a frictional crack between them; immutable, so that many runs may share one.

    Parameters
    ----------
    upper, lower
        The parts; without a lower one the crack is on a rigid plane.
    friction
        Coefficients at rest and sliding.
    contactors
        Which nodes are watched, 1 to 5.
    water
        Where its pressure follows the opening.
    anchors
        Those with stiffness. Neither goes with the penalty method.
    give
        Rotation [rad] and gap [m] of the crack's faces that elastic deformation alone accounts for.
    """

    def __init__(
        self,
        upper: ReducedBody,
        lower: ReducedBody | None,
        friction: tuple[float, float],
        contactors: int,
        water: FollowingWater | None = None,
        anchors: Sequence[CrackAnchor] = (),
        give: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self._dam = _kernel.CrackedDam(upper, lower, friction, contactors, water, anchors, give)

    def still(self) -> AtRest | None:
        """Return the state before the earthquake; None where friction does not hold the dam."""
        found = self._dam.still()
        if found is None:
            return None
        slip, opened, above, below, force = found
        return AtRest(slip, opened, (above, below), force.reshape(2, -1))

    def run(
        self,
        ground: Floats,
        step: float,
        theta: float,
        *,
        stride: int = 0,
        stresses: StressRows | None = None,
        penalty: tuple[float, float, float] | None = None,
        ending: Ending | None = None,
    ) -> DamRun:
        """Shake it, with exact contact or with springs at the contacts.

        Parameters
        ----------
        ground
            (n, 2) mean horizontal and vertical acceleration of each step [m/s2]; for springs that at both ends of all
            steps, (n + 1, 2).
        step
            Time step [s].
        theta
            Weight of the new state within a step, 0.5 to 1; springs know none.
        stride
            Steps from frame to frame; 0 for no frames.
        stresses
            Of which the extremes are wanted.
        penalty
            Stiffness of the springs [N/m] and Newmark's gamma and beta.
        ending
            What may end the run from another thread.
        """
        row, frames, upper, lower, force, status, above, below, *extremes = self._dam.run(
            ground, step, theta, stride, stride > 0, stresses, penalty, ending
        )
        names, numbers = _kernel.CRACK_SUMMARY_FIELDS, row.tolist()
        return DamRun(
            summary=dict(zip(names, numbers, strict=False)),
            tension=tuple(numbers[len(names) :]),
            frames=columns(_kernel.FRAME_FIELDS, frames),
            upper=upper,
            lower=lower,
            force=force,
            status=status,
            modes=(above, below),
            extremes=tuple(columns(_kernel.EXTREME_FIELDS, each) for each in extremes if each.size),
        )

    def run_many(
        self,
        ground: Floats,
        step: float,
        theta: float,
        scales: Floats,
        *,
        threads: int = 0,
        penalty: tuple[float, float, float] | None = None,
        ending: Ending | None = None,
    ) -> dict[str, Floats]:
        """Shake it once for each pair of factors, (n, 2), on `threads` cores (0 for all); the numbers, (n,) by name."""
        pairs = [(across, up) for across, up in scales.tolist()]
        rows = self._dam.run_many(ground, step, theta, pairs, threads, penalty, ending)
        return columns(_kernel.CRACK_SUMMARY_FIELDS, rows[:, : len(_kernel.CRACK_SUMMARY_FIELDS)])
