"""The rigid walk by integration: against the exact one, closed forms, bounds and laws that must hold."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heeltoe import build_block, read_case, rigid, verdict
from heeltoe.kernel.block import Limits, run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.rigid.varying import varies, varying
from heeltoe.motion.ground_motion import GroundMotion
from shared.dams import TYPICAL_SECTION

G = 9.80665
RULES = ("constant", "zero while open", "full while open", "follows opening")
#: An anchor that does nothing, with which there is no closed form.
IDLE = np.array([[0.0, 1.0, 0.0, 0.0, 0.0, 0.0, np.inf]])
QUIET = GroundMotion.from_points([0.0, 1.0], [0.0, 0.0], name="quiet")


def rectangle(width, height, friction=1.0, **more):
    corners = [["0 m", "0 m"], [f"{width} m", "0 m"], [f"{width} m", f"{height} m"], ["0 m", f"{height} m"]]
    crack = {"friction": friction, "restitution": 0.0} | more.pop("crack", {})
    return {"section": {"polygon": corners}, "crack": crack, **more}


def integrated(case, time, horizontal, vertical=None, turning=None, at=(), start=None, jam=False, idle=False):
    """Run the walk by integration whatever the case says; across an `idle` anchor nothing has a closed form."""
    block = build_block(case)
    shaking = Shaking(
        np.asarray(time, dtype=float),
        np.asarray(horizontal, dtype=float),
        None if vertical is None else np.asarray(vertical, dtype=float),
        None if turning is None else np.asarray(turning, dtype=float),
    )
    limits = Limits(event_limit=20_000, jam=jam)
    what = varying(case, block)
    if idle:
        what = replace(what, anchors=IDLE)
    return run_block(block.parameters(), shaking, np.asarray(at, dtype=float), limits, start=start, varying=what)


def random_dam(seed, **more):
    """Return a random trapezoid on a crack at a fifth of its height, a random record and its moments."""
    rng = np.random.default_rng(seed)
    width = 10.0 ** rng.uniform(-0.3, 2.0)
    height = width * rng.uniform(0.3, 4.0)
    crest = width * rng.uniform(0.1, 1.0)
    corners = [["0 m", "0 m"], [f"{width} m", "0 m"], [f"{crest} m", f"{height} m"], ["0 m", f"{height} m"]]
    fields = {
        "section": {"polygon": corners},
        "crack": {
            "friction": 10.0 ** rng.uniform(-1.0, 0.2),
            "restitution": float(rng.choice([0.0, 0.3, 0.5, 0.9])),
            "inclination": f"{rng.choice([0.0, 0.0, rng.uniform(-4.0, 10.0)])} deg",
            "elevation": f"{0.2 * height} m",
        },
        "reservoir": {"depth": f"{height * rng.uniform(0.3, 0.9)} m"},
        "uplift": {"pattern": "triangular", "intensity": rng.uniform(0.2, 1.0)} | more.pop("uplift", {}),
        **more,
    }
    if fields.pop("anchored", False):
        stiffness = f"{1e6 * rng.random() * width} N/m^2"
        fields["anchors"] = [
            {"distance": f"{0.2 * width} m", "axial_stiffness": stiffness, "shear_stiffness": stiffness}
        ]
    case = read_case(fields)
    critical = build_block(case).critical_accelerations()
    least = max(0.05 * G, min(abs(critical.sliding_downstream), abs(critical.rocking_downstream), 5.0 * G))
    count, step = 40, 0.04 * math.sqrt(height / 10.0)
    time = np.append(np.arange(count) * step, count * step + 2.0 * math.sqrt(height / 10.0))
    ground = np.append(rng.normal(size=count - 1), [0.0, 0.0]) * least * rng.uniform(0.5, 3.0)
    up = np.append(0.3 * G * rng.normal(size=count - 1), [0.0, 0.0]) if rng.random() < 0.5 else None
    return case, time, ground, up


def exactly(case, time, ground, up, factor=1.0):
    """Run the exact walk, the ground times a factor."""
    shaking = Shaking(time, factor * ground, up)
    return run_block(build_block(case).parameters(), shaking, np.empty(0), Limits(event_limit=20_000, jam=True))


def test_without_anything_that_varies_it_is_the_exact_walk():
    compared = chaotic = 0
    for seed in range(150):
        case, time, ground, up = random_dam(seed)
        by_events, integral = exactly(case, time, ground, up), integrated(case, time, ground, up, jam=True, idle=True)
        assert integral.outcome == by_events.outcome
        if integral.outcome != "ok":
            continue
        exact, ours = by_events.summary, integral.summary
        allowed = 1e-8 * (abs(exact.slip) + 1e-3 * build_block(case).width)
        # Where the exact walk itself changes as much with the last digits of the record, there is nothing to compare.
        if any(
            abs(exactly(case, time, ground, up, 1.0 + way).summary.slip - exact.slip) > allowed
            for way in (-1e-13, 1e-13)
        ):
            chaotic += 1
            continue
        compared += 1
        assert abs(ours.slip - exact.slip) <= allowed, seed
        assert ours.rotation_min == pytest.approx(exact.rotation_min, rel=1e-6, abs=1e-12), seed
    assert compared > 90
    assert chaotic < 15


@pytest.mark.parametrize("rotation", ["small", "p-delta", "finite"])
def test_a_dam_that_lies_slides_by_closed_forms(rotation):
    slid = 0
    for seed in range(60):
        case, time, ground, up = random_dam(
            seed, uplift={"during_shaking": "follows opening"}, analysis={"rotation": rotation}
        )
        exact = exactly(case, time, ground, up).summary
        if exact.slip == 0.0 or exact.outcome or exact.time_rest + exact.time_sliding < time[-1] * (1.0 - 1e-12):
            continue
        slid += 1
        ours = integrated(case, time, ground, up, jam=True).summary
        assert ours.slip == pytest.approx(exact.slip, rel=1e-13, abs=1e-15), seed
        assert ours.energy_friction == pytest.approx(exact.energy_friction, rel=1e-12)
        assert ours.time_sliding == pytest.approx(exact.time_sliding, rel=1e-12)
    assert slid > 5


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("rotation", ["small", "p-delta", "finite"])
def test_every_run_is_sound(rotation, rule):
    for seed in range(60):
        case, time, ground, up = random_dam(
            seed, uplift={"during_shaking": rule}, analysis={"rotation": rotation}, anchored=seed % 2 == 0
        )
        run = integrated(case, time, ground, up, at=time, jam=True)
        one, histories, events = run.summary, run.histories, run.events
        assert run.outcome in ("ok", "unstable", "overturned"), seed
        if run.outcome == "unstable":
            continue
        assert one.energy_residual < 1e-8
        assert all(np.isfinite(column).all() for column in histories.by_name().values())
        assert min(histories.gap_heel.min(), histories.gap_toe.min()) >= 0.0
        assert (events.energy_lost >= -1e-9 * one.energy_input).all()
        parts = one.slip_sliding + one.slip_slide_rocking + one.slip_drifting
        width = build_block(case).width
        assert parts == pytest.approx(one.slip, abs=1e-9 * width, rel=1e-9)


@pytest.mark.parametrize("which", [0, 1])
def test_what_begins_does_not_end_at_once(which):
    # Two of some hundred thousand random dams: a corner that bounces so little that the search for its landing fell
    # back on its take-off, and a slip that grows from nothing before it turns round within one step.
    result = json.loads((Path(__file__).parent / "varying_loops.json").read_text())[which]
    one = integrated(read_case(result["case"]), result["time"], result["ground"], result["vertical"], jam=True)
    assert one.outcome == ("ok", "overturned")[which]
    assert one.summary.events < 500
    assert one.summary.energy_residual < 1e-10


def test_below_the_critical_acceleration_nothing_moves():
    for seed in range(60):
        case, time, ground, _ = random_dam(seed, analysis={"rotation": "finite"}, anchored=True)
        critical = build_block(case).critical_accelerations()
        least = min(
            critical.sliding_downstream,
            critical.sliding_upstream,
            critical.rocking_downstream,
            critical.rocking_upstream,
        )
        if least <= 0.0:
            continue
        still = integrated(case, time, 0.9999 * least * ground / np.abs(ground).max(), at=time)
        assert still.summary.events == still.events.time.size == 0
        assert all((getattr(still.histories, name) == 0.0).all() for name in ("slip", "gap_heel", "gap_toe"))


def test_a_dowel_stops_the_slip_where_the_closed_form_says():
    # m s'' = F - mu m g - k s from rest: it turns round at s = 2 (F - mu m g) / k, where friction holds it:
    # there k s - F = F - 2 mu m g is less than the friction.
    mass, mu, stiffness = 2400.0 * 2.0, 0.5, 1e6
    case = read_case(rectangle(2, 1, mu, anchors=[{"distance": "1 m", "shear_stiffness": f"{stiffness} N/m^2"}]))
    push = 0.9
    one = integrated(case, [0.0, 2.0], [-push * G, -push * G])
    expected = 2.0 * (push - mu) * mass * G / stiffness
    assert one.outcome == "ok"
    assert one.summary.slip == pytest.approx(expected, rel=1e-11)
    assert one.final_mode == "rest"


def test_a_slip_that_just_reaches_an_anchor_is_stopped_by_it():
    # m s'' = -mu m g before it is taut, at s = 0; then -k sin (sin + mu cos) s more. Without the anchor it would turn
    # 1 mm beyond, after a step of the whole way: one that meets the anchor between its stages only.
    mass, mu, stiffness, angle = 2400.0 * 4.0, 0.3, 1e8, math.radians(20.0)
    anchor = {"distance": "2 m", "axial_stiffness": f"{stiffness} N/m^2", "inclination": "20 deg"}
    case = read_case(rectangle(4, 1, mu, anchors=[anchor]))
    before, beyond = 1.0, 1e-3
    start = [[-before, 0.0, 0.0], [math.sqrt(2.0 * mu * G * (before + beyond)), 0.0, 0.0]]
    one = integrated(case, [0.0, 5.0], [0.0, 0.0], start=start).summary
    # Of the speed v with which it reaches the anchor: v^2 / 2 = mu g s + k' s^2 / 2.
    held = stiffness * math.sin(angle) * (math.sin(angle) + mu * math.cos(angle)) / mass
    peak = (math.sqrt((mu * G) ** 2 + 2.0 * held * mu * G * beyond) - mu * G) / held
    assert peak < 0.8 * beyond
    assert one.slip_max == pytest.approx(peak, rel=1e-7)
    assert one.energy_residual < 1e-10


def test_an_anchor_pulls_with_its_prestress_and_its_elongation():
    # A slender block rocks about its toe and stretches a bar at its heel: its largest tension is P + k B theta.
    anchor = {"distance": "0 m", "prestress": "2 kN/m", "axial_stiffness": "100 kN/m/m", "capacity": "2.5 kN/m"}
    case = read_case(rectangle(1, 4, 2.0, anchors=[anchor], analysis={"rotation": "p-delta"}))
    motion = GroundMotion.from_points([0.0, 0.5, 0.5, 4.0], [-0.45 * G, -0.45 * G, 0.0, 0.0])
    response = rigid(case, motion)
    peak = response.anchors[0]["peak_tension_n"]
    assert response.rocking_downstream_rad > 0.01
    assert peak == pytest.approx(2e3 + 1e5 * response.rocking_downstream_rad, rel=1e-4)
    assert any("more than its capacity" in text for text in map(str, response.warnings))


def test_prestress_alone_is_a_force_of_the_exact_walk():
    # It presses the block down: friction for sliding grows by mu P / m; an inclined one also pulls upstream.
    plain = build_block(read_case(rectangle(4, 2, 0.5)))
    for lean in (0.0, 30.0):
        anchor = {"distance": "2 m", "prestress": "50 kN/m", "inclination": f"{lean} deg"}
        case = read_case(rectangle(4, 2, 0.5, anchors=[anchor]))
        assert not varies(case)
        angle = math.radians(lean)
        mass = 2400.0 * 8.0
        more = (0.5 * 50e3 * math.cos(angle) + 50e3 * math.sin(angle)) / mass
        got = build_block(case).critical_accelerations().sliding_downstream
        assert got == pytest.approx(plain.critical_accelerations().sliding_downstream + more, rel=1e-12)


def test_uplift_that_changes_is_bounded_by_none_and_all():
    # The block of the drifting reference case: with less pressure in the open crack it opens less, with more more.
    fields = rectangle(8, 10, 1.2, crack={"restitution": 0.5}, reservoir={"depth": "5 m"})
    time = np.arange(0.0, 0.4001, 0.005)
    motion = GroundMotion.from_points([*time, 3.0], [*(-1.2 * G * np.sin(np.pi * time / 0.4)), 0.0])
    opening = {}
    for rule in RULES:
        case = read_case(fields | {"uplift": {"during_shaking": rule}})
        response = rigid(case, motion)
        assert response.ok
        opening[rule] = response.opening_upstream_m
    assert opening["zero while open"] < opening["follows opening"] < opening["constant"] < opening["full while open"]
    # Where the change takes a larger opening than there is, the pressure is the constant one.
    slow = {"during_shaking": "follows opening", "opening": "0.1 m"}
    held = rigid(read_case(fields | {"uplift": slow}), motion).opening_upstream_m
    assert opening["follows opening"] < held < opening["constant"]


def test_a_crack_full_of_water_as_it_opens_lifts_less_than_statics_would():
    # Zero while open, with the crack drained: rocking starts at the same acceleration as with constant uplift, for the
    # crack is closed until then.
    fields = rectangle(8, 10, 2.0, reservoir={"depth": "5 m"}, uplift={"during_shaking": "zero while open"})
    case = read_case(fields)
    limit = build_block(case).critical_accelerations().rocking_downstream
    for factor, moves in ((0.9999, False), (1.0001, True)):
        one = integrated(case, [0.0, 0.2], np.full(2, -factor * limit)).summary
        assert (one.rotation_min < 0.0) is moves


def test_water_that_follows_the_vertical_motion():
    # With a_v = -g/2 the reservoir pushes with half its force, the concrete weighs half, uplift stays:
    # sliding starts at (mu (m g/2 - U) - P/2) / m_y.
    reservoir = {"depth": "4 m", "follows_vertical_motion": True}
    up = {"points": [["0 s", "-0.5 g"], ["1 s", "-0.5 g"]]}
    level = {"points": [["0 s", "0.1 g"], ["1 s", "0.1 g"]], "vertical": up}
    case = read_case(rectangle(8, 5, 0.8, reservoir=reservoir, motion=level))
    block = build_block(case)
    mass, push, lift = 2400.0 * 40.0, 1000.0 * G * 8.0, 1000.0 * G * 16.0
    limit = (0.8 * (mass * G / 2.0 - lift) - push / 2.0) / block.mass_horizontal
    for factor, moves in ((0.9999, False), (1.0001, True)):
        ground = np.full(2, -factor * limit)
        shaking = Shaking(np.array([0.0, 0.1]), ground, np.full(2, -0.5 * G))
        exact = run_block(block.parameters(), shaking, np.empty(0), Limits(event_limit=99))
        assert (exact.summary.slip > 0.0) is moves
        one = integrated(case, [0.0, 0.1], ground, np.full(2, -0.5 * G)).summary
        assert (one.slip > 0.0) is moves


def test_a_ground_that_turns_moves_the_block_by_its_inertia():
    # Counter-clockwise about the middle of the crack: the centroid, H above, is left behind downstream with m H phi''.
    case = read_case(rectangle(2, 1, 0.2))
    height, mu = 0.5, 0.2
    limit = mu * G / height
    for factor, moves in ((0.9999, False), (1.0001, True)):
        one = integrated(case, [0.0, 0.1], [0.0, 0.0], turning=np.full(2, factor * limit)).summary
        assert (one.slip > 0.0) is moves
    # Its rotation alone lifts a corner where J phi'' + ... exceeds m g B / 2: about the heel, with m_o = J + m H^2.
    stiff = read_case(rectangle(2, 1, 10.0))
    inertia = 2400.0 * 2.0 * (2.0**2 + 1.0**2) / 12.0 + 2400.0 * 2.0 * height**2
    lifts = 2400.0 * 2.0 * G * 1.0 / inertia
    for factor, moves in ((0.9999, False), (1.0001, True)):
        one = integrated(stiff, [0.0, 0.05], [0.0, 0.0], turning=np.full(2, -factor * lifts)).summary
        assert (one.rotation_max > 0.0) is moves
    turning = GroundMotion.from_points([0.0, 1.0], [2.0 * limit, 2.0 * limit])
    assert rigid(case, QUIET, rotation=turning).residual_slip_m > 0.0


def test_rocking_of_any_size_keeps_its_energy_between_blows():
    # Kinetic and potential energy of a slender block let go at 0.9 of its slenderness.
    case = read_case(rectangle(1, 4, 10.0, analysis={"rotation": "finite"}))
    slenderness = math.atan(0.25)
    start = [[0.0, 0.0, math.sin(0.9 * slenderness)], [0.0, 0.0, 0.0]]
    moments = np.linspace(0.0, 1.2, 121)
    one = integrated(case, [0.0, 1.2], [0.0, 0.0], at=moments, start=start)
    h = one.histories
    assert one.summary.impacts == 0
    mass, radius = 2400.0 * 4.0, math.hypot(0.5, 2.0)
    inertia = mass * (1.0 + 16.0) / 12.0 + mass * radius**2
    theta = np.arcsin(h.gap_toe)
    rate = h.gap_velocity_toe / np.cos(theta)
    total = 0.5 * inertia * rate**2 + mass * G * radius * np.cos(slenderness - theta)
    assert total == pytest.approx(np.full(moments.size, total[0]), rel=1e-12)


def test_small_and_finite_rotations_agree_where_rotations_are_small(records):
    """Below one per cent of the slenderness the models differ by no more than that."""
    fields = ["motion.duration=20s", "motion.pga=0.5g", "crack.friction=1.2", "crack.restitution=0.3"]
    small, finite = (
        rigid(read_case("examples/koyna-top.toml", [*fields, f"analysis.rotation={rotation}"]))
        for rotation in ("small", "finite")
    )
    largest = max(small.rocking_downstream_rad, small.rocking_upstream_rad)
    block = build_block(read_case("examples/koyna-top.toml"))
    assert 0.0 < largest < 0.01 * math.atan2(block.toe_distance, block.height)
    assert finite.residual_slip_m == pytest.approx(small.residual_slip_m, rel=0.01)
    for name in ("rocking_downstream_rad", "rocking_upstream_rad", "opening_upstream_m"):
        assert finite.summary[name] == pytest.approx(small.summary[name], rel=0.01)


@pytest.mark.parametrize("rotation", ["small", "p-delta", "finite"])
def test_free_rocking_from_under_one_per_cent_of_the_slenderness(rotation):
    case = read_case(rectangle(1, 4, 10.0, analysis={"rotation": rotation}))
    slenderness = math.atan(0.25)
    start = [[0.0, 0.0, 0.009 * slenderness], [0.0, 0.0, 0.0]]
    first = integrated(case, [0.0, 1.0], [0.0, 0.0], start=start).times_of("toe strikes")[0]
    # theta'' = -m g B / 2 / I: the time of the fall is that of a small rotation, longer by less than one per cent.
    radius2 = 0.25 + 4.0
    fall = math.sqrt(2.0 * 0.009 * slenderness * (17.0 / 12.0 + radius2) / (0.5 * G))
    assert first == pytest.approx(fall, rel=1e-9 if rotation == "small" else 0.01)


def test_mirrored_dams_overturn_the_other_way():
    case = read_case(rectangle(1, 4, 2.0, analysis={"rotation": "finite"}))
    push = [-0.4 * G, -0.4 * G, 0.0, 0.0]
    for sign, about, way in ((1.0, "toe", "downstream"), (-1.0, "heel", "upstream")):
        motion = GroundMotion.from_points([0.0, 1.0, 1.0, 8.0], [sign * value for value in push])
        response = rigid(case, motion, output_step=0.01)
        assert response.outcome == "overturned"
        assert response.ok
        assert response.advice is None
        assert response.overturned_about == about
        assert f"overturns {way}" in verdict(response)
        assert response.opening_upstream_m == pytest.approx(1.0 if about == "toe" else 0.0, abs=1e-9)
        # The histories end where the block lies on its side.
        assert response.histories["time_s"][-1] == response.end_time_s
        assert max(response.histories[f"gap_{corner}_m"][-1] for corner in ("heel", "toe")) == pytest.approx(1.0)
        # Of the rotation itself, up to the side of the block.
        turned = np.abs(response.histories["rotation_rad"])
        assert 1.2 < turned.max() <= math.pi / 2.0
    assert any("Makris" in text for text in response.citation())


def test_a_block_that_all_but_overturns_is_told_to_turn_further():
    response = rigid(
        read_case(rectangle(1, 4, 2.0)), GroundMotion.from_points([0.0, 0.3, 0.3, 4.0], [-0.4 * G, -0.4 * G, 0.0, 0.0])
    )
    assert any('analysis.rotation = "finite"' in text for text in map(str, response.warnings))


@pytest.mark.parametrize("rotation", ["p-delta", "finite"])
def test_length_by_l_and_time_by_its_root(rotation):
    def slip(scale):
        fields = rectangle(2.0 * scale, 6.0 * scale, 0.6, crack={"restitution": 0.2}, analysis={"rotation": rotation})
        time = np.array([0.0, 0.2, 0.4, 0.6, 0.6, 3.0]) * math.sqrt(scale)
        motion = GroundMotion.from_points(time, np.array([0.0, 0.7, -0.8, 0.5, 0.0, 0.0]) * G)
        response = rigid(read_case(fields), motion)
        return response.residual_slip_m, response.rocking_downstream_rad

    (one, turn), (other, same) = slip(1.0), slip(4.0)
    assert one != 0.0
    assert other == pytest.approx(4.0 * one, rel=1e-8)
    assert same == pytest.approx(turn, rel=1e-8)


def test_histories_and_spread_of_a_block_that_varies(records):
    from heeltoe import with_spread

    case = read_case("examples/triangular.toml", ["motion.duration=8s", "uplift.during_shaking=zero while open"])
    response = with_spread(rigid(case, output_step=0.02), case, 3)
    assert response.histories["time_s"].size == 401
    assert response.spread["failed"] == 0
    assert response.spread["residual_slips_m"][1] == pytest.approx(response.residual_slip_m, rel=1e-9)
    assert "Bureau of Reclamation" in " ".join(response.citation())


def test_a_level_crack_is_the_limit_of_an_inclined_one():
    def limits(angle):
        crack = {"friction": 0.8, "elevation": "20 m", "inclination": f"{angle} deg"}
        return build_block(
            read_case({"section": TYPICAL_SECTION, "crack": crack, "reservoir": {"depth": "60 m"}})
        ).critical_accelerations()

    level, tilted, steep = limits(0.0), limits(1e-6), limits(5.0)
    for name in ("sliding_downstream", "sliding_upstream", "rocking_downstream", "rocking_upstream"):
        assert getattr(tilted, name) == pytest.approx(getattr(level, name), rel=1e-6)
    # Up a slope it is harder to slide, down it easier.
    assert steep.sliding_downstream > level.sliding_downstream
    assert steep.sliding_upstream < level.sliding_upstream


def test_a_dry_block_on_a_slope_slides_where_the_angle_of_friction_says():
    # Up a slope of beta the ground must accelerate by g tan(phi + beta), down it by g tan(phi - beta).
    phi, beta = math.atan(0.4), math.radians(10.0)
    corners = [["0 m", "0 m"], ["40 m", "0 m"], ["40 m", "30 m"], ["0 m", "30 m"]]
    crack = {"friction": 0.4, "elevation": "15 m", "inclination": "10 deg"}
    block = build_block(read_case({"section": {"polygon": corners}, "crack": crack}))
    critical = block.critical_accelerations()
    assert critical.sliding_downstream == pytest.approx(G * math.tan(phi + beta), rel=1e-12)
    assert critical.sliding_upstream == pytest.approx(G * math.tan(phi - beta), rel=1e-12)
