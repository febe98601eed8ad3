"""The form of a study as the fields of a study file."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

from heeltoe.app.case.draft import case_of, fields_in_force
from heeltoe.app.case.fields import blocks, field_of, in_unit, typed, unit_of
from heeltoe.app.case.files import sent_files
from heeltoe.app.desk import BadRequestError
from heeltoe.app.open_case import models_for
from heeltoe.base.payload import Json
from heeltoe.case.distribution import Distribution
from heeltoe.case.paths import value_of
from heeltoe.case.suite import SuiteRule
from heeltoe.errors.error import InputError
from heeltoe.motion.records.catalog import MADE_TO_ORDER, PREFIX, available
from heeltoe.motion.scenario import order_of, scenario_parameters
from heeltoe.motion.targets import STANDARDS
from heeltoe.study.plan.components import CHANNEL, Component, components_of, grouped
from heeltoe.study.plan.file import Measure, Method, Model, Scale

if TYPE_CHECKING:
    from heeltoe.app.case.fields import Field
    from heeltoe.app.sessions import Session
    from heeltoe.case.model import Case

#: Fields, values of each, and records of a study.
MOST_FIELDS, MOST_VALUES, MOST_RECORDS = 30, 1000, 400
_KINDS = tuple(get_args(Distribution.model_fields["distribution"].annotation))
#: What the form calls the study that is a suite of records, among the methods.
SUITE = "suite"
_LIMITS = ("residual_slip", "peak_slip", "opening", "rotation", "cracked_length")


def choices(session: Session) -> Json:
    """Return what can be chosen in the form."""
    case = case_of(session)
    models = ["rigid"] if case is None else models_for(case)["models"]
    return {
        "fields": [_shown(field, block.label, case, session.units) for block, field in _fields()],
        "methods": [SUITE, *get_args(Method)],
        "models": list(get_args(Model)),
        "kinds": list(_KINDS),
        "scales": list(get_args(Scale.model_fields["measure"].annotation)),
        "measures": list(get_args(Measure)),
        "limits": list(_LIMITS),
        "units": session.units,
        "records": _records(session),
        "elastic": case is not None and case.concrete.modulus is not None,
        "usual": models[0],
        "better": models[-1],
        "own": (case is not None and case.motion is not None and case.motion.source_text()) or "",
        "judges": list(get_args(SuiteRule.model_fields["judge"].annotation)),
        "suite": None if case is None or not case.motions else _suite_of(case),
    }


def _suite_of(case: Case) -> Json:
    """Return how a form with the suite of a case is filled in."""
    rule = case.suite
    strength = {name: str(value) for name in ("pga", "sa") if (value := getattr(rule, name)) is not None}
    period = f"{rule.period!r} s" if isinstance(rule.period, float) else "T1"
    return {
        "of": len(case.motions),
        "suite.judge": rule.judge,
        "suite.target": rule.target or "",
        "motions.match": rule.match or "",
        "both_signs": rule.both_signs is not False,
        "scale.measure": next(iter(strength), ""),
        "scale.values": next(iter(strength.values()), ""),
        "scale.period": period if "sa" in strength else "",
    }


def _fields() -> list[tuple[Any, Field]]:
    """Return the fields that can vary, with their blocks: what holds one number or one of several words."""
    return [
        (block, field)
        for block in blocks()
        for field in block.fields
        if field.kind in ("quantity", "choice", "whole", "truth") and not field.path.startswith("motion")
    ]


def _shown(field: Field, block: str, case: Case | None, units: str) -> Json:
    value = None if case is None else value_of(case, field.path)
    now = "" if value is None else str(value)
    if field.quantity and isinstance(value, float):
        now = in_unit(value, field, units).strip()
    row = {"path": field.path, "block": block or "Case", "label": field.label, "meaning": field.meaning, "now": now}
    return row | {"unit": unit_of(field, units), "choices": list(field.choices), "drawn": bool(field.quantity)}


def _records(session: Session) -> list[Json]:
    """Return the records there are, in groups of one event each."""
    groups = [*grouped(_components(session)), *grouped(_catalogued())]
    return [
        {
            "event": group.name,
            "records": [
                {"name": part.file, "vertical": part.is_vertical} for part in (*group.horizontal, *group.vertical)
            ],
        }
        for group in groups
    ]


def _components(session: Session) -> list[Component]:
    """Return the components of earthquakes in the files that a tab has sent, as the files name them."""
    return [
        Component(
            name,
            f"{name}{CHANNEL}{channel['channel']}" if channel["channel"] else name,
            channel.get("vertical", False),
            tuple(channel.get("earthquake", ())),
        )
        for name in session.sent
        for channel in session.records.get(name, [{"channel": ""}])
    ]


@cache
def _catalogued() -> tuple[Component, ...]:
    """Return those of the catalogue."""
    names = dict.fromkeys(name for name, where in available() if (name, where) != MADE_TO_ORDER)
    return tuple(components_of(list(names), Path()))


def study_of_form(request: object, session: Session) -> tuple[dict[str, Any], dict[str, Any], dict[str, Path]]:
    """Return the case of a tab and the study of its form, both as files have them, and the files that it has sent.

    Raises
    ------
    BadRequestError
        Where the form of the page says no such thing.
    InputError
        Where something cannot be taken into a study.
    """
    form = _mapping(request)
    content: dict[str, Any] = {"title": _text(form, "title").strip(), "case": "case.toml"}
    content["model"] = _words(form, "models")
    suite = _text(form, "method") == SUITE
    if suite:
        content["suite"] = {"judge": _text(form, "suite.judge") or "largest", **_spectrum(form, "suite.target")}
    else:
        content |= _varied(form, session.units)
    motions = _motions(form, session, suite=suite)
    if motions:
        content["motions"] = motions
    study = {name: value for name, value in content.items() if value not in ("", {}, [])}
    case = fields_in_force(session)
    if not motions and not form.get("both_signs") and isinstance(case.get("motion"), dict):
        # Of the motion of the case one sign alone is wanted: the one that it has.
        turned = bool(case["motion"].get("reverse")) or case["motion"].get("sign") == "reversed"
        kept = {name: value for name, value in case["motion"].items() if name not in ("reverse", "sign")}
        case = {**case, "motion": {**kept, "sign": "reversed" if turned else "recorded"}}
    return case, study, sent_files(session)


def _varied(form: Mapping[str, Any], units: str) -> Json:
    """Return what varies, how, and the limits of the curves: all that a suite of records does without."""
    content: dict[str, Any] = {"method": _text(form, "method")}
    for name in ("samples", "seed"):
        text = _text(form, name).strip()
        if text:
            content[name] = _whole(text)
    content["vary"] = _vary(_list(form, "vary", MOST_FIELDS), units)
    content["correlation"] = _correlation(_text(form, "correlation"))
    limits = {name: _split(_text(form, f"limit.{name}")) for name in _LIMITS}
    if any(limits.values()):
        content["fragility"] = {
            "limits": {name: values for name, values in limits.items() if values},
            "measure": _text(form, "fragility.measure") or "pga",
            **_filled(form, "fragility.period", "period"),
            **{name: _numeric(text) for name, text in _filled(form, "fragility.confidence", "confidence").items()},
        }
    return content


def _vary(rows: list[Any], units: str) -> Json:
    axes: dict[str, Any] = {}
    for row in map(_mapping, rows):
        path = _text(row, "path")
        field = field_of(path)
        if field is None or path not in {known.path for _, known in _fields()}:
            raise BadRequestError("path is a field that can vary")
        if path in axes:
            raise InputError("listed-twice", f"vary.{path}", path)
        kind = _text(row, "kind")
        if kind == "list":
            axes[path] = [typed(value, field, units) for value in _split(_text(row, "values"))]
        elif kind in _KINDS:
            entries = {name: typed(_text(row, name), field, units) for name in _numbers()}
            entries |= {"count": _whole(_text(row, "count").strip())} if _text(row, "count").strip() else {}
            axes[path] = {"distribution": kind} | {name: value for name, value in entries.items() if value is not None}
        else:
            raise BadRequestError("kind is a list or a distribution")
    return axes


def _correlation(text: str) -> list[list[str | float]]:
    """Return pairs of fields with their correlation."""
    pairs = [[part.strip() for part in pair.split(",")] for pair in text.split(";") if pair.strip()]
    return [[*parts[:2], *map(_numeric, parts[2:])] for parts in pairs]


def _numbers() -> tuple[str, ...]:
    return tuple(
        field.alias or name
        for name, field in Distribution.model_fields.items()
        if name not in ("distribution", "count")
    )


def _motions(form: Mapping[str, Any], session: Session, *, suite: bool) -> Json:
    scale = _scale(form)
    chosen = _words(form, "records", MOST_RECORDS)
    if _text(form, "source") == "case":
        if not suite and not scale and not form.get("both_signs"):
            return {}
        events, chosen, read = _own(session, suite=suite)
    else:
        read = {name: _text(form, f"motions.{name}").strip() for name in ("unit", "time_step", "layout", "factor")}
        corners = {name: _text(form, f"motions.{name}").strip() for name in ("low", "high")}
        if any(corners.values()):
            corners = {name: f"{value} Hz" if _is_number(value) else value for name, value in corners.items() if value}
            read["processing"] = [{"step": "band-pass", **corners}]
        events = _events(chosen, session, vertical=bool(form.get("vertical")))
        # Each order is an earthquake of its own, whatever its name ends with.
        ordered = [name.strip() for name in _text(form, "ordered").split(";") if name.strip()]
        events += [{"horizontal": [name]} for name in ordered]
        events += _scenario(form)
        if not events:
            raise InputError("study-motions", "motions")
        chosen += ordered
    known = {name for name, _ in available()} | session.sent.keys()
    known |= {part.file for part in (*_components(session), *_catalogued())}
    for name in chosen:
        if name not in known and not name.startswith(PREFIX):
            raise InputError("record-not-found", "motions", name, hint="choose one of those shown;")
    motions: dict[str, Any] = {"events": events, **{name: value for name, value in read.items() if value}}
    motions |= {name: True for name in ("pairs", "vertical") if form.get(name)}
    motions["both_signs"] = bool(form.get("both_signs"))
    if suite:
        motions |= _spectrum(form, "motions.match")
    if form.get("every"):
        motions["every"] = True
    if scale:
        motions["scale"] = scale
    return motions


def _scenario(form: Mapping[str, object]) -> list[Json]:
    """Return motions made to order for one magnitude and distance, each with its seed; none where not asked."""
    magnitude, distance = (_text(form, f"scenario.{name}").strip() for name in ("magnitude", "distance"))
    if not (magnitude or distance):
        return []
    count = _whole(_text(form, "scenario.count").strip() or "1")
    if not isinstance(count, int) or not 1 <= count <= MOST_RECORDS:
        raise InputError("out-of-range", "scenario.count", count, bound=f"from 1 to {MOST_RECORDS}")
    far = distance.removesuffix("km").strip()
    parts = [*([f"M{magnitude}"] if magnitude else []), *([f"{far}km"] if far else [])]
    names = [f"{PREFIX}{','.join(parts)},seed={seed},scatter=yes" for seed in range(1, count + 1)]
    # What cannot be made is said at its field, before it stands in the file under the name of an event.
    order = order_of(names[0], field="scenario")
    try:
        scenario_parameters(order["magnitude"], order["distance"])
    except InputError as error:
        error.field = "scenario"
        raise
    known = {"magnitude": order["magnitude"], "distance": f"{order['distance']:g} km"}
    return [{"horizontal": [name], **known} for name in names]


def _seconds(time_step: float | None) -> str | None:
    return None if time_step is None else f"{time_step!r} s"


def _own(session: Session, *, suite: bool) -> tuple[list[dict[str, Any]], list[str], dict[str, Any]]:
    """Return the motion of the case, or those of its suite, as events of a study, the records in them, and how these
    are read."""
    case = case_of(session)
    if case is None:
        raise InputError("study-motions", "motions")
    suite = suite and bool(case.motions)
    called = {stored: name for name, stored in session.sent.items()}
    pairs = [(motion.file, motion.vertical) for motion in case.motions] if suite else []
    if not suite and case.motion is not None and case.motion.file is not None:
        vertical = case.motion.vertical
        pairs = [(case.motion.file, None if vertical is None else vertical.file)]
    if not pairs:
        raise InputError("study-motions", "motions")
    events, names = list[dict[str, Any]](), list[str]()
    for pair in pairs:
        own = [called.get(name, name) for name in pair if name is not None]
        events.append({"horizontal": own[:1], **({"vertical": own[1]} if own[1:] else {})})
        names += own
    read = case.suite if suite else case.motion
    how: dict[str, Any] = {} if read is None else {"unit": read.unit, "time_step": _seconds(read.time_step)}
    if suite:
        steps = [step.model_dump(mode="json", exclude_unset=True) for step in case.suite.processing]
        how |= {"layout": case.suite.layout, "factor": case.suite.factor, "processing": steps}
    return events, names, how


def _spectrum(form: Mapping[str, Any], path: str) -> dict[str, str]:
    """Return a target spectrum of a standard; no file is looked for."""
    name = path.rpartition(".")[2]
    spectrum = _filled(form, path, name)
    if spectrum and not spectrum[name].startswith(STANDARDS):
        raise InputError("target-form", path, spectrum[name])
    return spectrum


def _events(names: list[str], session: Session, *, vertical: bool) -> list[Json]:
    """Return records as events with their components, as a folder of them has."""
    known = {part.file: part for part in (*_catalogued(), *_components(session))}
    parts = [known.get(name, Component(name, name, is_vertical=False)) for name in names]
    events: list[Json] = []
    for group in grouped(parts):
        # Alone, a vertical component is what the user asks for; it is warned of.
        level = [part.file for part in group.horizontal or group.vertical]
        up = group.vertical[0].file if vertical and group.horizontal and group.vertical else None
        events.append({"name": group.name, "horizontal": level, **({} if up is None else {"vertical": up})})
    return events


def _scale(form: Mapping[str, object]) -> Json:
    measure = _text(form, "scale.measure")
    if not measure:
        return {}
    low, high = _text(form, "scale.from").strip(), _text(form, "scale.to").strip()
    drawn = {"from": _numeric(low), "to": _numeric(high)} if _text(form, "scale.kind") == "drawn" else None
    values = drawn or [_numeric(value) for value in _split(_text(form, "scale.values"))]
    return {"measure": measure, "values": values, **_filled(form, "scale.period", "period")}


def _filled(form: Mapping[str, object], name: str, called: str) -> dict[str, str]:
    text = _text(form, name).strip()
    return {called: text} if text else {}


def _is_number(text: str) -> bool:
    return isinstance(_numeric(text), float)


def _numeric(text: str) -> str | float:
    """Return a number where it has no unit."""
    try:
        return float(text)
    except ValueError:
        return text


def _whole(text: str) -> int | str:
    digits = text.replace(",", "").replace("_", "")
    return int(digits) if digits.isdecimal() and len(digits) < 16 else text


def _split(text: str) -> list[str]:
    parts = [part.strip() for part in text.split(",") if part.strip()]
    if len(parts) > MOST_VALUES:
        raise InputError("too-many", "vary", len(parts), most=MOST_VALUES)
    return parts


def _mapping(entry: object) -> Mapping[str, Any]:
    if not isinstance(entry, Mapping):
        raise BadRequestError("study is what its form says")
    return entry


def _list(form: Mapping[str, object], name: str, limit: int) -> list[Any]:
    entries = form.get(name, [])
    if not isinstance(entries, list):
        raise BadRequestError(f"{name} is a list")
    if len(entries) > limit:
        raise InputError("too-many", name, len(entries), most=limit)
    return entries


def _words(form: Mapping[str, Any], name: str, limit: int = 10) -> list[str]:
    words = _list(form, name, limit)
    if not all(isinstance(word, str) for word in words):
        raise BadRequestError(f"{name} are texts")
    return list(words)


def _text(form: Mapping[str, Any], name: str) -> str:
    entry = form.get(name, "")
    if not isinstance(entry, str) or len(entry) > 20_000:
        raise BadRequestError(f"{name} is a text")
    return entry
