#!/usr/bin/env bash
# ObsPy reads the step of a SAC file in whole microseconds: 128 samples a second become 128.008.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check obspy==1.5.1 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import io
import struct
import sys
from importlib.metadata import version

import numpy as np
import obspy

sent = obspy.Trace(np.zeros(7681, dtype=np.float32), {"sampling_rate": 128.0})
file = io.BytesIO()
sent.write(file, format="SAC")
(in_file,) = struct.unpack_from("<f", file.getvalue(), 0)
file.seek(0)
stats = obspy.read(file, format="SAC")[0].stats
print("obspy", version("obspy"))
print(f"step sent {sent.stats.delta} s, in the bytes of the file {in_file} s, read back {stats.delta} s")
print(f"samples a second {stats.sampling_rate:.4f}; the end of a minute comes {60.0 - (stats.npts - 1) * stats.delta:.5f} s early")
if in_file != 0.0078125 or stats.delta != 0.007812:
    sys.exit("differs: the step is no longer rounded to microseconds")
PYTHON
