"""The static checks between the motions of a sequence: whether the dam that one has left stands until the next."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.mechanics.drains import drainage_left
from heeltoe.models.statics.model import statics
from heeltoe.result.response import Response
from heeltoe.result.sequence import Stage, stages
from heeltoe.warnings.notice import Notice

_AFTER = "post-seismic"


def judged_stages(case: Case, response: Response) -> tuple[Stage, ...]:
    """Return what each motion of a sequence does, and how the dam that it leaves meets the static checks."""
    judged = [_judged(case, stage) for stage in stages(response, response.motion.parts)]
    if response.outcome == "overturned" and judged:
        fallen = f"the motion overturns the block about its {response.overturned_about}: nothing stands after it"
        judged[-1] = replace(judged[-1], at_rest=False, static={**judged[-1].static, "ok": False, "missed": [fallen]})
    return tuple(judged)


def about_the_sequence(
    case: Case, judged: tuple[Stage, ...], *, followed: bool, several: bool = False
) -> Iterator[Notice]:
    """Say where a motion meets a dam that is not at rest, that does not stand, or whose drains slip has closed; the run
    has `followed` these, or not. Where there are `several` cracks it is said of which."""
    parts = len(case.aftershocks) + 1
    if judged and len(judged) < parts:
        yield Notice("sequence-ends", number=len(judged), name=judged[-1].name, left=parts - len(judged))
    where = f" at the crack at {case.crack.elevation:g} m," if several else ""
    for number, stage in enumerate(judged[:-1]):
        which = f"motion {number + 1}, {stage.name},{where}"
        if not stage.at_rest:
            field, begins = f"aftershocks[{number}].pause", judged[number + 1].begins_s
            yield Notice("sequence-moves", name=which, field=field, time_s=begins)
        if not stage.static["ok"]:
            yield Notice("sequence-statics", name=which, missed="; ".join(stage.static["missed"]))
        share = stage.static["drainage"]
        if share < 1.0:
            efficiency = share * (case.uplift.drain_efficiency or 0.0)
            code = "sequence-drains-close" if followed else "sequence-drains"
            yield Notice(code, name=which, share=share, efficiency=efficiency)


def _judged(case: Case, stage: Stage) -> Stage:
    slip = stage.residual_slip_m
    if case.statics.residual_slip is not None:
        case = case.model_copy(update={"statics": case.statics.model_copy(update={"residual_slip": None})})
    result = statics(case, slip, slip_source=plain(stage.name))
    after = [check for check in result.checks if check.load_case == _AFTER]
    return replace(
        stage,
        static={
            "ok": all(check.met for check in after),
            "missed": [str(check.sentence) for check in after if not check.met],
            "drainage": drainage_left(case, slip),
        },
    )
