"""Anchors and drains in the coordinates of the dam, as they cross a crack."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import number
from heeltoe.case.dam import STEEPEST_ANCHOR, Anchor, Uplift
from heeltoe.errors.error import InputError
from heeltoe.geometry.crossing import Crossing, Place, crossing, head
from heeltoe.geometry.section import CutSection


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

    @property
    def yields(self) -> bool:
        """Whether its force changes as the crack moves."""
        return bool(self.axial_stiffness or self.shear_stiffness)


def anchor_at_crack(anchor: Anchor, section: CutSection) -> AnchorAtCrack:
    """Return an anchor as a crack has it."""
    crossing = crosses(anchor, section)
    strengths = (anchor.prestress, anchor.axial_stiffness, anchor.shear_stiffness)
    if crossing is None:
        assert anchor.distance is not None
        return AnchorAtCrack(anchor.distance, anchor.inclination, *strengths, anchor.capacity)
    distance, *forces = (number(np.where(crossing.crossed, force, 0.0)) for force in (crossing.distance, *strengths))
    if np.all(crossing.crossed):
        forces = list(strengths)
    return AnchorAtCrack(distance, _angle(crossing), forces[0], forces[1], forces[2], anchor.capacity)


def _angle(crossing: Crossing) -> float:
    # Cracks of columns have one inclination, as has the anchor.
    angles = np.unique(np.where(crossing.crossed, crossing.inclination, 0.0))
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
    crossing = crosses(anchor, section)
    return crossing is not None and abs(_angle(crossing)) > STEEPEST_ANCHOR


def flat(place: int, anchor: Anchor, section: CutSection) -> InputError:
    """Return the error for such an anchor."""
    crossing = crosses(anchor, section)
    angle = 0.0 if crossing is None else math.degrees(abs(_angle(crossing)))
    steepest = f"{math.degrees(STEEPEST_ANCHOR):.3g} deg"
    return InputError("anchor-flat", f"anchors[{place}].foot_x", f"{angle:.3g} deg", most=steepest)


def uplift_at_crack(uplift: Uplift, section: CutSection) -> Uplift:
    """Return the uplift with its drains on the crack; as without drains where they do not cross it."""
    if uplift.drain_x is None:
        return uplift
    inside, position = drains(uplift.drain_x, section)
    if not np.any(inside):
        gone = dict.fromkeys(("drain_x", "drain_position", "drain_efficiency"))
        return uplift.model_copy(update={**gone, "pattern": "triangular"})
    # Of columns some have drains: halfway down the triangle is where those in the middle change nothing.
    changes = {"drain_position": np.where(inside, position, 0.5)}
    efficiency = 0.0 if uplift.drain_efficiency is None else uplift.drain_efficiency
    changes["drain_efficiency"] = np.where(inside, efficiency, 0.5)
    return uplift.model_copy(update={name: number(value) for name, value in changes.items()})


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
