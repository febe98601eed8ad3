"""One problem for each independent code, and how wrong it and heeltoe are."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from problems import STEP, G, el_centro
from push_and_sine import Attempt, error, ours

#: Steps of the engines [s]; heeltoe samples the sine as finely.
STEPS = (1e-2, 1e-3, 1e-4)
TOLERANCES = (1e-6, 1e-10)
#: Steps of Siconos for rigid blocks, and those that stand for its limit: with two blocks, and with one shaken both ways
#: [s].
BLOCK_STEPS, BLOCK_LIMIT, CIRCLE_LIMIT = (1e-3, 1e-4), 2.5e-5, 1e-5
YIELD, PEAK = 0.1, 0.4


@dataclass(frozen=True)
class Solved:
    """How wrong a program is at a step, and heeltoe beside it.

    Attributes
    ----------
    settings, step
        How it was told to solve the problem.
    error, ours, unit
        Largest errors, of the program and of heeltoe.
    """

    settings: str
    step: str
    error: float
    ours: float
    unit: str = ""


def mujoco() -> list[Solved]:
    """Slide the block both ways with MuJoCo."""
    import peer_mujoco

    return [_best(peer_mujoco.attempts(step), step) for step in STEPS]


def pybullet() -> list[Solved]:
    """Slide the block both ways with PyBullet."""
    import peer_pybullet

    return [_best(peer_pybullet.attempts(step), step) for step in STEPS]


def _best(tried: list[Attempt], step: float) -> Solved:
    best = min(tried, key=lambda attempt: attempt.error)
    return Solved(best.settings, f"{step:g} s", 1e3 * best.error, 1e3 * ours(step).error, "mm")


def pyslammer() -> list[Solved]:
    """Slide the block one way with pySLAMMER."""
    import one_way
    import peer_pyslammer
    from exact import slip_one_way

    motion = el_centro()[0].scaled_to(PEAK * G)
    exact = slip_one_way(motion.acceleration, STEP, YIELD * G)
    mine = float(np.abs(one_way.our_slip(motion, YIELD) - exact).max())
    result = []
    for step in STEPS[:2]:
        slip = peer_pyslammer.slip(peer_pyslammer.record(motion, step), YIELD)[:: round(STEP / step)]
        wrong = float(np.abs(slip - exact).max())
        result.append(Solved("rigid", f"{step:g} s", wrong / exact[-1], mine / exact[-1]))
    return result


def opensees() -> list[Solved]:
    """Slide the elastic block with OpenSees."""
    import peer_opensees

    steps = ((0.004, "Newmark 1, 0.5625"), (0.00125, "Newmark 1, 0.5625"))
    return [_elastic(peer_opensees.sliding_block(step, name, repetitions=1).slip, name, step) for step, name in steps]


def siconos() -> list[Solved]:
    """Slide the elastic block with Siconos."""
    import peer_siconos

    name = "theta 0.7, Lemke"
    return [_elastic(peer_siconos.sliding_block(step, name, repetitions=1).slip, name, step) for step in (0.01, 0.001)]


def siconos_blocks() -> list[Solved]:
    """Rock and slide two blocks, one on the other, with Siconos."""
    import peer_siconos

    # The blocks are those of the tests.
    sys.path.append(str(Path(__file__).parents[1] / "tests"))
    from shared.stacks import STACKS, at_samples, pulse

    result = []
    for name, (stack, size) in STACKS.items():
        time, ground = pulse(size, rest=1.5)
        problem = stack.problem(time, ground)
        *coarse, limit = (
            at_samples(time, np.arange(round(time[-1] / step) + 1) * step, peer_siconos.rigid_blocks(problem, step))
            for step in (*BLOCK_STEPS, BLOCK_LIMIT)
        )
        # The columns of Siconos are gaps and slips of corners; ours slip, heel and toe gap of each crack.
        mine = float(np.abs(stack.exact(time, ground) - limit[:, [4, 0, 1, 6, 2, 3]]).max())
        for step, seen in zip(BLOCK_STEPS, coarse, strict=True):
            wrong = float(np.abs(seen - limit).max())
            result.append(Solved(f"both {name}, Gauss-Seidel", f"{step:g} s", 1e3 * wrong, 1e3 * mine, "mm"))
    return result


def siconos_circle() -> list[Solved]:
    """Shake a block both ways with Siconos."""
    import both_ways
    import peer_siconos

    result = []
    for name, shaken in both_ways.BLOCKS.items():
        problem, time = shaken.problem(), both_ways.TIME
        # Both corners slip alike.
        *coarse, limit = (
            peer_siconos.rigid_blocks(problem, step)[:: round(time[1] / step), [0, 1, 2, 4]]
            for step in (*BLOCK_STEPS, CIRCLE_LIMIT)
        )
        mine = float(np.abs(shaken.ours() - limit).max())
        for step, seen in zip(BLOCK_STEPS, coarse, strict=True):
            wrong = float(np.abs(seen - limit).max())
            result.append(Solved(f"it {name}, Gauss-Seidel", f"{step:g} s", 1e3 * wrong, 1e3 * mine, "mm"))
    return result


def _elastic(slip: tuple[float, ...], settings: str, step: float) -> Solved:
    import crack_peers

    shaken = crack_peers.our_block(16)
    # Ours at its own quickest step among those that hold the limit.
    mine = error(shaken.run(1e-3, crack_peers.INTERVAL).frames.slip[1:])
    return Solved(settings, f"{step:g} s", 1e3 * error(np.array(slip)), 1e3 * mine, "mm")


def siconos_version() -> str:
    """Return what Debian has of Siconos."""
    call = ["dpkg-query", "-W", "-f", "${Version}", "python3-siconos"]
    try:
        return subprocess.run(call, capture_output=True, text=True, check=True).stdout.strip() or "unknown"
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def scipy() -> list[Solved]:
    """Let the block rock with SciPy's integrator."""
    import rocking_peers

    exact = np.array(rocking_peers.exact_impacts())
    case = rocking_peers.block_case()
    block = rocking_peers.build_block(case)
    mine = np.array(rocking_peers.ours_impacts(block, rocking_peers.varying(case, block)))

    def wrong(found: np.ndarray) -> float:
        return float(np.abs(found / exact - 1.0).max())

    return [
        Solved("DOP853", f"{item:.0e}", wrong(np.array(rocking_peers.scipy_impacts(item))), wrong(mine))
        for item in TOLERANCES
    ]
