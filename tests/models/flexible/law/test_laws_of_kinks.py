"""Friction laws of a crack that is not straight: climbing flanks by hand, those of constant friction, mirror, scale."""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe.case.model import Case
from heeltoe.models.run import flexible
from shared.dams import plane_case

GRAVITY = 9.80665
PULSES = [["0 s", "0 g"], ["0.15 s", "-0.6 g"], ["0.4 s", "0.5 g"], ["0.65 s", "-0.5 g"], ["0.8 s", "0 g"]]
WEAK = {"name": "slip weakening", "peak_friction": 0.9, "residual_friction": 0.6, "slip": "20 mm"}
BARTON = {"name": "barton-bandis", "jrc": 10, "jcs": "20 MPa", "residual_angle": "30 deg"}
STEP = [["30 m", "0 m"], ["34 m", "1.5 m"]]


def dam(law, **crack) -> Case:
    given = {"friction": law} if isinstance(law, float) else {"law": law}
    return plane_case(
        {
            "section": {"height": "110 m", "crest_width": "8 m", "base_width": "90 m"},
            "concrete": {"modulus": "20 GPa"},
            "crack": {"elevation": "20 m", "kinks": STEP} | given | crack,
            "reservoir": {"depth": "105 m"},
            "motion": {"points": PULSES, "duration": "1 s"},
            "analysis": {"silence": "0 s"},
            "flexible": {"elements_across": 6, "evidence": "none"},
        }
    )


def test_a_law_reduced_to_coulomb_gives_coulombs_result():
    one, other = flexible(dam(0.9)), flexible(dam({**WEAK, "residual_friction": 0.9}))
    slip = one.histories["slip_m"]
    assert abs(slip).max() > 0.05
    np.testing.assert_allclose(other.histories["slip_m"], slip, rtol=0.0, atol=1e-10 * abs(slip).max())


def test_flanks_that_weaken_are_climbed_as_by_hand():
    """Up a slope i with mu = mu_p - (mu_p - mu_r) d / D the motion is d'' = a + k d, d = a/k (cosh(sqrt(k) t) - 1)."""
    rise, peak, residual, over = math.radians(10.0), 0.4, 0.2, 0.2
    height = math.tan(rise)
    law = {"name": "slip weakening", "peak_friction": peak, "residual_friction": residual, "slip": f"{over} m"}
    push = 1.5 * GRAVITY * math.tan(math.atan(peak) + rise)
    block = plane_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["8 m", "0 m"], ["8 m", "6 m"], ["0 m", "6 m"]]},
            "concrete": {"modulus": "1000 GPa"},
            "crack": {
                "elevation": "3 m",
                "kinks": [[f"{place} m", f"{height * (place % 2)} m"] for place in range(1, 8)],
                "law": law,
            },
            "uplift": {"pattern": "none"},
            "motion": {"points": [["0 s", f"{-push} m/s^2"], ["0.25 s", f"{-push} m/s^2"]], "duration": "0.25 s"},
            "analysis": {"silence": "0 s"},
            "flexible": {"elements_across": 8, "evidence": "none", "time_step": "0.1 ms"},
        }
    )
    response = flexible(block)
    pressed = GRAVITY * math.cos(rise) + push * math.sin(rise)
    uphill = push * math.cos(rise) - GRAVITY * math.sin(rise) - peak * pressed
    grows = (peak - residual) / over * pressed
    time, slip, way = (response.histories[name] for name in ("time_s", "slip_m", "slip_path_m"))
    climbed = uphill / grows * (math.cosh(math.sqrt(grows) * time[-1]) - 1.0)
    assert 0.05 < climbed < over
    # Without the weakening it would climb less by as much as counts.
    assert climbed > 1.05 * 0.5 * uphill * time[-1] ** 2
    assert slip[-1] == pytest.approx(climbed * math.cos(rise), rel=0.03)
    # The flanks that come down open at once, and have no way.
    assert way[-1] == pytest.approx(climbed / 2.0, rel=0.15)


@pytest.mark.parametrize("law", [WEAK, BARTON], ids=["weakening", "barton"])
def test_contact_is_met_and_the_ledger_closes(law):
    response = flexible(dam(law))
    assert response.summary["contact_residual"] < 1e-9
    assert response.energy.residual < 1e-12
    assert 0.05 < response.residual_slip_m < flexible(dam(law, kinks=[])).residual_slip_m


@pytest.mark.parametrize("law", [WEAK, BARTON], ids=["weakening", "barton"])
def test_a_mirrored_dam_slides_the_other_way(law):
    case = dam(law)
    width = case.cut.crack_width
    polygon = [[f"{-x!r} m", f"{z!r} m"] for x, z in reversed([list(vertex) for vertex in case.section.vertices()])]
    image = case.with_(
        {
            "section": {**dict.fromkeys(case.section.model_fields_set), "polygon": polygon},
            "crack.kinks": [[f"{width - 34.0!r} m", "1.5 m"], [f"{width - 30.0!r} m", "0 m"]],
            "reservoir": None,
            "tailwater": {"depth": "105 m", "compressible": False},
            "motion.reverse": True,
        }
    )
    one, other = flexible(case).histories, flexible(image).histories
    assert abs(one["slip_m"]).max() > 0.05
    np.testing.assert_allclose(other["slip_m"], -one["slip_m"], rtol=0.0, atol=1e-7)


def test_a_larger_dam_on_larger_steps_slides_as_much_farther():
    # Four times the lengths and the modulus, twice the times.
    case = dam(WEAK).with_({"flexible.time_step": "0.2 ms"})
    polygon = [[f"{4.0 * x!r} m", f"{4.0 * z!r} m"] for x, z in case.section.vertices()]
    larger = case.with_(
        {
            "section": {**dict.fromkeys(case.section.model_fields_set), "polygon": polygon},
            "crack.elevation": "80 m",
            "crack.kinks": [["120 m", "0 m"], ["136 m", "6 m"]],
            "crack.law.slip": "80 mm",
            "reservoir.depth": "420 m",
            "concrete.modulus": "80 GPa",
            "motion.points": [[f"{2.0 * float(time.split()[0])} s", size] for time, size in PULSES],
            "motion.duration": "2 s",
            "flexible.time_step": "0.4 ms",
        }
    )
    assert flexible(larger).residual_slip_m == pytest.approx(4.0 * flexible(case).residual_slip_m, rel=1e-9)
