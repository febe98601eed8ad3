"""Force of an anchor as its upper end moves, and whether anchors hold a block that friction and weight do not."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from heeltoe.base.arrays import Floats

if TYPE_CHECKING:
    from heeltoe.case.at_crack import AnchorAtCrack
    from heeltoe.mechanics.block import Block

# So far a block may turn before the anchors hold it [rad]: rotations are small.
_TURNED = 0.1


def anchor_force(anchor: AnchorAtCrack, along: Floats, across: Floats) -> Floats:
    """Return the force in an anchor [N/m], its tension and its resistance to slip together.

    The law of the kernels, ``crates/heeltoe/src/inside.rs``: a tension of max(0, P + k e), with e the elongation along
    the axis, and a dowel of its shear stiffness times the slip.

    Parameters
    ----------
    anchor
        The anchor.
    along, across
        (n,) how far its upper end has moved against the lower one, along the crack, positive downstream, and across it
        [m].
    """
    elongation = np.sin(anchor.inclination) * along + np.cos(anchor.inclination) * across
    tension = np.maximum(anchor.prestress + anchor.axial_stiffness * elongation, 0.0)
    return np.asarray(np.hypot(tension, anchor.shear_stiffness * along), dtype=np.float64)


def anchors_hold(block: Block) -> bool:
    """Whether anchors that stretch hold a block which friction, weight and prestress do not, before it has slid as far
    as its crack is wide.

    Static equilibrium of the block after a slip u the way that the static loads push it, or after a turn about the
    corner that it overturns about: with ``dT = max(-P, k_a e)``, e the elongation by that motion, the loads along and
    across the crack become ``F - dT sin(i) - k_s u`` and ``N + dT cos(i)``. Both are linear between the slips at which
    an anchor goes slack, so that one that holds is at one of these or at the end.
    """
    anchors = [anchor for anchor in block.case.anchors_at_crack if anchor.yields]
    if not anchors or block.normal_force <= 0.0:
        return False
    along, position = block.static.horizontal, block.resultant_position
    way, friction = np.sign(along), block.friction_kinetic

    def driven(slip: float) -> float:
        """Return by how much the loads along the crack exceed its resistance."""
        force, normal = along, block.normal_force
        for anchor in anchors:
            elongation = np.sin(anchor.inclination) * way * slip
            change = max(-anchor.prestress, anchor.axial_stiffness * elongation)
            force -= change * np.sin(anchor.inclination) + anchor.shear_stiffness * way * slip
            normal += change * np.cos(anchor.inclination)
        return float(way * force - friction * max(normal, 0.0))

    slack = [
        anchor.prestress / (anchor.axial_stiffness * abs(np.sin(anchor.inclination)))
        for anchor in anchors
        if anchor.axial_stiffness and np.sin(anchor.inclination) * way < 0.0
    ]
    slides = block.friction_static * block.normal_force < abs(along)
    if slides and min(driven(slip) for slip in (*slack, block.width) if slip <= block.width) > 0.0:
        return False
    if position is None or 0.0 <= position <= block.width:
        return True
    corner, beyond = (block.width, position - block.width) if position > block.width else (0.0, -position)
    arms = [(anchor, abs(corner - anchor.distance)) for anchor in anchors]
    stiffness = sum(anchor.axial_stiffness * (np.cos(anchor.inclination) * arm) ** 2 for anchor, arm in arms)
    return bool(stiffness * _TURNED >= beyond * block.normal_force)
