"""The commands that write files to start from."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from heeltoe.base.atomic_files import check_directory, write_text, write_whole
from heeltoe.cli.common import LONGEST_PATH
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import plain


def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the case; NAME.toml is written.")],
    all_: Annotated[bool, typer.Option("--all", help="Show every field, as comments where it is not set.")] = False,
    from_: Annotated[
        Path | None, typer.Option("--from", metavar="OLD.toml", help="Rewrite this case with today's fields.")
    ] = None,
) -> None:
    """Write a case file to start from."""
    from heeltoe.case.template import new_case_text

    if all_ and from_ is not None:
        raise InputError("fields-conflict", "--all", other="--from")
    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    if os.path.lexists(path):
        raise InputError("file-exists", str(path))
    text = new_case_text(path.stem, every_field=all_) if from_ is None else _rewritten(from_, path)
    write_text(path, text)
    written = plain(path, LONGEST_PATH)
    print(f"wrote {written}; run it with: heeltoe run {written}")


def _rewritten(old: Path, path: Path) -> str:
    """Return the text of a case in today's fields; `path` is where it will stand."""
    from heeltoe.case.fields_file import read_fields
    from heeltoe.case.read import read_case
    from heeltoe.case.toml_writer import case_text

    read_case(old)
    if path.parent.resolve() != old.parent.resolve():
        # Motions, meshes and drawings are relative to the case.
        raise InputError("contradiction", "NAME", shown(str(path)), other="--from, a case of another folder")
    return case_text(read_fields(old))


def examples(
    directory: Annotated[
        Path, typer.Argument(metavar="DIR", show_default=False, help="New directory to write into (default: examples).")
    ] = Path("examples"),
    list_: Annotated[bool, typer.Option("--list", help="List them with a line each, and write nothing.")] = False,
) -> None:
    """Write example cases and studies to start from."""
    from heeltoe.case.examples import copy_examples, list_examples

    if list_:
        for name, line in list_examples():
            print(f"{name}\n    {line}")
        return
    if os.path.lexists(directory):
        raise InputError("file-exists", str(directory))
    check_directory(directory, "DIR")
    written = write_whole(copy_examples, directory, (), field="DIR")
    print(f"wrote {len(written)} cases and studies into {plain(directory, LONGEST_PATH)}")
