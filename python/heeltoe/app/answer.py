"""Actions of the answer: what the dam does as a block while a slider moves, as an elastic dam as soon as
it rests, and with evidence on a button."""

from __future__ import annotations

import asyncio
import math
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from heeltoe.app.desk import BadRequestError, Desk, Entry, Request, number
from heeltoe.app.jobs import Job, Work
from heeltoe.app.sessions import Session
from heeltoe.app.transfers import full
from heeltoe.app.workers import WorkerLostError
from heeltoe.base.payload import Json
from heeltoe.errors.error import InputError

#: What a page is told where a process was killed, or was out of memory.
LOST = "The process that computes this was ended, perhaps because memory ran out. It has been restarted."
# How often it is looked whether a run fills the room of all tabs [s].
_LOOKS_EVERY_S = 2.0
# Of all tabs.
_RUNNING: set[asyncio.Task[None]] = set()


def changes_of(session: Session, values: object) -> Json:
    """Return what the sliders of a page change, by the paths of the case; what stands where the case is changes
    nothing."""
    from heeltoe.app.sliders import change, sliders

    if session.case is None or not isinstance(values, Mapping):
        raise BadRequestError("values are numbers by the paths of the sliders")
    known = {slider.path: slider for slider in sliders(session.case, session.units)}
    changes: dict[str, Any] = {}
    for path in values:
        if path not in known:
            raise BadRequestError(f"no slider has the path {path}")
        changes |= change(known[path], number(dict(values), path), session.case)
    return changes


def _is_late(session: Session, request: Request) -> bool:
    """Whether the page had not seen the last state when it asked: its sliders were of another case than the one there
    is, and it asks again when it has."""
    return bool(request.get("state", session.stated) != session.stated)


async def rigid(desk: Desk, request: Request) -> Json:
    """Run the rigid block with the sliders where they are, and remember where that is."""
    from heeltoe.app.live import answer

    session = desk.session
    values = request.get("values")
    async with session.turn:
        if _is_late(session, request):
            return {"of": "late"}
        session.changes, session.moved = changes_of(session, values), frozenset(values or ())
        session.heard = int(number(request, "serial")) if "serial" in request else session.heard
    payload = await desk.workers.quick(answer, session.case, session.changes, "rigid", session.units)
    return {"of": "rigid", **payload}


async def decoupled(desk: Desk, request: Request) -> Json:
    """Run the decoupled chain with the sliders where they are."""
    from heeltoe.app.live import answer

    session = desk.session
    if _is_late(session, request):
        return {"of": "late"}
    changes = changes_of(session, request.get("values"))
    try:
        payload = await desk.workers.beside(answer, session.case, changes, "decoupled", session.units)
    except WorkerLostError:
        payload = {"absent": LOST}
    return {"of": "decoupled", **payload}


async def elastic(desk: Desk, request: Request) -> Json:
    """Run the elastic dam without evidence with the sliders where they are, `long` or not; without values the tab waits
    for it no longer. The next one takes the place of one that runs."""
    from heeltoe.app.live import LONGEST_S
    from heeltoe.app.live import elastic as work

    session = desk.session
    if request.get("values") is None:
        return {"of": "elastic stopped"}
    changes = changes_of(session, request.get("values"))
    longest = math.inf if request.get("long") is True else LONGEST_S
    try:
        payload = await desk.workers.until_cancelled(work, session.case, changes, session.units, longest)
    except WorkerLostError:
        payload = {"waits": LOST}
    session.elastic = payload.get("left")
    return {"of": "elastic", **payload}


async def flexible(desk: Desk, request: Request) -> Json:
    """Start the flexible model with the sliders where they are; it tells how far it is, and its result in the end."""
    from heeltoe.app.live import flexible as work

    session = desk.session
    changes = changes_of(session, request.get("values"))
    return start(desk, "flexible", work, session.case, changes, session.units)


def start(
    desk: Desk, what: str, work: Work, *arguments: Any, parent: bool = False, unless_done: Path | None = None
) -> Json:
    """Start a long run of this tab, and return its state; see :class:`heeltoe.app.jobs.Job`. A folder is
    removed `unless_done`: where it does not come to its end."""
    session = desk.session
    if len(_RUNNING) >= desk.settings.most_jobs:
        if unless_done is not None:
            shutil.rmtree(unless_done, ignore_errors=True)
        return {
            "of": "job refused",
            "what": what,
            "text": f"{len(_RUNNING)} long runs are under way; cancel one, or wait until one ends.",
        }
    job = Job(what, work, *arguments, parent=parent)
    session.jobs[job.number] = job
    task = asyncio.create_task(_followed(desk, job, unless_done))
    _RUNNING.add(task)
    task.add_done_callback(_RUNNING.discard)
    return job.payload()


async def _followed(desk: Desk, job: Job, unless_done: Path | None) -> None:
    """Follow a run to its end, and end it where its files take more room than there is."""
    watch = asyncio.create_task(_watched(desk, job))
    try:
        await job.follow(desk.session.say)
    finally:
        watch.cancel()
    if job.state != "done" and unless_done is not None:
        await asyncio.to_thread(shutil.rmtree, unless_done, ignore_errors=True)


async def _watched(desk: Desk, job: Job) -> None:
    while job.state == "running":
        await asyncio.sleep(_LOOKS_EVERY_S)
        if refusal := await asyncio.to_thread(full, desk.settings):
            job.cancel("refused", refusal)


async def aside(desk: Desk, work: Callable[..., Any], *arguments: Any) -> Any:
    """Compute what takes seconds in the process for that, which may be lost, or say what is wrong with the input."""
    from heeltoe.app.live import refused

    try:
        return await desk.workers.aside(work, *arguments)
    except WorkerLostError:
        return {"error": {"field": "", "text": LOST, "problem": LOST, "remedy": ""}}
    except InputError as error:
        return refused(error)


async def cancel(desk: Desk, request: Request) -> Json:
    """Cancel a long run of this tab."""
    job = desk.session.jobs.get(int(number(request, "number")))
    if job is None:
        raise BadRequestError("there is no such run")
    job.cancel()
    return job.payload()


ACTIONS = {
    "rigid": Entry(rigid, newest=True),
    "decoupled": Entry(decoupled, newest=True),
    "elastic": Entry(elastic, replaced=True),
    "flexible": Entry(flexible),
    "cancel": Entry(cancel),
}
