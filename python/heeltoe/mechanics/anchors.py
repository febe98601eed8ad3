"""What an anchor bears as its upper end moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from heeltoe.base.arrays import Floats

if TYPE_CHECKING:
    from heeltoe.case.at_crack import AnchorAtCrack


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
