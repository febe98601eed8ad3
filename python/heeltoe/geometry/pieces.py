"""A polygon in the pieces that one takes by hand: rectangles and triangles side by side."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number

# What is so short beside the whole is no side.
_NOTHING = 1e-9
# More than so many pieces no one adds by hand.
_MOST = 8

_Corner = tuple[float, float]


class Piece(Block):
    """A rectangle, a triangle or another quadrilateral."""

    shape: Annotated[str, Number('"rectangle", "triangle" or "quadrilateral".')]
    width_m: Annotated[float, Number("Horizontal side.", "m")]
    height_m: Annotated[float, Number("Upright side; of a quadrilateral its mean height.", "m")]
    area_m2: Annotated[float, Number("Its area.", "m²")]
    x_m: Annotated[float, Number("x of its centroid, downstream.", "m")]
    z_m: Annotated[float, Number("z of its centroid, upwards.", "m")]


def pieces(polygon: Floats) -> tuple[Piece, ...]:
    """Return the pieces of a polygon (corners, shape (n, 2), not closed) from its left to its right; nothing where
    it is one piece, or where there are too many to be taken by hand."""
    little = _NOTHING * float(np.ptp(polygon, axis=0).max())
    pieces = [piece for strip in _strips(polygon, little) for piece in _of_strip(*strip, little)]
    return tuple(pieces) if 1 < len(pieces) <= _MOST else ()


def _strips(polygon: Floats, little: float) -> Iterator[tuple[_Corner, _Corner, _Corner, _Corner]]:
    """Cut a polygon upright at each corner; return the lower left, lower right, upper right and upper left corners of
    each piece."""
    places = np.sort(polygon[:, 0])
    places = places[np.concatenate([[True], np.diff(places) > little])]
    sides = [(a, b) if a[0] < b[0] else (b, a) for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True)]
    for left, right in pairwise(places.tolist()):
        across = [(a, b) for a, b in sides if a[0] <= left + little and b[0] >= right - little]
        ends = sorted(
            (tuple(float(np.interp(x, (a[0], b[0]), (a[1], b[1]))) for x in (left, right)) for a, b in across), key=sum
        )
        for (z0, z1), (top0, top1) in zip(ends[::2], ends[1::2], strict=True):
            yield (left, z0), (right, z1), (right, top1), (left, top0)


def _of_strip(low: _Corner, right: _Corner, far: _Corner, high: _Corner, little: float) -> Iterator[Piece]:
    """Return a rectangle and what is above or below it, or the strip as one piece where that is no help."""
    before, after = high[1] - low[1], far[1] - right[1]
    level, capped = abs(low[1] - right[1]) <= little, abs(high[1] - far[1]) <= little
    if min(before, after) <= little:
        if max(before, after) > little:
            corners = (low, far, high) if after <= little else (low, right, far)
            yield _piece("triangle", right[0] - low[0], max(before, after), corners)
    elif level and capped:
        yield _piece("rectangle", right[0] - low[0], before, (low, right, far, high))
    elif level:
        top = min(high[1], far[1])
        yield from _of_strip(low, right, (far[0], top), (high[0], top), little)
        yield from _of_strip((low[0], top), (right[0], top), far, high, little)
    elif capped:
        base = max(low[1], right[1])
        yield from _of_strip((low[0], base), (right[0], base), far, high, little)
        yield from _of_strip(low, right, (far[0], base), (high[0], base), little)
    else:
        yield _piece("quadrilateral", right[0] - low[0], (before + after) / 2.0, (low, right, far, high))


def _piece(shape: str, width: float, height: float, corners: tuple[_Corner, ...]) -> Piece:
    x, z = np.array(corners).T
    cross = x * np.roll(z, -1) - np.roll(x, -1) * z
    area = float(cross.sum()) / 2.0
    middle = [float(((axis + np.roll(axis, -1)) * cross).sum()) / (6.0 * area) for axis in (x, z)]
    return Piece(shape=shape, width_m=width, height_m=height, area_m2=area, x_m=middle[0], z_m=middle[1])
