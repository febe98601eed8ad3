"""Actions of the page of the case: show it, change it, drag in its drawing, open a file, save one, go back."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import PurePath
from typing import Any

from heeltoe.app.actions import Asked, BadRequestError, Desk, Entry, number, text
from heeltoe.app.sessions import Session
from heeltoe.app.uploads import upload_path
from heeltoe.errors import InputError
from heeltoe.plain import plain

# Letters of a case file that the page takes, and of a name of a file.
_LARGEST_FILE, _LONGEST_NAME = 200_000, 120
_MOST_CHANGES = 50


async def show(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return the case as it was typed, what is wrong with it, and its drawing."""
    return await _done(desk, lambda: None)


async def fields(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return what a case can say."""
    from heeltoe.app.case.fields import form

    return {"of": "case fields", "blocks": await desk.workers.quick(form, desk.session.units)}


async def edit(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Change fields, as they were typed."""
    from heeltoe.app.case.draft import edit as change

    changes, session = _changes(asked), desk.session
    return await _done(desk, lambda: change(session, _typed(session, changes), asked.get("step")))


async def put(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Put in a block that the case does not have, or take one away."""
    from heeltoe.app.case.begin import block
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.fields import blocks

    path, session, there = text(asked, "path"), desk.session, asked.get("there") is True
    if path not in {each.path for each in blocks() if each.path}:
        raise BadRequestError(f"{path} is no block of a case")
    return await _done(desk, lambda: change(session, block(session.case, session.units, path, there=there)))


async def add(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Put one more item into a list of blocks."""
    from heeltoe.app.case.begin import item
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.draft import fields_of, valued
    from heeltoe.app.case.fields import field_of

    path, session = text(asked, "path"), desk.session
    field = field_of(path)
    if field is None or field.path != path or field.kind != "blocks" or field.blocks:
        raise BadRequestError(f"{path} is no list of a case")

    def added() -> None:
        there = valued(fields_of(session)[0], path)
        begin = item(session.case, session.units, path)
        change(session, {path: [*(there if isinstance(there, list) else []), begin]})

    return await _done(desk, added)


async def drag(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Move a handle of the drawing."""
    from heeltoe.app.case.draft import case_of, fields_in_force
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.handles import moved

    session, name = desk.session, text(asked, "handle")
    to, by = (_numbers(asked.get(key, {})) for key in ("to", "by"))

    def dragged() -> None:
        case = case_of(session)
        if case is not None:
            change(session, moved(case, session.units, name, to, by, fields_in_force(session)), asked.get("step"))

    return await _done(desk, dragged)


async def step(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Take back the last step, or take it again."""
    from heeltoe.app.case.draft import back

    return await _done(desk, lambda: back(desk.session, forward=asked.get("forward") is True))


async def corners(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Say the section by its corners, in the place of its dimensions."""
    from heeltoe.app.case.draft import case_of, fields_of, valued
    from heeltoe.app.case.draft import edit as change
    from heeltoe.app.case.handles import corners_of

    session = desk.session

    def said() -> None:
        case = case_of(session)
        if case is not None and valued(fields_of(session)[0], "section.polygon") is None:
            change(session, {"section": {"polygon": corners_of(case, session.units)}})

    return await _done(desk, said)


async def open_file(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Open a case file that was sent, with the files beside it that were sent, too."""
    from heeltoe.app.case.draft import start
    from heeltoe.case.read import read_fields

    session, called = desk.session, _name(asked.get("called"))
    path = upload_path(session, text(asked, "file"))
    beside = {_name(each): stored for each, stored in _texts(asked.get("beside", {})).items()}
    if path is None or any(upload_path(session, stored) is None for stored in beside.values()):
        raise BadRequestError("there is no such file")

    def opened() -> None:
        try:
            if path.stat().st_size > _LARGEST_FILE:
                raise InputError("case-file-large", called, f"{_LARGEST_FILE // 1000} kB")
            session.sent |= beside
            start(session, read_fields(path))
        except InputError as error:
            # Not by the name that the file has here.
            error.field = called
            said.append(str(error))

    said: list[str] = []
    return {**await _done(desk, opened), "file": " ".join(said)}


async def save(desk: Desk, asked: Asked) -> dict[str, Any]:
    """Return the case file of what is in force, with the meaning of each field beside it."""
    from heeltoe.app.case.draft import fields_in_force
    from heeltoe.case.written import case_text

    def written() -> dict[str, Any]:
        found = fields_in_force(desk.session)
        words = re.findall(r"[a-z0-9]+", str(found.get("title", "")).lower())
        return {"of": "case file", "text": case_text(found), "name": f"{'-'.join(words)[:60] or 'case'}.toml"}

    found: dict[str, Any] = await desk.workers.quick(written)
    return found


async def _done(desk: Desk, do: Callable[[], None]) -> dict[str, Any]:
    """Do something with the case of a tab; where another one is in force then, all its pages hear of it."""
    from heeltoe.app.open_case import state

    session = desk.session

    def done() -> tuple[dict[str, Any], dict[str, Any] | None]:
        before, moved = session.case, session.moved
        do()
        changed = session.case is not before or session.moved != moved
        return _told(session), state(session) if changed else None

    told, changed = await desk.workers.quick(done)
    if changed is not None:
        await desk.tell(changed)
    found: dict[str, Any] = told
    return found


def _told(session: Session) -> dict[str, Any]:
    from heeltoe.app.case.draft import case_of, draft_of, fields_of, valued
    from heeltoe.app.case.drawing import drawing
    from heeltoe.app.case.handles import handles, told
    from heeltoe.app.case.law import law

    given, errors = fields_of(session)
    draft, case = draft_of(session), case_of(session)
    found: dict[str, Any] = {
        "of": "case",
        "fields": given,
        "errors": [
            {"field": each.field, "problem": plain(each.problem), "remedy": plain(each.remedy), "code": each.code}
            for each in errors
        ],
        "corners": valued(given, "section.polygon") is not None,
        "undo": bool(draft.undo),
        "redo": bool(draft.redo),
    }
    if case is not None:
        seen = drawing(case, session.units)
        found["drawing"] = {**seen, "handles": [told(each) for each in handles(case, session.units)]}
    found["law"] = None if case is None else law(case, session.units)
    return found


def _typed(session: Session, changes: Mapping[str, Any]) -> dict[str, Any]:
    from heeltoe.app.case.begin import following
    from heeltoe.app.case.draft import fields_of
    from heeltoe.app.case.fields import field_of
    from heeltoe.app.case.typed import typed

    found = {}
    for path, value in changes.items():
        field = field_of(path)
        # What is no field can be taken away.
        found[path] = typed(value, field, session.units) if field else None
    return following(found, fields_of(session)[0])


def _changes(asked: Asked) -> dict[str, Any]:
    given = asked.get("changes")
    if not isinstance(given, dict) or not 0 < len(given) <= _MOST_CHANGES or not all(map(_is_path, given)):
        raise BadRequestError("changes are values by the paths of fields")
    return given


def _is_path(path: str) -> bool:
    return all(part.strip() == part != "" for part in path.split(".")) and len(path) <= 200


def _numbers(given: object) -> dict[str, float]:
    if not isinstance(given, dict):
        raise BadRequestError("a handle is put to x and z")
    return {axis: number(given, axis) for axis in ("x", "z") if axis in given}


def _texts(given: object) -> dict[str, str]:
    if not isinstance(given, dict) or not all(isinstance(each, str) for each in given.values()):
        raise BadRequestError("files are names by names")
    return given


def _name(given: object) -> str:
    """Return what the sender of a file called it, without any directory."""
    if not isinstance(given, str):
        raise BadRequestError("a file has a name")
    return plain(PurePath(given.replace("\\", "/")).name, _LONGEST_NAME) or "file"


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
