"""Uplift that changes while the crack opens, and anchors: closed forms, laws, the ledger, and what is refused."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heeltoe import GroundMotion, InputError, flexible
from heeltoe.kernel.dam import CrackedDam, FollowingWater, only_crack
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.body.step import longest_step
from shared.dams import BASE, FAST, plane_case

G = 9.80665
MASS = 2400.0 * 4.0


def block(friction=0.3, anchors=(), **more):
    """A stiff block, 4 m wide and 1 m high, without water; its motion is given with each run, which ends with it."""
    return plane_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["4 m", "0 m"], ["4 m", "1 m"], ["0 m", "1 m"]]},
            "concrete": {"density": "2400 kg/m^3", "modulus": "2000 GPa", "poisson": 0.0},
            "crack": {"friction": friction},
            "anchors": list(anchors),
            "analysis": {"silence": "0 s"},
            "flexible": {"elements_across": 2, "evidence": "none", "time_step": "2e-5 s"},
        }
        | more
    )


def pushed(horizontal, vertical, duration):
    """Ground that accelerates steadily."""
    time = np.array([0.0, duration])
    return tuple(GroundMotion.from_points(time, np.full(2, value)) for value in (horizontal, vertical))


# Anchors


def test_a_dowel_stops_a_block_where_the_closed_form_says():
    # A steady push F = 0.5 m g against friction 0.3 m g and a spring: half a cosine to 2 (F - friction) / k, and as
    # F is less than three times the friction the block stays there.
    stiffness = 4e6
    case = block(anchors=[{"distance": "2 m", "shear_stiffness": f"{stiffness} N/m/m"}])
    response = flexible(case, *pushed(-0.5 * G, 0.0, 0.6))
    expected = 2.0 * 0.2 * MASS * G / stiffness
    omega = math.sqrt(stiffness / MASS)
    time, slip = response.histories["time_s"], response.histories["slip_m"]
    way = expected / 2.0 * (1.0 - np.cos(omega * np.minimum(time, math.pi / omega)))
    assert slip == pytest.approx(way, abs=0.01 * expected)
    assert response.residual_slip_m == pytest.approx(expected, rel=0.01)
    assert response.energy.residual < 1e-12
    # What the dowel holds in the end.
    assert response.energy.left_j == pytest.approx(stiffness * expected**2 / 2.0, rel=0.02)


def test_an_anchor_holds_a_block_that_would_fly():
    # Ground that falls away at 1.5 g: the block rises by (0.5 m g - P) / k (1 - cos), its anchor's peak is m g - P.
    stiffness, prestress = 5e6, 2e4
    anchor = {
        "distance": "2 m",
        "axial_stiffness": f"{stiffness} N/m/m",
        "prestress": f"{prestress} N/m",
        "capacity": "70 kN/m",
    }
    response = flexible(block(anchors=[anchor]), *pushed(0.0, -1.5 * G, 0.2))
    net = 0.5 * MASS * G - prestress
    gap = response.histories["gap_heel_m"]
    time = response.histories["time_s"]
    rise = net / stiffness * (1.0 - np.cos(math.sqrt(stiffness / MASS) * time))
    assert gap == pytest.approx(rise, abs=0.02 * rise.max())
    (borne,) = response.anchors
    assert borne.peak_tension_n == borne.peak_force_n == pytest.approx(prestress + 2.0 * net, rel=0.01)
    assert (borne.distance_m, borne.capacity_n) == (2.0, 70e3)
    assert any("more than its capacity of 0.07 MN/m" in text for text in map(str, response.warnings))
    assert response.energy.residual < 1e-12


def test_prestress_alone_is_a_constant_load():
    # 40 kN/m more on the crack: the block starts to slide at friction (m g + P) / m.
    anchor = {"distance": "2 m", "prestress": "40 kN/m", "capacity": "50 kN/m"}
    held = 0.3 * (MASS * G + 4e4) / MASS
    still = flexible(block(anchors=[anchor]), *pushed(-0.97 * held, 0.0, 0.3))
    moving = flexible(block(anchors=[anchor]), *pushed(-1.2 * held, 0.0, 0.3))
    assert abs(still.residual_slip_m) < 1e-5
    assert moving.residual_slip_m == pytest.approx(0.2 * held * 0.3**2 / 2.0, rel=0.02)
    (borne,) = still.anchors
    assert (borne.peak_tension_n, borne.peak_force_n, borne.capacity_n) == (4e4, 4e4, 5e4)
    assert not any("capacity" in text for text in map(str, moving.warnings))


def test_an_inclined_anchor_pulls_by_its_slip():
    # Leaning downstream by 60 degrees, it is stretched by sin 60 of the slip and pulls the block down as well.
    stiffness, lean = 4e6, math.radians(60.0)
    anchor = {"distance": "2 m", "axial_stiffness": f"{stiffness} N/m/m", "inclination": "60 deg"}
    response = flexible(block(anchors=[anchor]), *pushed(-0.5 * G, 0.0, 0.6))
    # Pull along and, by friction, down: a stiffer spring while it slides downstream, and no way back.
    resists = stiffness * math.sin(lean) * (math.sin(lean) + 0.3 * math.cos(lean))
    expected = 2.0 * 0.2 * MASS * G / resists
    assert response.residual_slip_m == pytest.approx(expected, rel=0.01)
    assert response.summary["anchors"][0]["peak_tension_n"] == pytest.approx(
        stiffness * math.sin(lean) * expected, rel=0.01
    )


def test_a_slack_anchor_does_not_push():
    # The other way it only gets slack: the block slides on as if it were not there.
    anchor = {"distance": "2 m", "axial_stiffness": "4 MN/m/m", "inclination": "60 deg"}
    response = flexible(block(anchors=[anchor]), *pushed(0.5 * G, 0.0, 0.3))
    free = flexible(block(), *pushed(0.5 * G, 0.0, 0.3))
    assert response.residual_slip_m == pytest.approx(free.residual_slip_m, rel=1e-9)
    assert free.residual_slip_m == pytest.approx(-0.2 * G * 0.3**2 / 2.0, rel=0.01)
    assert response.summary["anchors"][0]["peak_tension_n"] < 1.0


# Dams

TIME = np.linspace(0.0, 3.0, 601)
SHAKEN = GroundMotion("shaken", TIME, 7.0 * np.sin(2.0 * np.pi * 2.5 * TIME) * (TIME < 2.0))
SMALL = [*FAST, "reservoir.depth=80m"]
ANCHORS = (
    'anchors=[{distance="3 m", prestress="2 MN/m", axial_stiffness="200 MN/m/m", shear_stiffness="100 MN/m/m", '
    'inclination="-15 deg"}]'
)
LAWS = ("zero while open", "full while open", "follows opening")


def typical(elevation, *more):
    changes = [*SMALL, f"crack.elevation={elevation}m", *more]
    return plane_case(BASE, changes)


@pytest.fixture(scope="module", params=[0.0, 30.0])
def elevation(request):
    return request.param


def test_uplift_by_its_laws(elevation):
    constant, zero, full, follows = (
        flexible(typical(elevation, *([f'uplift.during_shaking="{law}"'] if law else [])), SHAKEN)
        for law in ("", *LAWS)
    )
    assert constant.opening_upstream_m > 1e-3
    # Less pressure holds the dam better, more of it worse.
    assert max(zero.residual_slip_m, follows.residual_slip_m) < 0.9 * constant.residual_slip_m
    assert full.residual_slip_m > 1.1 * constant.residual_slip_m
    for response in (zero, full, follows):
        assert response.energy.residual < 1e-12
        assert response.outcome == "ok"
    assert any("Bulletin 52" in text for text in full.references)


def test_a_change_over_a_wide_opening_is_none(elevation):
    dam = build_flexible_dam(typical(elevation, 'uplift.during_shaking="follows opening"', 'uplift.opening="0.1 m"'))
    shaking = np.column_stack([np.interp(np.arange(0.0, 1.0, 2e-4), TIME, SHAKEN.acceleration), np.zeros(5000)])

    def slip(opening):
        (line,) = dam.lines
        water = dataclasses.replace(line.water, opening=opening) if opening else None
        return (
            CrackedDam(dam.reduced, [dataclasses.replace(line, water=water)], 3).run(shaking, 2e-4, 0.52).summary.slip
        )

    assert abs(slip(None)) > 0.01
    assert slip(1e9) == pytest.approx(slip(None), rel=1e-6)
    assert slip(0.1) != pytest.approx(slip(None), rel=1e-4)


@pytest.mark.parametrize("law", LAWS)
def test_a_rising_block_by_its_equation_of_motion(law):
    # m z'' = m (a - g) + U(z) of a block on ground that falls away, with the law written out.
    still, reservoir, opening, fall = 2e4, 9e4, 2e-3, 1.5 * G
    laws = {
        "zero while open": lambda z: still * max(0.0, 1.0 - z / opening),
        "full while open": lambda z: still + (reservoir - still) * min(1.0, z / opening),
        "follows opening": lambda z: still * opening / (opening + z),
    }
    dam = build_flexible_dam(block())
    # The static load is that of a crack under the still pressure.
    share = np.array([1.0, 4.0, 2.0, 4.0, 1.0]) / 12.0
    part = dam.reduced[0]
    pressed = dataclasses.replace(part, load=part.load + part.shapes[:, 5:] @ (still * share))
    water = FollowingWater(law, opening, (still * share,), (reservoir * share,))
    (line,) = only_crack((pressed,), (0.3, 0.3))
    kernel = CrackedDam((pressed,), [dataclasses.replace(line, water=water)], 3)
    step, steps = 2e-5, 2000
    run = kernel.run(np.tile([0.0, -fall], (steps, 1)), step, 0.52, stride=10)
    time, rise = run.frames.time, run.frames.gap_heel

    def motion(_, state):
        return [state[1], fall - G + laws[law](state[0]) / MASS]

    reference = solve_ivp(motion, (0.0, time[-1]), [0.0, 0.0], t_eval=time, rtol=1e-9, max_step=1e-4).y[0]
    assert rise[-1] > 2.0 * opening
    assert rise == pytest.approx(reference, abs=0.005 * rise[-1])
    assert run.summary.energy_residual < 1e-12


@pytest.mark.parametrize("law", LAWS)
def test_halving_the_step_converges(law):
    slips = []
    for step in (2e-4, 1e-4, 5e-5, 2.5e-5):
        options = (f'uplift.during_shaking="{law}"', f"flexible.time_step={step}s", ANCHORS, "motion.duration=0.8s")
        slips.append(flexible(typical(0.0, *options), SHAKEN).residual_slip_m)
    assert slips[-1] > 0.05
    assert np.ptp(slips) < 2e-3 * slips[-1]
    assert abs(slips[-1] - slips[-2]) < 5e-4 * slips[-1]


def test_anchors_hold_a_dam(elevation):
    free, held = flexible(typical(elevation), SHAKEN), flexible(typical(elevation, ANCHORS), SHAKEN)
    assert 0.0 < held.residual_slip_m < 0.8 * free.residual_slip_m
    assert held.energy.residual < 1e-12
    assert abs(held.energy.numerical_j) < 0.1 * held.energy.input_j
    assert held.summary["anchors"][0]["peak_tension_n"] > 2e6
    # The frames close too, with what the anchors hold.
    h, e = held.histories, held.energy
    assert h["stored_energy_j"][-1] - h["stored_energy_j"][0] == pytest.approx(e.left_j, rel=1e-9)


def test_water_that_changes_nothing_changes_nothing():
    # Full pressure in a crack that is under it already, everywhere: not a bit may differ but rounding.
    uniform = ('uplift.pattern="uniform"', "crack.friction=1.5", "flexible.time_step=0.2 ms")
    constant = flexible(typical(0.0, *uniform), SHAKEN)
    full = flexible(typical(0.0, *uniform, 'uplift.during_shaking="full while open"'), SHAKEN)
    assert full.residual_slip_m == pytest.approx(constant.residual_slip_m, rel=1e-9)
    assert constant.opening_upstream_m > 1e-3


# What is refused


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ('uplift.during_shaking="follows opening"', "uplift.during_shaking"),
        (ANCHORS, r"anchors\[0\].axial_stiffness"),
        ('anchors=[{distance="3 m", shear_stiffness="100 MN/m/m"}]', r"anchors\[0\].shear_stiffness"),
    ],
)
def test_the_penalty_method_knows_contact_alone(change, words):
    with pytest.raises(InputError, match=words) as caught:
        flexible(typical(0.0, change, 'flexible.contact="idce"', 'flexible.damping="stiffness"'), SHAKEN)
    assert caught.value.code == "unsupported"
    assert "penalty contact" in str(caught.value)


def test_the_penalty_method_bears_prestress():
    anchor = {"distance": "2 m", "prestress": "40 kN/m"}
    options = {"elements_across": 2, "evidence": "none", "time_step": "2e-5 s"}
    exact, penalty = (
        flexible(
            block(anchors=[anchor], flexible={**options, "contact": contact, "damping": "stiffness"}),
            *pushed(-0.8 * G, 0.0, 0.3),
        )
        for contact in ("coulomb", "idce")
    )
    assert exact.residual_slip_m > 0.05
    assert penalty.residual_slip_m == pytest.approx(exact.residual_slip_m, rel=0.01)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        (('uplift.during_shaking="zero while open"', 'uplift.opening="0.001 mm"'), "uplift.opening"),
        (('anchors=[{distance="3 m", axial_stiffness="1e7 MN/m/m"}]',), "anchors"),
    ],
)
def test_what_a_step_cannot_follow_is_refused(changes, field):
    with pytest.raises(InputError) as caught:
        flexible(typical(0.0, *changes, "flexible.time_step=5e-3s"), SHAKEN)
    assert (caught.value.code, caught.value.field) == ("step-stiff", field)


def test_the_step_is_shortened_for_what_is_stiff():
    dam = build_flexible_dam(typical(0.0, 'anchors=[{distance="3 m", axial_stiffness="1e7 MN/m/m"}]'))
    step, field = longest_step(dam, 0.52, 1e-2)
    assert field == "anchors"
    assert step < 1e-2
    soft = build_flexible_dam(typical(0.0, 'anchors=[{distance="3 m", axial_stiffness="1 MN/m/m"}]'))
    assert longest_step(soft, 0.52, 1e-2)[0] == 1e-2


def test_anchors_hold_what_friction_does_not():
    held, free = (
        flexible(typical(0.0, "crack.friction=0.5", "reservoir.depth=95m", *anchors), SHAKEN)
        for anchors in (('anchors=[{distance="40 m", shear_stiffness="2000 MN/m/m"}]',), ())
    )
    assert (held.outcome, free.outcome) == ("ok", "unstable")
    assert any("until its anchors hold it" in text for text in map(str, held.warnings))
    assert 0.0 < held.residual_slip_m < 0.1 * free.residual_slip_m


def test_the_rigid_block_alone_has_a_say_in_its_rotation():
    response = flexible(typical(0.0, 'analysis.rotation="finite"'), SHAKEN)
    assert any("analysis.rotation" in text and "no effect" in text for text in map(str, response.warnings))
