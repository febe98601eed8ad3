"""The value of a field at which a limit is just met: the question of a run turned round.

The range of the field is scanned at some values, both signs of the motion at each. Between neighbours of which one
meets the limit and the other does not, the crossing is closed in: by a straight line between the logarithms of their
results (Illinois's rule, Dowell and Jarratt 1971), by halves where there is no result. How far the result may be off by
its evidence is carried over to the field by the slope of the curve there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from heeltoe.case.model import Case
from heeltoe.case.paths import bounds_of, quantity_of, value_of
from heeltoe.case.read import Source, read_case
from heeltoe.case.warnings import drawing_text
from heeltoe.errors.error import InputError, shown
from heeltoe.models.cost import Cost
from heeltoe.models.run import AUTO, check_model, models_of, run, wish_cost
from heeltoe.result.judge import LIMITS
from heeltoe.result.response import Response
from heeltoe.study.plan.axes import Axis
from heeltoe.study.small.solved import Crossing, Point, Solved
from heeltoe.units.parse import DIMENSIONS, parse, parse_acceleration

Progress = Callable[[str], None]
#: Limits of a case that are lengths.
_LENGTHS = tuple(name for name, limit in LIMITS.items() if limit.unit == "m" and name != "opening")

#: Values at which a range is looked at, and the widest bracket of a crossing as a part of the range.
SCANNED, _CLOSE = 9, 2e-4
# Runs that usually close in a crossing.
_CLOSING = 7
#: More runs than these close in no crossing: it is a jump.
_MOST = 24
# A result that falls and rises again by more than this part of the largest is not monotonic.
_SAME_WAY = 0.01
# The result of the last run, with its evidence, is this near to the limit, or the search is moved once.
_NEAR = 0.002
_LEAST_M = 1e-6


def solve(
    source: Case | Source,
    field: str,
    until: str,
    *,
    model: str = AUTO,
    between: tuple[object, object] | None = None,
    progress: Progress = lambda text: None,
) -> Solved:
    """Return the value of a field at which a limit is just met.

    Parameters
    ----------
    source
        The dam and its motion: a case, or what :func:`heeltoe.read_case` takes.
    field
        Path of a field that holds a number: ``"crack.friction"``, ``"reservoir.depth"``, ``"motion.pga"``.
    until
        A limit of the case and what it allows: ``"residual_slip = 150 mm"``.
    model
        As :func:`heeltoe.run` takes it.
    between
        The ends of the range that is searched; where they are not given those of the field, or half to twice its value.
    progress
        Told what goes on.

    Raises
    ------
    InputError
        Where the field holds no number, the limit or the range cannot be understood, or the case cannot run.
    """
    case = source if isinstance(source, Case) else read_case(source)
    check_model(model, "model")
    limit, allowed = _limit_of(until)
    # The better model answers, without the block beside it.
    model = models_of(case, model)[0][-1]
    search = _Search(case.with_(f"limits={{{limit} = {_quoted(allowed)}}}"), field, limit, model, progress)
    low, high = search.range(between)
    scan = [point for value in np.linspace(low, high, SCANNED).tolist() if (point := search.at(value)) is not None]
    if len(scan) < 2:
        raise InputError("solve-range", field, f"{low:g} to {high:g} {search.unit}".strip())
    crossings = [
        search.crossing(first, second, (high - low) * _CLOSE)
        for first, second in pairwise(scan)
        if first.met != second.met
    ]
    quantity = search.axis.quantity or "number"
    return Solved(
        title=case.title,
        model=model,
        field=field,
        quantity=quantity,
        unit=DIMENSIONS[quantity].unit,
        limit=limit,
        allowed_m=allowed,
        crossings=tuple(crossings),
        one_way=_goes_one_way(scan),
        points=tuple(sorted(search.points.values(), key=lambda point: point.value)),
        refused=tuple(search.refused),
        drawing=drawing_text(case),
    )


def search_cost(case: Case, model: str = AUTO) -> Cost | None:
    """Return about what a search with one crossing takes."""
    better = models_of(case, model)[0][-1]
    alone, whole = wish_cost(case.without_evidence(), better), wish_cost(case, better)
    return None if alone is None or whole is None else alone.times(SCANNED + _CLOSING) + whole


def _quoted(length_m: float) -> str:
    return f'"{length_m!r} m"'


def _limit_of(until: str) -> tuple[str, float]:
    """Return which limit a text names, and what it allows [m]."""
    name, equals, value = (part.strip() for part in until.partition("="))
    name = name.removeprefix("limits.").rstrip("<").strip()
    if not equals or name not in _LENGTHS:
        raise InputError(
            "not-a-choice", "--until", shown(until), choices=f"NAME = VALUE with one of {', '.join(_LENGTHS)}"
        )
    allowed = parse(value, "length", "--until")
    if allowed <= 0.0:
        raise InputError("out-of-range", "--until", value, bound="above 0")
    return name, allowed


def _goes_one_way(points: Sequence[Point]) -> bool:
    """Whether results only fall, or only rise, with the field; a dam that fails counts as infinitely far."""
    results = [math.inf if point.result_m is None else point.result_m for point in points]
    finite = [result for result in results if math.isfinite(result)]
    least = max(_SAME_WAY * max(finite, default=0.0), _LEAST_M)
    steps = [0.0 if first == second else second - first for first, second in pairwise(results)]
    return not (any(step > least for step in steps) and any(step < -least for step in steps))


class _Search:
    """Runs a case at values of a field, each once."""

    def __init__(self, case: Case, field: str, limit: str, model: str, progress: Progress) -> None:
        self.case, self.field, self.limit, self.model, self.progress = case, field, limit, model, progress
        quantity = quantity_of(field)
        if quantity is None:
            try:
                case.with_({field: 1.0})
            except InputError as error:
                # A field that is not there is named with what is near.
                if error.code == "unknown-field":
                    raise
            raise InputError("solve-field", field)
        self.axis = Axis(field, quantity, (), None)
        self.unit = DIMENSIONS[quantity].unit
        self.points: dict[float, Point] = {}
        self.refused: list[float] = []
        # By how much the results with evidence differ from those without [m].
        self.shift = 0.0

    def range(self, between: tuple[object, object] | None) -> tuple[float, float]:
        """Return the ends of the range, SI."""
        if between is not None:
            low, high = (self._number(end) for end in between)
            if not low < high:
                raise InputError(
                    "wrong-quantity",
                    "--between",
                    shown(list(map(str, between))),
                    kind="a range, LOW,HIGH with the lower end first",
                    example="0.6,1.2",
                )
            return low, high
        bounds = dict(bounds_of(self.field)) if "[" not in self.field else {}
        lowest, highest = bounds.get("ge", bounds.get("gt")), bounds.get("le", bounds.get("lt"))
        if lowest == 0.0 and highest == 1.0:
            return 0.0, 1.0
        value = value_of(self.case, self.field)
        base = None if value is None else value.si(self.case.gravity) if hasattr(value, "si") else float(value)
        if not base or base < 0.0:
            raise InputError("solve-no-range", self.field)
        return base / 2.0, 2.0 * base

    def _number(self, value: object) -> float:
        if self.axis.quantity == "acceleration":
            return parse_acceleration(value, "--between").si(self.case.gravity)
        return parse(value, self.axis.quantity or "number", "--between")

    def at(self, value: float, *, evidence: bool = False) -> Point | None:
        """Return what a value does; None where the case refuses it."""
        if value in self.points and not evidence:
            return self.points[value]
        written = f"{value:.6g} {self.unit}".strip()
        self.progress(f"{self.field} = {written}{', with its evidence' * evidence}, run {len(self.points) + 1}")
        try:
            case = self.case.with_(self.axis.changes(float(value)))
        except InputError:
            self.refused.append(value)
            return None
        response = run(case if evidence else case.without_evidence(), self.model)
        point = _point(value, response, self.limit, 0.0 if evidence else self.shift)
        self.points[value] = point
        return point

    def crossing(self, first: Point, second: Point, close: float) -> Crossing:
        """Close in a crossing between two values; `close` is the widest bracket, SI."""
        met, missed = self._closed(first, second, close)
        last = self.at(met.value, evidence=True)
        assert last is not None
        if last.result_m is not None and met.result_m is not None:
            allowed = self.case.limits and getattr(self.case.limits, self.limit)
            off = last.result_m - met.result_m
            if allowed and abs(off) > _NEAR * allowed:
                # Without evidence the results are off by this much here: the search is moved by it.
                self.shift = off
                self.points = {value: self._shifted(point, off) for value, point in self.points.items()}
                ends = [self.points[end.value] for end in (first, second)]
                if ends[0].met != ends[1].met:
                    met, missed = self._closed(ends[0], ends[1], close)
                    last = self.at(met.value, evidence=True)
                    assert last is not None
        low, high = first.value, second.value
        about = [point for point in self.points.values() if low <= point.value <= high]
        give = _give(met, missed, last, about)
        return Crossing(value=met.value, give_or_take=give, met_at=met.value, missed_at=missed.value, last=last)

    def _shifted(self, point: Point, off: float) -> Point:
        if point.result_m is None or point.uncertainty_m:
            return point
        allowed = getattr(self.case.limits, self.limit)
        result = max(point.result_m + off, 0.0)
        return replace(point, result_m=result, met=result <= allowed)

    def _closed(self, first: Point, second: Point, close: float) -> tuple[Point, Point]:
        """Return the ends of a narrow bracket: where the limit is met, and where not."""
        ends, kept = [first, second], -1
        heights = [self._height(first), self._height(second)]
        for _ in range(_MOST):
            if abs(ends[1].value - ends[0].value) <= close:
                break
            point = self.at(_between(ends, heights, close))
            if point is None:
                break
            moved = 0 if point.met == ends[0].met else 1
            ends[moved], heights[moved] = point, self._height(point)
            # Illinois: an end that stays twice counts half, so that both ends move.
            if kept == 1 - moved and math.isfinite(heights[kept]):
                heights[kept] /= 2.0
            kept = 1 - moved
        met, missed = sorted(ends, key=lambda point: not point.met)
        return met, missed

    def _height(self, point: Point) -> float:
        """Return the logarithm of a result over the limit; infinite where there is none."""
        if point.result_m is None:
            return math.inf
        return math.log(max(point.result_m, _LEAST_M) / getattr(self.case.limits, self.limit))


def _between(ends: Sequence[Point], heights: Sequence[float], close: float) -> float:
    """Return where to look next in a bracket: never so near to an end that it is not narrow afterwards."""
    low, high = ends[0].value, ends[1].value
    if not all(map(math.isfinite, heights)) or heights[0] == heights[1]:
        return (low + high) / 2.0
    share = heights[0] / (heights[0] - heights[1])
    edge = min(0.5, 0.9 * close / (high - low))
    return low + min(max(share, edge), 1.0 - edge) * (high - low)


def _give(met: Point, missed: Point, last: Point, points: Sequence[Point]) -> float | None:
    """Return how far a crossing may be off: the bracket, and the evidence by the slope over the runs about it; None
    where the result jumps from below the limit to a dam that fails."""
    known = [point for point in points if point.result_m is not None]
    if missed.result_m is None or len(known) < 2:
        return None
    ends = min(known, key=lambda point: point.value), max(known, key=lambda point: point.value)
    rise = abs((ends[1].result_m or 0.0) - (ends[0].result_m or 0.0))
    if rise <= _LEAST_M:
        return None
    return abs(missed.value - met.value) + last.uncertainty_m * (ends[1].value - ends[0].value) / rise


def _point(value: float, response: Response, limit: str, shift: float) -> Point:
    """Return what a response says of a value."""
    checks = [check for check in response.limits if check.name == limit]
    check = max(checks, key=lambda check: check.value or 0.0, default=None)
    sign = next((way.sign for way in response.signs if way.governs), "")
    if check is None or check.failed or check.value is None:
        return Point(value=value, result_m=None, met=False, sign=sign, outcome=response.outcome)
    result = max(check.value + shift, 0.0)
    return Point(
        value=value,
        result_m=result,
        uncertainty_m=check.uncertainty,
        met=result <= check.allowed,
        sign=sign,
        outcome=response.outcome,
    )
