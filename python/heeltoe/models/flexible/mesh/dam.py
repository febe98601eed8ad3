"""The dam as bodies of eight-node quadrilaterals, above and below its cracks.

The program's own mesh follows the section row by row (:mod:`heeltoe.models.flexible.mesh.rows`); a mesh from a file may
have any shape whose crack and area are those of the section."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import shapely

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.crack.kinks import climbs
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.geometry.axes import in_x_and_z
from heeltoe.geometry.axes import places as locate
from heeltoe.geometry.section import CutSection
from heeltoe.models.flexible.mesh.checks import boundary_edges
from heeltoe.models.flexible.mesh.faces import followed
from heeltoe.models.flexible.mesh.rows import meshed_rows

# As parts of the size of a mesh: nodes this close to the crack line are on it (files may have single precision),
# and the area may differ by this much.
_ON_LINE = 1e-6
_AREA = 0.01
# A part below the crack with less than this part of the area above it is rounding.
_NOTHING = 1e-9


@dataclass(frozen=True, eq=False)
class BodyMesh:
    """One part of the dam.

    Parameters
    ----------
    nodes
        x and z [m] in the coordinates of the case, shape (n, 2).
    elements
        Four corners counter-clockwise, then the midside nodes between corners 1-2, 2-3, 3-4, 4-1, shape (m, 8).
    crack
        Nodes of the crack face from the heel to the toe, midside nodes included, shape (k,), k odd; of a part between
        two cracks those of the one above it, then those of the one below it.
    upstream, downstream
        Nodes along the two faces from bottom to top, midside nodes included.
    fixed
        Nodes held still: the base of the lower part, none of the upper.
    missed
        How far corners of the section are from it at most, where they are finer than its rows [m].
    top
        How many nodes of `crack`, the first ones, are those of the crack above a part that has one below, too.
    """

    nodes: Floats
    elements: Integers
    crack: Integers
    upstream: Integers
    downstream: Integers
    fixed: Integers
    missed: float = 0.0
    top: int = 0

    @property
    def faces(self) -> tuple[Integers, ...]:
        """Nodes of each crack's face from the heel to the toe, the upper crack first."""
        return (self.crack[: self.top], self.crack[self.top :]) if self.top else (self.crack,)

    def facing(self, face: int) -> BodyMesh:
        """Return the part with one of its faces alone."""
        return replace(self, crack=self.faces[face], top=0)


@dataclass(frozen=True, eq=False)
class DamMesh:
    """The parts of the dam.

    Parameters
    ----------
    above
        Those above a crack, from the crest down.
    lower
        The part below all cracks; None where the lowest is at the base and the foundation is a rigid plane.
    """

    above: tuple[BodyMesh, ...]
    lower: BodyMesh | None

    @property
    def upper(self) -> BodyMesh:
        """The uppermost part."""
        return self.above[0]

    @property
    def parts(self) -> tuple[BodyMesh, ...]:
        """Parts of the dam, one or more."""
        return self.above if self.lower is None else (*self.above, self.lower)


def dam_mesh(case: Case, graded: Sequence[bool] | None = None) -> DamMesh:
    """Return the mesh of the dam.

    Parameters
    ----------
    case
        Its block `flexible` says how fine, or names files.
    graded
        Along which cracks, from the crest down, elements become smaller towards both ends, see :func:`graded_cracks`;
        None for none, as where all cracks are bonded.

    Raises
    ------
    InputError
        Where rows of elements cannot follow the section or the crack, or a mesh from a file is unfit.
    """
    options, section, directory = case.flexible, case.cut, case.base_directory
    graded, grounded = graded or [False] * len(case.single_crack_cases), _is_grounded(case)
    if case.further_cracks:
        above = _parts_above(case, graded, grounded=grounded)
        lowest = case.single_crack_cases[-1]
        if grounded:
            return DamMesh(above, None)
        counts = options.row_counts(below=True)
        return DamMesh(above, _own(*_faces_below(lowest), counts, lowest.cut, above=False, graded=graded[-1]))
    below = case.outline.area - section.area
    _check_ends(section, grounded=grounded)
    if options.mesh_above:
        upper = _from_file(directory / options.mesh_above, section, section.area, above=True)
    else:
        faces = section.upstream_face, section.downstream_face
        upper = _own(*faces, options.row_counts(), section, above=True, graded=graded[0])
    if grounded:
        if options.mesh_below:
            raise InputError(
                "option-foreign",
                "flexible.mesh_below",
                options.mesh_below,
                owner="a dam whose crack is at the base",
                remedy="",
            )
        return DamMesh((upper,), None)
    if options.mesh_below:
        return DamMesh((upper,), _from_file(directory / options.mesh_below, section, below, above=False))
    counts = options.row_counts(below=True)
    return DamMesh((upper,), _own(*_faces_below(case), counts, section, above=False, graded=graded[0]))


def graded_cracks(case: Case) -> list[bool]:
    """Return of which cracks, from the crest down, the elements become smaller towards both ends: a part that rocks
    above the base stands on much less than an even element.

    The thesis has even elements. Kinks and bonds need them everywhere along the crack, and who gives a mesh or rows
    that grow has his own.
    """
    options, single_crack_cases = case.flexible, case.single_crack_cases
    as_in_thesis = "thesis" in (options.damping, options.virtual_mass) or options.contact == "idce"
    halved = options.row_counts()[1] or options.row_counts(below=True)[1]
    if as_in_thesis or halved or options.mesh_above or options.mesh_below:
        return [False] * len(single_crack_cases)
    graded = [not (climbs(alone.crack.kinks) or alone.crack.bond) for alone in single_crack_cases]
    graded[-1] = graded[-1] and not _is_grounded(case)
    return graded


def _is_grounded(case: Case) -> bool:
    """Return whether the lowest crack is at the base, or along a sloping one, so that nothing is below it."""
    above = case.single_crack_cases[-1].cut.area
    return bool(case.outline.area - above <= _NOTHING * above)


def _parts_above(case: Case, graded: Sequence[bool], *, grounded: bool) -> tuple[BodyMesh, ...]:
    """Return the parts above each of several cracks, from the crest down."""
    counts = away, halvings = case.flexible.row_counts()
    sections = [single_crack_case.cut for single_crack_case in case.single_crack_cases]
    for section in sections:
        _check_ends(section, grounded=grounded and section is sections[-1])
    first = sections[0]
    result = [_own(first.upstream_face, first.downstream_face, counts, first, above=True, graded=graded[0])]
    for (high, low), (at_high, at_low) in zip(pairwise(sections), pairwise(graded), strict=True):
        upstream = _up_to(low.upstream_face, high.heel)
        downstream = _up_to(low.downstream_face, high.toe)
        faces = followed(upstream, downstream, away, above=False)
        rows = meshed_rows(faces.upstream, faces.downstream, away, (halvings, halvings), (at_low, at_high))
        mesh = _between(*rows, high, low)
        result.append(replace(mesh, missed=faces.missed))
    return tuple(result)


def _up_to(face: Floats, end: tuple[float, float]) -> Floats:
    """Return a face from bottom to top as far as the end of a crack on it."""
    slack = 1e-9 * np.ptp(face, axis=0).max()
    return np.vstack([face[face[:, 1] < end[1] - slack], end])


def _between(nodes: Floats, elements: Integers, high: CutSection, low: CutSection) -> BodyMesh:
    """Find the faces on the boundary of a part between two cracks."""
    ends = [_nearest(nodes, point) for point in (low.heel, low.toe, high.toe, high.heel)]
    edges = boundary_edges(elements)
    path = _walked(edges, int(np.flatnonzero(edges[:, 0] == ends[0])[0]))
    # With the body on its left the boundary runs downstream along the lower crack.
    toe, upper_toe, upper_heel = (int(np.flatnonzero(path == node)[0]) for node in ends[1:])
    bottom, downstream = path[: toe + 1], path[toe : upper_toe + 1]
    top, upstream = path[upper_toe : upper_heel + 1][::-1], path[upper_heel:][::-1]
    none = np.empty(0, dtype=np.int64)
    return BodyMesh(nodes, elements, np.concatenate([top, bottom]), upstream, downstream, none, top=top.size)


def _nearest(nodes: Floats, point: tuple[float, float]) -> int:
    return int(np.hypot(*(nodes - point).T).argmin())


def _own(
    upstream: Floats,
    downstream: Floats,
    counts: tuple[int, int],
    section: CutSection,
    *,
    above: bool,
    graded: bool = False,
) -> BodyMesh:
    """Return the program's own mesh between two faces, with such counts of its rows' elements, which may be graded
    along the crack."""
    away, halvings = counts
    faces = followed(upstream, downstream, away, above=above)
    finer = (halvings, 0) if above else (0, halvings)
    ends = (graded, False) if above else (False, graded)
    mesh = _body(*meshed_rows(faces.upstream, faces.downstream, away, finer, ends), section, "section", above=above)
    return replace(mesh, missed=faces.missed)


def _check_ends(section: CutSection, *, grounded: bool) -> None:
    """Refuse an inclined crack at one of whose ends there is nothing above or below it."""
    if section.inclination == 0.0:
        return
    slack = _ON_LINE * section.crack_width
    for end, (_, z) in (("heel", section.heel), ("toe", section.toe)):
        if z <= section.base_elevation + slack and not grounded:
            raise InputError("mesh-nothing", "crack.inclination", side="below", end=end)
        if z >= section.crest_elevation - slack:
            raise InputError("mesh-nothing", "crack.inclination", side="above", end=end)


def _from_file(path: Path, section: CutSection, area: float, *, above: bool) -> BodyMesh:
    if not os.path.isfile(path):
        raise InputError("file-missing", f"flexible.mesh_{'above' if above else 'below'}", path, expected="a mesh")
    # Needs an optional package and is seldom used.
    from heeltoe.models.flexible.mesh.file import read_quadrilaterals

    nodes, elements = read_quadrilaterals(path)
    name = str(path)
    # The crack line in the middle of the lower or upper side, as far as one can tell where a mesh is.
    places = locate(nodes, section)
    (left, bottom), (right, top) = places.min(axis=0), places.max(axis=0)
    edge = bottom if above else top
    if right <= 0.0 or left >= section.crack_width or abs(edge) > max(top - bottom, section.crack_width):
        (left, bottom), (right, top) = nodes.min(axis=0), nodes.max(axis=0)
        result = f"x from {left:g} to {right:g} m, z from {bottom:g} to {top:g} m"
        raise InputError("mesh-far", name, result, crack=_crack_place(section))
    mesh = _body(nodes, elements, section, name, above=above)
    # Exactly on the line, so that the two faces of the crack touch.
    along = places[mesh.crack, 0]
    along[[0, -1]] = 0.0, section.crack_width
    nodes[mesh.crack] = in_x_and_z(np.column_stack([along, np.zeros(len(along))]), section) + section.heel
    nodes[mesh.crack[[0, -1]]] = section.heel, section.toe
    edges = boundary_edges(elements)
    # Green's theorem with Simpson's rule, exact on edges of three nodes.
    start, middle, end = (nodes[edges[:, i]] for i in range(3))
    meshed = sum(
        weight * float(np.sum(place[:, 0] * along[:, 1]))
        for weight, place, along in (
            (1 / 6, start, 4.0 * middle - 3.0 * start - end),
            (4 / 6, middle, end - start),
            (1 / 6, end, start + 3.0 * end - 4.0 * middle),
        )
    )
    if abs(meshed - area) > _AREA * area:
        raise InputError("mesh-area", name, f"{meshed:.6g} m^2", area=f"{area:.6g} m^2")
    return mesh


def _crack_place(section: CutSection) -> str:
    (heel, bottom), (toe, top) = section.heel, section.toe
    if bottom == top:
        return f"x from {heel:g} to {toe:g} m at z = {bottom:g} m"
    return f"x from {heel:g} to {toe:g} m and z from {bottom:g} to {top:g} m"


def _body(nodes: Floats, elements: Integers, section: CutSection, name: str, *, above: bool) -> BodyMesh:
    """Find crack, faces and base on the boundary of a mesh."""
    slack = _ON_LINE * np.ptp(nodes, axis=0).max()
    places = locate(nodes, section)
    edges = boundary_edges(elements)
    t, n = places[edges, 0], places[edges, 1]
    on_crack = np.all((np.abs(n) <= slack) & (t >= -slack) & (t <= section.crack_width + slack), axis=1)
    # With the body on the left, the crack runs downstream along the upper part and upstream along the lower.
    on_crack &= (t[:, 2] > t[:, 0]) == above
    start, end = (0.0, section.crack_width) if above else (section.crack_width, 0.0)
    starts = np.flatnonzero(on_crack & (np.abs(t[:, 0] - start) <= slack))
    path = _walked(edges, int(starts[0])) if starts.size else np.empty(0, dtype=np.int64)
    last = 2 * int(on_crack.sum())
    walked = path[: last + 1]
    if last >= len(path) or abs(places[path[last], 0] - end) > slack or np.ptp(places[walked, 1]) > 2.0 * slack:
        side = places[:, 1].min() if above else places[:, 1].max()
        width = nodes[np.abs(places[:, 1] - side) <= slack]
        result = f"x from {width[:, 0].min():g} to {width[:, 0].max():g} m at z = {width[0, 1]:g} m"
        raise InputError("mesh-crack", name, result, crack=_crack_place(section), side="lower" if above else "upper")
    crack, rest = path[: last + 1], path[last:]
    heights = nodes[rest, 1]
    far = np.flatnonzero(np.abs(heights - (heights.max() if above else heights.min())) <= slack)
    onward, back = rest[: far[0] + 1], rest[far[-1] :]
    if above:
        return BodyMesh(nodes, elements, crack, back[::-1], onward, np.empty(0, dtype=np.int64))
    if len(far) < 3:
        raise InputError("mesh-base", name)
    return BodyMesh(nodes, elements, crack[::-1], onward[::-1], back, rest[far])


def _walked(edges: Integers, first: int) -> Integers:
    """Return the nodes along the boundary from the start of an edge once around, the first again at the end."""
    following = {int(edge[0]): edge for edge in edges}
    path, edge = [], edges[first]
    while True:
        path += [edge[0], edge[1]]
        if edge[2] == path[0]:
            return np.array([*path, edge[2]])
        edge = following[int(edge[2])]


def _faces_below(case: Case) -> tuple[Floats, Floats]:
    """Return the two faces of the part below the crack, from the base up."""
    corners = shapely.get_coordinates(case.outline.exterior)[:-1]
    section = case.cut
    base, slack = section.base_elevation, 1e-9 * np.ptp(corners, axis=0).max()
    on_base = np.abs(corners[:, 1] - base) <= slack
    first = np.flatnonzero(on_base & ~np.roll(on_base, 1))
    ring, count = np.roll(corners, -first[0], axis=0), int(on_base.sum())
    if len(first) != 1 or count < 2:
        raise InputError("mesh-section", "section")
    faces = []
    for chain, end in ((np.vstack([ring[:1], ring[:0:-1]]), section.heel), (ring[count - 1 :], section.toe)):
        level = end[1]
        higher = int(np.flatnonzero(chain[:, 1] > level - slack)[0])
        (x0, z0), (x1, z1) = chain[higher - 1 : higher + 1]
        # A face that does not lead to the end of the crack leads to a ledge.
        if abs(x0 + (x1 - x0) * (level - z0) / (z1 - z0) - end[0]) > 1e3 * slack:
            raise InputError("mesh-section", "section")
        face = np.vstack([chain[:higher], end])
        face[0, 1] = base
        faces.append(face)
    return faces[0], faces[1]
