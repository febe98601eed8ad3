"""Two rigid blocks against programs of small steps: one of our own that knows neither events nor modes, and Siconos."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from heeltoe.kernel.shaking import Shaking
from shared.stacks import Rectangles, pulse

BENCHMARKS = Path(__file__).parents[4] / "benchmarks"

# Both rock; both slide, rock and strike; both rock and bounce.
STACKS = {
    "rock": (Rectangles(), 5.5),
    "slide": (Rectangles(friction=(0.45, 0.35)), 6.5),
    "bounce": (Rectangles(restitution=(0.2, 0.3)), 5.5),
}


def exact(stack, time, ground):
    """Return slip, heel gap and toe gap of the lower and of the upper crack at the samples of the motion."""
    found = stack.run(Shaking(time, ground), time)
    assert all(crack.outcome == "ok" and crack.summary["impacts"] for crack in found.cracks)
    assert all(crack.summary["energy_residual"] < 1e-14 for crack in found.cracks)
    names = ("slip", "gap_heel", "gap_toe")
    return np.column_stack([crack.histories[name] for crack in found.cracks for name in names])


def off(expected, time, seen, moments):
    """Return how far histories are apart [m]."""
    return np.abs(np.column_stack([np.interp(time, moments, each) for each in seen.T]) - expected).max()


def test_small_steps_agree():
    stack, size = STACKS["rock"]
    time, ground = pulse(size, rest=0.5)
    expected = exact(stack, time, ground)
    assert expected[:, 2].max() > 0.06
    assert expected[:, 5].max() > 0.3
    moments, seen = stack.stepped(time, ground, 1e-3)
    assert off(expected, time, seen, moments) < 0.01 * expected.max()


@pytest.mark.slow
@pytest.mark.parametrize("name", STACKS)
def test_smaller_steps_agree_better(name):
    stack, size = STACKS[name]
    time, ground = pulse(size, rest=1.5)
    expected = exact(stack, time, ground)
    moments, seen = stack.stepped(time, ground, 2.5e-4)
    assert off(expected, time, seen, moments) < 0.01 * np.abs(expected).max()


@pytest.mark.slow
@pytest.mark.parametrize("name", STACKS)
def test_siconos_agrees(name, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(BENCHMARKS), *sys.path])
    import peer_siconos
    from measure import Skipped

    stack, size = STACKS[name]
    time, ground = pulse(size, rest=1.5)
    expected = exact(stack, time, ground)
    try:
        seen = peer_siconos.two_blocks(stack.problem(time, ground), 1e-4)
    except Skipped as why:
        pytest.skip(str(why))
    moments = np.arange(len(seen)) * 1e-4
    assert off(expected, time, seen[:, [4, 0, 1, 6, 2, 3]], moments) < 0.005 * np.abs(expected).max()
