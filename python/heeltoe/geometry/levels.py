"""One section cut at many elevations: what is above each crack, as columns."""

from __future__ import annotations

import numpy as np
import shapely

from heeltoe.base.arrays import Floats, Integers
from heeltoe.errors.error import InputError
from heeltoe.geometry.section import CutSection, cut, measured, on_line


def cut_levels(whole: shapely.Polygon, elevations: Floats, inclination: float = 0.0) -> CutSection:
    """Return the parts of a section above cracks at many elevations, its numbers and corners as columns.

    Level cracks through faces that rise all the way are cut in one step. Otherwise, as on a ledge, each elevation is
    cut by itself, once.

    Parameters
    ----------
    whole
        The section, from :func:`heeltoe.geometry.section.outline` [m].
    elevations
        (n,) heights of the cracks at the upstream face above the lowest point of the section [m].
    inclination
        Of all of them to the horizontal, positive where they rise downstream [rad].

    Raises
    ------
    InputError
        Where a crack does not cut the section in two along one line.
    """
    low = np.where(elevations > on_line(whole), elevations, 0.0)
    rising = None if inclination else _rising(whole)
    return _cut_all(whole, low, inclination) if rising is None else _clipped(whole, rising, low)


def _rising(whole: shapely.Polygon) -> CutSection | None:
    """Return all of a section that stands on a level base and ends in a level crest or a point, between faces that rise
    all the way; None of another."""
    try:
        section = cut(whole, 0.0)
    except InputError:
        return None
    faces = (section.upstream_face[:, 1], section.downstream_face[:, 1])
    plain = all((np.diff(z) > on_line(whole)).all() for z in faces)
    between = section.polygon[len(faces[1]) : len(section.polygon) - len(faces[0]) + 1, 1]
    return section if plain and (between == section.crest_elevation).all() else None


def _clipped(whole: shapely.Polygon, section: CutSection, elevations: Floats) -> CutSection:
    """Return what is above level cracks: corners below one move up along their face onto it."""
    levels = section.base_elevation + elevations
    up, down = (_above(face, levels, on_line(whole)) for face in (section.upstream_face, section.downstream_face))
    corners = np.concatenate([up[:1], down, up[:0:-1]])
    return measured(corners, (up, down), (section.base_elevation, section.crest_elevation))


def _above(face: Floats, levels: Floats, slack: float) -> Floats:
    """Return the corners (k, 2, n) of the part of a rising face above each level."""
    # As where one section is cut: corners that are close to the line are on it.
    z = np.where(np.abs(face[:, 1, None] - levels) <= slack, levels, face[:, 1, None])
    start = np.empty_like(levels)
    for (x0, x1), z0, z1 in zip(zip(face[:-1, 0], face[1:, 0], strict=True), z[:-1], z[1:], strict=True):
        crossed = (z0 <= levels) & (levels < z1)
        start[crossed] = (x0 + (levels - z0) / np.where(crossed, z1 - z0, 1.0) * (x1 - x0))[crossed]
    x = np.where(z > levels, face[:, 0, None], start)
    return np.stack([x, np.maximum(z, levels)], axis=1)


def _cut_all(whole: shapely.Polygon, elevations: Floats, inclination: float) -> CutSection:
    """Cut at each elevation by itself, the first that is given first."""
    values, first, which = np.unique(elevations, return_index=True, return_inverse=True)
    order = np.argsort(first)
    made = {place: cut(whole, float(values[place]), inclination) for place in order}
    sections = [made[place] for place in range(values.size)]
    corners, up, down = (
        _together([getattr(section, name) for section in sections], which)
        for name in ("polygon", "upstream_face", "downstream_face")
    )
    return measured(corners, (up, down), (sections[0].base_elevation, sections[0].crest_elevation))


def _together(shapes: list[Floats], which: Integers) -> Floats:
    """Return the corners of several shapes as columns (k, 2, n); the last corner of one with fewer is repeated."""
    longest = max(map(len, shapes))
    filled = np.stack([np.pad(shape, ((0, longest - len(shape)), (0, 0)), mode="edge") for shape in shapes], axis=-1)
    return np.ascontiguousarray(filled[..., which])
