"""Meshes of quadrilaterals from files, read by meshio: Gmsh (.msh), VTK (.vtu), Abaqus (.inp) and others.

What is read here is a sound mesh of one piece; whether it belongs to the section is for
:mod:`heeltoe.models.flexible.mesh.dam`."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.base.input_files import read_bounded
from heeltoe.errors.error import InputError, package
from heeltoe.models.flexible.mesh.checks import check_elements, check_pieces

_EXPECTED = "a mesh in a format that meshio reads, for example .msh, .vtu or .inp"
# Meshers write the boundary beside the body.
_BOUNDARY = {"vertex", "line", "line3"}
# More than a mesh of a section takes in any format; some files never end, as /dev/zero.
_LARGEST = 100_000_000


def read_quadrilaterals(path: Path) -> tuple[Floats, Integers]:
    """Read a plane mesh; quadrilaterals of four nodes get midside nodes on straight sides.

    Parameters
    ----------
    path
        In a format of meshio told by its ending, lengths in metres; in the plane x, y (z constant) or x, z (y
        constant).

    Returns
    -------
    nodes : ndarray, shape (n, 2)
        x and z [m].
    elements : ndarray, shape (m, 8)
        In the order of :class:`heeltoe.models.flexible.mesh.dam.BodyMesh`.

    Raises
    ------
    InputError
        Where the file cannot be read, holds anything but one piece of quadrilaterals of 4 or 8 nodes, or an element
        runs clockwise or is folded over.
    """
    name = str(path)
    mesh = _read(path)
    blocks: dict[str, list[Integers]] = {}
    for block in mesh.cells:
        if block.type not in _BOUNDARY and len(block.data):
            blocks.setdefault(block.type, []).append(np.asarray(block.data, dtype=np.int64))
    if list(blocks) not in (["quad"], ["quad8"]):
        raise InputError("mesh-kind", name, ", ".join(sorted(blocks)) or "no elements")
    kind, parts = blocks.popitem()
    elements = np.vstack(parts)
    if elements.min() < 0 or elements.max() >= len(mesh.points):
        raise InputError(
            "source-unreadable", name, reason="an element names a node that is not there", expected=_EXPECTED
        )
    nodes = _plane(np.asarray(mesh.points, dtype=np.float64), name)
    unused = np.setdiff1d(np.arange(len(nodes)), elements)
    if unused.size:
        raise InputError("mesh-unused", name, f"{unused.size}", first=int(unused[0]) + 1)
    if kind == "quad":
        nodes, elements = _with_midside_nodes(nodes, elements)
    check_elements(nodes, elements, name)
    check_pieces(nodes, elements, name)
    return nodes, elements


def _read(path: Path) -> Any:
    with package(str(path), "meshio"):
        import meshio
    try:
        content = read_bounded(path, _LARGEST)
        # Ansys has files of the same ending.
        kind = "gmsh" if content.startswith(b"$MeshFormat") else None
        if len(content) > _LARGEST:
            raise InputError(
                "too-large", str(path), f"{_LARGEST // 10**6} MB", expected="a mesh of some thousand elements"
            )
        if re.search(rb"^\s*\*include", content, re.IGNORECASE | re.MULTILINE):
            raise InputError(
                "source-unreadable",
                str(path),
                reason="it includes another file",
                expected="all of the mesh in one file",
            )
        # It is read once more, which a pipe does not bear.
        if not path.is_file():
            raise InputError("source-unreadable", str(path), reason="it is not a file", expected=_EXPECTED)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return meshio.read(path, kind)
    except SystemExit:  # this is how meshio ends when no reader for the ending knows the file
        raise InputError(
            "source-unreadable", str(path), reason="it is not what its ending says", expected=_EXPECTED
        ) from None
    except InputError:
        raise
    except Exception as error:  # its readers fail in any way that Python knows
        raise InputError("source-unreadable", str(path), reason=str(error).rstrip("."), expected=_EXPECTED) from None


def _plane(points: Floats, name: str) -> Floats:
    """Return the two coordinates of a plane mesh."""
    if not np.isfinite(points).all():
        raise InputError("mesh-not-finite", name, f"{int(np.argmin(np.isfinite(points).all(axis=1))) + 1}")
    if points.shape[1] == 2:
        return points.copy()
    extent = np.ptp(points, axis=0)
    for across, axes in ((2, [0, 1]), (1, [0, 2])):
        if extent[across] <= 1e-6 * extent.max():
            return points[:, axes]
    raise InputError("mesh-plane", name)


def _with_midside_nodes(nodes: Floats, elements: Integers) -> tuple[Floats, Integers]:
    sides = np.stack([elements, np.roll(elements, -1, axis=1)], axis=-1).reshape(-1, 2)
    ends, place = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    middles = nodes[ends].mean(axis=1)
    return np.vstack([nodes, middles]), np.hstack([elements, len(nodes) + place.reshape(-1, 4)])
