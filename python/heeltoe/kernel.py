"""The one door to the compiled kernels: what they take and what they return, by name. SI units, per metre of dam."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.arrays import Floats, Integers

if TYPE_CHECKING:
    from heeltoe._kernel import CrackAnchor, FollowingWater, ReducedBody

VERSION = _kernel.VERSION
#: "release" or "debug".
PROFILE = _kernel.PROFILE

#: Names of the numbers of a block, in the order of the kernels.
BLOCK = tuple(_kernel.BLOCK_FIELDS)
#: Names of the numbers of what changes as a block moves.
VARYING = tuple(_kernel.VARYING_FIELDS)
#: Names of the numbers of a rigid run.
SUMMARY = tuple(_kernel.SUMMARY_FIELDS)
#: Names that "mode", "kind" and "outcome" count.
MODES = tuple(_kernel.MODES)
EVENT_KINDS = tuple(_kernel.EVENT_KINDS)
OUTCOMES = tuple(_kernel.OUTCOMES)
#: The same of an elastic dam, and what the nodes of its crack do.
DAM_STATES = tuple(_kernel.CRACK_STATES)
DAM_OUTCOMES = tuple(_kernel.CRACK_OUTCOMES)
CONTACT_STATUSES = tuple(_kernel.CONTACT_STATUSES)

#: Bounces slower than this times sqrt(g' B) end the bouncing, g' the effective weight per mass and B the width of the
#: crack: some 1e-6 m/s for a dam, whose further bounces would stay below 1e-13 m.
SETTLE = 1e-7


@dataclass(frozen=True, eq=False)
class Shaking:
    """What a kernel gets of the ground's motion: (n,) each, or None where there is none.

    Attributes
    ----------
    time
        Moments from zero to the end of the run [s], not decreasing; at a jump the moment is there twice.
    horizontal, up
        Accelerations downstream and upward [m/s2], straight between the moments.
    turning
        Rotational acceleration about the middle of the crack, counter-clockwise [rad/s2].
    """

    time: Floats
    horizontal: Floats
    up: Floats | None = None
    turning: Floats | None = None

    @property
    def end(self) -> float:
        """Of the run [s]."""
        return float(self.time[-1])

    def scaled(self, factor: float) -> Shaking:
        """Return the same motion, weaker or stronger."""
        up, turning = (None if each is None else factor * each for each in (self.up, self.turning))
        return Shaking(self.time, factor * self.horizontal, up, turning)


@dataclass(frozen=True, eq=False)
class Varying:
    """What changes as a block moves.

    Attributes
    ----------
    numbers
        (21,) in the order of :data:`VARYING`.
    rotation, law
        ``analysis.rotation`` and ``uplift.during_shaking`` of the case.
    pressure
        (k, 2) distance from the heel [m], pressure in the closed crack [Pa].
    anchors
        (n, 6) distance, axis along and across the crack, prestress, axial and shear stiffness.
    """

    numbers: Floats
    rotation: str
    law: str
    pressure: Floats
    anchors: Floats


@dataclass(frozen=True)
class Limits:
    """What ends bouncing and runs.

    Attributes
    ----------
    event_limit
        Most events of one run.
    jam
        Resolve a Painlevé paradox by a tangential impact instead of stopping there.
    settle
        See :data:`SETTLE`.
    """

    event_limit: int = 1_000_000
    jam: bool = False
    settle: float = SETTLE


USUAL = Limits()


@dataclass(frozen=True, eq=False)
class BlockRun:
    """What a block did.

    Attributes
    ----------
    summary
        Numbers by name.
    histories
        Columns by name, at the moments that were asked for, fewer where the run stopped early.
    mode
        At the same moments, counting :data:`MODES`.
    events
        Columns by name; kinds and modes count :data:`EVENT_KINDS` and :data:`MODES`.
    tension
        (n,) largest tension of each anchor of what varies [N/m]; None where the walk was exact and nothing does.
    """

    summary: Mapping[str, float]
    histories: Mapping[str, Floats]
    mode: NDArray[np.uint8]
    events: Mapping[str, Floats]
    tension: Floats | None

    @classmethod
    def of(
        cls, row: Floats, histories: Floats, mode: NDArray[np.uint8], events: Floats, tension: Floats | None = None
    ) -> BlockRun:
        """Put the names on what a kernel returns."""
        return cls(
            summary=dict(zip(SUMMARY, row.tolist(), strict=True)),
            histories=_columns(_kernel.HISTORY_FIELDS, histories),
            mode=mode,
            events=_columns(_kernel.EVENT_FIELDS, events),
            tension=tension,
        )

    @property
    def exact(self) -> bool:
        """Whether there were closed forms from event to event, or the walk was integrated."""
        return self.tension is None

    @property
    def outcome(self) -> str:
        """By name."""
        return OUTCOMES[int(self.summary["outcome"])]

    @property
    def final_mode(self) -> str:
        """By name."""
        return MODES[int(self.summary["final_mode"])]

    def times_of(self, *kinds: str) -> list[float]:
        """Return the moments of all events of some kinds [s]."""
        wanted = [EVENT_KINDS.index(kind) for kind in kinds]
        found: list[float] = self.events["time"][np.isin(self.events["kind"], wanted)].tolist()
        return found


def block(values: Mapping[str, float]) -> Floats:
    """Return a block's numbers, those not given zero, as the kernels take them.

    Raises
    ------
    KeyError
        Where a name is none of :data:`BLOCK`.
    """
    unknown = set(values) - set(BLOCK)
    if unknown:
        raise KeyError(f"no such number of a block: {unknown}")
    return np.array([values.get(name, 0.0) for name in BLOCK], dtype=np.float64)


def run_block(
    block: Floats,
    shaking: Shaking,
    moments: Floats,
    limits: Limits = USUAL,
    *,
    start: Sequence[Sequence[float]] | None = None,
    varying: Varying | None = None,
) -> BlockRun:
    """Run one block through one motion: exactly from event to event, or by integration where something varies.

    Parameters
    ----------
    block
        (21,) numbers in the order of :data:`BLOCK`.
    shaking
        The ground's motion; a rotation of the ground is felt by integration alone.
    moments
        (k,) ascending, at which the state is wanted [s]; at an event the state after it.
    limits
        When to stop.
    start
        (slip, heel gap, toe gap) [m] and their velocities [m/s] at the first moment. Without it the block stands still,
        and must be able to under its static loads.
    varying
        What changes as it moves, where anything does.
    """
    time, horizontal, up = shaking.time, shaking.horizontal, shaking.up
    settle, most, jam = limits.settle, limits.event_limit, limits.jam
    if varying is None:
        return BlockRun.of(*_kernel.run_rigid(block, time, horizontal, up, moments, start, settle, most, jam))
    found = _kernel.run_rigid_varying(
        block,
        varying.numbers,
        varying.rotation,
        varying.law,
        varying.pressure,
        varying.anchors,
        time,
        horizontal,
        up,
        shaking.turning,
        moments,
        start,
        settle,
        most,
        jam,
    )
    return BlockRun.of(*found)


def run_blocks(
    blocks: Floats,
    shakings: Sequence[Shaking],
    which: Integers,
    scales: Floats,
    limits: Limits = USUAL,
    threads: int = 0,
) -> dict[str, Floats]:
    """Run (n, 21) blocks, each through the motion that `which` names, times `scales` (n, 2), horizontal and vertical.

    `threads` of 0 means all cores; the numbers, (n,) by name, are the same bits for any number of them.
    """
    motions = [(each.time, each.horizontal, each.up) for each in shakings]
    settle, most, jam = limits.settle, limits.event_limit, limits.jam
    return _columns(SUMMARY, _kernel.run_rigid_many(blocks, motions, which, scales, settle, most, jam, threads))


def spectrum(time: Floats, ground: Floats, periods: Floats, damping: float) -> tuple[Floats, Floats]:
    """Return largest relative displacement [m] and total acceleration [m/s2] of oscillators, (k,) each.

    `periods` (k,) in s, zero for the ground itself; `damping` in [0, 1). Exact for ground accelerations (n,) that are
    linear between the moments `time` (n,).
    """
    displacement, total = np.ascontiguousarray(_kernel.spectrum(time, ground, periods, damping).T)
    return displacement, total


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
    """

    summary: Mapping[str, float]
    tension: tuple[float, ...]
    frames: Mapping[str, Floats]
    upper: Floats
    lower: Floats
    force: Floats
    status: NDArray[np.uint8]
    modes: tuple[Floats, Floats]

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
        scale: tuple[float, float] = (1.0, 1.0),
        penalty: tuple[float, float, float] | None = None,
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
        scale
            Factors on the horizontal and the vertical ground.
        penalty
            Stiffness of the springs [N/m] and Newmark's gamma and beta.
        """
        row, frames, upper, lower, force, status, above, below = self._dam.run(
            ground, step, theta, stride, stride > 0, scale, penalty
        )
        names, numbers = _kernel.CRACK_SUMMARY_FIELDS, row.tolist()
        return DamRun(
            summary=dict(zip(names, numbers, strict=False)),
            tension=tuple(numbers[len(names) :]),
            frames=_columns(_kernel.FRAME_FIELDS, frames),
            upper=upper,
            lower=lower,
            force=force,
            status=status,
            modes=(above, below),
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
    ) -> dict[str, Floats]:
        """Shake it once for each pair of factors, (n, 2), on `threads` cores (0 for all); the numbers, (n,) by name."""
        pairs = [(across, up) for across, up in scales.tolist()]
        rows = self._dam.run_many(ground, step, theta, pairs, threads, penalty)
        return _columns(_kernel.CRACK_SUMMARY_FIELDS, rows[:, : len(_kernel.CRACK_SUMMARY_FIELDS)])


def _columns(names: Sequence[str], table: Floats) -> dict[str, Floats]:
    # A table that was not asked for has no columns either.
    columns = table.reshape(-1, len(names)).T
    return {name: np.ascontiguousarray(column) for name, column in zip(names, columns, strict=True)}
