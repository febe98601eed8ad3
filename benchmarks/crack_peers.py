"""An elastic block that slides: ours beside OpenSees and Siconos, error and time of each in one run."""

from __future__ import annotations

import numpy as np
import peer_opensees
import peer_siconos
from elastic_block import ALONG, MODULUS, POISSON, Result
from measure import NothingMeasured, Skipped, heading, repeat, require, table
from push_and_sine import (
    AMPLITUDE,
    DEPTH,
    DURATION,
    EXACT,
    FREQUENCY,
    FRICTION,
    GRAVITY,
    HEIGHT,
    INTERVAL,
    MASS,
    PUSH,
    WIDTH,
    Attempt,
    error,
    rows,
)

from heeltoe import GroundMotion, build_flexible_dam, read_case
from heeltoe.kernel.build import PROFILE
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.motion.earthquake import Earthquake

COLUMNS = ["program", "settings", "step", "largest error", "relative", "time per run", "times ours at no larger error"]
OUR_STEPS = (2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4)
OPENSEES = (
    (0.02, "Newmark 1, 0.5625"),
    (0.004, "Newmark 1, 0.5625"),
    (0.00125, "Newmark 1, 0.5625"),
    (0.001, "Newmark 0.7, 0.36"),
)
SICONOS = ((0.1, "theta 0.7, Lemke"), (0.01, "theta 0.7, Lemke"), (0.001, "theta 0.7, Lemke"))


def our_block(across: int) -> ShakenDam:
    """Return the block with so many eight-node elements along its base, ready to be shaken."""
    corners = [[0.0, 0.0], [WIDTH, 0.0], [WIDTH, HEIGHT], [0.0, HEIGHT]]
    case = read_case(
        {
            "gravity": f"{GRAVITY} m/s^2",
            "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
            "concrete": {
                "density": f"{MASS / (WIDTH * HEIGHT * DEPTH)} kg/m^3",
                "modulus": f"{MODULUS} Pa",
                "poisson": POISSON,
                "damping": 0.0,
            },
            "crack": {"friction": FRICTION},
            "rock": "rigid",
            "uplift": {"pattern": "none"},
            "flexible": {"elements_across": across},
        }
    )
    # The push is a part of the ground's motion to the block: both are forces on all of its mass.
    time = np.linspace(0.0, DURATION, 50_001)
    ground = GroundMotion.from_points(time, AMPLITUDE * np.sin(2.0 * np.pi * FREQUENCY * time) - PUSH)
    return ShakenDam(case, build_flexible_dam(case), Earthquake(ground, None, DURATION).shaking)


def ours(across: int) -> list[Attempt]:
    """Slide the block at all of our steps."""
    shaken, attempts = our_block(across), []
    for step in OUR_STEPS:
        slip = shaken.run(step, INTERVAL).frames.slip[1:]
        timing = repeat(lambda step=step: shaken.run(step), 3)
        attempts.append(Attempt("heeltoe", f"{across} across, 8-node, exact contact", step, error(slip), timing))
    return attempts


def attempt(result: Result) -> Attempt | None:
    """Judge a peer's run like ours; None where it did not get to the end."""
    if not result.finished:
        return None
    settings = f"{result.settings}; {result.note}"
    return Attempt(result.program, settings, result.step, error(np.array(result.slip)), result.timing)


def peers() -> tuple[list[Attempt], list[str]]:
    """Run the peers that are installed; also say which are not, or broke down."""
    outcome, remarks = [], []
    runs = [
        (lambda step=step, name=name, element=element: peer_opensees.sliding_block(step, name, element=element))
        for step, name in OPENSEES
        for element in ("SSPquad", "quad8n")
    ]
    runs += [
        (lambda step=step, name=name, nodes=nodes: peer_siconos.sliding_block(step, name, nodes=nodes))
        for step, name in SICONOS
        for nodes in (4, 8)
    ]
    for run in runs:
        try:
            result = run()
        except Skipped as reason:
            remarks.append(f"Not measured: {reason}.")
            continue
        except NothingMeasured as reason:
            remarks.append(f"Broke down: {reason}.")
            continue
        judged = attempt(result)
        if judged is None:
            remarks.append(f"{result.program}, {result.settings}, step {result.step:g} s: {result.note}.")
        else:
            outcome.append(judged)
    return outcome, list(dict.fromkeys(remarks))


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    own = ours(ALONG) + ours(ALONG // 2)
    result, remarks = peers()
    if not result:
        raise Skipped("no peer ran: " + " ".join(remarks))
    text = (
        f"Elastic block of 4 m by 1 m, {MODULUS / 1e9:g} GPa, no damping, pushed and shaken for {DURATION:g} s; errors "
        "are the largest at any tenth of a second against the exact slip of a rigid one, "
        f"{EXACT[-1]:.7f} m in the end: the elastic one slides some 0.03 % less, so that no error below 0.3 mm means "
        "anything. Building the models is not in the times. SSPquad and 4 nodes are meshes of 16 x 4 elements with 17 "
        "nodes on the base, quad8n and 8 nodes have 33; ours has 33 with 16 across and 17 with 8 across."
    )
    return "\n\n".join(
        [heading("Elastic block beside peers", ["heeltoe", "numpy"]), text, table(COLUMNS, rows(own, result)), *remarks]
    )


if __name__ == "__main__":
    print(report())
