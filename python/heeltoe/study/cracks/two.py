"""Two rigid blocks in a study, run by run."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.kernel.block import MODES
from heeltoe.models.rigid.stack.model import check_stack, outcome_of_two, walk_two_blocks
from heeltoe.models.rigid.tables import with_openings
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.contract import headlines
from heeltoe.study.cracks.columns import OfCrack


class OfTwo(NamedTuple):
    """What a run of two blocks found: how it ended, the numbers of the kernel at each crack, from the crest down, how
    wide the cracks are [m], and which of them is asked of."""

    outcome: str
    cracks: tuple[Mapping[str, float], ...]
    widths: tuple[float, ...]
    asked: int


def run_two(
    cases: Sequence[Case], earthquakes: Sequence[Earthquake], factors: Sequence[float], threads: int
) -> list[OfTwo | None]:
    """Run two blocks for each of some cases, through its motion by a factor, on `threads` cores (0 for all); None of
    one that cannot be used."""

    def run(case: Case, earthquake: Earthquake, factor: float) -> OfTwo | None:
        try:
            return _run(case, earthquake, factor)
        except InputError:
            return None

    # The kernel lets go of the interpreter.
    with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        return list(pool.map(run, cases, earthquakes, factors))


def _run(case: Case, earthquake: Earthquake, factor: float) -> OfTwo:
    """Run two blocks, and where they still move at the end of the motion, on through silence."""
    check_stack(case)
    blocks, run = walk_two_blocks(case, earthquake.shaking.scaled(factor))
    moves = any(MODES[int(each.summary["final_mode"])] != "rest" for each in run.cracks)
    if moves and run.cracks[0].outcome == "ok" and case.analysis.silence:
        longer = earthquake.silent(case.analysis.silence).shaking
        blocks, run = walk_two_blocks(case, longer.scaled(factor))
    # The kernel counts from the ground up.
    cracks = tuple(each.summary for each in reversed(run.cracks))
    return OfTwo(outcome_of_two(case, run), cracks, tuple(block.width for block in blocks), case.asked)


def at_two_cracks(case: Case, found: Sequence[OfTwo]) -> tuple[OfCrack, list[OfCrack], dict[str, Floats]]:
    """Return the numbers of some runs of two blocks: at the crack asked of, at each from the crest down, and what the
    kernel says of the former."""

    def at(places: Sequence[int]) -> tuple[OfCrack, dict[str, Floats]]:
        of = [each.cracks[place] for each, place in zip(found, places, strict=True)]
        table = {name: np.array([row[name] for row in of]) for name in of[0]}
        width = np.array([each.widths[place] for each, place in zip(found, places, strict=True)])
        return OfCrack(with_openings(headlines(table), case, width), width), table

    asked, table = at([each.asked for each in found])
    return asked, [at([place] * len(found))[0] for place in range(len(case.cracks))], table
