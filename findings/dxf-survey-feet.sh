#!/usr/bin/env bash
# ezdxf names the US survey foot of a drawing, unit 21 of $INSUNITS, and cannot convert it.
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
from ezdxf import units

drawing = ezdxf.new()
drawing.units = units.InsertUnits.USSurveyFeet
drawing.modelspace().add_lwpolyline([(0, 0), (262, 0), (16, 328), (0, 328)], close=True)
drawing.saveas("section.dxf")
stated = ezdxf.readfile("section.dxf").units
try:
    factor = str(units.conversion_factor(stated, units.M))
except TypeError:
    factor = "TypeError"
foot = units.conversion_factor(units.FT, units.M)
print("ezdxf", version("ezdxf"), f"- unit {int(stated)}, {units.unit_name(stated)}, in metres: {factor}; a foot: {foot:.4f}")
if (int(stated), units.unit_name(stated), factor) != (21, "USSurveyFeet", "TypeError"):
    sys.exit("differs: the survey foot is converted, or has no name")
PYTHON
