#!/usr/bin/env bash
# pySLAMMER's target_pga is documented in m/s2 and taken in g: 9.81 times the motion that was asked for.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check pyslammer==0.2.2 setuptools==80.10.2 numpy==2.4.6 scipy==1.17.1
venv/bin/python -W ignore - <<'PYTHON'
import inspect
import sys
from importlib.metadata import version

import numpy as np
import pyslammer

time = np.arange(0.0, 5.0, 0.01)
motion = pyslammer.GroundMotion(0.3 * np.sin(2 * np.pi * time) * np.exp(-time), 0.01)
line = next(line for line in inspect.getdoc(pyslammer.RigidAnalysis).splitlines() if "Target peak" in line)
print("pyslammer", version("pyslammer"), "- its docstring:", line.strip())
# The peak that the motion has already, in the unit of the docstring: nothing should change.
same = pyslammer.RigidAnalysis(0.1, motion).max_sliding_disp
asked = pyslammer.RigidAnalysis(0.1, motion, target_pga=motion.pga * pyslammer.G_EARTH).max_sliding_disp
in_g = pyslammer.RigidAnalysis(0.1, motion, target_pga=motion.pga).max_sliding_disp
print(f"slip as recorded {same:.4f} m; target_pga = {motion.pga * pyslammer.G_EARTH:.3f} m/s2 {asked:.3f} m; = {motion.pga:.4f} {in_g:.4f} m")
if "m/s^2" not in line or abs(in_g / same - 1) > 1e-9 or asked < 50 * same:
    sys.exit("differs: target_pga is in m/s2, or the docstring says g")
PYTHON
