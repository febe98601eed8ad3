"""A motion as the page shows it. It is read in a separate process, which has a limited time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from heeltoe.app.live import refused
from heeltoe.app.response_payload import thinned
from heeltoe.base.payload import Json
from heeltoe.case.model import Case
from heeltoe.case.motion import Source
from heeltoe.case.shaking import resolve
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import husid, velocity_displacement
from heeltoe.motion.records.catalog import PREFIX, find
from heeltoe.motion.records.formats.columns import ASKS_FOR_LAYOUT
from heeltoe.motion.records.read import read_channels, read_record
from heeltoe.motion.scenario import synthetic
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.study.plan.components import component_of
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.systems import unit_system
from heeltoe.views.animation.page import packed
from heeltoe.views.words.motion import about_motion, suspicions

_BINS = 400
# What a file does not state is told beside it.
_MENDED_BY = {"record-unit-missing": "unit", "record-step-missing": "time_step"}
_ASKED_LATER = {"record-unit-missing", "record-factor-of-several", "record-factor", *ASKS_FOR_LAYOUT}
#: A file of more has its first channels listed; each has a number, by which a case names it.
MOST_CHANNELS = 60


def channels(path: Path, called: str) -> Json:
    """Return the channels of a file that was sent, as a page lists them, or why it cannot be read as a record."""
    known = True
    try:
        try:
            motions = read_channels(path)
        except InputError as error:
            if error.code not in _ASKED_LATER:
                raise
            # It is asked for where the record is used.
            known = False
            motions = read_channels(path, unit="m/s^2", layout="rows", factor="contain", several=True)
    except InputError as error:
        return refused(_renamed(error, {str(path): called, path.name: called}))
    several = len(motions) > 1
    parts = [component_of(replace(motion, name=called), called, several=several) for motion in motions[:MOST_CHANNELS]]
    listed = [
        {
            "channel": motion.channel if several else "",
            "component": plain(motion.component),
            "vertical": part.is_vertical,
            "earthquake": list(part.earthquake),
            "pga": f"{motion.pga / STANDARD_GRAVITY:.3g} g" if known else "in a unit or a way that it does not state",
            "duration": f"{motion.duration:.4g} s",
            "format": motion.format,
        }
        for motion, part in zip(motions, parts, strict=False)
    ]
    return {"channels": listed}


def refusal(case: Case, motion: Mapping[str, object], folder: Path) -> Json:
    """Return why a motion cannot be used, read once as an analysis reads it; nothing where it can."""
    try:
        _resolved(case, motion, folder)
    except InputError as error:
        return refused(_placed(error, motion))
    return {}


def _resolved(case: Case, motion: Mapping[str, object], folder: Path) -> tuple[GroundMotion, GroundMotion | None]:
    problem = _with_motion(case, motion, folder)
    assert problem.motion is not None
    return resolve(problem.motion, problem.gravity, problem.base_directory)


def _with_motion(case: Case, motion: Mapping[str, object], folder: Path) -> Case:
    fields = case.model_dump(mode="json", exclude_unset=True)
    return Case.of({**fields, "motion": dict(motion)}, folder)


def look(case: Case, motion: Mapping[str, Any], folder: Path, units: str) -> Json:
    """Return what would shake a case: as an analysis takes it, or, where that cannot be, each record as it was read and
    why it cannot be used."""
    try:
        pair = _resolved(case, motion, folder)
    except InputError as error:
        payload = refused(_placed(error, motion))
        payload = _asks_for_both(case, motion, folder, error) or payload
        seen = [_as_read(source, case.gravity, folder) for source in (motion, motion.get("vertical"))]
        return {**payload, "usable": False, "motions": _shown(seen, case.gravity, units, doubts=True)}
    return {"usable": True, "motions": _shown(list(pair), case.gravity, units, doubts=False)}


# What stands in for a time step that a file does not state, to see what else it does not.
_SOME_STEP = "0.01 s"


def _asks_for_both(case: Case, motion: Mapping[str, Any], folder: Path, error: InputError) -> Json:
    """Return the question for unit and time step at once, of a file that states neither; nothing of another."""
    if error.code != "record-step-missing":
        return {}
    way = "motion.vertical" if error.field.startswith("motion.vertical") else "motion"
    source = motion.get("vertical", {}) if way == "motion.vertical" else motion
    stepped = {**source, "time_step": _SOME_STEP}
    try:
        _resolved(case, {**motion, "vertical": stepped} if way == "motion.vertical" else stepped, folder)
    except InputError as second:
        if second.code != "record-unit-missing":
            return {}
        problem = "The file states neither the unit of its numbers nor the time between two of them"
        peak, guess = second.problem.rpartition("; ")[2], second.remedy.rpartition(": ")[2]
        remedy = f"give both here. {peak[:1].upper()}{peak[1:]}: {guess}. Steps of 0.005, 0.01 and 0.02 s are usual."
        return {"error": {"field": f"{way}.unit", "text": f"{problem}; {remedy}", "problem": problem, "remedy": remedy}}
    return {}


def _as_read(source: Mapping[str, Any] | None, gravity: float, folder: Path) -> GroundMotion | None:
    """Return a record with the likeliest unit and step where they are missing; None where it cannot be read at all."""
    if source is None:
        return None
    try:
        own = Source.model_validate({key: source[key] for key in ("file", "channel", "points") if key in source})
        if own.file is None:
            return None
        if own.file.startswith(PREFIX):
            return synthetic(own.file, gravity=gravity)
        path = find(own.file, folder)
        try:
            unit, step = source.get("unit"), source.get("time_step")
            stated = Source.model_validate({"file": own.file, **({"time_step": step} if step else {})}).time_step
            return read_record(path, own.channel, unit=unit, time_step=stated, gravity=gravity, assume=True)
        except (InputError, ValueError):
            return read_record(path, own.channel, gravity=gravity, assume=True)
    except (InputError, ValueError):
        return None


def _shown(motions: list[GroundMotion | None], gravity: float, units: str, *, doubts: bool) -> list[Json]:
    ways = ("horizontal", "vertical")
    return [
        {"way": way, **drawn_motion(motion, gravity, units, doubts=doubts)}
        for way, motion in zip(ways, motions, strict=True)
        if motion is not None
    ]


def drawn_motion(motion: GroundMotion, gravity: float, units: str, *, doubts: bool) -> Json:
    """Return facts, warnings and curves of a motion; with `doubts`, also what an analysis would say about it."""
    warnings = [warning.text(units) for warning in motion.warnings]
    if doubts:
        warnings += suspicions(motion, units, gravity)
    facts = about_motion(motion, units, gravity)
    velocity, displacement = velocity_displacement(motion)
    intensity = husid(motion)
    share = 100.0 * intensity / intensity[-1] if intensity[-1] > 0.0 else intensity
    kept = thinned([motion.acceleration, velocity, displacement], _BINS)
    system = unit_system(units)
    # The unit of the peak that is said above: metres, or inches up to ten feet.
    speed = system.scale("velocity")
    length = system.scale("displacement", motion.pgd) if units == "us" else system.scale("length")
    spectrum = response_spectrum(motion)
    curves = {
        "time": (motion.time[kept], "s"),
        "acceleration": (motion.acceleration[kept] / gravity, "g"),
        "velocity": (speed(velocity[kept]), speed.unit),
        "displacement": (length(displacement[kept]), length.unit),
        "husid": (share[kept], "%"),
        "period": (spectrum.period, "s"),
        "spectrum": (spectrum.pseudo_acceleration / gravity, "g"),
    }
    return {
        "facts": [(label, plain(text)) for label, text in facts],
        "warnings": [plain(warning, 500) for warning in warnings],
        "end": motion.duration,
        "curves": {
            name: {"unit": unit, "values": packed(values, "float32")} for name, (values, unit) in curves.items()
        },
    }


def _placed(error: InputError, motion: Mapping[str, Any]) -> InputError:
    """Return an error about a file at the field that can mend it."""
    for field, source in (("motion", motion), ("motion.vertical", motion.get("vertical") or {})):
        if error.field and error.field == Path(str(source.get("file", ""))).name:
            error.field = f"{field}.{_MENDED_BY.get(error.code, 'file')}"
            break
    return error


def _renamed(error: InputError, called: Mapping[str, str]) -> InputError:
    """Return an error that calls files as their sender does."""
    for stored, name in called.items():
        for part in ("field", "problem", "remedy"):
            setattr(error, part, getattr(error, part).replace(stored, plain(name)))
    return error
