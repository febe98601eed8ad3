#!/usr/bin/env bash
# A layer of a DXF file has no case; ezdxf's table of layers follows, its query does not and finds nothing.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check ezdxf==1.4.5
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import ezdxf

drawing = ezdxf.new()
drawing.layers.add("Dam")
drawing.modelspace().add_lwpolyline([(0, 0), (80, 0), (5, 100), (0, 100)], close=True, dxfattribs={"layer": "DAM"})
drawing.saveas("section.dxf")
again = ezdxf.readfile("section.dxf")
lines = again.modelspace()
known = "dam" in again.layers
strict, loose = len(lines.query('LWPOLYLINE[layer=="Dam"]')), len(lines.query('LWPOLYLINE[layer=="Dam"]i'))
print("ezdxf", version("ezdxf"), f"- layer Dam, a polyline on DAM; the table knows layer dam: {known}; lines on Dam by query: {strict}, with i: {loose}")
if (known, strict, loose) != (True, 0, 1):
    sys.exit("differs: the query finds the polyline, or the table of layers minds the case")
PYTHON
