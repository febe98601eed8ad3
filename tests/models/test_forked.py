"""A process that was forked after the kernels have run in its parent: its numbers come, and are the same bits."""

from __future__ import annotations

import subprocess
import sys

import pytest

from shared.dams import BASE, FAST

SCRIPT = """
import os, sys
import numpy as np
import heeltoe

model, source, *changes = sys.argv[1:]
case = heeltoe.read_case(source, changes)
def run():
    return heeltoe.run(case, model=model).residual_slip_m
motion = heeltoe.GroundMotion("waves", 0.01 * np.arange(3000), np.sin(0.05 * np.arange(3000)))
def spectrum():
    return float(heeltoe.response_spectrum(motion, np.geomspace(0.05, 4.0, 200)).pseudo_acceleration.sum())
before = run(), spectrum()
if os.fork():
    sys.exit(os.waitstatus_to_exitcode(os.wait()[1]))
assert (run(), spectrum()) == before
os._exit(7)
"""


@pytest.mark.skipif(not hasattr(__import__("os"), "fork"), reason="no fork here")
@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_a_fork_returns_the_same_bits(model):
    words = [sys.executable, "-W", "ignore", "-c", SCRIPT, model, str(BASE), *FAST]
    ended = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 7, ended.stderr
