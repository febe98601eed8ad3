"""Friction laws and rough cracks as they run by closed forms and series; the walk by integration is their judge."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import build_block, read_case
from heeltoe.kernel.block import Limits, run_block
from heeltoe.kernel.friction import friction_law
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.rigid.varying import varying
from models.rigid.test_varying import IDLE, rectangle

FALLS = {"peak": 0.5, "residual": 0.3}
LAWS = {
    "constant": ("constant", FALLS),
    "linear": ("linear slip weakening", FALLS | {"scale": 0.05}),
    "exponential": ("exponential slip weakening", FALLS | {"scale": 0.05}),
    "speed": ("speed weakening", FALLS | {"scale": 0.1}),
    "brittle": ("constant", {"peak": 0.3, "residual": 0.3, "cohesion": 2e3}),
    "barton-bandis": (
        "barton-bandis",
        {"roughness": 6.0, "wall_strength": 2e5, "residual_angle": math.radians(15.0)},
    ),
    "lift joint": ("lift joint", {"residual": 0.3}),
}


def run(name, height, *, wear=None, integrated=False):
    """Shake a block 4 m wide, along and across, by a law; on a rough crack that wears by `wear` [m2/J], if given."""
    case = read_case(rectangle(4.0, height, 0.5, crack={"restitution": 0.3}))
    block = build_block(case)
    rng = np.random.default_rng(11)
    time = np.arange(80) * 0.05
    ground = np.append(rng.normal(size=78) * 5.0, [0.0, 0.0])
    up = np.append(rng.normal(size=78) * 2.0, [0.0, 0.0])
    shape, numbers = LAWS[name]
    points = [(0.0, 0.25), (2e5, 0.0)] if name == "lift joint" else ()
    what = replace(varying(case, block), friction=friction_law(shape, numbers, points))
    if wear is not None:
        what = replace(what, asperities=np.array([0.002, 0.05, wear]))
    if integrated:
        what = replace(what, anchors=IDLE)
    at = np.linspace(0.0, time[-1], 200)
    limits = Limits(event_limit=20_000, jam=True)
    return run_block(block.parameters(), Shaking(time, ground, up), at, limits, varying=what)


def compare(quick, slow, tolerance):
    """Compare histories, sums and what the crack has been through."""
    assert quick.summary.outcome == slow.summary.outcome == 0.0
    assert quick.summary.events == slow.summary.events
    assert quick.summary.slip_max > 1e-3
    for column in ("slip", "gap_heel", "gap_toe", "slip_velocity"):
        ours, theirs = (np.asarray(getattr(item.histories, column)) for item in (quick, slow))
        assert ours == pytest.approx(theirs, abs=tolerance)
    assert quick.worn.end == pytest.approx(slow.worn.end, abs=tolerance)
    assert quick.worn.path == pytest.approx(slow.worn.path, abs=tolerance)
    assert list(quick.worn.bonded) == list(slow.worn.bonded)
    assert quick.summary.energy_friction == pytest.approx(slow.summary.energy_friction, rel=tolerance)
    assert quick.summary.energy_residual < 1e-10


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("height", [1.0, 6.0])
def test_the_quick_walk_is_the_integrated_one(name, height):
    compare(run(name, height), run(name, height, integrated=True), 1e-9)


@pytest.mark.parametrize("wear", [0.0, 1e-5])
@pytest.mark.parametrize("height", [1.0, 6.0])
def test_a_rough_crack_moves_as_it_does_by_integration(height, wear):
    quick, slow = (run("constant", height, wear=wear, integrated=integrated) for integrated in (False, True))
    compare(quick, slow, 1e-8)
    assert quick.rough.end == pytest.approx(slow.rough.end, rel=1e-7, abs=1e-9)


def test_nothing_is_integrated_where_friction_stays_as_it_is():
    # A brittle bond is gone with the first slip, and a rough crack that does not wear has flanks of one slope.
    assert run("brittle", 6.0).worn.integrated == 0.0
    assert run("constant", 6.0, wear=0.0).worn.integrated == 0.0
    assert run("brittle", 6.0, integrated=True).worn.integrated > 0.0
