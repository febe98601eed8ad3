"""Starting values of a new block, an item of a list, a pattern of uplift or a friction law."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from heeltoe.app.case.fields import field_of
from heeltoe.app.case.handles import corners_of, length_text
from heeltoe.base.payload import Json
from heeltoe.case.crack.law import LAW_FIELDS
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.law_curve import SAMPLES, curve_of

# Blocks and items, as a file has them.
_BEGIN: dict[str, dict[str, object]] = {
    "crack.roughness": {"asperity_height": "20 mm", "wave_length": "200 mm"},
    "rock": {"modulus": "30 GPa"},
    "ice": {"force": "150 kN/m"},
    "motion": {"file": "elcentro-1940-180-nga", "pga": "0.4 g"},
    "motion.vertical": {"file": "elcentro-1940-up-nga"},
    "motion.cross_valley": {"file": "elcentro-1940-270-nga"},
    "aftershocks": {"file": "elcentro-1940-270-nga", "pga": "0.2 g"},
}
# What has a depth, as a part of the height of the dam.
_PARTS = {"reservoir": 0.9, "tailwater": 0.1, "silt": 0.1}
_PATTERNS: dict[str, dict[str, object]] = {
    "cut-off": {"uplift.extent": 0.5},
    "drained": {"uplift.drain_position": 0.1, "uplift.drain_efficiency": 0.667},
}
_LAW = "crack.law"
# Something to begin with, of a joint as any.
_BOND = {
    "tensile_strength": "0.5 MPa",
    "cohesion": "1.5 MPa",
    "fracture_energy": "100 N/m",
    "shear_energy": "1000 N/m",
}
_OWN_COEFFICIENTS = ("friction", "static_friction", "kinetic_friction")
_COEFFICIENTS = tuple(f"crack.{name}" for name in _OWN_COEFFICIENTS)


def block(case: Case | None, units: str, path: str, *, wanted: bool) -> Json:
    """Return the changes that put in a block, or take one away where it shall not be `there`."""
    if path == _LAW:
        return _law(case, wanted=wanted)
    if not wanted:
        return {path: None}
    if path.endswith(".bond"):
        return {path: dict(_BOND)}
    if path in _PARTS and case is not None:
        return {path: {"depth": length_text(case, units, _PARTS[path])}}
    if path.startswith("crack.band") and case is not None:
        left = round(0.8 * case.crack.mu_kinetic, 3)
        ends = {"slip_weakening": {"slip": "20 mm"}, "speed_weakening": {"speed": "0.05 m/s"}}
        end = ends.get(path.rpartition(".")[2])
        return {path: {"low": left} if end is None else {"residual_friction": left, **end}}
    return {path: dict(_BEGIN.get(path, {}))}


def item(case: Case | None, units: str, path: str) -> Json:
    """Return what one more item of a list begins with."""
    if path == "anchors" and case is not None and case.further_cracks:
        return _through(case, units)
    if path == "anchors":
        return {"distance": f"1 {'ft' if units == 'us' else 'm'}", "prestress": "1 MN/m"}
    field = field_of(path)
    if case is not None and field is not None and any(inner.path == f"{path}[].elevation" for inner in field.inner):
        part = _between_cracks(case) if path == "further_cracks" else 0.5
        return {"elevation": length_text(case, units, part)}
    return dict(_BEGIN.get(path, {}))


def _through(case: Case, units: str) -> Json:
    """Return an anchor from the middle of the crest, upright into the rock: through all cracks."""
    corners = np.array(corners_of(case, units))
    x, z = (np.array([float(length.split()[0]) for length in column]) for column in corners.T)
    unit, top, base = corners[0, 0].split()[1], float(z.max()), float(z.min())
    middle = f"{x[z == top].mean():.4g} {unit}"
    ends: Json = {"head_x": middle, "head_elevation": f"{top - base:.6g} {unit}", "foot_x": middle}
    return ends | {"foot_elevation": f"{-0.1 * (top - base):.4g} {unit}", "prestress": "1 MN/m"}


def following(changes: Mapping[str, Any], fields: Mapping[str, Any]) -> Json:
    """Return changes with the fields of a pattern of uplift or a law that they choose.

    Parameters
    ----------
    changes
        By paths, as a file has them.
    fields
        Of the case before.
    """
    following_changes = dict(changes)
    pattern, law = following_changes.get("uplift.pattern"), following_changes.get("crack.law.name")
    if isinstance(pattern, str):
        following_changes |= _PATTERNS.get(pattern, {})
    if isinstance(law, str) and law in LAW_FIELDS:
        had = fields.get("crack", {}).get("law") if isinstance(fields.get("crack"), dict) else None
        following_changes |= {_LAW: _named(law, had if isinstance(had, dict) else {})}
        del following_changes["crack.law.name"]
    if isinstance(following_changes.get("further_cracks"), list):
        before = fields.get("further_cracks")
        had = before if isinstance(before, list) else []
        following_changes["further_cracks"] = [
            _with_law(crack, had[place] if place < len(had) else None)
            for place, crack in enumerate(following_changes["further_cracks"])
        ]
    return following_changes


def _with_law(crack: Any, before: Any) -> Any:
    """Return a further crack with the fields of a new law, or of one that replaces another."""
    law = crack.get("law") if isinstance(crack, dict) else None
    if not isinstance(law, dict):
        return crack
    had = before.get("law") if isinstance(before, dict) else None
    name = law.get("name", "slip weakening")
    if name not in LAW_FIELDS or (isinstance(had, dict) and had.get("name") == name):
        return crack
    others = {key: value for key, value in crack.items() if key not in _OWN_COEFFICIENTS}
    return others | {"law": _named(name, law)}


def _named(law: str, had: Mapping[str, Any]) -> dict[str, Any]:
    """Return a law with the fields that it shares with the one before, and sample numbers for the others."""
    needed, allowed = LAW_FIELDS[law]
    kept = {name: had[name] for name in (*needed, *allowed) if name in had}
    return {"name": law, **SAMPLES[law], **kept}


def _law(case: Case | None, *, wanted: bool) -> Json:
    """Return the changes from coefficients to a law or back, each with the friction before any slip of the other."""
    if wanted:
        begins = {} if case is None else {"peak_friction": case.crack.mu_static}
        law = _named("slip weakening", begins)
        law["residual_friction"] = min(law["residual_friction"], law["peak_friction"])
        return dict.fromkeys(_COEFFICIENTS) | {_LAW: law}
    return {_LAW: None, "crack.friction": float(f"{_at_rest(case):.3g}")}


def _at_rest(case: Case | None) -> float:
    try:
        return 1.0 if case is None else curve_of(case).at_rest
    except InputError:
        return 1.0


def _between_cracks(case: Case) -> float:
    """Return where one more crack goes, as a part of the height: the neck, or the middle of the highest part without a
    crack."""
    _, base, _, crest = case.outline.bounds
    height = float(crest - base)
    taken = sorted({0.0, case.crack.elevation, *(crack.elevation for crack in case.further_cracks), height})
    neck = case.section.neck_height
    if neck is not None and all(abs(neck - level) > 0.01 * height for level in taken):
        return float(neck) / height
    low, high = max(pairwise(taken), key=lambda ends: ends[1] - ends[0])
    return 0.5 * (low + high) / height
