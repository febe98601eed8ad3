#!/usr/bin/env bash
# meshio writes a file.msh in the format of Ansys, without its point data, and gmsh, whose ending it is, cannot open it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check meshio==5.3.5 gmsh==4.15.2 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import sys
from contextlib import redirect_stderr, redirect_stdout
from importlib.metadata import version
from io import StringIO

import gmsh
import meshio
import numpy as np

corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
square = meshio.Mesh(corners, [("quad", np.array([[0, 1, 2, 3]]))], point_data={"height": corners[:, 1]})
words = StringIO()
with redirect_stdout(words), redirect_stderr(words):
    square.write("by-ending.msh")
    square.write("by-name.msh", file_format="gmsh")
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
print("meshio", version("meshio"), "gmsh", version("gmsh"))
opened, kept = {}, {}
for name in ("by-name.msh", "by-ending.msh"):
    try:
        gmsh.open(name)
        opened[name] = f"{len(gmsh.model.mesh.getNodes()[0])} nodes"
    except Exception as error:
        opened[name] = str(error).strip()
    # meshio itself looks inside.
    kept[name] = list(meshio.read(name).point_data)
    with open(name, "rb") as file:
        print(f"{name}: begins with {file.readline().strip()}; gmsh: {opened[name]}; meshio reads back {kept[name] or 'no point data'}")
gmsh.finalize()
print("words while writing:", repr(words.getvalue()))
if opened["by-name.msh"] != "4 nodes" or "syntax error" not in opened["by-ending.msh"] or kept["by-ending.msh"] or "height" not in kept["by-name.msh"] or "nsys" in words.getvalue():
    sys.exit("differs: the ending .msh means gmsh's format, or the point data is kept or warned of")
PYTHON
