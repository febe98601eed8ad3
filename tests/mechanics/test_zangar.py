"""Zangar's pressure against slow sums, potential flow, and what it is chosen for."""

from __future__ import annotations

import math

import numpy as np
import pytest

import heeltoe
from heeltoe.mechanics.virtual_water import moving_force, virtual_mass
from heeltoe.mechanics.zangar import coefficient, zangar
from shared.outlines import make
from shared.potential_flow import leaning, push

ZANGAR = {"depth": "36 m", "hydrodynamic": "zangar"}
SLOPED = [(0.0, 0.0), (40.0, 0.0), (12.0, 40.0), (6.0, 40.0), (6.0, 30.0)]


def by_strips(depth, foot, face, unit):
    """Sums of the pressure over the heights of a face from `foot` up, whose place is given by `face`."""
    count = round((depth - foot) * 1e4)
    z = foot + (depth - foot) * (np.arange(count) + 0.5) / count
    t = (depth - z) / depth
    m = unit * depth * (t * (2 - t) + np.sqrt(t * (2 - t))) / 2.0 * (depth - foot) / count
    x, slope = face(z)
    return m.sum(), m @ (z - foot), m @ (z - foot) ** 2, m @ slope, m @ (slope * x)


@pytest.mark.parametrize("elevation", [0.0, 10.0])
def test_sums_against_strips(elevation):
    case = make(SLOPED, elevation, reservoir=ZANGAR)
    # Ten of forty metres are vertical: the line from the foot to where 36 m of water meet the face.
    unit = 1000 * coefficient(6.0 / 36.0)
    result = zangar(case, case.reservoir, upstream=True)
    heel = 6.0 * elevation / 30.0
    slow = by_strips(36.0, elevation, lambda z: (np.minimum(z / 5.0, 6.0) - heel, np.where(z < 30.0, 0.2, 0.0)), unit)
    assert [result.mass, result.first, result.second, result.lift, result.turning] == pytest.approx(slow, rel=1e-6)


def test_the_block_feels_the_horizontal_part():
    case = make(SLOPED, 10.0, reservoir=ZANGAR)
    sums, water = zangar(case, case.reservoir, upstream=True), virtual_mass(case)
    assert (water.mass, water.height) == pytest.approx((sums.mass, sums.first / sums.mass))
    assert water.inertia == pytest.approx(sums.second - sums.first**2 / sums.mass)
    plain = make(SLOPED, 10.0, reservoir={"depth": "36 m"})
    assert 0.8 < water.mass / virtual_mass(plain).mass < 1.0
    assert heeltoe.build_block(case).water.mass == water.mass


def test_the_push_downstream_presses_a_slope_down():
    case = make(SLOPED, reservoir=ZANGAR, tailwater=ZANGAR | {"depth": "8 m"})
    force = moving_force(case, -2.0)
    up, down = (zangar(case, side, upstream=way) for side, way in ((case.reservoir, True), (case.tailwater, False)))
    assert force.horizontal == pytest.approx(2.0 * (up.mass + down.mass))
    assert force.vertical == pytest.approx(-2.0 * (up.lift + down.lift))
    assert up.lift > 0.0 > down.lift
    # Normal to a straight slope of 28 in 40 all the way.
    assert down.lift == pytest.approx(-0.7 * down.mass)


def test_a_face_that_is_vertical_for_half_its_height_counts_as_vertical():
    corners = [(0.0, 0.0), (40.0, 0.0), (12.0, 40.0), (6.0, 40.0), (6.0, 20.0)]
    case = make(corners, reservoir=ZANGAR)
    slow = by_strips(36.0, 0.0, lambda z: (z, z), 735.0)
    assert zangar(case, case.reservoir, upstream=True).mass == pytest.approx(slow[0], rel=1e-6)


def test_an_overhang_has_the_pressure_of_a_vertical_face():
    assert coefficient(-0.3) == coefficient(0.0) == 0.735


@pytest.mark.parametrize("degrees", [30, 60])
def test_the_curve_is_that_of_potential_flow(degrees):
    """An electric analogy is potential flow. C_m is the largest pressure on a face, which falls less with the slope
    than what the whole face is pushed with: the sums stay on the safe side, by up to 0.06 of a vertical face's."""
    upright, result = (push(leaning(angle), columns=40, rows=16)[0] for angle in (0.0, float(degrees)))
    share = coefficient(math.tan(math.radians(degrees))) / coefficient(0.0)
    assert -0.01 < share - result / upright < 0.065


def test_the_static_checks_take_it():
    statics = {"seismic_coefficient": 0.1}
    case = make(SLOPED, reservoir=ZANGAR, statics=statics)
    pushed = next(item for item in heeltoe.statics(case).cases if item.name == "pseudo-static downstream")
    line = next(line for line in pushed.sheet().lines if line.name == "hydrodynamic")
    sums = zangar(case, case.reservoir, upstream=True)
    assert line.horizontal_n == pytest.approx(0.980665 * sums.mass)
    assert line.vertical_n == pytest.approx(-0.980665 * sums.lift)
    assert line.height_m == pytest.approx(sums.first / sums.mass)
    assert str(line.source) == "Zangar's water times -0.1 g of the ground"
