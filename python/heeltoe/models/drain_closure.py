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

from heeltoe.base.arrays import Floats
from heeltoe.case.combinations import warned
from heeltoe.case.model import Case
from heeltoe.mechanics.drains import close_by_slip, drainage_left
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import Part
from heeltoe.result.numbers import ElasticDam
from heeltoe.result.outcome import Outcome

if TYPE_CHECKING:
    from heeltoe.kernel.dam import DamRun
    from heeltoe.models.flexible.model import Rested
    from heeltoe.models.flexible.result.response import FlexibleResponse
    from heeltoe.models.flexible.run.dam_runner import ShakenDam

#: Between which moments the drainage changes [s], and what is left of it then.
Drainage = tuple[tuple[float, float, float], ...]

# Water that rises faster than this shakes the dam by itself [s].
_FASTEST = 1.0


def follows_drains(case: Case, earthquake: Earthquake) -> bool:
    """Whether drains may close in a run of an elastic dam, and its uplift can change then."""
    closing = "drains that slip closes"
    return bool(earthquake.shaking.begins) and close_by_slip(case) and not warned(case, closing, "flexible")


def drained(case: Case, earthquake: Earthquake, run: Callable[[Earthquake], Rested]) -> tuple[Rested, list[float]]:
    """Run a dam until each motion of its sequence meets the uplift of the drains that the ones before have left.

    Parameters
    ----------
    case, earthquake
        Of both of which :func:`follows_drains` holds.
    run
        Runs the dam until it is at rest.

    Returns
    -------
    rested : Rested
        The last run; its earthquake has the drainage.
    shares : list of float
        How much of the drainage each motion finds.
    """
    parts = earthquake.motion.parts
    runs: list[Rested] = []

    def slips(drainage: Drainage) -> list[float]:
        runs.append(run(replace(earthquake, drainage=drainage)))
        return _left(runs[-1].run, parts) if runs[-1].outcome != Outcome.UNSTABLE else []

    shares = _left_by_motion(case, parts, slips)
    return runs[-1], shares


def with_shares(response: FlexibleResponse, shares: list[float]) -> FlexibleResponse:
    """Return the response with how much of the drainage each motion finds."""
    assert isinstance(response.dam, ElasticDam)
    return replace(response, dam=replace(response.dam, drainage_by_motion=shares))


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

    # Here, as blocks run without what an elastic dam needs.
    from heeltoe.models.flexible.run.expected import frame_step_of

    def under(drainage: Drainage) -> ShakenDam:
        return replace(shaken, shaking=replace(shaken.shaking, drainage=drainage))

    def run(factor: float) -> dict[str, Floats]:
        def slips(drainage: Drainage) -> list[float]:
            return _left(under(drainage).run(step, frame_step_of(shaken.shaking.end, None), factor=factor), parts)

        shares = _left_by_motion(shaken.case, parts, slips)
        return under(schedule(parts, shares)).run_scaled(step, np.array([factor]), threads=1)

    # The kernel lets go of the interpreter.
    with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        rows = list(pool.map(run, scales.tolist()))
    return {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}


def _left(run: DamRun, parts: Sequence[Part]) -> list[float]:
    """Return where each motion of a sequence leaves the dam to the next [m], as far as the run goes."""
    time, slip = run.frames.time, run.frames.slip
    begins = [part.begins for part in parts[1:] if part.begins <= run.summary.end_time]
    return [float(slip[time <= moment][-1]) for moment in begins]


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
    """Return the intervals in which the drainage changes [s] and the shares left, from that which each motion meets."""
    met = zip(pairwise(parts), pairwise(shares), strict=False)
    return tuple(
        (min(first.ends, then.begins - _FASTEST), then.begins, share)
        for (first, then), (before, share) in met
        if share != before
    )
