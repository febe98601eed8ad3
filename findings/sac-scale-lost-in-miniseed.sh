#!/usr/bin/env bash
# SAC's SCALE stays beside the samples in ObsPy; written on as miniSEED, which has no place for it, it is gone in silence.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check obspy==1.5.1 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import io
import sys
import warnings
from importlib.metadata import version

import numpy as np
import obspy
from obspy.io.sac import SACTrace

# Samples in percent of 9.81 m/s2, and SCALE for m/s2.
file, onward = io.BytesIO(), io.BytesIO()
SACTrace(data=np.full(100, 2.0, dtype=np.float32), delta=0.01, scale=0.0981).write(file)
file.seek(0)
sac = obspy.read(file, format="SAC")[0]
with warnings.catch_warnings(record=True) as words:
    warnings.simplefilter("always")
    sac.write(onward, format="MSEED")
    onward.seek(0)
    seed = obspy.read(onward, format="MSEED")[0]
print("obspy", version("obspy"))
print(f"SAC: samples {sac.data[0]}, factor {sac.stats.calib:.4f}; the value meant is {sac.data[0] * sac.stats.calib:.4f} m/s2")
print(f"miniSEED: samples {seed.data[0]}, factor {seed.stats.calib}; warnings: {len(words)}")
if (sac.data[0], seed.data[0], seed.stats.calib, len(words)) != (2.0, 2.0, 1.0, 0):
    sys.exit("differs: the factor is applied, kept or warned of")
PYTHON
