"""OpenSees on the push-and-sine block made elastic, at the settings that serve it best there.

The block stands on nodes of the ground, each joined to a node of its base by a zeroLengthContact2D: a penalty with
Coulomb's friction whose direction is fixed, so that it holds for a plane however far the block slides. Loads act in the
frame of the ground. Of what OpenSees has for contact this alone is quick and dependable here:

- zeroLengthContactASDimplex takes 20 to 80 iterations per step or fails to converge; its explicit variant ("IMPL-EX")
  loses half the slip at 0.01 s and 8 % at 0.001 s;
- flatSliderBearing with Coulomb friction fails at steps of 0.01 s and above a penalty of 1e8 to 1e9 N/m, and takes
  twice the time where it works;
- SimpleContact2D with its Lagrange multipliers does not converge once the block slides;
- explicit integrators (CentralDifference, ExplicitDifference) must make steps of 2e-5 s or less, which takes from 17 s
  to a minute, and undamped they slide some per cent too far.

OpenSeesPy brings all its libraries but BLAS (Debian: libblas3).
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from elastic_block import ALONG, MODULUS, POISSON, UP, Result, mesh, steps_between
from measure import Skipped, repeat
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

try:
    import openseespy.opensees as ops
except (ImportError, RuntimeError) as error:
    # It hides a missing library behind errors of its own.
    reason: BaseException = error
    while reason.__context__ is not None:
        reason = reason.__context__
    ops, MISSING = None, str(reason)

# Found by trying on this very problem: these integrators, each with penalties of 1e9 to 1e11 N/m, which hardly matter
# (softer than 1e9 they spoil the slip by some per cent at small steps). HHT, generalised alpha and Wilson's theta fail.
# Newton's method is the only one that gets through, for friction changes the tangent; a band solver is the
# quickest for so few freedoms; a tolerance of 1 N on 9810 N of weight changes nothing that is seen.
SETTINGS: dict[str, tuple[Any, ...]] = {
    "Newmark 0.5, 0.25": ("Newmark", 0.5, 0.25),
    "Newmark 0.6, 0.3025": ("Newmark", 0.6, 0.3025),
    "Newmark 0.7, 0.36": ("Newmark", 0.7, 0.36),
    "Newmark 1, 0.5625": ("Newmark", 1.0, 0.5625),
    "TRBDF2": ("TRBDF2",),
    "backward Euler": ("BackwardEuler",),
}
TOLERANCE, MOST_ITERATIONS = 1.0, 30
#: Error of the residual slip, and the quickest step and setting that reach it and hold it at every smaller step tried.
BEST = {
    0.1: (0.025, "Newmark 1, 0.5625"),
    0.01: (0.004, "Newmark 1, 0.5625"),
    0.001: (0.00125, "Newmark 1, 0.5625"),
}

# Part of an element's mass at each of its nodes, those of a corner and of the middle of a side.
SHARES = {4: (1 / 4, 0.0), 8: (-1 / 12, 1 / 3)}
#: Elements and their nodes. The first is one point with stabilisation and the quickest; the last is the mesh of ours.
ELEMENTS = {"SSPquad": 4, "quad": 4, "quad8n": 8}


def _build(element: str, penalty: float) -> list[int]:
    """Build the block at rest under its weight and push; return the nodes of its base."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    nodes = ELEMENTS[element]
    numbers, elements = mesh(nodes)
    base = []
    for (i, j), number in numbers.items():
        ops.node(number, WIDTH * i / (2 * ALONG), HEIGHT * j / (2 * UP))
        if j == 0:
            base.append(number)
    ops.nDMaterial("ElasticIsotropic", 1, MODULUS, POISSON, MASS / (WIDTH * HEIGHT * DEPTH))
    weights = dict.fromkeys(numbers.values(), 0.0)
    corner, side = SHARES[nodes]
    for tag, around in enumerate(elements):
        if element == "SSPquad":
            ops.element(element, tag, *around, 1, "PlaneStress", DEPTH)
        else:
            ops.element(element, tag, *around, DEPTH, "PlaneStress", 1)
        for k, number in enumerate(around):
            weights[number] += (corner if k < 4 else side) * MASS / len(elements)
    for tag, number in enumerate(base, len(elements)):
        ground = len(numbers) + number
        ops.node(ground, *ops.nodeCoord(number))
        ops.fix(ground, 1, 1)
        ops.element("zeroLengthContact2D", tag, number, ground, penalty, penalty, FRICTION, "-normal", 0, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for number, mass in weights.items():
        ops.load(number, PUSH * mass, -GRAVITY * mass)
    return base


def _analysis(kind: str, tolerance: float, integrator: tuple[Any, ...]) -> None:
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", tolerance, MOST_ITERATIONS, 0)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


class _Run:
    """The block in OpenSees, ready to step. OpenSees has one model at a time."""

    def __init__(self, step: float, integrator: tuple[Any, ...], penalty: float, element: str) -> None:
        self.step = step
        self.base = _build(element, penalty)
        _analysis("Static", 1e-3 * TOLERANCE, ("LoadControl", 1.0))
        self.stands = ops.analyze(1) == 0
        ops.loadConst("-time", 0.0)
        ops.wipeAnalysis()
        # The ground's motion enters as the force of inertia on all masses.
        ops.timeSeries("Trig", 2, 0.0, DURATION + 1.0, 1.0 / FREQUENCY, "-factor", AMPLITUDE)
        ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
        _analysis("Transient", TOLERANCE, integrator)
        self.rest = self._mean()
        self.slip: list[float] = []
        self.ringing = 0.0
        self.finished = False

    def _mean(self) -> float:
        return float(np.mean([ops.nodeDisp(number, 1) for number in self.base]))

    def solve(self) -> None:
        """Make all steps, those between two moments in one call, without Python between them."""
        every = steps_between(INTERVAL, self.step)
        for _ in range(round(DURATION / INTERVAL)):
            if not self.stands or ops.analyze(every, self.step) != 0:
                return
            self.slip.append(self._mean() - self.rest)
            self.ringing = max(self.ringing, float(np.ptp([ops.nodeVel(number, 1) for number in self.base])))
        self.finished = True


def sliding_block(
    step: float,
    settings: str = "Newmark 1, 0.5625",
    penalty: float = 1e10,
    element: str = "SSPquad",
    repetitions: int = 3,
) -> Result:
    """Slide the elastic block.

    Parameters
    ----------
    step
        Time step, a part of the moments' interval [s].
    settings
        One of `SETTINGS`.
    penalty
        Stiffness of each contact, across and along [N/m].
    element
        One of `ELEMENTS`.
    repetitions
        How often it is timed, unless it takes long.

    Raises
    ------
    Skipped
        Where OpenSeesPy cannot be loaded.
    """
    if ops is None:
        raise Skipped(f"OpenSeesPy cannot be loaded: {MISSING}; on Debian it also needs libblas3")
    # It reports every failure to converge at length.
    ops.logFile(os.devnull, "-noEcho")
    run = _Run(step, SETTINGS[settings], penalty, element)

    def prepare() -> None:
        nonlocal run
        run = _Run(step, SETTINGS[settings], penalty, element)

    timing = repeat(lambda: run.solve(), repetitions, prepare)
    note = f"{element}, penalty {penalty:g} N/m"
    if not run.finished:
        note += f"; stopped converging after {len(run.slip) * INTERVAL:g} s"
    steps = len(run.slip) * steps_between(INTERVAL, step)
    return Result("OpenSees", settings, step, steps, tuple(run.slip), run.ringing, run.finished, timing, note)
