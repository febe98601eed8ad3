"""Actions of the studies: what a study would be, its runs, what it says, and its export."""

from __future__ import annotations

import shutil
from functools import partial
from itertools import count

from heeltoe.app.answer import aside, start
from heeltoe.app.desk import BadRequestError, Desk, Entry, Request, number, text
from heeltoe.app.sessions import Session
from heeltoe.app.state import Made
from heeltoe.app.transfers import offer
from heeltoe.base.payload import Json
from heeltoe.errors.error import InputError

_NUMBERS = count(1)


async def form(desk: Desk, request: Request) -> Json:
    """Return what a study can be made of, and the studies there are."""
    from heeltoe.app.studies.draft import choices

    return {"of": "study form", "choices": await desk.workers.quick(choices, desk.session), **_listed(desk.session)}


async def look(desk: Desk, request: Request) -> Json:
    """Return how many runs the study of the form has, and about how long they take; or what is wrong with it."""
    from heeltoe.app.live import refused
    from heeltoe.app.studies.draft import study_of_form
    from heeltoe.app.studies.work import look as work

    session = desk.session
    try:
        fields = await desk.workers.quick(study_of_form, request.get("study"), session)
    except InputError as error:
        return {"of": "study look", **refused(error)}
    payload = await aside(desk, work, fields, session.folder / "study-looked-at", desk.settings.most_runs)
    return {"of": "study look", **payload}


async def run(desk: Desk, request: Request) -> Json:
    """Run the study of the form, or go on with one that was cancelled."""
    from heeltoe.app.studies.work import run as work

    session = desk.session
    again = "number" in request
    try:
        made = _made(session, request) if again else await _laid(desk, request)
    except InputError as error:
        return {"of": "study refused", "text": str(error)}
    if again and session.jobs[made.job].state == "running":
        raise BadRequestError("the study runs")
    job = start(desk, f"study {made.number}", work, made.folder, again, session.units, parent=True)
    if job["of"] != "job":
        if not again:
            await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), made.folder)
        return {"of": "study refused", "text": job["text"]}
    number = job["number"]
    assert isinstance(number, int)
    made.job = number
    session.studies[made.number] = made
    await desk.tell(job)
    return {"of": "studies", **_listed(session)}


async def _laid(desk: Desk, request: Request) -> Made:
    """Write the study of the form into a folder of its own.

    Raises
    ------
    InputError
        Where it cannot run, or there are too many.
    """
    from heeltoe.app.studies.draft import study_of_form
    from heeltoe.app.studies.work import lay
    from heeltoe.study.plan.file import untitled

    session = desk.session
    if len(session.studies) >= desk.settings.most_studies:
        raise InputError("too-many", "studies", len(session.studies) + 1, most=desk.settings.most_studies)
    fields = await desk.workers.quick(study_of_form, request.get("study"), session)
    number = next(_NUMBERS)
    folder = session.folder / f"study-{number}"
    try:
        await desk.workers.aside(lay, fields, folder, desk.settings.most_runs)
    except InputError:
        await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), folder)
        raise
    case, study, _ = fields
    records = len(study.get("motions", {}).get("events", ())) or 1
    title = study.get("title") or case.get("title") or untitled(study, records)
    return Made(number, str(title), folder, 0)


async def remove(desk: Desk, request: Request) -> Json:
    """Remove a study with its runs."""
    session = desk.session
    made = _made(session, request)
    session.jobs.pop(made.job).cancel()
    del session.studies[made.number]
    await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), made.folder)
    return {"of": "studies", **_listed(session)}


async def answers(desk: Desk, request: Request) -> Json:
    """Return what a study says, with its figures, as far as it has come."""
    from heeltoe.app.studies.work import answers as work
    from heeltoe.app.studies.work import kept_answers

    made, units = _made(desk.session, request), desk.session.units
    payload = await desk.workers.quick(kept_answers, made.folder, units)
    if payload is None:
        payload = await aside(desk, work, made.folder, units)
    return {"of": "study answers", "number": made.number, **payload}


async def download(desk: Desk, request: Request) -> Json:
    """Return where something of a study can be fetched."""
    from heeltoe.app.studies.work import STUDY, packed

    made, what = _made(desk.session, request), text(request, "what")
    if what == "file":
        return offer(desk.session, made.folder / STUDY, STUDY)
    if what not in ("study", "csv", "pdf", "html"):
        raise BadRequestError("what is study, csv, pdf, html or file")
    path = await aside(desk, packed, made.folder, what, desk.session.units)
    return (
        {"of": "study refused", "text": path["error"]["text"]} if isinstance(path, dict) else offer(desk.session, *path)
    )


def _made(session: Session, request: Request) -> Made:
    made = session.studies.get(int(number(request, "number")))
    if made is None:
        raise BadRequestError("there is no such study")
    return made


def _listed(session: Session) -> Json:
    return {
        "studies": [
            {"number": study.number, "title": study.title, "job": session.jobs[study.job].payload()}
            for study in session.studies.values()
        ]
    }


ACTIONS = {
    "study form": Entry(form, newest=True),
    "study look": Entry(look, newest=True, writes=True),
    "study run": Entry(run, writes=True),
    "study remove": Entry(remove),
    "study answers": Entry(answers),
    "study download": Entry(download, writes=True),
}
