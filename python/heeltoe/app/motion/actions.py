"""Actions of the page of the ground motion: take a record, look at what would shake the dam, use it in the case."""

from __future__ import annotations

from pathlib import PurePath
from typing import Any

from heeltoe.app.actions import Asked, BadRequestError, Desk, Entry, text
from heeltoe.app.sessions import Session
from heeltoe.app.uploads import forget, upload_path
from heeltoe.app.workers import WorkerLostError
from heeltoe.errors import InputError
from heeltoe.plain import plain

_LONGEST_NAME = 80
_SLOW = "Reading takes too long, or more memory than there is: it has been ended. Send the part that matters, in a \
common format."


async def begin(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return what the page begins with: what can be chosen, and what the case has."""
    return {"of": "motion", **await desk.workers.quick(_begin, desk.session)}


def _begin(session: Session) -> dict[str, Any]:
    from heeltoe.app.motion.draft import form_of

    return {"form": form_of(session), "records": _records(session), "catalogue": _catalogue()}


def _records(session: Session) -> list[dict[str, Any]]:
    """Return the records that a tab has sent; of a file that another page has taken nothing is known yet."""
    return [{"name": name, "channels": session.records.get(name, [{"channel": ""}])} for name in session.sent]


def _catalogue() -> list[str]:
    from heeltoe.motion.records.catalog import MADE_TO_ORDER, available

    return list(dict.fromkeys(name for name, where in available() if (name, where) != MADE_TO_ORDER))


async def record(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Read a file that was sent as a record; what is none is thrown away."""
    from heeltoe.app.motion.look import channels

    session, called = desk.session, text(asked, "called")
    path = upload_path(session, text(asked, "file"))
    if path is None or path.name in session.sent.values():
        raise BadRequestError("there is no such file")
    name = await desk.workers.quick(_free_name, session, called)
    try:
        found = await desk.workers.read(desk.settings.longest_reading_s, channels, path, name)
    except WorkerLostError:
        found = {"error": {"field": name, "text": f"{name}: {_SLOW}", "problem": _SLOW, "remedy": ""}}
    if "error" in found:
        forget(session, path)
        return {"of": "record", "called": name, **found}
    session.sent[name], session.records[name] = path.name, found["channels"]
    return {"of": "record", "called": name, "records": _records(session), **found}


def _free_name(session: Session, called: str) -> str:
    """Return what a file is called in the case: as its sender calls it, unless that means something else there."""
    from heeltoe.motion.scenario import PREFIX

    bare = plain(PurePath(called.replace("\\", "/")).name, _LONGEST_NAME).replace(":", "-")
    path = PurePath(bare if bare.strip(". ") else "record")
    taken = {*session.sent, *session.sent.values(), *_catalogue()}
    count, name = 1, path.name
    while name in taken or name.startswith((PREFIX, "upload-")) or PurePath(name).stem in taken:
        count += 1
        name = f"record-{count}{path.suffix}" if name.startswith("upload-") else f"{path.stem}-{count}{path.suffix}"
    return name


async def look(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return what would shake the dam."""
    from heeltoe.app.motion.look import look as seen

    return {"of": "motion look", **await _read(desk, asked, seen, desk.session.units)}


async def use(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Shake the case of the tab by what stands on the page."""
    from heeltoe.app.motion.look import refusal
    from heeltoe.app.open_case import state

    session = desk.session
    found = await _read(desk, asked, refusal)
    if not found:
        found = await desk.workers.quick(_put, session, asked["form"])
        await desk.tell(await desk.workers.quick(state, session))
    return {"of": "motion used", **found}


def _put(session: Session, given: object) -> dict[str, Any]:
    """Put the motion of a form into the case, and return what keeps that from being in force."""
    from heeltoe.app.case.draft import draft_of, edit
    from heeltoe.app.case.files import as_sent
    from heeltoe.app.live import refused
    from heeltoe.app.motion.draft import motion_fields, read_form

    form, case = read_form(given), session.case
    assert form is not None
    assert case is not None
    edit(session, as_sent(session, {"motion": motion_fields(form, case, session.sent)}))
    return next(map(refused, draft_of(session).errors), {})


async def _read(desk: Desk, asked: Asked, compute: Any, *arguments: Any) -> dict[str, Any]:
    """Compute with the case and the motion that the page asks for, where files are read."""
    from heeltoe.app.live import refused
    from heeltoe.app.motion.draft import motion_fields, read_form

    session, form = desk.session, read_form(asked.get("form"))
    if form is None or session.case is None:
        raise BadRequestError("a motion is chosen by the fields of its page")
    try:
        fields = motion_fields(form, session.case, session.sent)
    except InputError as error:
        return {"usable": False, "motions": [], **refused(error)}
    read, most = desk.workers.read, desk.settings.longest_reading_s
    try:
        found: dict[str, Any] = await read(most, compute, session.case, fields, session.folder, *arguments)
    except WorkerLostError:
        said = {"field": "motion", "text": _SLOW, "problem": _SLOW, "remedy": ""}
        return {"usable": False, "motions": [], "error": said}
    return found


ACTIONS = {
    "motion": Entry(begin, newest=True),
    "record": Entry(record),
    "motion look": Entry(look, newest=True),
    "use motion": Entry(use),
}
