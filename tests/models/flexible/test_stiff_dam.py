"""How close a stiff elastic dam comes to the rigid one, and what keeps it away: steady sliding may be unstable."""

import numpy as np
import pytest
import scipy.linalg

from heeltoe import GroundMotion, flexible, rigid
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.dams import TYPICAL, plane_case, polygon

G = 9.80665
DAM = [(0.0, 0.0), (24.0, 0.0), (8.0, 20.0), (6.0, 30.0), (0.0, 30.0)]


def stiff(modulus=2000.0, friction=0.5, depth=24.0, damping=0.05, across=3, corners=DAM, **options):
    return plane_case(
        {
            "section": polygon(corners),
            "concrete": {"modulus": f"{modulus} GPa", "damping": damping},
            "crack": {"friction": friction},
            "reservoir": {"depth": f"{depth} m"},
            "flexible": {"elements_across": across, "evidence": "none", **options},
            "analysis": {"silence": "0 s"},
        }
    )


def three_sines(strength=0.5):
    time = np.linspace(0.0, 3.0, 601)
    result = sum(np.sin(2.0 * np.pi * time / period + k) for k, period in enumerate((0.5, 0.37, 0.21)))
    result *= strength * G / 2.0 * np.sin(np.pi * time / 3.0) ** 2
    return GroundMotion.from_points(np.append(time, 4.0), np.append(result, 0.0), name="three sines")


def too_far(case):
    """Return by what part the elastic dam slides farther than the rigid one."""
    motion = three_sines()
    return flexible(case, motion).residual_slip_m / rigid(case, motion).residual_slip_m - 1.0


def growth(case):
    """Return the fastest growth [1/s] of a vibration of the sliding dam, all nodes of its crack closed and slipping
    downstream.

    The normal velocities vanish, ``S_n q' = 0``, and the forces are ``(S_n - mu S_t)^T p``; what is left of the
    equations of motion has those forces taken out of it, so that its matrices are not symmetric.
    """
    part = build_flexible_dam(case).reduced[0]
    along, across = np.split(part.shapes, 2, axis=1)
    free = scipy.linalg.null_space(across.T)
    left = scipy.linalg.null_space((across - case.crack.mu_kinetic * along).T).T
    mass, damping, stiffness = (
        left @ (d[:, None] * free) for d in (1.0 + 0.0 * part.load, part.damping_free, part.omega_squared)
    )
    count = len(mass)
    rates = np.linalg.solve(mass, np.hstack([-stiffness, -damping]))
    values = np.linalg.eigvals(np.vstack([np.eye(count, 2 * count, count), rates]))
    return float(values.real[np.abs(values) > 1.0].max())


def test_where_sliding_is_stable_a_stiff_dam_is_the_rigid_one():
    # More damping, or less friction: +0.07 % and +0.17 %, the dam's elastic give.
    for case in (stiff(damping=0.3), stiff(friction=0.3, depth=16.0)):
        assert growth(case) < 0.0
        assert abs(too_far(case)) < 0.003


@pytest.mark.slow
def test_where_sliding_flutters_a_stiff_dam_slides_farther():
    # 3.4 %, with 3, 8 or 16 elements along the crack; growth 69 1/s at a period of 3.3 ms.
    assert growth(stiff()) == pytest.approx(69.0, rel=0.02)
    farther = too_far(stiff())
    assert 0.02 < farther < 0.05
    assert too_far(stiff(across=8)) == pytest.approx(farther, rel=0.1)
    # A hundred times as stiff everything is ten times as fast, and the rigid dam is near.
    assert growth(stiff(2e5)) == pytest.approx(10.0 * growth(stiff()), rel=1e-3)
    assert abs(too_far(stiff(2e5))) < 0.005


@pytest.mark.parametrize(("sign", "elevation"), [(-1.0, 0.0), (1.0, 0.0), (-1.0, 12.0)])
def test_a_stiff_dam_turns_as_a_block_does_whose_water_turns_with_it(sign, elevation):
    # One push that rocks it, until before it comes down.
    time = np.linspace(0.0, 0.2, 101)
    ground = np.append(sign * 1.5 * G * np.sin(np.pi * time / 0.2), 0.0)
    motion = GroundMotion.from_points(np.append(time, 0.25), ground, name="push")
    case = stiff(2e5, 5.0, 29.0).with_({"crack.elevation": f"{elevation} m"})
    name = "rocking_downstream_rad" if sign < 0.0 else "rocking_upstream_rad"
    turned = getattr(flexible(case, motion), name)
    spread, point = (
        getattr(rigid(case.with_({"reservoir.virtual_mass_rotates": turns}), motion), name) for turns in (True, False)
    )
    assert turned > 1e-3
    assert turned == pytest.approx(spread, rel=2e-3)
    # With the water in one point it would turn by several per cent more.
    assert point > 1.03 * turned


@pytest.mark.slow
def test_the_own_step_is_short_enough_to_solve_the_contact():
    case = stiff(1e6, 1.2, 100.0, across=8, corners=TYPICAL)
    response = flexible(case, three_sines(0.8))
    assert response.contact_residual < 1e-9
    assert response.residual_slip_m == pytest.approx(rigid(case, three_sines(0.8)).residual_slip_m, rel=1e-3)
    # At the step that it once took, a sixteenth of the vibration, the contact is not solved; the result says so.
    coarse = flexible(stiff(1e6, 1.2, 100.0, across=8, corners=TYPICAL, time_step="0.05 ms"), three_sines(0.8).cut(1.5))
    assert coarse.contact_residual > 1e-6
    assert any("give a shorter flexible.time_step" in text for text in map(str, coarse.warnings))
