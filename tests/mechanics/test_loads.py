"""Forces on the part above the crack: hand values, Archimedes, mirror images, numeric integration."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from heeltoe.mechanics import loads, virtual_water
from shared.dams import TYPICAL
from shared.outlines import by_strips, dams, make

G = 9.80665


def deep(depth, **more):
    return {"depth": f"{depth!r} m", **more}


def solved(corners, elevation=0.0, **more):
    return make(corners, elevation, **more)


def test_typical_dam_by_hand():
    case = solved(TYPICAL, reservoir=deep(100.0), concrete={"density": "2650 kg/m^3"})
    weight, reservoir, tailwater, uplift = loads.static_forces(case)
    mass = 2650 * 4040.0
    assert (weight.horizontal, weight.vertical) == (0.0, pytest.approx(-mass * G))
    assert weight.moment == pytest.approx(-2650 * G * (800 * 4 + 3240 * 32))
    push = 1000 * G * 100**2 / 2
    assert (reservoir.horizontal, reservoir.vertical) == (pytest.approx(push), 0.0)
    assert reservoir.moment == pytest.approx(-push * 100 / 3)
    lift = 1000 * G * 100 * 80 / 2
    assert (uplift.horizontal, uplift.vertical) == (0.0, pytest.approx(lift))
    assert uplift.moment == pytest.approx(lift * 80 / 3)
    assert (tailwater.horizontal, tailwater.vertical, tailwater.moment) == (0.0, 0.0, 0.0)


def test_typical_dam_about_its_reference_point():
    # The reference point of the rigid model is as high as the common centre of concrete and virtual water.
    case = solved(TYPICAL, reservoir=deep(100.0), concrete={"density": "2650 kg/m^3"})
    water = virtual_water.virtual_mass(case)
    assert water.mass == pytest.approx(7 / 12 * 1000 * 100**2)
    assert water.height == pytest.approx(40.0)
    mass = loads.concrete_mass(case)
    assert mass == pytest.approx(10_706_000.0)
    height = (mass * case.cut.centroid[1] + water.mass * water.height) / (mass + water.mass)
    assert height == pytest.approx((2650 * (800 * 50 + 3240 * 30) + 5_833_333.3333 * 40) / 16_539_333.3333)
    inertia = case.concrete.density * case.cut.polar_inertia
    inertia += mass * (case.cut.centroid[1] - height) ** 2 + water.mass * (water.height - height) ** 2
    x = 106880 / 4040
    by_hand = 2650 * 800 * ((8**2 + 100**2) / 12 + (4 - x) ** 2 + (50 - height) ** 2)
    by_hand += 2650 * 3240 * ((72**2 + 90**2) / 18 + (32 - x) ** 2 + (30 - height) ** 2)
    by_hand += 5_833_333.3333 * (40 - height) ** 2
    assert inertia == pytest.approx(by_hand, rel=1e-9)
    about = loads.total("all", loads.static_forces(case)).moment_about(case.cut.centroid[0], height)
    push, lift = 1000 * G * 5000, 1000 * G * 4000
    assert about == pytest.approx(push * (height - 100 / 3) + lift * (80 / 3 - x))


def test_gravity_and_density_of_the_case():
    light = {"gravity": "1.62 m/s^2", "reservoir": deep(6.0, density="1030 kg/m^3")}
    case = solved([(0.0, 0.0), (4.0, 0.0), (4.0, 8.0), (0.0, 8.0)], **light)
    weight, reservoir, _, uplift = loads.static_forces(case)
    assert weight.vertical == pytest.approx(-2400 * 32 * 1.62)
    assert reservoir.horizontal == pytest.approx(1030 * 1.62 * 18)
    assert uplift.vertical == pytest.approx(1030 * 1.62 * 6 * 4 / 2)


@given(dams(), st.floats(0.0, 0.9), st.floats(0.0, 1.0))
def test_archimedes(corners, part, filling):
    # The same water on both sides and in all of the crack lifts the block by the weight of what it displaces.
    top = max(z for _, z in corners)
    water = deep(filling * top)
    case = solved(corners, part * top, reservoir=water, tailwater=water, uplift={"pattern": "uniform"})
    _, reservoir, tailwater, uplift = loads.static_forces(case)
    force = loads.total("water", (reservoir, tailwater, uplift))
    level, surface = case.cut.crack_elevation, case.reservoir.depth
    scale = 1000 * G * top * 100
    if surface <= level:
        assert (force.horizontal, force.vertical, force.moment) == (0.0, 0.0, 0.0)
        return
    area, x, *_ = by_strips(corners, level)
    if surface < top:
        dry, dry_x, *_ = by_strips(corners, surface)
        x = (area * x - dry * dry_x) / (area - dry) if area > dry else 0.0
        area -= dry
    assert force.horizontal == pytest.approx(0.0, abs=1e-12 * scale)
    assert force.vertical == pytest.approx(1000 * G * area, abs=1e-10 * scale)
    assert force.moment == pytest.approx(1000 * G * area * (x - case.cut.heel[0]), abs=1e-8 * scale)


@given(dams(), st.floats(0.0, 0.9), st.floats(0.0, 1.0))
def test_push_of_the_reservoir_does_not_depend_on_the_shape_of_the_face(corners, part, filling):
    top = max(z for _, z in corners)
    case = solved(corners, part * top, reservoir=deep(filling * top))
    h = max(0.0, case.reservoir.depth - case.cut.crack_elevation)
    assert loads.reservoir_pressure(case).horizontal == pytest.approx(1000 * G * h * h / 2, abs=1e-6)


@given(dams(), st.floats(0.0, 0.8), st.floats(0.0, 1.0))
def test_reservoir_against_numeric_integration(corners, part, filling):
    top = max(z for _, z in corners)
    case = solved(corners, part * top, reservoir=deep(filling * top))
    expected = np.zeros(3)
    for start, end in zip(case.cut.upstream_face[:-1], case.cut.upstream_face[1:], strict=True):
        s = (np.arange(4000) + 0.5) / 4000
        x, z = (start + s[:, None] * (end - start)).T
        pressure = 1000 * G * np.maximum(0.0, case.reservoir.depth - z) / 4000
        fx, fz = pressure * (end - start)[1], -pressure * (end - start)[0]
        moment = (x - case.cut.heel[0]) * fz - (z - case.cut.heel[1]) * fx
        expected += [fx.sum(), fz.sum(), moment.sum()]
    result = loads.reservoir_pressure(case)
    tolerance = 1e-5 * 1000 * G * 100 * 100
    assert (result.horizontal, result.vertical) == pytest.approx(expected[:2], rel=1e-5, abs=tolerance)
    assert result.moment == pytest.approx(expected[2], rel=1e-5, abs=100 * tolerance)


@given(dams(), st.floats(0.0, 0.9), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_mirror_image(corners, part, up, down):
    top = max(z for _, z in corners)
    mirrored = [(-x, z) for x, z in corners]
    case = solved(corners, part * top, reservoir=deep(up * top), tailwater=deep(down * top))
    image = solved(mirrored, part * top, reservoir=deep(down * top), tailwater=deep(up * top))
    one, two = loads.static_forces(case), loads.static_forces(image)
    for force, reflected in zip(one, (two[0], two[2], two[1], two[3]), strict=True):
        assert reflected.horizontal == pytest.approx(-force.horizontal, abs=1e-4)
        assert reflected.vertical == pytest.approx(force.vertical, abs=1e-4)
        about_toe = force.moment_about(case.cut.crack_width, 0.0)
        assert reflected.moment == pytest.approx(-about_toe, rel=1e-9, abs=1.0)


def test_inclined_face_carries_the_water_above_it():
    # Upstream slope of 3 m over 6 m of water: 9 m^2 of water stand on it, their centre 1 m from the heel.
    case = solved([(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (3.0, 6.0)], reservoir=deep(6.0))
    force = loads.reservoir_pressure(case)
    assert (force.horizontal, force.vertical) == pytest.approx((1000 * G * 18, -1000 * G * 9))
    assert force.moment == pytest.approx(1000 * G * (-18 * 2 - 9 * 1))


RECTANGLE = [(0.0, 0.0), (8.0, 0.0), (8.0, 12.0), (0.0, 12.0)]


@pytest.mark.parametrize(
    ("uplift", "tail", "points"),
    [
        ({"pattern": "none"}, 6.0, [(0, 0), (8, 0)]),
        ({"pattern": "uniform"}, 6.0, [(0, 8), (8, 8)]),
        ({"pattern": "triangular"}, 2.0, [(0, 8), (8, 0)]),
        ({"pattern": "triangular"}, 6.0, [(0, 8), (8, 4)]),
        ({"pattern": "triangular", "intensity": 0.5}, 6.0, [(0, 4), (8, 2)]),
        ({"pattern": "cut-off", "extent": 0.5}, 2.0, [(0, 8), (4, 0), (8, 0)]),
        ({"pattern": "cut-off triangular", "extent": 0.5}, 6.0, [(0, 8), (4, 4), (8, 4)]),
        (
            {"pattern": "drained", "drain_position": 0.25, "drain_efficiency": "75 %"},
            6.0,
            [(0, 8), (2, 5), (8, 4)],
        ),
        (
            {"pattern": "drained", "drain_position": 0.25, "drain_efficiency": 1},
            2.0,
            [(0, 8), (2, 0), (8, 0)],
        ),
        (
            {"pattern": "drained", "drain_position": 0.25, "drain_efficiency": 0},
            2.0,
            [(0, 8), (2, 8), (8, 0)],
        ),
        (
            {"pattern": "profile", "points": [[0, "8 m"], [0.5, "8 m"], [0.5, "1 m"], [1, "0 m"]]},
            6.0,
            [(0, 8), (4, 8), (4, 1), (8, 0)],
        ),
    ],
)
def test_uplift_patterns(uplift, tail, points):
    # The crack is 2 m above the base, 10 m of water in front: 8 m of head at the heel.
    case = solved(RECTANGLE, 2.0, reservoir=deep(10.0), tailwater=deep(tail), uplift=uplift)
    expected = np.array(points) * [1.0, 1000 * G]
    assert loads.uplift_profile(case) == pytest.approx(expected)
    force = loads.uplift(case)
    x = (np.arange(80_000) + 0.5) * 1e-4
    pressure = np.interp(x, *expected.T)
    assert force.vertical == pytest.approx(pressure.sum() * 1e-4, rel=1e-6)
    assert force.moment == pytest.approx((x * pressure).sum() * 1e-4, rel=1e-6)
    assert force.horizontal == 0.0


@pytest.mark.parametrize(
    ("waters", "density"),
    [
        ({"tailwater": {"depth": "6 m", "density": "1200 kg/m^3"}}, 1200.0),
        ({"reservoir": deep(10.0), "tailwater": {"depth": "6 m", "density": "1200 kg/m^3"}}, 1000.0),
        ({"reservoir": {"depth": "10 m", "density": "1100 kg/m^3"}}, 1100.0),
    ],
)
def test_heads_of_a_profile_are_of_the_water_that_is_there(waters, density):
    """A mean head of 3 m over a crack 8 m wide, by hand."""
    points = [[0, "4 m"], [1, "2 m"]]
    case = solved(RECTANGLE, 2.0, uplift={"pattern": "profile", "points": points}, **waters)
    assert loads.uplift(case).vertical == pytest.approx(density * G * 3.0 * 8.0, rel=1e-12)


def test_water_below_the_crack_does_nothing():
    case = solved(RECTANGLE, 6.0, reservoir=deep(6.0), tailwater=deep(5.0))
    assert all(force.moment == force.vertical == force.horizontal == 0.0 for force in loads.static_forces(case)[1:])
    assert virtual_water.virtual_mass(case) == virtual_water.VirtualMass(0.0, 0.0)


def test_dry_dam():
    case = solved(RECTANGLE)
    assert loads.total("water", loads.static_forces(case)[1:]) == loads.Resultant("water", 0.0, 0.0, 0.0)
    assert virtual_water.virtual_mass(case) == virtual_water.VirtualMass(0.0, 0.0)


@pytest.mark.parametrize(("crack", "depth"), [(0.0, 12.0), (3.0, 10.0), (9.0, 12.0)])
def test_virtual_mass_against_numeric_integration(crack, depth):
    case = solved(RECTANGLE, crack, reservoir=deep(depth))
    eta = crack + (depth - crack) * (np.arange(1_000_000) + 0.5) / 1_000_000
    strip = 7 / 8 * 1000 * np.sqrt(depth * (depth - eta)) * (depth - crack) / 1_000_000
    water = virtual_water.virtual_mass(case)
    assert water.mass == pytest.approx(math.fsum(strip), rel=1e-7)
    assert water.height == pytest.approx(math.fsum(strip * (eta - crack)) / math.fsum(strip), rel=1e-7)


def test_moment_about_another_point():
    force = loads.Resultant("one", horizontal=2.0, vertical=3.0, moment=5.0)
    # Seen from a point 7 to the right and 11 up, the same force at the heel acts 7 to the left and 11 down.
    assert force.moment_about(7.0, 11.0) == 5.0 + (-7.0) * 3.0 - (-11.0) * 2.0


def test_where_a_face_with_a_ledge_is():
    ledge = [(0.0, 0.0), (60.0, 0.0), (10.0, 70.0), (6.0, 70.0), (2.0, 20.0), (0.0, 20.0)]
    section = solved(ledge, 5.0).cut
    result = [loads.face_at(section, height) for height in (0.0, 10.0, 15.0, 40.0, 65.0, 80.0)]
    assert result == pytest.approx([0.0, 0.0, 2.0, 4.0, 6.0, 6.0])
