"""Actions of the page of the ground motion: take a record, look at what would shake the dam, use it in the case."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePath
from typing import Any

from heeltoe.app.desk import BadRequestError, Desk, Entry, Request, text
from heeltoe.app.motion.sequence import MOST
from heeltoe.app.sessions import Session
from heeltoe.app.transfers import forget, upload_path
from heeltoe.app.workers import WorkerLostError
from heeltoe.base.payload import Json
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain

_LONGEST_NAME = 80
_SLOW = "Reading takes too long, or more memory than there is: it has been ended. Send the part that matters, in a \
common format."


async def begin(desk: Desk, request: Request) -> Json:
    """Return what the page begins with: what can be chosen, and what the case has."""
    return {"of": "motion", **await desk.workers.quick(_begin, desk.session, _place(request))}


def _begin(session: Session, place: int) -> Json:
    from heeltoe.app.case.draft import fields_of
    from heeltoe.app.motion.draft import form_of
    from heeltoe.app.motion.sequence import listed

    fields, errors = fields_of(session)
    motions = listed(fields, {error.field: f"{plain(error.problem)}; {plain(error.remedy)}" for error in errors})
    place = min(place, max(len(motions) - 1, 0))
    payload = {"motions": motions, "most": MOST, "place": place, "form": form_of(session, place)}
    return payload | {"records": _records(session), "catalogue": _catalogue()}


def _place(request: Request, name: str = "place") -> int:
    """Return which motion of the case a page means."""
    place = request.get(name, 0)
    if isinstance(place, bool) or not isinstance(place, int) or not 0 <= place < MOST:
        raise BadRequestError(f"{name} is that of a motion of the case")
    return place


def _records(session: Session) -> list[Json]:
    """Return the records that a tab has sent; of a file that another page has taken nothing is known yet."""
    return [{"name": name, "channels": session.records.get(name, [{"channel": ""}])} for name in session.sent]


def _catalogue() -> list[str]:
    from heeltoe.motion.records.catalog import MADE_TO_ORDER, available

    return list(dict.fromkeys(name for name, where in available() if (name, where) != MADE_TO_ORDER))


async def record(desk: Desk, request: Request) -> Json:
    """Read a file that was sent as a record; what is none is thrown away."""
    from heeltoe.app.motion.look import channels

    session, called = desk.session, text(request, "called")
    path = upload_path(session, text(request, "file"))
    if path is None or path.name in session.sent.values():
        raise BadRequestError("there is no such file")
    name = await desk.workers.quick(_free_name, session, called)
    try:
        channel_list = await desk.workers.read(desk.settings.longest_reading_s, channels, path, name)
    except WorkerLostError:
        channel_list = {"error": {"field": name, "text": f"{name}: {_SLOW}", "problem": _SLOW, "remedy": ""}}
    if "error" in channel_list:
        forget(session, path)
        return {"of": "record", "called": name, **channel_list}
    session.sent[name], session.records[name] = path.name, channel_list["channels"]
    return {"of": "record", "called": name, "records": _records(session), **channel_list}


def _free_name(session: Session, called: str) -> str:
    """Return what a file is called in the case: as its sender calls it, unless that means something else there."""
    from heeltoe.motion.records.catalog import PREFIX

    bare = plain(PurePath(called.replace("\\", "/")).name, _LONGEST_NAME).replace(":", "-")
    path = PurePath(bare if bare.strip(". ") else "record")
    taken = {*session.sent, *session.sent.values(), *_catalogue()}
    count, name = 1, path.name
    while name in taken or name.startswith((PREFIX, "upload-")) or PurePath(name).stem in taken:
        count += 1
        name = f"record-{count}{path.suffix}" if name.startswith("upload-") else f"{path.stem}-{count}{path.suffix}"
    return name


async def look(desk: Desk, request: Request) -> Json:
    """Return what would shake the dam."""
    from heeltoe.app.motion.look import look as seen

    return {"of": "motion look", **await _read(desk, request, seen, desk.session.units)}


async def use(desk: Desk, request: Request) -> Json:
    """Put the motion of the page into the case of the tab: in place of one of its motions, or after all."""
    from heeltoe.app.motion.look import refusal
    from heeltoe.app.motion.sequence import listed, with_one

    session, place, to = desk.session, _place(request), _place(request, "to")
    payload = await _read(desk, request, refusal)
    if payload:
        return {"of": "motion used", **payload}

    def changes(fields: dict[str, Any]) -> Json:
        if to > min(len(listed(fields)), MOST - 1):
            raise BadRequestError("to is the place of a motion, or that after all")
        return with_one(fields, to, _motion(session, request["form"], place))

    return {**await _changed(desk, changes), "place": to}


async def change(desk: Desk, request: Request) -> Json:
    """Change the list of the case's motions: move one, remove one, or say the pause before it."""
    from heeltoe.app.case.fields import field_of, typed
    from heeltoe.app.motion.sequence import listed, moved, paused, without

    session, place, what = desk.session, _place(request), request.get("what")

    def changes(fields: dict[str, Any]) -> Json:
        count = len(listed(fields))
        by = {"up": -1, "down": 1}.get(str(what), 0)
        if not 0 <= place + by < count or not place < count or (what == "pause" and place == 0):
            raise BadRequestError("there is no such motion")
        if by:
            return moved(fields, place, by)
        if what == "remove" and count > 1:
            return without(fields, place)
        field = field_of("aftershocks[].pause")
        if what == "pause" and field is not None:
            return paused(fields, place, typed(text(request, "pause"), field, session.units))
        raise BadRequestError("what is up, down, remove or pause")

    return await _changed(desk, changes)


async def _changed(desk: Desk, changes: Callable[[dict[str, Any]], dict[str, Any]]) -> Json:
    """Change the motions of the case, and return what keeps that from being in force."""
    from heeltoe.app.case.draft import draft_of, edit, fields_of
    from heeltoe.app.live import refused
    from heeltoe.app.open_case import state

    session = desk.session

    def changed() -> Json:
        edit(session, changes(fields_of(session)[0]))
        return next(map(refused, draft_of(session).errors), {})

    async with session.turn:
        payload: Json = await desk.workers.quick(changed)
        await desk.tell(await desk.workers.quick(state, session))
    return {"of": "motion used", **payload}


def _motion(session: Session, entry: object, place: int) -> Json:
    """Return the motion of a form as a file has it."""
    from heeltoe.app.case.files import as_sent
    from heeltoe.app.motion.draft import motion_fields, read_form

    form = read_form(entry)
    assert form is not None
    fields: dict[str, Any] = as_sent(session, {"motion": motion_fields(form, _had(session, place), session.sent)})
    return dict(fields["motion"])


def _had(session: Session, place: int) -> Any:
    from heeltoe.app.motion.draft import motions_of

    motions = motions_of(session.case)
    return motions[place] if place < len(motions) else None


async def _read(desk: Desk, request: Request, compute: Any, *arguments: Any) -> Json:
    """Compute with the case and the motion that the page asks for, where files are read."""
    from heeltoe.app.live import refused
    from heeltoe.app.motion.draft import motion_fields, read_form

    session, form = desk.session, read_form(request.get("form"))
    if form is None or session.case is None:
        raise BadRequestError("a motion is chosen by the fields of its page")
    try:
        fields = motion_fields(form, _had(session, _place(request)), session.sent)
    except InputError as error:
        return {"usable": False, "motions": [], **refused(error)}
    read, longest = desk.workers.read, desk.settings.longest_reading_s
    try:
        payload: Json = await read(longest, compute, session.case, fields, session.folder, *arguments)
    except WorkerLostError:
        too_slow = {"field": "motion", "text": _SLOW, "problem": _SLOW, "remedy": ""}
        return {"usable": False, "motions": [], "error": too_slow}
    return payload


ACTIONS = {
    "motion": Entry(begin, newest=True),
    "record": Entry(record),
    "motion look": Entry(look, newest=True),
    "use motion": Entry(use),
    "change motions": Entry(change),
}
