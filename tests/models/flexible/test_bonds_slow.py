"""The order in which the joints of a published dam crack."""

from __future__ import annotations

from typing import Any

import pytest

from heeltoe import run
from shared.dams import plane_case

pytestmark = pytest.mark.slow
#: Koyna, after Westergaard's water and the strengths that papers on its cracks take.
KOYNA_BOND = {
    "tensile_strength": "1.5 MPa",
    "cohesion": "2 MPa",
    "fracture_energy": "150 N/m",
    "shear_energy": "1500 N/m",
    "dynamic_factor": 1.2,
}
KOYNA: dict[str, Any] = {
    "section": {
        "polygon": [["0 m", "0 m"], ["70 m", "0 m"], ["19.25 m", "66.5 m"], ["14.8 m", "103 m"], ["0 m", "103 m"]]
    },
    "concrete": {"modulus": "31 GPa", "density": "2643 kg/m^3"},
    "cracks": [{"elevation": level, "friction": 1.0, "bond": KOYNA_BOND} for level in ("66.5 m", "0 m")],
    "reservoir": {"depth": "91.7 m"},
    "motion": {"file": "elcentro-1940-180-nga", "pga": "0.47 g", "duration": "3 s", "sign": "recorded"},
    "flexible": {"elements_across": 8, "evidence": "none"},
    "analysis": {"silence": "0 s"},
}


def test_koyna_cracks_at_its_heel_first_then_through_its_neck_from_downstream():
    response = run(plane_case(KOYNA), "flexible")
    neck, base = response.cracks
    assert base.joint.first_cracking_s < neck.joint.first_cracking_s
    assert base.joint.first_cracking_at_m < 0.1 * base.crack_width_m
    assert neck.joint.first_cracking_at_m > 0.9 * neck.crack_width_m
    assert neck.joint.cracked_through_s is not None
    # The top rocks on what has cracked.
    assert neck.opening_upstream_m > 1e-2
