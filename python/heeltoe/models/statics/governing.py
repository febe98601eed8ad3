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


def _eccentricity(found: LoadCase) -> float:
    return math.inf if found.eccentricity_m is None else abs(found.eccentricity_m) / found.contact_width_m


def _stress(found: LoadCase) -> float:
    if found.heel_stress_pa is None or found.toe_stress_pa is None:
        return math.inf
    return max(found.heel_stress_pa, found.toe_stress_pa)


# What is the worse the larger it is, by the names of the checks.
_WORSE: dict[str, Callable[[LoadCase], float]] = {
    "equilibrium": lambda found: float(_OUTCOMES.index(found.outcome)),
    "sliding factor": lambda found: _smallest(found.sliding_factor),
    "overturning factor": lambda found: _smallest(found.overturning_factor),
    "flotation factor": lambda found: _smallest(found.flotation_factor),
    "resultant": _eccentricity,
    "compression": _stress,
}


def governing(tried: Sequence[Solved]) -> tuple[Solved, ...]:
    """Return the same load cases, each with the checks that it governs: those of which it is the worst, the first of
    them where several are as bad."""
    governed: list[list[str]] = [[] for _ in tried]
    for name, worse in _WORSE.items():
        values = [worse(each.load_case) for each in tried]
        governed[values.index(max(values))].append(name)
    return tuple(
        replace(each, load_case=replace(each.load_case, governs=tuple(names)))
        for each, names in zip(tried, governed, strict=True)
    )
