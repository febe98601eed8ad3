"""The files that a case of a tab names: those that it has sent, and names of the catalogue; no other is looked for.

In the case a file has the name that its sender gave it; in the folder of the tab it has one of ours."""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from heeltoe.errors.error import InputError
from heeltoe.motion.records import catalog
from heeltoe.motion.records.catalog import PREFIX

if TYPE_CHECKING:
    from heeltoe.app.sessions import Session

_RECORDS = ("motion.file", "motion.vertical.file", "aftershocks[].file", "aftershocks[].vertical.file")
_MESHES = ("flexible.mesh_above", "flexible.mesh_below", "section.file")
_CRITERIA = ("statics.criteria_file",)
_PLACES = re.compile(r"\[\d+\]")


def unsent(session: Session, fields: dict[str, Any]) -> list[InputError]:
    """Return an error at each field that names a file which this tab has not sent."""
    errors = []
    for path, block, name in named(fields):
        known = _PLACES.sub("[]", path) in _RECORDS and (block[name].startswith(PREFIX) or is_catalogued(block[name]))
        sent = block[name] in session.sent or block[name] in session.sent.values()
        if block[name] and not known and not sent:
            errors.append(InputError("file-not-sent", path, block[name]))
    return errors


def as_sent(session: Session, fields: dict[str, Any]) -> dict[str, Any]:
    """Return the fields with the names that the senders of files gave them."""
    return _renamed(fields, {stored: called for called, stored in session.sent.items()})


def of_this_machine(session: Session, fields: dict[str, Any]) -> dict[str, Any]:
    """Return the fields with the names that files have in the folder of the tab."""
    return _renamed(fields, session.sent)


def _renamed(fields: dict[str, Any], names: dict[str, str]) -> dict[str, Any]:
    if not names:
        return fields
    own = copy.deepcopy(fields)
    for _, block, name in named(own):
        block[name] = names.get(block[name], block[name])
    return own


def named(fields: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any], str]]:
    """Walk the fields that name files: path, block and name in it."""
    for path in (*_RECORDS, *_MESHES, *_CRITERIA):
        *blocks, name = path.split(".")
        for at, block in _blocks(fields, blocks):
            if isinstance(block.get(name), str):
                yield f"{at}.{name}", block, name


def _blocks(here: Any, names: list[str], at: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Walk the blocks at a path, of which a name that ends in ``[]`` is a list, with the path of each."""
    if not isinstance(here, dict):
        return
    if not names:
        yield at, here
        return
    first, *rest = names
    name = first.removesuffix("[]")
    path, content = f"{at}.{name}".removeprefix("."), here.get(name)
    if name == first:
        yield from _blocks(content, rest, path)
    elif isinstance(content, list):
        for place, entry in enumerate(content):
            yield from _blocks(entry, rest, f"{path}[{place}]")


def is_catalogued(name: str) -> bool:
    """Whether a record is found by this name, wherever one is."""
    return name in _catalogue()


@cache
def _catalogue() -> frozenset[str]:
    return frozenset(catalog.names())
