"""Meshes of our own: they have the shape of the section, and what rows cannot follow is refused in words."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from heeltoe.errors.error import InputError
from heeltoe.models.flexible.mesh.checks import (
    CORNERS,
    MIDDLES,
    check_elements,
    check_pieces,
    jacobians,
)
from shared.dams import TRIANGLE, TYPICAL
from shared.meshes import area, bodies, flat, meshed, on_polyline
from shared.outlines import dams, make


def test_typical_dam():
    mesh, _ = meshed(TYPICAL)
    upper = mesh.upper
    assert mesh.lower is None
    assert 80 <= len(upper.elements) <= 110
    assert upper.nodes[upper.crack] == pytest.approx(np.column_stack([np.linspace(0, 80, 17), np.zeros(17)]))
    assert len(upper.fixed) == 0
    assert upper.nodes[upper.upstream, 0] == pytest.approx(0.0)
    for face in (upper.upstream, upper.downstream):
        heights = upper.nodes[face, 1]
        assert (heights[0], heights[-1]) == (0.0, 100.0)
        assert np.all(np.diff(heights) > 0.0)
        assert 90.0 in heights[::2]
    heights = np.diff(upper.nodes[upper.upstream[::2], 1])
    assert np.all(heights[1:] / heights[:-1] > 0.7)
    assert np.all(heights[1:] / heights[:-1] < 1.0 + 1e-9)
    widths = np.diff(upper.nodes[upper.elements[:, :2], 0], axis=1)[:, 0]
    slender = np.diff(upper.nodes[upper.elements[:, 1:3], 1], axis=1)[:, 0] / widths
    assert slender.min() > 1.0
    assert slender.max() < 3.5
    middles = (upper.nodes[upper.elements[:, :4]] + np.roll(upper.nodes[upper.elements[:, :4]], -1, axis=1)) / 2
    assert upper.nodes[upper.elements[:, 4:]] == pytest.approx(middles)


def test_two_parts_meet_node_by_node():
    mesh, section = meshed(TYPICAL, 90.0)
    upper, lower = mesh.upper, mesh.lower
    assert 70 <= len(upper.elements) <= 110
    # With rows that grow away from the small elements at the ends of the crack.
    assert 80 <= len(lower.elements) <= 140
    assert lower.nodes[lower.crack] == pytest.approx(upper.nodes[upper.crack], abs=1e-12)
    assert lower.nodes[lower.fixed] == pytest.approx(np.column_stack([np.linspace(0, 80, 17), np.zeros(17)]))
    assert area(upper) == pytest.approx(section.area)
    assert area(lower) == pytest.approx(4040.0 - section.area)


def test_crack_at_a_height_has_small_elements_at_both_ends():
    mesh, _ = meshed(TYPICAL, 90.0)
    # Of 8 each is twice as long as the one before it, up to the middle of the 8 m.
    halves = np.array([1.0, 2.0, 4.0, 8.0])
    lengths = np.concatenate([halves, halves[::-1]]) * 4.0 / halves.sum()
    for body in bodies(mesh):
        assert np.diff(body.nodes[body.crack[::2], 0]) == pytest.approx(lengths)
        # At the distance of the width from the crack all elements of a row are equal again.
        levels = np.unique(body.nodes[body.upstream[::2], 1])
        far = levels[np.abs(levels - 90.0) >= 8.0]
        for level in far:
            row = np.sort(body.nodes[np.abs(body.nodes[:, 1] - level) < 1e-9, 0])
            assert np.diff(row) == pytest.approx((row[-1] - row[0]) / 16)
        assert len(far) > 1
        # Neither needles at the ends nor rows thicker than the elements are there.
        thin = np.abs(np.diff(body.nodes[body.upstream[::2], 1]))
        assert thin[np.argmin(np.abs(levels[:-1] - 90.0))] == pytest.approx(lengths[0], rel=0.5)


def test_each_graded_element_is_two_of_twice_as_many():
    fine, coarse = (meshed(TYPICAL, 90.0, elements_across=across)[0].upper for across in (16, 8))
    assert fine.nodes[fine.crack[::4]] == pytest.approx(coarse.nodes[coarse.crack[::2]])


@pytest.mark.parametrize(
    ("elevation", "options"),
    [
        (0.0, {}),
        (90.0, {"damping": "thesis"}),
        (90.0, {"virtual_mass": "thesis"}),
        (90.0, {"contact": "idce", "damping": "stiffness"}),
        (90.0, {"elements_away": 4}),
        (90.0, {"elements_across": 2}),
    ],
    ids=["base", "damping", "virtual mass", "penalties", "rows that grow", "few"],
)
def test_other_meshes_stay_even(elevation, options):
    mesh, section = meshed(TYPICAL, elevation, **options)
    face = mesh.upper.nodes[mesh.upper.crack, 0]
    assert face == pytest.approx(np.linspace(0.0, section.crack_width, face.size))


def test_another_number_of_elements_below():
    mesh, _ = meshed(TYPICAL, 90.0, elements_across=6, elements_across_below=4)
    assert (len(mesh.upper.crack), len(mesh.lower.crack)) == (13, 9)
    assert len(mesh.lower.elements) % 4 == 0


@settings(max_examples=30)
@given(dams(), st.integers(0, 9), st.integers(1, 5), st.integers(1, 5))
def test_mesh_has_the_shape_of_the_section(corners, tenths, across, below):
    top = max(z for _, z in corners)
    options = {"elements_across": across, "elements_across_below": below}
    assume(not flat(corners))
    mesh, section = meshed(corners, tenths / 10 * top, **options)
    whole = make(corners).cut.area
    for body, wanted, name in zip(bodies(mesh), (section.area, whole - section.area), ("upper", "lower"), strict=False):
        check_elements(body.nodes, body.elements, name)
        check_pieces(body.nodes, body.elements, name)
        assert area(body) == pytest.approx(wanted, rel=1e-9)
        assert body.nodes[body.crack[[0, -1]]] == pytest.approx(np.array([section.heel, section.toe]))
    assert len(mesh.upper.crack) == 2 * across + 1
    size = 1e-9 * top
    assert np.all(on_polyline(mesh.upper.nodes[mesh.upper.upstream], section.upstream_face) < size)
    assert np.all(on_polyline(mesh.upper.nodes[mesh.upper.downstream], section.downstream_face) < size)
    for face, line in (("upstream", section.upstream_face), ("downstream", section.downstream_face)):
        ends = mesh.upper.nodes[getattr(mesh.upper, face)[[0, -1]]]
        assert ends == pytest.approx(line[[0, -1]])
        # Every kink of the face is a corner node.
        nodes = mesh.upper.nodes[getattr(mesh.upper, face)[::2]]
        assert np.all(np.abs(nodes[:, None] - line).max(axis=2).min(axis=0) < size)


@pytest.mark.parametrize("elevation", [0.0, 40.0, 90.0])
@pytest.mark.parametrize(("across", "away", "halvings"), [(32, 4, 3), (24, 5, 2), (20, 5, 1), (10, 5, 0), (80, 10, 3)])
def test_rows_grow_away_from_the_crack(elevation, across, away, halvings):
    mesh, section = meshed(TYPICAL, elevation, elements_across=across, elements_away=away)
    # Rows that stay as many are those of a graded crack.
    even, _ = meshed(TYPICAL, elevation, elements_across=across, **({"virtual_mass": "thesis"} if halvings else {}))
    assert make(TYPICAL, flexible={"elements_across": across, "elements_away": away}).flexible.row_counts() == (
        across // 2**halvings,
        halvings,
    )
    for body, other, wanted in zip(bodies(mesh), bodies(even), (section.area, 4040.0 - section.area), strict=False):
        check_elements(body.nodes, body.elements, "typical")
        check_pieces(body.nodes, body.elements, "typical")
        assert area(body) == pytest.approx(wanted, rel=1e-9)
        assert body.nodes[body.crack] == pytest.approx(other.nodes[other.crack], abs=1e-9)
        assert len(np.unique(body.elements)) == len(body.nodes)
        assert halvings == 0 or len(body.nodes) < (0.5 if halvings > 2 else 0.8) * len(other.nodes)
    far = mesh.upper.nodes[:, 1].max()
    assert np.sum(np.isclose(mesh.upper.nodes[:, 1], far)) == 2 * across // 2**halvings + 1


@settings(max_examples=30)
@given(dams(), st.integers(0, 9))
def test_graded_rows_have_the_shape_of_the_section(corners, tenths):
    assume(not flat(corners))
    elevation = tenths / 10 * max(z for _, z in corners)
    mesh, section = meshed(corners, elevation, elements_across=16, elements_away=3)
    whole = make(corners).cut.area
    for body, wanted in zip(bodies(mesh), (section.area, whole - section.area), strict=False):
        check_elements(body.nodes, body.elements, "graded")
        check_pieces(body.nodes, body.elements, "graded")
        assert area(body) == pytest.approx(wanted, rel=1e-9)
    assert len(mesh.upper.crack) == 33


@settings(max_examples=30)
@given(dams(), st.integers(0, 9))
def test_mirror_image(corners, tenths):
    assume(not flat(corners))
    elevation = tenths / 10 * max(z for _, z in corners)
    one, _ = meshed(corners, elevation, elements_across=3)
    two, _ = meshed([(-x, z) for x, z in corners], elevation, elements_across=3)
    for body, image in zip(bodies(one), bodies(two), strict=True):
        assert image.nodes[image.crack] == pytest.approx(body.nodes[body.crack][::-1] * [-1, 1])
        assert image.nodes[image.upstream] == pytest.approx(body.nodes[body.downstream] * [-1, 1])
        assert len(image.nodes) == len(body.nodes)


@pytest.mark.parametrize("across", range(2, 10))
@pytest.mark.parametrize("apex", [0.0, 30.0, 80.0, 100.0])
def test_pointed_crest(across, apex):
    mesh, _ = meshed([(0.0, 0.0), (80.0, 0.0), (apex, 100.0)], elements_across=across)
    check_elements(mesh.upper.nodes, mesh.upper.elements, "upper")
    check_pieces(mesh.upper.nodes, mesh.upper.elements, "upper")
    assert area(mesh.upper) == pytest.approx(4000.0)
    for face, start in ((mesh.upper.upstream, 0.0), (mesh.upper.downstream, 80.0)):
        nodes = mesh.upper.nodes[face]
        assert nodes[[0, -1]] == pytest.approx(np.array([(start, 0.0), (apex, 100.0)]))
        assert np.all(on_polyline(nodes, nodes[[0, -1]]) < 1e-9)


def test_kinks_at_almost_the_same_height_share_a_line():
    kinked = [(0.0, 0.0), (80.0, 0.0), (12.0, 80.01), (8.0, 100.0), (0.0, 100.0), (-2.0, 80.0)]
    mesh, section = meshed(kinked)
    straight, _ = meshed([(x, round(z)) for x, z in kinked])
    assert len(mesh.upper.elements) == len(straight.upper.elements)
    assert area(mesh.upper) == pytest.approx(section.area)


@pytest.mark.parametrize(
    ("corners", "elevation"),
    [
        ([(0, 0), (10, 0), (10, 5), (8, 5), (8, 12), (0, 12)], 2.0),  # a ledge in the upper part
        ([(0, 0), (10, 0), (10, 5), (8, 5), (8, 12), (0, 12)], 6.0),  # in the lower
        ([(0, 0), (10, 0), (10, 5), (8, 5), (8, 12), (0, 12)], 5.0),  # at the crack, on the lower
        ([(0, 0), (8, 0), (8, 5), (10, 5), (10, 12), (0, 12)], 5.0),  # on the upper
        ([(0, 0), (10, 0), (10, 12), (5, 12), (7, 8), (6, 9), (0, 9)], 0.0),  # doubles back
        ([(0, 0), (10, -1), (10, 12), (0, 12)], 5.0),  # the base is not level
        ([(0, 0), (4, 0), (4, 1), (6, 1), (6, 0), (10, 0), (10, 12), (0, 12)], 5.0),  # in two pieces
        ([(0, 0), (10, 0), (10, 12), (9, 12.01), (0, 12)], 0.0),  # a crest with a hump
    ],
)
def test_section_that_rows_cannot_follow(corners, elevation):
    with pytest.raises(InputError, match=r"section: has a ledge.*flexible\.mesh_above"):
        meshed([(float(x), float(z)) for x, z in corners], elevation)


def test_layer_too_thin():
    with pytest.raises(InputError, match=r"section: has a layer of 1e-06 m at z = 0 m, too thin"):
        meshed(TYPICAL, 1e-6)


def test_tip_needs_two_elements_across():
    with pytest.raises(
        InputError,
        match=r"flexible\.elements_across: 1 is out of range; give a value of at least 2, as the crest is pointed",
    ):
        meshed(TRIANGLE, elements_across=1)


def test_local_coordinates_of_the_nodes():
    # One element that is its own local square: the gradients are those of the identity.
    nodes = np.vstack([CORNERS, MIDDLES])
    result = jacobians(nodes, np.arange(8)[None], np.array([(0.3, -0.7), (-1.0, 1.0), (0.0, 0.0)]))
    assert result == pytest.approx(np.broadcast_to(np.eye(2), (1, 3, 2, 2)))
