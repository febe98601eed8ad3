"""An elastic dam whose drains close between the motions of a sequence: it is run again with the uplift that its slip
has left, which changes while the ground stands still."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.crack.kinks import climbs
from heeltoe.case.model import Case
from heeltoe.mechanics.drains import close_by_slip, drainage_left
from heeltoe.models.flexible.expected import frame_step_of
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import Part
from heeltoe.result.sequence import stages

if TYPE_CHECKING:
    from heeltoe.models.flexible.response import FlexibleResponse
    from heeltoe.models.flexible.shaken import ShakenDam

#: Between which moments the drainage changes [s], and what is left of it then.
Drainage = tuple[tuple[float, float, float], ...]

# Water that rises faster than this shakes the dam by itself [s].
_FASTEST = 1.0


def follows_drains(case: Case, earthquake: Earthquake) -> bool:
    """Whether drains may close in a run of an elastic dam, and its uplift can change then."""
    there = bool(earthquake.shaking.begins) and close_by_slip(case) and not case.further_cracks
    # On steps the water that rises pushes along the crack, too, which the kernel does not know.
    there = there and not climbs(case.crack.kinks)
    return there and case.uplift.during_shaking == "constant" and case.flexible.contact == "coulomb"


def with_drains(
    case: Case, earthquake: Earthquake, run: Callable[[Case, Earthquake], FlexibleResponse]
) -> FlexibleResponse:
    """Run a dam until each motion of its sequence meets the uplift of the drains that the ones before have left; with
    evidence the last time alone."""
    quick = case.model_copy(update={"flexible": case.flexible.with_evidence("none")})
    parts, runs = earthquake.motion.parts, []

    def slips(drainage: Drainage) -> list[float]:
        runs.append(run(quick, replace(earthquake, drainage=drainage)))
        left = list(stages(runs[-1], parts)) if runs[-1].summary else []
        # Of the last motion that it meets there is none after it.
        return [each.residual_slip_m for each in left[:-1]]

    shares = _left_by_motion(case, parts, slips)
    found = runs[-1]
    if case.flexible.evidence != "none":
        found = run(case, replace(earthquake, drainage=schedule(parts, shares)))
    return replace(found, summary={**found.summary, "drainage_by_motion": shares}) if found.summary else found


def run_drained(
    shaken: ShakenDam, parts: Sequence[Part], step: float, scales: Floats, threads: int = 0
) -> dict[str, Floats]:
    """Run a dam through a sequence for each factor on its motions, each with the drains that its own slips leave.

    Parameters
    ----------
    shaken
        The dam with its earthquake, of both of which :func:`follows_drains` holds.
    parts
        The motions of the sequence.
    step
        Time step [s].
    scales
        (n,) factors.
    threads
        On how many cores, 0 for all.

    Returns
    -------
    dict
        (n,) arrays by name, as :meth:`ShakenDam.run_scaled` returns them.
    """

    def under(drainage: Drainage) -> ShakenDam:
        return replace(shaken, shaking=replace(shaken.shaking, drainage=drainage))

    def run(factor: float) -> dict[str, Floats]:
        def slips(drainage: Drainage) -> list[float]:
            found = under(drainage).run(step, frame_step_of(shaken.shaking.end, None), factor=factor)
            time, slip = found.frames["time"], found.frames["slip"]
            begins = [part.begins for part in parts[1:] if part.begins <= found.summary["end_time"]]
            return [float(slip[time <= each][-1]) for each in begins]

        shares = _left_by_motion(shaken.case, parts, slips)
        return under(schedule(parts, shares)).run_scaled(step, np.array([factor]), threads=1)

    # The kernel lets go of the interpreter.
    with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        rows = list(pool.map(run, scales.tolist()))
    return {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}


def _left_by_motion(case: Case, parts: Sequence[Part], slips: Callable[[Drainage], list[float]]) -> list[float]:
    """Return how much of the drainage each motion finds, as far as a run goes; `slips` runs the dam with some drainage
    and returns where each motion leaves it to the next [m]."""
    shares, left = [1.0], slips(())
    for number in range(1, len(parts)):
        if len(left) < number:
            # It has ended before.
            break
        share = drainage_left(case, left[number - 1])
        shares.append(share)
        if share != shares[-2]:
            left = slips(schedule(parts, shares))
    return shares


def schedule(parts: Sequence[Part], shares: Sequence[float]) -> Drainage:
    """Return from when to when the drainage changes [s] and what is left of it then, from what each motion finds."""
    met = zip(pairwise(parts), pairwise(shares), strict=False)
    return tuple(
        (min(first.ends, then.begins - _FASTEST), then.begins, share)
        for (first, then), (before, share) in met
        if share != before
    )
