"""A dam as a beam: about how long it swings, and how far each level of it does, without building elastic parts.

The whole section, uncracked, is a cantilever that bends and shears (Timoshenko), with the virtual water of a vertical
face; its axis is taken for straight. Its first period is up to 12 % off that of the elastic parts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case

_PIECES = 20
#: Share of a rectangle's area that carries shear.
_SHEAR = 5.0 / 6.0
_MODES = 3


@dataclass(frozen=True, eq=False)
class Beam:
    """A dam in its lowest modes.

    Attributes
    ----------
    periods
        (m,) with the water, for a modulus of 1 Pa; they go with one over its square root [s].
    levels
        (n,) from the base to the crest [m].
    reached
        (n, m) how far each level swings in each mode, over the spectral displacement.
    """

    periods: Floats
    levels: Floats
    reached: Floats


def beam(case: Case) -> Beam:
    """Return the dam of a case as a beam."""
    corners = np.array(case.section.vertices())
    base, crest = corners[:, 1].min(), corners[:, 1].max()
    levels = np.linspace(base, crest, _PIECES + 1)
    length = float(levels[1] - levels[0])
    wide = np.array([_width(corners, z) for z in (levels[1:] + levels[:-1]) / 2.0])
    size = 2 * (_PIECES + 1)
    stiffness, mass = np.zeros((size, size)), np.zeros(size)
    for piece, width in enumerate(wide):
        place = slice(2 * piece, 2 * piece + 4)
        stiffness[place, place] += _stiffness(width, length, case.concrete.poisson)
        half = case.concrete.density * length / 2.0
        mass[place] += half * np.array([width, width**3 / 12.0] * 2)
    if case.reservoir is not None:
        deep = case.reservoir.depth
        below = np.clip(deep - (levels - base), 0.0, None)
        mass[::2] += 7.0 / 8.0 * case.reservoir.density * np.sqrt(deep * below) * length
    # The base is held.
    root = np.sqrt(mass[2:])
    squares, turned = np.linalg.eigh(stiffness[2:, 2:] / np.outer(root, root))
    shapes = turned[:, :_MODES] / root[:, None]
    shares = shapes[::2].T @ mass[2::2]
    swing = np.vstack([np.zeros(_MODES), shapes[::2] * shares])
    return Beam(2.0 * np.pi / np.sqrt(squares[:_MODES]), levels - base, swing)


def _width(corners: Floats, level: float) -> float:
    """Return how wide the section is at a level [m]."""
    x, z = corners.T
    following = np.roll(corners, -1, axis=0).T
    crosses = (z > level) != (following[1] > level)
    share = (level - z[crosses]) / (following[1][crosses] - z[crosses])
    places = np.sort(x[crosses] + share * (following[0][crosses] - x[crosses]))
    return float(np.sum(places[1::2] - places[::2]))


def _stiffness(width: float, length: float, poisson: float) -> Floats:
    """Return the stiffness (4, 4) of a piece of a modulus of 1 Pa against displacement and rotation of both ends."""
    bending = width**3 / 12.0
    soft = 12.0 * bending * 2.0 * (1.0 + poisson) / (_SHEAR * width * length**2)
    a, b, c = 6.0 * length, (4.0 + soft) * length**2, (2.0 - soft) * length**2
    rows = [[12.0, a, -12.0, a], [a, b, -a, c], [-12.0, -a, 12.0, -a], [a, c, -a, b]]
    result: Floats = bending / (length**3 * (1.0 + soft)) * np.array(rows)
    return result
