"""A block that the ground shakes across the valley, too, beside the same block without that."""

from __future__ import annotations

from dataclasses import replace

from heeltoe.case.combinations import check
from heeltoe.case.model import Case
from heeltoe.case.motion import Motion
from heeltoe.result.contract import JOINT_METER_M
from heeltoe.result.numbers import BlockNumbers, WithoutCrossValley
from heeltoe.result.response import Response
from heeltoe.warnings.notice import Notice

# Joints of a real dam close before a monolith has slid so far across the valley [m].
_JOINTS_M = 0.02
_SHAKEN = {"points": [["0 s", "0 g"], ["1 s", "0.1 g"]]}


def check_across(case: Case, model: str = "rigid") -> None:
    """Refuse a case that a model does not follow where the ground shakes it across the valley, whatever its own motion.

    Raises
    ------
    InputError
        Then.
    """
    shaken = Motion.model_validate({**_SHAKEN, "cross_valley": _SHAKEN})
    check(case.model_copy(update={"motion": shaken}), model)


def beside_one_component(response: Response, without: Response) -> Response:
    """Add to a response what the block does without the shaking across the valley, and what a reader must know."""
    numbers = response.numbers
    if not isinstance(numbers, BlockNumbers) or numbers.cross_valley is None:
        return response
    slip = without.residual_slip_m if without.ok else None
    factor = None
    if response.ok and slip is not None and abs(slip) >= JOINT_METER_M:
        factor = numbers.residual_slip_m / slip
    alone = WithoutCrossValley(outcome=str(without.outcome), residual_slip_m=slip, factor=factor)
    across = replace(numbers.cross_valley, without_cross_valley=alone)
    farthest = max(across.peak_slip_cross_left_m, -across.peak_slip_cross_right_m)
    notices = [Notice("cross-valley-upright")]
    if farthest > _JOINTS_M:
        notices.append(Notice("cross-valley-far", slip_m=farthest))
    response = replace(response, warnings=(*response.warnings, *notices))
    return response.with_crack(of_crack=replace(numbers, cross_valley=across))
