"""A response as the page draws it: texts in the units of the reader, and curves with as many points as a screen has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from heeltoe.app.meant import meant
from heeltoe.app.thinned import thinned
from heeltoe.result.contract import HEADLINES
from heeltoe.result.response import Response
from heeltoe.result.verdict import verdict
from heeltoe.units.sentences import written
from heeltoe.units.systems import unit_system
from heeltoe.units.write import angle, length
from heeltoe.views.animation.page import packed
from heeltoe.views.figures.panels import pieces
from heeltoe.views.figures.style import shaken_by
from heeltoe.views.words import cracks as crack_words
from heeltoe.views.words import sequence as sequence_words
from heeltoe.views.words.law import law_lines

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
        "facts": law_lines(response, units),
        "tables": [
            {"label": label, "columns": columns, "rows": rows} for label, columns, rows in _tables(response, units)
        ],
    }


def _numbers(response: Response, units: str) -> list[dict[str, str]]:
    numbers = []
    for each in HEADLINES:
        value = each.way * response.summary[each.key]
        text = angle(value) if each.kind == "rotation" else length(value, units)
        numbers.append({"key": each.key, "label": each.full, "text": text if abs(value) >= each.least else "0"})
    return numbers


def _tables(response: Response, units: str) -> Iterator[tuple[str, Sequence[str], list[list[str]]]]:
    """Walk what a response tells row by row: of several cracks, of several motions."""
    if "cracks" in response.summary:
        yield "Each crack, from the crest down", crack_words.COLUMNS, crack_words.crack_rows(response, units)
    if response.sequence:
        yield "Motion by motion", sequence_words.COLUMNS, sequence_words.sequence_rows(response, units)


def _curves(response: Response, units: str) -> dict[str, Any]:
    h = response.histories
    ground = h["ground_acceleration_m_s2"] / response.gravity
    others = response.others
    cracks = [response, *others.values()]
    moving = [each.histories[name] for each in cracks for name in ("slip_m", "rotation_rad")]
    kept = thinned([*moving, ground], _BINS)
    system = unit_system(units)
    # The smallest units, whatever the size: the curves of two models share an axis.
    scales = {"slip": system.scale("displacement", 0.0), "rotation": system.scale("rotation", 0.0)}

    def rows(each: Response) -> dict[str, Any]:
        values = {"slip": each.histories["slip_m"], "rotation": each.histories["rotation_rad"]}
        return {
            name: {"unit": scale.unit, "values": packed(scale(values[name][kept]), "float32")}
            for name, scale in scales.items()
        }

    return {
        "time": packed(h["time_s"][kept], "float32"),
        "end": float(h["time_s"][-1]),
        "ground": {"unit": "g", "values": packed(ground[kept], "float32")},
        "cracks": [{"name": name, **rows(each)} for name, each in _named(response, others, units)],
        **rows(response),
    }


def _named(response: Response, others: Mapping[str, Response], units: str) -> Iterator[tuple[str, Response]]:
    """Walk the cracks beside that of ``[crack]``, by where they are."""
    for name, each in others.items():
        place = int(name.rpartition("-")[2]) - 1
        yield written("crack at {at_m:g m}", units, at_m=response.summary["cracks"][place]["elevation_m"]), each


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
