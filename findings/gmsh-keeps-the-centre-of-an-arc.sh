#!/usr/bin/env bash
# A mesh by gmsh of a section with an arc has a node that no element has: the centre of the arc.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check gmsh==4.15.2 meshio==5.3.5 numpy==2.4.6
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import gmsh
import meshio
import numpy as np

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
geometry = gmsh.model.geo
centre, right, top, corner = (geometry.addPoint(x, y, 0.0, 0.3) for x, y in ((1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)))
# A square of which a quarter of a circle is cut off: its centre is outside of the section.
sides = [geometry.addLine(corner, right), geometry.addCircleArc(right, centre, top), geometry.addLine(top, corner)]
geometry.addPlaneSurface([geometry.addCurveLoop(sides)])
geometry.synchronize()
gmsh.option.setNumber("Mesh.RecombineAll", 1)
gmsh.model.mesh.generate(2)
print("gmsh", version("gmsh"), "meshio", version("meshio"))
unused = {}
for ending, kind in (("msh", "gmsh"), ("inp", "abaqus"), ("vtk", "vtk")):
    gmsh.write(f"section.{ending}")
    mesh = meshio.read(f"section.{ending}", kind)
    used = np.unique(np.concatenate([block.data.ravel() for block in mesh.cells if block.type in ("quad", "triangle")]))
    unused[ending] = mesh.points[np.setdiff1d(np.arange(len(mesh.points)), used)].tolist()
    print(f"{ending}: {len(mesh.points)} nodes, {len(used)} of them in elements of the plane; others at {unused[ending]}")
gmsh.finalize()
if any(places != [[1.0, 1.0, 0.0]] for places in unused.values()):
    sys.exit("differs: the centre of the arc is not among the nodes")
PYTHON
