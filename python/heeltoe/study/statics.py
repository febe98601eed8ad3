"""Static checks as they are asked for: at every section, with the slip of a run, and for a table of dams."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import pyarrow as pa

from heeltoe.case.model import Case
from heeltoe.models.run import AUTO, cost_of, run
from heeltoe.models.statics.after import statics_after
from heeltoe.models.statics.joints import Joints, statics_of_sections
from heeltoe.models.statics.model import Statics, statics
from heeltoe.result.write import build_info
from heeltoe.study.axes import Axis
from heeltoe.study.small import cases_of, check_together

Say = Callable[[str], None]


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


def judge(case: Case, after: After = After(), say: Say = lambda text: None) -> Joints:
    """Judge the stability of a dam at each of its sections, after the earthquake, too.

    Parameters
    ----------
    case
        Dam, water, earthquake and the choices of ``[statics]``.
    after
        Where the slip of the post-seismic case comes from.
    say
        Told what goes on.

    Raises
    ------
    InputError
        Where something of the case cannot be used; without a motion where a model is to say the slip.
    """
    return statics_of_sections(case, partial(_one, after=after, say=say))


def _one(case: Case, after: After, say: Say) -> Statics:
    if after.slip_m is not None:
        return statics(case, after.slip_m, slip_source=after.source)
    if not after.runs(case):
        return statics(case)
    say(f"running the earthquake, crack at {case.crack.elevation:g} m")
    shaken = run(case, after.model or AUTO)
    if case.statics.residual_slip is not None:
        # What was asked for goes before what the case says.
        case = case.model_copy(update={"statics": case.statics.model_copy(update={"residual_slip": None})})
    return statics_after(case, *reversed(shaken.responses))


@dataclass(frozen=True, eq=False)
class StaticsTable:
    """Static checks of every combination of some values.

    Attributes
    ----------
    axes
        The fields that vary, with their values in words.
    cells
        The values of each dam, in the order of the axes; the last varies fastest.
    found
        The checks of each, in the order of `cells`.
    """

    axes: tuple[Axis, ...]
    cells: tuple[tuple[str, ...], ...]
    found: tuple[Joints, ...]

    @property
    def title(self) -> str:
        """Of the case."""
        return self.found[0].title

    @property
    def ok(self) -> bool:
        """Whether every check of every dam is met."""
        return all(each.ok for each in self.found)

    def rows(self) -> list[dict[str, Any]]:
        """Return the table: the varied fields, how many checks are not met, what governs, the least factors."""
        paths = [each.path for each in self.axes]
        return [
            {**dict(zip(paths, cell, strict=True)), **_numbers(found)}
            for cell, found in zip(self.cells, self.found, strict=True)
        ]

    def to_table(self) -> pa.Table:
        """Return the same as an Arrow table."""
        return pa.Table.from_pylist(self.rows())

    def to_json(self) -> dict[str, Any]:
        """Return all checks in full, with the values that belong to them."""
        paths = [each.path for each in self.axes]
        return {
            "model": "statics",
            "title": self.title,
            "ok": self.ok,
            "varied": {each.path: list(each.values) for each in self.axes},
            "runs": [
                {"varied": dict(zip(paths, cell, strict=True)), **row, **statics_json(found)}
                for cell, row, found in zip(self.cells, self.rows(), self.found, strict=True)
            ],
            "build": build_info(),
        }


def statics_json(found: Joints) -> dict[str, Any]:
    """Return the JSON of the checks at many sections, or of those at the only one by themselves."""
    return found.to_json() if len(found.joints) > 1 else found.joints[0].statics.to_json()


def _numbers(found: Joints) -> dict[str, Any]:
    governing = found.governing
    worst = governing.governing
    cases = [each for joint in found.joints for each in joint.statics.cases]
    checks = [check for joint in found.joints for check in joint.statics.checks]
    return {
        "checks_not_met": sum(not check.met for check in checks),
        "governing_elevation_m": governing.elevation_m,
        "governing_load_case": None if worst is None else worst.load_case,
        "governing_check": None if worst is None else worst.name,
        "governing_margin": None if worst is None else worst.margin,
        "least_sliding_factor": _least(each.sliding_factor for each in cases),
        "least_overturning_factor": _least(each.overturning_factor for each in cases),
        "least_flotation_factor": _least(each.flotation_factor for each in cases),
        "longest_crack_m": max((each.cracked_length_m for each in cases), default=None),
        "slip_m": governing.statics.slip_m,
    }


def _least(values: Any) -> float | None:
    return min((value for value in values if value is not None), default=None)


def statics_table(
    source: str | os.PathLike[str] | Mapping[str, Any],
    changes: Sequence[str],
    axes: Sequence[Axis],
    after: After = After(),
    say: Say = lambda text: None,
) -> StaticsTable:
    """Judge every combination of some values.

    Parameters
    ----------
    source, changes
        As :func:`heeltoe.read_case` takes them; the varied fields win.
    axes
        From :func:`heeltoe.study.small.parse_axes`.
    after, say
        As :func:`judge` takes them.

    Raises
    ------
    InputError
        Where a value cannot be used, or the runs of all dams take more than the first case allows.
    """
    cells, cases = cases_of(source, changes, axes)
    check_together(cases, lambda case: cost_of(case, after.model or AUTO) if after.runs(case) else None)
    found = []
    for done, case in enumerate(cases):
        say(f"judging, {done} of {len(cases)} dams done")
        found.append(judge(case, after, say))
    return StaticsTable(tuple(axes), cells, tuple(found))
