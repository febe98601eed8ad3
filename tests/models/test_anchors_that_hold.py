"""Anchors that hold a dam, go slack, or bear more than they are good for: a block on a plane, by hand.

It is 4 m wide and 1 m high, W = 2400 * 4 * 9.80665 N/m. Water of density rho up to its crest pushes it with
F = rho g / 2, and moves with it with Westergaard's 7/12 rho kg/m.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe import GroundMotion, flexible, read_case, rigid, run
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from shared.command import command
from shared.dams import plane_case
from shared.report_reader import Reader

G = 9.80665
WEIGHT = 2400.0 * 4.0 * G
STILL = GroundMotion.from_points([0.0, 0.5], [0.0, 0.0])
MODELS = [rigid, flexible]


def block(friction, density, anchor, **more):
    return plane_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["4 m", "0 m"], ["4 m", "1 m"], ["0 m", "1 m"]]},
            "concrete": {"density": "2400 kg/m^3", "modulus": "2000 GPa", "poisson": 0.0},
            "crack": {"friction": friction},
            "reservoir": {"depth": "1 m", "density": f"{density} kg/m^3"},
            "uplift": {"pattern": "none"},
            "anchors": [{"distance": "2 m"} | anchor],
            "analysis": {"silence": "0 s"},
            "flexible": {"elements_across": 2, "evidence": "none", "time_step": "5e-5 s"},
        }
        | more
    )


def codes(response):
    return [warning.name for warning in response.warnings]


@pytest.mark.parametrize("model", MODELS)
def test_a_dowel_holds_what_friction_does_not(model):
    # From rest under F - mu W, against a spring: half a cosine to 2 (F - mu W) / k, where friction holds it from then
    # on, as F is less than three times that.
    push, friction, stiffness = 500.0 * G, 0.03, 4e6
    response = model(block(friction, 1000, {"shear_stiffness": f"{stiffness} N/m/m"}), STILL)
    assert response.outcome == "ok"
    assert response.residual_slip_m == pytest.approx(2.0 * (push - friction * WEIGHT) / stiffness, rel=0.02)
    assert "friction-not-enough anchors" in codes(response)
    assert "slides-by-itself" not in codes(response)


# The upper end leans upstream by 10 degrees: sliding downstream shortens it.
LEANS = {"inclination": "-10 deg", "axial_stiffness": "10 MN/m/m"}
PUSH = 2e4 * G / 2.0


@pytest.mark.parametrize("model", MODELS)
def test_a_stiffness_hides_no_dam_that_does_not_stand(model):
    # 98 kN against 0.5 (94 kN + 99 kN) - 17 kN, with a prestress of 100 kN; sliding takes that away, too.
    case = block(0.5, 20000, LEANS | {"prestress": "100 kN/m"})
    response = model(case, STILL)
    assert response.outcome == "unstable"
    assert "friction-not-enough anchors" not in codes(response)
    lean, tension = math.radians(10.0), 1e5
    factor = 0.5 * (WEIGHT + tension * math.cos(lean)) / (PUSH + tension * math.sin(lean))
    assert factor < 1.0
    assert response.static.sliding_safety_factor == pytest.approx(factor, rel=1e-6)


@pytest.mark.parametrize("model", MODELS)
def test_a_tendon_goes_slack_where_the_slip_has_shortened_it_by_what_it_was_stretched(model):
    # It stands with 200 kN; a push of 1.5 g for 0.3 s moves it, and without the tendon nothing holds it.
    case = block(0.5, 20000, LEANS | {"prestress": "200 kN/m", "capacity": "1 MN/m"})
    push = GroundMotion.from_points([0.0, 0.3, 0.3, 0.8], [-1.5 * G, -1.5 * G, 0.0, 0.0])
    response = model(case, push, output_step=0.001)
    assert response.outcome == "ok"
    (anchor,) = response.anchors
    time, slip = response.histories["time_s"], response.histories["slip_m"]
    shortened = 2e5 / (1e7 * math.sin(math.radians(10.0)))
    assert np.interp(anchor.slack_s, time, slip) == pytest.approx(shortened, rel=0.03)
    assert (anchor.final_tension_n, anchor.yields_s) == (0.0, None)
    # From then on nothing but friction brakes it: (F - mu W) / (m + 7/12 rho).
    late = time > 0.4
    acceleration = np.polyfit(time[late], slip[late], 2)[0] * 2.0
    assert acceleration == pytest.approx((PUSH - 0.5 * WEIGHT) / (WEIGHT / G + 7.0 / 12.0 * 2e4), rel=0.01)
    assert "anchor-fails slack" in codes(response)
    assert response.to_json()["anchors"][0]["slack_s"] == anchor.slack_s


@pytest.mark.parametrize("model", MODELS)
def test_what_slides_beyond_its_crack_is_no_result(model):
    case = block(0.5, 20000, LEANS | {"prestress": "200 kN/m", "capacity": "1 MN/m"})
    # After 3.5 s some 2.4 m/s2 have moved it by three times its width.
    push = GroundMotion.from_points([0.0, 0.3, 0.3, 3.5], [-1.5 * G, -1.5 * G, 0.0, 0.0])
    response = model(case, push)
    assert response.peak_slip_downstream_m > 4.0
    assert (response.outcome, response.ok) == ("lost", False)
    assert "left what it stood on" in str(response.advice).replace("leaves", "left")
    assert "slid-off" in codes(response)


@pytest.mark.parametrize("model", MODELS)
def test_a_tendon_bears_more_than_its_capacity_from_a_known_slip_on(model):
    # The upper end leans downstream by 30 degrees: P + k sin(30) u = capacity.
    anchor = {"inclination": "30 deg", "axial_stiffness": "10 MN/m/m", "prestress": "20 kN/m", "capacity": "50 kN/m"}
    push = GroundMotion.from_points([0.0, 0.3, 0.3, 0.6], [-1.5 * G, -1.5 * G, 0.0, 0.0])
    response = model(block(0.5, 1000, anchor), push, output_step=0.001)
    (borne,) = response.anchors
    slip = np.interp(borne.yields_s, response.histories["time_s"], response.histories["slip_m"])
    assert slip == pytest.approx(30e3 / (1e7 * 0.5), rel=0.05)
    assert borne.slack_s is None
    (warning,) = [warning for warning in response.warnings if warning.name == "anchor-fails overloaded"]
    assert f"{borne.yields_s:.3f} s" in warning.text()


@pytest.mark.slow
def test_the_report_has_the_time_at_which_a_tendon_goes_slack():
    case = block(0.5, 20000, LEANS | {"prestress": "200 kN/m", "capacity": "1 MN/m"})
    push = GroundMotion.from_points([0.0, 0.3, 0.3, 0.8], [-1.5 * G, -1.5 * G, 0.0, 0.0])
    response = rigid(case, push)
    text = Reader(html(build_report(case, response))).text
    assert "slack from, rigid" in text
    assert "above its capacity from" not in text
    assert f"{response.anchors[0].slack_s:.3g}"[:4] in text


OLD_MILL = """
[section]
polygon = [["0 m","0 m"],["32 m","0 m"],["24 m","8 m"],["17.5 m","16 m"],["12.6 m","24 m"],["8.8 m","32 m"],
    ["6.6 m","38 m"],["5.5 m","45 m"],["1.5 m","45 m"],["1.5 m","20 m"]]
[concrete]
density = "2250 kg/m^3"
modulus = "8 GPa"
[crack]
friction = 0.75
[reservoir]
depth = "42 m"
[tailwater]
depth = "3 m"
[ice]
force = "150 kN/m"
depth = "0.4 m"
[[anchors]]
head_x = "3 m"
head_elevation = "45 m"
foot_x = "4 m"
foot_elevation = "-15 m"
prestress = "1 MN/m"
axial_stiffness = "30 MN/m/m"
capacity = "1.6 MN/m"
[uplift]
pattern = "drained"
drain_x = "4 m"
drain_efficiency = 0.3
[motion]
points = [["0 s", "0 g"], ["0.3 s", "0.1 g"], ["0.5 s", "0 g"]]
[flexible]
elements_across = 2
evidence = "none"
"""


def test_an_old_dam_with_a_tendon_is_as_unstable_with_its_stiffness_as_without(tmp_path):
    """Its factor of 0.81 is that of an independent program."""
    for text in (OLD_MILL, OLD_MILL.replace('axial_stiffness = "30 MN/m/m"\n', "")):
        (tmp_path / "mill.toml").write_text(text)
        response = run(read_case(tmp_path / "mill.toml"))
        assert [part.outcome for part in response.responses] == ["unstable"] * 2
        assert response.static.sliding_safety_factor == pytest.approx(0.81, abs=0.005)
        assert command("run", "mill.toml", cwd=tmp_path).returncode == 3
