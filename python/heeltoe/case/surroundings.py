"""Rock and water around an elastic dam: those of the case, or what is assumed where it says nothing.

A rigid plane below and water without sound carry nothing away of the vibration that sliding feeds, so that both have to
be chosen (docs/sliding-that-feeds-itself.md)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import shapely

from heeltoe.base.arrays import Floats
from heeltoe.case.combinations import Featured, misfit
from heeltoe.case.dam import Concrete, Reservoir, Rock, Water
from heeltoe.geometry.section import CutSection

#: A crack on rock rises by so much of its width at most.
LEVEL = 1e-6


class Cracked(Protocol):
    """A case with one crack."""

    @property
    def cut(self) -> CutSection: ...
    @property
    def crack_line(self) -> Floats: ...


class Standing(Featured, Protocol):
    """A case that stands on rock."""

    @property
    def concrete(self) -> Concrete: ...
    @property
    def rock(self) -> Rock | str | None: ...
    @property
    def reservoir(self) -> Reservoir | None: ...
    @property
    def tailwater(self) -> Water | None: ...
    @property
    def outline(self) -> shapely.Polygon: ...
    @property
    def single_crack_cases(self) -> Sequence[Cracked]: ...


@dataclass(frozen=True)
class Surroundings:
    """Rock and water around an elastic dam.

    Attributes
    ----------
    rock
        Below it; None for a rigid plane.
    assumed
        Whether the case says nothing of its rock, and has this one with the modulus of its concrete.
    sound
        On which sides sound travels in the water: ``"reservoir"``, ``"tailwater"``.
    rigid_since, mass_since
        Why nothing else than a rigid plane, and than water as a mass, could be assumed; empty where it could, or the
        case says so.
    """

    rock: Rock | None
    assumed: bool
    sound: frozenset[str]
    rigid_since: str
    mass_since: str


def surroundings_of(case: Standing) -> Surroundings:
    """Return what is around the dam of a case."""
    rock, assumed, rigid_since = case.rock, False, ""
    # A dam without a modulus can only be a rigid block, which has no waves around it.
    elastic = case.concrete.modulus is not None
    if rock is None and elastic:
        rigid_since = misfit(case, "elastic rock") or _uneven(case)
        assumed = not rigid_since
        if assumed:
            # Concrete may be softer or stiffer than any rock, which other warnings say.
            rock = Rock.model_validate({"modulus": "20 GPa"}).model_copy(update={"modulus": case.concrete.modulus})
    waters: dict[str, Water | Reservoir | None] = {"reservoir": case.reservoir, "tailwater": case.tailwater}
    unsaid = [side for side, water in waters.items() if elastic and water is not None and water.compressible is None]
    mass_since = misfit(case, "compressible water") if unsaid else ""
    sound = [side for side, water in waters.items() if water is not None and water.compressible]
    return Surroundings(
        rock=rock if isinstance(rock, Rock) else None,
        assumed=assumed,
        sound=frozenset([*sound, *([] if mass_since else unsaid)]),
        rigid_since=rigid_since,
        mass_since=mass_since,
    )


def _uneven(case: Standing) -> str:
    """Say that a dam is cracked along its base and that this is not level; nothing of one that may stand on rock."""
    lowest = case.single_crack_cases[-1]
    if case.outline.area - lowest.cut.area > 1e-9 * case.outline.area:
        return ""
    line = lowest.crack_line
    rises = float(np.ptp(line[:, 1])) > LEVEL * lowest.cut.crack_width
    return "its crack on the rock is not level" if rises else ""
