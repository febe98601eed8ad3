"""The static checks after an earthquake: with the slip of a run, or a block that has overturned; between the
motions of a sequence, whether the dam that one has left stands until the next."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.mechanics.drains import drainage_left
from heeltoe.models.statics.joints import Joints, statics_of_sections
from heeltoe.models.statics.model import Statics, statics
from heeltoe.result.numbers import BlockBond, BondState, Stage
from heeltoe.result.outcome import Outcome
from heeltoe.result.record import CrackResponse
from heeltoe.result.response import Response
from heeltoe.result.rest import comes_to_rest
from heeltoe.result.sequence import stages
from heeltoe.warnings.notice import Notice

_NO_CRACK = "this joint is no crack of the run, and has not slipped"


def joints_after(
    case: Case, runs: Callable[[], Sequence[Response]], run_alone: Callable[[Case], Sequence[Response]] | None = None
) -> Joints:
    """Judge a dam after its earthquake at each of its sections: the slip of a crack is that of the run of
    the whole dam, by every door.

    Parameters
    ----------
    case
        Dam, cracks, and the choices of ``[statics]``.
    runs
        Gives the runs of the whole dam, the better model first.
    run_alone
        Runs the dam with a lift joint cracked that is none of its cracks; such a joint has no check after the
        earthquake where it is not given.
    """

    def judge(alone: Case, place: int | None) -> Statics:
        if place is not None:
            return statics_after(alone, *(run.at_crack(place) if len(run.cracks) > 1 else run for run in runs()))
        if run_alone is None:
            still = alone.model_copy(update={"motion": None, "aftershocks": ()})
            asked = alone.statics.residual_friction is not None and alone.statics.residual_slip is None
            return statics(still, 0.0, slip_source=_NO_CRACK) if asked else statics(still)
        result = statics_after(alone, *run_alone(alone))
        source = result.slip_source and f"{result.slip_source}, run with this joint as the only crack"
        return replace(result, slip_source=source)

    return statics_of_sections(case, judge)


def statics_after(case: Case, *runs: Response) -> Statics:
    """Judge the stability of a case after its earthquake.

    Parameters
    ----------
    case
        Of the runs; a slip of its own, ``statics.residual_slip``, goes before theirs.
    *runs
        One run, or several of the same earthquake, the better model first: the first that ended as it should says
        how far the block has slipped. Where none did, an overturned one counts, as nothing stands after that.
    """
    trusted = next((run for run in runs if run.outcome == Outcome.OK), None)
    overturned = next((run for run in runs if run.outcome == Outcome.OVERTURNED), None)
    beside = tuple(run.model for run in runs)
    if trusted is None and overturned is not None:
        return statics(case, overturned_about=overturned.overturned_about, beside=beside)
    if case.statics.residual_slip is not None:
        return statics(case, beside=beside)
    if trusted is None:
        model, outcome = runs[0].model, runs[0].outcome
        source = f"the {model} model ends '{outcome}', zero is taken"
        result = statics(case, 0.0, slip_source=source, beside=beside)
        return replace(result, warnings=(Notice("slip-untold", model=model, outcome=outcome), *result.warnings))
    source, ligament = slip_source(trusted), ligament_of(trusted)
    # What still holds has not slid: its faces are apart by what the concrete gives.
    slip = trusted.residual_slip_m if ligament is None else 0.0
    return statics(case, slip, slip_source=source, ligament=ligament, beside=beside)


def ligament_of(run: Response | CrackResponse) -> tuple[float, float] | None:
    """Return from where to where a bonded joint still holds after its earthquake [m from the heel]; None of a crack,
    and of a joint that is cracked through.

    What has cracked or softened between its ends is taken off the side of the heel.
    """
    bond: BlockBond | None = getattr(run, "bond", None)
    if bond is not None:
        return (0.0, run.crack_width_m) if bond.breaks_s is None else None
    joint: BondState | None = getattr(run, "joint", None)
    if joint is None or joint.cracked_through_s is not None:
        return None
    width: float = run.crack_width_m
    to = width - joint.cracked_downstream_m
    lost = joint.cracked_length_m - joint.cracked_downstream_m + joint.softening_length_m
    return min(lost, to), to


def slip_source(run: Response) -> str:
    """Return what says where the residual slip of a run comes from."""
    source = f"{run.model} model, {plain(run.motion.name)}, PGA {run.motion.pga / run.gravity:.4g} g"
    return source if comes_to_rest(run) else f"{source}, still moving when the run ends"


_AFTER = "post-seismic"


def judged_stages(case: Case, response: Response) -> tuple[Stage, ...]:
    """Return what each motion of a sequence does, and how the dam that it leaves meets the static checks."""
    judged = [_judged(case, stage) for stage in stages(response, response.motion.parts)]
    if response.outcome == Outcome.OVERTURNED and judged:
        fallen = f"the motion overturns the block about its {response.overturned_about}: nothing stands after it"
        judged[-1] = replace(judged[-1], at_rest=False, static={**judged[-1].static, "ok": False, "missed": [fallen]})
    return tuple(judged)


def about_the_sequence(
    case: Case, judged: tuple[Stage, ...], *, followed: bool, several: bool = False
) -> Iterator[Notice]:
    """Say where a motion meets a dam that is not at rest, that does not stand, or whose drains slip has closed; the run
    has `followed` these, or not. Where there are `several` cracks each is named."""
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


def without_own_slip(case: Case) -> Case:
    """Return a case without the residual slip that it names, where another one goes before it."""
    if case.statics.residual_slip is None:
        return case
    return case.model_copy(update={"statics": case.statics.model_copy(update={"residual_slip": None})})


def _judged(case: Case, stage: Stage) -> Stage:
    slip = stage.residual_slip_m
    result = statics(without_own_slip(case), slip, slip_source=plain(stage.name))
    after = [check for check in result.checks if check.load_case == _AFTER]
    return replace(
        stage,
        static={
            "ok": all(check.met for check in after),
            "missed": [str(check.sentence) for check in after if not check.met],
            "drainage": drainage_left(case, slip),
        },
    )
