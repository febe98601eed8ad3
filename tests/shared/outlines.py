"""Sections of any shape, with a slow integration to compare the cut with."""

from itertools import pairwise

import numpy as np
from hypothesis import strategies as st

from heeltoe.case.model import Case
from shared.dams import on_rigid_plane, polygon


def make(corners, elevation=0.0, **more):
    """Return a case that has been through no check of the geometry yet."""
    crack = {"elevation": f"{elevation!r} m", "friction": 1.0}
    return on_rigid_plane(Case.model_validate({"section": polygon(corners), "crack": crack} | more))


def by_strips(corners, level):
    """Area, centroid and polar inertia above `level`, by Gauss points on horizontal lines: exact."""
    corners = np.asarray(corners, float)
    ends = np.roll(corners, -1, axis=0)
    marks = np.unique(np.append(corners[corners[:, 1] > level, 1], level))
    nodes, weights = np.polynomial.legendre.leggauss(4)
    sums = np.zeros(5)
    for low, high in pairwise(marks):
        for node, gauss in zip(nodes, weights, strict=True):
            z = (low + high) / 2 + node * (high - low) / 2
            hit = (corners[:, 1] < z) != (ends[:, 1] < z)
            (x0, z0), (x1, z1) = corners[hit].T, ends[hit].T
            x = np.sort(x0 + (z - z0) / (z1 - z0) * (x1 - x0))
            left, right = x[::2], x[1::2]
            width = np.sum(right - left)
            first = np.sum(right**2 - left**2) / 2
            second = np.sum(right**3 - left**3) / 3
            sums += gauss * (high - low) / 2 * np.array([width, first, z * width, second, z * z * width])
    area, sx, sz, sxx, szz = sums
    return area, sx / area, sz / area, sxx + szz - (sx * sx + sz * sz) / area


@st.composite
def dams(draw):
    """A section from z = 0 up that is one piece at every height, its corners from anywhere, either way."""
    heights = sorted(draw(st.sets(st.integers(1, 100), min_size=1, max_size=4)) | {0})
    left = [draw(st.integers(-20, 0)) for _ in heights]
    right = [draw(st.integers(1, 60)) for _ in heights]
    corners = [*zip(left, heights, strict=True), *reversed([*zip(right, heights, strict=True)])]
    start = draw(st.integers(0, len(corners) - 1))
    corners = corners[start:] + corners[:start]
    return tuple((float(x), float(z)) for x, z in (corners[::-1] if draw(st.booleans()) else corners))
