"""VTK files of a run of the flexible model, for ParaView: both parts deforming under their stresses, and the crack."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.atomic_files import write_whole
from heeltoe.errors.error import package
from heeltoe.geometry.axes import in_x_and_z, places
from heeltoe.models.flexible.body.elastic import principal, stresses
from heeltoe.models.flexible.result.history import CrackHistory
from heeltoe.views.files.names import VTK_FILES

#: Frames written where none are chosen: 10 s at 20 pictures per second.
_FRAMES = 200


def write_vtk_series(history: CrackHistory, directory: Path, *, frames: Sequence[int] | None = None) -> Path:
    """Write frames of a run as VTK XML files (.vtu), with a collection (.pvd) that knows their times.

    ``dam.pvd`` lists grids of both parts: eight-node quadrilaterals where they are drawn, in the plane x downstream, y
    up. Point data are ``displacement`` [m], of which "Warp By Vector" makes the deformed dam; the stresses ``sxx``,
    ``szz``, ``sxz`` and ``principal_major``, ``principal_minor`` [Pa], tension positive. Cell data is ``part``, 0
    above the crack and 1 below.

    ``crack.pvd`` lists the nodes of the faces as vertices, and lines between them. Point data are ``displacement``
    [m]; ``force`` [N], by which the lower face pushes a node of the upper one, along the crack and across it, mean
    since the frame before (in the first frame of the static state, at nodes of the lower face zero); ``gap`` [m] to
    the other face, NaN beyond its end; ``status``, counting absent, open, stick, slip downstream, slip upstream, -1
    where a node is not watched; of a bonded joint ``damage``, 0 intact, below 1 softening, 1 broken, on both faces.
    Cell data is ``part``.

    One frame is in memory at a time. On disk 200 frames take 7 MB with the 355 nodes of the typical dam cracked at its
    base, 90 MB with 5000 nodes: some 85 bytes per node and frame.

    Parameters
    ----------
    history
        Of a response of the flexible model.
    directory
        Where; it is made if it is not there. An earlier series in it is replaced, by a whole one or not at all.
    frames
        Places in ``history.time``, negative ones from the end; without them at most 200 at equal distances, the first
        and the last among them.

    Returns
    -------
    Path
        Of ``dam.pvd``, the file to open.

    Raises
    ------
    InputError
        Where the files cannot be written, or the package meshio is missing.
    """
    _meshio(directory)
    write_whole(lambda fresh: write_frames(history, fresh, frames=frames), directory, VTK_FILES, field="directory")
    return directory / "dam.pvd"


def write_frames(history: CrackHistory, fresh: Path, *, frames: Sequence[int] | None = None) -> None:
    """Write the files of :func:`write_vtk_series` into an empty directory."""
    meshio = _meshio(fresh)
    chosen = _chosen(len(history.time), frames)
    digits = len(str(len(history.time) - 1))
    names = [f"{frame:0{digits}d}.vtu" for frame in chosen]
    dam, crack = _Dam(history), _Crack(history)
    for frame, name in zip(chosen, names, strict=True):
        for series in (dam, crack):
            grid = meshio.Mesh(series.points, series.cells, series.point_data(frame), series.cell_data)
            meshio.write(fresh / f"{series.name}-{name}", grid, "vtu", binary=True, compression="zlib")
    for series in (dam, crack):
        files = [f"{series.name}-{name}" for name in names]
        _write_collection(fresh / f"{series.name}.pvd", files, history.time[chosen])


class _Dam:
    """Grids of all parts."""

    name = "dam"

    def __init__(self, history: CrackHistory) -> None:
        self.history = history
        meshes = [body.mesh for body in history.dam.bodies]
        self.points = _spatial(np.vstack([mesh.nodes for mesh in meshes]))
        first = np.cumsum([0, *(len(mesh.nodes) for mesh in meshes)])
        # Our order of nodes is VTK's: corners counter-clockwise, then midsides from that between the first two.
        elements = [mesh.elements + start for mesh, start in zip(meshes, first[:-1], strict=True)]
        self.cells = [("quad8", np.vstack(elements))]
        self.cell_data = {"part": [_parts([len(mesh.elements) for mesh in meshes])]}

    def point_data(self, frame: int) -> dict[str, NDArray[Any]]:
        moved = self.history.displacements(frame)
        bodies = self.history.dam.bodies
        stress = np.vstack(
            [stresses(body, displacement.reshape(-1)) for body, displacement in zip(bodies, moved, strict=True)]
        )
        major, minor, _ = principal(stress)
        return {
            "displacement": _spatial(np.vstack(moved)),
            **{name: np.ascontiguousarray(stress[:, column]) for column, name in enumerate(("sxx", "szz", "sxz"))},
            "principal_major": major,
            "principal_minor": minor,
        }


class _Crack:
    """Nodes of the crack's faces, upper first."""

    name = "crack"

    def __init__(self, history: CrackHistory) -> None:
        self.faces = history.faces
        drawn = history.drawn
        self.points = _spatial(np.vstack(drawn))
        self.section = history.dam.sections[history.place]
        self.start = [places(nodes, self.section).T for nodes in drawn]
        counts = [len(nodes) for nodes in drawn]
        first = np.cumsum([0, *counts])
        nodes = np.arange(first[-1])
        # The straight pieces from node to node, midside nodes included, that contact knows.
        lines = [np.column_stack([nodes[a : b - 1], nodes[a + 1 : b]]) for a, b in pairwise(first)]
        self.cells = [("vertex", nodes[:, None]), ("line", np.vstack(lines))]
        self.cell_data = {"part": [_parts(counts), _parts([len(line) for line in lines])]}
        self.force = history.forces()
        self.gaps = np.hstack(history.node_gaps())
        self.status = np.hstack(history.node_status()).astype(np.int32)
        self.damage = None if history.damage is None else np.hstack(history.node_damage())

    def point_data(self, frame: int) -> dict[str, NDArray[Any]]:
        moved = [
            in_x_and_z((face[frame] - start).T, self.section)
            for face, start in zip(self.faces, self.start, strict=True)
        ]
        force = np.zeros_like(self.points)
        force[: self.force.shape[2], :2] = self.force[frame].T
        damage = {} if self.damage is None else {"damage": self.damage[frame]}
        return {
            "displacement": _spatial(np.vstack(moved)),
            "force": force,
            "gap": self.gaps[frame],
            "status": self.status[frame],
            **damage,
        }


def _meshio(directory: Path) -> ModuleType:
    with package(str(directory), "meshio"):
        import meshio
    return meshio  # type: ignore[no-any-return]


def _chosen(count: int, frames: Sequence[int] | None) -> Integers:
    """Return the frames to write, each once, in the order of time."""
    if frames is None:
        return np.unique(np.linspace(0, count - 1, min(count, _FRAMES)).round().astype(np.int64))
    return np.unique(np.arange(count)[np.asarray(frames, dtype=np.int64)])


def _spatial(plane: Floats) -> Floats:
    """Return points or vectors of the plane as those of space, which VTK wants."""
    return np.column_stack([plane, np.zeros(len(plane))])


def _parts(counts: list[int]) -> NDArray[np.int32]:
    return np.repeat(np.arange(len(counts), dtype=np.int32), counts)


def _write_collection(path: Path, files: list[str], times: Floats) -> None:
    order = {"little": "LittleEndian", "big": "BigEndian"}[sys.byteorder]
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1", byte_order=order)
    collection = ElementTree.SubElement(root, "Collection")
    for file, time in zip(files, times.tolist(), strict=True):
        ElementTree.SubElement(collection, "DataSet", timestep=repr(time), group="", part="0", file=file)
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
