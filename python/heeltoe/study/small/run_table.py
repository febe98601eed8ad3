"""A small study of one case: every combination of some values, each run kept whole, with its histories and its words.

What varies, and which dams that makes, is that of any study; nothing of it is stored as it runs."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from tomllib import TOMLDecodeError, loads
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import ValidationError

from heeltoe.base.display import Shown
from heeltoe.base.pandas import dataframe_of_rows
from heeltoe.case.changes import Change
from heeltoe.case.distribution import Distribution
from heeltoe.case.model import Case
from heeltoe.case.paths import quantity_of
from heeltoe.case.read import Source, read_case
from heeltoe.case.sentences import first_error
from heeltoe.errors.error import InputError, shown
from heeltoe.kernel.build import build_info
from heeltoe.models.cost import Cost
from heeltoe.models.flexible.body.cost import check_cost
from heeltoe.result.contract import CRACKED, HEADLINES, RESIDUAL_SLIP, SLIPS_BY_MODE
from heeltoe.result.response import Response
from heeltoe.study.plan.axes import Axis, even
from heeltoe.study.plan.crack_columns import column_of
from heeltoe.study.plan.samples import Samples
from heeltoe.units.parse import DIMENSIONS

if TYPE_CHECKING:
    import pyarrow as pa


#: Column of the residual slip of the simpler model.
BESIDE = f"beside_{RESIDUAL_SLIP.key}"
#: More runs than this are a study, not a table.
MOST = 32
# So many cases of a table say what all take; seconds to read one, bytes that are kept of one.
_LOOKED_AT, _READ, _KEPT = 4, 0.01, 1e6

_not_varied = partial(
    InputError, "wrong-quantity", kind="values of a field, PATH=VALUE,VALUE", example="crack.friction=0.8,1.0,1.2"
)
Run = Callable[[Case], Response]


@dataclass(frozen=True, eq=False)
class Table(ABC):
    """A result for every combination of some values.

    Attributes
    ----------
    axes
        The fields that vary, with their values in words.
    cells
        The values of each run, in the order of the axes; the last varies fastest.
    """

    axes: tuple[Axis, ...]
    cells: tuple[tuple[str, ...], ...]

    def varied(self) -> Iterator[dict[str, str]]:
        """Walk the runs by the values of their varied fields."""
        for cell in self.cells:
            yield {axis.path: value for axis, value in zip(self.axes, cell, strict=True)}

    def rows(self) -> list[dict[str, Any]]:
        """Return the table by its columns: the varied fields, then the numbers of each run."""
        return [{**values, **numbers} for values, numbers in zip(self.varied(), self.numbers(), strict=True)]

    @abstractmethod
    def numbers(self) -> Iterable[dict[str, Any]]:
        """Return the numbers of the runs by their JSON names; None without a result."""

    def to_table(self) -> pa.Table:
        """Return the same as an Arrow table."""
        import pyarrow as pa

        return pa.Table.from_pylist(self.rows())

    def to_pandas(self) -> Any:
        """Return the same as a ``pandas.DataFrame``."""
        return dataframe_of_rows(self.rows())

    def runs_json(self, runs: Iterable[Mapping[str, object]]) -> dict[str, object]:
        """Return runs in full, with the values that belong to them."""
        return {
            "varied": {axis.path: list(axis.values) for axis in self.axes},
            "runs": [{"varied": values, **run} for values, run in zip(self.varied(), runs, strict=True)],
            "build": build_info(),
        }


@dataclass(frozen=True, eq=False)
class SmallStudy(Table, Shown):
    """Runs of every combination of some values.

    Attributes
    ----------
    responses
        The results, in the order of `cells`.
    """

    responses: tuple[Response, ...]

    @property
    def model(self) -> str:
        """Model of all runs."""
        return self.responses[0].model

    @property
    def title(self) -> str:
        """Title of the case."""
        return self.responses[0].title

    @property
    def cracks(self) -> int:
        """Numbers of cracks of the dams; empty where all of them have one."""
        return max(len(response.cracks) if response.several else 0 for response in self.responses)

    @property
    def ok(self) -> bool:
        """Whether all runs have a result to trust."""
        return all(response.ok for response in self.responses)

    def __repr__(self) -> str:
        varied = ", ".join(f"{axis.path} {len(axis.values)} times" for axis in self.axes)
        title = self.title or "untitled case"
        return f"<SmallStudy: {len(self.responses)} runs of the {self.model} model, {title!r}, {varied}>"

    def numbers(self) -> Iterable[dict[str, Any]]:
        """Return the numbers of the runs, and how they ended."""
        return (_numbers(response, self.cracks, bonded=self.bonded) for response in self.responses)

    @property
    def bonded(self) -> bool:
        """Whether a run has a bonded joint."""
        return any(getattr(crack, "joint", None) is not None for run in self.responses for crack in run.cracks)

    def to_json(self) -> dict[str, Any]:
        """Return all results in full, with the values that belong to them."""
        runs = self.runs_json(response.to_json() for response in self.responses)
        return {"model": self.model, "title": self.title, **runs}


def parse_axes(texts: Sequence[str], field: str = "--vary") -> tuple[Axis, ...]:
    """Return what ``"PATH=VALUE,VALUE"`` mean, or ``"PATH={from=VALUE,to=VALUE,count=3}"``, a distribution as a study
    file has it.

    Raises
    ------
    InputError
        Where one has no values or no path, a path comes twice, or they make too many runs.
    """
    axes: list[Axis] = []
    for text in texts:
        path, _, entry = (part.strip() for part in text.partition("="))
        if not path:
            raise _not_varied(field, shown(text))
        values = _spread(path, entry, field) if entry.startswith("{") else tuple(map(str.strip, entry.split(",")))
        if not all(values):
            raise _not_varied(field, shown(text))
        if path in [other.path for other in axes] or len(set(values)) < len(values):
            raise InputError("listed-twice", field, shown(path))
        # As written: the case reads them, as it reads its own file.
        axes.append(Axis(path, None, values, None))
    runs = Samples(axes, "grid", None, 0).count
    if runs > MOST:
        raise InputError(
            "too-many", field, f"{runs} runs for one table", most=f"{MOST}, or write a study file for `heeltoe study`"
        )
    return tuple(axes)


def _spread(path: str, entry: str, field: str) -> tuple[str, ...]:
    """Return equally likely values of a distribution, with their units."""
    try:
        distribution = Distribution.model_validate(loads(f"given = {entry}")["given"])
    except TOMLDecodeError:
        raise _not_varied(field, shown(f"{path}={entry}")) from None
    except ValidationError as error:
        raise first_error(error, Distribution) from None
    quantity = quantity_of(path)
    if quantity is None:
        raise InputError("study-not-a-number", path, shown(distribution.distribution))
    unit = DIMENSIONS[quantity].unit
    return tuple(f"{value:.6g} {unit}".strip() for value in even(distribution, quantity, path).tolist())


def run_small(
    source: Source,
    changes: Sequence[Change],
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
    source: Source, changes: Sequence[Change], axes: Sequence[Axis]
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


def table_cost(
    source: Source, changes: Sequence[Change], axes: Sequence[Axis], cost: Callable[[Case], Cost | None]
) -> Cost | None:
    """Return about what a table costs with the reading of its cases, by a few of them; None where one is refused."""
    samples = Samples(axes, "grid", None, 0)
    looked = np.unique(np.linspace(0, samples.count - 1, _LOOKED_AT).astype(np.int64))
    columns, _ = samples.at(looked)
    costs = []
    for cell in zip(*columns.values(), strict=True):
        case = read_case(source, [*changes, *(f"{path}={value}" for path, value in zip(columns, cell, strict=True))])
        costs.append(cost(case))
    known = [one for one in costs if one is not None]
    if not known or len(known) < len(costs):
        return None
    together = sum(one.seconds for one in known) / len(known) + _READ
    return Cost(samples.count * together, max(one.memory for one in known) + _KEPT * samples.count)


def check_together(cases: Sequence[Case], cost: Callable[[Case], Cost | None]) -> None:
    """Refuse a table that takes too much as a whole."""
    costs = [estimate for estimate in map(cost, cases) if estimate is not None]
    if costs:
        check_cost(cases[0], Cost(sum(cost.seconds for cost in costs), max(cost.memory for cost in costs)), "--vary")


def _beside(block: Response) -> float | None:
    return RESIDUAL_SLIP.of(block) if block.ok else None


def _by_crack(cracks: Sequence[Mapping[str, Any]], count: int) -> dict[str, Any]:
    """Return the headline numbers of each of several cracks; None where there is no result."""
    rows = [*cracks, *({} for _ in range(count - len(cracks)))]
    return {
        column_of(place, headline.key): crack.get(headline.key)
        for place, crack in enumerate(rows)
        for headline in HEADLINES
    }


def _numbers(response: Response, cracks: int, *, bonded: bool) -> dict[str, Any]:
    summary = response.summary if response.ok else {}
    joint = summary.get("joint") or {}
    by_mode = summary.get("slip_by_mode_m", {})
    slips = [headline.key for headline in HEADLINES if headline.kind == "slip"]
    others = [headline.key for headline in HEADLINES if headline.kind != "slip"]
    return {
        **{name: summary.get(name) for name in slips},
        **dict(zip(SLIPS_BY_MODE, by_mode.values() or (None,) * len(SLIPS_BY_MODE), strict=True)),
        **{name: summary.get(name) for name in (*others, "impacts")},
        **_by_crack([crack.to_json() for crack in response.cracks] if summary and response.several else (), cracks),
        **({name: joint.get(name) for name in ("first_cracking_s", CRACKED)} if bonded else {}),
        "largest_tension_pa": (summary.get("tension") or {}).get("stress_pa"),
        **({} if response.beside is None else {BESIDE: _beside(response.beside)}),
        "limits_met": all(check.met for check in response.limits) if response.limits else None,
        "outcome": response.outcome,
    }
