"""A block whose drains close between the motions of a sequence: each motion finds the uplift that the slip has left."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Bools, Floats
from heeltoe.case.model import Case
from heeltoe.kernel.block import BlockRun
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, build_block
from heeltoe.mechanics.drains import close_by_slip, drainage_left, with_drainage
from heeltoe.result.outcome import Outcome

#: A block of a case, run through a motion, with the moments wanted and which of them are wanted whole, from where the
#: run before has left it.
Walk = Callable[[Case, Block, Shaking, Floats, "Bools | None", "BlockRun | None"], BlockRun]


def in_stages(case: Case, shaking: Shaking) -> bool:
    """Whether drains may close between the motions of a case."""
    return bool(shaking.begins) and close_by_slip(case)


def walk_in_stages(
    case: Case, block: Block, shaking: Shaking, moments: Floats, whole: Bools | None, walk: Walk
) -> tuple[BlockRun, list[float]]:
    """Run a block motion by motion, each from the state that the one before has left it in, with the uplift of the
    drains that are left; in one run where no drains close. Return how much of its drainage each motion met, too."""
    runs: list[BlockRun] = []
    shares: list[float] = []
    places = _wanted(shaking, moments)
    owns = np.split(moments, places)
    wholes = [None] * len(owns) if whole is None else np.split(whole, places)
    for part, own, own_whole in zip(_parts(shaking), owns, wholes, strict=True):
        share = drainage_left(case, runs[-1].summary.slip) if runs else 1.0
        shares.append(share)
        now = case if share == 1.0 else with_drainage(case, share)
        staged = block if now is case else build_block(now)
        runs.append(walk(now, staged, part, own, own_whole, runs[-1] if runs else None))
        if runs[-1].outcome != Outcome.OK:
            break
    if min(shares) == 1.0:
        return walk(case, block, shaking, moments, whole, None), shares
    return reduce(BlockRun.then, runs), shares


def start_of(before: BlockRun) -> tuple[list[list[float]], tuple[float, bool] | None]:
    """Return slip, gaps and their velocities at the end of a run, and what its crack has been through."""
    end = before.summary
    place = [end.slip, end.gap_heel, end.gap_toe]
    speed = [end.slip_velocity, end.gap_velocity_heel, end.gap_velocity_toe]
    return [place, speed], None if before.worn is None else (before.worn.end, before.worn.bonded_at_end)


@dataclass(frozen=True)
class _Cut:
    """Where motions after the first begin, among the moments of a shaking."""

    places: tuple[int, ...]

    @classmethod
    def of(cls, shaking: Shaking) -> _Cut:
        places = np.searchsorted(shaking.time, shaking.begins, side="left")
        return cls(tuple(sorted({int(place) for place in places if 0 < place < shaking.time.size - 1})))


def _parts(shaking: Shaking) -> Iterator[Shaking]:
    """Walk what shakes the block in each stage, from the moment at which a motion begins to that of the next."""
    places = _Cut.of(shaking).places
    for first, last in zip((0, *places), (*places, shaking.time.size - 1), strict=True):
        here = slice(first, last + 1)
        up, turning, cross = (
            None if component is None else component[here] for component in (shaking.up, shaking.turning, shaking.cross)
        )
        yield Shaking(shaking.time[here], shaking.horizontal[here], up, turning, cross)


def _wanted(shaking: Shaking, moments: Floats) -> NDArray[np.intp]:
    """Return where the requested moments of each stage but the first begin; those at the begin of a motion lie after
    the changes then."""
    places = list(_Cut.of(shaking).places)
    return np.searchsorted(moments, shaking.time[places], side="left")
