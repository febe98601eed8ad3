"""Two rigid blocks against programs of small steps: one of our own that knows neither events nor modes, and Siconos."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from shared.stacks import STACKS, at_samples, pulse

BENCHMARKS = Path(__file__).parents[4] / "benchmarks"


def off(expected, time, seen, moments):
    """Return how far histories are apart [m]."""
    return np.abs(at_samples(time, moments, seen) - expected).max()


def test_small_steps_agree():
    stack, size = STACKS["rock"]
    time, ground = pulse(size, rest=0.5)
    expected = stack.exact(time, ground)
    assert expected[:, 2].max() > 0.06
    assert expected[:, 5].max() > 0.3
    moments, seen = stack.stepped(time, ground, 1e-3)
    assert off(expected, time, seen, moments) < 0.01 * expected.max()


@pytest.mark.slow
@pytest.mark.parametrize("name", STACKS)
def test_smaller_steps_agree_better(name):
    stack, size = STACKS[name]
    time, ground = pulse(size, rest=1.5)
    expected = stack.exact(time, ground)
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
    expected = stack.exact(time, ground)
    try:
        seen = peer_siconos.rigid_blocks(stack.problem(time, ground), 1e-4)
    except Skipped as why:
        pytest.skip(str(why))
    moments = np.arange(len(seen)) * 1e-4
    assert off(expected, time, seen[:, [4, 0, 1, 6, 2, 3]], moments) < 0.005 * np.abs(expected).max()
