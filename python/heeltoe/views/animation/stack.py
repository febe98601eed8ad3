"""Two rigid blocks, one on the other, as the parts of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import shapely

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.views.animation.bodies import Moments, Part, part_below, rigid_parts


def stack_parts(case: Case, histories: tuple[Mapping[str, Floats], ...], moments: Moments) -> tuple[Part, ...]:
    """Return both blocks and, if the lower crack is not at the base, what stands still below it, from the crest down.

    `histories` are those of both cracks, from the crest down. Rotations are small, so that what the lower block does
    adds to what the upper one does on it.
    """
    upper_case, lower_case = case.cracks
    (upper, *_), (whole, *ground) = (
        rigid_parts(each, own, moments) for each, own in zip((upper_case, lower_case), histories, strict=True)
    )
    heel, toe = np.array(lower_case.cut.heel), np.array(lower_case.cut.toe)
    rest = shapely.Polygon(np.array(lower_case.cut.polygon))
    lower = part_below(upper_case.cut, rest, (heel, toe))
    assert lower is not None
    ends = [int(np.hypot(*(lower.points - corner).T).argmin()) for corner in (heel, toe)]
    carried = replace(
        lower,
        crack=np.array(ends),
        shapes=_shapes(lower_case, lower.points),
        amplitudes=whole.amplitudes,
    )
    riding = replace(
        upper,
        shapes=np.concatenate([upper.shapes, _shapes(lower_case, upper.points)]),
        amplitudes=np.concatenate([upper.amplitudes, whole.amplitudes], axis=1),
    )
    return (riding, carried, *ground)


def _shapes(case: Case, points: Floats) -> Floats:
    """Return what the amplitudes of the block above a crack do to points that go with it."""
    section = case.cut
    e, n = section.from_crack_frame(1.0, 0.0), section.from_crack_frame(0.0, 1.0)
    arm, ones = points - section.heel, np.ones((len(points), 2))
    return np.stack([ones * e, ones * n, arm, np.column_stack([-arm[:, 1], arm[:, 0]])])
