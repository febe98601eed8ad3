"""A block whose drains close between the motions of a sequence: each motion finds the uplift that the slip has left."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.kernel.block import BlockRun, Roughness, Worn
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, build_block
from heeltoe.mechanics.drains import close_by_slip, drainage_left, with_drainage

#: A block of a case, run through a motion, with the moments wanted, from where the run before has left it.
Walk = Callable[[Case, Block, Shaking, Floats, "BlockRun | None"], BlockRun]

_COORDINATES = ("slip", "gap_heel", "gap_toe")
_VELOCITIES = ("slip_velocity", "gap_velocity_heel", "gap_velocity_toe")
# How two runs, one after the other, make up one; what is not here is that of the later one. Of two residuals of the
# books, each relative to the size of its entries, the larger bounds that of both together.
_LEAST = ("slip_min", "rotation_min")
_LARGEST = (
    "slip_max",
    "rotation_max",
    "largest_gap_heel",
    "largest_gap_toe",
    "largest_impact_velocity",
    "energy_residual",
)
_SUMS = (
    *(f"slip_{mode}" for mode in ("sliding", "slide_rocking", "drifting")),
    *(f"time_{mode}" for mode in ("rest", "sliding", "rocking", "slide_rocking", "drifting")),
    *("impacts", "events", "energy_limited_impacts", "jams", "slip_stops"),
    *("energy_input", "energy_friction", "energy_impact"),
)


def in_stages(case: Case, shaking: Shaking) -> bool:
    """Whether drains may close between the motions of what shakes a case."""
    return bool(shaking.begins) and close_by_slip(case)


def walk_in_stages(case: Case, block: Block, shaking: Shaking, moments: Floats, walk: Walk) -> BlockRun:
    """Run a block motion by motion, each from the state that the one before has left it in, with the uplift of the
    drains that are left; in one run where no drains close."""
    runs: list[BlockRun] = []
    shares: list[float] = []
    for part, own in zip(_parts(shaking), _wanted(shaking, moments), strict=True):
        share = drainage_left(case, runs[-1].summary["slip"]) if runs else 1.0
        shares.append(share)
        now = case if share == 1.0 else with_drainage(case, share)
        runs.append(walk(now, block if now is case else build_block(now), part, own, runs[-1] if runs else None))
        if runs[-1].outcome != "ok":
            break
    if min(shares) == 1.0:
        return replace(walk(case, block, shaking, moments, None), drainage=tuple(shares))
    return replace(reduce(_joined, runs), drainage=tuple(shares))


def start_of(before: BlockRun) -> tuple[list[list[float]], tuple[float, bool] | None]:
    """Return slip, gaps and their velocities at the end of a run, and what its crack has been through."""
    state = [[before.summary[name] for name in names] for names in (_COORDINATES, _VELOCITIES)]
    return state, None if before.worn is None else (before.worn.end, before.worn.bonded_at_end)


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
        up, turning = (None if each is None else each[here] for each in (shaking.up, shaking.turning))
        yield Shaking(shaking.time[here], shaking.horizontal[here], up, turning)


def _wanted(shaking: Shaking, moments: Floats) -> Sequence[Floats]:
    """Return the moments that are wanted of each stage; where one motion begins, after what changes then."""
    places = list(_Cut.of(shaking).places)
    return np.split(moments, np.searchsorted(moments, shaking.time[places], side="left"))


def _joined(first: BlockRun, then: BlockRun) -> BlockRun:
    """Return two runs, one after the other, as one."""
    summary = dict(then.summary)
    summary |= {name: min(first.summary[name], then.summary[name]) for name in _LEAST}
    summary |= {name: max(first.summary[name], then.summary[name]) for name in _LARGEST}
    summary |= {name: first.summary[name] + then.summary[name] for name in _SUMS}
    tension = None if then.tension is None or first.tension is None else np.maximum(first.tension, then.tension)
    return BlockRun(
        summary=summary,
        histories=_behind(first.histories, then.histories),
        mode=np.concatenate([first.mode, then.mode]),
        events=_behind(first.events, then.events),
        tension=tension,
        worn=None if first.worn is None or then.worn is None else _worn(first.worn, then.worn),
        rough=None if first.rough is None or then.rough is None else _rough(first.rough, then.rough),
    )


def _behind(first: Mapping[str, Floats], then: Mapping[str, Floats]) -> dict[str, Floats]:
    return {name: np.concatenate([values, then[name]]) for name, values in first.items()}


def _worn(first: Worn, then: Worn) -> Worn:
    return replace(
        then,
        path=np.concatenate([first.path, then.path]),
        bonded=np.concatenate([first.bonded, then.bonded]),
        error=first.error + then.error,
        integrated=first.integrated + then.integrated,
    )


def _rough(first: Roughness, then: Roughness) -> Roughness:
    return replace(then, kept=np.concatenate([first.kept, then.kept]), highest=max(first.highest, then.highest))
