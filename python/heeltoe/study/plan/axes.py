"""An axis of a study: a field of the case with its values, or the distribution that they are drawn from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.case.distribution import PLACES, Distribution, Value, distributed
from heeltoe.case.model import Case
from heeltoe.case.paths import quantity_of, value_of
from heeltoe.errors.error import InputError, shown
from heeltoe.study.plan.problems import Problems
from heeltoe.units.parse import DIMENSIONS, parse

#: Values of a distribution that are tried in the case, before anything runs.
_TRIED = 100


@dataclass(frozen=True, eq=False)
class Axis:
    """A field that varies.

    Attributes
    ----------
    path
        Of the field.
    quantity
        That it holds, a key of :data:`heeltoe.units.parse.DIMENSIONS`; None of a choice among words.
    values
        As the user wrote them; of a distribution those that a grid takes, none where it is only drawn.
    numbers
        The same in SI units; None of words.
    law
        What is drawn from; None of a list, of which each value is as likely.
    """

    path: str
    quantity: str | None
    values: tuple[Value, ...]
    numbers: Floats | None
    law: Any = None

    def changes(self, value: Any) -> dict[str, Any]:
        """Return the change of the case that gives the field a value of :meth:`at` or :meth:`drawn`."""
        if self.quantity is None or not isinstance(value, float):
            return {self.path: value}
        unit = DIMENSIONS[self.quantity].unit
        return {self.path: f"{float(value)!r} {unit}" if unit else float(value)}

    def at(self, index: NDArray[np.integer[Any]]) -> NDArray[Any]:
        """Return the values at places of the list; SI numbers, or words."""
        listed: NDArray[Any] = self._listed[index]
        return listed

    def drawn(self, share: Floats) -> NDArray[Any]:
        """Return the values below which these shares of all draws lie, from 0 to 1; SI numbers, or words."""
        if self.law is None:
            return self._listed[np.minimum((share * len(self.values)).astype(np.int64), len(self.values) - 1)]
        # What a sequence puts at the very ends is not infinite.
        return np.asarray(self.law.ppf(np.clip(share, 1e-12, 1.0 - 1e-12)), dtype=np.float64)

    @cached_property
    def _listed(self) -> NDArray[Any]:
        return np.array(self.values, dtype=object) if self.numbers is None else self.numbers


def axis_of(
    path: str,
    entry: tuple[Value, ...] | Distribution,
    case: Case,
    *,
    drawn: bool,
    beside: Mapping[str, Any] = MappingProxyType({}),
) -> Axis:
    """Return what varies.

    Parameters
    ----------
    path, given
        From the study file.
    case
        The base case, whose other fields decide which values there can be.
    drawn
        Whether values are drawn; otherwise a distribution needs a count.
    beside
        Values of other fields that vary, without which this one may have no meaning.

    Raises
    ------
    InputError
        Where there is no such field, or it cannot have such values, with all of these.
    """
    quantity = quantity_of(path)
    if isinstance(entry, Distribution):
        if quantity is None:
            try:
                case.with_({path: 1.0})
            except InputError as error:
                if error.code == "unknown-field":
                    raise
            raise InputError("study-not-a-number", f"vary.{path}", shown(entry.distribution))
        law = law_of(entry, lambda value, field: parse(value, quantity, field), f"vary.{path}")
        numbers = np.zeros(0) if drawn else _even(entry, law, f"vary.{path}")
        # Many values lie between these, which are tried; a run of one that the case refuses is counted as refused.
        ends = (*law.support(), *numbers[:: max(1, numbers.size // _TRIED)], *numbers[-1:])
        for value in (end for end in ends if np.isfinite(end)):
            _tried(case, Axis(path, quantity, (), None), float(value), beside)
        return Axis(path, quantity, tuple(numbers.tolist()), numbers, law)
    axis = Axis(path, quantity, entry, None)
    values, problems = list[Any](), Problems()
    for value in entry:
        with problems:
            values.append(value_of(_tried(case, axis, value, beside), path))
    problems.tell()
    if len({str(value) for value in values}) < len(values):
        raise InputError("listed-twice", f"vary.{path}", shown(list(entry)))
    if quantity is None:
        return Axis(path, None, entry, None)
    # An acceleration remembers whether it was given in g.
    numbers = np.array([value.si(case.gravity) if hasattr(value, "si") else float(value) for value in values])
    return Axis(path, quantity, entry, numbers)


def check_drawn(axis: Axis, values: NDArray[Any], case: Case, beside: Mapping[str, object]) -> None:
    """Refuse a distribution of which something was drawn that the field cannot have.

    Raises
    ------
    InputError
        Naming the lowest or the highest value.
    """
    if axis.law is not None:
        for value in (values.min(), values.max()):
            _tried(case, axis, float(value), beside)


def law_of(distribution: Distribution, read: Callable[[object, str], float], field: str) -> Any:
    """Return a distribution in SI units, as scipy has them.

    Parameters
    ----------
    distribution
        From the study file.
    read
        Returns the number that a value in a field means.
    field
        Where the distribution stands.

    Raises
    ------
    InputError
        Where its numbers do not make one.
    """
    numbers, problems = dict[str, float](), Problems()
    for name in PLACES:
        value = getattr(distribution, "from_" if name == "from" else name)
        if value is not None:
            with problems:
                numbers[name] = read(value, f"{field}.{name}")
    problems.tell()
    return distributed(distribution, numbers, field)


def even(distribution: Distribution, quantity: str, field: str) -> Floats:
    """Return equally likely values of a distribution, SI; of a uniform one from end to end, as people count.

    Raises
    ------
    InputError
        Where its numbers do not make one, or it does not say how many.
    """
    return _even(distribution, law_of(distribution, lambda value, name: parse(value, quantity, name), field), field)


def _even(distribution: Distribution, law: Any, field: str) -> Floats:
    if distribution.count is None:
        raise InputError("study-count", field, shown(distribution.distribution))
    if distribution.distribution == "uniform":
        low, high = (float(end) for end in law.support())
        return np.linspace(low, high, distribution.count)
    return np.asarray(law.ppf((np.arange(distribution.count) + 0.5) / distribution.count), dtype=np.float64)


def beside(axis_path: str, vary: Mapping[str, tuple[Value, ...] | Distribution]) -> dict[str, Any]:
    """Return a value of each other field that varies by a list."""
    return {path: entry[0] for path, entry in vary.items() if path != axis_path and not isinstance(entry, Distribution)}


def _tried(case: Case, axis: Axis, value: Any, others: Mapping[str, object]) -> Case:
    """Return the case with a value, which it may refuse; taken by itself, and beside others if it needs them."""
    changes = axis.changes(value)
    try:
        return case.with_(changes)
    except InputError as error:
        if others:
            with suppress(InputError):
                return case.with_({**others, **changes})
        for problem in (error, *error.others):
            problem.field = (
                f"vary.{problem.field}" if problem.field == axis.path else f"vary.{axis.path}: {problem.field}"
            )
        raise
