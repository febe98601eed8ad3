"""The cut through the section: hand values, awkward shapes, and integration strip by strip to compare."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from heeltoe.errors.error import InputError
from heeltoe.geometry.section import cut, outline
from shared.dams import TYPICAL
from shared.outlines import by_strips, dams, make


@st.composite
def stars(draw):
    """A polygon around the origin with deep bays, not always one piece at every height."""
    radii = draw(st.lists(st.integers(2, 30), min_size=3, max_size=9))
    angles = 2 * np.pi * (np.arange(len(radii)) + 0.1) / len(radii)
    return tuple((float(r * np.cos(a)), float(r * np.sin(a))) for r, a in zip(radii, angles, strict=True))


def check_against_strips(corners, section):
    area, x, z, inertia = by_strips(corners, section.crack_elevation)
    assert section.area == pytest.approx(area, rel=1e-9)
    assert section.centroid == pytest.approx((x, z), rel=1e-9, abs=1e-9)
    assert section.polar_inertia == pytest.approx(inertia, rel=1e-8)


def test_typical_dam_by_hand():
    # A rectangle of 8 m x 100 m and a triangle of 72 m x 90 m.
    section = make(TYPICAL).cut
    assert section.area == pytest.approx(4040.0)
    assert section.centroid == pytest.approx((106880 / 4040, 137200 / 4040))
    x, z = section.centroid
    rectangle = 800 * ((8**2 + 100**2) / 12 + (x - 4) ** 2 + (z - 50) ** 2)
    triangle = 3240 * ((72**2 + 90**2) / 18 + (x - 32) ** 2 + (z - 30) ** 2)
    assert section.polar_inertia == pytest.approx(rectangle + triangle)
    assert (section.heel, section.toe, section.crack_width) == ((0.0, 0.0), (80.0, 0.0), 80.0)
    assert (section.base_elevation, section.crest_elevation, section.height) == (0.0, 100.0, 100.0)
    assert section.upstream_face.tolist() == [[0, 0], [0, 100]]
    assert section.downstream_face.tolist() == [[80, 0], [8, 90], [8, 100]]


@given(dams(), st.floats(0.0, 0.95))
def test_any_dam_at_any_height(corners, part):
    top = max(z for _, z in corners)
    section = make(corners, part * top).cut
    check_against_strips(corners, section)
    for face, end in ((section.upstream_face, section.heel), (section.downstream_face, section.toe)):
        assert tuple(face[0]) == end
        assert face[-1, 1] == top
    assert section.heel[1] == section.toe[1] == pytest.approx(part * top, abs=2e-7)
    assert np.all(section.polygon[:2] == [section.heel, section.toe])
    assert section.crack_width > 0.0


@given(stars(), st.floats(0.05, 0.9))
def test_any_polygon_that_the_crack_cuts_once(corners, part):
    low, high = min(z for _, z in corners), max(z for _, z in corners)
    try:
        section = make(corners, part * (high - low)).cut
    except InputError as error:
        assume(error.code != "crack-pieces")
        raise
    check_against_strips(corners, section)
    assert section.base_elevation == low


@given(dams(), st.data())
def test_crack_through_a_corner(corners, data):
    level = data.draw(st.sampled_from(sorted({z for _, z in corners})[:-1]))
    section = make(corners, level).cut
    check_against_strips(corners, section)
    at_level = sorted(x for x, z in corners if z == level)
    assert (section.heel[0], section.toe[0]) == (at_level[0], at_level[-1])
    assert len(section.polygon) == sum(z >= level for _, z in corners)


@given(dams(), st.floats(0.0, 0.9))
def test_order_of_the_corners_does_not_matter(corners, part):
    elevation = part * max(z for _, z in corners)
    one, other = make(corners, elevation).cut, make(corners[::-1], elevation).cut
    assert one.polygon == pytest.approx(other.polygon)
    assert one.polar_inertia == pytest.approx(other.polar_inertia)


def test_closed_repeated_and_collinear_corners_change_nothing():
    plain = [(0, 0), (4, 0), (4, 3), (0, 3)]
    wordy = [(0, 0), (1, 0), (3, 0), (4, 0), (4, 0), (4, 1), (4, 3), (2, 3), (0, 3), (0, 2), (0, 0)]
    for elevation in (0.0, 1.0, 1.5):
        one, other = make(plain, elevation).cut, make(wordy, elevation).cut
        assert (one.heel, one.toe) == (other.heel, other.toe)
        assert one.area == pytest.approx(other.area)
        assert one.centroid == pytest.approx(other.centroid)
        assert one.polar_inertia == pytest.approx(other.polar_inertia)
        assert one.polar_inertia == pytest.approx(one.area * (4**2 + one.height**2) / 12)


@pytest.mark.parametrize("off", [-1e-12, 0.0, 1e-12])
def test_rounding_of_the_elevation_leaves_no_sliver(off):
    section = make(TYPICAL, 90 * (1 + off)).cut
    assert section.polygon == pytest.approx(np.array([(0, 90), (8, 90), (8, 100), (0, 100)]))


def test_elevation_counts_from_the_lowest_point():
    section = make([(0, 600), (10, 600), (2, 640), (0, 640)], 20.0).cut
    assert (section.crack_elevation, section.base_elevation, section.height) == (620.0, 600.0, 20.0)
    assert section.toe == pytest.approx((6.0, 620.0))


def test_ledge_and_overhang_on_the_crack_line():
    below, above = [(0, 0), (10, 0), (10, 5)], [(6, 5), (6, 9), (1, 9), (1, 5), (0, 5)]
    ledge = make(below + above, 5.0).cut
    assert (ledge.heel, ledge.toe, ledge.area) == ((1, 5), (6, 5), 20)
    # Upside down the wide part overhangs the crack on both sides; its lower side belongs to the faces.
    overhang = make([(x, 9 - z) for x, z in below + above], 4.0).cut
    assert (overhang.heel, overhang.toe, overhang.area) == ((1, 4), (6, 4), 50)
    assert overhang.upstream_face.tolist() == [[1, 4], [0, 4], [0, 9]]
    assert overhang.downstream_face.tolist() == [[6, 4], [10, 4], [10, 9]]
    assert overhang.polar_inertia == pytest.approx(50 * (100 + 25) / 12)


def test_top_of_an_arch_on_the_crack_line():
    arch = [(0, 0), (2, 0), (5, 4), (8, 0), (10, 0), (10, 9), (0, 9)]
    section = make(arch, 4.0).cut
    assert (section.heel, section.toe, section.area) == ((0, 4), (10, 4), 50)
    with pytest.raises(InputError, match="several pieces"):
        cut(outline(arch), 3.9)
    with pytest.raises(InputError, match="several pieces"):
        cut(outline(arch), 0.0)


@pytest.mark.parametrize("elevation", [4.0, 5.0])
def test_two_towers(elevation):
    towers = [(0, 0), (10, 0), (10, 9), (8, 9), (5, 4), (2, 9), (0, 9)]
    with pytest.raises(InputError, match="several pieces"):
        cut(outline(towers), elevation)
    assert make(towers, 3.9).cut.upstream_face.tolist() == [[0, 3.9], [0, 9]]


def test_results_cannot_be_changed():
    section = make([(0, 0), (4, 0), (4, 3), (0, 3)]).cut
    with pytest.raises(ValueError, match="read-only"):
        section.polygon[0, 0] = 1.0


def test_a_copy_of_a_case_is_cut_where_it_says():
    case = make([(0, 0), (4, 0), (4, 3), (0, 3)], 1.0)
    assert case.cut is case.cut
    assert case.model_copy(update={"title": "another"}).cut is case.cut
    higher = case.model_copy(update={"crack": case.crack.model_copy(update={"elevation": 2.0})})
    assert (case.cut.heel, higher.cut.heel) == ((0, 1), (0, 2))
    wider = case.model_copy(update={"section": make([(0, 0), (5, 0), (5, 3), (0, 3)]).section})
    assert (case.outline.area, wider.outline.area, wider.cut.crack_width) == (12, 15, 5)
    assert case == make([(0, 0), (4, 0), (4, 3), (0, 3)], 1.0)
    assert "cut" not in case.model_dump()


def test_a_line_that_is_in_concrete_before_it_starts():
    # Under the overhang it would start at the crest.
    overhang = outline([(0, 0), (50, 0), (50, 100), (-100, 100), (0, 90)])
    assert cut(overhang, 90.0, math.radians(-5.0)).crack_width == pytest.approx(50.0 / math.cos(math.radians(5.0)))
    with pytest.raises(InputError, match="-6 deg goes through concrete upstream of where it starts, too"):
        cut(overhang, 90.0, math.radians(-6.0))
