"""Slides by a law that is a straight line over its path: closed forms, and the walk by integration as their judge."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import build_block, read_case
from heeltoe.kernel.block import Limits, run_block
from heeltoe.kernel.friction import friction_law
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.rigid.varying import varying
from heeltoe.models.run import earthquake
from models.rigid.test_varying import IDLE, exactly, random_dam, rectangle

G = 9.80665
NUMBERS = {"peak": 0.6, "residual": 0.3, "scale": 0.05}
WEAKENING = friction_law("linear slip weakening", NUMBERS)


def walked(case, time, ground, law, up=None, at=(), integrated=False):
    block = build_block(case)
    shaking = Shaking(np.asarray(time, dtype=float), np.asarray(ground, dtype=float), up)
    what = replace(varying(case, block), friction=law)
    if integrated:
        what = replace(what, anchors=IDLE)
    limits = Limits(event_limit=20_000, jam=True)
    return run_block(block.parameters(), shaking, np.asarray(at, dtype=float), limits, varying=what)


def weight(case):
    return build_block(case).concrete_mass * G


def test_a_weakening_slider_under_a_rectangular_pulse_by_hand():
    case, slip = read_case(rectangle(20.0, 1.0, 0.6)), 0.05
    # s'' = 0.2 g + k^2 s up to s = D, then 0.5 g up to the end of the pulse at 0.3 s, then -0.3 g.
    k = math.sqrt(0.3 * G / slip)
    at = np.linspace(0.0, 0.11, 12)
    run = walked(case, [0.0, 0.3, 0.3, 5.0], [-0.8 * G, -0.8 * G, 0.0, 0.0], WEAKENING, at=at)
    assert run.histories.slip == pytest.approx(0.2 * slip / 0.3 * (np.cosh(k * at) - 1.0), abs=1e-12)
    corner = math.acosh(1.0 + 0.3 / 0.2) / k
    speed, left = 0.2 * slip / 0.3 * k * math.sinh(k * corner), 0.3 - corner
    way = slip + speed * left + 0.25 * G * left**2 + (speed + 0.5 * G * left) ** 2 / (0.6 * G)
    assert run.summary.slip == pytest.approx(way, abs=1e-12)
    lost = weight(case) * (0.45 * slip + 0.3 * (way - slip))
    assert run.summary.energy_friction == pytest.approx(lost, rel=1e-12)
    assert run.summary.energy_residual < 1e-14
    assert run.worn.integrated == run.worn.error == 0.0


def test_a_slide_that_stops_on_the_way_up_to_the_corner_by_hand():
    # A ramp -0.7 g -> -0.5 g within 0.1 s, then a push the other way: no corner is reached.
    case, slip, length = read_case(rectangle(20.0, 1.0, 0.6)), 0.05, 0.1
    run = walked(
        case, [0.0, length, length, 3.0], np.array([-0.7, -0.5, 0.3, 0.3]) * G, WEAKENING, at=[0.02, 0.05, 0.1]
    )
    k = math.sqrt(0.3 * G / slip)
    p, q = 0.1 * G, -0.2 * G / length
    t = np.array([0.02, 0.05, 0.1])
    expected = p * (np.cosh(k * t) - 1.0) / k**2 + q * (np.sinh(k * t) - k * t) / k**3
    assert run.histories.slip == pytest.approx(expected, abs=1e-15)
    s0, v0 = expected[2], p * math.sinh(k * length) / k + q * (math.cosh(k * length) - 1.0) / k**2
    # s'' = -0.9 g + k^2 s from there: s - e = (s0 - e) cosh + v0/k sinh, at rest where tanh = -v0/k / (s0 - e).
    rest = 0.9 * G / k**2
    stop = math.atanh(-v0 / k / (s0 - rest)) / k
    end = rest + (s0 - rest) * math.cosh(k * stop) + v0 / k * math.sinh(k * stop)
    assert run.summary.slip == pytest.approx(end, abs=1e-15)
    assert 0.0 < end < slip
    assert run.events.time[-1] == pytest.approx(length + stop, abs=1e-14)


@pytest.mark.parametrize("up", [False, True])
@pytest.mark.parametrize("name", ["weakening", "cohesion", "both", "barton-bandis", "lift joint"])
def test_the_walk_by_integration_agrees_on_a_real_record(name, up, records):
    motion = {"file": str(next(records.glob("taft-1952-s69e-caltech*"))), "pga": "0.4 g"}
    case = read_case(rectangle(20.0, 1.0, 0.2, motion=motion))
    pressure = weight(case) / 20.0
    bond = {"cohesion": 0.003 * pressure, "loss": 0.01}
    falls = {"peak": 0.22, "residual": 0.12, "scale": 0.02}
    law = {
        "weakening": friction_law("linear slip weakening", falls),
        "cohesion": friction_law("constant", {"peak": 0.15, "residual": 0.15, **bond}),
        "both": friction_law("linear slip weakening", falls | bond),
        "barton-bandis": friction_law(
            "barton-bandis", {"roughness": 4.0, "wall_strength": 2.0 * pressure, "residual_angle": math.radians(8.0)}
        ),
        "lift joint": friction_law("lift joint", {"residual": 0.1}, [(0.0, 0.0), (1.1 * pressure, 0.05)]),
    }[name]
    shaking = earthquake(case).shaking
    time, ground = shaking.time, shaking.horizontal
    lift = 0.5 * ground[::-1].copy() if up else None
    closed, judge = (walked(case, time, ground, law, lift, integrated=which) for which in (False, True))
    assert closed.outcome == judge.outcome == "ok"
    # With a vertical motion friction that goes by path or stress has no closed form; cohesion alone has.
    exact = not up or name == "cohesion"
    assert (closed.worn.integrated == 0.0) == exact
    assert closed.worn.error <= judge.worn.error
    assert judge.worn.error > 0.0
    assert judge.worn.integrated == pytest.approx(judge.summary.time_sliding)
    assert closed.worn.end > 0.005
    allowed = judge.worn.error + 1e-12  # of the events
    assert closed.summary.slip == pytest.approx(judge.summary.slip, abs=allowed)
    assert closed.worn.end == pytest.approx(judge.worn.end, abs=allowed)
    assert closed.summary.energy_friction == pytest.approx(judge.summary.energy_friction, rel=1e-9)
    if exact:
        assert closed.summary.energy_residual < 1e-13


@pytest.mark.parametrize("seed", range(12))
def test_coulomb_as_the_limit_of_a_linear_law(seed):
    case, time, ground, up = random_dam(seed)
    exact, mu = exactly(case, time, ground, up), case.crack.mu_static
    law = friction_law("linear slip weakening", NUMBERS | {"peak": mu, "residual": mu})
    walk = walked(case, time, ground, law, up)
    assert walk.outcome == exact.outcome
    slides = exact.summary.time_rocking + exact.summary.time_slide_rocking + exact.summary.time_drifting == 0.0
    if slides:
        assert walk.worn.integrated == 0.0
        assert walk.summary.slip == pytest.approx(exact.summary.slip, rel=1e-13, abs=1e-14)
    assert walk.summary.slip == pytest.approx(exact.summary.slip, rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("seed", range(40))
def test_random_dams_agree_with_the_walk_by_integration(seed):
    case, time, ground, up = random_dam(seed)
    rng = np.random.default_rng(seed)
    low, high = sorted(rng.uniform(0.1, 1.2, 2))
    bond = {"cohesion": float(rng.choice([0.0, 2e4])), "loss": 10.0 ** rng.uniform(-4.0, -1.0)}
    law = friction_law(
        "linear slip weakening", {"peak": high, "residual": low, "scale": 10.0 ** rng.uniform(-4.0, 0.0), **bond}
    )
    closed, judge = (
        walked(case, time, ground, law, None if seed % 2 else up, integrated=which) for which in (False, True)
    )
    assert closed.outcome == judge.outcome
    # Both may have the same time to integrate: it ends where each of them finds the end of a slide.
    assert closed.worn.integrated <= judge.worn.integrated + 1e-9
    if closed.summary.impacts == 0.0:
        assert closed.summary.slip == pytest.approx(judge.summary.slip, rel=1e-9, abs=judge.worn.error + 1e-9)
