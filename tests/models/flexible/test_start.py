"""The state before the earthquake: static, with friction; without an earthquake nothing moves, to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import GroundMotion, flexible
from heeltoe.mechanics.block import build_block
from heeltoe.models.flexible.body.elastic import dofs
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.dams import plane_case

QUIET = GroundMotion.from_points(np.array([0.0, 0.5]), np.array([0.0, 0.0]), name="quiet")


def typical(friction, elevation=0.0, *changes, anchors=(), **options):
    fields = {
        "section": {"polygon": [["0 m", "0 m"], ["80 m", "0 m"], ["8 m", "90 m"], ["8 m", "100 m"], ["0 m", "100 m"]]},
        "concrete": {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143},
        "crack": {"friction": friction, "elevation": f"{elevation} m"},
        "reservoir": {"depth": "100 m"},
        "uplift": {"pattern": "triangular"},
        "flexible": {"elements_across": 4, "time_step": "0.2 ms", "evidence": "none", **options},
    }
    return plane_case(fields | ({"anchors": anchors} if anchors else {}), list(changes))


@pytest.mark.parametrize("factor", [1.006, 1.02, 1.07, 1.34])
@pytest.mark.parametrize("damping", ["relative", "thesis"])
def test_without_an_earthquake_nothing_slips(factor, damping):
    per_friction = build_block(typical(1.0)).sliding_safety_factor
    case = typical(factor / per_friction, damping=damping)
    assert build_block(case).sliding_safety_factor == pytest.approx(factor, rel=1e-9)
    response = flexible(case, QUIET)
    assert response.outcome == "ok"
    assert not np.any(response.histories["slip_m"])
    assert not np.any(response.histories["slip_velocity_m_s"])
    assert response.residual_slip_m == response.peak_slip_downstream_m == 0.0
    # What slipped when the crack was let go is told apart.
    assert 1e-4 < response.before_shaking["slip_m"] < 2e-3


@pytest.mark.parametrize("elevation", [60.0, 90.0])
@pytest.mark.parametrize("contactors", [1, 3, 4, 5])
def test_nor_does_a_crack_at_a_height(elevation, contactors):
    response = flexible(typical(0.9, elevation, elements_across_below=3, contactors=contactors), QUIET)
    assert response.before_shaking["stands"]
    assert not np.any(response.histories["slip_m"])
    assert not np.any(response.histories["rotation_rad"] - response.histories["rotation_rad"][0])


def test_nor_with_water_that_follows_the_opening_and_anchors():
    anchor = {"distance": "20 m", "prestress": "1 MN/m", "axial_stiffness": "50 MN/m/m", "shear_stiffness": "10 MN/m/m"}
    water = "uplift.during_shaking='zero while open'", "uplift.opening='1 mm'"
    case = typical(1.0, 0.0, *water, anchors=[anchor])
    response = flexible(case, QUIET)
    # Some of the crack is open, and it is the pressure of the state at rest that counts there.
    assert response.before_shaking["open_contacts"] > 0
    assert not np.any(response.histories["slip_m"])


@pytest.mark.parametrize(("friction", "elevation"), [(0.8, 0.0), (1.2, 0.0), (0.9, 60.0)])
def test_it_is_an_equilibrium_with_friction(friction, elevation):
    """On the nodes, with the matrices of the elements."""
    one = build_flexible_dam(typical(friction, elevation))
    assert one.start.stands
    upper, crack = one.upper, one.upper.mesh.crack
    along, across = one.crack_forces[0]
    scale = np.abs(across).max()
    force = upper.load.copy()
    force[dofs(crack)] += one.crack_forces[0].T.reshape(-1)
    assert upper.stiffness @ one.static[0] == pytest.approx(force, abs=1e-6 * scale)
    assert across.min() >= 0.0
    assert np.all(np.abs(along) <= friction * across + 1e-9 * scale)
    # Nowhere do the faces enter each other, and where they are apart nothing presses.
    gap = one.static[0][dofs(crack)][1::2].copy()
    if one.lower is not None:
        gap -= one.static[1][dofs(one.lower.mesh.crack)][1::2]
    assert gap.min() > -1e-9
    assert np.all(across[gap > 1e-9] == 0.0)


def test_what_friction_does_not_hold_is_unstable():
    response = flexible(typical(0.7), QUIET)
    assert response.outcome == "unstable"
    assert not response.before_shaking["stands"]
    assert response.residual_slip_m > 1e-3


def test_a_crack_that_holds_bonded_is_left_as_it_was():
    one = build_flexible_dam(typical(5.0, 0.0, "reservoir.depth='20 m'", "uplift.pattern='none'"))
    assert one.start.stands
    assert one.start.slips[0] == pytest.approx(0.0, abs=1e-12)
    assert one.start.open_contacts[0] == 0


@pytest.mark.parametrize("friction", [0.01, 0.6])
@pytest.mark.parametrize("across", [1, 4])
def test_a_dam_without_water_is_at_rest(across, friction):
    """Weight deforms no part that is free: what the bonded crack has been bent by says what is a small motion."""
    corners = [["0 m", "0 m"], ["2 m", "0 m"], ["2 m", "3 m"], ["0 m", "3 m"]]
    fields = {
        "section": {"polygon": corners},
        "concrete": {"modulus": "20 GPa"},
        "crack": {"friction": friction},
        "flexible": {"elements_across": across},
    }
    dam = build_flexible_dam(plane_case(fields))
    assert dam.start.stands
    assert dam.start.slips[0] == pytest.approx(0.0, abs=1e-9)


def test_the_slip_to_the_state_at_rest_is_one_number_at_any_mesh():
    """With so much friction a node may stick nowhere where it slips, which the search for the state must see."""
    coarse, fine = (build_flexible_dam(typical(1.2, elements_across=across)).start for across in (8, 24))
    assert coarse.stands
    assert fine.stands
    assert fine.slips[0] == pytest.approx(coarse.slips[0], rel=0.04)
