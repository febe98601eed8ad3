"""Comparison of a result with the user's limits."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from heeltoe.result.contract import CRACKED, WIDTH
from heeltoe.result.crest import CREST_PEAKS, crest_peaks
from heeltoe.result.judge import CREST_LIMITS, LIMITS, Judgement, LimitCheck, judge
from heeltoe.result.record import CrackResponse, ResponseData
from heeltoe.units.parse import Acceleration

if TYPE_CHECKING:
    from heeltoe.case.options import Limits


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
    return judge({"outcome": [response.outcome], **columns}, allowances(limits, response.gravity))


def check_limits(limits: Limits, response: ResponseData, judgement: Judgement | None = None) -> tuple[LimitCheck, ...]:
    """Compare the numbers of a response with the limits that the user has set.

    They are the numbers to trust: where the runs of an elastic dam scatter, the means. Nothing is compared where the
    run does not say; of a dam that has failed no limit is met. `judgement` is that of the response, where it is known.
    """
    judgement = judgement or judge_response(limits, response)
    if not (judgement.has_result[0] or judgement.failed[0]):
        return ()
    checks = []
    for name in judgement.not_met:
        sizes = judgement.size(name)[0].tolist()
        # Any of several cracks may break a limit; each bonded joint is judged by itself.
        joints = [place for place, crack in enumerate(response.cracks) if _bonded(crack)]
        for place in joints if name == "cracked_length" else [sizes.index(max(sizes))]:
            known = not math.isnan(sizes[place])
            of_crack = known and name not in CREST_LIMITS
            checks.append(
                LimitCheck(
                    name=name,
                    value=sizes[place] if known else None,
                    allowed=judgement.limits[name],
                    failed=bool(judgement.failed[0]),
                    uncertainty=_uncertainty(name, response.cracks[place]) if of_crack else 0.0,
                    elevation_m=response.cracks[place].elevation if response.several and of_crack else None,
                )
            )
    return tuple(checks)


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
    return abs(float(numbers[key] if worth.uncertainty is None else worth.uncertainty))
