#!/usr/bin/env bash
# A ball of restitution 1 in PyBullet: the finer the step, the less it bounces, to nothing.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check pybullet==3.2.7 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import pybullet

DROP = 0.1


def rebound(step):
    world = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0.0, 0.0, -9.81, world)
    pybullet.setPhysicsEngineParameter(fixedTimeStep=step, restitutionVelocityThreshold=0.0, physicsClientId=world)
    plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=world)
    sphere = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.1, physicsClientId=world)
    floor = pybullet.createMultiBody(0.0, plane, physicsClientId=world)
    ball = pybullet.createMultiBody(1.0, sphere, basePosition=[0.0, 0.0, 0.1 + DROP], physicsClientId=world)
    for body in (floor, ball):
        pybullet.changeDynamics(body, -1, restitution=1.0, linearDamping=0.0, angularDamping=0.0, physicsClientId=world)
    top, landed = 0.0, False
    for _ in range(round(0.4 / step)):
        pybullet.stepSimulation(world)
        height = pybullet.getBasePositionAndOrientation(ball, world)[0][2] - 0.1
        landed = landed or height < 0.01
        if landed and pybullet.getBaseVelocity(ball, world)[0][2] > 0.0:
            top = max(top, height)
    pybullet.disconnect(world)
    return top


print("pybullet", version("pybullet"), f"- a ball of restitution 1, dropped by {DROP} m, comes back to")
heights = {}
for step in (1 / 240, 1e-3, 5e-4, 1e-4):
    heights[step] = rebound(step)
    print(f"{heights[step]:.4f} m at steps of {1000 * step:.3g} ms")
if heights[1 / 240] < 0.08 or max(heights[step] for step in (1e-3, 5e-4, 1e-4)) > 0.001:
    sys.exit("differs: it bounces at small steps, or not at large ones")
PYTHON
