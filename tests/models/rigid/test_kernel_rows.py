"""What the exact walk writes down: the last row of its histories, the impulses of its blows."""

import math
from itertools import pairwise

import numpy as np
import pytest

from shared.kernel_cases import GRAVITY, rectangle, run

MASS = 2650.0 * 2.0
STRIKES = ("heel strikes", "toe strikes", "both strike")


@pytest.mark.parametrize("jump", [False, True], ids=["ends", "ends with a jump"])
def test_the_last_row_has_the_forces_of_its_moment(jump):
    # A block that slides downstream while ground and weight change up to the very end: m s'' = -m a - mu m (g + a_v).
    time, across, up = [0.0, 1.0, 2.0], [-6.0, -8.0, -12.0], [0.0, 0.0, 5.0]
    if jump:
        time, across, up = [*time, 2.0], [*across, 0.0], [*up, 0.0]
    response = run(rectangle(2.0, 1.0, 0.3), time, across, up, at=[1.0, 2.0])
    last = {name: column[-1] for name, column in response.histories.by_name().items()}
    weight = MASS * (GRAVITY + 5.0)
    assert response.modes[-1] == "slide downstream"
    assert last["friction_force"] == pytest.approx(-0.3 * weight, rel=1e-13)
    assert last["normal_force_heel"] + last["normal_force_toe"] == pytest.approx(weight, rel=1e-13)
    assert last["slip_acceleration"] == pytest.approx(12.0 - 0.3 * (GRAVITY + 5.0), rel=1e-13)


def test_the_last_row_of_a_block_at_rest_holds_the_push():
    response = run(rectangle(2.0, 1.0, 0.8), [0.0, 1.0], [0.0, 3.0], at=[0.0, 0.5, 1.0])
    assert response.histories.friction_force == pytest.approx(MASS * np.array([0.0, 1.5, 3.0]), rel=1e-13)


def test_a_hair_before_a_jump_a_block_at_rest_has_forces():
    """Behind an event the piece before the jump ends there to rounding only: either side of the jump is right."""
    rng, block = np.random.default_rng(7), rectangle(2.0, 1.0, 0.8)
    for start, length in rng.uniform(0.5, 3.0, (200, 2)):
        jump = start + length
        time, hair = [start, jump, jump, jump + 1.0], np.nextafter(jump, 0.0)
        # It comes to rest on the way.
        coasts = [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0]]
        response = run(block, time, [1.0, 1.0, 2.0, 2.0], start=coasts, at=[hair, jump])
        assert response.modes == ["rest"] * 2
        sides = response.histories.friction_force / MASS
        assert np.minimum(abs(sides - 1.0), abs(sides - 2.0)).max() < 1e-13


@pytest.mark.parametrize("slip", [0.0, 2.0])
def test_a_blow_that_brings_a_block_to_lie_has_its_impulse(slip):
    # Too slow to bounce: both corners are stopped by the momentum of the fall, shared between them.
    speed = 0.5e-7 * math.sqrt(2.0 * GRAVITY)
    start = [[0.0, 0.0, 0.0], [slip, -speed, -speed]]
    response = run(rectangle(2.0, 1.0, 0.3, restitution=0.5), [0.0, 1e-9], [0.0, 0.0], start=start)
    blow = response.kinds.index("both strike")
    impulse = {name: getattr(response.events, f"{name}_impulse")[blow] for name in ("friction", "heel", "toe")}
    assert impulse["heel"] + impulse["toe"] == pytest.approx(MASS * speed, rel=1e-9)
    assert impulse["friction"] == pytest.approx(-0.3 * MASS * speed if slip else 0.0, rel=1e-9)
    assert response.events.slip_velocity[blow] == pytest.approx(slip - 0.3 * speed if slip else 0.0, abs=1e-15)


def test_every_blow_pushes():
    rng = np.random.default_rng(3)
    blows = lying = 0
    for _ in range(60):
        block = rectangle(
            2.0, 2.0 * rng.uniform(0.5, 4.0), 10.0 ** rng.uniform(-0.7, 0.5), restitution=rng.uniform(0, 0.9)
        )
        ground = GRAVITY * rng.uniform(0.5, 1.5) * np.append(rng.uniform(-1.0, 1.0, 20), [0.0, 0.0])
        response = run(block, np.append(0.05 * np.arange(21), 8.0), ground)
        events = response.events
        strikes = np.isin(response.kinds, STRIKES)
        pushes = np.array([events.heel_impulse[strikes], events.toe_impulse[strikes]])
        assert (pushes.min(axis=0) >= -1e-9 * pushes.max(axis=0)).all()
        assert (pushes.max(axis=0) > 0.0).all()
        assert (events.energy_lost[strikes] >= -1e-12 * response.summary.energy_input).all()
        blows += strikes.sum()
        lying += response.summary.final_mode == 0.0
    assert blows > 1000
    assert lying > 40


@pytest.mark.parametrize("left", [1e-5, 1e-8, 1e-11])
def test_a_block_that_all_but_floats_stays_where_it_is_while_the_ground_moves(left):
    # Friction of next to no weight pushes next to nothing: the slip is the ground's motion the other way.
    time = np.linspace(0.0, 1.0, 201)
    ground = 3.0 * np.sin(2.0 * math.pi * time)
    weight = MASS * GRAVITY
    block = rectangle(2.0, 1.0, 0.5, water=0.0)
    block[7] = -left * weight
    response = run(block, time, ground)
    h, moved, speed = 0.005, 0.0, 0.0
    for a0, a1 in pairwise(ground):
        moved += h * speed + h * h * (2.0 * a0 + a1) / 6.0
        speed += h * (a0 + a1) / 2.0
    assert response.outcome == "ok"
    assert response.summary.slip == pytest.approx(-moved, rel=10.0 * left + 1e-9)
    assert response.summary.events < 10
