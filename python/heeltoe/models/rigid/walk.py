"""The way of a block from the case to the kernel, and which walk it is."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from heeltoe.base.arrays import Bools, Floats
from heeltoe.case.model import Case
from heeltoe.kernel.block import BlockRun, Limits, run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.anchors import anchors_hold
from heeltoe.mechanics.block import Block, instability
from heeltoe.models.rigid.bond import bonded_block
from heeltoe.models.rigid.stages import in_stages, start_of, walk_in_stages
from heeltoe.models.rigid.varying import varies, varying


def limits_of(case: Case) -> Limits:
    """Return when the runs of a case stop."""
    analysis = case.analysis
    return Limits(analysis.event_limit, analysis.paradox == "tangential impact", silence=analysis.silence)


def walk(
    case: Case,
    block: Block,
    shaking: Shaking,
    moments: Floats | None = None,
    limits: Limits | None = None,
    whole: Bools | None = None,
) -> BlockRun:
    """Run a block as :func:`walk_with_drainage` does; return the run alone."""
    return walk_with_drainage(case, block, shaking, moments, limits, whole=whole)[0]


def across_of(case: Case, block: Block, before: BlockRun | None) -> tuple[float, float, float, float, float]:
    """Return what moves across the valley: its mass, the gaps on either side, and where the run before has left it."""
    left, right = case.crack.side_gap or (math.inf, math.inf)
    there = None if before is None or before.crossing is None else before.crossing.summary
    place, speed = (0.0, 0.0) if there is None else (there.slip, there.slip_velocity)
    return block.concrete_mass, left, right, place, speed


def _loose(block: Block) -> list[list[float]] | None:
    """Return the place and the velocity that a block moves off from which anchors alone will hold; None of one that
    stands, or that nothing holds, as the walk finds out by itself."""
    return [[0.0] * 3, [0.0] * 3] if instability(block) is not None and anchors_hold(block) else None


def walk_with_drainage(
    case: Case,
    block: Block,
    shaking: Shaking,
    moments: Floats | None = None,
    limits: Limits | None = None,
    *,
    whole: Bools | None = None,
) -> tuple[BlockRun, list[float]]:
    """Run the block of a case as the case asks: exactly, or by integration where something varies; motion by motion
    where slip closes drains between those of a sequence.

    `moments` are those of the histories [s], none without them, or those of them that are `whole`: at the others the
    place alone is kept, see :func:`heeltoe.kernel.block.run_block`. `limits` stand in place of those of the case.
    Return how much of its drainage each motion of a sequence met, too; empty where no drains close.
    """
    wanted = np.empty(0) if moments is None else moments
    ends = limits or limits_of(case)
    bonded = bonded_block(block, shaking)
    holds = bonded is not None and bonded.holds
    if bonded is not None:
        block, shaking = bonded.block, bonded.shaking

    def run(
        now: Case, block: Block, shaking: Shaking, moments: Floats, whole: Bools | None, before: BlockRun | None
    ) -> BlockRun:
        # Nothing varies below a block that does not move.
        what = varying(now, block) if not holds and (varies(now) or shaking.turning is not None) else None
        across = None if shaking.cross is None else across_of(now, block, before)
        start, worn = (_loose(block), None) if before is None else start_of(before)
        if what is not None and before is not None and before.rough is not None:
            dilation, _, work = before.rough.end
            what = replace(what, dilated=(dilation, work))
        numbers = block.parameters()
        return run_block(
            numbers, shaking, moments, ends, start=start, varying=what, worn=worn, across=across, whole=whole
        )

    if in_stages(case, shaking):
        return walk_in_stages(case, block, shaking, wanted, whole, run)
    return run(case, block, shaking, wanted, whole, None), []
