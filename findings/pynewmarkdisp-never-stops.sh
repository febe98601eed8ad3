#!/usr/bin/env bash
# A block that pynewmarkdisp slides goes on for ever at its last speed once the ground is at rest.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check pynewmarkdisp==0.1.0 numpy==2.4.6 scipy==1.17.1
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
from pynewmarkdisp.newmark import direct_newmark

PUSH, HELD, RESIST = 4.0, 0.5, 1.0  # m/s2, s, m/s2
by_hand = 0.5 * PUSH * HELD**2 * (PUSH / RESIST - 1.0)
print("pynewmarkdisp", version("pynewmarkdisp"), f"- 4 m/s2 for 0.5 s against a yield of 1 m/s2; by hand {by_hand:.3f} m, at rest after 2 s")
slips = []
for rest in (3.0, 6.0, 12.0):
    time = np.arange(0.0, HELD + rest, 1e-3)
    result = direct_newmark(time, np.where(time < HELD, PUSH, 0.0), RESIST / 9.81, 9.81)
    slips.append(float(result["perm_disp"]))
    print(f"{rest:4.0f} s of rest: permanent slip {slips[-1]:.3f} m, last speed {result['vel'][-1]:.3f} m/s")
if not (slips[0] > 3 * by_hand and slips[2] > 1.9 * slips[1]):
    sys.exit("differs: the block comes to rest")
PYTHON
