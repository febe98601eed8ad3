"""Friction laws of a rigid block: closed forms, Coulomb as their limit, an independent program, laws that must hold."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import InputError, build_block, read_case, rigid, rigid_many, statics
from heeltoe.app.sliders import sliders
from heeltoe.kernel.block import Limits, run_block
from heeltoe.kernel.friction import LAWS, friction_law, shear_stress
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.rigid.varying import varying
from heeltoe.models.run import earthquake
from heeltoe.motion.ground_motion import GroundMotion
from models.rigid.test_varying import exactly, integrated, random_dam, rectangle
from shared.dams import TYPICAL_SECTION

G = 9.80665
PULSE = (np.array([0.0, 0.3, 0.3, 5.0]), 0.8 * G * np.array([-1.0, -1.0, 0.0, 0.0]))


def walked(case, time, ground, law, up=None, at=(), jam=True):
    """Run a block whose crack has a law, by integration."""
    block = build_block(case)
    shaking = Shaking(np.asarray(time, dtype=float), np.asarray(ground, dtype=float), up)
    what = replace(varying(case, block), friction=law)
    limits = Limits(event_limit=20_000, jam=jam)
    return run_block(block.parameters(), shaking, np.asarray(at, dtype=float), limits, varying=what)


def weight(case):
    return build_block(case).concrete_mass * G


def linear(peak=0.6, residual=0.3, slip=0.05):
    return friction_law("linear slip weakening", {"peak": peak, "residual": residual, "scale": slip})


def test_a_weakening_slider_under_a_pulse_by_hand():
    case, slip = read_case(rectangle(20.0, 1.0, 0.6)), 0.05
    # s'' = (0.8 - 0.6) g + 0.3 g s / D until s = D, or 0.2 (cosh(k t) - 1) / 0.3 of it.
    k = math.sqrt(0.3 * G / slip)
    at = np.linspace(0.0, 0.11, 12)
    run = walked(case, *PULSE, linear(slip=slip), at=at)
    expected = 0.2 * slip / 0.3 * (np.cosh(k * at) - 1.0)
    assert expected[-1] < slip
    assert run.histories.slip == pytest.approx(expected, abs=1e-10)
    # The work of friction is that of the curve; that of the pulse ends with it.
    way = run.summary.slip
    assert way > slip
    lost = weight(case) * (0.45 * slip + 0.3 * (way - slip))
    assert run.summary.energy_friction == pytest.approx(lost, rel=1e-10)
    assert run.worn.end == way


def test_exponential_weakening_loses_the_work_under_its_curve():
    case, slip = read_case(rectangle(20.0, 1.0, 0.6)), 0.05
    law = friction_law("exponential slip weakening", {"peak": 0.6, "residual": 0.3, "scale": slip})
    run = walked(case, *PULSE, law)
    way = run.summary.slip
    lost = weight(case) * (0.3 * way + 0.3 * slip * -math.expm1(-way / slip))
    assert run.summary.energy_friction == pytest.approx(lost, rel=1e-10)


def test_cohesion_is_lost_under_its_curve_or_at_once():
    case, cohesion, slip = read_case(rectangle(20.0, 1.0, 0.6)), 2000.0, 0.05
    for loss, work in ((slip, 0.5 * cohesion * 20.0 * slip), (0.0, 0.0)):
        law = friction_law("constant", {"peak": 0.3, "residual": 0.3, "cohesion": cohesion, "loss": loss})
        run = walked(case, *PULSE, law)
        way = run.summary.slip
        assert way > slip
        # The corner of the curve lies within a step, the shortest of which is a thousand-millionth of the time scale.
        assert run.summary.energy_friction == pytest.approx(weight(case) * 0.3 * way + work, rel=1e-9)


def test_a_bond_holds_what_friction_does_not():
    case = read_case(rectangle(20.0, 1.0, 0.3))
    needed = (0.8 - 0.3) * weight(case) / 20.0
    for cohesion, moves in ((0.999 * needed, True), (1.001 * needed, False)):
        run = walked(case, *PULSE, friction_law("constant", {"peak": 0.3, "residual": 0.3, "cohesion": cohesion}))
        assert (run.summary.slip > 0.0) == moves


def test_speed_weakening_comes_to_its_steady_acceleration():
    case, speed = read_case(rectangle(20.0, 1.0, 0.6)), 0.01
    law = friction_law("speed weakening", {"peak": 0.6, "residual": 0.3, "scale": speed})
    run = walked(case, *PULSE, law, at=[0.25])
    assert run.histories.slip_acceleration[0] == pytest.approx(0.5 * G, rel=1e-10)
    assert run.histories.friction_force[0] == pytest.approx(-0.3 * weight(case), rel=1e-10)


@pytest.mark.parametrize("seed", range(12))
def test_every_law_reduced_to_coulomb_gives_coulombs_result(seed):
    case, time, ground, up = random_dam(seed)
    mu = case.crack.mu_static
    exact, plain = exactly(case, time, ground, up), integrated(case, time, ground, up, jam=True)
    same = {"peak": mu, "residual": mu, "scale": 1.0}
    reduced = [friction_law(name, same) for name in LAWS[:4]]
    reduced += [
        friction_law("barton-bandis", {"residual_angle": math.atan(mu), "wall_strength": 1e7}),
        friction_law("lift joint", {"residual": mu}),
    ]
    for law in reduced:
        walk = walked(case, time, ground, law, up)
        assert walk.outcome == exact.outcome
        for name in ("slip", "rotation_min", "rotation_max"):
            assert getattr(walk.summary, name) == pytest.approx(getattr(exact.summary, name), rel=1e-10, abs=1e-12)
            assert getattr(walk.summary, name) == pytest.approx(getattr(plain.summary, name), rel=1e-12, abs=1e-14)


def test_a_lift_joint_is_basic_friction_and_what_is_rough():
    law = friction_law("lift joint", {"residual": 0.7}, [(1e5, 0.4), (5e5, 0.2), (2e6, 0.1)])
    stress = np.array([5e4, 1e5, 3e5, 5e5, 1e6, 3e6])
    assert shear_stress(law, stress)[1] / stress == pytest.approx([1.1, 1.1, 1.0, 0.9, 0.7 + 0.2 - 0.1 / 3.0, 0.8])


def small_steps(time, ground, g, law, width, substeps):
    """An independent program for a block of a unit mass that only slides: an impulse of friction in every small step,
    up to what the law bears at the way and the speed before it. Of first order."""
    velocity, slip, path = 0.0, 0.0, 0.0
    for k in range(time.size - 1):
        step = (time[k + 1] - time[k]) / substeps
        for part in range(substeps):
            a = ground[k] + (ground[k + 1] - ground[k]) * (part + 0.5) / substeps
            free = velocity - a * step
            still, moving = law(g / width, path, abs(velocity))
            bound = (still if velocity == 0.0 else moving) * width * step
            if abs(free) <= bound or (velocity != 0.0 and free * velocity < 0.0 and abs(free) <= bound):
                after = 0.0
            else:
                after = free - math.copysign((moving if velocity == 0.0 else bound / width / step) * width * step, free)
            slip += 0.5 * step * (velocity + after)
            path += 0.5 * step * abs(velocity + after)
            velocity = after
    return slip


def hand_written(name, stress, path, speed):
    """The laws of the test below, written by hand: shear stresses at rest and sliding."""
    mu = {
        "linear slip weakening": 0.12 + 0.1 * max(0.0, 1.0 - path / 0.02),
        "exponential slip weakening": 0.12 + 0.1 * math.exp(-path / 0.02),
        "speed weakening": 0.12 + 0.1 * math.exp(-speed / 0.1),
        "constant": 0.15,
        "gradual": 0.15,
        "brittle": 0.15,
        "barton-bandis": math.tan(math.radians(5.0 + 4.0 * math.log10(20.0 / stress))),
        "lift joint": 0.1 + 0.05 * stress / 10.0 if stress < 10.0 else 0.15,
    }[name]
    bond = {"gradual": 0.03 * max(0.0, 1.0 - path / 0.01), "brittle": 0.03 * (path == 0.0)}.get(name, 0.0)
    return mu * stress + bond, mu * stress + (0.0 if name == "brittle" else bond)


NUMBERS = {
    **{name: {"peak": 0.22, "residual": 0.12, "scale": 0.02} for name in LAWS[1:3]},
    "speed weakening": {"peak": 0.22, "residual": 0.12, "scale": 0.1},
    "constant": {"peak": 0.15, "residual": 0.15},
    "gradual": {"peak": 0.15, "residual": 0.15, "cohesion": 0.03, "loss": 0.01},
    "brittle": {"peak": 0.15, "residual": 0.15, "cohesion": 0.03},
    "barton-bandis": {"roughness": 4.0, "wall_strength": 20.0, "residual_angle": math.radians(5.0)},
    "lift joint": {"residual": 0.1},
}


@pytest.mark.parametrize("name", NUMBERS)
def test_a_program_of_small_steps_agrees_on_a_real_record(name, records):
    motion = {"file": str(next(records.glob("taft-1952-s69e-caltech*"))), "pga": "0.4 g"}
    case = read_case(rectangle(20.0, 1.0, 0.2, motion=motion))
    density = weight(case) / G  # the hand-written block has a unit mass: stresses in parts of this one's
    numbers = {
        key: value * (density if key in ("cohesion", "wall_strength") else 1.0) for key, value in NUMBERS[name].items()
    }
    points = [(0.0, 0.0), (10.0 * density, 0.05)] if name == "lift joint" else []
    shape = name if name in LAWS else "constant"
    shaking = earthquake(case).shaking
    time, ground = shaking.time, shaking.horizontal
    keep = time <= 12.0
    time, ground = time[keep], ground[keep]
    run = walked(case, time, ground, friction_law(shape, numbers, points))
    result, path_slipped = run.summary.slip, run.worn.end

    def law(stress, path, speed):
        return hand_written(name, stress, path, speed)

    # A brittle bond breaks on a step, so that its error does not fall evenly: three of them say how large it is.
    counts = (10, 20, 40) if name == "brittle" else (10, 20)
    tried = [small_steps(time, ground, G, law, 20.0, count) for count in counts]
    error = max(tried) - min(tried)
    assert abs(result) > 1e-4
    assert result == pytest.approx(tried[-1], abs=2.0 * error + 1e-7)
    assert error < 0.1 * path_slipped


def random_law(rng):
    low, high = sorted(10.0 ** rng.uniform(-1.0, 0.2, 2))
    bond = {"cohesion": float(rng.choice([0.0, 0.0, 10.0 ** rng.uniform(3.0, 6.0)]))}
    bond["loss"] = float(rng.choice([0.0, 10.0 ** rng.uniform(-4.0, -1.0)]))
    name = LAWS[rng.integers(len(LAWS))]
    if name == "barton-bandis":
        walls = {"wall_strength": 10.0 ** rng.uniform(5.0, 8.0), "roughness": rng.uniform(0.0, 20.0)}
        return friction_law(name, {"residual_angle": math.atan(low), **walls, **bond})
    if name == "lift joint":
        return friction_law(name, {"residual": low, **bond}, [(0.0, 1.0), (2e5, 0.5), (1e6, 0.3)])
    return friction_law(name, {"peak": high, "residual": low, "scale": 10.0 ** rng.uniform(-3.0, 0.0), **bond})


def check_random(seed):
    case, time, ground, up = random_dam(seed, anchored=seed % 5 == 0)
    walk = walked(case, time, ground, random_law(np.random.default_rng(seed + 10**6)), up, at=time)
    raw = walk.summary
    assert np.isfinite(list(raw.by_name().values())).all()
    assert np.isfinite(walk.worn.error)
    assert all(np.isfinite(column).all() for column in walk.histories.by_name().values())
    assert raw.energy_friction >= -1e-9 * abs(raw.energy_input)
    assert raw.energy_residual < 1e-7
    assert (np.diff(walk.worn.path) >= 0.0).all()
    return walk.outcome


def test_random_blocks_with_random_laws_end():
    ends = [check_random(seed) for seed in range(60)]
    assert ends.count("ok") > 45
    assert set(ends) <= {"ok", "unstable"}


# A slip that slows until friction, which rises meanwhile, makes the reaction infinite.
@pytest.mark.parametrize("seed", [383, 2446, 3804, 8294])
def test_friction_that_jams_a_slowing_slip_ends_it(seed):
    assert check_random(seed) == "ok"


@pytest.mark.product
def test_five_thousand_random_blocks_with_random_laws_end():
    ends = [check_random(seed) for seed in range(5_000)]
    assert ends.count("ok") > 3750
    assert set(ends) <= {"ok", "unstable"}


WEAKENING = {"name": "slip weakening", "peak_friction": 1.1, "residual_friction": 0.9, "slip": "20 mm"}
BARTON = {"name": "barton-bandis", "jrc": 10, "jcs": "20 MPa", "residual_angle": "32 deg"}
LIFT = {
    "name": "lift joint",
    "surface": "untreated",
    "basic_friction": 0.8,
    "roughness_friction": [["0.1 MPa", 0.4], ["2 MPa", 0.2]],
}
COHESION = {"name": "cohesion", "cohesion": "0.1 MPa", "residual_friction": 0.9}
SPEED = {"name": "speed weakening", "peak_friction": 1.1, "residual_friction": 0.9, "speed": "0.1 m/s"}
ALL = [WEAKENING, {**WEAKENING, "form": "exponential"}, SPEED, COHESION, {**COHESION, "slip": "5 mm"}, BARTON, LIFT]
SHAKEN = GroundMotion.from_points([0.0, 0.2, 0.3, 0.5, 3.0], [0.0, -6.0, -6.0, 0.0, 0.0], name="pulse")


def typical(law, **more):
    return read_case(
        {
            "section": TYPICAL_SECTION,
            "concrete": {"density": "2650 kg/m^3"},
            "crack": {"restitution": 0.5, "law": law},
            "reservoir": {"depth": "90 m"},
            **more,
        }
    )


@pytest.mark.parametrize(
    "law", ALL, ids=lambda law: "-".join(map(str, list(law.values())[:1] + sorted(set(law) & {"form", "slip"})))
)
def test_a_dam_with_each_law(law):
    response = rigid(typical(law), SHAKEN)
    result, histories = response.friction_law, response.histories
    assert response.outcome == "ok"
    assert result["name"] == law["name"]
    assert result["slip_path_m"] >= abs(response.residual_slip_m) * (1.0 - 1e-12) > 0.0
    assert result["apparent_friction_after"] <= result["apparent_friction_before"]
    assert result["integration_error_m"] < 1e-6
    assert (np.diff(histories["slip_path_m"]) >= 0.0).all()
    slides = np.array([mode.startswith("slide ") for mode in response.mode])
    assert slides.any()
    borne = histories["friction_strength_n"][slides]
    assert abs(histories["friction_force_n"][slides]) == pytest.approx(borne, rel=1e-9)
    assert any("DOP853" in source for source in response.references)
    judged = statics(typical(law)).cases[0]
    strength = judged.cohesive_force_n + judged.friction * judged.normal_force_n
    assert judged.sliding_factor == pytest.approx(strength / abs(judged.shear_force_n))
    assert strength / judged.normal_force_n == pytest.approx(result["apparent_friction_before"], rel=0.05)


def test_many_blocks_have_the_same_bits_on_any_number_of_threads():
    cases = [typical(law) for law in ALL]
    one, four = (rigid_many(cases, [SHAKEN], threads=threads) for threads in (1, 4))
    assert one.keys() == four.keys()
    for name in one:
        assert (one[name] == four[name]).all(), name
    alone = [rigid(case, SHAKEN).residual_slip_m for case in cases]
    assert one["slip"] == pytest.approx(alone, abs=0.0)


@pytest.mark.parametrize(
    ("law", "code"),
    [
        ({**WEAKENING, "jrc": 5}, "option-foreign"),
        ({"name": "barton-bandis", "jrc": 5}, "option-missing"),
        ({**WEAKENING, "residual_friction": 1.2}, "below-other"),
        ({**LIFT, "roughness_friction": [["2 MPa", 0.2], ["1 MPa", 0.4]]}, "not-ascending"),
        ({**LIFT, "basic_friction": 0.1, "roughness_friction": [["1 MPa", 1.0], ["1.1 MPa", 0.1]]}, "law-falls"),
        ({**LIFT, "surface": "plane"}, "contradiction"),
        ({"name": "lift joint", "surface": "untreated", "basic_friction": 0.8}, "option-missing"),
    ],
)
def test_what_a_law_does_not_know_is_refused(law, code):
    with pytest.raises(InputError) as refused:
        typical(law)
    assert refused.value.code == code


def test_a_law_stands_beside_nothing_that_says_the_same():
    with pytest.raises(InputError, match='cannot stand beside "law"'):
        typical(WEAKENING, crack={"friction": 1.0, "law": WEAKENING})
    with pytest.raises(InputError) as refused:
        typical(COHESION, statics={"bonded": 0.5, "cohesion": "0.1 MPa"})
    assert refused.value.code == "combination"


def test_coefficients_that_are_given_take_the_place_of_a_law():
    case = typical(WEAKENING)
    assert case.with_("crack.friction=1.0").crack.law is None
    assert case.with_("crack.friction=1.0").with_({"crack.law": BARTON}).crack.friction is None


def test_a_law_beyond_its_range_is_warned_about():
    codes = [notice.name for notice in rigid(typical({**BARTON, "jcs": "0.2 MPa"}), SHAKEN).warnings]
    assert {"law-range mean", "law-by-mean"} <= set(codes)
    assert "law-range mean" in [
        notice.name for notice in rigid(typical({**BARTON, "jrc": 20, "jcs": "1 GPa"}), SHAKEN).warnings
    ]
    points = [["0.1 MPa", 0.4], ["0.2 MPa", 0.38]]
    assert "law-range mean" in [
        notice.name for notice in rigid(typical({**LIFT, "roughness_friction": points}), SHAKEN).warnings
    ]
    assert "law-range mean" not in [notice.name for notice in rigid(typical(BARTON), SHAKEN).warnings]


def test_the_app_has_no_slider_for_a_law():
    assert sliders(typical(WEAKENING), "si")[0].off == "The law slip weakening gives the friction of the crack."
    assert not sliders(typical(WEAKENING).with_("crack.friction=0.9"), "si")[0].off
