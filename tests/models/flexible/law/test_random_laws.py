"""Random dams with random friction laws: they end, with numbers, and contact makes no energy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from models.rigid.test_friction_laws import random_law
from shared.random_dams import LEFT, MADE, draw


def check(seed):
    rng = np.random.default_rng(seed)
    drawn = draw(rng)
    law = random_law(rng)
    lines = tuple(replace(line, law=law) for line in drawn.dam.lines)
    run = replace(drawn, dam=replace(drawn.dam, lines=lines)).run()
    summary = run.summary
    assert all(np.isfinite(value) for value in summary.by_name().values())
    assert run.outcome in ("ok", "lost")
    assert summary.energy_residual <= drawn.residual_allowed(run)
    assert (run.worked.path >= run.worked.path_before).all()
    assert (run.worked.bonded <= run.worked.bonded_before).all()
    assert summary.bond_energy >= 0.0
    if drawn.ordinary:
        assert summary.energy_gained <= MADE * summary.energy_turnover
        assert summary.energy_friction + summary.energy_impact >= -LEFT * summary.energy_turnover
    # Where all nodes of both faces are watched the problem is next to singular, by any law.
    return float(summary.contact_residual) if drawn.ordinary and drawn.case.flexible.contactors != 5 else 0.0


@pytest.mark.parametrize("count", [10, pytest.param(200, marks=pytest.mark.product)])
def test_random_dams_with_random_laws_end(count):
    assert max(check(seed) for seed in range(count)) < 1e-6
