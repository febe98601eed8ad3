#!/usr/bin/env bash
# A zeroLengthContact2D of OpenSees, pushed with less than its friction, creeps: the faster the shorter the step.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check openseespy==3.7.1.2
venv/bin/python - <<'PYTHON'
import sys
from importlib.metadata import version

import openseespy.opensees as ops

WEIGHT, MASS, PUSH = 1000.0, 100.0, 0.75  # N, kg, part of the friction, whose coefficient is 1


def slips(stiffness, step):
    """Return the slip after each of six seconds [m]; the push is there from the start."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 0.0)
    ops.fix(1, 1, 1)
    ops.mass(2, MASS, MASS)
    ops.element("zeroLengthContact2D", 1, 2, 1, stiffness, stiffness, 1.0, "-normal", 0, 1)
    for tag, force in enumerate([(0.0, -WEIGHT), (PUSH * WEIGHT, 0.0)], 1):
        if tag == 2:
            ops.loadConst("-time", 0.0)
            ops.wipeAnalysis()
        ops.timeSeries("Constant", tag)
        ops.pattern("Plain", tag, tag)
        ops.load(2, *force)
        ops.constraints("Plain")
        ops.numberer("Plain")
        ops.system("FullGeneral")
        ops.test("NormUnbalance", 1e-6, 30, 0)
        ops.algorithm("Newton")
        ops.integrator(*(("LoadControl", 1.0) if tag == 1 else ("Newmark", 0.6, 0.3025)))
        ops.analysis("Static" if tag == 1 else "Transient")
        if tag == 1:
            ops.analyze(1)
    result = []
    for _ in range(6):
        if ops.analyze(round(1.0 / step), step) != 0:
            sys.exit("differs: it does not converge")
        result.append(ops.nodeDisp(2, 1))
    return result


print("openseespy", version("openseespy"), f"- pushed with {PUSH:g} of its friction, creep in the sixth second:")
creeps = []
for stiffness, step in ((1e6, 1e-3), (1e6, 5e-4), (4e6, 1e-3)):
    *_, before, after = slips(stiffness, step)
    creeps.append(after - before)
    print(f"  stiffness {stiffness:g} N/m, step {1e3 * step:g} ms: {creeps[-1]:.3f} m/s")
if [round(creep, 3) for creep in creeps] != [0.417, 0.833, 0.104]:
    sys.exit("differs: the creep is another, or none")
PYTHON
