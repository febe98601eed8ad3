"""Each of several cracks by itself; anchors and drains that are given in the dam's coordinates, as a crack has them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import shapely

from heeltoe.arrays import number
from heeltoe.case.crack.kinks import straight_crack
from heeltoe.case.dam import STEEPEST_ANCHOR, Anchor, Uplift
from heeltoe.errors import InputError, shown
from heeltoe.geometry.crossing import Crossing, Place, crossing, head
from heeltoe.geometry.section import CutSection

if TYPE_CHECKING:
    from heeltoe.case.model import Case

# Cracks nearer to each other than this part of the height of the section leave no part of the dam between them.
_NEAREST = 1e-3


@dataclass(frozen=True)
class AnchorAtCrack:
    """An anchor as the crack has it; SI units, see :class:`heeltoe.case.dam.Anchor`.

    Attributes
    ----------
    distance
        From the heel along the crack.
    inclination
        To the normal of the crack, positive where its upper end leans downstream.
    prestress, axial_stiffness, shear_stiffness
        As given; nothing of one that does not cross the crack.
    capacity
        As given.
    """

    distance: float
    inclination: float
    prestress: float
    axial_stiffness: float
    shear_stiffness: float
    capacity: float | None


def anchor_at_crack(anchor: Anchor, section: CutSection) -> AnchorAtCrack:
    """Return an anchor as a crack has it."""
    found = crosses(anchor, section)
    given = (anchor.prestress, anchor.axial_stiffness, anchor.shear_stiffness)
    if found is None:
        assert anchor.distance is not None
        return AnchorAtCrack(anchor.distance, anchor.inclination, *given, anchor.capacity)
    distance, *forces = (number(np.where(found.there, each, 0.0)) for each in (found.distance, *given))
    if np.all(found.there):
        forces = list(given)
    return AnchorAtCrack(distance, _angle(found), forces[0], forces[1], forces[2], anchor.capacity)


def _angle(found: Crossing) -> float:
    # Cracks of columns have one inclination, as has the anchor.
    angles = np.unique(np.where(found.there, found.inclination, 0.0))
    return float(angles[np.abs(angles).argmax()])


def crosses(anchor: Anchor, section: CutSection) -> Crossing | None:
    """Return where an anchor that is given by its ends crosses the crack; None of one that is given on the crack."""
    if anchor.ends is None:
        return None
    (x, up), (foot_x, foot_up) = anchor.ends
    base = section.base_elevation
    return crossing(section, (x, base + up), (foot_x, base + foot_up))


def too_flat(anchor: Anchor, section: CutSection) -> bool:
    """Whether an anchor crosses the crack at too flat an angle."""
    found = crosses(anchor, section)
    return found is not None and abs(_angle(found)) > STEEPEST_ANCHOR


def flat(place: int, anchor: Anchor, section: CutSection) -> InputError:
    """Return what is to be said of such an anchor."""
    found = crosses(anchor, section)
    angle = 0.0 if found is None else math.degrees(abs(_angle(found)))
    most = f"{math.degrees(STEEPEST_ANCHOR):.3g} deg"
    return InputError("anchor-flat", f"anchors[{place}].foot_x", f"{angle:.3g} deg", most=most)


def uplift_at_crack(uplift: Uplift, section: CutSection) -> Uplift:
    """Return the uplift with its drains on the crack; as without drains where they do not cross it."""
    if uplift.drain_x is None:
        return uplift
    there, position = drains(uplift.drain_x, section)
    if not np.any(there):
        gone = dict.fromkeys(("drain_x", "drain_position", "drain_efficiency"))
        return uplift.model_copy(update={**gone, "pattern": "triangular"})
    # Of columns some have drains: halfway down the triangle is where those in the middle change nothing.
    found = {"drain_position": np.where(there, position, 0.5)}
    found["drain_efficiency"] = np.where(there, uplift.drain_efficiency or 0.0, 0.5)
    return uplift.model_copy(update={name: number(value) for name, value in found.items()})


def drains(x: float, section: CutSection) -> tuple[bool, float]:
    """Return whether vertical drains cross the crack, and where, as a part of its width from the heel."""
    (left, _), (right, _) = section.heel, section.toe
    position = (x - left) / (right - left)
    return (position > 0.0) & (position < 1.0), position


def anchor_line(anchor: Anchor, section: CutSection, below: float) -> tuple[Place, Place]:
    """Return head and foot of an anchor (x, z) [m]: as they are given, or where its axis leaves the part above the
    crack, and a place so far `below` the crack."""
    if anchor.ends is not None:
        (x, up), (foot_x, foot_up) = anchor.ends
        return (x, section.base_elevation + up), (foot_x, section.base_elevation + foot_up)
    assert anchor.distance is not None
    along, across = math.sin(anchor.inclination), math.cos(anchor.inclination)
    x, z = section.from_crack_frame(anchor.distance - below * along, -below * across)
    return head(section, anchor.distance, anchor.inclination), (section.heel[0] + x, section.heel[1] + z)


def rough_crack(case: Case) -> Iterator[InputError]:
    """Walk what of a case does not go with a rough crack."""
    if case.crack.roughness is None:
        return
    if case.analysis.rotation == "finite":
        yield InputError("rough-other", "analysis.rotation", shown("finite"))
    if case.uplift.during_shaking != "constant":
        yield InputError("rough-other", "uplift.during_shaking", shown(case.uplift.during_shaking))
    for place, anchor in enumerate(case.anchors):
        for name in ("axial_stiffness", "shear_stiffness"):
            if getattr(anchor, name):
                yield InputError("rough-other", f"anchors[{place}].{name}", f"{getattr(anchor, name):g} N/m^2")


def many_cracks(case: Case) -> Iterator[InputError]:
    """Walk what of a case does not go with several cracks."""
    if not case.further_cracks:
        return
    other = "further_cracks"
    options = case.flexible
    yield from anchors_through_several(case)
    if case.crack.roughness is not None:
        yield InputError("one-crack-only", "crack.roughness", other=other)
    if case.uplift.during_shaking != "constant":
        yield InputError("one-crack-value", "uplift.during_shaking", shown(case.uplift.during_shaking), other=other)
    for name, unfit in (("contact", "idce"), ("damping", "thesis"), ("virtual_mass", "thesis")):
        value = getattr(options, name)
        if value == unfit:
            yield InputError("one-crack-value", f"flexible.{name}", shown(value), other=other)
    for name in ("mesh_above", "mesh_below"):
        if getattr(options, name) is not None:
            yield InputError("one-crack-only", f"flexible.{name}", other=other)


def anchors_through_several(case: Case) -> Iterator[InputError]:
    """Walk what of the anchors of a case does not go with several cracks, each of which they may cross."""
    for place, anchor in enumerate(case.anchors):
        if anchor.distance is not None:
            yield InputError("anchor-ends", f"anchors[{place}].distance")
        for name in ("axial_stiffness", "shear_stiffness"):
            if getattr(anchor, name):
                yield InputError("one-crack-only", f"anchors[{place}].{name}", other="further_cracks")


def places_of(case: Case) -> tuple[tuple[Case, ...], int]:
    """Return the case with each of its cracks alone, from the crest down, and which of them is that of ``[crack]``.

    Raises
    ------
    InputError
        Where a crack does not cut the section in two, or two meet or cross.
    """
    if not case.further_cracks:
        return (case,), 0
    found = sorted(each_alone(case), key=lambda each: -_cut(*each)[0])
    for (upper, above), (lower, below) in pairwise(found):
        least = _NEAREST * (upper.cut.crest_elevation - upper.cut.base_elevation)
        ends = zip(_cut(upper, above), _cut(lower, below), strict=True)
        if any(high - low < least for high, low in ends) or _apart(upper, lower) < least:
            later = max(above, below, key=lambda name: (name != "crack", name))
            one, other = f"{upper.crack.elevation:g} m", f"{lower.crack.elevation:g} m"
            raise InputError("cracks-meet", f"{later}.elevation", one, other=other, least=f"{least:g} m")
    cases = tuple(each for each, _ in found)
    return cases, [name for _, name in found].index("crack")


def each_alone(case: Case) -> Iterator[tuple[Case, str]]:
    """Walk the cracks of a case: the case with each alone, and what the crack is called, that of ``[crack]`` first."""
    alone = case.model_copy(update={"further_cracks": ()}) if case.further_cracks else case
    yield alone, "crack"
    for place, crack in enumerate(case.further_cracks):
        update = {"crack": crack.beside(case.crack), "uplift": crack.wet(case.uplift)}
        yield alone.model_copy(update=update), f"further_cracks[{place}]"


def _apart(upper: Case, lower: Case) -> float:
    """Return how far the lines of two cracks are apart, which may have kinks [m]."""
    if not (upper.crack.kinks or lower.crack.kinks):
        return math.inf
    return float(shapely.distance(*(shapely.LineString(each.crack_line) for each in (upper, lower))))


def _cut(case: Case, field: str) -> tuple[float, float]:
    """Return the elevations of both ends of the only crack of a case."""
    try:
        section = case.cut
    except InputError as error:
        if field == "crack":
            raise
        elevation = f"{case.crack.elevation:g} m"
        raise InputError("section-misfit", f"{field}.elevation", elevation, reason=error) from None
    return section.heel[1], section.toe[1]


def one_crack(case: Case, model: str) -> None:
    """Refuse a case with several cracks, or one that is not straight, for what knows a straight one alone.

    Raises
    ------
    InputError
        Then.
    """
    if case.further_cracks:
        raise InputError("several-cracks", "further_cracks", model=model)
    straight_crack(case, model)
