"""The outline of a section in a mesh of plane elements: Gmsh (.msh), Abaqus and CalculiX (.inp)."""

from __future__ import annotations

from collections import Counter

import numpy as np
import shapely

from heeltoe.base.abaqus_mesh import is_abaqus, read_abaqus
from heeltoe.base.arrays import Floats
from heeltoe.base.gmsh_mesh import is_gmsh, read_gmsh
from heeltoe.base.plane_mesh import PlaneMesh
from heeltoe.errors.error import InputError, shown

Corners = list[tuple[float, float]]

# As parts of the larger side of the mesh: nodes so near are one, a corner so near to a straight line is none, and a
# mesh is so thin at most.
_SAME, _STRAIGHT, _PLANE = 1e-7, 1e-6, 1e-6
_MOST_NAMES = 8
# Numbers beyond this are places in no unit.
_FARTHEST = 1e12


def is_mesh(content: bytes) -> bool:
    """Whether the content of a file is a mesh of a kind that is read."""
    return is_gmsh(content) or is_abaqus(content)


def corners_of_mesh(content: bytes, layer: str | None) -> Corners:
    """Return the corners of the outline of a mesh as they stand.

    Parameters
    ----------
    content
        Of the file.
    layer
        Sets of elements, or physical groups, that are the dam, divided by commas; needed where there are several.

    Raises
    ------
    InputError
        Where it cannot be read, is not plane, or its elements are not one section without holes.
    """
    try:
        text = content.decode("utf-8-sig", errors="replace")
        mesh = read_gmsh(text) if is_gmsh(content) else read_abaqus(text)
        rings = _chosen(mesh, layer)
        used = sorted({node for ring in rings for node in ring})
        points = np.array([mesh.points[node] for node in used], dtype=np.float64).reshape(-1, 3)
    except KeyError as error:
        raise _unreadable(f"a node or section {error} is not there") from None
    except (ValueError, IndexError, OverflowError) as error:
        raise _unreadable(str(error).rstrip(".")[:120]) from None
    if not rings:
        raise _without("plane elements")
    known = (np.abs(points) < _FARTHEST).all(axis=1)
    if not known.all():
        raise InputError("mesh-not-finite", "section.file", used[int(known.argmin())].strip())
    plane = _plane(points)
    place = dict(zip(used, plane.tolist(), strict=True))
    return _outline([[place[node] for node in ring] for ring in rings], plane)


def _unreadable(reason: str) -> InputError:
    expected = "a plane mesh as text, .msh (2.2 or 4.1) or .inp"
    return InputError("source-unreadable", "section.file", reason=reason, expected=expected)


def _without(what: str) -> InputError:
    remedy = "give triangles or quadrilaterals of 3, 4, 6, 8 or 9 nodes"
    return InputError("another-kind", "section.file", f"a mesh without {what}", wanted="a section", remedy=remedy)


def _chosen(mesh: PlaneMesh, layer: str | None) -> list[list[str]]:
    """Return the nodes around the elements that are the dam."""
    counts = Counter(name for _, names in mesh.elements for name in names)
    known = ", ".join(shown(name) for name, _ in counts.most_common(_MOST_NAMES)) or "none"
    if layer is None:
        parts = [name for name, count in counts.items() if count < len(mesh.elements)]
        if parts:
            how = "by section.layer, or name all that are the dam, divided by commas"
            raise InputError("several", "section.layer", known, things="sets of elements", how=how)
        return [ring for ring, _ in mesh.elements]
    by_letters = {name.lower(): name for name in counts}
    wanted = [word.strip() for word in layer.split(",")]
    for word in wanted:
        if word.lower() not in by_letters:
            raise InputError("not-a-choice", "section.layer", shown(word), choices=known)
    own = {by_letters[word.lower()] for word in wanted}
    return [ring for ring, names in mesh.elements if names & own]


def _plane(points: Floats) -> Floats:
    """Return the two coordinates of points that are in the plane x, y or x, z."""
    extent = np.ptp(points, axis=0)
    for across, axes in ((2, [0, 1]), (1, [0, 2])):
        if extent[across] <= _PLANE * extent.max():
            return points[:, axes]
    raise InputError("mesh-plane", "section.file")


def _outline(rings: list[list[list[float]]], points: Floats) -> Corners:
    """Return the corners around all elements."""
    size = float(np.ptp(points, axis=0).max())
    # The two faces of a crack become one where their nodes are in the same places.
    from scipy.spatial import cKDTree

    tree = cKDTree(points)
    first = np.array([min(near) for near in tree.query_ball_point(points, _SAME * size)])
    elements = [shapely.make_valid(shapely.Polygon(points[first[tree.query(ring)[1]]])) for ring in rings]
    whole = shapely.union_all(elements)
    if whole.geom_type != "Polygon":
        # Faces that lie on each other although their nodes do not.
        whole = shapely.union_all(elements, grid_size=_SAME * size)
    if not whole.area > 0.0:
        raise _without("an area")
    if whole.geom_type != "Polygon":
        count = f"{len(shapely.get_parts(whole))}"
        raise InputError("mesh-pieces", "section.file", count)
    # A hole thinner than the tolerance is rounding between two faces.
    holes = [hole for hole in whole.interiors if shapely.Polygon(hole).area > _SAME * size * hole.length]
    if holes:
        raise InputError(
            "another-kind",
            "section.file",
            f"a mesh with holes ({len(holes)})",
            wanted="a section without any",
            remedy="fill galleries, or name the sets of elements that do by section.layer",
        )
    around = shapely.get_coordinates(whole.exterior)[:-1]
    # From a corner of the hull, so that a straight side with the first point in its middle loses it, too.
    around = np.roll(around, -int(around.sum(axis=1).argmin()), axis=0)
    straight = shapely.simplify(shapely.LinearRing(around), _STRAIGHT * size)
    corners = shapely.get_coordinates(straight)[:-1]
    # The nodes themselves, to the last bit.
    nearest = tree.query(corners)[1]
    return [(x, z) for x, z in points[nearest].tolist()]
