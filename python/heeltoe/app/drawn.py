"""A response as the page draws it: texts in the units of the reader, and curves with as many points as a screen has."""

from __future__ import annotations

from typing import Any

import numpy as np

from heeltoe.app.meant import meant
from heeltoe.app.thinned import thinned
from heeltoe.result.contract import HEADLINES
from heeltoe.result.response import Response
from heeltoe.result.verdict import verdict
from heeltoe.units.systems import unit_system
from heeltoe.units.write import angle, length
from heeltoe.views.animation.page import packed
from heeltoe.views.figures.panels import pieces
from heeltoe.views.figures.style import shaken_by

# Stretches of a history of which each has its peaks drawn: as many as a large screen has room for.
_BINS = 400
_KINDS = {"sliding": "slide", "slide_rocking": "slide-rock", "drifting": "drift"}


def drawn(response: Response, units: str) -> dict[str, Any]:
    """Return what the page shows of a response."""
    told = {
        "model": response.model,
        "title": response.title,
        "ok": response.ok,
        "verdict": verdict(response, units),
        "warnings": [{"text": meant(each, units), "severity": each.severity} for each in response.warnings],
        "shaking": shaken_by(response),
        "seconds": response.seconds,
    }
    if not response.summary:
        return told
    return told | {
        "numbers": _numbers(response, units),
        "curves": _curves(response, units),
        "ribbon": _ribbon(response),
        "slips": _slips(response, units),
    }


def _numbers(response: Response, units: str) -> list[dict[str, str]]:
    numbers = []
    for each in HEADLINES:
        value = each.way * response.summary[each.key]
        text = angle(value) if each.kind == "rotation" else length(value, units)
        numbers.append({"key": each.key, "label": each.full, "text": text if abs(value) >= each.least else "0"})
    return numbers


def _curves(response: Response, units: str) -> dict[str, Any]:
    h = response.histories
    ground = h["ground_acceleration_m_s2"] / response.gravity
    kept = thinned([h["slip_m"], h["rotation_rad"], ground], _BINS)
    system = unit_system(units)
    # The smallest units, whatever the size: the curves of two models share an axis.
    slip, rotation = system.scale("displacement", 0.0), system.scale("rotation", 0.0)
    rows = {"slip": (slip, h["slip_m"]), "rotation": (rotation, h["rotation_rad"])}
    curves = {
        name: {"unit": scale.unit, "values": packed(scale(values[kept]), "float32")}
        for name, (scale, values) in rows.items()
    }
    curves["ground"] = {"unit": "g", "values": packed(ground[kept], "float32")}
    return {"time": packed(h["time_s"][kept], "float32"), "end": float(h["time_s"][-1]), **curves}


def _ribbon(response: Response) -> list[dict[str, Any]]:
    """Return kind, start and end of each stretch of one kind of motion; neighbours of one kind are joined."""
    spans: list[dict[str, Any]] = []
    for kind, start, end in pieces(response):
        if spans and spans[-1]["kind"] == kind:
            spans[-1]["end"] = end
        elif end > start:
            spans.append({"kind": kind, "start": start, "end": end})
    return spans


def _slips(response: Response, units: str) -> list[dict[str, Any]]:
    found = {kind: response.slip_by_mode_m[key] for key, kind in _KINDS.items()}
    most = max(float(np.max(np.abs(list(found.values())))), 1e-12)
    return [
        {"kind": kind, "text": length(value, units), "share": abs(value) / most, "upstream": value < 0.0}
        for kind, value in found.items()
    ]
