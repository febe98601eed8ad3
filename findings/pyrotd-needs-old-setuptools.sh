#!/usr/bin/env bash
# pip finds pyRotd's requirements met, yet it does not import: pkg_resources left setuptools with version 82.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check pyrotd==0.6.1 setuptools==82.0.0 numpy==2.4.6 scipy==1.17.1
venv/bin/python -W ignore - <<'PYTHON'
import subprocess
import sys
from importlib.metadata import requires, version

print("pyrotd", version("pyrotd"), "setuptools", version("setuptools"))
check = subprocess.run([sys.executable, "-m", "pip", "check"], capture_output=True, text=True)
print("pip check:", check.stdout.strip())
print("pyrotd requires:", ", ".join(requires("pyrotd")))
try:
    import pyrotd
except ModuleNotFoundError as error:
    print("import pyrotd:", error)
    missing = error.name
else:
    missing = None
if check.returncode or missing != "pkg_resources":
    sys.exit("differs: pyrotd imports, or pip names what is missing")
PYTHON
