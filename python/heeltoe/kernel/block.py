"""A rigid block: its numbers, how it is run, what it did."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.arrays import Floats, Integers
from heeltoe.kernel.columns import columns
from heeltoe.kernel.friction import FrictionLaw
from heeltoe.kernel.shaking import Shaking

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

#: Bounces slower than this times sqrt(g' B) end the bouncing, g' the effective weight per mass and B the width of the
#: crack: some 1e-6 m/s for a dam, whose further bounces would stay below 1e-13 m.
SETTLE = 1e-7


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
    friction
        Law of the crack, in place of the coefficients of the block.
    asperities
        Height and wave length [m] and wear [m2/J] of those of a rough crack, on whose flanks `friction` acts.
    dilated
        How far it has dilated [m] and the plastic work that has worn it [J/m2], where it is not new.
    """

    numbers: Floats
    rotation: str
    law: str
    pressure: Floats
    anchors: Floats
    friction: FrictionLaw | None = None
    asperities: Floats | None = None
    dilated: tuple[float, float] | None = None


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
    silence
        How long :func:`heeltoe.rigid_many` goes on after the motion until a block is at rest [s]; a kernel's run ends
        with its motion.
    """

    event_limit: int = 1_000_000
    jam: bool = False
    settle: float = SETTLE
    silence: float = 10.0


USUAL = Limits()


@dataclass(frozen=True, eq=False)
class Worn:
    """What a crack whose friction goes by a law has been through.

    Attributes
    ----------
    path, bonded
        At the moments that were asked for: how far it has slipped, to and fro [m], and 1 while its bond is whole.
    end, bonded_at_end
        The same when the run ended.
    error
        Sum of the errors estimated of all steps of the integration, and of what those in the velocity come to [m].
    integrated
        Time that these steps took; all else of the run is exact [s].
    """

    path: Floats
    bonded: Floats
    end: float
    bonded_at_end: bool
    error: float
    integrated: float


@dataclass(frozen=True, eq=False)
class Roughness:
    """What the asperities of a rough crack have been through.

    Attributes
    ----------
    kept
        (k, 3) at the moments that were asked for: how high the flank is on which the block is, or above which it flies,
        over the valley in which it stood at first [m], angle of the flanks [rad], plastic work per area [J/m2].
    end
        The same three when the run ended.
    highest
        Largest dilation with a corner in contact [m].
    """

    kept: Floats
    end: Sequence[float]
    highest: float


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
    worn
        What the crack has been through, where its friction goes by a law.
    drainage
        How much of its drainage each motion of a sequence has found, where slip closes the drains.
    rough
        What its asperities have been through, where it is rough.
    """

    summary: Mapping[str, float]
    histories: Mapping[str, Floats]
    mode: NDArray[np.uint8]
    events: Mapping[str, Floats]
    tension: Floats | None
    worn: Worn | None = None
    drainage: tuple[float, ...] = ()
    rough: Roughness | None = None

    @classmethod
    def of(
        cls,
        row: Floats,
        histories: Floats,
        mode: NDArray[np.uint8],
        events: Floats,
        tension: Floats | None = None,
        worn: tuple[Floats, float, bool, float, float] | None = None,
        rough: tuple[Floats, Sequence[float], float] | None = None,
    ) -> BlockRun:
        """Put the names on what a kernel returns."""
        return cls(
            summary=dict(zip(SUMMARY, row.tolist(), strict=True)),
            histories=columns(_kernel.HISTORY_FIELDS, histories),
            mode=mode,
            events=columns(_kernel.EVENT_FIELDS, events),
            tension=tension,
            worn=None if worn is None else Worn(worn[0][:, 0], worn[0][:, 1], *worn[1:]),
            rough=None if rough is None else Roughness(rough[0], rough[1], rough[2]),
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
    worn: tuple[float, bool] | None = None,
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
    worn
        How far a crack whose friction goes by a law has slipped [m] and whether its bond is whole, where it is not new.
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
        varying.friction,
        varying.asperities,
        time,
        horizontal,
        up,
        shaking.turning,
        moments,
        start,
        worn,
        varying.dilated,
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
    return columns(SUMMARY, _kernel.run_rigid_many(blocks, motions, which, scales, settle, most, jam, threads))
