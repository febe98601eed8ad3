"""The quadratic edges along which dam, water and rock meet: their shapes, places on them, and smooth patterns."""

from __future__ import annotations

import numpy as np

from heeltoe.base.arrays import Floats, Integers

#: Places from -1 to 1 and weights by which products of shapes are integrated along an edge.
GAUSS_POINTS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(4)


def edge_shapes(places: Floats) -> Floats:
    """Return the three quadratic shapes of an edge at places from -1 to 1, along the last axis."""
    return np.stack([places * (places - 1.0) / 2.0, 1.0 - places**2, places * (places + 1.0) / 2.0], axis=-1)


def edge_shares(nodes: Floats, places: Floats) -> tuple[Integers, Floats]:
    """Return of a line of quadratic edges with such nodes, middle ones included, the three at each place and their
    shares, both (k, 3)."""
    edge = 2 * np.clip(np.searchsorted(nodes[2:-1:2], places), 0, (nodes.size - 3) // 2)
    low, high = nodes[edge], nodes[edge + 2]
    return edge[:, None] + np.arange(3), edge_shapes((2.0 * places - low - high) / (high - low))


def smooth_patterns(places: Floats, start: float, end: float, count: int) -> Floats:
    """Return Legendre polynomials of rising degree at places between two ends, (k, count)."""
    along = 2.0 * (places - start) / (end - start) - 1.0
    patterns: Floats = np.asarray(np.polynomial.legendre.legvander(along, count - 1), dtype=np.float64)
    return patterns
