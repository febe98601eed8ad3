"""An elastic block that rocks: ours beside the macroelement RockingBC of OpenSees (Avgenakis and Psycharis 2020).

The block stands on its base and is shaken by one wave of a sine. RockingBC is a beam whose foot bears by a stress that
its own closed form distributes over the part in contact; ours is plane elasticity with contact at every node. They are
two models, so each is compared with its own limit, and the limits with each other.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
import peer_opensees
from measure import NothingMeasured, Skipped, Timing, heading, require, seconds, table
from problems import Floats

from heeltoe import GroundMotion, build_flexible_dam, read_case
from heeltoe.kernel.build import PROFILE
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.motion.earthquake import Earthquake

ops: Any = peer_opensees.ops

COLUMNS = [
    "program",
    "settings",
    "step",
    "largest rotation",
    "relative",
    "time per run",
    "times ours at no larger error",
]
#: The block [m], its concrete [kg/m3], [Pa], and the part of critical damping at its first period, by stiffness alone.
WIDTH, HEIGHT, DENSITY, MODULUS, POISSON, DAMPING = 1.0, 5.0, 2400.0, 20e9, 0.2, 0.05
#: Peak [m/s2] and length [s] of the wave; how long the run is, and what lies between two moments of comparison [s].
GRAVITY = 9.80665
PEAK, PERIOD, DURATION, INTERVAL = 0.27 * GRAVITY, 0.3, 1.0, 0.01
MOMENTS = np.arange(1, round(DURATION / INTERVAL) + 1) * INTERVAL
OUR_STEPS, OUR_LIMIT = (1e-3, 5e-4, 2e-4, 1e-4), 1e-5
ITS_STEPS, ITS_LIMIT = (1e-3, 2e-4, 1e-4), 2e-5
#: Elements along our base, pieces of its beam: of the table, and coarser ones.
ACROSS, PIECES = (16, 8, 32), (16, 8, 32)
#: Control points of its foot, as its authors use.
POINTS = 15


@dataclass(frozen=True)
class Run:
    """The rotation at each of the moments, positive as the block first turns furthest, and the time it took."""

    rotation: Floats
    timing: Timing

    @property
    def largest(self) -> float:
        """Largest rotation either way [rad]."""
        return float(np.abs(self.rotation).max())

    def error(self, limit: Run) -> float:
        """Largest difference from a limit, relative to the largest rotation of that."""
        return float(np.abs(self.rotation - limit.rotation).max()) / limit.largest


def wave(moments: Floats) -> Floats:
    """Return the acceleration of the ground [m/s2]."""
    return np.where(moments <= PERIOD, PEAK * np.sin(2.0 * np.pi * moments / PERIOD), 0.0)


def our_block(across: int) -> ShakenDam:
    """Return the block with so many eight-node elements along its base, ready to be shaken."""
    corners = [[0.0, 0.0], [WIDTH, 0.0], [WIDTH, HEIGHT], [0.0, HEIGHT]]
    case = read_case(
        {
            "gravity": f"{GRAVITY} m/s^2",
            "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
            "concrete": {
                "density": f"{DENSITY} kg/m^3",
                "modulus": f"{MODULUS} Pa",
                "poisson": POISSON,
                "damping": DAMPING,
            },
            # RockingBC's foot does not slide; ours slips by some 0.02 mm.
            "crack": {"friction": 2.0},
            "rock": "rigid",
            "uplift": {"pattern": "none"},
            "flexible": {"elements_across": across, "damping": "stiffness"},
        }
    )
    moments = np.linspace(0.0, DURATION, 10_001)
    ground = GroundMotion.from_points(moments, wave(moments))
    return ShakenDam(case, build_flexible_dam(case), Earthquake(ground, None, DURATION).shaking)


def ours(block: ShakenDam, step: float, repetitions: int = 3) -> Run:
    """Rock our block."""
    rotation = block.run(step, INTERVAL).frames.rotation[1:]
    wall, cpu = [], []
    for _ in range(repetitions):
        start, busy = time.perf_counter(), time.process_time()
        block.run(step)
        wall.append(time.perf_counter() - start)
        cpu.append(time.process_time() - busy)
    return Run(np.asarray(rotation), Timing(tuple(wall), tuple(cpu)))


def its_block(pieces: int, damping: float) -> None:
    """Build the beam on its RockingBC element, and let its weight act.

    Parameters
    ----------
    pieces
        Of the beam, whose masses are at the nodes between them; the first is the macroelement.
    damping
        Factor on the stiffness [s].
    """
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    piece, inertia = HEIGHT / pieces, WIDTH**3 / 12.0
    for node in range(pieces + 1):
        ops.node(node + 1, 0.0, piece * node)
    ops.fix(1, 1, 1, 1)
    # Friction 0 stands for a foot that does not slide; concrete that never yields. The rest is its authors' example.
    options = {
        "-convlim": 1e-15,
        "-useshear": 0,
        "-blevery": 1,
        "-useUelNM": 1,
        "-usecomstiff": 0,
        "-af": 1.0,
        "-aflim": 0.4,
        "-convlimmult": 1.0,
        "-maxtries": 50,
        "-NlimN": 0.001,
        "-NlimT": 1.0,
        "-Dtlim": 1e-8,
        "-errorifNexceeds": 0,
    }
    material = (MODULUS, POISSON, -1e15, WIDTH, 1.0, 0.0)
    ops.element("RockingBC", 1, 2, 1, POINTS, *material, *(item for pair in options.items() for item in pair))
    ops.geomTransf("Corotational", 1)
    for node in range(2, pieces + 1):
        ops.element("elasticBeamColumn", node, node, node + 1, WIDTH, MODULUS, inertia, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for node in range(2, pieces + 2):
        length = piece * (1.5 if node == 2 else 0.5 if node == pieces + 1 else 1.0)
        mass = DENSITY * WIDTH * length
        ops.mass(node, mass, mass, DENSITY * inertia * length)
        ops.load(node, 0.0, -mass * GRAVITY, 0.0)
    _analysis("Static", ("EnergyIncr", 1e-10, 100), ("LoadControl", 0.1))
    require(ops.analyze(10) == 0, "RockingBC does not stand")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    ops.rayleigh(0.0, damping, 0.0, 0.0)
    points = wave(np.arange(0.0, DURATION + 1e-3, 1e-4))
    ops.timeSeries("Path", 2, "-dt", 1e-4, "-values", *points, "-factor", 1.0)
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    _analysis("Transient", ("RelativeNormUnbalance", 1e-8, 100), ("Newmark", 0.5, 0.25))


def _analysis(kind: str, test: tuple[object, ...], integrator: tuple[object, ...]) -> None:
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test(*test)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


@contextmanager
def _silent() -> Iterator[None]:
    """Keep what the library prints away from the terminal: a line for each search that it gives up, thousands of
    them."""
    kept = os.dup(1), os.dup(2)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        for descriptor, target in zip(kept, (1, 2), strict=True):
            os.dup2(descriptor, target)
            os.close(descriptor)
        os.close(nowhere)


def its(pieces: int, step: float, damping: float) -> Run:
    """Rock the block of OpenSees, once.

    Raises
    ------
    NothingMeasured
        Where it stops converging.
    """
    every, rotation = round(INTERVAL / step), []
    with _silent():
        its_block(pieces, damping)
        start, busy = time.perf_counter(), time.process_time()
        for _ in MOMENTS:
            if ops.analyze(every, step) != 0:
                raise NothingMeasured(f"RockingBC with {pieces} pieces stops at {ops.getTime():.3g} s, step {step:g} s")
            # At half the height; upstream is positive there.
            rotation.append(-ops.nodeDisp(pieces // 2 + 1, 3))
        timing = Timing((time.perf_counter() - start,), (time.process_time() - busy,))
    return Run(np.array(rotation), timing)


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    if ops is None:
        raise Skipped(f"OpenSeesPy cannot be loaded: {peer_opensees.MISSING}; on Debian it also needs libblas3")
    blocks = {across: our_block(across) for across in ACROSS}
    first, *_ = blocks.values()
    damping = 2.0 * DAMPING * float(first.dam.periods[0]) / (2.0 * np.pi)
    limits = {across: ours(block, OUR_LIMIT, 1) for across, block in blocks.items()}
    # Other meshes at a step where it differs little from its limit.
    steps = [ITS_LIMIT] + [ITS_STEPS[-1]] * (len(PIECES) - 1)
    ends = {pieces: its(pieces, step, damping) for pieces, step in zip(PIECES, steps, strict=True)}
    mine, theirs = limits[ACROSS[0]], ends[PIECES[0]]
    own = [(step, ours(first, step)) for step in OUR_STEPS]
    lines, remarks = [], []
    for step, run in own:
        lines.append(_line("heeltoe", f"{ACROSS[0]} across", step, run, mine, ""))
    for step in ITS_STEPS:
        try:
            run = its(PIECES[0], step, damping)
        except NothingMeasured as reason:
            remarks.append(f"Broke down: {reason}.")
            continue
        good = [item for _, item in own if item.error(mine) <= run.error(theirs)]
        quickest = min((item.timing.median for item in good), default=0.0)
        ratio = f"{run.timing.median / quickest:,.0f} ({seconds(quickest)})" if quickest else "none of ours is as exact"
        lines.append(_line("OpenSees RockingBC", f"{PIECES[0]} pieces", step, run, theirs, ratio))
    text = (
        f"Elastic block of {WIDTH:g} m by {HEIGHT:g} m, {MODULUS / 1e9:g} GPa, {DAMPING:.0%} damping by stiffness, "
        f"shaken by one sine of {PEAK / GRAVITY:g} g and {PERIOD:g} s, for {DURATION:g} s. Errors are the largest of "
        f"the rotation at any {INTERVAL:g} s, relative to its largest value, against the same model with steps of "
        f"{OUR_LIMIT:g} s (ours) and {ITS_LIMIT:g} s (RockingBC). Building the models is not in the times."
    )
    sizes = [
        [
            f"{across} across, {pieces} pieces",
            f"{1e3 * limits[across].largest:.2f}",
            f"{1e3 * ends[pieces].largest:.2f}",
        ]
        for across, pieces in sorted(zip(ACROSS, PIECES, strict=True))
    ]
    limit_text = (
        "The limits themselves, largest rotation [mrad]. RockingBC is a beam, without shear as its authors use it, and "
        "loses its hold as it leans; ours is a plane at small rotations."
    )
    return "\n\n".join(
        [
            heading("Elastic block that rocks", ["heeltoe", "openseespy", "numpy"]),
            text,
            table(COLUMNS, lines),
            limit_text,
            table(["mesh", "heeltoe", "RockingBC"], sizes),
            *remarks,
        ]
    )


def _line(program: str, settings: str, step: float, run: Run, limit: Run, ratio: str) -> list[str]:
    largest, error = f"{1e3 * run.largest:.3f} mrad", f"{run.error(limit):.1%}"
    return [program, settings, f"{step:g} s", largest, error, seconds(run.timing.median), ratio]


if __name__ == "__main__":
    print(report())
