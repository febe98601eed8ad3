"""The rigid block of the typical dam against arithmetic by hand."""

import pytest

from heeltoe import build_block, read_case
from heeltoe.mechanics.block import static_state
from shared.dams import TYPICAL_SECTION
from validation.plain import rectangle

TYPICAL = {
    "gravity": "9.81 m/s^2",
    "section": TYPICAL_SECTION,
    "concrete": {"density": "2650 kg/m^3"},
    "crack": {"friction": 1.0},
    "reservoir": {"depth": "100 m"},
}


def test_typical_dam_by_hand():
    block = build_block(read_case(TYPICAL))
    # Two parts: a column 8 x 100 m and a triangle 72 m wide and 90 m high.
    column, wedge = 8.0 * 100.0, 72.0 * 90.0 / 2.0
    mass = 2650.0 * (column + wedge)
    x = (column * 4.0 + wedge * (8.0 + 24.0)) / (column + wedge)
    z = (column * 50.0 + wedge * 30.0) / (column + wedge)
    water = 7.0 / 12.0 * 1000.0 * 100.0**2
    height = (mass * z + water * 40.0) / (mass + water)
    parts = [
        (column, 8.0**2 / 12.0 + 100.0**2 / 12.0, 4.0, 50.0),
        (wedge, 72.0**2 / 18.0 + 90.0**2 / 18.0, 32.0, 30.0),
    ]
    inertia = 2650.0 * sum(a * (own + (px - x) ** 2 + (pz - z) ** 2) for a, own, px, pz in parts)
    inertia += mass * (z - height) ** 2 + water * (40.0 - height) ** 2
    # Zhu (2004) has the water in one point; its profile turns, too.
    turning = 12.0 / 175.0 * water * 100.0**2
    push = 1000.0 * 9.81 * 100.0**2 / 2.0
    uplift = 1000.0 * 9.81 * 100.0 * 80.0 / 2.0
    moment = push * (height - 100.0 / 3.0) + uplift * (80.0 / 3.0 - x)

    assert block.mass_vertical == pytest.approx(mass, rel=1e-12)
    assert block.mass_horizontal == pytest.approx(mass + water, rel=1e-12)
    assert block.height == pytest.approx(height, rel=1e-12)
    assert block.inertia == pytest.approx(inertia + turning, rel=1e-12)
    assert block.inertia / inertia == pytest.approx(1.39, abs=0.005)
    point = build_block(read_case(TYPICAL | {"reservoir": {"depth": "100 m", "virtual_mass_rotates": False}}))
    assert point.inertia == pytest.approx(inertia, rel=1e-12)
    assert point.height == block.height
    assert block.heel_distance == pytest.approx(x, rel=1e-12)
    assert block.toe_distance == pytest.approx(80.0 - x, rel=1e-12)
    assert block.static.horizontal == pytest.approx(push, rel=1e-12)
    assert block.normal_force == pytest.approx(mass * 9.81 - uplift, rel=1e-12)
    assert block.static_moment == pytest.approx(moment, rel=1e-12)
    assert block.sliding_safety_factor == pytest.approx((mass * 9.81 - uplift) / push, rel=1e-12)


def test_critical_accelerations_are_where_the_kernel_starts_to_move():
    """Closed forms against the kernel: just below nothing moves, just above the motion named begins."""
    import numpy as np

    from heeltoe.kernel.block import run_block
    from heeltoe.kernel.shaking import Shaking

    for friction, kind in ((0.5, "sliding"), (5.0, "rocking")):
        block = build_block(read_case({**TYPICAL, "crack": {"friction": friction}, "reservoir": {"depth": "60 m"}}))
        critical = block.critical_accelerations()
        for way, sign in (("downstream", -1.0), ("upstream", 1.0)):
            limit = getattr(critical, f"{kind}_{way}")
            for factor, moves in ((0.9999, False), (1.0001, True)):
                ground = np.full(2, sign * factor * limit)
                run = run_block(block.parameters(), Shaking(np.array([0.0, 0.1]), ground), np.empty(0))
                slip = run.summary.slip
                rotation = run.summary.rotation_min if way == "downstream" else run.summary.rotation_max
                moved = slip if kind == "sliding" else rotation
                assert (moved != 0.0) == moves, (kind, way, factor)
                assert (run.events.time.size > 0) == moves
                if moves and kind == "sliding":
                    assert np.sign(slip) == -sign


def test_resultant_of_a_free_standing_rectangle_is_in_the_middle():
    case = read_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["6 m", "0 m"], ["6 m", "9 m"], ["0 m", "9 m"]]},
            "crack": {"friction": 0.7},
        }
    )
    block = build_block(case)
    assert block.resultant_position == pytest.approx(3.0)
    assert block.sliding_safety_factor is None
    critical = block.critical_accelerations()
    g = case.gravity
    assert critical.sliding == pytest.approx(0.7 * g)
    assert critical.rocking == pytest.approx(6.0 / 9.0 * g)
    assert block.parameters() == pytest.approx(rectangle(6.0, 9.0, 0.7, gravity=g, restitution=0.5))


def test_concrete_above_an_inclined_crack_has_no_water_in_its_mass():
    case = read_case({**TYPICAL, "crack": {"friction": 1.0, "elevation": "20 m", "inclination": "12 deg"}})
    block = build_block(case)
    assert static_state(block)["concrete_mass_kg"] == pytest.approx(2650.0 * block.section.area, rel=1e-12)
    assert block.mass_vertical > 2650.0 * block.section.area


def test_a_dam_that_floats_has_no_friction():
    block = build_block(read_case({**TYPICAL, "uplift": {"pattern": "uniform", "intensity": 3.0}}))
    assert block.normal_force < 0.0
    assert block.sliding_safety_factor == 0.0
