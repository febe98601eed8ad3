"""Ctrl-C ends a command, and it says so; a library that does not look out for it does not keep it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import pytest

from shared.dams import BASE

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no such signals here")

# LAPACK does not look out for signals; one of both lets go of Python's lock. It would take a minute and more.
DEAF = """
import numpy as np
import numpy.linalg, scipy.linalg
from heeltoe.cli.streams import end_if_deaf, streams

with streams():
    end_if_deaf()
    numbers = np.random.default_rng(1).random((4000, 4000))
    print("deaf", flush=True)
    {library}.linalg.eigvals(numbers)
"""


@pytest.mark.parametrize("library", ["np", "scipy"])
def test_a_deaf_library_is_ended(library):
    running = subprocess.Popen(
        [sys.executable, "-c", DEAF.format(library=library)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert running.stdout is not None
    assert running.stdout.readline() == "deaf\n"
    time.sleep(1.0)
    began = time.monotonic()
    running.send_signal(signal.SIGINT)
    _, words = running.communicate(timeout=60)
    # 1.5 s are its patience; the rest is what a busy machine takes.
    assert time.monotonic() - began < 10.0
    assert (running.returncode, words) == (130, "heeltoe: interrupted\n")


def test_afterwards_signals_are_as_they_were():
    code = """
import os, signal, time
from heeltoe.cli.streams import end_if_deaf, streams
for _ in range(3):
    with streams():
        end_if_deaf()
        end_if_deaf()
        assert signal.getsignal(signal.SIGINT) is not signal.default_int_handler
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert signal.set_wakeup_fd(-1) == -1
try:
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(5)
except KeyboardInterrupt:
    time.sleep(2)
    print("heard")
"""
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert ended.stdout == "heard\n", ended.stderr


@pytest.mark.slow
def test_sixty_joints_say_what_they_take_and_end(tmp_path):
    """Before anything runs: time and memory; most of the time is spent in libraries."""
    fields = tomllib.loads(Path(BASE).read_text(encoding="utf-8"))
    del fields["crack"]
    bond = {"tensile_strength": "1 MPa", "cohesion": "1 MPa", "fracture_energy": "100 N/m", "shear_energy": "1000 N/m"}
    fields["joints"] = {"every": "1.6 m", "friction": 1.0, "bond": bond}
    fields["flexible"] = {"elements_across": 3, "evidence": "none"}
    fields["analysis"] = {"time_limit": "25 h"}
    (tmp_path / "case.json").write_text(json.dumps(fields))
    words = [sys.executable, "-m", "heeltoe", "run", str(tmp_path / "case.json"), "--model", "flexible"]
    environment = {**os.environ, "COLUMNS": "200"}
    running = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
    assert running.stderr is not None
    line = running.stderr.readline()
    assert "takes about" in line, line
    time.sleep(4.0)
    began = time.monotonic()
    running.send_signal(signal.SIGINT)
    running.communicate(timeout=60)
    assert running.returncode == 130
    assert time.monotonic() - began < 6.0
