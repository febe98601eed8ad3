"""The crack kernel: against a plain twin, its own laws, and dams drawn at random."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from heeltoe.kernel.dam import CrackedDam, only_crack
from heeltoe.models.flexible.body.reduced import ReducedBody, build_flexible_dam
from shared.dams import plane_case
from shared.random_dams import LEFT, MADE, draw

G = 9.80665
FRICTION = 0.6


def dam(elevation=0.0, across=2, **options):
    """A small dam with water, which a ground of half a g moves in every way."""
    fields = {
        "section": {"polygon": [["0 m", "0 m"], ["16 m", "0 m"], ["6 m", "20 m"], ["0 m", "20 m"]]},
        "concrete": {"density": "2400 kg/m^3", "modulus": "2 GPa", "poisson": 0.2},
        "crack": {"friction": FRICTION, "elevation": f"{elevation} m"},
        "reservoir": {"depth": "17 m"},
        "flexible": {"elements_across": across, **options},
    }
    return build_flexible_dam(plane_case(fields))


def ground(steps, dt, strength=0.5 * G):
    """A pulse each way, then a stand; upward as well."""
    t = dt * np.arange(steps)
    end = 0.6 * steps * dt
    across = np.where(t < end, -strength * np.sin(4.0 * np.pi * t / end), 0.0)
    return np.column_stack([across, np.where(t < end, 0.7 * strength * np.sin(9.0 * np.pi * t / end), 0.0)])


def run(one, a, dt, theta=0.52, stride=1):
    return one.kernel.run(a, dt, theta, stride=stride)


# A twin


def twin(part, start, friction, a, dt, theta):
    """Step one part on a rigid plane from modes and places at the start, with matrices as they stand in the theory and
    contact by sweeps; all states."""
    count = part.position.size // 2
    square, b = part.omega_squared, part.shapes
    ratio = 1.0 / theta - 1.0
    v, w = np.zeros_like(part.start), np.zeros(2 * count)
    q, place = start[0].copy(), start[1].copy()
    damping, states = part.damping_sticking, [q.copy()]
    coupling = part.dampers.T @ part.dampers
    slipping = np.zeros(count, dtype=bool)
    for across, up in a:
        c = np.diag(damping) + coupling
        d = np.linalg.inv(np.eye(square.size) + theta * dt * c + (theta * dt) ** 2 * np.diag(square))
        drive = dt * (part.load - across * part.participation_horizontal - up * part.participation_vertical)
        spring = square * (q + theta * (1.0 - theta) * dt * v) + (1.0 - theta) * c @ v
        free = d @ (v + drive - dt * spring)
        g = b.T @ d @ b
        u, p = b.T @ free, np.zeros(2 * count)
        ahead = np.maximum(np.maximum(place[count:], 0.0) / dt, ratio * w[count:])
        for _ in range(20_000):
            before = p.copy()
            for i in range(count):
                n = i + count
                p[n] = max(0.0, p[n] - (u[n] + g[n] @ p + ahead[i]) / g[n, n])
                limit = friction * p[n]
                p[i] = np.clip(p[i] - (u[i] + g[i] @ p) / g[i, i], -limit, limit)
            if np.abs(p - before).max() <= 1e-15 * max(1.0, np.abs(p).max()):
                break
        new = free + d @ (b @ p)
        w_new = b.T @ new
        place += dt * (theta * w_new + (1.0 - theta) * w)
        q, v, w = q + dt * (theta * new + (1.0 - theta) * v), new, w_new
        slipping = (p[count:] > 0.0) & (np.abs(p[:count]) >= friction * p[count:] * (1.0 - 1e-9))
        sticks = np.any((p[count:] > 0.0) & ~slipping)
        damping = part.damping_sticking if sticks else part.damping_free
        states.append(q.copy())
    return np.array(states), place


@pytest.mark.parametrize("theta", [*(pytest.param(value, marks=pytest.mark.slow) for value in (0.5, 1.0)), 0.52])
@pytest.mark.parametrize("damping", ["relative", "stiffness", "modal", "thesis", "deformation"])
def test_twin(theta, damping):
    one = dam(across=1, damping=damping)
    a = ground(400, 1e-3)
    ours = run(one, a, 1e-3, theta)
    states, place = twin(one.reduced[0], (ours.modes[0][0], ours.upper[0][0]), FRICTION, a, 1e-3, theta)
    # It did something: slid, and opened.
    assert abs(ours.summary.slip) > 1e-3
    assert ours.summary.opening_upstream > 1e-4
    assert ours.modes[0] == pytest.approx(states, rel=1e-7, abs=1e-7 * np.abs(states).max())
    assert ours.upper[0][-1] == pytest.approx(place, abs=1e-9)


# Laws of every run


@pytest.mark.parametrize("elevation", [0.0, 8.0])
@pytest.mark.parametrize("contactors", [3, 4])
def test_friction_stays_in_its_cone_and_nothing_pulls(elevation, contactors):
    one = dam(elevation, across=3, contactors=contactors)
    ours = run(one, ground(1500, 1e-3, 0.8 * G), 1e-3)
    along, across = ours.force[0].reshape(len(ours.force[0]), 2, -1).swapaxes(0, 1)
    largest = across.max()
    assert across.min() >= -1e-12 * largest
    if contactors == 3 and elevation == 0.0:
        assert (np.abs(along) <= FRICTION * across + 1e-9 * largest).all()
    # The sums are what the frames say.
    assert along.sum(axis=1) == pytest.approx(ours.frames.friction_force, abs=1e-9 * largest)
    assert across.sum(axis=1) == pytest.approx(ours.frames.normal_force, abs=1e-9 * largest)
    assert (np.abs(ours.frames.friction_force) <= FRICTION * ours.frames.normal_force + 1e-9 * largest).all()


def test_every_frame_closes_the_ledger():
    for elevation in (0.0, 8.0):
        one = run(dam(elevation), ground(2000, 1e-3), 1e-3)
        f, s = one.frames, one.summary
        losses = f.damping_energy + f.impact_energy + f.friction_energy + f.numerical_energy
        left = f.stored_energy - s.energy_start - f.input_energy + losses
        assert np.abs(left).max() <= 1e-12 * s.energy_turnover
        assert f.stored_energy[-1] == s.energy_stored
        # Losses only grow.
        for name in ("damping_energy", "numerical_energy"):
            assert np.diff(getattr(f, name)).min() >= 0.0


def test_impulse_is_momentum():
    # Over the whole run the crack has carried the weight and the inertia of what moved.
    one = dam()
    a = ground(1500, 1e-3)
    ours = run(one, a, 1e-3)
    part, body = one.reduced[0], one.upper
    velocity = np.gradient(ours.modes[0] @ part.participation_vertical, 1e-3)[-2]
    weight = -body.load[1::2].sum()
    mass = body.mass_concrete.sum() / 2.0
    pushed = ours.frames.normal_force.sum() * 1e-3
    moved = weight * 1.5 + mass * a[:, 1].sum() * 1e-3
    assert pushed == pytest.approx(moved + velocity, rel=1e-3)


def test_frames_change_nothing():
    one, a = dam(8.0), ground(1000, 1e-3)
    fine, coarse = run(one, a, 1e-3), run(one, a, 1e-3, stride=100)
    assert fine.summary == coarse.summary
    assert (coarse.upper[0] == fine.upper[0][::100]).all()
    # Impulses are summed up from frame to frame.
    assert coarse.force[0][1:] == pytest.approx(fine.force[0][1:].reshape(10, 100, -1).mean(axis=1))
    none = one.kernel.run(a, 1e-3, 0.52)
    assert none.summary == fine.summary
    assert not any(
        table.size for table in (*none.frames.by_name().values(), *none.upper, *none.force, none.status, *none.modes)
    )


def test_same_bits_for_any_number_of_threads():
    one, a = dam(8.0), ground(1000, 1e-3)
    scales = np.array([(0.5 + 0.1 * k, 1.0) for k in range(9)])
    first = one.kernel.run_many(a, 1e-3, 0.52, scales, threads=1)[0]
    for threads in (2, 3, 8, 0):
        again = one.kernel.run_many(a, 1e-3, 0.52, scales, threads=threads)[0]
        assert all((again[name] == first[name]).all() for name in first)
    sixth = one.kernel.run(a * scales[5], 1e-3, 0.52)
    assert {name: column[5] for name, column in first.items()} == sixth.summary.by_name()
    assert len(np.unique(first["slip"])) == len(scales)


def test_a_factor_is_that_of_the_ground():
    one, a = dam(), ground(1000, 1e-3)
    scaled = one.kernel.run_many(a, 1e-3, 0.52, np.array([[2.0, 0.5]]))[0]
    alone = one.kernel.run(a * [2.0, 0.5], 1e-3, 0.52).summary
    assert {name: column[0] for name, column in scaled.items()} == alone.by_name()


def test_contactors_are_the_same_on_a_rigid_plane():
    a = ground(1000, 1e-3)
    runs = [dam(contactors=kind).kernel.run(a, 1e-3, 0.52).summary for kind in range(1, 6)]
    assert all(item == runs[0] for item in runs)


@pytest.mark.parametrize("contactors", [1, 3])
def test_a_lower_part_that_cannot_move_is_a_plane(contactors):
    # Its face reaches far beyond the upper one, in two segments.
    one, a, dt = dam(across=3), ground(1000, 1e-3), 1e-3
    nothing = np.zeros(1)
    face = np.array([-50.0, 3.3, 80.0, 0.0, 0.0, 0.0])
    still = ReducedBody(
        np.ones(1),
        *[nothing] * 6,
        shapes=np.zeros((1, 6)),
        position=face,
        dampers=np.zeros((3, 1)),
        damper_signs=np.ones(3),
        wet=np.empty((0, 1)),
        boundary=np.empty((0, 0)),
    )
    parts = one.reduced[0], still
    line = only_crack(parts, (FRICTION, FRICTION))
    response = CrackedDam(parts, line, contactors).run(a, dt, 0.52, stride=1)
    plane = run(one, a, dt)
    assert abs(plane.summary.slip) > 0.05
    assert response.frames.slip == pytest.approx(plane.frames.slip, abs=1e-9)
    assert response.summary.energy_residual < 1e-12


def test_parts_that_do_not_fit_are_refused():
    part = dam().reduced[0]
    for wrong, text in (
        ({"load": part.load[:-1]}, "must agree"),
        ({"shapes": np.ascontiguousarray(part.shapes[:, :-2])}, "must agree"),
        (
            {"position": part.position[:2], "shapes": np.ascontiguousarray(part.shapes[:, :2])},
            "two crack nodes or more",
        ),
    ):
        misfit = dataclasses.replace(part, **wrong)
        with pytest.raises(ValueError, match=text):
            CrackedDam((misfit,), only_crack((misfit,), (0.5, 0.5)), 3)


# Random dams


@pytest.fixture(params=[30, pytest.param(1000, marks=pytest.mark.product)])
def examples(request) -> int:
    return request.param


@pytest.mark.slow
def test_energy_of_random_dams(examples):
    @settings(max_examples=examples)
    @given(st.integers(0, 2**32 - 1))
    def law(seed):
        drawn = draw(np.random.default_rng(seed))
        run = drawn.run()
        summary = run.summary
        assert all(np.isfinite(value) for value in summary.by_name().values())
        assert run.outcome in ("ok", "lost")
        # The search for the state at rest ends where rounding leaves its forces out of balance by 1e-16 to 1e-10 of the
        # loads (start.rs). The motion counts from there as if they balanced, the ledger takes them as they are: it is
        # left with the difference times the way of the dam, whatever step, stiffness and damping. Seeds 1024 and 2418
        # leave 1.7e-11 and 6.7e-11 of their turnover, out of balance by 1.2e-11 and 7.7e-11 of the largest load.
        assert summary.energy_residual <= max(drawn.residual_allowed(run), 1e-10)
        assert min(summary.energy_damping, summary.energy_numerical) >= 0.0
        if drawn.ordinary:
            assert summary.energy_gained <= MADE * summary.energy_turnover
            assert summary.energy_friction + summary.energy_impact >= -LEFT * summary.energy_turnover

    law()
