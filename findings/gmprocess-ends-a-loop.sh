#!/usr/bin/env bash
# The velocity file of a USGS download, read by gmprocess, ends a loop over the folder that catches every Exception.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check gmprocess==2.8.0
venv/bin/python -W ignore - <<'PYTHON'
import logging
import sys
from importlib.metadata import version
from pathlib import Path

from gmprocess.io.read import read_data

logging.disable(logging.CRITICAL)
# A second of velocity [cm/s] in the SMC format: text, integers, floating point, values.
text = ["3 VELOCITY", "*", "ABC0B", "     1980   1   1    2000 Nowhere, XY"]
text += ["Moment Mag=      6.5 Ms=      6.5 Ml=      6.5", "station = Empty Valley             component=   90"]
text += ["epicentral dist =     20.0       pk     =      1.0", "inst type=SMA-1      data source = XYZ", "*", "*", "*"]
integers = [-32768] * 48
integers[13], integers[16], integers[17] = 90, 100, 0
lines = ["".join(f"{value:10d}" for value in integers[k : k + 8]) for k in range(0, 48, 8)]
numbers = [1.7e38] * 50
numbers[1] = 100.0
lines += ["".join(f"{value:15.7E}" for value in numbers[k : k + 5]) for k in range(0, 50, 5)]
lines += ["".join(f"{value:10.4E}" for value in [1.0] * 8)] * 12 + ["".join(f"{value:10.4E}" for value in [1.0] * 4)]
Path("velocity.smc").write_text("\n".join(text + lines) + "\n")
try:
    try:
        read_data(Path("velocity.smc"))
        outcome = "read"
    except Exception as error:
        outcome = f"caught: {type(error).__name__}"
except BaseException as error:
    outcome = f"not caught: {type(error).__name__}, {error}"
print("gmprocess", version("gmprocess"), f"- a velocity file in a loop that catches every Exception: {outcome}")
if not outcome.startswith("not caught: BaseException"):
    sys.exit("differs: the file is read, or its error is an Exception")
PYTHON
