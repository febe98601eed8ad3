"""The flexible model through its Python interface: symmetries, limits, evidence, warnings."""

from __future__ import annotations

import json

import numpy as np
import pytest

from heeltoe import GroundMotion, InputError, flexible, read_case, rigid
from heeltoe.block import build_block
from heeltoe.flexible_model import Convergence
from heeltoe.flexible_parts import build_flexible_dam

G = 9.80665
DAM = [(0.0, 0.0), (24.0, 0.0), (8.0, 20.0), (6.0, 30.0), (0.0, 30.0)]


def case(corners=DAM, *, friction=0.8, elevation=0.0, modulus=5.0, depth=0.0, size=1.0, **blocks):
    """A small dam on a coarse mesh; `size` multiplies its lengths and its modulus."""
    fields = {
        "section": {"polygon": [[f"{size * x!r} m", f"{size * z!r} m"] for x, z in corners]},
        "concrete": {"density": "2400 kg/m^3", "modulus": f"{size * modulus!r} GPa", "poisson": 0.2},
        "crack": {"friction": friction, "elevation": f"{size * elevation!r} m"},
        "flexible": {"elements_across": 3, "convergence_check": False, "time_step": "0.5 ms"},
    }
    if depth:
        fields["reservoir"] = {"depth": f"{size * depth!r} m"}
    for name, block in blocks.items():
        fields[name] = fields.get(name, {}) | block
    return read_case(fields)


def shaking(strength=0.6, *, periods=(0.5, 0.37, 0.21), end=3.0, quiet=1.0, time=1.0):
    """Three sines of amplitudes in g that grow and fall, then a stand; `time` stretches it."""
    t = np.linspace(0.0, end, 601)
    a = sum(np.sin(2.0 * np.pi * t / period + k) for k, period in enumerate(periods))
    a *= strength * G / 2.0 * np.sin(np.pi * t / end) ** 2
    return GroundMotion.from_points(time * np.append(t, end + quiet), np.append(a, 0.0), name="three sines")


@pytest.fixture(scope="module")
def shaken():
    """A response in which everything happens: sliding, rocking, blows."""
    return flexible(case(depth=28.0), shaking(1.0))


# Symmetries


@pytest.mark.parametrize("elevation", [0.0, 12.0])
def test_mirrored_dam_in_mirrored_shaking(elevation):
    # Water has a virtual mass on the upstream face alone: what is mirrored is a dry dam, with the uplift by points.
    points = [[0.0, "12 m"], [0.4, "5 m"], [1.0, "2 m"]]
    mirrored = [[1.0 - x, head] for x, head in reversed(points)]
    one = flexible(case(elevation=elevation, uplift={"pattern": "profile", "points": points}), shaking())
    other = flexible(
        case([(-x, z) for x, z in DAM], elevation=elevation, uplift={"pattern": "profile", "points": mirrored}),
        shaking().reversed(),
    )
    assert abs(one.residual_slip_m) > 0.01
    assert other.residual_slip_m == pytest.approx(-one.residual_slip_m, rel=1e-6)
    for name, mirror in (
        ("peak_slip_downstream_m", "peak_slip_upstream_m"),
        ("rocking_downstream_rad", "rocking_upstream_rad"),
        ("opening_upstream_m", "opening_downstream_m"),
    ):
        sign = -1.0 if "slip" in name else 1.0
        assert other.summary[mirror] == pytest.approx(sign * one.summary[name], rel=1e-6, abs=1e-9)
        assert other.summary[name] == pytest.approx(sign * one.summary[mirror], rel=1e-6, abs=1e-9)
    assert other.impacts == one.impacts
    assert other.energy.friction_j == pytest.approx(one.energy.friction_j, rel=1e-6)


@pytest.mark.parametrize("elevation", [0.0, 12.0])
@pytest.mark.parametrize("damping", ["deformation", "thesis"])
def test_a_dam_four_times_as_large(elevation, damping):
    # Lengths and modulus times 4, times times 2, at the same accelerations: slip times 4, rotation the same.
    options = {"damping": damping}
    one = flexible(case(elevation=elevation, depth=27.0, flexible=options), shaking())
    larger = case(elevation=elevation, depth=27.0, size=4.0, flexible=options | {"time_step": "1 ms"})
    other = flexible(larger, shaking(time=2.0))
    assert abs(one.residual_slip_m) > 0.01
    assert other.periods_s == pytest.approx([2.0 * period for period in one.periods_s], rel=1e-9)
    assert other.residual_slip_m == pytest.approx(4.0 * one.residual_slip_m, rel=1e-6)
    assert other.rocking_downstream_rad == pytest.approx(one.rocking_downstream_rad, rel=1e-6)
    assert other.opening_upstream_m == pytest.approx(4.0 * one.opening_upstream_m, rel=1e-6)
    assert other.energy.friction_j == pytest.approx(4.0**3 * one.energy.friction_j, rel=1e-6)


def test_heavier_and_as_much_stiffer_is_the_same():
    one = flexible(case(depth=27.0), shaking())
    heavy = {"density": "4800 kg/m^3", "modulus": "10 GPa"}
    other = flexible(case(concrete=heavy, reservoir={"depth": "27 m", "density": "2000 kg/m^3"}), shaking())
    assert other.residual_slip_m == pytest.approx(one.residual_slip_m, rel=1e-6)
    assert other.peak_normal_force_n == pytest.approx(2.0 * one.peak_normal_force_n, rel=1e-6)


def test_the_same_twice():
    one, other = (flexible(case(elevation=12.0, depth=28.0), shaking(1.0)) for _ in range(2))
    assert one.summary == other.summary
    assert one.energy == other.energy
    assert all((one.histories[name] == other.histories[name]).all() for name in one.histories)


# Limits


def swell(peak):
    """One slow push each way, in m/s2."""
    t = np.linspace(0.0, 2.0, 201)
    return GroundMotion.from_points(np.append(t, 3.0), np.append(-peak * np.sin(np.pi * t), 0.0), name="swell")


@pytest.mark.parametrize("depth", [0.0, 24.0])
def test_below_the_critical_acceleration_a_stiff_crack_does_not_slip(depth):
    # What a crack at rest may slip is elastic: the force on it over the modulus, some 1e-5 m here; near its ends, where
    # the concrete is strained most, nodes let go, and keep about as much.
    stiff = case(friction=0.4, modulus=200.0, depth=depth)
    block = build_block(stiff)
    limits = block.critical_accelerations()
    force = (block.mass_horizontal * limits.sliding + abs(block.static.horizontal)) / 200e9
    calm = flexible(stiff, swell(0.9 * limits.sliding))
    assert max(calm.peak_slip_downstream_m, -calm.peak_slip_upstream_m) < 2.0 * force
    assert calm.final_mode in ("rest", "rocking")
    moved = flexible(stiff, swell(1.2 * limits.sliding))
    assert max(moved.peak_slip_downstream_m, -moved.peak_slip_upstream_m) > 50.0 * force


def test_a_stiff_dam_is_the_rigid_one():
    stiff = case(friction=0.5, modulus=2000.0, depth=24.0, flexible={"time_step": "0.05 ms"})
    motion = shaking(0.5)
    assert flexible(stiff, motion).residual_slip_m == pytest.approx(rigid(stiff, motion).residual_slip_m, rel=0.02)


def test_modes_left_out_hardly_matter():
    full = flexible(case(depth=27.0), shaking())
    few = flexible(case(depth=27.0, flexible={"modes": 20}), shaking())
    assert few.summary["mesh"]["modes"][0] < full.summary["mesh"]["modes"][0] / 2
    assert few.residual_slip_m == pytest.approx(full.residual_slip_m, rel=0.02)
    assert full.summary["mesh"]["basis_error"] == 0.0 < few.summary["mesh"]["basis_error"]


def test_the_penalty_method_agrees_where_it_is_damped():
    exact = flexible(case(depth=27.0), shaking())
    springs = flexible(
        case(depth=27.0, flexible={"contact": "idce", "newmark_gamma": 0.7, "time_step": "0.1 ms"}), shaking()
    )
    assert springs.residual_slip_m == pytest.approx(exact.residual_slip_m, rel=0.04)


# What is reported


def test_numbers_agree_with_histories(shaken):
    h, crack = shaken.histories, shaken.crack
    assert h["time_s"][-1] == pytest.approx(4.0, rel=1e-12)
    assert h["slip_m"][-1] == shaken.residual_slip_m
    assert 0.0 <= shaken.peak_slip_downstream_m - h["slip_m"].max() < 0.01
    assert shaken.rocking_downstream_rad >= -h["rotation_rad"].min()
    assert shaken.opening_upstream_m >= h["gap_heel_m"].max() > 1e-3
    assert sum(shaken.slip_by_mode_m.values()) == pytest.approx(shaken.residual_slip_m, rel=1e-9)
    assert sum(shaken.time_by_mode_s.values()) == pytest.approx(4.0, rel=1e-9)
    assert set(shaken.mode) > {"rest", "slide-rocking"}
    assert shaken.impacts > 10
    # The crack's own record is the same motion.
    along = crack.upper_position[:, 0]
    assert (along - along[0]).mean(axis=1) == pytest.approx(h["slip_m"], abs=1e-12)
    assert crack.force[:, 1].sum(axis=1) == pytest.approx(h["normal_force_n"], rel=1e-9)
    json.dumps(shaken.to_json(), allow_nan=False)


def test_the_energy_closes(shaken):
    e = shaken.energy
    losses = e.friction_j + e.impact_j + e.damping_j + e.numerical_j
    assert e.kinetic_j == pytest.approx(e.input_j - losses, abs=1e-9 * losses)
    assert e.residual < 1e-12
    assert 0.0 <= e.gained_j < 1e-6 * losses
    assert min(e.friction_j, e.impact_j, e.damping_j, e.numerical_j) > 0.0


def test_at_rest_the_crack_carries_the_static_loads(shaken):
    # In the end as in the beginning: weight less uplift, and the water's push.
    for name, force in (("normal_force_n", "normal_force_n"), ("friction_force_n", "horizontal_force_n")):
        expected = shaken.static[force] * (1.0 if name == "normal_force_n" else -1.0)
        end = shaken.histories[name][-40:].mean()
        assert end == pytest.approx(expected, rel=0.01)
    built = build_flexible_dam(case(depth=28.0))
    assert built.crack_force[1::2].sum() == pytest.approx(shaken.static["normal_force_n"], rel=1e-9)
    assert built.crack_force[::2].sum() == pytest.approx(-shaken.static["horizontal_force_n"], rel=1e-9)


def test_output_step_changes_nothing_but_the_output():
    coarse, fine = (flexible(case(depth=28.0), shaking(1.0), output_step=step) for step in (0.1, 0.01))
    assert coarse.residual_slip_m == fine.residual_slip_m
    assert (coarse.histories["slip_m"] == fine.histories["slip_m"][::10]).all()


def test_after_the_record_the_ground_stands_still():
    cut = shaking(0.8).cut(1.5)
    short = flexible(case(), cut)
    points = [[f"{t!r} s", f"{a!r} m/s^2"] for t, a in zip(cut.time, cut.acceleration, strict=True)]
    long = flexible(case(motion={"points": points, "duration": "6 s"}))
    assert long.histories["ground_acceleration_m_s2"][-1] == 0.0
    assert long.histories["slip_m"][:150] == pytest.approx(short.histories["slip_m"][:150], abs=1e-9)
    assert long.final_slip_velocity_m_s == pytest.approx(0.0, abs=1e-6)
    assert long.energy.input_j < 2.0 * short.energy.input_j


def test_vertical_motion_changes_the_result():
    plain = flexible(case(depth=27.0), shaking())
    up = flexible(case(depth=27.0), shaking(), shaking(0.4))
    assert up.residual_slip_m != pytest.approx(plain.residual_slip_m, rel=0.01)
    assert "vertical_ground_acceleration_m_s2" in up.histories


def test_a_dam_is_built_once():
    one = build_flexible_dam(case(depth=20.0))
    assert build_flexible_dam(case(depth=20.0, title={}) if False else case(depth=20.0)) is one
    assert build_flexible_dam(case(depth=20.5)) is not one
    response = flexible(case(depth=20.0), shaking(0.1), dam=one)
    assert response.crack.dam is one


def test_references_are_those_of_the_options_used(shaken):
    text = " ".join(shaken.citation())
    assert "Moreau" in text
    assert "Westergaard" in text
    dry = " ".join(flexible(case(flexible={"contact": "idce"}), shaking(0.2).cut(0.5)).citation())
    assert "Newmark" in dry
    assert "Westergaard" not in dry


# Evidence and warnings


def test_the_step_is_halved_until_little_changes():
    wanted = {"convergence_check": True, "time_step": None}
    response = flexible(case(depth=27.0, flexible=wanted), shaking(0.8))
    evidence = response.summary["convergence"]
    assert evidence["time_step_s"] == pytest.approx(evidence["coarser_step_s"] / 2.0)
    assert evidence["time_step_s"] == pytest.approx(response.time_step_s, rel=1e-3)
    assert evidence["change"] <= evidence["allowed"] == 0.03
    assert evidence["residual_slip_m"] == response.residual_slip_m
    assert not any("converge" in text for text in response.warnings)


def test_a_given_step_is_judged_and_not_changed():
    given = {"convergence_check": True, "time_step": "2 ms"}
    response = flexible(case(elevation=12.0, depth=29.0, flexible=given), shaking(1.0))
    evidence = response.summary["convergence"]
    assert evidence["coarser_step_s"] == pytest.approx(2e-3)
    assert evidence["allowed"] == 0.10
    warned = any("has not converged" in text for text in response.warnings)
    assert warned == (evidence["change"] > evidence["allowed"])


def test_change_of_a_slip_too_small_to_matter():
    assert Convergence(1e-4, 2e-4, 0.2, 0.21, 0.03).change == pytest.approx(0.05)
    assert not Convergence(1e-4, 2e-4, 0.2, 0.21, 0.03).reached
    # A tenth of a millimetre more or less is nothing.
    assert Convergence(1e-4, 2e-4, 1e-5, 9e-5, 0.03).reached
    assert not Convergence(1e-4, 2e-4, 1e-5, 5e-4, 0.03).reached


@pytest.mark.parametrize(
    ("more", "text"),
    [
        ({}, "convergence_check is off"),
        ({"depth": 29.5, "concrete": {"damping": 0.001}}, "hardly any damping"),
        ({"concrete": {"poisson": 0.4}}, "concrete.poisson"),
        ({"modulus": 1.0}, "concrete.modulus: 1 GPa is not that of concrete"),
        ({"friction": 0.3, "depth": 29.0}, "slides under its static loads alone"),
        ({"flexible": {"modes": 1}}, "raise flexible.modes"),
    ],
)
def test_warnings(more, text):
    response = flexible(case(**more), shaking(0.3).cut(1.0))
    assert any(text in warning for warning in response.warnings), response.warnings


def test_still_moving_in_the_end_is_a_warning():
    motion = shaking(1.0)
    peak = flexible(case(depth=28.0), motion).histories
    fastest = peak["time_s"][np.argmax(peak["slip_velocity_m_s"])]
    response = flexible(case(depth=28.0), motion.cut(float(fastest)))
    assert any("still moves when the run ends" in text for text in response.warnings)


def test_a_dam_that_slides_away_is_lost():
    motion = GroundMotion.from_points([0.0, 60.0], [-9.0 * G, -9.0 * G])
    response = flexible(case(friction=0.1, modulus=20.0, flexible={"elements_across": 1, "time_step": "1 ms"}), motion)
    assert response.outcome == "lost"
    assert "crack widths away" in response.advice
    json.dumps(response.to_json(), allow_nan=False)


def test_what_cannot_be_run_is_refused():
    with pytest.raises(InputError, match=r"flexible\.time_step: 0\.1 s is too long") as found:
        flexible(case(flexible={"time_step": "0.1 s"}), shaking())
    assert found.value.code == "time-step-long"
    with pytest.raises(InputError) as found:
        flexible(case())
    assert found.value.code == "motion-missing"
