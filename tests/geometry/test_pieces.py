"""Polygons in pieces: the sums are those of the polygon, the pieces those that one takes by hand."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from heeltoe.geometry.pieces import pieces

DAM = [(0, 0), (36, 0), (6, 40), (6, 45), (0, 45)]
BATTERED = [(-4, 0), (40, 0), (8, 40), (8, 45), (0, 45), (0, 20)]
OVERHANG = [(0, 0), (30, 0), (6, 40), (10, 44), (10, 46), (-2, 46), (-2, 44), (0, 42)]
SLOPED = [(0, 0), (36, 3), (6, 40), (6, 45), (0, 45)]


@pytest.mark.parametrize("corners", [DAM, BATTERED, OVERHANG, SLOPED])
def test_areas_and_moments_add_up(corners):
    whole = shapely.Polygon(corners)
    parts = pieces(np.array(corners, dtype=float))
    assert sum(part.area_m2 for part in parts) == pytest.approx(whole.area)
    for axis, middle in (("x", whole.centroid.x), ("z", whole.centroid.y)):
        assert sum(part.area_m2 * getattr(part, f"{axis}_m") for part in parts) == pytest.approx(whole.area * middle)


def test_a_dam_is_a_rectangle_and_a_triangle():
    rectangle, triangle = pieces(np.array(DAM, dtype=float))
    assert (rectangle.shape, rectangle.width_m, rectangle.height_m, rectangle.x_m) == ("rectangle", 6.0, 45.0, 3.0)
    assert (triangle.shape, triangle.width_m, triangle.height_m, triangle.area_m2) == ("triangle", 30.0, 40.0, 600.0)
    assert (triangle.x_m, triangle.z_m) == pytest.approx((16.0, 40.0 / 3.0))


def test_one_piece_and_too_many_are_left_whole():
    assert pieces(np.array([[0.0, 0.0], [80.0, 0.0], [0.0, 100.0]])) == ()
    angles = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    assert pieces(np.stack([np.cos(angles), np.sin(angles)], axis=1)) == ()


def test_a_slope_under_a_slope_is_a_quadrilateral():
    corners = np.array([(0.0, 0.0), (20.0, 4.0), (10.0, 30.0), (0.0, 35.0)])
    parts = pieces(corners)
    assert [part.shape for part in parts] == ["quadrilateral", "triangle"]
    assert sum(part.area_m2 for part in parts) == pytest.approx(shapely.Polygon(corners).area)
