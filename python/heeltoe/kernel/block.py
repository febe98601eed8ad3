"""Rigid blocks, alone or two of them one on the other: their numbers, how they are run, what they did."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Bools, Floats, Integers
from heeltoe.kernel import _kernel
from heeltoe.kernel.friction import FrictionLaw
from heeltoe.kernel.shaking import Shaking

#: What runs return.
BlockRun = _kernel.BlockRun
BlockSummary = _kernel.BlockSummary
StackRun = _kernel.StackRun
#: Names of the numbers of a block, in the order of the kernels.
BLOCK = tuple(_kernel.BLOCK_FIELDS)
#: Names of the numbers of what changes as a block moves.
VARYING = tuple(_kernel.VARYING_FIELDS)
#: Names of the numbers of a rigid run.
SUMMARY = tuple(_kernel.SUMMARY_FIELDS)
#: Names of what many runs say of a crest: how far it moves [m], and its acceleration with the ground's [m/s2].
CREST = ("crest_displacement", "crest_acceleration")
#: Names that "mode", "kind" and "outcome" count.
MODES = tuple(_kernel.MODES)
EVENT_KINDS = tuple(_kernel.EVENT_KINDS)
OUTCOMES = tuple(_kernel.OUTCOMES)

#: Bounces slower than this times sqrt(g' B) end the bouncing, g' the effective weight per mass and B the width of the
#: crack: some 1e-6 m/s for a dam, whose further bounces would stay below 1e-13 m.
SETTLE = 1e-7


@dataclass(frozen=True, eq=False)
class Varying:
    """Properties that change as a block moves.

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
    """Limits that end bouncing and runs.

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
    across: tuple[float, float, float, float, float] | None = None,
    whole: Bools | None = None,
) -> BlockRun:
    """Run one block through one motion: exactly from event to event, or by integration where something varies.

    Parameters
    ----------
    block
        (22,) numbers in the order of :data:`BLOCK`.
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
    across
        Mass that moves across the valley [kg/m], how far the neighbours to the left and to the right are [m], and place
        and velocity that way at the first moment, where the ground shakes that way. Friction by a law and the uplift
        of an open crack alone vary then.
    whole
        (k,) at which of the moments all of the state is wanted, where at the others the place is enough.
    """
    time, horizontal, up = shaking.time, shaking.horizontal, shaking.up
    settle, most, jam = limits.settle, limits.event_limit, limits.jam
    cross = shaking.cross
    if varying is None and across is not None and cross is not None:
        return _kernel.run_rigid_plane(
            block, across, time, horizontal, up, cross, moments, start, settle, most, jam, whole
        )
    if varying is None:
        return _kernel.run_rigid(block, time, horizontal, up, moments, start, settle, most, jam, whole)
    return _kernel.run_rigid_varying(
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
        across,
        cross,
        whole,
    )


def run_blocks(
    blocks: Floats,
    shakings: Sequence[Shaking],
    which: Integers,
    scales: Floats,
    limits: Limits = USUAL,
    threads: int = 0,
    crest: tuple[Floats, Sequence[Floats], Floats] | None = None,
) -> dict[str, Floats]:
    """Run (n, 22) blocks, each through the motion that `which` names, times `scales` (n, 2), horizontal and vertical.

    `threads` of 0 means all cores; the numbers, (n,) by name, are the same bits for any number of them. Where `crest`
    says how far slip, heel gap and toe gap of each block move a crest (n, 3), at which moments of each motion it is
    looked at [s], and the weights of the filter of its acceleration, they are those of :data:`SUMMARY` and of
    :data:`CREST`.
    """
    motions = [(shaking.time, shaking.horizontal, shaking.up) for shaking in shakings]
    settle, most, jam = limits.settle, limits.event_limit, limits.jam
    looked_at = () if crest is None else (crest,)
    return _kernel.run_rigid_many(blocks, motions, which, scales, settle, most, jam, threads, *looked_at)


def run_stack(
    blocks: tuple[Floats, Floats],
    place: Floats,
    shaking: Shaking,
    moments: Floats,
    limits: Limits = USUAL,
    *,
    whole: Bools | None = None,
) -> StackRun:
    """Run two blocks, exactly from event to event.

    Parameters
    ----------
    blocks
        (22,) numbers in the order of :data:`BLOCK`: all above the lower crack as one block, and
        what is above the upper one.
    place
        (3,) where the upper block is, see :func:`heeltoe.models.rigid.stack.place_of`.
    shaking, moments, limits, whole
        As of :func:`run_block`.
    """
    time, horizontal, up = shaking.time, shaking.horizontal, shaking.up
    settle, most, jam = limits.settle, limits.event_limit, limits.jam
    return _kernel.run_rigid_stack(*blocks, place, time, horizontal, up, moments, settle, most, jam, whole)
