"""What an elastic dam does as a whole: it rests, slides, rocks or drifts, whatever a single node of its crack does."""

import math

import numpy as np
import pytest

from heeltoe import GroundMotion, flexible, rigid
from shared.dams import plane_case
from shared.shaken import EXAMPLES, SMALL

G = 9.80665


def block(modulus, friction, *, damping=0.05, across=2):
    corners = [["0 m", "0 m"], ["5 m", "0 m"], ["5 m", "15 m"], ["0 m", "15 m"]]
    return plane_case(
        {
            "section": {"polygon": corners},
            "concrete": {"modulus": f"{modulus} GPa", "damping": damping},
            "crack": {"friction": friction, "restitution": 0.0},
            "flexible": {"elements_across": across, "evidence": "none", "damping": "deformation"},
            "analysis": {"silence": "0 s"},
        }
    )


def swings(strength=0.6):
    time = np.linspace(0.0, 3.0, 601)
    result = strength * G * np.sin(2.0 * np.pi * time) * np.sin(np.pi * time / 3.0) ** 2
    return GroundMotion.from_points(np.append(time, 5.0), np.append(result, 0.0), name="swings")


def moving(response, *modes):
    return sum(response.time_by_mode_s[mode] for mode in modes or ("rocking", "slide_rocking", "drifting"))


@pytest.mark.parametrize("across", [4, 8])
def test_a_dam_that_slides_with_its_heel_open_does_not_rock(across):
    changes = ["crack.friction=1.2", f"flexible.elements_across={across}", "motion.duration=4s"]
    response = flexible(plane_case(EXAMPLES["base"], [*SMALL, *changes]))
    opened = (response.crack.status == response.crack.status_names().index("open")).mean(axis=1)
    assert response.opening_upstream_m > 0.01
    assert opened.max() > 0.6
    assert moving(response) == 0.0
    assert response.slip_by_mode_m["sliding"] == pytest.approx(response.residual_slip_m, rel=1e-12)
    assert response.time_by_mode_s["sliding"] > 0.5


def test_a_dam_with_its_heel_open_is_at_rest_before_the_ground_moves():
    still = GroundMotion("still", np.array([0.0, 0.5]), np.zeros(2))
    response = flexible(plane_case(EXAMPLES["base"], [*SMALL, "crack.friction=3"]), still)
    assert (response.crack.status == response.crack.status_names().index("open")).any()
    assert response.time_by_mode_s["rest"] == pytest.approx(response.end_time_s, rel=1e-12)


def test_a_stiff_block_slides_as_the_rigid_one():
    case = block(2e5, 0.25, across=4)
    elastic, stiff = flexible(case, swings()), rigid(case, swings())
    assert elastic.slip_by_mode_m["sliding"] == pytest.approx(stiff.slip_by_mode_m["sliding"], rel=0.01)
    assert elastic.time_by_mode_s["sliding"] == pytest.approx(stiff.time_by_mode_s["sliding"], rel=0.05)
    assert moving(elastic) < 0.005


def test_a_stiff_block_rocks_as_the_rigid_one():
    # So damped that its waves hardly throw it up again: like a rigid one without restitution.
    case = block(2e5, 1.0, damping=0.99)
    elastic, stiff = flexible(case, swings()), rigid(case, swings())
    assert elastic.time_by_mode_s["rest"] == pytest.approx(stiff.time_by_mode_s["rest"], rel=0.01)
    assert elastic.time_by_mode_s["sliding"] < 0.01
    assert elastic.time_by_mode_s["rocking"] == pytest.approx(stiff.time_by_mode_s["rocking"], rel=0.06)
    assert abs(elastic.slip_by_mode_m["sliding"] + elastic.slip_by_mode_m["slide_rocking"]) < 1e-4


@pytest.mark.slow
def test_a_crack_near_the_crest_rocks_with_any_mesh():
    times = []
    for across in (4, 8):
        # All modes: what differs is the mesh alone.
        changes = [f"flexible.elements_across={across}", "motion.duration=4s", "flexible.modes=10000"]
        response = flexible(plane_case(EXAMPLES["height"], [*SMALL, *changes]))
        times.append(moving(response))
        # 0.39 s by 32 even elements across.
        assert response.time_by_mode_s["rocking"] > 0.35
    assert times[1] == pytest.approx(times[0], rel=0.05)


def test_what_a_dam_does_goes_with_its_size():
    # Twice the size, twice the modulus, times longer by the root of two: every strain is the same.
    def run(size, modulus):
        corners = [
            ["0 m", "0 m"],
            [f"{4 * size} m", "0 m"],
            [f"{4 * size} m", f"{10 * size} m"],
            ["0 m", f"{10 * size} m"],
        ]
        case = plane_case(
            {
                "section": {"polygon": corners},
                "concrete": {"modulus": f"{modulus} GPa", "damping": 0.3},
                "crack": {"friction": 0.5},
                "flexible": {
                    "elements_across": 2,
                    "evidence": "none",
                    "time_step": f"{0.1 * math.sqrt(size)} ms",
                },
                # The silence does not go with the size.
                "analysis": {"silence": "0 s"},
            }
        )
        time = np.linspace(0.0, 2.0, 401)
        ground = 0.7 * G * np.sin(2.0 * np.pi * time / 0.8)
        return flexible(case, GroundMotion("sine", math.sqrt(size) * time, ground))

    small, large = run(1.0, 5.0), run(2.0, 10.0)
    assert moving(small) > 0.3
    for mode, seconds in small.time_by_mode_s.items():
        assert large.time_by_mode_s[mode] == pytest.approx(math.sqrt(2.0) * seconds, abs=0.02), mode
    assert large.elastic_give["rotation_rad"] == pytest.approx(small.elastic_give["rotation_rad"], rel=1e-9)
    assert large.elastic_give["gap_m"] == pytest.approx(2.0 * small.elastic_give["gap_m"], rel=1e-9)


def test_a_block_that_is_shaken_the_other_way_does_the_same():
    # Up to its first blows; from then on rounding tells the two apart.
    motion = swings().cut(1.6)
    there = flexible(block(20.0, 0.6), motion)
    back = flexible(block(20.0, 0.6), GroundMotion("back", motion.time, -motion.acceleration))
    assert moving(there) > 0.1
    for mode, seconds in there.time_by_mode_s.items():
        assert back.time_by_mode_s[mode] == pytest.approx(seconds, abs=1e-3), mode
    assert back.residual_slip_m == pytest.approx(-there.residual_slip_m, abs=1e-6)
