#!/usr/bin/env bash
# Below six steps of the record eqsig's response spectra are the record's peak, whatever the oscillator does.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check eqsig==1.2.17 numpy==2.4.6 scipy==1.17.1
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
from eqsig import sdof

STEP = 0.01
time = np.arange(0.0, 10.0, STEP)
print("eqsig", version("eqsig"), "- a sine of 1 m/s2 at the period of an oscillator damped by 5 %: 10 m/s2 in the long run")
found = {}
for steps in (5.0, 5.9, 6.1, 12.0):
    period = steps * STEP
    record = np.sin(2 * np.pi * time / period)
    coarse = sdof.pseudo_response_spectra(record, STEP, np.array([period]), 0.05)[2][0]
    # The same record, straight between its samples, in steps of a tenth.
    fine = np.interp(np.arange(0.0, time[-1], STEP / 10), time, record)
    refined = sdof.pseudo_response_spectra(fine, STEP / 10, np.array([period]), 0.05)[2][0]
    found[steps] = coarse
    print(f"period of {steps:4.1f} steps: {coarse:.3f} m/s2; the same record in finer steps {refined:.3f} m/s2")
if not (found[5.9] < 1.001 and found[6.1] > 9.0):
    sys.exit("differs: the response at 5.9 steps is no longer the record's peak")
PYTHON
