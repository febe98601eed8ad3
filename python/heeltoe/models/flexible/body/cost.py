"""What elastic parts take, estimated before they are made: time on one core, and memory.

A part of the dam has d degrees of freedom in its mesh, m modes and k nodes on the crack. Its modes cost d m, the search
for the equilibrium of the dam k^3. The factors were measured on one core at some 3 GHz with meshes of 2 to 64
elements across; tests/models/flexible/test_cost.py measures again. Both numbers are good within a factor of three."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.models.flexible.body.modes import FIRST_KEPT
from heeltoe.models.flexible.mesh.rows import ROWS

# Seconds of the equations of a dam, of each d m and of each k^3 of them.
_SET_UP, _SOLVED, _RESTED = 0.15, 8e-7, 2e-6
# Of the modes of a body with waves: water with sound on one side; rock takes as long as so many of them.
_WAVES, _ROCK = 0.45, 4
# Seconds of each d^3 and copies of d^2 numbers where all modes are wanted.
_DENSE, _DENSE_COPIES = 2e-9, 4.0
# Copies of the d m numbers of the modes that are there at once, and their bytes.
_COPIES, NUMBER = 7.0, 8.0
_TIMES = ((86400.0, "days"), (3600.0, "h"), (60.0, "min"), (1.0, "s"))
# A limit that is proposed, over what is estimated.
_GENEROUS = 1.1


@dataclass(frozen=True)
class Cost:
    """Time on one core [s] and memory [B]."""

    seconds: float
    memory: float

    def __add__(self, other: Cost) -> Cost:
        """Return what both cost, one after the other."""
        return Cost(self.seconds + other.seconds, max(self.memory, other.memory))

    def within(self, case: Case) -> bool:
        """Whether a case allows that."""
        return self.seconds <= case.analysis.time_limit and self.memory <= case.analysis.memory_limit


@dataclass(frozen=True)
class Part:
    """Degrees of freedom, modes and crack nodes of a part."""

    freedoms: float
    nodes: int
    kept: int

    @property
    def modes(self) -> float:
        """With the static shapes of the crack."""
        return min(self.freedoms, self.kept + 2.0 * self.nodes + 6.0)

    @property
    def cost(self) -> Cost:
        """Of its modes."""
        numbers = self.freedoms * self.modes
        seconds, memory = _SOLVED * numbers, _COPIES * numbers
        if 3.0 * self.kept >= self.freedoms:
            seconds, memory = seconds + _DENSE * self.freedoms**3, memory + _DENSE_COPIES * self.freedoms**2
        return Cost(seconds, NUMBER * memory)


# Nodes for each element along a crack that is finer than the rest, in the rows that grow away from it.
_GRADED = 25.0


def part_of(case: Case, nodes: int, freedoms: float | None = None) -> Part:
    """Return a part with so many nodes along its crack; with the program's own mesh if nothing else is said."""
    across = (nodes - 1) / 2.0
    away = min(across, case.flexible.elements_away or across)
    own = 2.0 * (3.0 * ROWS * away**2 + 5.0 * away + _GRADED * (across - away))
    return Part(freedoms or own, nodes, case.flexible.modes or FIRST_KEPT)


def parts_of(case: Case) -> list[Part]:
    """Return what the parts of a case will be, without their meshes."""
    options = case.flexible
    across = [options.elements_across] * (1 + len(case.further_cracks))
    lowest = min(case.crack.elevation, *(each.elevation for each in case.further_cracks), math.inf)
    if lowest > 0.0:
        across.append(options.elements_across_below or options.elements_across)
    # A part between two cracks has the nodes of both.
    both = [int(0 < place <= len(case.further_cracks)) for place in range(len(across))]
    return [part_of(case, (1 + twice) * (2 * each + 1)) for each, twice in zip(across, both, strict=True)]


def wave_bodies(case: Case) -> int:
    """Return how many bodies with waves surround a dam: water with sound on either side, and rock for several."""
    sides = sum(
        body is not None and body.compressible and body.depth > 0.0 for body in (case.reservoir, case.tailwater)
    )
    return sides + (0 if case.rock is None else _ROCK)


def building(parts: Sequence[Part], waves: int = 0) -> Cost:
    """Return what the equations of a dam cost, with so many bodies of :func:`wave_bodies` around it."""
    seconds = _SET_UP + _WAVES * waves + sum(part.cost.seconds for part in parts) + _RESTED * parts[0].nodes ** 3
    return Cost(seconds, sum(part.cost.memory for part in parts))


def check_cost(case: Case, cost: Cost, field: str | None = None) -> None:
    """Refuse what takes more than a case allows.

    Raises
    ------
    InputError
        Then; it names `field`, or what is the furthest from usual.
    """
    if cost.within(case):
        return
    limits = case.analysis
    more = [
        f'{name} = "{_two(_GENEROUS * value / factor)} {unit}"'
        for name, value, limit, factor, unit in (
            ("analysis.time_limit", cost.seconds, limits.time_limit, 60.0, "min"),
            ("analysis.memory_limit", cost.memory, limits.memory_limit, 1e9, "GB"),
        )
        if value > limit
    ]
    raise InputError("too-costly", field or _driver(case), shown_cost(cost), allow=" and ".join(more))


def shown_cost(cost: Cost) -> str:
    """Return a cost in words."""
    factor, unit = next(each for each in _TIMES if cost.seconds >= 1.5 * each[0] or each[1] == "s")
    return f"{_two(max(cost.seconds / factor, 1.0))} {unit} and {_two(max(cost.memory / 1e9, 0.1))} GB"


def _two(value: float) -> str:
    """Return a number with two digits that count."""
    return f"{float(f'{value:.2g}'):.0f}" if 10.0 <= value < 1e6 else f"{value:.2g}"


def _driver(case: Case) -> str:
    """Return the field that makes most of the cost."""
    options = case.flexible
    duration = case.motion.duration if case.motion else None
    far = {
        "flexible.elements_across": max(options.elements_across, options.elements_across_below or 0) / 8.0,
        "flexible.modes": (options.modes or FIRST_KEPT) / 100.0,
        "flexible.time_step": 1e-4 / (options.time_step or 1e-4),
        "motion.duration": (duration or 60.0) / 60.0,
    }
    return max(far, key=lambda field: far[field])
