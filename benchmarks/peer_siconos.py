"""Siconos on the push-and-sine block made elastic, on two rigid blocks, one on the other, and on a block whose ground
shakes both ways: Moreau and Jean's time stepping, contact without a penalty.

Siconos is not on PyPI. Debian has it (python3-siconos) for its own Python and its own NumPy, which another interpreter
cannot load; so this file calls itself: `sliding_block` hands the matrices to an interpreter that has Siconos, and what
runs there is timed there. Siconos has no finite elements for plane bodies, so elastic_block.py makes the matrices.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from elastic_block import Floats, Result, matrices, mesh, steps_between
from measure import Skipped, Timing, repeat, require

# Found by trying on this very problem. Theta is that of the time stepping: one half keeps the energy of vibrations and
# flutters, 0.55 wears them out down to steps of 2e-4 s but at 1e-4 s pivoting breaks off and the block flies away, 0.7
# has held at every step. Lemke's pivoting solves the contact exactly in about 27 pivots however stiff the block is;
# projected Gauss-Seidel needs up to a thousand sweeps at large steps and catches up at small ones.
SETTINGS: dict[str, dict[str, Any]] = {
    "theta 0.5, Lemke": {"theta": 0.5},
    "theta 0.55, Lemke": {"theta": 0.55},
    "theta 0.7, Lemke": {"theta": 0.7},
    "theta 1, Lemke": {"theta": 1.0},
    "theta 0.55, Gauss-Seidel": {"theta": 0.55, "solver": "SICONOS_FRICTION_2D_NSGS", "tolerance": 1e-6},
}
#: Error of the residual slip, and the quickest step and setting that reach it and hold it at every smaller step tried.
BEST = {
    0.1: (0.1, "theta 0.7, Lemke"),
    0.01: (0.01, "theta 0.7, Lemke"),
    0.001: (0.001, "theta 0.7, Lemke"),
}


@cache
def _problem(nodes: int) -> dict[str, Any]:
    """Everything the steps need, in modal coordinates: all modes, so that nothing is lost."""
    # Not at the head of the file: the interpreter that has Siconos has none of this.
    from push_and_sine import (
        AMPLITUDE,
        DEPTH,
        DURATION,
        FREQUENCY,
        FRICTION,
        GRAVITY,
        HEIGHT,
        INTERVAL,
        MASS,
        PUSH,
        WIDTH,
    )

    stiffness, mass = matrices(nodes, WIDTH, HEIGHT, MASS / (WIDTH * HEIGHT * DEPTH))
    numbers, _ = mesh(nodes)
    base = np.array([number for place, number in sorted(numbers.items()) if place[1] == 0])
    inverse = np.linalg.inv(np.linalg.cholesky(mass))
    squares, vectors = np.linalg.eigh(inverse @ stiffness @ inverse.T)
    modes = inverse.T @ vectors
    # Free motions of the whole; what eigh gives for them is rounding.
    squares[:3] = 0.0
    along = mass[:, 0::2].sum(axis=1)
    force = PUSH * along - GRAVITY * mass[:, 1::2].sum(axis=1)
    # At rest with its base bonded, as the elastic model starts.
    still = np.concatenate([2 * base, 2 * base + 1])
    free = np.setdiff1d(np.arange(mass.shape[0]), still)
    rest = np.zeros(mass.shape[0])
    rest[free] = np.linalg.solve(stiffness[np.ix_(free, free)], force[free])
    return {
        "squares": squares,
        "start": modes.T @ mass @ rest,
        "force": modes.T @ force,
        "along": modes.T @ along,
        "base_along": modes[2 * base],
        "base_up": modes[2 * base + 1],
        "friction": FRICTION,
        "interval": INTERVAL,
        "duration": DURATION,
        "amplitude": AMPLITUDE,
        "frequency": FREQUENCY,
    }


@cache
def _interpreter() -> tuple[str, str]:
    """An interpreter that has Siconos, this one or the system's, and what else is to be said of it.

    Raises
    ------
    Skipped
        Where none has it.
    """
    reason = "not even an interpreter"
    for candidate in (sys.executable, shutil.which("python3", path=os.defpath)):
        if candidate is None:
            continue
        call = [candidate, "-c", "import numpy, siconos.kernel as k, siconos.numerics; print(numpy.__version__)"]
        answer = subprocess.run(call, capture_output=True, text=True, check=False, env=_environment())
        if answer.returncode == 0:
            return candidate, f"its interpreter has NumPy {answer.stdout.strip()}"
        reason = (answer.stderr.strip().splitlines() or [f"code {answer.returncode}"])[-1]
    raise Skipped(f"no interpreter here has Siconos ({reason}); Debian's package is python3-siconos")


def _environment() -> dict[str, str]:
    # One thread as for everyone else, and none of this interpreter's packages in the other.
    kept = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV")}
    return kept | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def sliding_block(
    step: float, settings: str = "theta 0.7, Lemke", nodes: int = 4, repetitions: int = 3, keep: bool = True
) -> Result:
    """Slide the elastic block.

    Parameters
    ----------
    step
        Time step, a part of the moments' interval [s].
    settings
        One of `SETTINGS`.
    nodes
        Of each element, 4 or 8.
    repetitions
        How often it is timed, unless it takes long.
    keep
        Whether Siconos is told that its contact matrix stays the same while all nodes are in contact. Left alone it
        works the matrix out anew at every step, which takes nearly all the time and changes nothing.

    Raises
    ------
    Skipped
        Where Siconos is not installed.
    NothingMeasured
        Where it breaks down.
    """
    program, note = _interpreter()
    steps_between(float(_problem(nodes)["interval"]), step)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.npz"
        np.savez(path, **_problem(nodes))
        order = {"step": step, "repetitions": repetitions, "keep": keep, **SETTINGS[settings]}
        call = [program, str(Path(__file__).resolve()), str(path), json.dumps(order)]
        answer = subprocess.run(call, capture_output=True, text=True, check=False, env=_environment())
    require(answer.returncode == 0, f"Siconos broke down: {answer.stderr.strip()[-300:]}")
    document = json.loads(answer.stdout.strip().splitlines()[-1])
    notes = [f"{nodes}-node elements, {document['sweeps']:.3g} iterations of the contact per step", note]
    if document["unsolved"]:
        notes.append(f"contact not solved to tolerance in {document['unsolved']} steps")
    if document["renewed"] > 1:
        notes.append(f"contact matrix worked out anew in {document['renewed']} steps")
    return Result(
        "Siconos",
        settings,
        step,
        document["steps"],
        tuple(document["slip"]),
        document["ringing"],
        bool(np.isfinite(document["slip"]).all()),
        Timing(tuple(document["wall"]), tuple(document["cpu"])),
        "; ".join(notes),
    )


def rigid_blocks(problem: dict[str, Floats], step: float) -> Floats:
    """Move rigid blocks by small steps.

    Parameters
    ----------
    problem
        `mass` (n,) of the motions; `gaps` and `slips` (c, n), rows of the corners, and `crosses` (c, n) where they slip
        across the plane, too; `friction`, `bounce` (c,) of them; `force` and `along` (n,), the weights and what an
        acceleration of the ground moves, and `across` (n,) of one across the plane; `time` and `ground` (k,), the
        samples of the motion, and `ground_across` (k,).
    step
        Time step [s].

    Returns
    -------
    ndarray, shape (k + 1, 2 c) or (k + 1, 3 c)
        Gaps and slips of the corners at each step, and slips across.

    Raises
    ------
    Skipped
        Where Siconos is not installed.
    """
    program, _ = _interpreter()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.npz"
        np.savez(path, **problem)
        call = [program, str(Path(__file__).resolve()), str(path), json.dumps({"blocks": step})]
        answer = subprocess.run(call, capture_output=True, text=True, check=False, env=_environment())
        require(answer.returncode == 0, f"Siconos broke down: {answer.stderr.strip()[-300:]}")
        seen: Floats = np.load(path.with_suffix(".npy"))
    return seen


def _rock(problem: dict[str, Any], step: float, path: Path) -> None:
    """Make the steps of `rigid_blocks`, inside the interpreter that has Siconos."""
    from siconos import kernel, numerics

    size, end = problem["mass"].size, float(problem["time"][-1])
    body = kernel.LagrangianLinearTIDS(np.zeros(size), np.zeros(size), np.diag(problem["mass"]))
    body.setFExtPtr(kernel.SiconosVector(size))
    world = kernel.NonSmoothDynamicalSystem(0.0, end + 1.0)
    world.insertDynamicalSystem(body)
    names = ("gaps", "slips", "crosses") if "crosses" in problem else ("gaps", "slips")
    rows = np.stack([problem[name] for name in names], axis=1)
    for row, friction, bounce in zip(rows, problem["friction"], problem["bounce"], strict=True):
        law = kernel.NewtonImpactFrictionNSL(float(bounce), 0.0, float(friction), len(names))
        relation = kernel.LagrangianLinearTIR(row, np.zeros(len(names)))
        world.link(kernel.Interaction(law, relation), body)
    # Pivoting and enumeration let blocks that stand creep by millimetres; projections do not.
    solver = numerics.SICONOS_FRICTION_2D_NSGS if len(names) == 2 else numerics.SICONOS_FRICTION_3D_NSGS
    contact = kernel.FrictionContact(len(names), solver)
    contact.setMStorageType(1)
    options = contact.numericsSolverOptions()
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = 100_000
    options.dparam[numerics.SICONOS_DPARAM_TOL] = 1e-12
    clock, scheme = kernel.TimeDiscretisation(0.0, step), kernel.MoreauJeanOSI(0.5)
    simulation = kernel.TimeStepping(world, clock, scheme, contact)
    simulation.setNewtonOptions(kernel.SICONOS_TS_LINEAR)
    count = round(end / step)
    middle = (np.arange(count) + 0.5) * step
    ground = [np.interp(middle, problem["time"], problem["ground"])]
    drive = [problem["along"]]
    if "across" in problem:
        ground.append(np.interp(middle, problem["time"], problem["ground_across"]))
        drive.append(problem["across"])
    forces = problem["force"] + np.column_stack(ground) @ np.array(drive)
    force, place, both = body.fExt(), body.q(), np.concatenate([problem[name] for name in names])
    seen = np.zeros((count + 1, len(both)))
    for k in range(count):
        force[:] = forces[k]
        simulation.computeOneStep()
        simulation.nextStep()
        seen[k + 1] = both @ place
    np.save(path, seen)


class _Run:
    """The block in Siconos, ready to step; only where Siconos is installed."""

    # A gap below this counts as contact [m]: ten times the compression by the weight, a millionth of the slip.
    # Without it nodes that hover by rounding drop out of the contact problem and come back at every step.
    NEAR = 1e-6
    # Nodes start this deep in the ground, which makes them touch beyond rounding [m].
    DEEP = 1e-9

    def __init__(
        self,
        problem: dict[str, Any],
        step: float,
        keep: bool,
        theta: float,
        solver: str = "SICONOS_FRICTION_2D_LEMKE",
        tolerance: float = 1e-8,
    ) -> None:
        from siconos import kernel, numerics

        self.problem, self.step, self.keep, self.tolerance = problem, step, keep, tolerance
        size = problem["start"].size
        self.body = kernel.LagrangianLinearTIDS(problem["start"].copy(), np.zeros(size), np.eye(size))
        self.body.setKPtr(np.diag(problem["squares"]))
        self.body.setFExtPtr(kernel.SiconosVector(size))
        world = kernel.NonSmoothDynamicalSystem(0.0, float(problem["duration"]) + 1.0)
        world.insertDynamicalSystem(self.body)
        law = kernel.NewtonImpactFrictionNSL(0.0, 0.0, float(problem["friction"]), 2)
        for up, along in zip(problem["base_up"], problem["base_along"], strict=True):
            relation = kernel.LagrangianLinearTIR(np.vstack([up, along]), np.array([-self.DEEP, 0.0]))
            world.link(kernel.Interaction(law, relation), self.body)
        self.scheme = kernel.MoreauJeanOSI(theta)
        self.scheme.setConstraintActivationThreshold(self.NEAR)
        self.scheme.setIsWSymmetricDefinitePositive(True)
        self.contact = kernel.FrictionContact(2, getattr(numerics, solver))
        # Small dense blocks suit Gauss-Seidel; it then needs fewer sweeps.
        self.contact.setMStorageType(int(solver.endswith("NSGS")))
        self.contact.setKeepLambdaAndYState(True)
        self.options = self.contact.numericsSolverOptions()
        self.options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = 1000
        self.options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
        self.iterations, self.residual = numerics.SICONOS_IPARAM_ITER_DONE, numerics.SICONOS_DPARAM_RESIDU
        self.clock = kernel.TimeDiscretisation(0.0, step)
        self.simulation = kernel.TimeStepping(world, self.clock, self.scheme, self.contact)
        self.simulation.setNewtonOptions(kernel.SICONOS_TS_LINEAR)
        self.simulation.setComputeResiduY(False)
        self.simulation.setComputeResiduR(False)
        self.simulation.setWarnOnNonConvergence(False)
        self.slip: list[float] = []
        self.ringing, self.sweeps, self.unsolved, self.renewed = 0.0, 0, 0, 0

    def solve(self) -> None:
        """Make all steps."""
        problem, every = self.problem, steps_between(float(self.problem["interval"]), self.step)
        count = every * round(float(problem["duration"] / problem["interval"]))
        # The force in the middle of each step, which serves best.
        middle = (np.arange(count) + 0.5) * self.step
        ground = -float(problem["amplitude"]) * np.sin(2.0 * np.pi * float(problem["frequency"]) * middle)
        force, place, speed = self.body.fExt(), self.body.q(), self.body.velocity()
        touching = True
        for k in range(count):
            np.multiply(problem["along"], ground[k], out=force)
            np.add(force, problem["force"], out=force)
            self.simulation.computeOneStep()
            self.simulation.nextStep()
            self.sweeps += int(self.options.iparam[self.iterations])
            self.unsolved += bool(self.options.dparam[self.residual] > self.tolerance)
            # Siconos takes a node into the next contact problem by its gap half a step ahead. The matrix may stay
            # where all nodes were in the last problem and will be in the next.
            before, touching = touching, self._near(place, speed)
            stays = self.keep and before and touching
            self.contact.setHasBeenUpdated(stays)
            self.renewed += not stays
            if (k + 1) % every == 0:
                along = problem["base_along"]
                self.slip.append(float((along @ place).mean()))
                self.ringing = max(self.ringing, float(np.ptp(along @ speed)))

    def _near(self, place: Floats, speed: Floats) -> bool:
        ahead = self.problem["base_up"] @ (place + 0.5 * self.step * speed)
        return bool(ahead.max() - self.DEEP < 0.9 * self.NEAR)


def _work(path: str, order: str) -> str:
    """Do what `sliding_block` asked for, inside the interpreter that has Siconos."""
    with np.load(path) as file:
        problem = {name: file[name] for name in file.files}
    told = json.loads(order)
    if "blocks" in told:
        _rock(problem, told["blocks"], Path(path).with_suffix(".npy"))
        return ""
    repetitions = told.pop("repetitions")
    run = _Run(problem, **told)

    def prepare() -> None:
        nonlocal run
        run = _Run(problem, **told)

    timing = repeat(lambda: run.solve(), repetitions, prepare)
    steps = len(run.slip) * steps_between(float(problem["interval"]), run.step)
    answer = {"slip": run.slip, "ringing": run.ringing, "sweeps": run.sweeps / steps, "unsolved": run.unsolved}
    return json.dumps(answer | {"renewed": run.renewed, "steps": steps, "wall": timing.wall, "cpu": timing.cpu})


if __name__ == "__main__":
    print(_work(*sys.argv[1:]))
