"""The static checks of a triangular dam against arithmetic by hand; limits stand in test_static_limits.py.

The dam: base 80 m, height 100 m, vertical upstream face, concrete of 2400 kg/m^3, water of 1000 kg/m^3, one g of
10 m/s^2. Forces in MN, lengths in m, stresses in MPa, per metre of dam.

    weight                W = 0.024 x 80 x 100 / 2 = 96 at 80/3 from the heel
    90 m of water         P = 0.01 x 90^2 / 2 = 40.5 at 30 above the heel
    uplift, triangular    U = 0.9 x 80 / 2 = 36 at 80/3 from the heel
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import heeltoe
from heeltoe import InputError
from shared.statics import CLOSE, SHAKEN, M, dam, only

# Hand calculations


def test_usual_loads():
    result = only(heeltoe.statics(dam()), "usual")
    assert result.outcome == "stands"
    # N = W - U = 96 - 36, T = P
    assert result.normal_force_n == pytest.approx(60.0 * M, **CLOSE)
    assert result.shear_force_n == pytest.approx(40.5 * M, **CLOSE)
    # 0.9 x 60 / 40.5
    assert result.sliding_factor == pytest.approx(54.0 / 40.5, **CLOSE)
    # About the toe: W x 160/3 = 5120 against P x 30 + U x 160/3 = 1215 + 1920
    assert result.overturning_about == "toe"
    assert result.overturning_factor == pytest.approx(5120.0 / 3135.0, **CLOSE)
    assert result.flotation_factor == pytest.approx(96.0 / 36.0, **CLOSE)
    # Moments about the heel: (96 - 36) x 80/3 + 40.5 x 30 = 1600 + 1215 = 2815; over N = 60
    assert result.resultant_from_heel_m == pytest.approx(2815.0 / 60.0, **CLOSE)
    assert result.eccentricity_m == pytest.approx(2815.0 / 60.0 - 40.0, **CLOSE)
    assert result.resultant_zone == "middle third"
    # N/B (1 -+ 6 e/B) with e = 6.91667: 0.75 x (1 -+ 0.51875)
    assert result.heel_stress_pa == pytest.approx(0.75 * (1.0 - 0.51875) * M, **CLOSE)
    assert result.toe_stress_pa == pytest.approx(0.75 * (1.0 + 0.51875) * M, **CLOSE)
    assert (result.cracked_length_m, result.compressed_length_m, result.iterations) == (0.0, 80.0, 0)


def test_forces_one_by_one():
    forces = {force.name: force for force in only(heeltoe.statics(dam()), "usual").forces}
    assert forces["weight"].vertical == pytest.approx(-96.0 * M)
    assert forces["weight"].moment == pytest.approx(-96.0 * 80.0 / 3.0 * M)
    assert forces["reservoir"].horizontal == pytest.approx(40.5 * M)
    assert forces["reservoir"].moment == pytest.approx(-40.5 * 30.0 * M)
    assert forces["uplift"].vertical == pytest.approx(36.0 * M)
    assert forces["uplift"].moment == pytest.approx(36.0 * 80.0 / 3.0 * M)


def test_cohesion_counts_where_the_crack_is_bonded():
    # The half from the toe is bonded with 0.5 MPa: 0.5 x 40 = 20; (20 + 54) / 40.5
    result = heeltoe.statics(dam(statics={"bonded": 0.5, "cohesion": "0.5 MPa"}))
    outcome = only(result, "usual")
    assert outcome.cohesive_force_n == pytest.approx(20.0 * M, **CLOSE)
    assert outcome.sliding_factor == pytest.approx(74.0 / 40.5, **CLOSE)
    after = only(heeltoe.statics(dam(statics={"bonded": 0.5, "cohesion": "0.5 MPa"}), 0.0), "post-seismic")
    assert after.cohesive_force_n == 0.0
    assert after.sliding_factor == pytest.approx(54.0 / 40.5, **CLOSE)


def test_cracked_length_with_uplift_in_the_crack():
    """A full reservoir cracks the dam. With the full pressure p = 1 in the crack and a straight line from its tip to
    the toe, moments about the toe give the length L that is left: the normal force

        N = W - p (B - L) - p L / 2   acts at L/3 from the toe:
        M - p (B^2 - L^2)/2 - p L^2/3 = N L / 3,    M = W x 160/3 - P x 100/3 = 5120 - 50 x 100/3

    in which L^2 cancels: L = 3 (M - p B^2/2) / (W - p B) = 3 x (3453.3333 - 3200) / 16 = 47.5.
    """
    result = only(heeltoe.statics(dam("100 m")), "usual")
    assert result.outcome == "stands"
    assert result.cracked_from == "heel"
    assert result.cracked_length_m == pytest.approx(80.0 - 47.5, **CLOSE)
    assert result.compressed_length_m == pytest.approx(47.5, **CLOSE)
    # N = 96 - 32.5 - 23.75 = 39.75, stress at the toe 2 N / L
    assert result.normal_force_n == pytest.approx(39.75 * M, **CLOSE)
    assert result.heel_stress_pa == pytest.approx(0.0, abs=1e-6 * M)
    assert result.toe_stress_pa == pytest.approx(2.0 * 39.75 / 47.5 * M, **CLOSE)
    assert result.resultant_from_heel_m == pytest.approx(80.0 - 47.5 / 3.0, **CLOSE)
    assert result.sliding_factor == pytest.approx(0.9 * 39.75 / 50.0, **CLOSE)
    # Uplift about the toe: 32.5 x (47.5 + 16.25) + 23.75 x 2/3 x 47.5
    uplift = 32.5 * 63.75 + 23.75 * 2.0 / 3.0 * 47.5
    assert result.overturning_factor == pytest.approx(5120.0 / (5000.0 / 3.0 + uplift), **CLOSE)
    assert result.flotation_factor == pytest.approx(96.0 / 56.25, **CLOSE)
    assert 0 < result.iterations < 30


def test_cracked_length_with_tensile_strength():
    """Bonded with f = 0.1: the stress at the tip, 6 M_toe/L^2 - 2 N/L, is -f; the last equation becomes
    f L^2/6 - (W - p B) L/3 + M - p B^2/2 = 0: L = (16/3 - sqrt(256/9 - 4 x 0.1/6 x 253.3333)) / (0.1/3)."""
    strong = {"bonded": 1.0, "tensile_strength": "0.1 MPa", "cohesion": "1 MPa"}
    result = only(heeltoe.statics(dam("100 m", statics=strong)), "usual")
    left = (16.0 / 3.0 - math.sqrt(256.0 / 9.0 - 4.0 * 0.1 / 6.0 * 760.0 / 3.0)) / (0.1 / 3.0)
    assert result.cracked_length_m == pytest.approx(80.0 - left, **CLOSE)
    assert result.heel_stress_pa == pytest.approx(-0.1 * M, **CLOSE)
    # N = 96 - (80 - L) - L/2; the toe has 2 N/L + 0.1; the stress passes zero at 0.1 / (toe + 0.1) of L from the tip
    normal = 96.0 - (80.0 - left) - left / 2.0
    toe = 2.0 * normal / left + 0.1
    assert result.toe_stress_pa == pytest.approx(toe * M, **CLOSE)
    pressed = left * toe / (toe + 0.1)
    assert result.compressed_length_m == pytest.approx(pressed, **CLOSE)
    assert result.cohesive_force_n == pytest.approx(1.0 * pressed * M, **CLOSE)
    assert result.sliding_factor == pytest.approx((pressed + 0.9 * normal) / 50.0, **CLOSE)
    # Enough strength for the 0.1625 MPa of the dam that is whole: nothing opens.
    strong |= {"tensile_strength": "0.2 MPa"}
    whole = only(heeltoe.statics(dam("100 m", statics=strong)), "usual")
    # N = 56; moment about the heel 56 x 80/3 + 50 x 100/3 = 3160; e = 16.428571
    assert whole.cracked_length_m == 0.0
    assert whole.heel_stress_pa == pytest.approx(0.7 * (1.0 - 6.0 * (3160.0 / 56.0 - 40.0) / 80.0) * M, **CLOSE)


def test_a_crack_stops_where_the_bond_begins():
    # Bonded from 80 x 0.3 = 24 on, where the crack of 32.5 would come to: strong enough, it stops there.
    result = only(heeltoe.statics(dam("100 m", statics={"bonded": 0.7, "tensile_strength": "1 MPa"})), "usual")
    assert result.cracked_length_m == pytest.approx(24.0, **CLOSE)
    # N = 96 - 24 - 28 = 44, about the toe 3453.3333 - 24 x 68 - 28 x 2/3 x 56 = 776; tip 6 x 776/56^2 - 2 x 44/56
    about_toe = 10360.0 / 3.0 - 24.0 * 68.0 - 28.0 * 2.0 / 3.0 * 56.0
    assert result.heel_stress_pa == pytest.approx((6.0 * about_toe / 56.0**2 - 88.0 / 56.0) * M, **CLOSE)
    assert result.heel_stress_pa < 0.0


def test_flood():
    choice = {"flood_depth": "95 m", "flood_tailwater": "8 m"}
    result = only(heeltoe.statics(dam(statics=choice, ice={"force": "150 kN/m"})), "flood")
    # The tailwater, 8 m on a face of 0.8 : 1: 0.32 upstream, 0.32 x 0.8 = 0.256 down; the ice is gone.
    # P = 0.01 x 95^2/2 = 45.125; U = (0.95 + 0.08)/2 x 80 = 41.2
    normal = 96.0 + 0.256 - 41.2
    assert result.normal_force_n == pytest.approx(normal * M, **CLOSE)
    assert result.shear_force_n == pytest.approx((45.125 - 0.32) * M, **CLOSE)
    assert result.sliding_factor == pytest.approx(0.9 * normal / 44.805, **CLOSE)
    # About the heel: W 2560; P x 95/3; tailwater -0.32 x 8/3 and 0.256 x (80 - 0.8 x 8/3);
    # uplift 0.08 x 80 at 40 and 0.87 x 40 at 80/3
    moment = 2560.0 + 45.125 * 95.0 / 3.0 - 0.32 * 8.0 / 3.0 + 0.256 * (80.0 - 6.4 / 3.0) - 256.0 - 34.8 * 80.0 / 3.0
    assert result.resultant_from_heel_m == pytest.approx(moment / normal, **CLOSE)
    eccentricity = moment / normal - 40.0
    assert result.heel_stress_pa == pytest.approx(normal / 80.0 * (1.0 - 6.0 * eccentricity / 80.0) * M, **CLOSE)
    assert result.toe_stress_pa == pytest.approx(normal / 80.0 * (1.0 + 6.0 * eccentricity / 80.0) * M, **CLOSE)
    # About the toe the tailwater stabilises: 0.32 x 8/3 + 0.256 x 6.4/3
    stabilising = 5120.0 + 0.32 * 8.0 / 3.0 + 0.256 * 6.4 / 3.0
    overturning = 45.125 * 95.0 / 3.0 + 256.0 + 34.8 * 160.0 / 3.0
    assert result.overturning_factor == pytest.approx(stabilising / overturning, **CLOSE)
    assert result.flotation_factor == pytest.approx(96.256 / 41.2, **CLOSE)


# The seismic coefficient: inertia 0.1 x 96 = 9.6 at 100/3; Westergaard 7/12 x 0.01 x 90^2 x 0.1 = 4.725 at 0.4 x 90;
# upward 0.05 x 96 = 4.8 at 80/3 from the heel.


def test_pseudo_static_downstream():
    result = only(heeltoe.statics(dam(statics=SHAKEN)), "pseudo-static downstream, lifting")
    assert result.normal_force_n == pytest.approx((60.0 - 4.8) * M, **CLOSE)
    assert result.shear_force_n == pytest.approx((40.5 + 9.6 + 4.725) * M, **CLOSE)
    assert result.sliding_factor == pytest.approx(0.9 * 55.2 / 54.825, **CLOSE)
    # About the heel: 2815 + 9.6 x 100/3 + 4.725 x 36 - 4.8 x 80/3 = 2815 + 320 + 170.1 - 128
    assert result.resultant_from_heel_m == pytest.approx(3177.1 / 55.2, **CLOSE)
    # Beyond the middle third: it opens, the uplift unchanged, to three times the distance from the toe.
    left = 3.0 * (80.0 - 3177.1 / 55.2)
    assert result.cracked_length_m == pytest.approx(80.0 - left, **CLOSE)
    assert result.toe_stress_pa == pytest.approx(2.0 * 55.2 / left * M, **CLOSE)
    # About the toe: W 5120 against P 1215, U 1920, hydrodynamic 170.1, and inertia as a whole 320 + 4.8 x 160/3
    assert result.overturning_factor == pytest.approx(5120.0 / (1215.0 + 1920.0 + 170.1 + 320.0 + 256.0), **CLOSE)


def test_pseudo_static_upstream():
    result = only(heeltoe.statics(dam(statics=SHAKEN)), "pseudo-static upstream, lifting")
    assert result.shear_force_n == pytest.approx((40.5 - 9.6 - 4.725) * M, **CLOSE)
    assert result.sliding_factor == pytest.approx(0.9 * 55.2 / 26.175, **CLOSE)
    # 2815 - 320 - 170.1 - 128
    assert result.resultant_from_heel_m == pytest.approx(2196.9 / 55.2, **CLOSE)


def test_pseudo_static_without_water_pushes_both_ways_alike():
    result = heeltoe.statics(dam(reservoir=None, statics={"seismic_coefficient": 0.1}))
    down, up = only(result, "pseudo-static downstream"), only(result, "pseudo-static upstream")
    assert down.sliding_factor == up.sliding_factor == pytest.approx(9.0, **CLOSE)
    # About the heel, W x 80/3 = 2560 against inertia 320; about the toe 5120 against 320
    assert (up.overturning_about, up.overturning_factor) == ("heel", pytest.approx(8.0, **CLOSE))
    assert (down.overturning_about, down.overturning_factor) == ("toe", pytest.approx(16.0, **CLOSE))
    # (2560 - 320) / 96 = 23.3333 from the heel, beyond the middle third: the toe opens to 3 x 23.3333.
    assert up.cracked_from == "toe"
    assert up.cracked_length_m == pytest.approx(10.0, **CLOSE)
    assert up.heel_stress_pa == pytest.approx(2.0 * 96.0 / 70.0 * M, **CLOSE)


def test_usbr_takes_the_uplift_from_the_crack_of_the_earthquake():
    """On the length L left the uplift is p L/B at its tip: L/B x L/2 = p L^2/(2 B) at 2 L/3 from the toe. With
    W' = 96 - 4.8 = 91.2 and M' = 91.2 x 160/3 - 1215 - 320 - 170.1 = 3158.9 about the toe,
    M' - p L^3/(3 B) = (W' - p L^2/(2 B)) L/3: p L^3/(6 B) + W' L/3 - M' = 0, p = 0.9."""
    result = heeltoe.statics(dam(statics=SHAKEN | {"criteria": "USBR"}))
    outcome = only(result, "pseudo-static downstream, lifting")
    roots = np.roots([0.9 / 480.0, 0.0, 91.2 / 3.0, -3158.9])
    left = float(roots[np.argmin(abs(roots.imag))].real)
    assert outcome.cracked_length_m == pytest.approx(80.0 - left, **CLOSE)
    assert outcome.normal_force_n == pytest.approx((91.2 - 0.9 * left**2 / 160.0) * M, **CLOSE)
    assert "zero where the earthquake opens" in str(outcome.assumptions[0])


def test_the_earthquake_starts_from_the_crack_of_the_usual_loads():
    # Nearly no shaking: the crack of 32.5 with its water stays, though the bond would have held it now.
    result = heeltoe.statics(dam("100 m", statics={"seismic_coefficient": 1e-9}))
    assert only(result, "pseudo-static downstream").cracked_length_m == pytest.approx(32.5, **CLOSE)


AFTER = {"residual_friction": 0.8, "residual_slip": "2 m"}


def test_post_seismic():
    # The toe overhangs by 2: U = 0.9 x 78/2 = 35.1 at 26; N = 60.9
    result = heeltoe.statics(dam(statics=AFTER))
    outcome = only(result, "post-seismic")
    assert (result.slip_m, result.slip_source) == (2.0, "statics.residual_slip")
    assert (outcome.contact_from_m, outcome.contact_to_m) == (0.0, 78.0)
    assert outcome.normal_force_n == pytest.approx(60.9 * M, **CLOSE)
    assert outcome.sliding_factor == pytest.approx(0.8 * 60.9 / 40.5, **CLOSE)
    # About the heel: 2560 + 1215 - 35.1 x 26 = 2862.4
    position = 2862.4 / 60.9
    assert outcome.resultant_from_heel_m == pytest.approx(position, **CLOSE)
    assert outcome.heel_stress_pa == pytest.approx(60.9 / 78.0 * (1.0 - 6.0 * (position - 39.0) / 78.0) * M, **CLOSE)
    # About the new toe: 96 x (78 - 80/3) against 1215 + 35.1 x 52
    assert outcome.overturning_factor == pytest.approx(96.0 * (78.0 - 80.0 / 3.0) / (1215.0 + 35.1 * 52.0), **CLOSE)


def test_post_seismic_upstream():
    # The heel overhangs by 2, over full pressure: 1.8 at 1, and 35.1 at 2 + 26; N = 59.1
    result = only(heeltoe.statics(dam(statics={"residual_friction": 0.8}), -2.0), "post-seismic")
    assert (result.contact_from_m, result.contact_to_m) == (2.0, 80.0)
    assert result.normal_force_n == pytest.approx(59.1 * M, **CLOSE)
    position = (2560.0 + 1215.0 - 1.8 * 1.0 - 35.1 * 28.0) / 59.1
    assert result.resultant_from_heel_m == pytest.approx(position, **CLOSE)
    assert result.eccentricity_m == pytest.approx(position - 41.0, **CLOSE)


def test_slip_closes_drains():
    drained = {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 2.0 / 3.0}
    case = dam(uplift=drained, statics={"drain_diameter": "75 mm"})
    result = heeltoe.statics(case, 0.03)
    # Before: 0.9 to 0.3 over 8, to 0 over 72: 4.8 + 10.8
    assert only(result, "usual").normal_force_n == pytest.approx((96.0 - 15.6) * M, **CLOSE)
    # 30 of 75 mm leave 0.6 of the efficiency, 0.4: 0.9 to 0.54 at 7.997, to 0 at 79.97
    uplift = (0.9 + 0.54) / 2.0 * 7.997 + 0.54 / 2.0 * 71.973
    assert only(result, "post-seismic").normal_force_n == pytest.approx((96.0 - uplift) * M, **CLOSE)
    # From a diameter on the reservoir's pressure reaches them: 0.9 over 7.992, to 0 over 71.928
    closed = only(heeltoe.statics(case, 0.08), "post-seismic")
    assert closed.normal_force_n == pytest.approx((96.0 - 0.9 * 7.992 - 0.45 * 71.928) * M, **CLOSE)
    # Without a diameter they stay as they are.
    kept = only(heeltoe.statics(dam(uplift=drained), 0.03), "post-seismic")
    assert kept.normal_force_n == pytest.approx((96.0 - 15.6 * 79.97 / 80.0) * M, **CLOSE)
    assert any("drains as before" in text for text in map(str, kept.assumptions))


def test_drains_that_are_closed_leave_the_uplift_linear_where_that_is_chosen():
    drained = {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 2.0 / 3.0}
    case = dam(uplift=drained, statics={"drain_diameter": "75 mm", "closed_drains": "linear"})
    after = only(heeltoe.statics(case, 0.08), "post-seismic")
    # Linear from 0.9 MPa at the heel to zero at 79.92 m, as `triangular` has it.
    assert after.normal_force_n == pytest.approx((96.0 - 0.45 * 79.92) * M, **CLOSE)
    triangular = only(heeltoe.statics(dam(uplift={"pattern": "triangular"}), 0.08), "post-seismic")
    assert after.sliding_factor == pytest.approx(triangular.sliding_factor, **CLOSE)
    assert any("linear from heel to toe" in text for text in map(str, after.assumptions))
    # 30 of 75 mm: the head at the drains is 0.6 of 0.3 and 0.4 of 0.81 MPa.
    half = only(heeltoe.statics(case, 0.03), "post-seismic")
    uplift = (0.9 + 0.504) / 2.0 * 7.997 + 0.504 / 2.0 * 71.973
    assert half.normal_force_n == pytest.approx((96.0 - uplift) * M, **CLOSE)
    with pytest.raises(InputError, match=r"statics\.closed_drains: .*drain_diameter"):
        dam(uplift=drained, statics={"closed_drains": "linear"})


def test_a_crack_beyond_the_drains_drains_no_more():
    drained = {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.05}
    # Short of these weak drains it opens further; from them on it is the crack without drains.
    result = only(heeltoe.statics(dam("100 m", uplift=drained)), "usual")
    assert result.cracked_length_m == pytest.approx(32.5, **CLOSE)


def test_drains_stop_a_crack_that_would_go_through_without_them():
    """Base 73, W = 87.6 at 73/3: without drains there is no length left. Drains at 21.9 that leave 0.2 keep the crack,
    of length c, short of them: pressure 1 to c, straight to 0.2 at 21.9, straight to 0 at 73."""
    slim = {"polygon": [["0 m", "0 m"], ["73 m", "0 m"], ["0 m", "100 m"]]}
    assert only(heeltoe.statics(dam("100 m", section=slim)), "usual").outcome == "cracks through"
    drained = {"pattern": "drained", "drain_position": 0.3, "drain_efficiency": 0.8}
    result = only(heeltoe.statics(dam("100 m", section=slim, uplift=drained)), "usual")
    crack = result.cracked_length_m
    assert result.outcome == "stands"
    assert 0.0 < crack < 21.9
    # Four rectangles and triangles of uplift, each with its distance from the toe.
    way = 21.9 - crack
    parts = [
        (1.0 * crack, 73.0 - crack / 2.0),
        (0.2 * way, 51.1 + way / 2.0),
        (0.8 * way / 2.0, 51.1 + 2.0 / 3.0 * way),
        (0.2 * 51.1 / 2.0, 2.0 / 3.0 * 51.1),
    ]
    normal = 87.6 - sum(force for force, _ in parts)
    about_toe = 87.6 * 146.0 / 3.0 - 50.0 * 100.0 / 3.0 - sum(force * distance for force, distance in parts)
    assert result.normal_force_n == pytest.approx(normal * M, **CLOSE)
    # No tension at the tip: the resultant is a third of what is left from the toe.
    assert about_toe / normal == pytest.approx((73.0 - crack) / 3.0, **CLOSE)
