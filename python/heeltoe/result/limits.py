"""Comparison of a result with the user's limits."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from heeltoe.result.contract import CRACKED, WIDTH
from heeltoe.result.crest import CREST_PEAKS, crest_peaks
from heeltoe.result.distribution import judged_size, share_above
from heeltoe.result.judge import CREST_LIMITS, LIMITS, Judgement, LimitCheck, judge
from heeltoe.result.numbers import HeadlineWorth
from heeltoe.result.record import CrackResponse, ResponseData
from heeltoe.units.parse import Acceleration

if TYPE_CHECKING:
    from heeltoe.case.options import Limits

# Standard error of the 84 % fractile of a normal sample, over that of its mean: sqrt(p (1 - p)) over the density there.
_ERROR_OF_FRACTILE = 1.5

#: The numbers of a crack by which a response is judged.
_KEYS = (WIDTH, *sorted({key for limit in LIMITS.values() for key in limit.keys} - {*CREST_PEAKS, CRACKED}))


def allowances(limits: Limits, gravity: float) -> dict[str, float]:
    """Return the allowed values by name: lengths in m, rotations in rad, accelerations in g of `gravity` [m/s2]."""
    return {
        name: value.si(gravity) / gravity if isinstance(value, Acceleration) else float(value)
        for name, value in limits
        if value is not None
    }


def judge_response(limits: Limits, response: ResponseData) -> Judgement:
    """Return the judgement of a response, one row."""
    cracks = [crack.of_crack for crack in response.cracks]
    columns = dict[str, list[list[float]]]()
    for key in _KEYS:
        columns[key] = [[math.nan if numbers is None else getattr(numbers, key) for numbers in cracks]]
    if any(_bonded(crack) for crack in response.cracks):
        columns[CRACKED] = [[_cracked(crack) for crack in response.cracks]]
    if response.crest is not None or not response.started:
        columns |= {key: [[value]] for key, value in crest_peaks(response.crest).items()}
    judged = judge({"outcome": [response.outcome], **columns}, allowances(limits, response.gravity))
    scatter = {name: [_scatter(name, crack) for crack in response.cracks] for name in judged.limits}
    for name, samples in scatter.items():
        if any(samples):
            sizes = judged.size(name)[0].tolist()
            columns[name] = [[judged_size(runs) if runs else size for runs, size in zip(samples, sizes, strict=True)]]
    if not any(map(any, scatter.values())):
        return judged
    return judge({"outcome": [response.outcome], **columns}, judged.limits)


def check_limits(limits: Limits, response: ResponseData, judgement: Judgement | None = None) -> tuple[LimitCheck, ...]:
    """Compare the numbers of a response with the limits that the user has set.

    They are the numbers to trust: where the runs of an elastic dam scatter, those that 84 % of them keep to. Nothing is
    compared where the run does not say; of a dam that has failed no limit is met. `judgement` is that of the response,
    where it is known.
    """
    judgement = judgement or judge_response(limits, response)
    if not (judgement.has_result[0] or judgement.failed[0]):
        return ()
    # One run says where the crest goes: where runs scatter, nothing bounds its error.
    one_run = float(any(_of_many(crack) for crack in response.cracks))
    checks = []
    for name in judgement.not_met:
        sizes = judgement.size(name)[0].tolist()
        # Any of several cracks may break a limit; each bonded joint is judged by itself.
        joints = [place for place, crack in enumerate(response.cracks) if _bonded(crack)]
        for place in joints if name == "cracked_length" else [sizes.index(max(sizes))]:
            known = not math.isnan(sizes[place])
            of_crack = known and name not in CREST_LIMITS
            runs = _scatter(name, response.cracks[place]) if of_crack else []
            checks.append(
                LimitCheck(
                    name=name,
                    value=sizes[place] if known else None,
                    allowed=judgement.limits[name],
                    failed=bool(judgement.failed[0]),
                    uncertainty=_uncertainty(name, response.cracks[place])
                    if of_crack
                    else (one_run * sizes[place] if known else 0.0),
                    elevation_m=response.cracks[place].elevation if response.several and of_crack else None,
                    exceeding=share_above(runs, judgement.limits[name]) if runs else None,
                )
            )
    return tuple(checks)


def _of_many(crack: CrackResponse) -> bool:
    """Whether the numbers of a crack are means of runs with the shaking varied."""
    evidence = None if crack.numbers is None else crack.numbers.get("evidence")
    return evidence is not None and evidence.scatters


def _bonded(crack: CrackResponse) -> bool:
    """Whether a crack is a joint that was bonded before the earthquake; not known without a result."""
    numbers = crack.numbers
    return numbers is not None and (numbers.get("joint") is not None or numbers.get("bond") is not None)


def _cracked(crack: CrackResponse) -> float:
    """Return how far a bonded joint has cracked in the end [m]; what is cracked from the start cracks no farther."""
    numbers = crack.numbers
    if numbers is None or not _bonded(crack):
        return 0.0
    joint = numbers.get("joint")
    if joint is not None:
        return float(joint[CRACKED])
    # The bond of a block breaks all at once.
    return 0.0 if numbers["bond"]["breaks_s"] is None else float(numbers[WIDTH])


def _worths(name: str, crack: CrackResponse) -> list[HeadlineWorth]:
    """Return the worth of each number of a crack that a limit limits; none without evidence of it."""
    evidence = None if crack.numbers is None else crack.numbers.get("evidence")
    return [] if evidence is None else [worth for key in LIMITS[name].keys if (worth := evidence.get(key)) is not None]


def _scatter(name: str, crack: CrackResponse) -> list[float | None]:
    """Return the size that a limit bounds in each run with the shaking varied, None of a run without a result; nothing
    where single runs do not scatter."""
    numbers = [worth.distribution.numbers for worth in _worths(name, crack) if worth.distribution is not None]
    return [
        None if any(value is None for value in run) else max(abs(value) for value in run if value is not None)
        for run in zip(*numbers, strict=True)
    ]


def _uncertainty(name: str, crack: CrackResponse) -> float:
    """Return how far what a limit limits may be off at a crack."""
    numbers = crack.numbers
    assert numbers is not None
    evidence = numbers.get("evidence")
    if evidence is None:
        return 0.0
    keys = LIMITS[name].keys
    key = keys[0] if len(keys) == 1 else max(keys, key=lambda key: abs(numbers[key]))
    worth = evidence[key]
    if worth is None:
        return 0.0
    # Without a bound the error may be as large as the value.
    bound = abs(float(numbers[key] if worth.uncertainty is None else worth.uncertainty))
    if worth.distribution is None:
        return bound
    # The error of a mean becomes that of the fractile; both add by squares.
    return math.hypot(bound, math.sqrt(_ERROR_OF_FRACTILE**2 - 1.0) * worth.shaking)
