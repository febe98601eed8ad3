"""The files that a case of a tab names: those that it has sent, and names of the catalogue; no other is looked for.

In the case a file has the name that its sender gave it; in the folder of the tab it has one of ours. A case leaves the
app as a folder that goes anywhere: its file, and beside it the files that it names."""

from __future__ import annotations

import copy
import re
import shutil
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zipfile import ZIP_DEFLATED, ZipFile

from heeltoe.base.payload import Json
from heeltoe.case.toml_writer import case_text
from heeltoe.errors.error import InputError
from heeltoe.motion.records import catalog
from heeltoe.motion.records.catalog import PREFIX

if TYPE_CHECKING:
    from heeltoe.app.sessions import Session

_RECORDS = tuple(
    f"{motion}{component}.file"
    for motion in ("motion", "aftershocks[]")
    for component in ("", ".vertical", ".cross_valley")
)
_MESHES = ("flexible.mesh_above", "flexible.mesh_below", "section.file")
_TABLES = ("statics.criteria_file", "crack.fit", "cracks[].fit")
_PLACES = re.compile(r"\[\d+\]")
#: What the file of the case is called.
CASE = "case.toml"
#: Files that a tab has sent, by what they are called.
Sent = Mapping[str, Path]
_STRANGE = re.compile(r"[^A-Za-z0-9._-]+")
_LONGEST = 80


def unsent(session: Session, fields: dict[str, Any]) -> list[InputError]:
    """Return an error at each field that names a file which this tab has not sent."""
    errors = []
    for path, block, name in named(fields):
        known = _PLACES.sub("[]", path) in _RECORDS and (block[name].startswith(PREFIX) or is_catalogued(block[name]))
        sent = block[name] in session.sent or block[name] in session.sent.values()
        if block[name] and not known and not sent:
            errors.append(InputError("file-not-sent", path, block[name]))
    return errors


def as_sent(session: Session, fields: dict[str, object]) -> Json:
    """Return the fields with the names that the senders of files gave them."""
    return _renamed(fields, {stored: called for called, stored in session.sent.items()})


def of_this_machine(session: Session, fields: dict[str, object]) -> Json:
    """Return the fields with the names that files have in the folder of the tab."""
    return _renamed(fields, session.sent)


def _renamed(fields: dict[str, Any], names: dict[str, str]) -> Json:
    if not names:
        return fields
    own = copy.deepcopy(fields)
    for _, block, name in named(own):
        block[name] = names.get(block[name], block[name])
    return own


def named(fields: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any], str]]:
    """Walk the fields that name files: path, block and name in it."""
    for path in (*_RECORDS, *_MESHES, *_TABLES):
        *blocks, name = path.split(".")
        for at, block in _blocks(fields, blocks):
            if isinstance(block.get(name), str):
                yield f"{at}.{name}", block, name


def _blocks(here: Any, names: list[str], at: str = "") -> Iterator[tuple[str, dict[str, object]]]:
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


def sent_files(session: Session) -> dict[str, Path]:
    """Return the files that a tab has sent, by name."""
    return {name: session.folder / stored for name, stored in session.sent.items()}


def lay_out(fields: Mapping[str, Any], sent: Sent, folder: Path, *, listed: bool = True) -> None:
    """Write a case, given by its fields, into a folder, and beside it those of its files that were sent; its cracks as
    one list, or as they are where a study has paths of them."""
    folder.mkdir(parents=True, exist_ok=True)
    own = copy.deepcopy(dict(fields))
    for _, block, name in named(own):
        if block[name] in sent:
            block[name] = copied(sent[block[name]], block[name], folder)
    (folder / CASE).write_text(case_text(own, listed=listed), encoding="utf-8")


def copied(path: Path, name: str, folder: Path) -> str:
    """Give a file a second name, which says what it is to people and nothing to a system, and return that."""
    harmless = _STRANGE.sub("-", Path(name).name).lstrip(".-")[-_LONGEST:] or "file"
    place, number = folder / harmless, 1
    while place.exists() or place.name == CASE:
        number += 1
        place = folder / f"{number}-{harmless}"
    try:
        # Nothing changes such a file: a second name of it takes no room.
        place.hardlink_to(path)
    except OSError:
        shutil.copyfile(path, place)
    return place.name


def zipped(folder: Path, path: Path, *, without: tuple[str, ...] = ()) -> Path:
    """Write all files of a folder into one, but those that have one of these names or are hidden with their folder."""
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        for member in sorted(folder.rglob("*")):
            inner = member.relative_to(folder)
            hidden = any(part.startswith(".") for part in inner.parts[:-1])
            if member.is_file() and member != path and member.name not in without and not hidden:
                archive.write(member, f"{folder.name}/{inner.as_posix()}")
    return path
