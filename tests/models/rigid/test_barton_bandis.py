"""Barton and Choubey's law at points of its curve, and what is printed of it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe.kernel.friction import friction_law, shear_stress


# Barton and Choubey (1977): phi_r + JRC log10(JCS / s), curves of JRC 20, 10 and 5 for a residual angle of 30 degrees.
@pytest.mark.parametrize(
    ("jrc", "ratio", "angle"),
    [(20.0, 100.0, 70.0), (20.0, 10.0, 50.0), (10.0, 100.0, 50.0), (10.0, 10.0, 40.0), (5.0, 100.0, 40.0)],
)
def test_barton_bandis_at_points_of_its_curves(jrc, ratio, angle):
    numbers = {"roughness": jrc, "wall_strength": 1e8, "residual_angle": math.radians(30.0)}
    stress = 1e8 / ratio
    strength = shear_stress(friction_law("barton-bandis", numbers), stress)[1]
    assert strength / stress == pytest.approx(math.tan(math.radians(angle)), rel=1e-12)
    assert shear_stress(friction_law("barton-bandis", numbers), 2e8)[1] == pytest.approx(
        2e8 * math.tan(math.radians(30.0))
    )


# E. Hoek, Practical Rock Engineering, chapter "Shear strength of discontinuities": Barton's law for a joint, JRC 16.9,
# JCS 96 MPa and 29 degrees: normal stress, shear strength [MPa], slope of the curve. Not compared with the print.
HOEK = [
    (0.360, 0.989, 1.652),
    (0.720, 1.538, 1.423),
    (1.440, 2.476, 1.213),
    (2.880, 4.073, 1.030),
    (5.759, 6.779, 0.872),
    (11.518, 11.344, 0.733),
    (23.036, 18.973, 0.609),
    (46.073, 31.533, 0.496),
]


@pytest.mark.parametrize(("stress", "strength", "slope"), HOEK)
def test_barton_bandis_gives_a_published_table(stress, strength, slope):
    numbers = {"roughness": 16.9, "wall_strength": 96.0, "residual_angle": math.radians(29.0)}
    law = friction_law("barton-bandis", numbers)
    assert shear_stress(law, stress)[1] == pytest.approx(strength, abs=0.0011)
    # At 0.36 MPa the angle is 70 degrees, and held there below: the slope is that to the right.
    right = shear_stress(law, np.array([stress + 1e-3, stress + 2e-3]))[1]
    assert (right[1] - right[0]) / 1e-3 == pytest.approx(slope, abs=0.002 + 0.003 / stress)


# M. Garnier Villarreal, GMisc 0.3.1, the example of Barton_Choubey in its manual (github.com/maxgav13/GMisc), as it is
# printed: JRC 10, JCS 30 MPa and 26 degrees; normal stress, shear strength [MPa].
GMISC = [
    (0.01, 0.018),
    (0.02, 0.032),
    (0.03, 0.044),
    (0.04, 0.057),
    (0.05, 0.068),
    (0.06, 0.080),
    (0.07, 0.091),
    (0.08, 0.101),
    (0.09, 0.112),
    (0.1, 0.122),
    (0.744, 0.671),
]


@pytest.mark.parametrize(("stress", "strength"), GMISC)
def test_barton_bandis_gives_what_another_program_prints(stress, strength):
    law = friction_law(
        "barton-bandis", {"roughness": 10.0, "wall_strength": 30.0, "residual_angle": math.radians(26.0)}
    )
    assert shear_stress(law, stress)[1] == pytest.approx(strength, abs=5.1e-4)
