"""The way of a block from the case to the kernel, and which walk it is."""

from __future__ import annotations

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.kernel.block import BlockRun, Limits, run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block
from heeltoe.models.rigid.varying import varies, varying


def limits_of(case: Case) -> Limits:
    """Return when the runs of a case stop."""
    analysis = case.analysis
    return Limits(analysis.event_limit, analysis.paradox == "tangential impact", silence=analysis.silence)


def walk(case: Case, block: Block, shaking: Shaking, moments: Floats | None = None) -> BlockRun:
    """Run the block of a case as the case asks: exactly, or by integration where something varies.

    `moments` are those of the histories [s]; none without them.
    """
    wanted, limits = np.empty(0) if moments is None else moments, limits_of(case)
    what = varying(case, block) if varies(case) or shaking.turning is not None else None
    return run_block(block.parameters(), shaking, wanted, limits, varying=what)
