"""A section between two faces that are given by their slopes."""

from __future__ import annotations

from collections.abc import Sequence

Point = tuple[float, float]


def corners_between(
    upstream: Sequence[Point], downstream: Sequence[Point], height: float, crest: float
) -> tuple[Point, ...]:
    """Return the corners (x, z) of a section, counter-clockwise from its heel [m].

    Parameters
    ----------
    upstream, downstream
        Slopes of the faces from elevations on: (elevation [m], horizontal per vertical), ascending from 0, positive
        where the dam is wider below; vertical where there are none.
    height
        From the base to the crest [m].
    crest
        Width at the crest, whose upstream edge is at x = 0 [m].
    """
    left = [(0.0 - out, level) for out, level in _going_down(upstream, height)]
    right = [(crest + out, level) for out, level in _going_down(downstream, height)]
    return left[-1], *reversed(right), *left[:-1]


def _going_down(slopes: Sequence[Point], height: float) -> list[Point]:
    """Return how far a face is out from its crest, with the level, from the crest down to the base."""
    corners, out, above = [(0.0, height)], 0.0, height
    for level, slope in reversed(slopes or ((0.0, 0.0),)):
        out += slope * (above - level)
        above = level
        corners.append((out, level))
    return corners
