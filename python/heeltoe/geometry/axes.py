"""Vectors of the plane, many at a time, along and across a crack that may be inclined."""

from __future__ import annotations

import math

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.geometry.section import CutSection


def along_and_across(vectors: Floats, section: CutSection) -> Floats:
    """Return the components along and across the crack of vectors (..., 2) in x and z."""
    return vectors if section.level else vectors @ _axes(section).T


def in_x_and_z(vectors: Floats, section: CutSection) -> Floats:
    """Return x and z of vectors (..., 2) along and across the crack."""
    return vectors if section.level else vectors @ _axes(section)


def places(points: Floats, section: CutSection) -> Floats:
    """Return where points (..., 2) are, along the crack from the heel and across it from the crack [m]."""
    return along_and_across(points - section.heel, section)


def _axes(section: CutSection) -> Floats:
    """Return the unit vectors along and across the crack, row by row."""
    down, up = math.cos(section.inclination), math.sin(section.inclination)
    return np.array([[down, up], [-up, down]])
