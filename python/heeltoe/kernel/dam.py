"""An elastic dam cut by a crack: how it is run, what it did."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from heeltoe.base.arrays import Floats
from heeltoe.kernel import _kernel
from heeltoe.kernel.friction import FrictionLaw

if TYPE_CHECKING:
    from heeltoe.kernel._kernel import ReducedBody

#: Names of what an elastic dam does, how its run ends, and what the nodes of its crack do.
DAM_STATES = tuple(_kernel.CRACK_STATES)
DAM_OUTCOMES = tuple(_kernel.CRACK_OUTCOMES)
CONTACT_STATUSES = tuple(_kernel.CONTACT_STATUSES)
#: The dam for the kernel, its state before the earthquake, and what its runs return.
CrackedDam = _kernel.CrackedDam
AtRest = _kernel.AtRest
DamRun = _kernel.DamRun
DamSummary = _kernel.DamSummary
StressExtremes = _kernel.StressExtremes
#: What ends runs on other threads than the main one.
Ending = _kernel.Ending


@dataclass(frozen=True, eq=False)
class FollowingWater:
    """Water in a crack whose pressure changes as the crack opens.

    Attributes
    ----------
    law
        A choice of ``uplift.during_shaking`` other than "constant".
    opening
        Over which it changes [m].
    still, full
        Forces of each node of the upper and, if there is one, of the lower face, across the crack, positive away from
        the lower part: at the static pressure and at that of the reservoir at the heel, (k,) each [N].
    """

    law: str
    opening: float
    still: tuple[Floats, ...]
    full: tuple[Floats, ...]


@dataclass(frozen=True)
class CrackAnchor:
    """An anchor with stiffness where it crosses a crack.

    Attributes
    ----------
    anchor
        Which anchor of the dam: one that crosses several cracks has one tension, by its elongation at all of them.
    points
        Where it crosses the upper and, if there is one, the lower face: nodes of the face from 0 with their shares.
    axis
        Direction along and across the crack.
    prestress, axial_stiffness, shear_stiffness
        Tension at the start [N], what it gains by opening along its axis and resistance by slip [N/m].
    capacity
        Force that it is good for [N], infinite where nothing says so; it bears more all the same.
    """

    anchor: int
    points: tuple[tuple[tuple[int, float], ...], ...]
    axis: tuple[float, float]
    prestress: float
    axial_stiffness: float
    shear_stiffness: float
    capacity: float = math.inf


@dataclass(frozen=True)
class CrackLine:
    """A crack.

    Attributes
    ----------
    upper, lower
        First and number of the nodes of either face, among those of the part above and of the part below; (0, 0) for a
        rigid plane.
    friction
        Coefficients at rest and sliding.
    give
        Rotation [rad] and gap [m] of the faces that elastic deformation alone accounts for.
    law
        A friction law in place of the coefficients.
    angles
        Of the segments of the upper and of the lower face to the line from heel to toe [rad]; none of a straight crack.
    bond
        Of a bonded joint: tensile strength and cohesion [Pa], energies of opening and of shear [J/m2], the factor on
        both strengths during the earthquake, and the share of the energies that belongs to the first line of softening.
    water, anchors
        What acts in it beside contact: water whose pressure changes as it opens, anchors with stiffness.
    """

    upper: tuple[int, int]
    lower: tuple[int, int]
    friction: tuple[float, float]
    give: tuple[float, float] = (0.0, 0.0)
    law: FrictionLaw | None = None
    angles: tuple[list[float], list[float]] = ([], [])
    bond: tuple[float, float, float, float, float, float] | None = None
    water: FollowingWater | None = None
    anchors: tuple[CrackAnchor, ...] = ()


def only_crack(
    parts: Sequence[ReducedBody],
    friction: tuple[float, float],
    give: tuple[float, float] = (0.0, 0.0),
    law: FrictionLaw | None = None,
) -> tuple[CrackLine, ...]:
    """Return the crack between two parts that have no other, or below the only part."""
    above, *below = (part.position.size // 2 for part in parts)
    return (CrackLine((0, above), (0, sum(below)), friction, give, law),)


@dataclass(frozen=True, eq=False)
class RisingWater:
    """Water in a crack whose pressure changes with time.

    Attributes
    ----------
    crack
        Which one, from the crest down.
    span
        From when to when it changes, evenly [s].
    change
        By how much the forces of the nodes of the upper and, if there is one, of the lower face change across the
        crack, (k,) each [N].
    """

    crack: int
    span: tuple[float, float]
    change: tuple[Floats, ...]
