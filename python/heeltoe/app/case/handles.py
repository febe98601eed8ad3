"""The handles of the drawing: what of a section can be dragged, from where to where, and what that changes in the case.

A handle is moved along x or z or both. What it stands for is said in the units that are chosen."""

from __future__ import annotations

import copy
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from heeltoe.base.payload import Json
from heeltoe.case.model import Case
from heeltoe.units.systems import Scale, unit_system

# More corners than these are moved in their table.
_MOST_CORNERS = 40
# The handle of the crack, and that of its inclination: parts of its width from the heel.
_CRACK_AT, _INCLINED_AT = 0.35, 0.8
_STEEPEST_DEG = 30.0
_NOTHING: Mapping[str, Any] = {}


@dataclass(frozen=True)
class Way:
    """One direction in which a handle goes.

    Attributes
    ----------
    axis
        ``"x"`` or ``"z"`` of the drawing.
    field
        Which it changes.
    value, least, most, step
        In `unit`.
    start, per_unit
        Where zero stands [m], and metres for each unit.
    unit
        Empty where it has none.
    """

    axis: str
    field: str
    value: float
    least: float
    most: float
    step: float
    start: float
    per_unit: float
    unit: str = ""

    def text(self, value: float) -> Any:
        """Return what is written into the field where the handle is at `value`, which is kept within its ends."""
        kept = min(max(round(value / self.step) * self.step, self.least), self.most)
        return f"{kept:.10g} {self.unit}" if self.unit else float(f"{kept:.10g}")


@dataclass(frozen=True)
class Handle:
    """A point that can be dragged; at `at` [m], in one or two directions."""

    name: str
    label: str
    at: tuple[float, float]
    ways: tuple[Way, ...]


def handles(case: Case, units: str) -> list[Handle]:
    """Return the handles of a case."""
    shape = [*(_corners(case, units) if case.section.polygon else _dimensions(case, units))]
    return [*shape, *_levels(case, units), *_along_crack(case, units)]


def moved(
    case: Case,
    units: str,
    name: str,
    to: Mapping[str, float] = _NOTHING,
    by: Mapping[str, float] = _NOTHING,
    fields: Mapping[str, Any] = _NOTHING,
) -> Json:
    """Return what changes in a case, by paths, where a handle is put to x and z [m], or moved by a number of steps;
    nothing where it does not exist. `fields` are those of the case as they were typed."""
    handle = next((handle for handle in handles(case, units) if handle.name == name), None)
    if handle is None:
        return {}
    changes: dict[str, Any] = {}
    for way in handle.ways:
        if way.axis in to:
            changes[way.field] = way.text(_value(case, way, to[way.axis]))
        elif way.axis in by:
            changes[way.field] = way.text(way.value + by[way.axis] * way.step)
    if any("[" in path for path in changes):
        own = case.model_dump(mode="json", exclude_unset=True)
        own_fields = fields or own
        if case.section.polygon is not None and "polygon" not in own_fields["section"]:
            # Corners from a file are the case's own from now on.
            own_fields = {**own_fields, "section": own["section"]}
        return _in_lists(own_fields, changes)
    return changes


def handle_data(handle: Handle) -> Json:
    """Return a handle as the page shows it."""
    texts = [f"{way.value:.5g} {way.unit}".strip() for way in handle.ways]
    text = f"x {texts[0]}, z {texts[1]}" if len(texts) > 1 else texts[0]
    last = handle.ways[-1]
    return {
        "name": handle.name, "label": handle.label, "at": handle.at, "axes": [way.axis for way in handle.ways],
        "text": text, "value": last.value, "least": last.least, "most": last.most,
    }  # fmt: skip


def _value(case: Case, way: Way, at: float) -> float:
    if way.field == "crack.inclination":
        run = _INCLINED_AT * (case.cut.toe[0] - case.cut.heel[0])
        return math.degrees(math.atan2(at - case.cut.heel[1], run))
    return (at - way.start) / way.per_unit


def _in_lists(fields: Mapping[str, Any], changes: Mapping[str, Any]) -> Json:
    """Return changes of corners and anchors as changes of the whole lists they stand in."""
    lists: dict[str, Any] = {}
    for path, value in changes.items():
        name, *places = path.replace("[", ".[").split(".[")
        block: Any = fields
        for part in name.split("."):
            block = block[part]
        kept = lists.setdefault(name, copy.deepcopy(block))
        place, _, last = places[0].partition("].")
        if last:
            kept[int(place)][last] = value
        else:
            row = list(kept[int(place.rstrip("]"))])
            row[int(places[1].rstrip("]"))] = value
            kept[int(place.rstrip("]"))] = row
    return lists


def length_text(case: Case, units: str, part: float) -> str:
    """Return a part of the height of a dam as it is typed."""
    lengths = _Lengths(case, units)
    return str(
        lengths.way("z", "", part * lengths.height, (0.0, lengths.height)).text(part * lengths.height / lengths.metres)
    )


def corners_of(case: Case, units: str) -> list[list[str]]:
    """Return the corners of a section as they are typed."""
    metres, unit = _Lengths(case, units).metres, _Lengths(case, units).unit
    return [[f"{length / metres:.8g} {unit}" for length in corner] for corner in case.section.vertices()]


class _Lengths:
    """Lengths of a case in the units that are chosen, with a step that fits its size."""

    def __init__(self, case: Case, units: str) -> None:
        scale: Scale = unit_system(units).scale("length")
        self.unit, self.metres = scale.unit, 1.0 / scale.factor
        self.left, self.base, self.right, self.crest = case.outline.bounds
        self.height = self.crest - self.base
        self.size = max(self.height, self.right - self.left)
        rough = self.size / self.metres / 200.0
        power = 10.0 ** math.floor(math.log10(rough))
        self.step = next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= rough * 0.999)

    def way(self, axis: str, field: str, value: float, ends: tuple[float, float], start: float = 0.0) -> Way:
        """Return a way whose field is a length: value and ends in metres."""
        low, high = ends
        m = self.metres
        return Way(axis, field, value / m, min(low, value) / m, max(high, value) / m, self.step, start, m, self.unit)


def _dimensions(case: Case, units: str) -> Iterator[Handle]:
    section, lengths = case.section, _Lengths(case, units)
    height, crest, base = section.height or 0.0, section.crest_width or 0.0, section.base_width or 0.0
    neck = section.neck_height or 0.0
    small, wide = lengths.step * lengths.metres, 3.0 * lengths.size
    depths = [water.depth for water in (case.reservoir, case.tailwater, case.silt) if water is not None]
    depths += [depth for depth in (case.statics.flood_depth, case.statics.flood_tailwater) if depth is not None]
    breaks = [level for face in (section.upstream, section.downstream) for level, _ in face or ()]
    lowest = max(neck, *(level + small for level in breaks), case.crack.elevation + small, *depths, small)
    yield Handle(
        "crest",
        "Crest",
        (crest, height),
        (
            lengths.way("x", "section.crest_width", crest, (0.0, wide)),
            lengths.way("z", "section.height", height, (lowest, wide)),
        ),
    )
    if section.neck_width is not None and section.neck_height is not None:
        yield Handle(
            "neck",
            "Neck",
            (section.neck_width, neck),
            (
                lengths.way("x", "section.neck_width", section.neck_width, (small, wide)),
                lengths.way("z", "section.neck_height", neck, (small, height - small)),
            ),
        )
    if section.base_width is None:
        return
    yield Handle(
        "base",
        "Downstream end of the base",
        (base, 0.0),
        (lengths.way("x", "section.base_width", base, (small, wide)),),
    )


def _corners(case: Case, units: str) -> Iterator[Handle]:
    lengths, corners = _Lengths(case, units), case.section.polygon or ()
    if len(corners) > _MOST_CORNERS:
        return
    wide = 3.0 * lengths.size
    for place, (x, z) in enumerate(corners):
        ends = ((lengths.left - wide, lengths.right + wide), (lengths.base - wide, lengths.crest + wide))
        yield Handle(
            f"corner {place + 1}",
            f"Corner {place + 1}",
            (x, z),
            (
                lengths.way("x", f"section.polygon[{place}][0]", x, ends[0]),
                lengths.way("z", f"section.polygon[{place}][1]", z, ends[1]),
            ),
        )


def _levels(case: Case, units: str) -> Iterator[Handle]:
    lengths = _Lengths(case, units)
    bodies = (
        ("reservoir", "Reservoir level", case.reservoir, lengths.left - 0.22 * lengths.size),
        ("tailwater", "Tailwater level", case.tailwater, lengths.right + 0.18 * lengths.size),
        ("silt", "Silt level", case.silt, lengths.left - 0.12 * lengths.size),
    )
    for name, label, body, x in bodies:
        if body is not None:
            way = lengths.way("z", f"{name}.depth", body.depth, (0.0, lengths.height), lengths.base)
            yield Handle(name, label, (x, lengths.base + body.depth), (way,))


def _along_crack(case: Case, units: str) -> Iterator[Handle]:
    section, lengths = case.cut, _Lengths(case, units)
    (left, low), (right, high) = section.heel, section.toe

    def at(part: float) -> tuple[float, float]:
        return left + part * (right - left), low + part * (high - low)

    yield _level(case, lengths, "crack", "Crack", "crack")
    slope = math.degrees(case.crack.inclination)
    # It ends in the downstream face, not in the base.
    falling = max(-_STEEPEST_DEG, -math.degrees(math.atan2(low - lengths.base, right - left)))
    turn = Way("z", "crack.inclination", slope, min(slope, falling), _STEEPEST_DEG, 0.5, low, 1.0, "deg")
    yield Handle("inclination", "Inclination of the crack", at(_INCLINED_AT), (turn,))
    position = case.uplift.drain_position
    if position is not None:
        way = Way("x", "uplift.drain_position", position, 0.01, 0.99, 0.01, left, right - left)
        yield Handle("drains", "Drains", at(position), (way,))
    if case.uplift.drain_x is not None:
        x = case.uplift.drain_x
        part = min(max((x - left) / (right - left), 0.0), 1.0)
        yield Handle("drains", "Drains", at(part), (lengths.way("x", "uplift.drain_x", x, (left, right)),))
    for place, crack in enumerate(case.further_cracks):
        alone = case.model_copy(update={"crack": crack.beside(case.crack)})
        name = f"further crack {place + 1}"
        yield _level(alone, lengths, name, name.capitalize(), f"further_cracks[{place}]")
    for place, anchor in enumerate(case.anchors):
        # What is given by its ends moves by their numbers.
        if anchor.distance is None:
            continue
        part = anchor.distance / section.crack_width
        way = Way(
            "x", f"anchors[{place}].distance", anchor.distance / lengths.metres, 0.0,
            section.crack_width / lengths.metres, lengths.step, left,
            lengths.metres * (right - left) / section.crack_width, lengths.unit,
        )  # fmt: skip
        yield Handle(f"anchor {place + 1}", f"Anchor {place + 1}", at(part), (way,))


def _level(case: Case, lengths: _Lengths, name: str, label: str, path: str) -> Handle:
    """Return the handle of the elevation of the crack of a case, whose block in the file has this path."""
    (left, low), (right, high) = case.cut.heel, case.cut.toe
    at = (left + _CRACK_AT * (right - left), low + _CRACK_AT * (high - low))
    highest = lengths.height - lengths.step * lengths.metres
    # It stands on the crack, the elevation counts at the heel.
    start = lengths.base + at[1] - low
    way = lengths.way("z", f"{path}.elevation", case.crack.elevation, (0.0, highest), start)
    return Handle(name, label, at, (way,))
