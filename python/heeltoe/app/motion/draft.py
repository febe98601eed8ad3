"""From what stands on the page of the motion to the motion of a case, and back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from heeltoe.app.case.fields import NUMBER
from heeltoe.app.case.files import is_catalogued
from heeltoe.base.payload import Json
from heeltoe.errors.error import InputError
from heeltoe.motion.records.catalog import PREFIX
from heeltoe.units.parse import parse

if TYPE_CHECKING:
    from heeltoe.app.sessions import Session
    from heeltoe.case.model import Case
    from heeltoe.case.motion import Motion

#: What a form is asked for; all are texts but the last.
_TEXTS = ("source", "channel", "unit", "time_step", "pga", "magnitude", "distance", "seed", "period")
_LONGEST = 200
_WINDOW = "window"
_OWN = "case"

Form = Mapping[str, Any]


def read_form(entry: object) -> Json | None:
    """Return what a page says of the motion, None where no page of this app says so."""
    if not isinstance(entry, Mapping):
        return None
    ways = {way: _way(entry.get(way)) for way in ("horizontal", "vertical")}
    cuts = {name: entry.get(name, "") for name in ("start", "end")}
    if ways["horizontal"] is None or not all(isinstance(cut, str) and len(cut) <= _LONGEST for cut in cuts.values()):
        return None
    return {**ways, **cuts}


def _way(entry: object) -> Json | None:
    if not isinstance(entry, Mapping) or not entry.get("source"):
        return None
    texts = {name: entry.get(name, "") for name in _TEXTS}
    if not all(isinstance(text, str) and len(text) <= _LONGEST for text in texts.values()):
        return None
    return {**{name: text.strip() for name, text in texts.items()}, "reverse": entry.get("reverse") is True}


def motions_of(case: Case | None) -> tuple[Motion, ...]:
    """Return the motions of a case in their order."""
    return () if case is None or case.motion is None else (case.motion, *case.aftershocks)


def form_of(session: Session, place: int = 0) -> Json:
    """Return what the page begins with: a motion that the case has, where its sliders are."""
    case = session.case
    if case is not None and session.changes:
        with suppress(InputError):
            case = case.with_numbers(session.changes)
    motions = motions_of(case)
    if place >= len(motions):
        return {"horizontal": {"source": ""}, "vertical": {"source": ""}, "start": "", "end": ""}
    motion = motions[place]
    fields = motion.model_dump(mode="json", exclude_none=True)
    called = {stored: name for name, stored in session.sent.items()}
    ways = {}
    for way, of in (("horizontal", fields), ("vertical", fields.get("vertical"))):
        ways[way] = {"source": ""}
        if of:
            title = called.get(of.get("file", ""), of.get("file")) or "drawn by points"
            ways[way] = {"source": _OWN, "title": title, "pga": of.get("pga", ""), "reverse": of.get("reverse", False)}
            ways[way] |= {name: of.get(name, "") for name in ("unit", "time_step")}
    window = _window(fields)
    start, end = (window.get("start", ""), window.get("end", "")) if window else ("", fields.get("duration", ""))
    return {**ways, "start": "" if start == "0 s" else start, "end": end}


def _window(fields: Form) -> Json:
    window: dict[str, Any] = next((step for step in fields.get("processing", ()) if step["step"] == _WINDOW), {})
    return window


def motion_fields(form: Form, had: Motion | None, sent: Mapping[str, str]) -> Json:
    """Return a motion of a case as its file would have it, with the names that files have here; `had` is the one in
    whose place it comes.

    Raises
    ------
    InputError
        Where a number is none, or a record was not sent.
    """
    own = {} if had is None else had.model_dump(mode="json", exclude_unset=True, exclude={"pause"})
    own_vertical = own.pop("vertical", None)
    start, end = _with_unit(form["start"], "s"), _with_unit(form["end"], "s")
    fields = _source(form["horizontal"], own, sent, "motion")
    if form["vertical"] is not None:
        upward = own_vertical if isinstance(own_vertical, dict) else {}
        fields["vertical"] = _source(form["vertical"], upward, sent, "motion.vertical")
    if form["horizontal"]["source"] != _OWN:
        fields.pop("allow_zero", None)
    had_window = bool(_window(own))
    if start:
        cut = {"step": _WINDOW, "start": start, **({"end": end} if end else {})}
        for part in (fields, fields.get("vertical")):
            if part is not None:
                part["processing"] = [cut, *part.get("processing", ())]
        if not had_window or form["horizontal"]["source"] != _OWN:
            fields.pop("duration", None)
    elif end:
        fields["duration"] = end
    else:
        fields.pop("duration", None)
    return fields


def _source(way: Form, own: Form, sent: Mapping[str, str], field: str) -> dict[str, Any]:
    """Return one direction: its source, or that which the case has, with the scale and the sign of the page."""
    source, _, name = way["source"].partition(":")
    if source == _OWN:
        steps = [step for step in own.get("processing", ()) if step["step"] != _WINDOW]
        content = {**own, "processing": steps}
        if not steps:
            del content["processing"]
        for key in ("pga", "reverse", *(() if "points" in own else ("unit", "time_step"))):
            content.pop(key, None)
    elif source == "record":
        if name not in sent:
            raise InputError("record-not-found", f"{field}.file", name, hint="this tab has not sent it:")
        content = {"file": sent[name]}
    elif source == "name":
        if not is_catalogued(name):
            raise InputError("record-not-found", f"{field}.file", name, hint="the catalogue does not have it:")
        content = {"file": name}
    elif source == "synthetic":
        distance = _with_unit(way["distance"], "km").replace(" ", "")
        content = {"file": f"{PREFIX}M{way['magnitude']},{distance},seed={way['seed']}"}
    elif source == "pulse" and name in KINDS:
        period = parse(_with_unit(way["period"], "s"), "duration", f"{field}.period")
        content = {"points": pulse_points(name, period)}
    else:
        raise InputError("motion-source", field)
    reads = source in ("record", "name") or (source == _OWN and "file" in own)
    entries = {"channel": way["channel"], "unit": way["unit"], "time_step": _with_unit(way["time_step"], "s")}
    if reads:
        content |= {key: entry for key, entry in entries.items() if entry}
    if content.get("channel", "").isdigit():
        content["channel"] = int(content["channel"])
    if pga := _with_unit(way["pga"], "g"):
        content["pga"] = pga
    if way["reverse"]:
        content["reverse"] = True
    return content


def _with_unit(text: str, unit: str) -> str:
    """Return a number without a unit with the one that the page shows beside it."""
    return f"{text} {unit}" if NUMBER.fullmatch(text) else text


KINDS = ("sine", "half-sine", "cosine")
# Straight pieces of a whole period.
_PIECES = 40


def pulse_points(kind: str, period: float) -> list[list[str]]:
    """Return a pulse of one g as the points of a case: one sine, half of one, or one cosine of a period [s]."""
    count = _PIECES // 2 if kind == "half-sine" else _PIECES
    wave = math.cos if kind == "cosine" else math.sin
    values = [wave(2.0 * math.pi * place / _PIECES) for place in range(count + 1)]
    return [[f"{period * k / _PIECES:.9g} s", f"{0.0 if abs(v) < 1e-12 else v:.9g} g"] for k, v in enumerate(values)]
