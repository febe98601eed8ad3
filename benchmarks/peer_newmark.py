"""Newmark's sliding block by steps, as a user writes it: in C (newmark.c, compiled here) and in Python with numba.

Both make the same steps, with the mean of the drive in each. The drive is straight between the samples of the record,
so that a record sampled more finely is the same problem.
"""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np
from measure import repeat, require
from problems import Floats
from push_and_sine import AMPLITUDE, DURATION, FREQUENCY, FRICTION, GRAVITY, MOMENTS, PUSH, Attempt, error

SOURCE = Path(__file__).with_name("newmark.c")
OPTIONS = ("-O3", "-march=native", "-shared", "-fPIC")
#: Steps of the block that slides both ways [s].
STEPS = (1e-2, 1e-3, 1e-4, 1e-5)
_ARRAY = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
#: Drive at samples a step apart [m/s2], the step [s], resistances to slip downstream and upstream [m/s2]; the slip at
#: every sample comes back [m].
Walk = Callable[[Floats, float, float, float], Floats]


class Program(NamedTuple):
    """A program for one block, and one for many, each with a factor on the drive and resistances of its own."""

    name: str
    one: Walk
    many: Callable[[Floats, float, Floats, Floats, Floats], Floats]


def programs() -> tuple[list[Program], list[str]]:
    """Return the programs that are there, and why the others are not."""
    found, missing = [], []
    for name, make in (("Newmark in C", in_c), ("Newmark in numba", in_numba)):
        try:
            found.append(Program(name, *make()))
        except (ImportError, OSError) as reason:
            missing.append(f"Not measured: {name} ({reason}).")
    return found, missing


def attempts() -> list[Attempt]:
    """Slide the block of push_and_sine.py both ways, by each program at each step."""
    limit, tried = FRICTION * GRAVITY, []
    for program in programs()[0]:
        for step in STEPS:
            time = np.arange(round(DURATION / step) + 1) * step
            drive = PUSH - AMPLITUDE * np.sin(2.0 * np.pi * FREQUENCY * time)
            slip = program.one(drive, step, limit, limit)[np.round(MOMENTS / step).astype(int)]
            timing = repeat(partial(program.one, drive, step, limit, limit))
            tried.append(Attempt(program.name, "sine sampled", step, error(slip), timing))
    return tried


@cache
def in_c() -> tuple[Walk, Callable[[Floats, float, Floats, Floats, Floats], Floats]]:
    """Compile the C program into a folder that goes again, and return its functions."""
    compiler = shutil.which("cc")
    if compiler is None:
        raise ImportError("there is no cc")
    with TemporaryDirectory() as folder:
        library = Path(folder) / "newmark.so"
        done = subprocess.run([compiler, *OPTIONS, str(SOURCE), "-o", str(library)], capture_output=True, check=False)
        require(done.returncode == 0, f"cc: {done.stderr.decode(errors='replace')[-300:]}")
        loaded = ctypes.CDLL(str(library))
    count, number = ctypes.c_long, ctypes.c_double
    loaded.newmark.argtypes = [_ARRAY, count, number, number, number, _ARRAY]
    loaded.newmark_many.argtypes = [_ARRAY, count, number, count, _ARRAY, _ARRAY, _ARRAY, _ARRAY]
    for function in (loaded.newmark, loaded.newmark_many):
        function.restype = None

    def one(drive: Floats, step: float, down: float, up: float) -> Floats:
        slip = np.empty(drive.size)
        loaded.newmark(drive, drive.size, step, down, up, slip)
        return slip

    def many(drive: Floats, step: float, scale: Floats, down: Floats, up: Floats) -> Floats:
        slip = np.empty(scale.size)
        loaded.newmark_many(drive, drive.size, step, scale.size, scale, down, up, slip)
        return slip

    return one, many


@cache
def in_numba() -> tuple[Walk, Callable[[Floats, float, Floats, Floats, Floats], Floats]]:
    """Return the same functions, which numba compiles at their first call."""
    from numba import njit

    def walk(drive: Floats, step: float, scale: float, down: float, up: float, slip: Floats) -> float:
        speed = place = 0.0
        for k in range(drive.size - 1):
            pull = 0.5 * scale * (drive[k] + drive[k + 1])
            if speed != 0.0 or pull > down or pull < -up:
                friction = down if speed > 0.0 or (speed == 0.0 and pull > 0.0) else -up
                rate = pull - friction
                after, time = speed + rate * step, step
                if speed * after < 0.0:
                    time, after = -speed / rate, 0.0
                place += time * (speed + 0.5 * rate * time)
                speed = after
            if slip.size:
                slip[k + 1] = place
        return place

    slide = njit(walk)

    def blocks(drive: Floats, step: float, scale: Floats, down: Floats, up: Floats) -> Floats:
        slip, none = np.empty(scale.size), np.empty(0)
        for k in range(scale.size):
            slip[k] = slide(drive, step, scale[k], down[k], up[k], none)
        return slip

    def one(drive: Floats, step: float, down: float, up: float) -> Floats:
        slip = np.zeros(drive.size)
        slide(drive, step, 1.0, down, up, slip)
        return slip

    return one, njit(blocks)
