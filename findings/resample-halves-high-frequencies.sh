#!/usr/bin/env bash
# ObsPy's resample to TWICE the rate halves a sine at half of the old Nyquist frequency.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check obspy==1.5.1 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
import obspy

time = np.arange(2000) / 100.0
print("obspy", version("obspy"), "- peaks of sines of amplitude 1, from 100 to 200 samples a second")
peaks = {}
for frequency in (5.0, 10.0, 25.0, 40.0):
    sine = obspy.Trace(np.sin(2 * np.pi * frequency * time), {"sampling_rate": 100.0})
    as_it_comes, without = sine.copy().resample(200.0), sine.copy().resample(200.0, window=None)
    peaks[frequency] = [float(np.abs(trace.data[1000:3000]).max()) for trace in (as_it_comes, without)]
    print(f"{frequency:4.0f} Hz: {peaks[frequency][0]:.3f}; with window=None {peaks[frequency][1]:.3f}")
if abs(peaks[25.0][0] - 0.5) > 0.01 or abs(peaks[40.0][0] - 0.091) > 0.01 or peaks[25.0][1] < 0.99:
    sys.exit("differs: a finer step no longer weakens what the record holds")
PYTHON
