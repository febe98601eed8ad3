"""A crack with a step converges with step and mesh, at gentle and at steep slopes."""

from __future__ import annotations

import runpy

import pytest

from shared.dams import ROOT

TABLE = runpy.run_path(str(ROOT / "docs" / "kink_meshes.py"))
LINES, slips = TABLE["LINES"], TABLE["slips"]


@pytest.mark.slow
@pytest.mark.parametrize(("line", "good"), [("10°, 0.8", 0.04), ("27°, 0.9", 0.05), ("45°, 0.9", 0.03)])
def test_a_step_converges_with_step_and_mesh(line, good):
    """Parts of the table of docs/kinks.md: 24 and 32 across, and half the step with 16."""
    usual, finer = (slips(*LINES[line], across, 2e-4) for across in (24, 32))
    assert finer[0] == pytest.approx(usual[0], rel=good)
    coarse, smaller = (slips(*LINES[line], 16, step) for step in (2e-4, 1e-4))
    assert smaller[0] == pytest.approx(coarse[0], rel=0.01)
    for mean, half in (usual, finer, coarse, smaller):
        assert half < 0.05 * mean


@pytest.mark.slow
def test_where_a_hundredth_of_the_shaking_decides_no_mesh_mends_it():
    for across in (8, 16, 24):
        mean, half = slips(*LINES["10°, 0.9"], across, 2e-4)
        assert mean == pytest.approx(222.0, rel=0.03)
        assert half > 0.05 * mean


@pytest.mark.slow
@pytest.mark.product
def test_sixteen_elements_across_are_enough_for_a_straight_crack_and_too_few_for_a_step():
    """Two to four nodes carry the dam on a step with eight of them; twice as many still miss it."""
    straight, step = (LINES[name] for name in ("straight, 0.9", "27°, 0.9"))
    assert slips(*straight, 16, 2e-4)[0] == pytest.approx(slips(*straight, 24, 2e-4)[0], rel=0.01)
    eight, sixteen, fine = (slips(*step, across, 2e-4)[0] for across in (8, 16, 24))
    assert eight < 0.9 * fine
    assert abs(sixteen - fine) > 0.04 * fine
