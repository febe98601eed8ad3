"""Friction laws in the crack kernel: against a plain twin, closed forms, Coulomb as their limit."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from heeltoe.kernel.friction import LAWS, friction_law
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.dams import plane_case, polygon

G = 9.80665
CORNERS = [(0.0, 0.0), (16.0, 0.0), (6.0, 20.0), (0.0, 20.0)]
NUMBERS = {
    "linear slip weakening": {"peak": 0.7, "residual": 0.5, "scale": 0.02},
    "exponential slip weakening": {"peak": 0.7, "residual": 0.5, "scale": 0.02},
    "speed weakening": {"peak": 0.7, "residual": 0.5, "scale": 0.1},
    "constant": {"peak": 0.5, "residual": 0.5, "cohesion": 3e4, "loss": 0.01},
    "barton-bandis": {"roughness": 6.0, "wall_strength": 1e7, "residual_angle": math.radians(22.0)},
    "lift joint": {"residual": 0.5},
}
POINTS = [(0.0, 0.3), (2e5, 0.1)]


def law(name):
    return friction_law(name, NUMBERS[name], POINTS if name == "lift joint" else ())


def by_hand(name, stress, path, speed, bonded):
    """The same laws, written by hand: shear stress."""
    mu = {
        "linear slip weakening": 0.5 + 0.2 * max(0.0, 1.0 - path / 0.02),
        "exponential slip weakening": 0.5 + 0.2 * math.exp(-path / 0.02),
        "speed weakening": 0.5 + 0.2 * math.exp(-speed / 0.1),
        "constant": 0.5,
        "barton-bandis": math.tan(
            math.radians(min(70.0, 22.0 + max(0.0, 6.0 * math.log10(1e7 / max(stress, 1e-300)))))
        ),
        "lift joint": 0.5 + np.interp(stress, [0.0, 2e5], [0.3, 0.1]),
    }[name]
    bond = 3e4 * max(0.0, 1.0 - path / 0.01) if name == "constant" and bonded else 0.0
    return mu * stress + bond


def dam(friction_law=None, elevation=0.0, across=2, friction=0.6, **options):
    """A small dam with water, whose crack has a law of the kernel."""
    fields = {
        "section": polygon(CORNERS),
        "concrete": {"density": "2400 kg/m^3", "modulus": "2 GPa", "poisson": 0.2},
        "crack": {"friction": friction, "elevation": f"{elevation} m"},
        "reservoir": {"depth": "15 m"},
        "flexible": {"elements_across": across, **options},
    }
    one = build_flexible_dam(plane_case(fields))
    lines = tuple(replace(line, law=friction_law) for line in one.lines)
    return replace(one, contactors=3, lines=lines), one.reduced


def ground(steps, dt, strength=0.6 * G):
    """A pulse each way, then a stand; upward as well."""
    t = dt * np.arange(steps)
    end = 0.6 * steps * dt
    across = np.where(t < end, -strength * np.sin(4.0 * np.pi * t / end), 0.0)
    return np.column_stack([across, np.where(t < end, 0.4 * strength * np.sin(9.0 * np.pi * t / end), 0.0)])


class Twin:
    """One part on a rigid plane, with matrices as they stand in the theory and contact by sweeps in which each contact
    asks the law written by hand."""

    def __init__(self, part, ours, name):
        self.part, self.name = part, name
        self.q, self.place = ours.modes[0][0].copy(), ours.upper[0][0].copy()
        self.v, self.w = np.zeros_like(self.q), np.zeros_like(self.place)
        self.path, self.bonded = ours.worked.path_before.copy(), ours.worked.bonded_before > 0.0
        self.length = ours.worked.length
        self.slipped = np.zeros(self.path.size, dtype=bool)
        self.sticks = True

    def step(self, ground, dt, theta):
        part, count = self.part, self.path.size
        c = np.diag(part.damping_sticking if self.sticks else part.damping_free) + part.dampers.T @ part.dampers
        d = np.linalg.inv(np.eye(self.q.size) + theta * dt * c + (theta * dt) ** 2 * np.diag(part.omega_squared))
        drive = part.load - ground[0] * part.participation_horizontal - ground[1] * part.participation_vertical
        spring = part.omega_squared * (self.q + theta * (1.0 - theta) * dt * self.v) + (1.0 - theta) * c @ self.v
        free = d @ (self.v + dt * drive - dt * spring)
        b = part.shapes
        g, u = b.T @ d @ b, b.T @ free
        ahead = np.maximum(np.maximum(self.place[count:], 0.0) / dt, (1.0 / theta - 1.0) * self.w[count:])
        p, limit, way = np.zeros(2 * count), np.zeros(count), np.zeros(count)
        for _ in range(20_000):
            before = p.copy()
            for i in range(count):
                n = i + count
                p[n] = max(0.0, p[n] - (u[n] + g[n] @ p + ahead[i]) / g[n, n])
                limit[i] = self.borne(i, p[n] / dt, way[i]) * dt if p[n] > 0.0 else 0.0
                p[i] = np.clip(p[i] - (u[i] + g[i] @ p) / g[i, i], -limit[i], limit[i])
            mean = theta * (u[:count] + g[:count] @ p) + (1.0 - theta) * self.w[:count]
            slips = (p[count:] > 0.0) & (np.abs(p[:count]) >= limit * (1.0 - 1e-9))
            way = np.where(slips | (self.slipped & (p[count:] > 0.0)), dt * np.abs(mean), 0.0)
            if np.abs(p - before).max() <= 1e-14 * max(1.0, np.abs(p).max()):
                break
        new = free + d @ (b @ p)
        w_new = b.T @ new
        self.place += dt * (theta * w_new + (1.0 - theta) * self.w)
        self.q, self.v, self.w = self.q + dt * (theta * new + (1.0 - theta) * self.v), new, w_new
        self.path += way
        self.bonded &= p[count:] > 0.0
        self.slipped = slips
        self.sticks = bool(((p[count:] > 0.0) & ~slips).any())

    def borne(self, i, pressed, way):
        stress, speed = pressed / self.length[i], abs(self.w[i])
        path, bonded = self.path[i] + 0.5 * way, self.bonded[i]
        return self.length[i] * by_hand(self.name, stress, path, speed, bonded)


@pytest.mark.parametrize("name", LAWS)
def test_a_twin_with_each_law_agrees(name):
    dt, theta = 1e-3, 0.52
    one, reduced = dam(law(name), across=1)
    a = ground(400, dt, 0.75 * G)
    ours = one.kernel.run(a, dt, theta, stride=1)
    twin = Twin(reduced[0], ours, name)
    states = [twin.q.copy()]
    for row in a:
        twin.step(row, dt, theta)
        states.append(twin.q.copy())
    assert abs(ours.summary.slip) > 5e-3
    assert ours.modes[0] == pytest.approx(np.array(states), rel=1e-6, abs=1e-6 * np.abs(states).max())
    assert ours.worked.path == pytest.approx(twin.path, rel=1e-6, abs=1e-9)
    assert (ours.worked.bonded > 0.0).tolist() == twin.bonded.tolist()
    assert ours.summary.contact_residual < 1e-9


@pytest.mark.parametrize("elevation", [0.0, 8.0])
@pytest.mark.parametrize("mu", [0.45, 0.6])
def test_every_law_reduced_to_coulomb_gives_coulombs_result(elevation, mu):
    plain, _ = dam(None, elevation, friction=mu)
    a = ground(1500, 1e-3)
    expected = plain.kernel.run(a, 1e-3, 0.52, stride=10)
    assert abs(expected.summary.slip) > 1e-3
    same = {"peak": mu, "residual": mu, "scale": 1.0}
    reduced = [friction_law(name, same) for name in LAWS[:4]]
    reduced += [
        friction_law("constant", same | {"cohesion": 0.0, "loss": 0.01}),
        friction_law("barton-bandis", {"residual_angle": math.atan(mu), "wall_strength": 1e7}),
        friction_law("lift joint", {"residual": mu}),
    ]
    for item in reduced:
        one, _ = dam(item, elevation, friction=0.0)
        response = one.kernel.run(a, 1e-3, 0.52, stride=10)
        for name in ("slip", "slip_min", "slip_max", "rotation_min", "opening_upstream", "energy_friction"):
            assert getattr(response.summary, name) == pytest.approx(
                getattr(expected.summary, name), rel=1e-10, abs=1e-13
            ), name
        assert response.upper[0] == pytest.approx(expected.upper[0], rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_every_frame_closes_the_ledger_and_friction_stays_below_the_law(name):
    one, _ = dam(law(name), 8.0)
    run = one.kernel.run(ground(2000, 1e-3), 1e-3, 0.52, stride=1)
    f, s = run.frames, run.summary
    losses = f.damping_energy + f.impact_energy + f.friction_energy + f.numerical_energy
    left = f.stored_energy - s.energy_start - f.input_energy + losses
    assert np.abs(left).max() <= 1e-11 * s.energy_turnover
    assert s.energy_gained < 1e-5 * s.energy_turnover
    largest = f.normal_force.max()
    assert (np.abs(f.friction_force) <= f.friction_strength + 1e-9 * largest).all()
    # Only what slips the same way everywhere bears all that it can.
    assert (np.abs(f.friction_force) >= f.friction_strength * (1.0 - 1e-9)).sum() > 10
    assert (np.diff(f.slip_path) >= 0.0).all()
    assert f.slip_path[-1] == s.slip_path > 0.0


def test_a_bond_takes_the_work_under_its_curve():
    # All nodes slide far beyond the way over which it is lost, and none opens before.
    numbers = {"peak": 0.3, "residual": 0.3, "cohesion": 2e4, "loss": 0.002}
    one, _ = dam(friction_law("constant", numbers), friction=0.0, across=4)
    push = np.zeros((2000, 2))
    push[:400, 0] = -0.25 * G
    response = one.kernel.run(push, 2e-4, 0.52)
    worked = response.worked
    assert (worked.path > 0.002).all()
    whole = worked.bonded_before * np.maximum(0.0, 1.0 - worked.path_before / 0.002)
    left_at_work = 0.5 * 2e4 * 0.002 * (worked.length * whole**2)[worked.bonded > 0.0].sum()
    assert response.summary.bond_energy == pytest.approx(left_at_work, rel=2e-2)


def test_a_dam_with_a_law_that_nothing_shakes_stands_to_the_last_bit():
    for name in LAWS:
        one, _ = dam(law(name), 8.0)
        assert one.kernel.still() is not None
        run = one.kernel.run(np.zeros((200, 2)), 1e-3, 0.52, stride=20)
        assert (run.upper[0] == run.upper[0][0]).all()
        assert run.summary.slip == run.summary.slip_path == run.summary.bond_energy == 0.0
        assert (run.worked.path == run.worked.path_before).all()


def test_a_node_that_opens_has_lost_its_bond():
    one, _ = dam(friction_law("constant", {"peak": 0.8, "residual": 0.8, "cohesion": 1e6}), across=4)
    a = np.zeros((1500, 2))
    a[:300, 0] = -0.9 * G
    run = one.kernel.run(a, 1e-3, 0.52, stride=1)
    opened = (run.status == 1).any(axis=0)
    assert opened.any()
    assert not opened.all()
    assert (run.worked.bonded[opened] == 0.0).all()
    assert (run.worked.bonded[~opened] == 1.0).all()


def test_an_end_that_comes_in_another_ones_place_has_its_path():
    one, _ = dam(law("linear slip weakening"), 8.0, friction=0.0)
    a = np.zeros((3000, 2))
    a[:120, 0] = -1.1 * G
    run = one.kernel.run(a, 1e-3, 0.52, stride=50)
    double = run.worked.double > 0.0
    assert double.sum() == 2
    assert run.summary.slip > 0.05
    # The toe of the upper face has gone beyond the lower one, whose end comes in its place.
    path = run.worked.path
    assert run.status[-1][~double][-1] == 0
    assert path[double][-1] == pytest.approx(path[~double][-2], rel=0.1)


def test_many_runs_have_the_same_bits_on_any_number_of_threads():
    scales = np.array([[k / 4.0, k / 4.0] for k in range(1, 8)])
    for name in ("exponential slip weakening", "barton-bandis"):
        one, _ = dam(law(name))
        result = [one.kernel.run_many(ground(600, 1e-3), 1e-3, 0.52, scales, threads=n)[0] for n in (1, 2, 4)]
        assert np.ptp(result[0]["slip"]) > 1e-3
        for other in result[1:]:
            assert all((other[key] == result[0][key]).all() for key in result[0])
