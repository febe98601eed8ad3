#!/usr/bin/env bash
# ObsPy applies a K-NET file's scale to the samples and keeps it as well: written as SAC and read again, it counts twice.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check obspy==1.5.1 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import io
import sys
from importlib.metadata import version

import obspy

HEAD = """Origin Time       2020/01/01 12:00:00
Lat.              36.000
Long.             141.000
Depth. (km)       24
Mag.              6.0
Station Code      XYZ001
Station Lat.      36.5000
Station Long.     140.5000
Station Height(m) 40
Record Time       2020/01/01 12:00:36
Sampling Freq(Hz) 100Hz
Duration Time(s)  1
Dir.              N-S
Scale Factor      2000(gal)/8000000
Max. Acc. (gal)   25.000
Last Correction   2020/01/01 12:00:21
Memo.
"""
with open("XYZ0012001011200.NS", "w") as file:
    file.write(HEAD + (" ".join(["  100000"] * 8) + "\n") * 12 + " ".join(["  100000"] * 4) + "\n")
plain = obspy.read("XYZ0012001011200.NS")[0]
scaled = obspy.read("XYZ0012001011200.NS", apply_calib=True)[0]
between = io.BytesIO()
scaled.write(between, format="SAC")
between.seek(0)
again = obspy.read(between, format="SAC", apply_calib=True)[0]
print("obspy", version("obspy"), "- counts of 100000 at 2000 gal / 8000000, that is 0.25 m/s2")
print(f"read: {plain.data[0]:.0f}, factor {plain.stats.calib:.3g}")
print(f"read with apply_calib: {scaled.data[0]:.3g} m/s2, factor still {scaled.stats.calib:.3g}")
print(f"written as SAC, read with apply_calib: {again.data[0]:.3g} m/s2")
if abs(scaled.data[0] - 0.25) > 1e-9 or scaled.stats.calib == 1.0 or abs(again.data[0] / 6.25e-7 - 1) > 1e-3:
    sys.exit("differs: the factor is 1 once it is applied")
PYTHON
