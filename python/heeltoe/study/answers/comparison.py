"""Measures of the strength of motions compared: how well each foretells the slip, and what it leaves unsaid.

Efficiency and sufficiency after Luco and Cornell (2007), on a straight line through the logarithms.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.blocks import Block, Number
from heeltoe.result.contract import JOINT_METER_M
from heeltoe.study.run.aggregate import SHAKEN, Walk

#: Fewer runs, or events, make no line.
_LEAST = 3
#: A logarithm that varies less does not vary.
_ALIKE = 1e-9


class TraitLine(Block):
    """How what a measure leaves over goes with a trait of the events."""

    slope: Annotated[float, Number("How what is left over goes with it.")]
    p: Annotated[float, Number("Probability of such a slope by chance.")]
    events: Annotated[int, Number("How many events that is from.")]


class MeasureFit(Block):
    """How well a measure of strength foretells a slip."""

    measure: Annotated[str, Number("Name of the measure.")]
    efficiency: Annotated[float, Number("Scatter of the slip's logarithm about the line: less is better.")]
    slope: Annotated[float | None, Number("Slope of the line.")]
    sufficiency: Annotated[
        Mapping[str, TraitLine | None],
        Number("Whether the measure says all of the motion that matters: for each trait, null where unknown."),
    ]


class Compared(Block):
    """Measures of strength compared, of one model."""

    runs: Annotated[int, Number("How many runs are behind the lines.")]
    at_rest: Annotated[int, Number("How many do not slide, and are left out.")]
    unknown: Annotated[int, Number("How many have no result.")]
    measures: Annotated[list[MeasureFit], Number("The measures, the most efficient first.")]


class Comparison:
    """Compares measures by the runs that slide more than a joint meter reads, taken in part by part.

    Parameters
    ----------
    events
        How many there are.
    """

    def __init__(self, events: int) -> None:
        self._events = events
        self._at_rest = self._unknown = 0
        self._runs = np.zeros(events)
        self._demand, self._square = np.zeros(events), 0.0
        self._strength: dict[str, _Sums] = {}
        self._trait: dict[str, Floats] = {}

    def add(
        self, strengths: Mapping[str, Floats], demand: Floats, event: Integers, traits: Mapping[str, Floats]
    ) -> None:
        """Take in some runs.

        Parameters
        ----------
        strengths
            (n,) of the motion of each run, by measure.
        demand
            (n,) slip of each run [m], without sign; not a number where a run has no result.
        event
            (n,) which runs belong together.
        traits
            (n,) what else is known of the motion of each run, by name; not a number where it is not known.
        """
        slides = demand > JOINT_METER_M  # not a number is not
        unknown = int(np.isnan(demand).sum())
        self._unknown += unknown
        self._at_rest += demand.size - int(slides.sum()) - unknown
        which, y = event[slides], np.log(demand[slides] / JOINT_METER_M)
        self._runs += np.bincount(which, minlength=self._events)
        self._demand += np.bincount(which, y, self._events)
        self._square += float(y @ y)
        for name, strength in strengths.items():
            x = np.log(strength[slides])
            self._strength.setdefault(name, _Sums(self._events)).add(x, y, which)
        for name, values in traits.items():
            added = np.bincount(which, values[slides], self._events)
            self._trait[name] = self._trait.get(name, np.zeros(self._events)) + added

    def found(self) -> Compared:
        """Return what has been found.

        Runs of one event are no independent witnesses: what the line leaves over is held against a trait event by
        event, by their means.
        """
        count = int(self._runs.sum())
        none = Compared(runs=count, at_rest=self._at_rest, unknown=self._unknown, measures=[])
        if count < _LEAST:
            return none
        ran = self._runs > 0.0
        runs = self._runs[ran]
        events = {name: values[ran] / runs for name, values in self._trait.items()}
        mean = self._demand.sum() / count
        scatter = self._square - count * mean**2
        measures = []
        for name, sums in self._strength.items():
            middle = sums.by_event.sum() / count
            square, both = sums.square - count * middle**2, sums.both - count * middle * mean
            varies = square > count * _ALIKE**2
            slope = float(both / square) if varies else None
            left = scatter - (slope or 0.0) * both
            over = self._demand[ran] / runs - mean - (slope or 0.0) * (sums.by_event[ran] / runs - middle)
            measures.append(
                MeasureFit(
                    measure=name,
                    efficiency=float(np.sqrt(max(left, 0.0) / (count - (2 if varies else 1)))),
                    slope=slope,
                    sufficiency={trait: _line(values, over) for trait, values in events.items()},
                )
            )
        return replace(none, measures=sorted(measures, key=lambda measure: measure.efficiency))


class _Sums:
    """Sums of the logarithms of a measure, less the first of them: where the measure does not vary, rounding leaves
    nothing."""

    def __init__(self, events: int) -> None:
        self._first: float | None = None
        self.by_event, self.square, self.both = np.zeros(events), 0.0, 0.0

    def add(self, x: Floats, y: Floats, event: Integers) -> None:
        if x.size and self._first is None:
            self._first = float(x[0])
        x = x - (self._first or 0.0)
        self.by_event += np.bincount(event, x, self.by_event.size)
        self.square += float(x @ x)
        self.both += float(x @ y)


def compared(walk: Walk, demand: str) -> dict[str, Compared]:
    """Compare measures of the strength of motions by how well they foretell a slip of the table, for each model."""
    motions = walk.manifest["motions"]
    comparisons = {model: Comparison(len(walk.manifest["events"])) for model in walk.models}
    traits = {
        name: np.array([motion["traits"][name] for motion in motions], dtype=np.float64)
        for name in motions[0].get("traits", ())
    }
    for runs in walk("model", "event", *SHAKEN, demand):
        values, model, event = np.abs(runs.numbers(demand)), runs.model, runs.event
        strengths = {name: runs.strength(name) for name in motions[0]["measures"]}
        known = {name: trait[runs.motion] for name, trait in traits.items()}
        for place, name in enumerate(walk.models):
            here = model == place
            comparisons[name].add(
                {key: strength[here] for key, strength in strengths.items()},
                values[here],
                event[here],
                {key: trait[here] for key, trait in known.items()},
            )
    return {name: comparison.found() for name, comparison in comparisons.items()}


def _line(trait: Floats, over: Floats) -> TraitLine | None:
    """Return slope and p-value of a line; None where too few events tell of one."""
    from scipy import stats

    known = np.isfinite(trait)
    if known.sum() < _LEAST or np.ptp(trait[known]) <= 1e-9:
        return None
    line = stats.linregress(trait[known], over[known])
    return TraitLine(slope=float(line.slope), p=float(line.pvalue), events=int(known.sum()))
