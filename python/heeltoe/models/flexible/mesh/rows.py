"""Rows of quadrilaterals between the upstream and the downstream face of a part of the dam.

Every line of nodes runs straight from face to face, every kink of a face is on such a line, and the rows grow and
shrink with the width of the dam. Above and below an inclined crack the lines turn evenly, from the crack's direction
to level, as they join points of the two faces at the same part of their heights. Towards a crack rows may become
thinner and their elements as many more: four elements of one row then meet two of the next. Or they become thinner and
their elements, as many in every row, smaller towards both ends of the crack. A pointed crest ends in three fields of
quadrilaterals that meet inside the tip, so that the mesh has the very area of the section: blunting the tip would need
many thin rows and still change weight and water pressure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.errors.error import InputError
from heeltoe.models.flexible.mesh.checks import check_elements

Line = tuple[Floats, Floats]

#: Rows per element across, so that any part has about so many elements; a tip has its own instead of some of them.
ROWS, _ROWS_OF_TIP = 1.65, 0.75
# Between these ratios to the width of their elements, rows are as high as its square root says: with as many elements,
# the higher frequencies of tall dams are much nearer to the exact ones than with rows as high as the elements are wide.
_SQUAT, _SLENDER = 1.0, 3.0
# Steps in which the height of rows is integrated over a segment between kinks; more where they grow with the distance.
_STEPS, _FINE_STEPS = 100, 4000
# So many times as long are graded elements in the middle of a crack as at its ends, were they as small as can be: of 8
# the first is a thirtieth of the width.
_GRADED = 16.0
# By so much of the distance to the crack are rows higher than those at it.
_GROWTH = 0.5
# A face that runs more than this per unit of rise is a ledge: elements on it would be needles.
_FLATTEST = 20.0
# Rows that are a smaller part of the width of their elements come from a slip in the corners or a crack at the base.
_THINNEST = 1e-4
# Kinks of the two faces closer than this part of a row share a line, which then slopes.
_NEAR = 0.25
# Rows that run together towards one face may become so much thinner than their elements are wide, and no more.
_WEDGE = 0.02


def meshed_rows(
    left: Floats,
    right: Floats,
    across: int,
    finer: tuple[int, int] = (0, 0),
    graded: tuple[bool, bool] = (False, False),
) -> tuple[Floats, Integers]:
    """Mesh the part of a section between two faces.

    Parameters
    ----------
    left, right
        Upstream and downstream face, straight between points (x, z) [m], from bottom to top; they end at one point, or
        two. Where they start or end at two heights, the first or the last line of nodes slopes.
    across
        Number of elements in a row, even where some are finer.
    finer
        How often the elements of the first and of the last row are halved.
    graded
        Whether the elements of the first and of the last row, none of which is halved, are :func:`graded_places`.

    Returns
    -------
    nodes, elements : ndarray
        As in :class:`heeltoe.models.flexible.mesh.dam.BodyMesh`.

    Raises
    ------
    InputError
        Where a face has a ledge or doubles back, two of its kinks are so close that elements between them would be
        too thin, rows run together to wedges thinner than elements can be, or a single element across would have to
        fill a tip.
    """
    for face in (left, right):
        run, rise = np.diff(face, axis=0).T
        if np.any(rise <= 0.0) or np.any(np.abs(run) > _FLATTEST * rise):
            raise InputError("mesh-section", "section")
    faces = left, right
    sloping = left[0, 1] != right[0, 1] or left[-1, 1] != right[-1, 1]
    span = (left[[0, -1], 1] + right[[0, -1], 1]) / 2.0
    if sloping:
        # Rows are laid out between faces that are stretched to the same heights, and put back.
        left, right = (_stretched(face, face[[0, -1], 1], span) for face in faces)
    keys = _key_lines(left, right, across)
    start, end = keys[-1]
    pointed = end[0] - start[0] <= 1e-9 * (end[1] - keys[0][0][1])
    if pointed and across < 2:
        raise InputError(
            "out-of-range", "flexible.elements_across", f"{across}", bound="of at least 2, as the crest is pointed"
        )
    if pointed:
        # Rows up to half the height of the uppermost segment, the tip from there.
        keys[-1] = ((keys[-2][0] + left[-1]) / 2.0, (keys[-2][1] + left[-1]) / 2.0)
    smallest = across * float(graded_places(across)[1])
    least = [smallest if is_graded else 0.5**halved for halved, is_graded in zip(finer, graded, strict=True)]
    lines = _spread(keys, across, across * (ROWS - _ROWS_OF_TIP if pointed else ROWS), least)
    halvings = _halvings(lines, across, finer)
    shifts = _shifts(lines, across, graded)
    if sloping:
        ends = (face[[0, -1], 1] for face in faces)
        back = [
            _stretched(np.array(points), span, ends_of_line)
            for points, ends_of_line in zip(zip(*lines, strict=True), ends, strict=True)
        ]
        lines = list(zip(*back, strict=True))
    fields = _fields(lines, across, halvings, shifts)
    if pointed:
        fields += _tip(*lines[-1], faces[0][-1], across * 2 ** halvings[-1])
    nodes, elements = _joined(fields)
    if shifts.any():
        straighten(nodes, elements)
    if sloping:
        _check_turned(lines, nodes, elements, across * 2 ** max(finer))
    return nodes, elements


def graded_places(across: int) -> Floats:
    """Return the corners of elements that grow evenly from both ends to the middle, as parts of the width, shape
    (across + 1,). Each element of half as many is two of these."""
    place = np.linspace(0.0, 1.0, across + 1)
    near = np.expm1(2.0 * math.log(_GRADED) * np.minimum(place, 1.0 - place)) / (2.0 * (_GRADED - 1.0))
    near[np.abs(place - 0.5) < 0.25 / across] = 0.5
    result: Floats = np.where(place <= 0.5, near, 1.0 - near)
    return result


def straighten(nodes: Floats, elements: Integers) -> None:
    """Put midside nodes between their corners."""
    ends = elements[:, :4]
    nodes[elements[:, 4:]] = (nodes[ends] + nodes[np.roll(ends, -1, axis=1)]) / 2.0


def _stretched(points: Floats, ends_of_line: Floats, wanted: Floats) -> Floats:
    """Return points with their heights moved as the two ends of their range are, which come out to the last bit."""
    part = (points[:, 1] - ends_of_line[0]) / (ends_of_line[1] - ends_of_line[0])
    return np.column_stack([points[:, 0], wanted[0] * (1.0 - part) + wanted[1] * part])


def _check_turned(lines: list[Line], nodes: Floats, elements: Integers, across: int) -> None:
    """Refuse rows that turn until their elements vanish."""
    ends = np.array(lines)
    thinnest = np.diff(ends[:, :, 1], axis=0).min()
    widest = (ends[:, 1, 0] - ends[:, 0, 0]).max() / across
    try:
        check_elements(nodes, elements, "section")
        folded = False
    except InputError:
        folded = True
    if folded or thinnest < _WEDGE * widest:
        raise InputError("mesh-wedge", "crack.inclination")


def _key_lines(left: Floats, right: Floats, across: int) -> list[Line]:
    """Return the lines through the kinks of both faces, from bottom to top."""
    levels = np.unique(np.concatenate([left[:, 1], right[:, 1]]))
    on_left, on_right = np.isin(levels, left[:, 1]), np.isin(levels, right[:, 1])
    widths = np.interp(levels, right[:, 1], right[:, 0]) - np.interp(levels, left[:, 1], left[:, 0])
    pairs: list[tuple[float, float]] = []
    joined = False
    for i, level in enumerate(levels):
        if joined:
            joined = False
            continue
        alone = i + 1 < len(levels) and on_left[i] != on_right[i]
        joined = bool(
            alone
            and on_left[i + 1] == on_right[i]
            and on_right[i + 1] == on_left[i]
            and levels[i + 1] - level < _NEAR * widths[i] / across
        )
        other = levels[i + 1] if joined else level
        pairs.append((level, other) if on_left[i] else (other, level))
    return [
        (np.array([np.interp(a, left[:, 1], left[:, 0]), a]), np.array([np.interp(b, right[:, 1], right[:, 0]), b]))
        for a, b in pairs
    ]


def _spread(keys: list[Line], across: int, wanted: float, least: Sequence[float]) -> list[Line]:
    """Put about as many lines between the key lines as are wanted, close where the part is narrow, and more of them
    where the smallest of its first or last elements is `least` times as wide as an even one, which is less than 1."""
    widths = np.array([end[0] - start[0] for start, end in keys]) / across
    heights = np.diff([(start[1] + end[1]) / 2.0 for start, end in keys])
    thin = heights < _THINNEST * widths[:-1]
    if thin.any():
        level = keys[int(np.argmax(thin))][0][1]
        raise InputError("mesh-thin", "section", f"{heights[thin][0]:.3g} m", level=f"{level:g} m")
    steps = _FINE_STEPS if min(least) < 1.0 else _STEPS
    places = (np.arange(steps) + 0.5) / steps
    width = widths[:-1, None] + np.diff(widths)[:, None] * places

    highest: Floats = np.full(width.shape, math.inf)

    def rows(scale: float) -> Floats:
        """Rows per step of each segment."""
        height = np.clip(scale * np.sqrt(width), _SQUAT * width, _SLENDER * width)
        density: Floats = heights[:, None] / np.minimum(height, highest) / steps
        return density

    # The coarsest scale is that at which all rows are as slender as they may be, the finest that of squat ones.
    fine, coarse = _SQUAT * math.sqrt(width.min()), _SLENDER * math.sqrt(width.max())
    for _ in range(50):
        middle = (fine + coarse) / 2.0
        fine, coarse = (middle, coarse) if rows(middle).sum() > wanted else (fine, middle)
    levels = np.cumsum([0.0, *heights])
    level = levels[:-1, None] + heights[:, None] * places
    for end, part in enumerate(least):
        if part < 1.0:
            lowest = widths[-end] * part
            highest = np.minimum(highest, lowest + _GROWTH * np.abs(level - levels[-end]))
    lines = keys[:1]
    for (below, above), density in zip(pairwise(keys), rows(coarse), strict=True):
        passed = np.concatenate([[0.0], np.cumsum(density)])
        count = max(1, round(passed[-1]))
        marks = np.arange(1, count) / count * passed[-1]
        parts = np.interp(marks, passed, np.linspace(0.0, 1.0, steps + 1))
        lines += [(below[0] + part * (above[0] - below[0]), below[1] + part * (above[1] - below[1])) for part in parts]
        lines.append(above)
    return lines


def _halvings(lines: list[Line], across: int, finer: tuple[int, int]) -> list[int]:
    """Return how often the elements along each line are halved: by one less from line to line at most."""
    ends = np.array(lines)
    widths, levels = ends[:, 1, 0] - ends[:, 0, 0], ends[:, :, 1].mean(axis=1)
    heights = np.diff(levels)

    def away(halved: int, widths: Floats, heights: Floats) -> list[int]:
        result = [halved]
        for width, height in zip(widths[1:], heights, strict=True):
            wanted = round(math.log2(max(width / across / height, 1.0)))
            result.append(min(max(wanted, result[-1] - 1), result[-1]))
        return result

    first, last = away(finer[0], widths, heights), away(finer[1], widths[::-1], heights[::-1])[::-1]
    return [max(pair) for pair in zip(first, last, strict=True)]


def _shifts(lines: list[Line], across: int, graded: tuple[bool, bool]) -> Floats:
    """Return how far downstream of an even one each corner of an element along each line is, as a part of the width of
    the line, shape (lines, across + 1): the shift of a graded end, which fades up to a distance of its width, or up to
    the other end."""
    ends = np.array(lines)
    levels, widths = ends[:, :, 1].mean(axis=1), ends[:, 1, 0] - ends[:, 0, 0]
    result: Floats = np.zeros((len(lines), across + 1))
    for end, is_graded in zip((0, -1), graded, strict=True):
        if is_graded:
            reach = min(widths[end], levels[-1] - levels[0])
            share = np.maximum(1.0 - np.abs(levels - levels[end]) / reach, 0.0)
            result += share[:, None] * (graded_places(across) - np.linspace(0.0, 1.0, across + 1))
    return result


def _fields(lines: list[Line], across: int, halvings: list[int], shifts: Floats) -> list[Floats]:
    """Return the fields of the rows between lines, see :func:`_field`."""
    if shifts.any():
        return [_field(lines, across, shifts)]
    result: list[Floats] = []
    start = 0
    for row, (below, above) in enumerate(pairwise(halvings)):
        if below != above:
            if row > start:
                result.append(_field(lines[start : row + 1], across * 2**below))
            result += _halved(lines[row], lines[row + 1], across * 2 ** max(below, above), upwards=below > above)
            start = row + 1
    if start + 1 < len(lines):
        result.append(_field(lines[start:], across * 2 ** halvings[-1]))
    return result


# A group of four elements that meets two: the corners of its six elements from their down-left one on, along the line
# with the four in quarters, towards the other in halves.
_GROUP = (
    ((1, 0), (2, 0), (2, 1), (1, 1)),
    ((2, 0), (3, 0), (3, 1), (2, 1)),
    ((0, 0), (1, 0), (1, 1), (0, 2)),
    ((3, 0), (4, 0), (4, 2), (3, 1)),
    ((1, 1), (2, 1), (2, 2), (0, 2)),
    ((2, 1), (3, 1), (4, 2), (2, 2)),
)


def _halved(below: Line, above: Line, columns: int, *, upwards: bool) -> list[Floats]:
    """Return the elements of a row of which one line has `columns` and the other half of them, each as a field of its
    own; `upwards` where the upper one has fewer."""
    result = []
    for first in range(0, columns, 4):
        for corners in _GROUP:
            points = []
            for quarter, half in corners:
                along, up = (first + quarter) / columns, half / 2.0 if upwards else 1.0 - half / 2.0
                start, end = (line[0] + along * (line[1] - line[0]) for line in (below, above))
                points.append(start + up * (end - start))
            # Upside down, the other way around.
            low_left, low_right, high_right, high_left = points if upwards else points[::-1]
            result.append(_field([(low_left, low_right), (high_left, high_right)], 1))
    return result


def _field(lines: list[Line], across: int, shifts: Floats | None = None) -> Floats:
    """Return the points of the elements between lines, midside nodes and centres too, shape (rows, columns, 2); their
    corners are shifted along the lines by parts of the width, shape (lines, across + 1)."""
    ends = np.array(lines)
    ends = np.insert(ends, range(1, len(ends)), (ends[1:] + ends[:-1]) / 2.0, axis=0)
    part = np.linspace(0.0, 1.0, 2 * across + 1)[:, None]
    if shifts is not None:
        shifts = np.insert(shifts, range(1, across + 1), (shifts[:, 1:] + shifts[:, :-1]) / 2.0, axis=1)
        shifts = np.insert(shifts, range(1, len(shifts)), (shifts[1:] + shifts[:-1]) / 2.0, axis=0)
        part = part + shifts[:, :, None]
    points: Floats = ends[:, None, 0] + part * (ends[:, None, 1] - ends[:, None, 0])
    return points


def _tip(left: Floats, right: Floats, apex: Floats, across: int) -> list[Floats]:
    """Return the three fields of a triangle whose base has `across` elements."""
    a, b = (across + 1) // 2, across // 2
    # Each side is cut in two, from cut to cut through one point inside; the base into a and b elements, and from the
    # base up the left flank into b and b, the right into b and a.
    base = left + (right - left) * a / across
    flank_left, flank_right = left + (apex - left) / 2.0, right + (apex - right) * b / across
    middle = (base + flank_left + flank_right) / 3.0

    def between(below: Line, above: Line, columns: int) -> Floats:
        part = np.linspace(0.0, 1.0, b + 1)[:, None]
        starts, ends = below[0] + part * (above[0] - below[0]), below[1] + part * (above[1] - below[1])
        return _field(list(zip(starts, ends, strict=True)), columns)

    return [
        between((left, base), (flank_left, middle), a),
        between((base, right), (middle, flank_right), b),
        between((flank_left, middle), (apex, flank_right), a),
    ]


def _joined(fields: list[Floats]) -> tuple[Floats, Integers]:
    """Return nodes and elements of fields of points, with the nodes that two fields share made one."""
    result, start = [], 0
    for field in fields:
        rows, columns, _ = field.shape
        numbers = start + np.arange(rows * columns).reshape(rows, columns)
        start += rows * columns
        # Down-left corner of each element, and from there its nodes in their order.
        up = columns
        offsets = np.array([0, 2, 2 * up + 2, 2 * up, 1, up + 2, 2 * up + 1, up])
        result.append(numbers[:-2:2, :-2:2].reshape(-1, 1) + offsets)
    nodes = np.vstack([field.reshape(-1, 2) for field in fields])
    elements = np.vstack(result)
    if len(fields) > 1:
        from scipy.spatial import cKDTree

        near = cKDTree(nodes).query_ball_point(nodes, 1e-9 * np.ptp(nodes, axis=0).max())
        elements = np.array([min(others) for others in near])[elements]
    used, places = np.unique(elements, return_inverse=True)
    return nodes[used], places.reshape(elements.shape).astype(np.int64)
