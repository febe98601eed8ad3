"""A small study of one case: every combination of some values, each run kept whole, with its histories and its words.

What varies, and which dams that makes, is that of any study; nothing of it is stored as it runs."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from tomllib import TOMLDecodeError, loads
from typing import Any

import numpy as np
import pyarrow as pa
from pydantic import ValidationError

from heeltoe.case.model import Case
from heeltoe.case.paths import quantity_of
from heeltoe.case.read import read_case
from heeltoe.case.sentences import first_error
from heeltoe.dataframe import dataframe
from heeltoe.errors import InputError, shown
from heeltoe.models.flexible.cost import Cost, check_cost
from heeltoe.result.contract import HEADLINES
from heeltoe.result.response import Response
from heeltoe.result.write import build_info
from heeltoe.shown import Shown
from heeltoe.study.axes import Axis, even
from heeltoe.study.cracks.columns import column_of
from heeltoe.study.file import Distribution
from heeltoe.study.samples import Samples
from heeltoe.units.parse import DIMENSIONS

#: More runs than this are a study, not a table.
MOST = 32

Run = Callable[[Case], Response]

# Slips have their modes behind them, as columns of their own.
_MODES = ("sliding", "slide_rocking", "drifting")


@dataclass(frozen=True, eq=False)
class SmallStudy(Shown):
    """Every combination of some values.

    Attributes
    ----------
    axes
        The fields that vary, with their values in words.
    cells
        The values of each run, in the order of the axes; the last varies fastest.
    responses
        The results, in the order of `cells`.
    """

    axes: tuple[Axis, ...]
    cells: tuple[tuple[str, ...], ...]
    responses: tuple[Response, ...]

    @property
    def model(self) -> str:
        """Of all runs."""
        return self.responses[0].model

    @property
    def title(self) -> str:
        """Of the case."""
        return self.responses[0].title

    @property
    def cracks(self) -> int:
        """How many cracks the dams have; none are told of where all of them have one."""
        return max(len(each.summary.get("cracks", ())) for each in self.responses)

    @property
    def ok(self) -> bool:
        """Whether all runs have a result to trust."""
        return all(each.ok for each in self.responses)

    def __repr__(self) -> str:
        varied = ", ".join(f"{each.path} {len(each.values)} times" for each in self.axes)
        title = self.title or "untitled case"
        return f"<SmallStudy: {len(self.responses)} runs of the {self.model} model, {title!r}, {varied}>"

    def rows(self) -> list[dict[str, Any]]:
        """Return the table: the varied fields, numbers by their JSON names (None without a result), the outcome."""
        paths = [each.path for each in self.axes]
        return [
            {**dict(zip(paths, cell, strict=True)), **_numbers(response, self.cracks)}
            for cell, response in zip(self.cells, self.responses, strict=True)
        ]

    def to_table(self) -> pa.Table:
        """Return the same as an Arrow table."""
        return pa.Table.from_pylist(self.rows())

    def to_pandas(self) -> Any:
        """Return the same as a ``pandas.DataFrame``."""
        rows = self.rows()
        return dataframe({name: [row[name] for row in rows] for name in rows[0]})

    def to_json(self) -> dict[str, Any]:
        """Return all results in full, with the values that belong to them."""
        paths = [each.path for each in self.axes]
        return {
            "model": self.model,
            "title": self.title,
            "varied": {each.path: list(each.values) for each in self.axes},
            "runs": [
                {"varied": dict(zip(paths, cell, strict=True)), **response.to_json()}
                for cell, response in zip(self.cells, self.responses, strict=True)
            ],
            "build": build_info(),
        }


def parse_axes(texts: Sequence[str], field: str = "--vary") -> tuple[Axis, ...]:
    """Return what ``"PATH=VALUE,VALUE"`` mean, or ``"PATH={from=VALUE,to=VALUE,count=3}"``, a distribution as a study
    file has it.

    Raises
    ------
    InputError
        Where one has no values or no path, a path comes twice, or they make too many runs.
    """
    found: list[Axis] = []
    for text in texts:
        path, _, given = (part.strip() for part in text.partition("="))
        if not path:
            raise InputError("vary-form", field, shown(text))
        values = _spread(path, given, field) if given.startswith("{") else tuple(map(str.strip, given.split(",")))
        if not all(values):
            raise InputError("vary-form", field, shown(text))
        if path in [other.path for other in found] or len(set(values)) < len(values):
            raise InputError("vary-twice", field, shown(path))
        # As written: the case reads them, as it reads its own file.
        found.append(Axis(path, None, values, None))
    runs = Samples(found, "grid", None, 0).count
    if runs > MOST:
        raise InputError("vary-many", field, runs, most=MOST)
    return tuple(found)


def _spread(path: str, given: str, field: str) -> tuple[str, ...]:
    """Return equally likely values of a distribution, with their units."""
    try:
        told = Distribution.model_validate(loads(f"given = {given}")["given"])
    except TOMLDecodeError:
        raise InputError("vary-form", field, shown(f"{path}={given}")) from None
    except ValidationError as error:
        raise first_error(error, Distribution) from None
    quantity = quantity_of(path)
    if quantity is None:
        raise InputError("study-not-a-number", path, shown(told.distribution))
    unit = DIMENSIONS[quantity].unit
    return tuple(f"{value:.6g} {unit}".strip() for value in even(told, quantity, path).tolist())


def run_small(
    source: str | os.PathLike[str] | Mapping[str, Any],
    changes: Sequence[str | Mapping[str, Any]],
    axes: Sequence[Axis],
    run: Run,
    *,
    cost: Callable[[Case], Cost | None] = lambda case: None,
    progress: Callable[[int, int], None] | None = None,
) -> SmallStudy:
    """Run every combination of the values.

    Parameters
    ----------
    source, changes
        As :func:`heeltoe.read_case` takes them; the varied fields win.
    axes
        From :func:`parse_axes`.
    run
        Makes a response of a case.
    cost
        Says what that takes, where it takes much.
    progress
        Called with how many runs are done, and of how many.

    Raises
    ------
    InputError
        Where a value cannot be used, or all runs together take more than the first case allows; all cases are read
        before the first one runs.
    """
    cells, cases = cases_of(source, changes, axes)
    check_together(cases, cost)
    responses = []
    for done, case in enumerate(cases):
        if progress is not None:
            progress(done, len(cases))
        responses.append(run(case))
    return SmallStudy(tuple(axes), cells, tuple(responses))


def cases_of(
    source: str | os.PathLike[str] | Mapping[str, Any], changes: Sequence[str | Mapping[str, Any]], axes: Sequence[Axis]
) -> tuple[tuple[tuple[str, ...], ...], list[Case]]:
    """Return the values of every combination, and the case that each makes."""
    samples = Samples(axes, "grid", None, 0)
    columns, _ = samples.at(np.arange(samples.count, dtype=np.int64))
    cells = tuple(zip(*columns.values(), strict=True)) if columns else ((),)
    cases = [
        read_case(source, [*changes, *(f"{path}={value}" for path, value in zip(columns, cell, strict=True))])
        for cell in cells
    ]
    return cells, cases


def check_together(cases: Sequence[Case], cost: Callable[[Case], Cost | None]) -> None:
    """Refuse a table that takes too much as a whole."""
    costs = [each for each in map(cost, cases) if each is not None]
    if costs:
        check_cost(cases[0], Cost(sum(each.seconds for each in costs), max(each.memory for each in costs)), "--vary")


def _beside(block: Response) -> float | None:
    return block.residual_slip_m if block.ok else None


def _by_crack(found: Sequence[Mapping[str, Any]], count: int) -> dict[str, Any]:
    """Return the headline numbers of each of several cracks; None where there is no result."""
    told = [*found, *({} for _ in range(count - len(found)))]
    return {column_of(place, each.key): crack.get(each.key) for place, crack in enumerate(told) for each in HEADLINES}


def _numbers(response: Response, cracks: int) -> dict[str, Any]:
    found = response.summary if response.ok else {}
    by_mode = found.get("slip_by_mode_m", {})
    slips = [each.key for each in HEADLINES if each.kind == "slip"]
    others = [each.key for each in HEADLINES if each.kind != "slip"]
    return {
        **{name: found.get(name) for name in slips},
        **{f"slip_{name}_m": by_mode.get(name) for name in _MODES},
        **{name: found.get(name) for name in (*others, "impacts")},
        **_by_crack(found.get("cracks", ()), cracks),
        "largest_tension_pa": (found.get("tension") or {}).get("stress_pa"),
        **({} if response.beside is None else {"beside_residual_slip_m": _beside(response.beside)}),
        "limits_met": all(check.met for check in response.limits) if response.limits else None,
        "outcome": response.outcome,
    }
