#!/usr/bin/env bash
# A quad8n of OpenSees that is damped by its initial stiffness gains energy, although its material is linear.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check openseespy==3.7.1.2
venv/bin/python - <<'PYTHON'
import os
import sys
from importlib.metadata import version

import openseespy.opensees as ops

PLACES = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5)]


def setting(kind, integrator):
    ops.wipeAnalysis()
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-9, 30, 0)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


def released(tangent, initial):
    """Return the deflection of a square that is held at its left side, pulled at a corner, and half a second after it
    is let go, with damping by its tangent or its initial stiffness [s]."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    for node, (x, y) in enumerate(PLACES, 1):
        ops.node(node, float(x), float(y))
        ops.mass(node, 1.0, 1.0)
    for node in (1, 4, 8):
        ops.fix(node, 1, 1)
    ops.nDMaterial("ElasticIsotropic", 1, 1e6, 0.2)
    ops.element("quad8n", 1, *range(1, 9), 1.0, "PlaneStress", 1)
    ops.region(1, "-ele", 1, "-rayleigh", 0.0, tangent, initial, 0.0)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, 1000.0)
    setting("Static", ("LoadControl", 1.0))
    ops.analyze(1)
    start = ops.nodeDisp(2, 2)
    ops.remove("loadPattern", 1)
    setting("Transient", ("Newmark", 0.5, 0.25))
    for _ in range(500):
        if ops.analyze(1, 0.001) != 0:
            break
    return start, ops.nodeDisp(2, 2)


ops.logFile(os.devnull, "-noEcho")
start, tangent = released(0.001, 0.0)
_, initial = released(0.0, 0.001)
print("openseespy", version("openseespy"), f"- pulled by {start:.4f} m; half a second after it is let go")
print(f"  damped by the tangent stiffness {tangent:.1e} m, by the initial stiffness {initial:.1e} m")
if not (abs(tangent) < 1e-2 * start and abs(initial) > 1e3 * start):
    sys.exit("differs: both die away")
PYTHON
