"""The case of a tab as it was typed: its fields, sound or not, what is wrong with them, and the way back.

There is one truth: the draft, with what the sliders of the answer change. While anything in it is wrong the last sound
case stays in force."""

from __future__ import annotations

import copy
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from heeltoe.app.case.files import as_sent, of_this_machine, unsent
from heeltoe.app.state import Draft
from heeltoe.base.payload import Json
from heeltoe.case.changes import apply
from heeltoe.case.lists import as_blocks
from heeltoe.case.model import problems
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import harmless
from heeltoe.units.parse import Acceleration, InSI

if TYPE_CHECKING:
    from heeltoe.app.sessions import Session
    from heeltoe.case.model import Case

#: Letters that a case may have as JSON, and edits that can be taken back.
LARGEST, MOST_STEPS = 200_000, 50


def draft_of(session: Session) -> Draft:
    """Return the draft of a tab; where its case was changed elsewhere, with the differences."""
    draft = session.draft
    if draft is None:
        draft = session.draft = Draft(_written_fields(session, session.case), case=session.case)
    elif draft.case is not session.case:
        before, now = _written_fields(session, draft.case), _written_fields(session, session.case)
        fields = {name: value for name, value in draft.fields.items() if name in now or name not in before}
        fields |= {name: value for name, value in now.items() if value != before.get(name)}
        _remember(draft, None)
        draft.fields, draft.case = fields, session.case
        draft.errors = _read(session, fields)[1]
    return draft


def _written_fields(session: Session, case: Case | None) -> Json:
    return as_sent(session, case.model_dump(mode="json", exclude_unset=True)) if case else {}


def fields_of(session: Session) -> tuple[dict[str, object], list[InputError]]:
    """Return the fields of a tab with the changes of its sliders, and their errors."""
    draft = draft_of(session)
    if not session.changes:
        return draft.fields, draft.errors
    fields = _moved(draft.fields, session.changes)
    return fields, _read(session, fields)[1]


def case_of(session: Session) -> Case | None:
    """Return the case in force, with the changes of the sliders that it accepts."""
    case = session.case
    if case is None or not session.changes:
        return case
    try:
        return case.with_numbers(session.changes)
    except InputError:
        return case


def fields_in_force(session: Session) -> dict[str, Any]:
    """Return the fields of the case in force, those that were typed where they are it."""
    fields, errors = fields_of(session)
    if not errors:
        return fields
    return _written_fields(session, case_of(session))


def start(session: Session, fields: Mapping[str, Any]) -> None:
    """Take the fields of another case in the place of the one there is; the way back leads to that.

    Raises
    ------
    InputError
        Where there are too many of them.
    """
    plain = _plain(as_blocks(fields))
    _settle(session)
    draft = session.draft
    if draft is not None:
        _remember(draft, None)
        draft.fields = plain
    else:
        draft = session.draft = Draft(plain)
    _check(session, draft)


def edit(session: Session, changes: Mapping[str, object], step: object = None) -> None:
    """Change fields by their paths; None takes back what the case says, and a block takes the place of the one there.
    All changes of the case of a tab come here.

    Raises
    ------
    InputError
        Where the case would become too large; it stays as it was.
    """
    _settle(session)
    draft = draft_of(session)
    fields = copy.deepcopy(draft.fields)
    for path, value in changes.items():
        _set(fields, path, value)
    fields = _plain(fields)
    if fields == draft.fields:
        return
    _remember(draft, step)
    draft.fields = fields
    _check(session, draft)


def back(session: Session, *, forward: bool = False) -> None:
    """Take back the last step, or take it again."""
    _settle(session)
    draft = draft_of(session)
    past, future = (draft.redo, draft.undo) if forward else (draft.undo, draft.redo)
    if past:
        future.append(draft.fields)
        draft.fields, draft.step = past.pop(), None
        _check(session, draft)


def _settle(session: Session) -> None:
    """Write into the fields what the sliders change; they stand where the case is from now on."""
    if session.case is None:
        return
    draft, changes = draft_of(session), session.changes
    session.changes, session.moved = {}, frozenset()
    fields = _moved(draft.fields, changes) if changes else draft.fields
    if fields == draft.fields:
        return
    _remember(draft, None)
    session.changes = changes
    session.case = draft.case = case_of(session)
    session.changes = {}
    draft.fields = fields
    _check(session, draft)


def _moved(fields: dict[str, object], changes: Mapping[str, object]) -> Json:
    moved = copy.deepcopy(fields)
    for path, value in changes.items():
        _set(moved, path, str(value) if isinstance(value, InSI | Acceleration) else value)
    return moved


def _remember(draft: Draft, step: object) -> None:
    if step is None or step != draft.step:
        draft.undo.append(draft.fields)
        del draft.undo[:-MOST_STEPS]
    draft.redo.clear()
    draft.step = step


def _check(session: Session, draft: Draft) -> None:
    """Read the fields; where they are sound their case is in force."""
    case, draft.errors = _read(session, draft.fields)
    if case is not None and case != session.case:
        if "units" in case.model_fields_set and (session.case is None or case.units != session.case.units):
            session.units = case.units
        session.case, session.example = case, ""
    draft.case = session.case


def _read(session: Session, fields: dict[str, object]) -> tuple[Case | None, list[InputError]]:
    foreign = unsent(session, fields)
    if foreign:
        # No one looks for these.
        return None, foreign + problems(fields, None)[1]
    case, errors = problems(of_this_machine(session, fields), session.folder)
    return (None if case is None else case.based_in(session.folder)), errors


def _set(fields: dict[str, Any], path: str, value: Any) -> None:
    """Set one field, whatever stands where its block should be."""
    *blocks, name = path.split(".")
    if value is not None:
        block = fields
        for part in blocks:
            if not isinstance(block.get(part), dict):
                block[part] = {}
            block = block[part]
        if isinstance(value, Mapping):
            block[name] = dict(value)
        else:
            apply(fields, {path: value})
        return
    here = valued(fields, ".".join(blocks)) if blocks else fields
    if isinstance(here, dict):
        here.pop(name, None)


def valued(fields: dict[str, object], path: str) -> Any:
    """Return what stands at a path; None where nothing does."""
    here: Any = fields
    for part in path.split("."):
        here = here.get(part) if isinstance(here, dict) else None
    return here


def _plain(fields: Mapping[str, object]) -> Json:
    """Return fields of which JSON can say each: dates of TOML and numbers beyond all numbers become texts.

    Raises
    ------
    InputError
        Where there are too many, or they stand too deep.
    """
    try:
        text = json.dumps(_sayable(fields), default=str)
    except (RecursionError, ValueError):
        text = ""
    if not text or len(text) > LARGEST:
        raise InputError("too-large", "case", f"{LARGEST // 1000} kB", expected="a case file")
    plain: dict[str, Any] = json.loads(text)
    return plain


def _sayable(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {harmless(str(name)): _sayable(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_sayable(entry) for entry in value]
    if isinstance(value, float) and not abs(value) < float("inf"):
        return str(value)
    return harmless(value) if isinstance(value, str) else value
