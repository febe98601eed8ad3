"""Cost of elastic parts, estimated before they are made: time on one core, and memory.

A part of the dam has d degrees of freedom in its mesh, m modes and k nodes on the crack. Its modes cost d m, the search
for the equilibrium of the dam k^3. The factors were measured on one core at some 3 GHz with meshes of 2 to 64
elements across; tests/models/flexible/test_cost.py measures again. Times are good within a factor of three, memory
within two; it is what comes on top of what the program and its libraries take themselves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import shapely

from heeltoe.case.dam import Rock, Water
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.beam import band_of
from heeltoe.models.cost import NOTHING, Cost, two_digits
from heeltoe.models.flexible.body.modes import FIRST_KEPT
from heeltoe.models.flexible.mesh.rows import ROWS

# Seconds of the equations of a dam, of each d m and of each k^3 of them.
_SET_UP, _SOLVED, _RESTED = 0.15, 8e-7, 2e-6
# Seconds and bytes of the modes of water with sound on one side, and bytes for each period of the highest frequency
# that sound takes through its depth: the deeper, the more of its resonances are below it, and each has samples of its
# own.
_WATER, _WATER_BY_DEPTH = (0.35, 1.3e7), 1.6e7
# The same of rock with n elements along its base, of n^2.5 and of n^2: measured with 8 to 24, for waves as for a fine
# mesh. Each step takes as long as with so many bodies of water.
_ROCK, _ROCK_ACROSS, _ROCK_STEPS = (0.4, 2.3e7), (1.8e-3, 3.6e5), 4
# Seconds of each d^3 where all modes are wanted: 0.12 s of 710, 0.9 s of 1,570 degrees of freedom.
_DENSE = 3e-10
# Copies of the d m numbers of the modes of a part: while some or all of them are solved, and after that; the bytes of a
# number.
_SOLVING, _SOLVING_ALL, _KEPT, NUMBER = 8.5, 3.0, 2.5, 8.0
# Bytes of whatever there is beside.
_BESIDE = 2e6
# A part that is lower has so many rows less, of each element across, for each of its heights over its widths.
_FLAT, _FLATTEST = 1.5, 0.15
# A limit that is proposed, over what is estimated.
_GENEROUS = 1.1


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
        """Cost of the modes of the part."""
        numbers = self.freedoms * self.modes
        dense = 3.0 * self.kept >= self.freedoms
        seconds = _DENSE * self.freedoms**3 if dense else _SOLVED * numbers
        return Cost(seconds, NUMBER * (_SOLVING_ALL if dense else _SOLVING) * numbers)

    @property
    def kept_memory(self) -> float:
        """Memory of the modes once they are known [B]."""
        return NUMBER * _KEPT * self.freedoms * self.modes


# Nodes for each element along a crack that is finer than the rest, in the rows that grow away from it.
_GRADED = 25.0


def part_of(
    case: Case, nodes: int, freedoms: float | None = None, *, cracks: int = 1, slenderness: float = math.inf
) -> Part:
    """Return a part with a number of nodes along its one or two cracks; by default with the program's own mesh, for
    which `slenderness` is its height over its width."""
    across = round((nodes / cracks - 1) / 2.0)
    away, _ = case.flexible.halved(across)
    rows = min(ROWS, _FLAT * slenderness)
    own = 2.0 * (3.0 * rows * away**2 + 5.0 * away + cracks * _GRADED * (across - away))
    return Part(freedoms or own, nodes, case.flexible.modes or FIRST_KEPT)


def parts_of(case: Case) -> list[Part]:
    """Return what the parts of a case will be, without their meshes, from the crest down."""
    options = case.flexible
    levels = sorted((crack.elevation for crack in (case.crack, *case.further_cracks)), reverse=True)
    held = [0.0] if levels[-1] > 0.0 else []
    parts = []
    left, base, right, crest = case.outline.bounds
    for place, (top, foot) in enumerate(pairwise([crest - base, *levels, *held])):
        last = place == len(levels)
        across = (options.elements_across_below if last else None) or options.elements_across
        # A part between two cracks has the nodes of both.
        cracks = 2 if 0 < place < len(levels) else 1
        line = shapely.LineString([(left - 1.0, base + foot), (right + 1.0, base + foot)])
        width = case.outline.intersection(line).length
        slenderness = max((top - foot) / width, _FLATTEST) if width > 0.0 else math.inf
        parts.append(part_of(case, cracks * (2 * across + 1), cracks=cracks, slenderness=slenderness))
    return parts


def wave_bodies(case: Case) -> int:
    """Return how many bodies with waves surround a dam: water with sound on either side, and rock for several."""
    return len(_waters(case)) + (0 if case.foundation is None else _ROCK_STEPS)


def surroundings_of(case: Case) -> Cost:
    """Return what the modes of the bodies with waves around a dam cost."""
    cost = Cost(0.0, 0.0)
    for water in _waters(case):
        periods = band_of(case) * water.depth / water.wave_speed
        cost += Cost(_WATER[0], _WATER[1] + _WATER_BY_DEPTH * periods)
    if case.foundation is not None:
        across = float(_rock_elements(case, case.foundation))
        cost += Cost(_ROCK[0] + _ROCK_ACROSS[0] * across**2.5, _ROCK[1] + _ROCK_ACROSS[1] * across**2)
    return cost


def _rock_elements(case: Case, rock: Rock) -> int:
    """Return how many elements there are along the base of the rock."""
    from heeltoe.models.flexible.surroundings.rock import BEYOND, RockMaterial, base_elements, halvings

    left, base, right, _ = case.outline.bounds
    width = case.outline.intersection(shapely.LineString([(left, base), (right, base)])).length
    at_base = min(crack.elevation for crack in (case.crack, *case.further_cracks)) == 0.0
    across = (None if at_base else case.flexible.elements_across_below) or case.flexible.elements_across
    across *= 2 ** halvings(across)
    edges = across + 2 * BEYOND if at_base else across
    material = RockMaterial(rock.modulus, rock.poisson, rock.density)
    return base_elements(edges, width * edges / across, material, band_of(case))


def _waters(case: Case) -> list[Water]:
    sides = {"reservoir": case.reservoir, "tailwater": case.tailwater}
    return [body for side, body in sides.items() if body is not None and case.has_sound(side) and body.depth > 0.0]


def building(parts: Sequence[Part], surroundings: Cost = NOTHING) -> Cost:
    """Return what the equations of a dam cost, with those of :func:`surroundings_of` it. One part is solved after the
    other, and what is around them after that."""
    costs = [part.cost for part in parts]
    seconds = _SET_UP + surroundings.seconds + sum(cost.seconds for cost in costs) + _RESTED * parts[0].nodes ** 3
    most = max(surroundings.memory, *(cost.memory for cost in costs))
    return Cost(seconds, _BESIDE + most + sum(part.kept_memory for part in parts))


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
        f'{name} = "{two_digits(_GENEROUS * value / factor)} {unit}"'
        for name, value, limit, factor, unit in (
            ("analysis.time_limit", cost.seconds, limits.time_limit, 60.0, "min"),
            ("analysis.memory_limit", cost.memory, limits.memory_limit, 1e9, "GB"),
        )
        if value > limit
    ]
    raise InputError("too-costly", field or _driver(case), cost.shown(), allow=" and ".join(more))


def _driver(case: Case) -> str:
    """Return the field that makes most of the cost."""
    options = case.flexible
    duration = case.motion.duration if case.motion else None
    rock = (
        0.0
        if case.foundation is None
        else _rock_elements(case, case.foundation) / max(24.0, options.elements_across + 2.0)
    )
    far = {
        "rock.modulus": rock,
        "flexible.elements_across": max(options.elements_across, options.elements_across_below or 0) / 8.0,
        "flexible.modes": (options.modes or FIRST_KEPT) / 100.0,
        "flexible.time_step": 1e-4 / (options.time_step or 1e-4),
        "motion.duration": (duration or 60.0) / 60.0,
    }
    return max(far, key=lambda field: far[field])
