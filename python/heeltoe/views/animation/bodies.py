"""The parts of the dam as an animation moves them: points, and displacements as shapes with amplitudes in time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.geometry.section import CutSection
from heeltoe.models.flexible.mesh.checks import boundary_edges
from heeltoe.models.flexible.mesh.dam import BodyMesh
from heeltoe.models.flexible.result.history import CrackHistory
from heeltoe.result.histories import Histories

#: How far the displacements of an elastic part may be off, as a part of the largest: far below the pixel.
ACCURACY = 2e-4
#: Meshes of more elements are shown by their outline alone; their lines would only darken the picture.
_MOST_ELEMENTS = 1500


@dataclass(frozen=True)
class Moments:
    """Moments of an animation between the samples of a response.

    Attributes
    ----------
    before
        (f,) sample before each moment.
    share
        (f,) how far on the way to the next sample.
    nearest
        (f,) sample nearest to each moment.
    """

    before: Integers
    share: Floats
    nearest: Integers

    @classmethod
    def of(cls, samples: Floats, wanted: Floats) -> Moments:
        """Find moments `wanted` among the times of `samples`, of which there is at least one."""
        before = np.clip(np.searchsorted(samples, wanted, side="right") - 1, 0, max(samples.size - 2, 0))
        after = np.minimum(before + 1, samples.size - 1)
        length = samples[after] - samples[before]
        share = np.where(length > 0.0, (wanted - samples[before]) / np.where(length > 0.0, length, 1.0), 0.0)
        share = np.clip(share, 0.0, 1.0)
        return cls(before, share, np.where(share < 0.5, before, after))

    def between(self, values: Floats) -> Floats:
        """Return values of the samples (n, ...), linear between them, at each moment."""
        after = np.minimum(self.before + 1, len(values) - 1)
        share = self.share.reshape(-1, *(1,) * (values.ndim - 1))
        between: Floats = (1.0 - share) * values[self.before] + share * values[after]
        return between


@dataclass(frozen=True, eq=False)
class Part:
    """One part of the dam and its motion: ``displacement = sum of amplitudes x shapes``.

    Attributes
    ----------
    points
        (n, 2) where the points are drawn, x downstream and z up [m].
    outline
        Points around the part, counter-clockwise, not closed.
    grid
        (e, 2) points at the ends of the lines between elements; none of a rigid part.
    upstream, downstream
        Points along the two faces from bottom to top.
    crack
        Points along the crack from heel to toe.
    shapes
        (r, n, 2) displacements by which the part moves.
    amplitudes
        (f, r) how much of each there is at each moment of the animation.
    """

    points: Floats
    outline: Integers
    grid: Integers
    upstream: Integers
    downstream: Integers
    crack: Integers
    shapes: Floats
    amplitudes: Floats

    def displacements(self, points: Integers) -> Floats:
        """Return the displacements (f, p, 2) [m] of some points at all moments."""
        moved: Floats = self.amplitudes @ self.shapes[:, points].reshape(len(self.shapes), 2 * len(points))
        return moved.reshape(-1, len(points), 2)

    def drawn(self, frame: int, exaggeration: float) -> Floats:
        """Return where the points (n, 2) are drawn [m], with exaggerated displacements."""
        moved: Floats = self.points + exaggeration * np.tensordot(self.amplitudes[frame], self.shapes, axes=1)
        return moved


def rigid_parts(case: Case, histories: Sequence[Histories], moments: Moments) -> tuple[Part, ...]:
    """Return the rigid blocks from the crest down and, if the lowest crack is not at the base, what stands still below.

    `histories` are those of the cracks, from the crest down. A block moves by its own crack and by the cracks below it,
    which carry it.
    """
    motions = [
        _amplitudes(crack, history, moments) for crack, history in zip(case.single_crack_cases, histories, strict=True)
    ]
    parts: list[Part] = []
    for place, crack in enumerate(case.single_crack_cases):
        part = _between(case.single_crack_cases[place - 1], crack) if place else _top_block(crack.cut)
        shapes = np.concatenate([_shapes(below.cut, part.points) for below in case.single_crack_cases[place:]])
        parts.append(replace(part, shapes=shapes, amplitudes=np.concatenate(motions[place:], axis=1)))
    ground = part_below(case.single_crack_cases[-1].cut, case.outline)
    if ground is not None:
        parts.append(replace(ground, amplitudes=np.zeros((len(motions[0]), 0))))
    return tuple(parts)


def _amplitudes(case: Case, histories: Histories, moments: Moments) -> Floats:
    """Return how far (f, 4) the part above a crack moves along the four shapes of :func:`_shapes`.

    The contact coordinates are turned into the motion of a rigid body of any rotation: the corner that is lower slides
    along the crack, and the gaps are those of the histories. All four amplitudes multiply shapes that are linear in
    the place, so an exaggerated block keeps its gaps in proportion, too.
    """
    columns = (histories.slip_m, histories.gap_heel_m, histories.gap_toe_m, histories.rotation_rad)
    slip, heel, toe, rotation = map(moments.between, columns)
    width = case.cut.crack_width
    sine = np.clip((toe - heel) / width, -1.0, 1.0)
    cosine = np.where(np.abs(rotation) > math.pi / 2.0, -1.0, 1.0) * np.sqrt(1.0 - sine**2)
    # The heel's own motion; where the block stands on its toe, it is the toe that slips.
    along = np.where(sine < 0.0, slip + width * (1.0 - cosine), slip)
    return np.column_stack([along, heel, cosine - 1.0, sine])


def _shapes(section: CutSection, points: Floats) -> Floats:
    """Return the displacements (4, n, 2) of points above a crack: along it, across it, towards the heel, turned."""
    arm, ones = points - section.heel, np.ones((len(points), 2))
    along, across = section.from_crack_frame(1.0, 0.0), section.from_crack_frame(0.0, 1.0)
    return np.stack([ones * along, ones * across, arm, np.column_stack([-arm[:, 1], arm[:, 0]])])


def _top_block(section: CutSection) -> Part:
    """Return the part above a crack, still without motion."""
    points = np.array(section.polygon)
    top = np.flatnonzero(points[:, 1] == section.crest_elevation)
    return Part(
        points=points,
        outline=np.arange(len(points)),
        grid=np.empty((0, 2), dtype=np.int64),
        upstream=np.concatenate([[0], np.arange(len(points) - 1, top[-1] - 1, -1)]),
        downstream=np.arange(1, top[0] + 1),
        crack=np.array([0, 1]),
        shapes=np.zeros((0, len(points), 2)),
        amplitudes=np.zeros((0, 0)),
    )


def _between(upper: Case, lower: Case) -> Part:
    """Return the part between two cracks, still without motion; its crack is the lower one."""
    heel, toe = np.array(lower.cut.heel), np.array(lower.cut.toe)
    part = part_below(upper.cut, shapely.Polygon(np.array(lower.cut.polygon)), (heel, toe))
    assert part is not None
    return replace(part, crack=np.array([int(np.hypot(*(part.points - corner).T).argmin()) for corner in (heel, toe)]))


def part_below(section: CutSection, whole: shapely.Polygon, base: tuple[Floats, Floats] | None = None) -> Part | None:
    """Return the part of a section below a crack, still without motion; None where there is none to speak of. Its faces
    begin at the corners of its `base`, those of the lowest level where it is not given."""
    # By the line of the crack: the outline of the part above it is rounded, and would leave slivers along the faces.
    far = 10.0 * float(np.ptp(shapely.get_coordinates(whole), axis=0).max())
    along, across = np.array(section.from_crack_frame(far, 0.0)), np.array(section.from_crack_frame(0.0, far))
    heel_side, toe_side = np.array(section.heel) - along, np.array(section.toe) + along
    below = shapely.Polygon([heel_side - across, toe_side - across, toe_side, heel_side])
    rest = shapely.intersection(whole, below)
    rest = max(shapely.get_parts(rest), key=shapely.area, default=None)
    if rest is None or rest.area < 1e-6 * whole.area:
        return None
    points = shapely.get_coordinates(shapely.geometry.polygon.orient(rest).exterior)[:-1]
    if base is None:
        at_base = np.flatnonzero(points[:, 1] <= section.base_elevation + 1e-9 * section.height)
        base = points[at_base[points[at_base, 0].argmin()]], points[at_base[points[at_base, 0].argmax()]]
    corners = (section.heel, section.toe, *base)
    heel, toe, *ends = (int(np.hypot(*(points - corner).T).argmin()) for corner in corners)
    count = len(points)

    def round_to(start: int, end: int, step: int) -> Integers:
        return (start + step * np.arange((step * (end - start)) % count + 1)) % count

    return Part(
        points=points,
        outline=np.arange(count),
        grid=np.empty((0, 2), dtype=np.int64),
        upstream=round_to(ends[0], heel, -1),
        downstream=round_to(ends[1], toe, 1),
        crack=np.array([heel, toe]),
        shapes=np.zeros((0, count, 2)),
        amplitudes=np.zeros((0, 0)),
    )


def elastic_parts(history: CrackHistory, moments: Moments) -> tuple[Part, ...]:
    """Return the elastic parts of a run of the flexible model.

    Hundreds of modes move together; of their displacements the few shapes are taken that hold them to
    :data:`ACCURACY` (proper orthogonal decomposition), which an animation can carry along.
    """
    parts, fields = [], []
    for body, basis, amplitude in zip(history.dam.bodies, history.dam.modes, history.modes, strict=True):
        part, shown = _meshed(body.mesh)
        rows = np.column_stack([2 * shown, 2 * shown + 1]).reshape(-1)
        parts.append(part)
        fields.append(moments.between(amplitude) @ basis.shapes[rows].T)
    largest = max(float(np.abs(field).max()) for field in fields)
    return tuple(
        replace(part, shapes=shapes.reshape(-1, len(part.points), 2), amplitudes=amplitudes)
        for part, (amplitudes, shapes) in zip(
            parts, (_few_shapes(field, ACCURACY * largest) for field in fields), strict=True
        )
    )


def _few_shapes(field: Floats, allowed: float) -> tuple[Floats, Floats]:
    """Split a field (f, d) into amplitudes (f, r) and shapes (r, d) that give it back to `allowed`."""
    # By the eigenvectors of the smaller product of the field with itself, which is much faster than its decomposition
    # and exact enough.
    wide = field.shape[1] > field.shape[0]
    vectors = np.linalg.eigh(field @ field.T if wide else field.T @ field)[1][:, ::-1]
    count = min(4, vectors.shape[1])
    while True:
        chosen = vectors[:, :count]
        amplitudes, shapes = (chosen, chosen.T @ field) if wide else (field @ chosen, chosen.T)
        if count == vectors.shape[1] or np.abs(field - amplitudes @ shapes).max() <= allowed:
            break
        count = min(math.ceil(1.25 * count), vectors.shape[1])
    # Shapes of the size of displacements, amplitudes up to one: both keep their digits in single precision.
    scale = np.abs(amplitudes).max(axis=0)
    scale = np.where(scale > 0.0, scale, 1.0)
    return amplitudes / scale, scale[:, None] * shapes


def _meshed(mesh: BodyMesh) -> tuple[Part, Integers]:
    """Return the points of a mesh that are drawn, still without motion, and which of its nodes they are."""
    edges = boundary_edges(mesh.elements)
    following = {int(edge[0]): edge for edge in edges}
    around, corner = [], int(edges[0, 0])
    for _ in edges:
        edge = following[corner]
        around += [int(edge[0]), int(edge[1])]
        corner = int(edge[2])
    lines = np.empty((0, 2), dtype=np.int64)
    if len(mesh.elements) <= _MOST_ELEMENTS:
        sides = np.stack([mesh.elements[:, :4], np.roll(mesh.elements[:, :4], -1, axis=1)], axis=2).reshape(-1, 2)
        every, counts = np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)
        lines = every[counts > 1]
    shown = np.unique(np.concatenate([around, lines.reshape(-1)]).astype(np.int64))
    place = np.full(len(mesh.nodes), -1, dtype=np.int64)
    place[shown] = np.arange(shown.size)
    part = Part(
        points=mesh.nodes[shown],
        outline=place[np.array(around)],
        grid=place[lines],
        upstream=place[mesh.upstream],
        downstream=place[mesh.downstream],
        crack=place[mesh.faces[-1]],
        shapes=np.zeros((0, shown.size, 2)),
        amplitudes=np.zeros((0, 0)),
    )
    return part, shown
