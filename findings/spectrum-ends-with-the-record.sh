#!/usr/bin/env bash
# A pulse at a record's end: eqsig and pyRotd give a long-period ordinate a factor of 3 apart, and both too small.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check eqsig==1.2.17 pyrotd==0.6.1 setuptools==80.10.2 numpy==2.4.6 scipy==1.17.1
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
import pyrotd
from eqsig import sdof

STEP, PERIOD, DAMPING = 0.01, 8.0, 0.05
record = np.zeros(1000)
record[-60:-10] = np.sin(np.linspace(0.0, np.pi, 50))
print("eqsig", version("eqsig"), "pyrotd", version("pyrotd"), "- pseudo-acceleration at 8 s [m/s2]")


def ordinates(motion):
    by_eqsig = sdof.pseudo_response_spectra(motion, STEP, np.array([PERIOD]), DAMPING)[2][0]
    by_pyrotd = pyrotd.calc_spec_accels(STEP, motion, np.array([1.0 / PERIOD]), DAMPING).spec_accel[0]
    return float(by_eqsig), float(by_pyrotd)


bare, padded = ordinates(record), ordinates(np.r_[record, np.zeros(20000)])
# By hand: a push of speed v at rest, then free vibration of 5 %: the first peak.
speed = STEP * record.sum()
pull = 2 * np.pi / PERIOD * speed * np.exp(-DAMPING / np.sqrt(1 - DAMPING**2) * np.arccos(DAMPING))
print(f"record as it ends:    eqsig {bare[0]:.3f}, pyRotd {bare[1]:.3f}")
print(f"zeros of 200 s added: eqsig {padded[0]:.3f}, pyRotd {padded[1]:.3f}; by hand, as a sudden push, {pull:.3f}")
if not (bare[0] < 0.07 and 0.19 < bare[1] < 0.20 and all(abs(value / pull - 1) < 0.05 for value in padded)):
    sys.exit("differs: the programs no longer stop (eqsig) or wrap round (pyRotd) at the record's end")
PYTHON
