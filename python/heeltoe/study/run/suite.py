"""Run a suite of records: one dam, several earthquakes, both signs of each. A suite is a study of one dam."""

from __future__ import annotations

import os
import re
import shutil
import weakref
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from heeltoe.case.lists import renamed
from heeltoe.case.model import Case
from heeltoe.case.read import read_case
from heeltoe.case.suite import Suite
from heeltoe.errors.error import InputError
from heeltoe.models.run import AUTO, check_model, models_of
from heeltoe.motion.disaggregation import Disaggregation, read_disaggregation
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.study.plan.components import Reading
from heeltoe.study.plan.file import Event, Study
from heeltoe.study.plan.motions import suite_events
from heeltoe.study.run.run import Outlook, Progress, run_study

Motions = str | os.PathLike[str] | Sequence[str | os.PathLike[str]]
_READING = ("unit", "time_step", "layout", "factor", "processing")
# Fields of the study of a suite, and what the case calls them.
_FIELDS = {
    f"motions.{name}": f"suite.{field}"
    for name, field in (
        *(("scale.period", "period"), ("match", "match")),
        *((name, name) for name in ("vertical", "cross_valley", *_READING)),
    )
}

_OF_FILES = re.compile(rf"\bmotions\.({'|'.join(_READING)})\b")


def run_suite(
    source: Case | str | os.PathLike[str] | Mapping[str, Any],
    motions: Motions | None = None,
    *,
    model: str = AUTO,
    out: str | os.PathLike[str] | None = None,
    resume: bool = False,
    scheduler: str | None = None,
    progress: Callable[[Progress], None] | None = None,
    before: Callable[[Outlook], None] | None = None,
    **suite: Any,
) -> StudyResults:
    """Run one dam through several earthquakes, each both ways round.

    Parameters
    ----------
    source
        The dam: a case, or what :func:`heeltoe.read_case` takes. Its single motion, if any, is not used.
    motions
        A folder of records, or records by file or by name, each of which is one earthquake, in the place of those that
        the case lists in `[[motions]]`.
    model
        As :func:`heeltoe.run` takes it; ``"auto"`` runs the better model alone.
    out
        Directory that keeps the runs, for `resume`; without it they are gone with the result.
    resume, scheduler, progress, before
        As of :func:`heeltoe.run_study`.
    **suite
        Fields of the block `[suite]` of the case, which win over its own: ``sa="0.5 g", judge="mean"``.

    Returns
    -------
    StudyResults
        The runs; `suite` has each record, the numbers over all of them, and the limits.

    Raises
    ------
    InputError
        Where the dam cannot run through the motions.
    """
    case = source if isinstance(source, Case) else read_case(source)
    changes = {f"suite.{name}": value for name, value in suite.items() if value is not None}
    if motions is not None:
        vertical = bool(suite.get("vertical") or case.suite.vertical)
        changes["motions"] = [_entry(case, name, vertical=vertical) for name in _listed(motions)]
    case = case.with_(changes) if changes else case
    check_model(model, "model")
    study, names = _study_of(case, model)
    place = mkdtemp(prefix="heeltoe-suite-") if out is None else out
    still = case.model_copy(update={"motions": (), "suite": Suite()})
    still.model_fields_set.difference_update({"motions", "suite"})
    options = {"scheduler": scheduler, "progress": progress, "before": before}
    try:
        results = run_study(study, place, case=still, resume=resume, **options)  # type: ignore[arg-type]
    except BaseException as error:
        if out is None:
            shutil.rmtree(place, ignore_errors=True)
        if isinstance(error, InputError):
            for one in renamed((error, *error.others), names):
                one.remedy = _OF_FILES.sub(r"suite.\1", one.remedy)
        raise
    if out is not None:
        return results
    # No one finds it there.
    results = replace(results, kept=False)
    weakref.finalize(results, shutil.rmtree, place, ignore_errors=True)
    return results


def _study_of(case: Case, model: str) -> tuple[Study, dict[str, str]]:
    """Return the study that a suite is, and how the case calls its fields."""
    rule, models = case.suite, models_of(case, model)[0]
    events, paths = suite_events(
        case.motions,
        case.base_directory,
        vertical=rule.vertical,
        cross_valley=rule.cross_valley,
        reading=Reading.of(rule),
    )
    if rule.disaggregation is not None:
        shares = read_disaggregation(rule.disaggregation, case.base_directory, "suite.disaggregation")
        events = [event.model_copy(update={"hazard_share": _share(shares, event)}) for event in events]
    scale = None
    if rule.pga is not None:
        scale = {"measure": "pga", "values": [str(rule.pga)]}
    elif rule.sa is not None:
        scale = {"measure": "sa", "period": _as_written(rule.period), "values": [str(rule.sa)]}
    study = Study.of(
        {
            "title": case.title,
            "case": case.title or "case",
            "model": list(models[-1:] if model == AUTO else models),
            "motions": {
                "events": [_written(event) for event in events],
                "vertical": rule.vertical,
                "cross_valley": rule.cross_valley,
                "both_signs": rule.both_signs,
                "scale": scale,
                "match": rule.match,
                "unit": rule.unit,
                "time_step": None if rule.time_step is None else f"{rule.time_step!r} s",
                "layout": rule.layout,
                "factor": rule.factor,
                "processing": [step.model_dump(mode="json", exclude_unset=True) for step in rule.processing],
            },
            "suite": {"judge": rule.judge, "target": rule.target},
        },
        case.base_directory,
    )
    names = {f"motions.events[{place}].horizontal[0]": f"{path}.file" for place, path in enumerate(paths)}
    names |= {f"motions.events[{place}].vertical": f"{path}.vertical" for place, path in enumerate(paths)}
    names["motions.scale.values"] = "suite.sa" if rule.sa is not None else "suite.pga"
    return study, names | _FIELDS


def _share(shares: Disaggregation, event: Event) -> float | None:
    """Return the share of the hazard from earthquakes like that of an event; None where it is not known which it is."""
    if event.magnitude is None or event.distance is None:
        return None
    return shares.share_of(event.magnitude, event.distance)


def _written(event: Event) -> dict[str, Any]:
    """Return an event as a study file has it."""
    units = {"distance": "m", "vs30": "m/s", "pulse_period": "s"}
    return {
        name: f"{value!r} {units[name]}" if name in units and value is not None else value
        for name, value in event.model_dump().items()
    }


def _as_written(period: str | float | None) -> str:
    return f"{period!r} s" if isinstance(period, float) else "T1"


def _entry(case: Case, name: str, *, vertical: bool) -> dict[str, str]:
    """Return a record of a suite, on request with the vertical component that the case names for it."""
    named = _vertical_of(case, name) if vertical else None
    return {"file": name} if named is None else {"file": name, "vertical": named}


def _vertical_of(case: Case, name: str) -> str | None:
    """Return the file of the vertical component that goes with a record in the case; None where it names none."""

    def is_same(file: str | None) -> bool:
        return file is not None and (file == name or _absolute(str(case.base_directory / file)) == name)

    listed = (motion.vertical for motion in case.motions if is_same(motion.file))
    single = (case.motion, *case.aftershocks)
    pairs = (motion.vertical.file for motion in single if motion and motion.vertical and is_same(motion.file))
    return next((file for file in (*listed, *pairs) if file is not None), None)


def _listed(motions: Motions) -> list[str]:
    names = [motions] if isinstance(motions, str | os.PathLike) else list(motions)
    if not names:
        raise InputError("study-motions", "motions")
    return [_absolute(os.fspath(name)) for name in names]


def _absolute(name: str) -> str:
    """Return the path of a file or a folder; a name of the catalogue is returned unchanged."""
    path = os.path.expanduser(name)
    return str(Path(path).resolve()) if os.path.exists(path) else name
