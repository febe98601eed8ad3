#!/usr/bin/env bash
# A block in MuJoCo that is pushed with HALF the force that friction can hold creeps on at 1.7 mm/s.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check mujoco==4.0.0 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import mujoco

WEIGHT, FRICTION = 9810.0, 0.8


def slip_mm(option):
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><option {option}/><worldbody>
          <geom type="plane" size="5 5 1" friction="{FRICTION} 0 0"/>
          <body pos="0 0 0.5"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>
            <geom type="box" size="0.5 0.5 0.5" mass="1000" friction="{FRICTION} 0 0"/></body>
        </worldbody></mujoco>""")
    data = mujoco.MjData(model)
    data.qfrc_applied[0] = 0.5 * FRICTION * WEIGHT
    at = {}
    for second in (5, 10):
        while data.time < second:
            mujoco.mj_step(model, data)
        at[second] = 1000.0 * float(data.qpos[0])
    return at[5], at[10]


print("mujoco", version("mujoco"), "- slip after 5 s and 10 s, in mm")
slips = {}
for option in ("", 'cone="elliptic"', 'cone="elliptic" noslip_iterations="20"', 'cone="elliptic" impratio="100"'):
    slips[option] = slip_mm(option)
    print(f"{option or 'as it comes'}: {slips[option][0]:.2f}, {slips[option][1]:.2f}")
first, last = slips[""]
if not (15.0 < last < 19.0 and 0.9 < (last - first) / first < 1.1 and slips['cone="elliptic" impratio="100"'][1] < 0.5):
    sys.exit("differs: the block holds, or creeps at another rate")
PYTHON
