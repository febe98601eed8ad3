"""Run a suite of records: one dam, several earthquakes, both signs of each. A suite is a study of one dam."""

from __future__ import annotations

import os
import shutil
import weakref
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from pydantic import ValidationError

from heeltoe.case.model import Case
from heeltoe.case.read import read_case
from heeltoe.case.sentences import first_error
from heeltoe.errors.error import InputError
from heeltoe.models.run import AUTO, check_model, models_of
from heeltoe.study.answers.study_results import Opened
from heeltoe.study.plan.file import Study
from heeltoe.study.plan.motions import suite_events
from heeltoe.study.run.run import Outlook, Progress, run_study

Motions = str | os.PathLike[str] | Sequence[str | os.PathLike[str]]


def run_suite(
    source: Case | str | os.PathLike[str] | Mapping[str, Any],
    motions: Motions,
    *,
    model: str = AUTO,
    pga: str | None = None,
    sa: str | None = None,
    period: str = "T1",
    match: str | None = None,
    target: str | None = None,
    judge: str = "largest",
    both_signs: bool | None = None,
    vertical: bool = False,
    out: str | os.PathLike[str] | None = None,
    resume: bool = False,
    scheduler: str | None = None,
    progress: Callable[[Progress], None] | None = None,
    before: Callable[[Outlook], None] | None = None,
) -> Opened:
    """Run one dam through several earthquakes, each both ways round.

    Parameters
    ----------
    source
        The dam: a case, or what :func:`heeltoe.read_case` takes. Its own motion, if any, is not used.
    motions
        A folder of records, or records by file or by name, each of which is one earthquake.
    model
        As :func:`heeltoe.run` takes it; ``"auto"`` runs the better model alone.
    pga
        Scale each record to this peak, ``"0.3 g"``; as recorded where neither this nor `sa` is given.
    sa
        Scale each record to this spectral acceleration at `period`, 5 % damping.
    period
        ``"0.3 s"``, or ``"T1"`` for the first period of the dam, intact and with its water.
    match
        Match each record to a target spectrum first, ``"en1998:0.3g,B"``; see :func:`heeltoe.match`.
    target
        Target spectrum to draw with those of the records; that of `match` where it is given.
    judge
        What is held against the limits of the case: the ``"largest"``, ``"mean"``, ``"median"`` or ``"84%"`` over the
        records, each by its worse sign.
    both_signs
        Whether each record runs both ways round; it does unless the case says which way round its motion is.
    vertical
        Whether a vertical component, told by its name, shakes the dam with each horizontal one.
    out
        Directory that keeps the runs, for `resume`; without it they are gone with the result.
    resume, scheduler, progress, before
        As of :func:`heeltoe.run_study`.

    Returns
    -------
    Opened
        The runs; `suite` has each record, the numbers over all of them, and the limits.

    Raises
    ------
    InputError
        Where the dam cannot run through the motions.
    """
    case = source if isinstance(source, Case) else read_case(source)
    check_model(model, "model")
    names = models_of(case, model)[0]
    study = _study(
        {
            "title": case.title,
            "case": case.title or "case",
            "model": list(names[-1:] if model == AUTO else names),
            "motions": {
                "events": [event.model_dump() for event in suite_events(_listed(motions), vertical=vertical)],
                "vertical": vertical,
                "both_signs": both_signs,
                "scale": _scale(pga, sa, period),
                "match": match,
            },
            "suite": {"judge": judge, "target": target},
        }
    )
    if out is not None:
        return run_study(study, out, case=case, resume=resume, scheduler=scheduler, progress=progress, before=before)
    place = mkdtemp(prefix="heeltoe-suite-")
    try:
        found = run_study(study, place, case=case, scheduler=scheduler, progress=progress, before=before)
    except BaseException:
        shutil.rmtree(place, ignore_errors=True)
        raise
    # Nobody finds it there.
    found = replace(found, kept=False)
    weakref.finalize(found, shutil.rmtree, place, ignore_errors=True)
    return found


def _study(fields: dict[str, Any]) -> Study:
    try:
        return Study.model_validate(fields)
    except ValidationError as error:
        raise first_error(error, Study) from None


def _listed(motions: Motions) -> list[str]:
    names = [motions] if isinstance(motions, str | os.PathLike) else list(motions)
    if not names:
        raise InputError("study-motions", "motions")
    return [_absolute(os.fspath(name)) for name in names]


def _absolute(name: str) -> str:
    """Return where a file or a folder is; a name of the catalogue stays as it is."""
    path = os.path.expanduser(name)
    return str(Path(path).resolve()) if os.path.exists(path) else name


def _scale(pga: str | None, sa: str | None, period: str) -> dict[str, Any] | None:
    if pga is not None and sa is not None:
        raise InputError("fields-conflict", "pga", other="sa")
    if pga is not None:
        return {"measure": "pga", "values": [pga]}
    if sa is not None:
        return {"measure": "sa", "period": period, "values": [sa]}
    if period != "T1":
        raise InputError("needs-other", "period", other="sa")
    return None
