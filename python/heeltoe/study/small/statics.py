"""Static checks on request: at every section, with the slip of a run, and for a table of dams."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from heeltoe.case.model import Case
from heeltoe.case.read import Source
from heeltoe.models.cost import Cost
from heeltoe.models.run import AUTO, cost_of, record_cost, run_as_stated, wish_cost
from heeltoe.models.statics.after import joints_after, without_own_slip
from heeltoe.models.statics.joints import Joints, statics_of_sections
from heeltoe.models.statics.model import statics
from heeltoe.result.response import Response
from heeltoe.study.plan.axes import Axis
from heeltoe.study.small.response_spectrum import with_response_spectrum
from heeltoe.study.small.run_table import Table, cases_of, check_together

Say = Callable[[str], None]
# Seconds of the checks themselves.
_CHECKED = 0.5
#: Runs that have been made, the better model first, by the model that was asked for and all that a run depends on.
Made = dict[tuple[str, str], tuple[Response, ...]]


@dataclass(frozen=True)
class After:
    """Where the slip of the post-seismic case comes from.

    Attributes
    ----------
    slip_m
        Given; None where it is that of the case, or of a run.
    source
        Who gives it.
    model
        Whose run says it, whatever slip the case gives; None for the slip of the case, or of the model that fits it.
    """

    slip_m: float | None = None
    source: str = "given"
    model: str | None = None

    def runs(self, case: Case) -> bool:
        """Whether an earthquake is to be run."""
        if self.slip_m is not None:
            return False
        return self.model is not None or (case.motion is not None and case.statics.residual_slip is None)


def judge(
    case: Case,
    after: After = After(),
    say: Say = lambda text: None,
    *,
    spectrum: str | None = None,
    made: Made | None = None,
) -> Joints:
    """Judge the stability of a dam at each of its sections, after the earthquake, too.

    Parameters
    ----------
    case
        Dam, water, earthquake and the choices of ``[statics]``.
    after
        Where the slip of the post-seismic case comes from.
    say
        Told what goes on.
    spectrum
        Of the response spectrum analysis beside them, see
        :func:`heeltoe.study.small.response_spectrum.with_response_spectrum`; None for none.
    made
        Runs of dams that differ in their static checks at most; those that are still to be made are put there.

    Raises
    ------
    InputError
        Where something of the case cannot be used; without a motion where a model is to say the slip.
    """
    judged = _judge(case, after, say, {} if made is None else made)
    if spectrum is None:
        return judged
    say("looking for the first mode")
    return with_response_spectrum(judged, spectrum, field="--spectrum")


def statics_cost(case: Case, after: After) -> Cost | None:
    """Return what the earthquake of the post-seismic case takes, and the checks beside it; None where it is refused."""
    if not after.runs(case):
        return Cost(_CHECKED)
    cost = record_cost(case) + Cost(_CHECKED)
    alone = wish_cost(case, after.model or AUTO)
    return None if alone is None else cost + alone


def _judge(case: Case, after: After, say: Say, made: Made) -> Joints:
    slip_m = after.slip_m
    if slip_m is not None:
        return statics_of_sections(case, lambda alone, place: statics(alone, slip_m, slip_source=after.source))
    if not after.runs(case):
        return statics_of_sections(case)
    # What was asked for goes before what the case says.
    case = without_own_slip(case)

    def run_once(dam: Case, what: str) -> Sequence[Response]:
        model = after.model or AUTO
        key = model, _run_of(dam)
        if key not in made:
            say(f"running the earthquake{what}")
            made[key] = tuple(reversed(run_as_stated(dam, model).responses))
        return made[key]

    def run_alone(alone: Case) -> Sequence[Response]:
        return run_once(alone, f", crack at {alone.crack.elevation:g} m alone")

    return joints_after(case, lambda: run_once(case, ""), run_alone)


def _run_of(case: Case) -> str:
    """Return all that a run depends on: static checks read more of a case."""
    return case.model_dump_json(exclude={"statics": True})


@dataclass(frozen=True, eq=False)
class StaticsTable(Table):
    """Static checks of every combination of some values.

    Attributes
    ----------
    dams
        The checks of each, in the order of `cells`.
    """

    dams: tuple[Joints, ...]

    @property
    def title(self) -> str:
        """Title of the case."""
        return self.dams[0].title

    @property
    def ok(self) -> bool:
        """Whether every check of every dam is met."""
        return all(joints.ok for joints in self.dams)

    def numbers(self) -> Iterable[dict[str, Any]]:
        """Return how many checks of each dam are not met, what governs, and the least factors."""
        return map(_numbers, self.dams)

    def to_json(self) -> dict[str, Any]:
        """Return all checks in full, with the values that belong to them."""
        runs = ({**row, **statics_json(joints)} for row, joints in zip(self.rows(), self.dams, strict=True))
        return {"model": "statics", "title": self.title, "ok": self.ok, **self.runs_json(runs)}


def statics_json(joints: Joints) -> dict[str, object]:
    """Return the JSON of the checks at many sections, or of those at the only one by themselves."""
    return joints.to_json() if len(joints.joints) > 1 else joints.joints[0].statics.to_json()


def _numbers(joints: Joints) -> dict[str, Any]:
    governing = joints.governing
    worst = governing.governing
    cases = [case for joint in joints.joints for case in joint.statics.cases]
    checks = [check for joint in joints.joints for check in joint.statics.checks]
    return {
        "checks_not_met": sum(not check.met for check in checks),
        "governing_elevation_m": governing.elevation_m,
        "governing_load_case": None if worst is None else worst.load_case,
        "governing_check": None if worst is None else worst.name,
        "governing_margin": None if worst is None else worst.margin,
        "least_sliding_factor": _least(case.sliding_factor for case in cases),
        "least_overturning_factor": _least(case.overturning_factor for case in cases),
        "least_flotation_factor": _least(case.flotation_factor for case in cases),
        "longest_crack_m": max((case.cracked_length_m for case in cases), default=None),
        "slip_m": governing.statics.slip_m,
    }


def _least(values: Any) -> float | None:
    return min((value for value in values if value is not None), default=None)


def statics_table(
    source: Source,
    changes: Sequence[str],
    axes: Sequence[Axis],
    after: After = After(),
    say: Say = lambda text: None,
    *,
    spectrum: str | None = None,
) -> StaticsTable:
    """Judge every combination of some values.

    Parameters
    ----------
    source, changes
        As :func:`heeltoe.read_case` takes them; the varied fields win.
    axes
        From :func:`heeltoe.study.small.run_table.parse_axes`.
    after, say, spectrum
        As :func:`judge` takes them.

    Raises
    ------
    InputError
        Where a value cannot be used, or the runs of all dams take more than the first case allows.
    """
    cells, cases = cases_of(source, changes, axes)
    runs = {_run_of(case): case for case in cases if after.runs(case)}
    check_together([*runs.values()], lambda case: cost_of(case, after.model or AUTO))
    table = []
    made: Made = {}
    for done, case in enumerate(cases):
        say(f"judging, {done} of {len(cases)} dams done")
        table.append(judge(case, after, say, spectrum=spectrum, made=made))
    return StaticsTable(tuple(axes), cells, tuple(table))
