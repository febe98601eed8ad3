"""Actions of the page of the case: show it, change it, drag in its drawing, open a file, save one, go back."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import PurePath
from typing import Any

from heeltoe.app.desk import BadRequestError, Desk, Entry, Request, number, text
from heeltoe.app.sessions import Session
from heeltoe.app.transfers import upload_path
from heeltoe.base.payload import Json
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain

# Letters of a case file that the page takes, and of a name of a file.
_LARGEST_FILE, _LONGEST_NAME = 200_000, 120
_MOST_CHANGES = 50


async def show(desk: Desk, request: Request) -> Json:
    """Return the case as it was typed, what is wrong with it, and its drawing."""
    return await _done(desk, lambda: None)


async def fields(desk: Desk, request: Request) -> Json:
    """Return what a case can say."""
    from heeltoe.app.case.fields import form

    return {"of": "case fields", "blocks": await desk.workers.quick(form, desk.session.units)}


async def edit(desk: Desk, request: Request) -> Json:
    """Change fields, as they were typed."""
    from heeltoe.app.case.draft import edit as change

    changes, session = _changes(request), desk.session
    return await _done(desk, lambda: change(session, _typed(session, changes), request.get("step")))


async def put(desk: Desk, request: Request) -> Json:
    """Put in a block that the case does not have, or take one away."""
    from heeltoe.app.case.defaults import block
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.fields import blocks

    path, session, present = text(request, "path"), desk.session, request.get("present") is True
    if path not in {block.path for block in blocks() if block.path}:
        raise BadRequestError(f"a case has no block {path}")
    return await _done(desk, lambda: change(session, block(session.case, session.units, path, wanted=present)))


async def add(desk: Desk, request: Request) -> Json:
    """Put one more item into a list of blocks."""
    from heeltoe.app.case.defaults import item
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.draft import fields_of, valued
    from heeltoe.app.case.fields import field_of

    path, session = text(request, "path"), desk.session
    field = field_of(path)
    if field is None or field.path != path or field.kind != "blocks" or field.blocks:
        raise BadRequestError(f"a case has no list {path}")

    def added() -> None:
        items = valued(fields_of(session)[0], path)
        begin = item(session.case, session.units, path)
        change(session, {path: [*(items if isinstance(items, list) else []), begin]})

    return await _done(desk, added)


async def drag(desk: Desk, request: Request) -> Json:
    """Move a handle of the drawing."""
    from heeltoe.app.case.draft import case_of, fields_in_force
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.handles import moved

    session, name = desk.session, text(request, "handle")
    to, by = (_numbers(request.get(key, {})) for key in ("to", "by"))

    def dragged() -> None:
        case = case_of(session)
        if case is not None:
            change(session, moved(case, session.units, name, to, by, fields_in_force(session)), request.get("step"))

    return await _done(desk, dragged)


async def step(desk: Desk, request: Request) -> Json:
    """Take back the last step, or take it again."""
    from heeltoe.app.case.draft import back

    return await _done(desk, lambda: back(desk.session, forward=request.get("forward") is True))


async def corners(desk: Desk, request: Request) -> Json:
    """Say the section by its corners, in the place of its dimensions."""
    from heeltoe.app.case.draft import case_of, fields_of, valued
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.handles import corners_of

    session = desk.session

    def write_corners() -> None:
        case = case_of(session)
        if case is not None and valued(fields_of(session)[0], "section.polygon") is None:
            change(session, {"section": {"polygon": corners_of(case, session.units)}})

    return await _done(desk, write_corners)


async def open_file(desk: Desk, request: Request) -> Json:
    """Open a case file that was sent, with the files beside it that were sent, too."""
    from heeltoe.app.case.draft import start
    from heeltoe.case.fields_file import read_fields

    session, called = desk.session, _name(request.get("called"))
    path = upload_path(session, text(request, "file"))
    beside = {_name(name): stored for name, stored in _texts(request.get("beside", {})).items()}
    if path is None or any(upload_path(session, stored) is None for stored in beside.values()):
        raise BadRequestError("there is no such file")

    def opened() -> None:
        try:
            if path.stat().st_size > _LARGEST_FILE:
                raise InputError("too-large", called, f"{_LARGEST_FILE // 1000} kB", expected="a case file")
            session.sent |= beside
            start(session, read_fields(path))
        except InputError as error:
            # Not by the name that the file has here.
            error.field = called
            sentences.append(str(error))

    sentences: list[str] = []
    return {**await _done(desk, opened), "file": " ".join(sentences)}


async def save(desk: Desk, request: Request) -> Json:
    """Return the case file of the fields in force, with the meaning of each field beside it."""
    from heeltoe.app.case.draft import fields_in_force
    from heeltoe.case.toml_writer import case_text

    def written() -> Json:
        fields = fields_in_force(desk.session)
        words = re.findall(r"[a-z0-9]+", str(fields.get("title", "")).lower())
        return {"of": "case file", "text": case_text(fields), "name": f"{'-'.join(words)[:60] or 'case'}.toml"}

    fields: dict[str, Any] = await desk.workers.quick(written)
    return fields


async def _done(desk: Desk, do: Callable[[], None]) -> Json:
    """Do something with the case of a tab; where another one is in force then, all its pages hear of it."""
    from heeltoe.app.open_case import state

    session = desk.session

    def done() -> tuple[dict[str, object], dict[str, object] | None]:
        before, moved = session.case, session.moved
        do()
        changed = session.case is not before or session.moved != moved
        return _case_message(session), state(session) if changed else None

    async with session.turn:
        message, changed = await desk.workers.quick(done)
        if changed is not None:
            await desk.tell(changed)
    payload: Json = message
    return payload


def _case_message(session: Session) -> Json:
    from heeltoe.app.case.draft import case_of, draft_of, fields_of, valued
    from heeltoe.app.case.drawing import drawing, law
    from heeltoe.app.case.handles import handle_data, handles

    fields, errors = fields_of(session)
    draft, case = draft_of(session), case_of(session)
    payload: Json = {
        "of": "case",
        "fields": fields,
        "errors": [
            {"field": error.field, "problem": plain(error.problem), "remedy": plain(error.remedy), "code": error.code}
            for error in errors
        ],
        "corners": valued(fields, "section.polygon") is not None,
        "undo": bool(draft.undo),
        "redo": bool(draft.redo),
    }
    if case is not None:
        seen = drawing(case, session.units)
        payload["drawing"] = {**seen, "handles": [handle_data(handle) for handle in handles(case, session.units)]}
    payload["law"] = None if case is None else law(case, session.units)
    return payload


def _typed(session: Session, changes: Mapping[str, object]) -> Json:
    from heeltoe.app.case.defaults import following
    from heeltoe.app.case.draft import fields_of
    from heeltoe.app.case.fields import field_of, typed

    values = {}
    for path, value in changes.items():
        field = field_of(path)
        # What is no field can be taken away.
        values[path] = typed(value, field, session.units) if field else None
    return following(values, fields_of(session)[0])


def _changes(request: Request) -> Json:
    entries = request.get("changes")
    if not isinstance(entries, dict) or not 0 < len(entries) <= _MOST_CHANGES or not all(map(_is_path, entries)):
        raise BadRequestError("changes are values by the paths of fields")
    return entries


def _is_path(path: str) -> bool:
    return all(part.strip() == part != "" for part in path.split(".")) and len(path) <= 200


def _numbers(entries: object) -> dict[str, float]:
    if not isinstance(entries, dict):
        raise BadRequestError("a handle is put to x and z")
    return {axis: number(entries, axis) for axis in ("x", "z") if axis in entries}


def _texts(entries: object) -> dict[str, str]:
    if not isinstance(entries, dict) or not all(isinstance(entry, str) for entry in entries.values()):
        raise BadRequestError("files are names by names")
    return entries


def _name(entry: object) -> str:
    """Return what the sender of a file called it, without any directory."""
    if not isinstance(entry, str):
        raise BadRequestError("a file has a name")
    return plain(PurePath(entry.replace("\\", "/")).name, _LONGEST_NAME) or "file"


ACTIONS = {
    "case": Entry(show, newest=True),
    "case fields": Entry(fields),
    "edit case": Entry(edit),
    "put block": Entry(put),
    "add item": Entry(add),
    "drag": Entry(drag),
    "step case": Entry(step),
    "corners": Entry(corners),
    "open case": Entry(open_file),
    "save case": Entry(save),
}
