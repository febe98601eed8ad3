"""Static checks of cracks that are not straight, against arithmetic by hand; limits stand in test_kinks_limits.py.

The block: 8 m wide and 3 m high above the straight line from heel to toe, vertical faces, concrete of 2400 kg/m^3, one
g of 10 m/s^2, 2.5 m of water above the heel. Forces in kN per metre.

    water     P = 10 x 2.5^2 / 2 = 31.25 at 2.5/3 above the heel
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import heeltoe
from heeltoe import read_case
from heeltoe.mechanics.loads import static_forces
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.statics.contact import Settled
from heeltoe.models.statics.pieces import borne, pieces_between
from shared.statics import CLOSE, only

K = 1e3
TEETH = [[f"{place} m", f"{0.5 * (place % 2)} m"] for place in range(1, 8)]
ROOF = [["2 m", "0 m"], ["4 m", "0.5 m"], ["6 m", "0 m"]]


def block(kinks, friction=0.5, **changes):
    """Return the block of the head of this file with some kinks."""
    fields = {
        "gravity": "10 m/s^2",
        "section": {"polygon": [["0 m", "0 m"], ["8 m", "0 m"], ["8 m", "6 m"], ["0 m", "6 m"]]},
        "crack": {"elevation": "3 m", "friction": friction, "kinks": kinks},
        "reservoir": {"depth": "5.5 m"},
        "uplift": {"pattern": "none"},
    }
    return read_case(fields | changes)


def pressed_at(place):
    """Return a contact whose normal force is 1 N/m at a distance from the heel."""
    return Settled("stands", 0.0, 0.0, 1.0, place, 0.0, 0.0, np.zeros((0, 2)), 0)


def test_a_block_on_teeth():
    result = heeltoe.statics(block(TEETH))
    outcome = only(result, "usual")
    # Four teeth of 2 m x 0.5 m stick up into it: W = 24 x (24 - 4 x 0.5) = 528
    assert outcome.normal_force_n == pytest.approx(528.0 * K, **CLOSE)
    assert outcome.shear_force_n == pytest.approx(31.25 * K, **CLOSE)
    # 0.5 x 528 / 31.25; on the teeth tan(phi + i) = (0.5 + 0.5) / (1 - 0.5 x 0.5) = 4/3 in the place of 0.5
    assert outcome.sliding_factor == pytest.approx(8.448, **CLOSE)
    assert outcome.sliding_factor_on_pieces == pytest.approx(528.0 * 4.0 / 3.0 / 31.25, **CLOSE)
    assert (outcome.pieces_bear, math.tan(outcome.steepest_rise_rad)) == ("more", pytest.approx(0.5))
    # It is symmetric: W in the middle, P x 2.5/3 turns it downstream.
    assert outcome.resultant_from_heel_m == pytest.approx(4.0 + 31.25 * 2.5 / 3.0 / 528.0, **CLOSE)
    warning = next(notice for notice in result.warnings if notice.name == "kinks-beside-line add")
    for words in ("a factor of 8.448", "up to 26.6 degrees", "22.528"):
        assert words in warning.text()


def test_uplift_is_normal_to_every_piece():
    """25 kPa at the heel, none at the toe; the roof rises by 0.5 m from 2 m to 4 m and falls to 6 m."""
    result = only(heeltoe.statics(block(ROOF, uplift={"pattern": "triangular"})), "usual")
    uplift = next(force for force in result.forces if force.name == "uplift")
    # Across as without the roof; along it the mean pressure is 15.625 on what rises and 9.375 on what falls.
    assert uplift.vertical == pytest.approx(100.0 * K, **CLOSE)
    assert uplift.horizontal == pytest.approx(-0.5 * (15.625 - 9.375) * K, **CLOSE)
    # Triangle: 100 x 8/3; roof: the integral of p h dh, 0.5^2/6 x (18.75 - 6.25)
    assert uplift.moment == pytest.approx((100.0 * 8.0 / 3.0 + 0.25 / 6.0 * 12.5) * K, **CLOSE)
    line = next(line for line in result.sheet().lines if line.name == "uplift")
    # The integral of p h dh is - z H; the rest is x V.
    assert line.height_m == pytest.approx(0.25 / 6.0 * 12.5 / 3.125, **CLOSE)
    assert line.distance_m == pytest.approx(8.0 / 3.0, **CLOSE)
    # Sums of the sheet are what the checks have.
    assert result.sheet().sum.moment_nm == pytest.approx(-result.normal_force_n * result.resultant_from_heel_m, **CLOSE)


def test_uplift_on_an_inclined_line_turns_with_it():
    """A crack that rises at 30 degrees, all of it under 25 kPa: the level one, turned."""
    angle = math.radians(30.0)
    top = [["8 m", "40 m"], ["0 m", "40 m"]]
    case = block(
        [["2 m", "0 m"], ["4 m", "0.5 m"]],
        section={"polygon": [["0 m", "0 m"], ["8 m", "0 m"], *top]},
        crack={
            "elevation": "3 m",
            "inclination": "30 deg",
            "friction": 1.0,
            "kinks": [["2 m", "0 m"], ["4 m", "0.5 m"]],
        },
        uplift={"pattern": "uniform"},
    )
    width = 8.0 / math.cos(angle)
    uplift = next(force for force in static_forces(case) if force.name == "uplift")
    assert uplift.horizontal == pytest.approx(-25.0 * width * math.sin(angle) * K, **CLOSE)
    assert uplift.vertical == pytest.approx(25.0 * width * math.cos(angle) * K, **CLOSE)
    # The integral of p h dh vanishes under one pressure.
    assert uplift.moment == pytest.approx(25.0 * width**2 / 2.0 * K, **CLOSE)
    # Upward forces alone: 25 x dx at x, whatever is between.
    assert uplift.lift_moment == pytest.approx(25.0 * 8.0**2 / 2.0 * K, **CLOSE)


def test_a_roof_bears_by_its_rising_flank():
    """One step, from 2 m to 4 m, holds more the nearer the resultant is to it: by the moments of two forces."""
    case = block(ROOF)
    pieces = pieces_between(case, 0.0, 8.0)
    # tan(phi + i) = (0.5 + 0.25) / (1 - 0.5 x 0.25) = 6/7 on what rises, at 2 m and at 4 m, 0.5 m up: its moments about
    # the heel are those of 2 m and of 4 + 0.5 x 6/7 = 31/7 m; the level rest has 0.5.
    rise = 6.0 / 7.0
    for place, held in ((2.0, rise), (3.0, rise), (31.0 / 7.0, rise), (1.0, (0.5 + rise) / 2.0), (8.0, 0.5)):
        assert borne(pieces, 0.5, pressed_at(place), 1.0) == pytest.approx(held, rel=1e-9)
    # Halfway from there to the toe both bear half.
    assert borne(pieces, 0.5, pressed_at((31.0 / 7.0 + 8.0) / 2.0), 1.0) == pytest.approx((rise + 0.5) / 2.0, rel=1e-9)
    # Outside the crack nothing is borne.
    assert borne(pieces, 0.5, pressed_at(8.5), 1.0) is None


def test_where_the_crack_falls_the_smaller_factor_counts():
    """1 m up within the first metre, and down again over 7 m: pushed near the toe it slides down."""
    kinks = [["1 m", "1 m"]]
    pieces = pieces_between(block(kinks), 0.0, 8.0)
    # tan(phi - j) at the toe: (0.5 - 1/7) / (1 + 0.5/7); at 1 m, 1 m up, tan(phi + 45 deg) = 3 and a moment of 4.
    falls = (0.5 - 1.0 / 7.0) / (1.0 + 0.5 / 7.0)
    assert borne(pieces, 0.5, pressed_at(7.9), 1.0) == pytest.approx(falls + (3.0 - falls) * 0.1 / 4.0, rel=1e-9)
    # Silt brings the resultant there.
    high = [["0 m", "0 m"], ["8 m", "0 m"], ["8 m", "30 m"], ["0 m", "30 m"]]
    silt = {"depth": "29 m", "horizontal_density": "660 kg/m^3", "vertical_density": "660 kg/m^3"}
    bond = {"bonded": 1.0, "tensile_strength": "5 MPa"}
    result = heeltoe.statics(block(kinks, section={"polygon": high}, silt=silt, statics=bond))
    outcome = only(result, "usual")
    assert outcome.pieces_bear == "less"
    along = 0.5 * outcome.normal_force_n / outcome.shear_force_n
    assert outcome.sliding_factor == outcome.sliding_factor_on_pieces < along
    at = pressed_at(outcome.resultant_from_heel_m)
    held = borne(pieces, 0.5, at, 1.0)
    assert outcome.sliding_factor == pytest.approx(held * outcome.normal_force_n / outcome.shear_force_n, rel=1e-9)
    assert "kinks-beside-line take" in {notice.name for notice in result.warnings}


def test_steep_steps_bear_any_push():
    # tan i = 1 and friction 1.5: phi + i is beyond a right angle.
    kinks = [[f"{place} m", f"{place % 2} m"] for place in range(1, 8)]
    result = heeltoe.statics(block(kinks, 1.5))
    outcome = only(result, "usual")
    assert (outcome.pieces_bear, outcome.sliding_factor_on_pieces) == ("any push", None)
    assert outcome.sliding_factor == pytest.approx(1.5 * outcome.normal_force_n / outcome.shear_force_n)
    assert any("any push until something shears off" in str(notice) for notice in result.warnings)


def test_after_a_slip_the_kinks_count_for_nothing():
    result = only(heeltoe.statics(block(TEETH), 0.1), "post-seismic")
    assert (result.pieces_bear, result.sliding_factor_on_pieces) == ("", None)
    assert any("no longer match" in str(assumption) for assumption in result.assumptions)
    assert only(heeltoe.statics(block(TEETH), 0.0), "post-seismic").pieces_bear == "more"


def test_the_loads_are_those_of_the_elastic_dam():
    case = block(ROOF, uplift={"pattern": "triangular"}, concrete={"modulus": "20 GPa"}).with_(
        "crack.inclination=10 deg", "flexible.elements_across=8"
    )
    loads = build_flexible_dam(case).bodies[0].loads
    for force in static_forces(case):
        along, up = loads[force.name][::2].sum(), loads[force.name][1::2].sum()
        assert (along, up) == pytest.approx((force.horizontal, force.vertical), rel=1e-9, abs=1e-3)
