"""The water that moves with a dam: slopes and both faces, against integrals and potential flow."""

import math

import numpy as np
import pytest

from heeltoe import flexible, rigid
from heeltoe.kernel.block import VARYING
from heeltoe.mechanics.block import build_block
from heeltoe.mechanics.references import REFERENCES
from heeltoe.mechanics.virtual_water import slope_factor, virtual_mass
from heeltoe.models.decoupled.chain import attached_mass
from heeltoe.models.rigid.varying import varying
from heeltoe.motion.ground_motion import GroundMotion
from shared.dams import plane_case
from shared.outlines import make
from shared.potential_flow import leaning, push

# Leans back upstream by 10 m in 30, vertical above; downstream by 24 in 40.
LEANING = ((0.0, 0.0), (40.0, 0.0), (16.0, 40.0), (10.0, 40.0), (10.0, 30.0))


def deep(depth):
    return {"depth": f"{depth} m"}


@pytest.mark.parametrize("degrees", [-20, -10, 10, 20, 30, 45])
def test_slopes_take_from_the_push_what_potential_flow_says(degrees):
    upright, _ = push(leaning(0.0))
    # A series of half-sines in height: 0.5428 rho a h^2.
    odd = np.arange(1, 2001, 2)
    assert upright == pytest.approx(float(np.sum(16.0 / (math.pi * odd) ** 3)), rel=1e-3)
    result, down = push(leaning(degrees))
    # It presses along the normal, ...
    assert down == pytest.approx(math.tan(math.radians(degrees)) * result, rel=1e-9)
    # ... and the straight line for Zangar's curve is within 8 %.
    assert slope_factor(math.tan(math.radians(degrees))) == pytest.approx(result / upright, rel=0.08)


def test_a_level_face_moves_no_water_sideways():
    assert slope_factor(0.0) == 1.0
    assert slope_factor(1e15) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("crack", [0.0, 12.0, 33.0])
def test_mass_before_both_faces_against_numeric_integration(crack):
    case = make(LEANING, crack, reservoir=deep(36.0), tailwater=deep(20.0))
    mass = moment = second = 0.0
    for depth, factor in (
        (36.0, lambda z: np.where(z < 30.0, 1.0 - math.atan2(10.0, 30.0) / (math.pi / 2.0), 1.0)),
        (20.0, lambda z: np.full_like(z, 1.0 - math.atan2(24.0, 40.0) / (math.pi / 2.0))),
    ):
        high = depth - crack
        if high > 0.0:
            z = crack + high * (np.arange(1_000_000) + 0.5) / 1_000_000
            strip = 7 / 8 * 1000 * np.sqrt(depth * (depth - z)) * factor(z) * high / 1_000_000
            mass, moment = mass + float(strip.sum()), moment + float(strip @ (z - crack))
            second += float(strip @ (z - crack) ** 2)
    water = virtual_mass(case)
    assert water.mass == pytest.approx(mass, rel=1e-6)
    assert water.height == pytest.approx(moment / mass, rel=1e-6)
    assert water.inertia == pytest.approx(second - moment**2 / mass, rel=1e-5)
    assert water.sloped == (crack < 30.0)
    assert build_block(case).water == water


def test_a_vertical_face_has_westergaards_water():
    case = make(((0.0, 0.0), (40.0, 0.0), (6.0, 40.0), (0.0, 40.0)), reservoir=deep(36.0))
    water = virtual_mass(case)
    assert water.mass == 7.0 / 12.0 * 1000.0 * math.sqrt(36.0) * 36.0**1.5
    assert (water.height, water.sloped) == (0.4 * 36.0, False)
    assert water.inertia == 12.0 / 175.0 * water.mass * 36.0**2
    assert water.inertia == pytest.approx(0.0686 * water.mass * 36.0**2, rel=1e-3)


@pytest.mark.parametrize("crack", [0.0, 7.0, 30.0])
def test_of_a_crack_at_a_height_the_profile_above_it_turns(crack):
    case = make(((0.0, 0.0), (40.0, 0.0), (6.0, 40.0), (0.0, 40.0)), crack, reservoir=deep(36.0))
    water = virtual_mass(case)
    assert water.inertia == pytest.approx(12.0 / 175.0 * water.mass * (36.0 - crack) ** 2, rel=1e-14)
    # A face that leans by next to nothing is integrated edge by edge.
    leaning = make(((0.0, 0.0), (40.0, 0.0), (6.0, 40.0), (1e-6, 40.0)), crack, reservoir=deep(36.0))
    assert virtual_mass(leaning).sloped
    assert virtual_mass(leaning).inertia == pytest.approx(water.inertia, rel=1e-6)


def test_what_turns_scales_and_has_a_mirror_image():
    water = virtual_mass(make(LEANING, 5.0, reservoir=deep(36.0), tailwater=deep(20.0)))
    twice = make([(2.0 * x, 2.0 * z) for x, z in LEANING], 10.0, reservoir=deep(72.0), tailwater=deep(40.0))
    assert virtual_mass(twice).inertia == pytest.approx(16.0 * water.inertia, rel=1e-12)
    image = make([(-x, z) for x, z in LEANING], 5.0, reservoir=deep(20.0), tailwater=deep(36.0))
    assert virtual_mass(image).inertia == pytest.approx(water.inertia, rel=1e-12)


def test_points_of_water_on_both_sides_are_two():
    still = {"virtual_mass_rotates": False}
    waters = [
        virtual_mass(make(LEANING, **sides))
        for sides in (
            {"reservoir": deep(36.0) | still},
            {"tailwater": deep(20.0) | still},
            {"reservoir": deep(36.0) | still, "tailwater": deep(20.0) | still},
        )
    ]
    one, other, both = waters
    assert one.inertia == other.inertia == 0.0
    apart = one.mass * other.mass / (one.mass + other.mass) * (one.height - other.height) ** 2
    assert both.inertia == pytest.approx(apart, rel=1e-12)


@pytest.mark.parametrize("inclination", [0.0, 5.0, -3.0])
def test_every_walk_turns_with_the_inertia_of_the_profile(inclination):
    crack = {"elevation": "5 m", "friction": 1.0, "inclination": f"{inclination} deg"}
    case = make(LEANING, crack=crack, reservoir=deep(36.0))
    block = build_block(case)
    point = build_block(make(LEANING, crack=crack, reservoir=deep(36.0) | {"virtual_mass_rotates": False}))
    inertia = VARYING.index("inertia")
    more = block.inertia - point.inertia
    assert more == pytest.approx(block.water.inertia, rel=1e-9)
    numbers = varying(case, block).numbers, varying(point.case, point).numbers
    assert numbers[0][inertia] - numbers[1][inertia] == pytest.approx(more, rel=1e-9)
    kept = np.arange(len(VARYING)) != inertia
    assert (numbers[0][kept] == numbers[1][kept]).all()
    attached = attached_mass(case, block) - attached_mass(point.case, point)
    assert attached[2, 2] == pytest.approx(more, rel=1e-9)
    attached[2, 2] = 0.0
    assert not attached.any()


def test_zangar_is_cited_where_a_face_leans():
    motion = GroundMotion("still", np.array([0.0, 0.1]), np.zeros(2))
    for corners, cited in ((LEANING, True), (((0.0, 0.0), (40.0, 0.0), (6.0, 40.0), (0.0, 40.0)), False)):
        case = plane_case(
            {
                "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
                "concrete": {"modulus": "20 GPa"},
                "crack": {"friction": 3.0},
                "reservoir": deep(20.0),
                "flexible": {"elements_across": 2, "evidence": "none"},
            }
        )
        for response in (rigid(case, motion), flexible(case, motion)):
            assert (REFERENCES["sloped water"] in response.citation()) == cited, response.model
