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
    wide = _widths(corners, (levels[1:] + levels[:-1]) / 2.0)
    size = 2 * (_PIECES + 1)
    stiffness, mass = np.zeros((size, size)), np.zeros(size)
    half = case.concrete.density * length / 2.0 * np.column_stack([wide, wide**3 / 12.0])
    for piece, (stiff, heavy) in enumerate(zip(_stiffness(wide, length, case.concrete.poisson), half, strict=True)):
        place = 2 * piece
        stiffness[place : place + 4, place : place + 4] += stiff
        mass[place : place + 2] += heavy
        mass[place + 2 : place + 4] += heavy
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


def _widths(corners: Floats, levels: Floats) -> Floats:
    """Return how wide the section is at some levels [m]."""
    (x0, z0), (x1, z1) = corners.T, np.roll(corners, -1, axis=0).T
    level = levels[:, None]
    # Where the outline goes up there is concrete on one side of it, where it goes down on the other.
    way = np.where(z1 > level, 1.0, 0.0) - np.where(z0 > level, 1.0, 0.0)
    share = (level - z0) / np.where(z1 == z0, 1.0, z1 - z0)
    width: Floats = np.abs(np.sum(way * (x0 + share * (x1 - x0)), axis=1))
    return width


def _stiffness(width: Floats, length: float, poisson: float) -> Floats:
    """Return the stiffness (n, 4, 4) of pieces of a modulus of 1 Pa against displacement and rotation of both ends."""
    bending = width**3 / 12.0
    soft = 12.0 * bending * 2.0 * (1.0 + poisson) / (_SHEAR * width * length**2)
    twelve, a = np.full_like(width, 12.0), np.full_like(width, 6.0 * length)
    b, c = (4.0 + soft) * length**2, (2.0 - soft) * length**2
    rows = [[twelve, a, -twelve, a], [a, b, -a, c], [-twelve, -a, twelve, -a], [a, c, -a, b]]
    result: Floats = np.moveaxis(bending / (length**3 * (1.0 + soft)) * np.array(rows), -1, 0)
    return result
