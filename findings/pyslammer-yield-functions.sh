#!/usr/bin/env bash
# pySLAMMER's docstrings offer a yield acceleration that is a function or a table; both end in a TypeError.
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
motion = pyslammer.GroundMotion(0.3 * np.sin(2 * np.pi * time), 0.01)
column = {"height": 20.0, "vs_slope": 400.0, "vs_base": 600.0, "damp_ratio": 0.05}
line = next(line for line in inspect.getdoc(pyslammer.Decoupled).splitlines() if line.startswith("ky :"))
print("pyslammer", version("pyslammer"), "- its docstring:", line)
raised = []
for name, given in (("function", lambda slip: 0.1), ("table", (np.array([0.0, 1.0]), np.array([0.1, 0.1])))):
    try:
        pyslammer.Decoupled(ky=given, ground_motion=motion, **column)
        print(f"{name}: runs")
    except TypeError as error:
        raised.append(name)
        print(f"{name}: TypeError: {error}")
if "callable" not in line or raised != ["function", "table"]:
    sys.exit("differs: a yield acceleration as the docstring has it runs, or the docstring no longer offers it")
PYTHON
