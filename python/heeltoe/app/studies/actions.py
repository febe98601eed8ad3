"""Actions of the studies: what a study would be, its runs, what it says, and what is taken away of it."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

from heeltoe.app.actions import Asked, BadRequestError, Desk, Entry, number, text
from heeltoe.app.answer import start
from heeltoe.app.downloads import offer
from heeltoe.app.sessions import Session
from heeltoe.app.workers import WorkerLostError
from heeltoe.errors import InputError

_NUMBERS = count(1)
_LOST = "The process that looks at studies was ended, perhaps for want of memory. It has been started anew."


@dataclass(eq=False)
class Made:
    """A study of a tab.

    Attributes
    ----------
    number, title
        For the page.
    folder
        Of its file, its case, its records and its runs.
    job
        The number of its run.
    """

    number: int
    title: str
    folder: Path
    job: int


async def form(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return what a study can be made of, and the studies there are."""
    from heeltoe.app.studies.draft import choices

    return {"of": "study form", "choices": await desk.workers.quick(choices, desk.session), **_listed(desk.session)}


async def look(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return how many runs the study of the form has, and about how long they take; or what is wrong with it."""
    from heeltoe.app.live import refused
    from heeltoe.app.studies.draft import study_asked
    from heeltoe.app.studies.work import look as work

    session = desk.session
    try:
        told = await desk.workers.quick(study_asked, asked.get("study"), session)
    except InputError as error:
        return {"of": "study look", **refused(error)}
    found = await _aside(desk, work, told, session.folder / "study-looked-at", desk.settings.most_runs)
    return {"of": "study look", **found}


async def run(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Run the study of the form, or go on with one that was cancelled."""
    from heeltoe.app.studies.work import run as work

    session = desk.session
    again = "number" in asked
    try:
        made = _made(session, asked) if again else await _laid(desk, asked)
    except InputError as error:
        return {"of": "study refused", "text": str(error)}
    if again and session.jobs[made.job].state == "running":
        raise BadRequestError("the study runs")
    told = start(desk, f"study {made.number}", work, made.folder, again, session.units, parent=True)
    if told["of"] != "job":
        if not again:
            await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), made.folder)
        return {"of": "study refused", "text": told["text"]}
    made.job = told["number"]
    session.studies[made.number] = made
    await desk.tell(told)
    return {"of": "studies", **_listed(session)}


async def _laid(desk: Desk, asked: Asked) -> Made:
    """Write the study of the form into a folder of its own.

    Raises
    ------
    InputError
        Where it cannot run, or there are too many.
    """
    from heeltoe.app.studies.draft import study_asked
    from heeltoe.app.studies.work import lay

    session = desk.session
    if len(session.studies) >= desk.settings.most_studies:
        raise InputError("study-many", "studies", len(session.studies) + 1, most=desk.settings.most_studies)
    told = await desk.workers.quick(study_asked, asked.get("study"), session)
    number = next(_NUMBERS)
    folder = session.folder / f"study-{number}"
    try:
        await desk.workers.aside(lay, told, folder, desk.settings.most_runs)
    except InputError:
        await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), folder)
        raise
    return Made(number, str(told[1].get("title") or told[0].get("title") or "untitled study"), folder, 0)


async def remove(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Remove a study with its runs."""
    session = desk.session
    made = _made(session, asked)
    session.jobs.pop(made.job).cancel()
    del session.studies[made.number]
    await desk.workers.quick(partial(shutil.rmtree, ignore_errors=True), made.folder)
    return {"of": "studies", **_listed(session)}


async def answers(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return what a study says, with its figures, as far as it has come."""
    from heeltoe.app.studies.work import answers as work
    from heeltoe.app.studies.work import kept_answers

    made, units = _made(desk.session, asked), desk.session.units
    found = await desk.workers.quick(kept_answers, made.folder, units)
    if found is None:
        found = await _aside(desk, work, made.folder, units)
    return {"of": "study answers", "number": made.number, **found}


async def download(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return where something of a study can be fetched."""
    from heeltoe.app.studies.work import STUDY, packed

    made, what = _made(desk.session, asked), text(asked, "what")
    if what == "file":
        return offer(desk.session, made.folder / STUDY, STUDY)
    if what not in ("study", "csv", "pdf", "html"):
        raise BadRequestError("what is study, csv, pdf, html or file")
    found = await _aside(desk, packed, made.folder, what, desk.session.units)
    return (
        {"of": "study refused", "text": found["error"]["text"]}
        if isinstance(found, dict)
        else offer(desk.session, *found)
    )


def _made(session: Session, asked: Asked) -> Made:
    made = session.studies.get(int(number(asked, "number")))
    if made is None:
        raise BadRequestError("there is no such study")
    return made


def _listed(session: Session) -> dict[str, Any]:
    return {
        "studies": [
            {"number": each.number, "title": each.title, "job": session.jobs[each.job].told()}
            for each in session.studies.values()
        ]
    }


async def _aside(desk: Desk, work: Any, *arguments: Any) -> Any:
    """Compute in the process of the studies, which may be lost as any other."""
    from heeltoe.app.live import refused

    try:
        return await desk.workers.aside(work, *arguments)
    except WorkerLostError:
        return {"error": {"field": "", "text": _LOST, "problem": _LOST, "remedy": ""}}
    except InputError as error:
        return refused(error)


ACTIONS = {
    "study form": Entry(form, newest=True),
    "study look": Entry(look, newest=True),
    "study run": Entry(run),
    "study remove": Entry(remove),
    "study answers": Entry(answers),
    "study download": Entry(download),
}
