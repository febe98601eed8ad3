"""The water in a crack for the static checks: where the crack opens its pressure changes.

A profile is an array of shape (k, 2): distance from the heel of the block along the crack [m], ascending, and pressure
[Pa], straight in between; twice the same distance is a jump.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.crack.kinks import climbs
from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.geometry.section import CutSection
from heeltoe.mechanics.block import across_crack
from heeltoe.mechanics.loads import in_crack, uplift_profile, water_above_crack

# Of a polynomial that follows what is smooth between two bends closely enough to tell where it turns.
_SMOOTH = 7


def force_and_moment(profile: Floats) -> tuple[float, float]:
    """Return the force of a profile on the block [N/m] and its moment about the heel, counter-clockwise [N m/m]."""
    x, pressure = profile.T
    length, middle, mean = np.diff(x), (x[:-1] + x[1:]) / 2.0, (pressure[:-1] + pressure[1:]) / 2.0
    # Simpson's rule, exact for the product of two straight lines.
    lever = (x[:-1] * pressure[:-1] + 4.0 * middle * mean + x[1:] * pressure[1:]) / 6.0
    return float(length @ mean), float(length @ lever)


def _on_pieces(case: Case, profile: Floats) -> tuple[float, float]:
    """Return the same of a pressure that is normal to each piece of a crack with kinks."""
    pressures = across_crack(in_crack(case, profile.tolist()), case.cut)
    return pressures.vertical, pressures.moment


def cut_out(profile: Floats, start: float, end: float) -> list[tuple[float, float]]:
    """Return the points of a profile from `start` to `end`, the pressures at both ends among them."""
    points: list[tuple[float, float]] = []
    for (x0, p0), (x1, p1) in zip(profile[:-1].tolist(), profile[1:].tolist(), strict=True):
        low, high = max(x0, start), min(x1, end)
        if x1 > x0 and high > low:
            slope = (p1 - p0) / (x1 - x0)
            points += [(low, p0 + slope * (low - x0)), (high, p1 - slope * (x1 - high))]
    return points


@dataclass(frozen=True, eq=False)
class StillWater:
    """The pressure in a crack as a function of how far it is open.

    Attributes
    ----------
    pressure
        Gives the profile over the whole base of the block for a length open from the heel and one from the toe [m],
        counted from the ends of the contact.
    places
        Distances from the heel at which the profile bends or jumps [m]: on a length of opening between two of them,
        force and moment are polynomials of it, or on a crack with kinks smooth.
    act
        Gives the force of a profile across the crack, from heel to toe, and its moment about the heel.
    degree
        Of the polynomial that tells where what the tip bears turns, between two places.
    """

    pressure: Callable[[float, float], Floats]
    places: tuple[float, ...]
    act: Callable[[Floats], tuple[float, float]] = force_and_moment
    degree: int = 3


def still_water(case: Case, start: float, end: float) -> StillWater:
    """Return the water at rest in a crack whose contact goes from `start` to `end` of the base of the block.

    Over the contact it is the case's uplift, with its pattern fitted to that length. What opens from the heel has the
    pressure of the reservoir over all of its area, whatever the intensity, and the rest of the pattern starts at the
    tip: from there straight to the next of its points (extent, drains or toe), so that drains which the crack has
    passed no longer count (so does USACE, EM 1110-2-2200, 1995, chapter 3). A profile of the user's own stays beyond
    the tip as it is. What opens from the toe has the pressure of the tailwater, in the same way. The base outside the
    contact, left there by a slip, feels reservoir and tailwater. With the pattern "none" no water enters.
    """
    section, dry = case.cut, case.uplift.pattern == "none"
    base = uplift_profile(case) * [(end - start) / section.crack_width, 1.0] + [start, 0.0]
    own = case.uplift.pattern == "profile"

    def outside(water: Water | None, low: float, high: float) -> list[tuple[float, float]]:
        """Return the points of free water under the block; none gets in where it does not reach the crack's end."""
        if high <= low:
            return []
        if dry or not water_above_crack(case, water, toe=water is case.tailwater):
            return [(low, 0.0), (high, 0.0)]
        # Where an inclined crack rises out of the water the pressure ends.
        surface = _surface(section, water)
        places = [low, surface, high] if low < surface < high else [low, high]
        return [(x, _pressure_at(case, water, x)) for x in places]

    def pressure(heel: float, toe: float) -> Floats:
        tip, back = start + heel, end - toe
        points = outside(case.reservoir, 0.0, tip)
        if own or dry:
            points += cut_out(base, tip, back)
        elif tip < back:
            ends = [float(base[0, 1]), float(base[-1, 1])]
            if heel > 0.0:
                ends[0] = case.uplift.intensity * _pressure_at(case, case.reservoir, tip)
            # A uniform pressure ends at the tip as it did at the toe: it knows no tailwater.
            if toe > 0.0 and case.uplift.pattern != "uniform":
                ends[1] = case.uplift.intensity * _pressure_at(case, case.tailwater, back)
            points += [(tip, ends[0]), *((x, p) for x, p in base.tolist() if tip < x < back), (back, ends[1])]
        points += outside(case.tailwater, back, section.crack_width)
        return np.array(points)

    bends = [float(x) for x in base[:, 0]]
    bends += [x for water in (case.reservoir, case.tailwater) if math.isfinite(x := _surface(section, water))]
    if not climbs(case.crack.kinks):
        return StillWater(pressure, tuple(bends))
    bends += [distance for distance, _ in case.crack.kinks]
    return StillWater(pressure, tuple(bends), partial(_on_pieces, case), _SMOOTH)


def water_in_earthquake(before: Floats, still: StillWater, opened: tuple[float, float], law: str) -> StillWater:
    """Return the water in a crack that the earthquake opens further.

    Parameters
    ----------
    before
        Profile before the earthquake.
    still
        Water that has had time to follow the opening.
    opened
        How far it was open before from the heel and from the toe [m]: the earthquake takes no water out of that.
    law
        What the pressure is in what the earthquake opens: "unchanged", "zero", or "full", at once that of free water.
    """
    # The earthquake finds the block on all of its base.
    start, end = 0.0, float(before[-1, 0])
    from_heel, from_toe = opened
    # A crack that the usual loads have opened through has no more to open.
    through = from_heel + from_toe >= end - start

    def pressure(heel: float, toe: float) -> Floats:
        if law == "unchanged" or through or (heel <= from_heel and toe <= from_toe):
            return before
        if law == "full":
            # Where new and old openings meet, the water of the heel has all of the crack.
            new_heel = max(heel, from_heel)
            return still.pressure(new_heel, min(max(toe, from_toe), end - start - new_heel))
        # The pressure vanishes between the old tip and the new one.
        low, high = (start + from_heel, start + heel) if heel > from_heel else (end - toe, end - from_toe)
        points = cut_out(before, 0.0, low)
        points += [(low, 0.0), (high, 0.0)]
        return np.array(points + cut_out(before, high, float(before[-1, 0])))

    places = (start + from_heel, end - from_toe, *still.places, *(float(x) for x in before[:, 0]))
    return replace(still, pressure=pressure, places=places)


def _level(section: CutSection, water: Water | None) -> float:
    """Return how high the water stands above the heel [m], negative below it."""
    return -math.inf if water is None else section.base_elevation + water.depth - section.heel[1]


def _pressure_at(case: Case, water: Water | None, x: float) -> float:
    """Return the pressure of still water at a distance from the heel along the crack [Pa]."""
    if water is None:
        return 0.0
    section = case.cut
    return water.density * case.gravity * max(0.0, _level(section, water) - x * math.sin(section.inclination))


def _surface(section: CutSection, water: Water | None) -> float:
    """Return at which distance from the heel an inclined crack meets the water surface [m]."""
    rise = math.sin(section.inclination)
    return _level(section, water) / rise if rise and water is not None else math.inf
