"""Random bonded joints: cracked lengths are as certain as they say, nothing heals, ledgers close.

``make attack`` tries 60 on half the mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from heeltoe import flexible, read_case, run
from shared.attack_page import CASES

SECTION = {
    "height": "30 m",
    "crest_width": "5 m",
    "neck_height": "25 m",
    "neck_width": "6 m",
    "base_width": "26 m",
}


def random_joint(rng: np.random.Generator) -> dict[str, Any]:
    """Return a dam with a joint, brittle or tough, at its base or above."""
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


def joint_that_cracks_in_part(rng: np.random.Generator) -> dict[str, Any]:
    """Return a dam whose joint is cracked in part in the end, on a mesh that resolves its process zone."""
    while True:
        fields = random_joint(rng)
        times = np.sort(rng.uniform(0.05, 0.6, rng.integers(3, 9)))
        scale = rng.uniform(0.3, 1.2)
        points = [(0.0, 0.0), *((time, scale * rng.uniform(-1.0, 1.0)) for time in times), (0.65, 0.0)]
        fields["motion"]["points"] = [[f"{time} s", f"{acceleration} g"] for time, acceleration in points]
        fields["flexible"] = {"elements_across": 12, "evidence": "none"}
        if rng.random() < 0.5:
            bond = fields["crack"]["bond"]
            bond["initial_energy"] = f"{rng.uniform(0.4, 1.0) * float(bond['fracture_energy'].split()[0])} N/m"
        response = run(read_case(fields), "flexible")
        coarse = any(warning.code == "joint-coarse" for warning in response.warnings)
        if not coarse and 0.02 < response.joint.cracked_length_m / response.crack_width_m < 0.98:
            return fields


def off_on_half_the_mesh(fields: dict[str, Any]) -> tuple[float, float]:
    """Return by how much the cracked length is another one on half the mesh, and what the result says of that [m]."""
    response = run(read_case(fields | {"flexible": {"elements_across": 12, "evidence": "full"}}), "flexible")
    worth = response.evidence.cracked_length_m
    finer = {
        "elements_across": 2 * round(response.crack_width_m / response.joint.element_m),
        "elements_away": 12,
        "evidence": "none",
    }
    length = run(read_case(fields | {"flexible": finer}), "flexible").joint.cracked_length_m
    return abs(length - worth.value), worth.uncertainty


@pytest.mark.product
@pytest.mark.parametrize("part", range(4))
def test_the_cracked_length_on_half_the_mesh_is_within_what_is_said(part):
    rng = np.random.default_rng([32, part])
    for _ in range(min(CASES // 32, 15)):
        fields = joint_that_cracks_in_part(rng)
        off, said = off_on_half_the_mesh(fields)
        assert off <= said + 1e-9, (off, said, fields)


@pytest.mark.product
@pytest.mark.parametrize("batch", range(6))
def test_of_random_joints_none_heals_and_every_ledger_closes(batch):
    rng = np.random.default_rng([3232, batch])
    for place in range(50):
        fields = random_joint(rng)
        fields["flexible"] = {"elements_across": int(rng.integers(2, 5)), "evidence": "none"}
        fields["uplift"] = {"pattern": str(rng.choice(["none", "triangular"]))}
        if place % 2:
            bond = fields["crack"]["bond"]
            bond["initial_energy"] = f"{rng.uniform(0.3, 1.0) * float(bond['fracture_energy'].split()[0])} N/m"
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
