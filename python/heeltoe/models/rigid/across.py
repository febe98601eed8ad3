"""Which blocks are followed where the ground shakes them across the valley, too."""

from __future__ import annotations

from heeltoe.case.combinations import check
from heeltoe.case.model import Case
from heeltoe.case.motion import Motion
from heeltoe.errors.error import InputError

_FIELD = "motion.cross_valley"
_SHAKEN = {"points": [["0 s", "0 g"], ["1 s", "0.1 g"]]}


def check_across(case: Case, model: str = "rigid", field: str = _FIELD) -> None:
    """Refuse a case that a model does not follow where the ground shakes it across the valley, whatever its own motion.
    `field` is what asks for that shaking, where it is not the case.

    Raises
    ------
    InputError
        Then.
    """
    shaken = Motion.model_validate({**_SHAKEN, "cross_valley": _SHAKEN})
    try:
        check(case.model_copy(update={"motion": shaken}), model)
    except InputError as error:
        for problem in (error, *error.others):
            problem.field, problem.remedy = (text.replace(_FIELD, field) for text in (problem.field, problem.remedy))
        raise
