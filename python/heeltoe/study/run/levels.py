"""Run one dam through a suite at each level of earthquake, and judge each level by its own limits."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated

from heeltoe.base.blocks import Block, Number
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.models.run import AUTO
from heeltoe.models.statics.model import statics
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.judge import LIMITS
from heeltoe.study.answers.suite import SuiteModel
from heeltoe.study.plan.levels import Level, Levels, case_at
from heeltoe.study.run.run import Progress
from heeltoe.study.run.suite import Motions, run_suite

#: Name of the check of the factor against sliding after the earthquake.
FACTOR = "post_seismic_factor"


class LevelCheck(Block):
    """Comparison of a number of a level with its limit or requirement."""

    name: Annotated[str, Number("Field of `limits`, or post_seismic_factor.")]
    value: Annotated[float | None, Number("The judged number over the records, SI; null where the dam fails.")]
    allowed: Annotated[float, Number("The limit, SI; for a factor the required value.")]
    met: Annotated[bool, Number("Whether that is met.")]

    @property
    def label(self) -> str:
        """Name in words."""
        return "factor against sliding after it" if self.name == FACTOR else LIMITS[self.name].label

    @property
    def unit(self) -> str:
        """Unit of value and limit; empty of a factor."""
        return "" if self.name == FACTOR else LIMITS[self.name].unit


class LevelResult(Block):
    """Results at one level of earthquake."""

    return_period_years: Annotated[float, Number("Mean time between such earthquakes, in years.")]
    records: Annotated[int, Number("Earthquakes of the suite.")]
    records_needed: Annotated[int, Number("Earthquakes that the criteria ask for.")]
    judge: Annotated[str, Number("Which number over the records is judged.")]
    checks: Annotated[list[LevelCheck], Number("Its limits; null numbers of a dam that fails.")]

    @property
    def enough(self) -> Annotated[bool, Number("Whether the suite has as many earthquakes as the criteria ask for.")]:
        """Whether the suite is large enough."""
        return self.records >= self.records_needed

    @property
    def met(self) -> Annotated[bool, Number("Whether the suite is large enough and every limit is met.")]:
        """Whether the level is met."""
        return self.enough and all(check.met for check in self.checks)


class LevelResults(Block):
    """Results at every level of earthquake."""

    title: Annotated[str, Number("Title of the case.")]
    criteria: Annotated[str, Number("Whose criteria they are.")]
    model: Annotated[str, Number("Model that ran.")]
    levels: Annotated[list[LevelResult], Number("The levels, in the order of the file.")]

    @property
    def met(self) -> Annotated[bool, Number("Whether every level is met.")]:
        """Whether every level is met."""
        return all(level.met for level in self.levels)


def run_levels(
    case: Case,
    levels: Levels,
    motions: Motions | None = None,
    *,
    model: str = AUTO,
    progress: Callable[[Progress], None] | None = None,
) -> LevelResults:
    """Run a suite at each level and judge it.

    Parameters
    ----------
    case
        The dam; its own limits are not used.
    levels
        Criteria by level, of :func:`heeltoe.study.plan.levels.read_levels`.
    motions
        Records of the levels that name none; those of the case where it is not given.
    model, progress
        As of :func:`heeltoe.run_suite`, which ``"auto"`` runs the better model alone.

    Raises
    ------
    InputError
        Where the dam cannot run through the motions of a level, with its return period.
    """
    rows, name = [], model
    for level in levels.levels:
        try:
            at = case_at(case, level)
            results = run_suite(at, level.motions or motions, model=model, progress=progress, **level.suite())
        except InputError as error:
            error.field = f"levels, {level.return_period:g} years: {error.field}"
            raise
        if results.suite is None:
            raise RuntimeError("a suite has no answer")
        answer = results.suite.models[-1]
        name = answer.model
        rows.append(_judged(at, level, answer))
    return LevelResults(title=case.title, criteria=levels.title, model=name, levels=rows)


def _judged(case: Case, level: Level, answer: SuiteModel) -> LevelResult:
    """Return a level beside its limits."""
    checks = [
        LevelCheck(name=limit.name, value=limit.value, allowed=limit.allowed, met=limit.met) for limit in answer.limits
    ]
    if level.factor is not None:
        slip = answer.statistics[RESIDUAL_SLIP.key][level.judge]
        factor = None if slip is None else _factor_after(case, level, slip)
        met = factor is not None and factor >= level.factor
        checks.append(LevelCheck(name=FACTOR, value=factor, allowed=level.factor, met=met))
    return LevelResult(
        return_period_years=level.return_period,
        records=len(answer.records),
        records_needed=level.records,
        judge=level.judge,
        checks=checks,
    )


def _factor_after(case: Case, level: Level, slip: float) -> float | None:
    """Return the factor against sliding after the earthquake, with the slip that was judged; None where nothing is left
    to bear the shear."""
    own = level.residual_friction
    worn = case if own is None else case.with_({"statics.residual_friction": own})
    after = [load_case for load_case in statics(worn, slip).cases if load_case.name == "post-seismic"]
    factor = after[0].sliding_factor if after else None
    return factor if factor is not None and math.isfinite(factor) else None
