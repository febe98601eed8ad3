"""A case as a folder that goes anywhere: its file, and beside it the files that it names."""

from __future__ import annotations

import copy
import re
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zipfile import ZIP_DEFLATED, ZipFile

from heeltoe.app.case.files import named
from heeltoe.case.toml_writer import case_text

if TYPE_CHECKING:
    from heeltoe.app.sessions import Session

#: What the file of the case is called.
CASE = "case.toml"
#: Files that a tab has sent, by what they are called.
Sent = Mapping[str, Path]
_STRANGE = re.compile(r"[^A-Za-z0-9._-]+")
_LONGEST = 80


def sent_files(session: Session) -> dict[str, Path]:
    """Return the files that a tab has sent, by what they are called."""
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
    """Copy a file under a name that says what it is to people and nothing to a system, and return that."""
    harmless = _STRANGE.sub("-", Path(name).name).lstrip(".-")[-_LONGEST:] or "file"
    place, number = folder / harmless, 1
    while place.exists() or place.name == CASE:
        number += 1
        place = folder / f"{number}-{harmless}"
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
