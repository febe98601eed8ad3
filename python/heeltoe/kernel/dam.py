"""An elastic dam cut by a crack: how it is run, what it did."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.arrays import Floats
from heeltoe.kernel.columns import columns
from heeltoe.kernel.friction import FrictionLaw

if TYPE_CHECKING:
    from heeltoe._kernel import CrackAnchor, FollowingWater, ReducedBody, StressRows

#: Names of what an elastic dam does, how its run ends, and what the nodes of its crack do.
DAM_STATES = tuple(_kernel.CRACK_STATES)
DAM_OUTCOMES = tuple(_kernel.CRACK_OUTCOMES)
CONTACT_STATUSES = tuple(_kernel.CONTACT_STATUSES)
#: What ends runs on other threads than the main one.
Ending = _kernel.Ending


@dataclass(frozen=True)
class CrackLine:
    """A crack.

    Attributes
    ----------
    upper, lower
        First and number of the nodes of either face, among those of the part it belongs to; (0, 0) for a rigid plane.
    friction
        Coefficients at rest and sliding.
    give
        Rotation [rad] and gap [m] of the faces that elastic deformation alone accounts for.
    law
        A friction law in place of the coefficients.
    angles
        Of the segments of the upper and of the lower face to the line from heel to toe [rad]; none of a straight crack.
    """

    upper: tuple[int, int]
    lower: tuple[int, int]
    friction: tuple[float, float]
    give: tuple[float, float] = (0.0, 0.0)
    law: FrictionLaw | None = None
    angles: tuple[list[float], list[float]] = ([], [])


def only_crack(
    upper: ReducedBody,
    lower: ReducedBody | None,
    friction: tuple[float, float],
    give: tuple[float, float] = (0.0, 0.0),
    law: FrictionLaw | None = None,
) -> tuple[CrackLine, ...]:
    """Return the crack between two parts that have no other."""
    above, below = (0 if part is None else part.position.size // 2 for part in (upper, lower))
    return (CrackLine((0, above), (0, below), friction, give, law),)


@dataclass(frozen=True, eq=False)
class RisingWater:
    """Water in the only crack whose pressure changes with time.

    Attributes
    ----------
    span
        From when to when it changes, evenly [s].
    change
        By how much the forces of the nodes of the upper and, if there is one, of the lower face change across the
        crack, (k,) each [N].
    """

    span: tuple[float, float]
    change: tuple[Floats, ...]


@dataclass(frozen=True, eq=False)
class DamRun:
    """What an elastic dam did; f frames, k nodes on cracks, m modes.

    Attributes
    ----------
    summary
        Numbers by name, of the crack asked of.
    tension
        Largest tension of each anchor with stiffness [N].
    frames
        Columns (f,) by name, of the crack asked of.
    summaries, all_frames
        The same of all cracks, from the crest down.
    upper, lower
        (f, 2 k) where the nodes of either part are, all along their cracks, then all across them [m].
    force
        (f, 2 k) mean forces on the nodes of the upper part since the frame before, and with several cracks on those of
        the lower one behind them [N].
    status
        (f, c) of each watched node, counting :data:`CONTACT_STATUSES`.
    modes
        (f, m) amplitudes of the modes of the upper and of the lower part.
    extremes
        Of the stresses of each part, columns (p,) by name: largest principal stress, when, and the stress then; least
        principal stress, and when. Empty where none are wanted.
    worked
        What the watched nodes of cracks with a law have been through, columns (n,) by name: number of the crack, the
        length of it that is theirs [m], whether they come in the place of the other face's end, path slipped [m] and
        whether the bond is whole, both before the earthquake, and the normal force then [N]. Empty without a law.
    """

    summary: Mapping[str, float]
    tension: tuple[float, ...]
    frames: Mapping[str, Floats]
    summaries: tuple[Mapping[str, float], ...]
    all_frames: tuple[Mapping[str, Floats], ...]
    upper: Floats
    lower: Floats
    force: Floats
    status: NDArray[np.uint8]
    modes: tuple[Floats, Floats]
    extremes: tuple[Mapping[str, Floats], ...]
    worked: Mapping[str, Floats]

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
    """An elastic dam before the earthquake, its cracks let go; k nodes on cracks, m modes.

    Attributes
    ----------
    slips
        Of each crack since it was bonded [m].
    open_contacts
        How many of the watched nodes of each are open.
    modes
        (m,) amplitudes of the upper and of the lower part.
    forces
        (2, k) forces on the nodes of the upper and of the lower part, along and across their cracks [N].
    """

    slips: tuple[float, ...]
    open_contacts: tuple[int, ...]
    modes: tuple[Floats, Floats]
    forces: tuple[Floats, Floats]


class CrackedDam:
    """Elastic parts with frictional cracks between them; immutable, so that many runs may share one.

    Parameters
    ----------
    upper, lower
        The parts; without a lower one the only crack is on a rigid plane. Of several cracks `upper` has the first,
        third, ... part from the crest down side by side, and `lower` the others.
    cracks
        From the crest down.
    contactors
        Which nodes are watched, 1 to 5.
    water
        Where its pressure follows the opening.
    anchors
        Those with stiffness. Neither goes with the penalty method, nor do they or that go with several cracks.
    asked
        Which crack is told of first.
    """

    def __init__(
        self,
        upper: ReducedBody,
        lower: ReducedBody | None,
        cracks: Sequence[CrackLine],
        contactors: int,
        water: FollowingWater | None = None,
        anchors: Sequence[CrackAnchor] = (),
        *,
        asked: int = 0,
    ) -> None:
        self._dam = _kernel.CrackedDam(upper, lower, cracks, contactors, water, anchors)
        self._cracks, self._asked = len(cracks), asked
        self._rising: Sequence[RisingWater] = ()

    def under(self, rising: Sequence[RisingWater]) -> CrackedDam:
        """Return the same dam with water that changes in its runs; springs know none."""
        changed = copy(self)
        changed._rising = rising
        return changed

    def still(self) -> AtRest | None:
        """Return the state before the earthquake; None where friction does not hold the dam."""
        found = self._dam.still()
        if found is None:
            return None
        slips, opened, above, below, *forces = found
        up, down = (force.reshape(2, -1) for force in forces)
        return AtRest(tuple(slips), tuple(opened), (above, below), (up, down))

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
        table, frames, upper, lower, force, status, above, below, *extremes, worked = self._dam.run(
            ground, step, theta, stride, stride > 0, stresses, penalty, ending, self._rising
        )
        names, rows = _kernel.CRACK_SUMMARY_FIELDS, table.tolist()
        summaries = tuple(dict(zip(names, row, strict=False)) for row in rows)
        of_cracks = frames.reshape(-1, self._cracks, len(_kernel.FRAME_FIELDS))
        all_frames = tuple(columns(_kernel.FRAME_FIELDS, of_cracks[:, k]) for k in range(self._cracks))
        return DamRun(
            summary=summaries[self._asked],
            tension=tuple(rows[0][len(names) :]),
            frames=all_frames[self._asked],
            summaries=summaries,
            all_frames=all_frames,
            upper=upper,
            lower=lower,
            force=force,
            status=status,
            modes=(above, below),
            extremes=tuple(columns(_kernel.EXTREME_FIELDS, each) for each in extremes if each.size),
            worked=columns(_kernel.WORKED_FIELDS, worked),
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
        """Shake it as :meth:`run_many_cracks` does; the numbers of the crack asked of."""
        found = self.run_many_cracks(ground, step, theta, scales, threads=threads, penalty=penalty, ending=ending)
        return found[self._asked]

    def run_many_cracks(
        self,
        ground: Floats,
        step: float,
        theta: float,
        scales: Floats,
        *,
        threads: int = 0,
        penalty: tuple[float, float, float] | None = None,
        ending: Ending | None = None,
    ) -> tuple[dict[str, Floats], ...]:
        """Shake it once for each pair of factors, (n, 2), on `threads` cores (0 for all); the numbers, (n,) by name, of
        each crack."""
        pairs = [(across, up) for across, up in scales.tolist()]
        rows = self._dam.run_many(ground, step, theta, pairs, threads, penalty, ending, self._rising)
        names = _kernel.CRACK_SUMMARY_FIELDS
        return tuple(columns(names, rows[k :: self._cracks, : len(names)]) for k in range(self._cracks))
