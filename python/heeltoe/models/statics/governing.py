"""Which of several load cases governs which check: the two signs of a vertical seismic coefficient."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from heeltoe.models.statics.load_case import LoadCase, Solved

_OUTCOMES = ("stands", "cracks through", "floats")


def _smallest(value: float | None) -> float:
    """Return what grows as a factor falls; nothing that pushes is nothing to fear."""
    return -math.inf if value is None else -value


def _eccentricity(load_case: LoadCase) -> float:
    return math.inf if load_case.eccentricity_m is None else abs(load_case.eccentricity_m) / load_case.contact_width_m


def _stress(load_case: LoadCase) -> float:
    if load_case.heel_stress_pa is None or load_case.toe_stress_pa is None:
        return math.inf
    return max(load_case.heel_stress_pa, load_case.toe_stress_pa)


# What is the worse the larger it is, by the names of the checks.
_WORSE: dict[str, Callable[[LoadCase], float]] = {
    "equilibrium": lambda load_case: float(_OUTCOMES.index(load_case.outcome)),
    "sliding factor": lambda load_case: _smallest(load_case.sliding_factor),
    "overturning factor": lambda load_case: _smallest(load_case.overturning_factor),
    "flotation factor": lambda load_case: _smallest(load_case.flotation_factor),
    "resultant": _eccentricity,
    "compression": _stress,
}


def governing(tried: Sequence[Solved]) -> tuple[Solved, ...]:
    """Return the same load cases, each with the checks that it governs: those of which it is the worst, the first of
    them where several are as bad."""
    governed: list[list[str]] = [[] for _ in tried]
    for name, worse in _WORSE.items():
        values = [worse(solved.load_case) for solved in tried]
        governed[values.index(max(values))].append(name)
    return tuple(
        replace(solved, load_case=replace(solved.load_case, governs=tuple(names)))
        for solved, names in zip(tried, governed, strict=True)
    )
