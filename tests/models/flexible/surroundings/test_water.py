"""Compressible water against closed forms: frequency by frequency, step by step, up and down."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from heeltoe.models.flexible.surroundings.water import floor_admittance, floor_reflection, full_water, reduced_water
from shared.exact_water import channel_pressure, step_pressure, vertical_pressure

DEPTH, SPEED, DENSITY = 100.0, 1440.0, 1000.0
FIRST = np.pi * SPEED / (2.0 * DEPTH)
HEIGHTS = np.linspace(0.0, 120.0, 25)
FACE = np.column_stack([0.0 * HEIGHTS, HEIGHTS])
WET = HEIGHTS <= DEPTH


@pytest.fixture(
    scope="module",
    params=[1.0, 0.5, *(pytest.param(reflection, marks=pytest.mark.slow) for reflection in (0.9, 0.0))],
)
def water(request):
    return request.param, reduced_water(FACE, DEPTH, wave_speed=SPEED, reflection=request.param, density=DENSITY)


def answer(water, omega, velocities):
    """Return pressures and the total force downstream of amplitudes of velocities ``L v + G v``."""
    moved = water.amplitudes(omega, velocities)
    return water.pressure @ moved, -(water.coupling.T @ moved)[::2].sum()


def stepped(full, ground, times, step=5e-4):
    """Return base pressure and total force at times under a ground that accelerates by 1 m/s2 from t = 0 on, by the
    trapezoidal rule.

    With all shapes of the finite elements: a step has all frequencies, which a reduction leaves out on purpose."""
    body = full.body
    solve = splu((body.mass + step / 2.0 * body.damping + step**2 / 4.0 * body.stiffness).tocsc()).solve
    moved = velocity = np.zeros(body.mass.shape[0])
    rows = []
    for count in range(1, round(times[-1] / step) + 1):
        push = body.mass @ velocity - step / 2.0 * (body.damping @ velocity)
        push -= step * (body.stiffness @ (moved + step / 4.0 * velocity))
        following = solve(push + step * ground * (count - 0.5) * step)
        moved, velocity = moved + step / 2.0 * (velocity + following), following
        if np.abs(times - count * step).min() < step / 4.0:
            rows.append([(full.pressure @ velocity)[0], -(full.coupling.T @ velocity)[::2].sum()])
    return np.array(rows).T


def all_shapes(reflection, face=FACE, highest=30.0):
    return full_water(
        [face], DEPTH, wave_speed=SPEED, reflection=reflection, density=DENSITY, highest=highest, floor=None,
        upstream=True, near=0.5,
    )  # fmt: skip


@pytest.mark.parametrize("ratio", [0.01, 0.5, 0.75, 0.9, 1.1, 1.25, 1.5, 2.0, 2.5])
def test_rigid_wall_at_a_frequency(water, ratio):
    reflection, reduced = water
    omega = ratio * FIRST
    pressure, force = answer(reduced, omega, reduced.ground[:, 0] / (1j * omega))
    # A wall that goes downstream draws; the closed form has it go into the water.
    exact = -channel_pressure(HEIGHTS[WET], omega, DEPTH, SPEED, reflection, lambda y: np.ones_like(y) / (1j * omega))
    scale = np.abs(exact).max()
    assert np.abs(pressure[WET] - exact).max() < 0.01 * scale
    assert not pressure[~WET].any()
    y = np.linspace(0.0, DEPTH, 401)
    fine = -channel_pressure(y, omega, DEPTH, SPEED, reflection, lambda y: np.ones_like(y) / (1j * omega))
    assert abs(force - np.trapezoid(fine, y)) < 0.01 * abs(force)


@pytest.mark.parametrize("ratio", [0.95, 1.05])
def test_rigid_wall_next_to_the_first_resonance(water, ratio):
    reflection, reduced = water
    omega = ratio * FIRST
    pressure, _ = answer(reduced, omega, reduced.ground[:, 0] / (1j * omega))
    exact = -channel_pressure(HEIGHTS[WET], omega, DEPTH, SPEED, reflection, lambda y: np.ones_like(y) / (1j * omega))
    assert np.abs(pressure[WET] - exact).max() < 0.02 * np.abs(exact).max()


def test_face_that_bends(water):
    reflection, reduced = water
    omega = 1.7 * FIRST
    velocity = np.zeros(2 * HEIGHTS.size)
    velocity[::2] = (HEIGHTS / DEPTH) ** 2
    pressure, _ = answer(reduced, omega, reduced.coupling @ velocity)
    exact = -channel_pressure(HEIGHTS[WET], omega, DEPTH, SPEED, reflection, lambda y: (y / DEPTH) ** 2)
    assert np.abs(pressure[WET] - exact).max() < 0.02 * np.abs(exact).max()


@pytest.mark.slow
def test_step_of_acceleration():
    times = np.array([0.02, 0.04, 0.06, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0])
    full = all_shapes(1.0)
    pressures, forces = stepped(full, -full.ground[:, 0], times)
    pressure, force = step_pressure(times, DEPTH, SPEED)
    assert forces == pytest.approx(force, rel=0.01)
    assert pressures == pytest.approx(pressure, rel=0.01)
    # Until a wave is back from the surface the base knows nothing of it.
    assert pressure[:3] == pytest.approx(DENSITY * SPEED * times[:3], rel=2e-3)


@pytest.mark.parametrize("reflection", [0.5, *(pytest.param(each, marks=pytest.mark.slow) for each in (1.0, 0.0))])
def test_step_of_vertical_acceleration(reflection):
    times = np.array([0.03, 0.06, 0.09, 0.12, 0.17, 0.2, 0.25, 0.31, 0.4, 0.5])
    full = all_shapes(reflection, highest=60.0)
    pressures, _ = stepped(full, full.ground[:, 1], times)
    exact = vertical_pressure(times, DEPTH, SPEED, reflection)
    assert pressures == pytest.approx(exact, abs=0.01 * exact.max())


@pytest.mark.parametrize("frequency", [1.0, 3.0, 5.0, 9.0, 13.0])
def test_vertical_motion_at_a_frequency(water, frequency):
    """A wave up and down, over a floor that rises by ``exp(i omega t)``."""
    reflection, reduced = water
    omega = 2.0 * np.pi * frequency
    pressure, _ = answer(reduced, omega, reduced.ground[:, 1] / (1j * omega))
    back = np.exp(-2j * omega * DEPTH / SPEED)
    exact = DENSITY * SPEED * (1.0 + reflection) / 2.0 / (1j * omega) * (1.0 - back) / (1.0 + reflection * back)
    assert pressure[0] == pytest.approx(exact, abs=0.01 * abs(exact) + 0.01 * DENSITY * DEPTH)


def test_what_the_water_takes_is_what_it_loses(water):
    reflection, reduced = water
    assert reduced.damping == pytest.approx(reduced.damping_floor + reduced.damping_far)
    for part in (reduced.damping_floor, reduced.damping_far):
        assert part == pytest.approx(part.T)
        assert np.linalg.eigvalsh(part)[0] > -1e-9 * np.abs(reduced.damping).max()
    assert (np.abs(reduced.damping_floor).max() == 0.0) == (reflection == 1.0)
    for omega in (0.3 * FIRST, FIRST, 2.2 * FIRST, 3.9 * FIRST):
        admittance = reduced.coupling.T @ reduced.amplitudes(omega, reduced.coupling + 0j)
        assert np.linalg.eigvalsh((admittance + admittance.conj().T) / 2.0)[0] > -1e-9 * np.abs(admittance).max()


def test_slow_motion_moves_westergaards_mass_of_potential_flow():
    """0.5428 rho H^2 before a rigid vertical wall: the sum of 8 / ((2 k - 1)^3 pi^3) squared modes."""
    reduced = reduced_water(FACE, DEPTH, wave_speed=20.0 * SPEED, reflection=1.0, density=DENSITY)
    omega = 10.0
    _, force = answer(reduced, omega, reduced.ground[:, 0] / (1j * omega))
    exact = 16.0 / np.pi**3 * np.sum(1.0 / (2.0 * np.arange(1, 200) - 1.0) ** 3)
    assert -force.real / (DENSITY * DEPTH**2) == pytest.approx(exact, rel=2e-3)


def test_parts_of_a_dam_one_above_the_other_feel_the_same_water():
    cut = 12
    whole = reduced_water(FACE, DEPTH, wave_speed=SPEED, reflection=0.9, density=DENSITY)
    parts = reduced_water([FACE[: cut + 1], FACE[cut:]], DEPTH, wave_speed=SPEED, reflection=0.9, density=DENSITY)
    assert parts.coupling.shape[1] == whole.coupling.shape[1] + 2
    omega = 1.4 * FIRST
    twice = np.concatenate([np.arange(cut + 1), np.arange(cut, len(FACE))])
    one, _ = answer(whole, omega, whole.ground[:, 0] + 0j)
    two, _ = answer(parts, omega, parts.ground[:, 0] + 0j)
    assert two == pytest.approx(one[twice], abs=1e-6 * np.abs(one).max())
    # A shape that goes on from one part to the other.
    velocity = np.column_stack([(HEIGHTS / DEPTH) ** 2, 0.0 * HEIGHTS])
    one, _ = answer(whole, omega, whole.coupling @ velocity.reshape(-1) + 0j)
    two, _ = answer(parts, omega, parts.coupling @ velocity[twice].reshape(-1) + 0j)
    assert two == pytest.approx(one[twice], abs=1e-6 * np.abs(one).max())


def test_water_downstream_is_the_mirror_of_water_upstream():
    sloped = np.column_stack([0.3 * HEIGHTS, HEIGHTS])
    options = {"wave_speed": SPEED, "reflection": 0.7, "density": DENSITY}
    one = reduced_water(sloped, DEPTH, **options)
    other = reduced_water(sloped * [-1.0, 1.0], DEPTH, upstream=False, **options)
    turned = np.tile([-1.0, 1.0], len(sloped))
    omega = 1.3 * FIRST
    push = one.amplitudes(omega, one.coupling + 0j)
    pull = other.amplitudes(omega, other.coupling * turned + 0j)
    assert one.coupling.T @ push == pytest.approx((other.coupling * turned).T @ pull, rel=1e-6, abs=1e-3)
    assert one.ground.T @ one.amplitudes(omega, one.ground + 0j) == pytest.approx(
        (other.ground * [-1.0, 1.0]).T @ other.amplitudes(omega, other.ground * [-1.0, 1.0] + 0j), rel=1e-6
    )


def test_ground_is_the_face_and_the_floor_together():
    """A ground that moves downstream moves each node of the face; one that rises lifts floor and face."""
    sloped = np.column_stack([0.3 * HEIGHTS, HEIGHTS])
    full = all_shapes(0.7, sloped)
    ones = np.tile([1.0, 0.0], len(sloped))
    assert full.coupling @ ones == pytest.approx(full.ground[:, 0])
    lifted = full.coupling @ np.tile([0.0, 1.0], len(sloped))
    assert np.abs(lifted - full.ground[:, 1]).max() > 0.1 * np.abs(full.ground[:, 1]).max()


def test_near_field_may_be_longer():
    """What the far field answers does not depend on where it starts."""
    sloped = np.column_stack([0.2 * HEIGHTS, HEIGHTS])
    forces = []
    for near in (0.4, 1.5):
        water = reduced_water(sloped, DEPTH, wave_speed=SPEED, reflection=0.8, density=DENSITY, near=near)
        omega = 1.3 * FIRST
        forces.append(answer(water, omega, water.ground[:, 0] / (1j * omega))[1])
    assert forces[0] == pytest.approx(forces[1], rel=0.005)


def test_floor_of_rock():
    assert floor_reflection(1000.0, 1440.0, 2640.0, 2500.0) == pytest.approx((1 - 0.21818) / (1 + 0.21818), rel=1e-4)
    assert floor_admittance(1440.0, 1.0) == 0.0
    assert floor_admittance(1440.0, 0.0) == 1.0 / 1440.0


@pytest.mark.parametrize("depth", [0.01, 0.05, 0.3])
def test_a_little_water_far_from_zero_pushes_as_water_without_sound(depth):
    """Far below the first frequency of the water 0.543 rho h^2 of it move with a rigid wall (Westergaard 1933)."""
    face = np.column_stack([70.0 + 0.0 * HEIGHTS, 0.2 * HEIGHTS + 30.0])
    water = reduced_water([face], depth, wave_speed=SPEED, reflection=1.0, density=DENSITY, upstream=False)
    omega = 2.0 * np.pi * 5.0
    _, force = answer(water, omega, water.ground[:, 0] / (1j * omega))
    assert abs(abs(force) / (0.5428 * DENSITY * depth**2) - 1.0) < 0.01
