"""How far the crack of an elastic dam turns and opens while the dam only stands or slides.

What the part above the crack does as a whole is told by the kernel, from what it stands on, how far it has turned and
what of it slips (docs/flexible.md, "Motion of the dam"). What it has to turn and lift by, so that this is no elastic
deformation any more, is worked out here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from heeltoe.case.model import Case
from heeltoe.geometry.axes import along_and_across
from heeltoe.geometry.section import CutSection

#: By how many times N/(E B) the crack's face has turned where a push that grows slowly reaches that which makes a
#: rigid block rock: 14 to 36 on square, tall and dam-shaped bodies, more with a finer mesh.
_TURNS = 20.0


def elastic_give(case: Case, section: CutSection, crack_force: NDArray[np.float64]) -> tuple[float, float]:
    """Return the rotation [rad] and the gap [m] of the crack's faces that elastic deformation alone accounts for.

    Parameters
    ----------
    case, section
        Modulus *E* and the crack's width *B*.
    crack_force
        (2 k,) forces on the upper part's crack nodes before the earthquake, x and z in turn [N]; *N* is the
        resultant across the crack.

    Returns
    -------
    tuple
        20 N/(E B) and N/E: the latter is by how much a block as high as it is wide shortens under *N*. Both vanish
        with 1/E, as the rigid model needs it, and turn with the crack. On elastic rock its 1/E comes on top.
    """
    normal = float(along_and_across(crack_force.reshape(-1, 2), section)[:, 1].sum())
    soft = 1.0 / (case.concrete.modulus or np.inf) + (0.0 if case.foundation is None else 1.0 / case.foundation.modulus)
    gap = max(normal, 0.0) * soft
    return _TURNS * gap / section.crack_width, gap
