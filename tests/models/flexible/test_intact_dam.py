"""A joint that holds is none: the dam moves and is stressed as modal analysis of the whole dam says."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh

from heeltoe.kernel.shaking import Shaking
from heeltoe.models.flexible.body.elastic import side_by_side, stresses
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake
from heeltoe.motion.moments import step_means
from shared.dams import plane_case

HOLDS = {
    "tensile_strength": "100 MPa",
    "cohesion": "150 MPa",
    "fracture_energy": "10 MN/m",
    "shear_energy": "10 MN/m",
}
STEP = 2.5e-4


@pytest.mark.parametrize(("elevation", "depth"), [("12 m", "25 m"), ("0 m", "25 m"), ("12 m", None)])
def test_the_stresses_of_an_intact_dam_are_those_of_modal_analysis(elevation, depth):
    case = plane_case(
        {
            "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in [(0, 0), (24, 0), (8, 20), (6, 30), (0, 30)]]},
            "concrete": {"modulus": "20 GPa", "damping": 0.05},
            "crack": {"friction": 0.8, "elevation": elevation, "bond": HOLDS},
            "flexible": {"elements_across": 4, "modes": 5000, "damping": "stiffness", "theta": 0.5, "evidence": "none"},
            "motion": {"points": [["0 s", "0 g"], ["0.07 s", "0.5 g"], ["0.2 s", "-0.6 g"], ["0.5 s", "0 g"]]},
            "analysis": {"silence": "0 s"},
            **({} if depth is None else {"reservoir": {"depth": depth}}),
        }
    )
    shaking: Shaking = earthquake(case).shaking
    dam = build_flexible_dam(case)
    run = ShakenDam(case, dam, shaking).run(STEP, 10 * STEP, stresses=False)
    ours = [
        stresses(body, basis.shapes @ (amplitudes - amplitudes[0]).T)
        for body, basis, amplitudes in zip(dam.bodies, dam.modes, run.modes, strict=True)
    ]
    # All modes of the whole dam, from its own matrices, and the trapezoidal rule in each of them.
    stiffness, mass = ((dam.tie.T @ side_by_side(dam, name) @ dam.tie).toarray() for name in ("stiffness", "mass"))
    squares, shapes = eigh(stiffness, mass)
    pushed = np.tile([1.0, 0.0], side_by_side(dam, "mass").shape[0] // 2)
    shares = shapes.T @ (dam.tie.T @ (side_by_side(dam, "mass") @ pushed))
    damping = 2.0 * 0.05 / np.sqrt(squares[0]) * squares
    ground = step_means(shaking, round(shaking.end / STEP))[:, 0]
    x, v = np.zeros_like(squares), np.zeros_like(squares)
    amplitudes = [x]
    for place, acceleration in enumerate(ground):
        resisting = damping / 2.0 + squares * STEP / 4.0
        after = ((1.0 / STEP - resisting) * v - squares * x - shares * acceleration) / (1.0 / STEP + resisting)
        x, v = x + STEP * (v + after) / 2.0, after
        if (place + 1) % 10 == 0:
            amplitudes.append(x)
    moved = dam.tie @ (shapes @ np.array(amplitudes).T)
    ends = np.cumsum([body.mesh.nodes.size for body in dam.bodies])[:-1]
    for body, result, motion in zip(dam.bodies, ours, np.split(moved, ends), strict=True):
        wanted = stresses(body, motion)
        assert result.shape == wanted.shape
        largest = np.abs(wanted).max()
        assert largest > 1e5
        assert np.abs(result - wanted).max() < 1e-6 * largest
    assert run.summary.cracked_length == 0.0
