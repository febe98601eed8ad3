"""Drawings on the page of a case: its section as shapes [m], and the curve of its friction law."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import shapely

from heeltoe.base.payload import Json
from heeltoe.case.at_crack import anchor_line
from heeltoe.case.crack.law import Law
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.law_curve import SAMPLES, LawCurve, curve_of
from heeltoe.mechanics.loads import uplift_profile
from heeltoe.mechanics.section_shapes import section_shapes
from heeltoe.units.sentences import written
from heeltoe.units.systems import unit_system

# How deep the diagram of the uplift hangs below the crack, as a part of the size of the dam.
_UPLIFT = 0.16
# Margins of the view, as parts of the size: left, right, above, below.
_MARGINS = (0.42, 0.36, 0.12, 0.2)
# A law is drawn by one of this many of its points.
_EVERY = 4
_KINDS = {"slip path": "displacement", "slip speed": "velocity", "normal stress": "pressure"}


def drawing(case: Case, units: str) -> Json:
    """Return the shapes of a case from the back to the front, what is written beside them, and what of the plane is
    seen."""
    left, base, right, crest = case.outline.bounds
    size = max(right - left, crest - base)
    west, east, above, below = (part * size for part in _MARGINS)
    return {
        "view": [left - west, base - below, right + east, crest + above],
        "shapes": [{"kind": kind, "rings": rings} for kind, rings in _shapes(case, size)],
        "lines": [{"kind": kind, "points": points} for kind, points in _lines(case, size)],
        "notes": list(_notes(case, units)),
    }


def _shapes(case: Case, size: float) -> Iterator[tuple[str, list[Any]]]:
    for kind, shape in section_shapes(case):
        yield kind, [shapely.get_coordinates(part)[:-1].tolist() for part in shapely.get_parts(shape)]
    for crack in case.single_crack_cases:
        uplift = _uplift(crack, size)
        if uplift:
            yield "uplift", [uplift]


def _uplift(case: Case, size: float) -> list[list[float]]:
    """Return the diagram of the uplift below the crack; nothing where there is none."""
    profile = uplift_profile(case)
    largest = float(np.abs(profile[:, 1]).max())
    if not largest:
        return []
    section = case.cut
    points = [(0.0, 0.0), *((at, -_UPLIFT * size * pressure / largest) for at, pressure in profile.tolist())]
    points.append((section.crack_width, 0.0))
    corners = [section.from_crack_frame(along, across) for along, across in points]
    return [[section.heel[0] + x, section.heel[1] + z] for x, z in corners]


def _lines(case: Case, size: float) -> Iterator[tuple[str, list[list[float]]]]:
    section = case.cut
    for crack in case.single_crack_cases:
        kind = "crack" if crack is case.single_crack_cases[case.asked] else "further-crack"
        yield kind, crack.crack_line.tolist()
    position = case.uplift_at_crack.drain_position
    if position is not None:
        x, z = section.from_crack_frame(position * section.crack_width, 0.0)
        foot = [section.heel[0] + x, section.heel[1] + z]
        yield "drain", [foot, [foot[0], foot[1] + 0.3 * section.height]]
    for anchor in case.anchors:
        end, start = anchor_line(anchor, section, 0.15 * size)
        yield "anchor", [list(start), list(end)]


def _notes(case: Case, units: str) -> Iterator[dict[str, object]]:
    """Walk what is written in the drawing: slopes of the downstream face, and heel and toe."""
    section, length = case.cut, unit_system(units).scale("length")
    yield {"at": list(section.heel), "text": "heel", "side": "heel"}
    yield {"at": list(section.toe), "text": "toe", "side": "toe"}
    _, base, _, crest = case.outline.bounds
    for edges, side in ((section.upstream_edges, "left"), (section.downstream_edges, "right")):
        for edge in edges:
            rise = edge.z1 - edge.z0
            if rise > 0.15 * (crest - base) and abs(edge.slope) > 1e-6:
                at = [section.heel[0] + (edge.x0 + edge.x1) / 2.0, section.heel[1] + (edge.z0 + edge.z1) / 2.0]
                yield {"at": at, "text": f"{abs(edge.slope):.3g} : 1", "side": side}
    yield {
        "at": list(section.centroid),
        "text": f"{length(section.crack_width):.4g} {length.unit} wide at the crack",
        "side": "middle",
    }


def law(case: Case, units: str) -> Json | None:
    """Return the curve of the law of a case under its static loads; None where it has no law, or no curve."""
    if case.crack.law is None:
        return None
    try:
        return _drawn(curve_of(case), units, _samples(case.crack.law))
    except InputError:
        return None


def _drawn(curve: LawCurve, units: str, samples: list[str]) -> Json:
    scale = unit_system(units).scale(_KINDS[curve.over], float(curve.at[-1]))
    kept = [*range(0, len(curve.at) - 1, _EVERY), len(curve.at) - 1]
    stress = written("{stress_pa:.3g MPa}", units, stress_pa=curve.normal_stress_pa)
    sentence = f"The dot: before any slip {curve.at_rest:.3g}, under {stress} from the static loads."
    if samples:
        sentence += f" Sample numbers, those of no dam: {', '.join(samples)}. Give your own."
    return {
        "over": f"{curve.over} [{scale.unit}]",
        "at": [float(f"{value:.5g}") for value in scale(curve.at[kept])],
        "friction": [float(f"{value:.5g}") for value in curve.friction[kept]],
        "dot": [float(scale(curve.normal_stress_pa)) if curve.over == "normal stress" else 0.0, curve.at_rest],
        "sentence": sentence,
    }


def _samples(law: Law) -> list[str]:
    """Return what of a law stands as it begins with."""
    begins = Law(name=law.name, **SAMPLES[law.name])
    return [
        name.replace("_", " ")
        for name in SAMPLES[law.name]
        # The peak is that of the coefficient before.
        if name != "peak_friction" and getattr(law, name) == getattr(begins, name)
    ]
