"""From what stands on the page of the motion to the motion of a case, and back."""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from heeltoe.app.case.files import is_catalogued
from heeltoe.app.motion.pulses import KINDS, pulse_points
from heeltoe.errors import InputError
from heeltoe.motion.scenario import PREFIX
from heeltoe.units.parse import parse

if TYPE_CHECKING:
    from heeltoe.app.sessions import Session
    from heeltoe.case.model import Case
    from heeltoe.case.motion import Motion

#: What a form is asked for; all are texts but the last.
_TEXTS = ("source", "channel", "unit", "time_step", "pga", "magnitude", "distance", "seed", "period")
_LONGEST = 200
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_WINDOW = "window"
_OWN = "case"

Form = Mapping[str, Any]


def read_form(given: object) -> dict[str, Any] | None:
    """Return what a page says of the motion, None where no page of this app says so."""
    if not isinstance(given, Mapping):
        return None
    ways = {way: _way(given.get(way)) for way in ("horizontal", "vertical")}
    cuts = {name: given.get(name, "") for name in ("start", "end")}
    if ways["horizontal"] is None or not all(isinstance(each, str) and len(each) <= _LONGEST for each in cuts.values()):
        return None
    return {**ways, **cuts}


def _way(given: object) -> dict[str, Any] | None:
    if not isinstance(given, Mapping) or not given.get("source"):
        return None
    texts = {name: given.get(name, "") for name in _TEXTS}
    if not all(isinstance(each, str) and len(each) <= _LONGEST for each in texts.values()):
        return None
    return {**{name: each.strip() for name, each in texts.items()}, "reverse": given.get("reverse") is True}


def motions_of(case: Case | None) -> tuple[Motion, ...]:
    """Return the motions of a case in their order."""
    return () if case is None or case.motion is None else (case.motion, *case.aftershocks)


def form_of(session: Session, place: int = 0) -> dict[str, Any]:
    """Return what the page begins with: a motion that the case has, where its sliders are."""
    case = session.case
    if case is not None and session.changes:
        with suppress(InputError):
            case = case.with_(session.changes)
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


def _window(fields: Form) -> dict[str, Any]:
    found: dict[str, Any] = next((each for each in fields.get("processing", ()) if each["step"] == _WINDOW), {})
    return found


def motion_fields(form: Form, had: Motion | None, sent: Mapping[str, str]) -> dict[str, Any]:
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
        for each in (fields, fields.get("vertical")):
            if each is not None:
                each["processing"] = [cut, *each.get("processing", ())]
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
        steps = [each for each in own.get("processing", ()) if each["step"] != _WINDOW]
        found = {**own, "processing": steps}
        if not steps:
            del found["processing"]
        for key in ("pga", "reverse", *(() if "points" in own else ("unit", "time_step"))):
            found.pop(key, None)
    elif source == "record":
        if name not in sent:
            raise InputError("record-not-found", f"{field}.file", name, hint="this tab has not sent it:")
        found = {"file": sent[name]}
    elif source == "name":
        if not is_catalogued(name):
            raise InputError("record-not-found", f"{field}.file", name, hint="the catalogue does not have it:")
        found = {"file": name}
    elif source == "synthetic":
        distance = _with_unit(way["distance"], "km").replace(" ", "")
        found = {"file": f"{PREFIX}M{way['magnitude']},{distance},seed={way['seed']}"}
    elif source == "pulse" and name in KINDS:
        period = parse(_with_unit(way["period"], "s"), "duration", f"{field}.period")
        found = {"points": pulse_points(name, period)}
    else:
        raise InputError("motion-source", field)
    reads = source in ("record", "name") or (source == _OWN and "file" in own)
    said = {"channel": way["channel"], "unit": way["unit"], "time_step": _with_unit(way["time_step"], "s")}
    if reads:
        found |= {key: each for key, each in said.items() if each}
    if found.get("channel", "").isdigit():
        found["channel"] = int(found["channel"])
    if pga := _with_unit(way["pga"], "g"):
        found["pga"] = pga
    if way["reverse"]:
        found["reverse"] = True
    return found


def _with_unit(text: str, unit: str) -> str:
    """Return a number without a unit with the one that the page shows beside it."""
    return f"{text} {unit}" if _NUMBER.fullmatch(text) else text
