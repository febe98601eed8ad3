"""Kinks, anchors and bonds of an elastic dam shaken across the valley: closed forms, modal analysis, limits."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.sparse.linalg import eigsh

from heeltoe.kernel.shaking import Shaking
from heeltoe.models.flexible.body.across import across_dam
from heeltoe.models.flexible.body.elastic import scalar_matrices
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.body.step import longest_step
from models.flexible.test_cross_valley import BOND, STEP, case_of, made, shaken
from shared.dams import plane_case
from validation.blocks.elastic_cracks import sawtooth

G = 9.80665


def pushed(horizontal: float, cross: float, seconds: float) -> Shaking:
    """Return a ground that accelerates steadily."""
    return Shaking(np.array([0.0, seconds]), np.full(2, horizontal), cross=np.full(2, cross))


# Kinks


def test_kinks_of_no_height_are_none():
    straight, flat = (
        shaken(case_of(0.9, crack={"elevation": "20 m"} | kinks), made(2.0)).run(STEP, 0.01)
        for kinks in ({}, {"kinks": [["30 m", "0 m"]]})
    )
    assert abs(straight.summary.cross_slip) > 1e-4
    assert flat.frames.slip_cross.tobytes() == straight.frames.slip_cross.tobytes()
    assert flat.frames.slip.tobytes() == straight.frames.slip.tobytes()


def test_a_sawtooth_is_climbed_askew_as_a_point_on_a_slope_goes():
    """On a flank the pushes up the slope and across it are constant, and so is friction: the block goes straight along
    their resultant."""
    rise, friction = math.radians(10.0), 0.3
    push, across = 1.2 * G * math.tan(math.atan(friction) + rise), 0.5 * G
    normal = G * math.cos(rise) + push * math.sin(rise)
    uphill = push * math.cos(rise) - G * math.sin(rise)
    resultant = math.hypot(uphill, across)
    rate = (resultant - friction * normal) / resultant
    # Friction uses up less along the stream than it would alone.
    assert uphill * rate > 1.3 * (uphill - friction * normal)
    seconds = 0.25
    case = sawtooth(rise, friction, push)
    run = shaken(case, pushed(-push, -across, seconds)).run(1e-4, 0.01)
    assert run.summary.slip == pytest.approx(0.5 * uphill * rate * seconds**2 * math.cos(rise), rel=0.04)
    assert run.summary.cross_slip == pytest.approx(0.5 * across * rate * seconds**2, rel=0.04)
    assert run.summary.energy_residual < 1e-12


# Anchors


def block(elevation: str, stiffness: float):
    """Return a stiff block of 4 m x 1 m with a dowel, cracked at a height."""
    return plane_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["4 m", "0 m"], ["4 m", "1 m"], ["0 m", "1 m"]]},
            "concrete": {"density": "2400 kg/m^3", "modulus": "2000 GPa", "poisson": 0.0},
            "crack": {"friction": 0.3, "elevation": elevation},
            "uplift": {"pattern": "none"},
            "anchors": [{"distance": "2 m", "shear_stiffness": f"{stiffness} N/m/m", "prestress": "0 N/m"}],
            "flexible": {"elements_across": 2, "evidence": "none", "time_step": "2e-5 s"},
        }
    )


@pytest.mark.parametrize(("elevation", "mass"), [("0 m", 9600.0), ("0.5 m", 4800.0)])
def test_a_dowel_stops_a_block_across_the_valley_where_the_closed_form_says(elevation, mass):
    # A push of 0.5 m g against friction 0.3 m g and a spring: half a cosine to 2 (0.5 - 0.3) m g / k, where it stays.
    stiffness, angle = 4e6, math.radians(60.0)
    expected = 2.0 * 0.2 * mass * G / stiffness
    shaking = pushed(-0.5 * G * math.cos(angle), -0.5 * G * math.sin(angle), 0.4)
    run = shaken(block(elevation, stiffness), shaking).run(2e-5, 0.01)
    summary = run.summary
    assert math.hypot(summary.slip, summary.cross_slip) == pytest.approx(expected, rel=0.01)
    assert math.atan2(summary.cross_slip, summary.slip) == pytest.approx(angle, abs=0.005)
    omega = math.sqrt(stiffness / mass)
    way = 0.5 * expected * (1.0 - np.cos(omega * np.minimum(run.frames.time, math.pi / omega)))
    assert run.frames.slip_cross == pytest.approx(way * math.sin(angle), abs=0.01 * expected)
    assert summary.energy_residual < 1e-12


def test_the_step_follows_dowels_and_bonds_across_the_valley():
    for more, field in (
        ({"anchors": [{"distance": "40 m", "shear_stiffness": "1e7 MN/m/m", "prestress": "0 N/m"}]}, "anchors"),
        ({"crack": {"bond": BOND | {"shear_energy": "1 N/m"}}}, "crack.bond"),
    ):
        case = case_of(1.0, **more)
        dam = build_flexible_dam(case)
        across = across_dam(case, dam).parts
        step, asked = longest_step(dam, 0.5, 1e-2, across)
        assert asked == field
        # By the mass that a node moves at once, each direction asks for about the same.
        assert longest_step(dam, 0.5, 1e-2)[0] / 2.0 <= step <= longest_step(dam, 0.5, 1e-2)[0] < 1e-2


# Bonds

STRONG = {
    "tensile_strength": "50 MPa",
    "cohesion": "60 MPa",
    "fracture_energy": "10 MN/m",
    "shear_energy": "10 MN/m",
}


def test_a_strength_beyond_reach_is_the_bonded_dam():
    """The crest moves as modal analysis of the whole dam has it, in which nothing takes energy."""
    concrete = {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143, "damping": 1e-9}
    case = case_of(1.0, crack={"elevation": "20 m", "bond": STRONG}, concrete=concrete)
    shaking = made(1.0)
    dam = build_flexible_dam(case)
    run = shaken(case, shaking).run(1e-4)
    assert run.summary.cross_slip_max < 1e-12
    assert run.summary.energy_fracture < 1e-9 * run.summary.energy_turnover
    # One field over the nodes of both parts, those of the joint once.
    matrices = [scalar_matrices(case, body.mesh) for body in dam.bodies]
    stiffness, mass = (sparse.block_diag([pair[k] for pair in matrices]) for k in (0, 1))
    upper, lower = (body.mesh for body in dam.bodies)
    count = len(upper.nodes)
    whole = np.arange(count + len(lower.nodes))
    whole[count + lower.crack] = upper.crack
    free = np.setdiff1d(whole, count + lower.fixed)
    tie = sparse.coo_array((np.ones(whole.size), (np.arange(whole.size), whole))).tocsc()[:, free]
    squares, shapes = eigsh(tie.T @ stiffness @ tie, 12, tie.T @ mass @ tie, sigma=0.0)
    pushes = shapes.T @ (tie.T @ mass @ np.ones(whole.size))
    crest = int(np.flatnonzero(free == upper.upstream[-1])[0])
    time = 1e-4 * np.arange(len(run.crest_cross))
    expected = np.zeros(time.size)
    for square, shape, push in zip(squares, shapes[crest], pushes, strict=True):
        expected += shape * push * _swing(math.sqrt(square), time, shaking)
    assert np.abs(expected).max() > 1e-3
    assert run.crest_cross == pytest.approx(expected, abs=0.01 * np.abs(expected).max())


def _swing(omega, time, shaking):
    """Return how far a mass on a spring goes on a ground whose acceleration follows straight lines (Nigam and Jennings
    1969, without damping)."""
    result, moves, speed = np.zeros(time.size), 0.0, 0.0
    step = time[1]
    cosine, sine = math.cos(omega * step), math.sin(omega * step)
    ground = -np.interp(time, shaking.time, shaking.cross)
    for k in range(time.size - 1):
        slope, static = (ground[k + 1] - ground[k]) / step / omega**2, ground[k] / omega**2
        away, faster = moves - static, speed - slope
        moves = static + slope * step + away * cosine + faster * sine / omega
        speed = slope - away * omega * sine + faster * cosine
        result[k + 1] = moves
    return result


def test_a_bond_of_hardly_any_strength_is_that_of_a_crack():
    faint = {
        "tensile_strength": "1 Pa",
        "cohesion": "1 Pa",
        "fracture_energy": "0.001 N/m",
        "shear_energy": "0.001 N/m",
    }
    crack, joint = (shaken(case_of(0.9, crack=bond), made(2.0)).run(STEP).summary for bond in ({}, {"bond": faint}))
    assert abs(crack.cross_slip) > 1e-4
    assert [joint.slip, joint.cross_slip] == pytest.approx([crack.slip, crack.cross_slip], rel=1e-6)


def test_the_shaking_across_the_valley_breaks_a_joint_that_holds_without_it():
    case, shaking = case_of(1.0, crack={"elevation": "20 m", "bond": BOND | {"cohesion": "3 MPa"}}), made(2.0)
    with_it, without = (shaken(case, item).run(2e-4).summary for item in (shaking, shaking.along_stream()))
    assert with_it.energy_fracture > 1.05 * without.energy_fracture > 0.0


def test_a_joint_under_faint_shaking_across_the_valley_goes_over_into_that_of_one_component():
    case, shaking = case_of(1.0, crack={"elevation": "20 m", "bond": BOND}), made(2.0)
    alone = shaken(case, shaking.along_stream()).run(STEP).summary
    faint = shaken(case, replace(shaking, cross=1e-9 * shaking.cross)).run(STEP).summary
    # The spring of its bond is one for all directions, and a little softer than that of one.
    assert faint.slip == pytest.approx(alone.slip, rel=1e-4)
    assert faint.energy_fracture == pytest.approx(alone.energy_fracture, rel=2e-3)
    assert 0.0 < abs(faint.cross_slip) < 1e-8
