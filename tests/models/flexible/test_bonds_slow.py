"""Joints of many kinds on half the mesh, and the order in which those of a published dam crack."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from heeltoe import flexible, read_case, run

pytestmark = pytest.mark.slow
SECTION = {
    "height": "30 m",
    "crest_width": "5 m",
    "neck_height": "25 m",
    "neck_width": "6 m",
    "base_width": "26 m",
}
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


def random_joint(rng: np.random.Generator) -> dict[str, Any]:
    strength, energy = 10.0 ** rng.uniform(-0.7, 0.2), rng.uniform(60.0, 300.0)
    scale = rng.uniform(0.4, 1.5)
    pulses = [(0.0, 0.0), (0.1, 0.6), (0.3, -0.9), (0.5, 0.9), (0.6, 0.0)]
    bond = {
        "tensile_strength": f"{strength} MPa",
        "cohesion": f"{strength * rng.uniform(1.2, 2.5)} MPa",
        "fracture_energy": f"{energy} N/m",
        "shear_energy": f"{energy * rng.uniform(3.0, 10.0)} N/m",
    }
    return {
        "section": SECTION,
        "concrete": {"modulus": "25 GPa"},
        "crack": {"elevation": f"{rng.choice([0.0, 6.0, 12.0, 18.0])} m", "friction": 1.0, "bond": bond},
        "reservoir": {"depth": "26 m"},
        "motion": {"points": [[f"{t} s", f"{scale * a} g"] for t, a in pulses], "sign": "recorded"},
        "analysis": {"silence": "0 s"},
        "flexible": {"elements_across": 8, "evidence": "full"},
    }


@pytest.mark.parametrize("seed", range(12))
def test_the_cracked_length_is_as_certain_as_it_says(seed):
    fields = random_joint(np.random.default_rng([32, seed]))
    response = run(read_case(fields), "flexible")
    worth = response.evidence.cracked_length_m
    fields["flexible"] = {
        "elements_across": 2 * round(response.crack_width_m / response.joint.element_m),
        "elements_away": 8,
        "evidence": "none",
    }
    finer = run(read_case(fields), "flexible").joint.cracked_length_m
    assert abs(finer - worth.value) <= worth.uncertainty + 1e-9


def test_koyna_cracks_at_its_heel_first_then_through_its_neck_from_downstream():
    response = run(read_case(KOYNA), "flexible")
    neck, base = response.cracks
    assert base.joint.first_cracking_s < neck.joint.first_cracking_s
    assert base.joint.first_cracking_at_m < 0.1 * base.crack_width_m
    assert neck.joint.first_cracking_at_m > 0.9 * neck.crack_width_m
    assert neck.joint.cracked_through_s is not None
    # The top rocks on what has cracked.
    assert neck.opening_upstream_m > 1e-2


@pytest.mark.parametrize("batch", range(6))
def test_of_random_joints_none_heals_and_every_ledger_closes(batch):
    rng = np.random.default_rng([3232, batch])
    for _ in range(50):
        fields = random_joint(rng)
        fields["flexible"] = {"elements_across": int(rng.integers(2, 5)), "evidence": "none"}
        fields["uplift"] = {"pattern": str(rng.choice(["none", "triangular"]))}
        response = flexible(read_case(fields))
        assert response.outcome == "ok", fields
        assert response.energy.residual < 1e-9, fields
        damage = response.crack.damage
        assert np.all(np.isfinite(damage)), fields
        assert np.all(np.diff(damage, axis=0) >= 0.0), fields
        assert all(np.isfinite(values).all() for values in response.histories.values()), fields
        for name in ("cracked_upstream_m", "cracked_downstream_m", "cracked_length_m"):
            values = response.histories[name]
            assert np.all(np.diff(values) >= -1e-9 * max(1.0, np.abs(values).max())), (name, fields)
