"""PyBullet on the push-and-sine block, at the settings that serve it best there."""

from __future__ import annotations

import numpy as np
import pybullet
from measure import repeat
from push_and_sine import DEPTH, FRICTION, GRAVITY, HEIGHT, INTERVAL, MASS, WIDTH, Attempt, error, force

# Found by trying; damping, rolling and spinning friction and restitution are off always.
SETTINGS = {
    "50 iterations": {"numSolverIterations": 50},
    "200 iterations, no slop": {"numSolverIterations": 200, "solverResidualThreshold": 0.0, "contactSlop": 0.0},
    "200 iterations, error reduction 0.2": {
        "numSolverIterations": 200,
        "solverResidualThreshold": 0.0,
        "erp": 0.2,
        "contactERP": 0.2,
        "frictionERP": 0.2,
    },
}


def _world(client: int, step: float, setting: dict[str, float]) -> int:
    pybullet.resetSimulation(client)
    pybullet.setGravity(0.0, 0.0, -GRAVITY, client)
    pybullet.setPhysicsEngineParameter(
        fixedTimeStep=step,
        numSubSteps=0,
        enableConeFriction=0,
        restitutionVelocityThreshold=0.0,
        physicsClientId=client,
        **setting,
    )
    shape = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client)
    base = pybullet.createMultiBody(0.0, shape, physicsClientId=client)
    half = [WIDTH / 2, DEPTH / 2, HEIGHT / 2]
    shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, physicsClientId=client)
    block = pybullet.createMultiBody(MASS, shape, basePosition=[0.0, 0.0, HEIGHT / 2], physicsClientId=client)
    # The friction of a contact is the product of both bodies'.
    for body, friction in ((base, 1.0), (block, FRICTION)):
        pybullet.changeDynamics(
            body,
            -1,
            lateralFriction=friction,
            restitution=0.0,
            rollingFriction=0.0,
            spinningFriction=0.0,
            linearDamping=0.0,
            angularDamping=0.0,
            physicsClientId=client,
        )
    return block


def _attempt(client: int, step: float, name: str) -> Attempt:
    block = -1
    slip: list[float] = []
    every = round(INTERVAL / step)
    forces = force(step).tolist()

    def prepare() -> None:
        nonlocal block
        block = _world(client, step, SETTINGS[name])
        slip.clear()

    def solve() -> None:
        # Local names, since the loop below is part of what is timed.
        push, advance, frame = pybullet.applyExternalForce, pybullet.stepSimulation, pybullet.LINK_FRAME
        centre = (0.0, 0.0, 0.0)
        for k, along in enumerate(forces, 1):
            push(block, -1, (along, 0.0, 0.0), centre, frame, client)
            advance(client)
            if k % every == 0:
                slip.append(pybullet.getBasePositionAndOrientation(block, client)[0][0])

    timing = repeat(solve, 3, prepare)
    return Attempt("PyBullet", name, step, error(np.array(slip)), timing)


def attempts(step: float) -> list[Attempt]:
    """Solve with every setting; the steps run one by one from Python, which is how PyBullet is used."""
    client = pybullet.connect(pybullet.DIRECT)
    result = [_attempt(client, step, name) for name in SETTINGS]
    pybullet.disconnect(client)
    return result
