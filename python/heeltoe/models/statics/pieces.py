"""Resistance of the pieces of a crack that is not straight to a force along it: the block has to climb them."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.crack.kinks import climbs, corners
from heeltoe.case.model import Case
from heeltoe.models.statics.contact import Settled

# A length of less than this part of the crack is no piece.
_NOTHING = 1e-9


def pieces_between(case: Case, start: float, end: float) -> list[tuple[Floats, Floats]]:
    """Return the ends of the pieces of a crack with kinks between two distances from the heel, along and above the
    straight line to the toe [m]; none of a straight crack."""
    if not climbs(case.crack.kinks):
        return []
    line = np.array(corners(case.cut, case.crack.kinks))
    inside = [place for place in line[:, 0].tolist() if start < place < end]
    points = np.array([[place, np.interp(place, *line.T)] for place in (start, *inside, end)])
    return [(a, b) for a, b in pairwise(points) if b[0] - a[0] > _NOTHING * line[-1, 0]]


def steepest(pieces: list[tuple[Floats, Floats]], way: float) -> float:
    """Return the angle [rad] of the steepest piece that rises where the block is pushed, 1 downstream, -1 upstream."""
    return max((way * _angle(*piece) for piece in pieces), default=0.0)


def borne(pieces: list[tuple[Floats, Floats]], friction: float, settled: Settled, way: float) -> float | None:
    """Return the largest force along the crack that the pieces can bear by friction [N/m].

    A block that is pushed along slides on every piece that it still touches. Each of these bears a force at the angle
    of friction to its normal, anywhere on it; the largest sum along the crack is wanted of those whose sum across it
    and whose moment are what the loads have there. On pieces steeper than what the angle of friction leaves to a right
    angle it has no limit but the strength of the concrete.

    Parameters
    ----------
    pieces
        From :func:`pieces_between`, where the block is in contact.
    friction
        Coefficient.
    settled
        Normal force and its place.
    way
        1 where the block is pushed downstream, -1 upstream.

    Returns
    -------
    float or None
        Infinite where there is no limit; None where they cannot bear the normal force at its place.
    """
    if settled.position is None or not pieces:
        return None
    from scipy.optimize import linprog

    size = max(float(end[0]) for _, end in pieces)
    rays = []
    for piece in pieces:
        to_normal = _angle(*piece) + way * math.atan(friction)
        back, up = math.sin(to_normal), math.cos(to_normal)
        rays += [(way * back, up, (place[0] * up + place[1] * back) / size) for place in piece]
    held, across, turning = np.array(rays).T
    optimum = linprog(-held, A_eq=np.array([across, turning]), b_eq=[1.0, settled.position / size])
    if optimum.status == _UNBOUNDED:
        return math.inf
    return max(0.0, -float(optimum.fun)) * settled.normal if optimum.success else None


# As scipy numbers it.
_UNBOUNDED = 3


def _angle(start: Floats, end: Floats) -> float:
    along, up = end - start
    return math.atan2(float(up), float(along))
