"""Read a case: a file in TOML or JSON, or a dictionary, with changes of single fields, to a
:class:`Case` that is sound.

The models are in :mod:`heeltoe.case.model`, what changes do in :mod:`heeltoe.case.changes`, the way from complaints to
one plain sentence in :mod:`heeltoe.case.sentences`."""

from __future__ import annotations

import copy
import json
import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from heeltoe.base.input_files import read_bounded
from heeltoe.case.changes import Changes, apply
from heeltoe.case.joints import JOINTS, JOINTS_MEANING, Joints
from heeltoe.case.lists import CRACKS, CRACKS_MEANING, motions_as_blocks
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError, shown
from heeltoe.units.parse import misgrouped

# A case is some kilobytes; what never ends, as /dev/zero, is none.
_LARGEST = 10_000_000
# The time to read a dotted key of TOML grows with the square of its parts; no field is so deep.
_DEEPEST = 50
_OF_KEYS = re.compile(
    r'''"""(?:\\[\s\S]|[^\\])*?"""|\'\'\'[\s\S]*?\'\'\'|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|\#[^\n]*|[][{}=,\n.]'''
)


_A_CASE = "a case file; `heeltoe new NAME` writes one"

#: Source of a case: a file, or its fields.
Source = str | os.PathLike[str] | Mapping[str, object]


def read_case(source: Source, changes: Changes = ()) -> Case:
    """Read and check a case.

    Parameters
    ----------
    source
        Path of a TOML or JSON file (told apart by what is in it), or the fields themselves.
    changes
        What wins over `source`: ``"crack.friction=1.0"`` or ``"reservoir.depth=95m"``, a list of such texts, or a
        dictionary of the same paths, ``{"crack.friction": 1.0}``; see :meth:`heeltoe.Case.with_`.

    Returns
    -------
    Case
        A case in which crack, water and section agree.

    Raises
    ------
    InputError
        The first thing that is wrong, with the others.
    """
    if isinstance(source, Mapping):
        fields, directory = copy.deepcopy(dict(source)), Path()
    elif isinstance(source, str | os.PathLike):
        path = Path(source)
        fields, directory = read_fields(path), path.parent
        if "section" not in fields and not fields.keys().isdisjoint(("case", "cases")):
            raise InputError("study-no-case", str(path))
    else:
        raise InputError("case-source", "source", kind=type(source).__name__)
    # Changes by path find the motions as blocks; cracks stay as they are written.
    fields = motions_as_blocks(fields)
    return Case.of(fields, directory, apply(fields, changes, directory))


def case_schema() -> dict[str, object]:
    """Return the JSON schema of a case: its cracks stand in one list, in the blocks `crack` and `further_cracks`, or as
    `joints`."""
    schema = Case.model_json_schema()
    cracks = {"type": "array", "minItems": 1, "items": {"$ref": "#/$defs/Crack"}, "description": CRACKS_MEANING}
    joints = Joints.model_json_schema()
    schema["$defs"] |= joints.pop("$defs")
    joints |= {"description": JOINTS_MEANING}
    properties: dict[str, Any] = {}
    for name, field in schema["properties"].items():
        properties |= {CRACKS: cracks, JOINTS: joints, name: field} if name == "crack" else {name: field}
    required = [name for name in schema["required"] if name != "crack"]
    forms = [{"required": [name]} for name in (CRACKS, "crack", JOINTS)]
    return schema | {"properties": properties, "required": required, "oneOf": forms}


def read_fields(path: Path, expected: str = _A_CASE) -> dict[str, object]:
    """Return what stands in a file in TOML or JSON; `expected` is what it should be.

    Raises
    ------
    InputError
        Where it cannot be read.
    """
    name = str(path)
    try:
        content = read_bounded(path, _LARGEST)
        if len(content) > _LARGEST:
            raise InputError("too-large", name, f"{_LARGEST // 10**6} MB", expected="a case file")
        text = content.decode("utf-8-sig")  # editors on Windows begin a file with a byte order mark
    except FileNotFoundError:
        raise InputError("source-missing", name, expected=expected) from None
    except UnicodeDecodeError:
        raise InputError("case-file-encoding", name) from None
    except (OSError, ValueError) as error:
        raise InputError(
            "source-unreadable",
            name,
            reason=getattr(error, "strerror", None) or error,
            expected="a file in TOML or JSON",
        ) from None
    kind = "JSON" if text.lstrip().startswith("{") else "TOML"
    try:
        fields: dict[str, Any] = json.loads(text, object_pairs_hook=_once) if kind == "JSON" else _toml(text)
        if "\\" in text and _has_nul(fields):
            raise ValueError("a text holds the character U+0000")
    except (ValueError, RecursionError) as error:
        raise InputError("case-file-syntax", name, kind=kind, reason=error) from None
    return fields


def _has_nul(value: Any) -> bool:
    """Whether a text, or a name, holds a NUL, at which other programs end it."""
    if isinstance(value, dict):
        return any(map(_has_nul, (*value, *value.values())))
    if isinstance(value, list):
        return any(map(_has_nul, value))
    return isinstance(value, str) and "\0" in value


def _toml(text: str) -> dict[str, object]:
    if text.count(".") >= _DEEPEST and any(line.count(".") >= _DEEPEST for line in text.splitlines()):
        parts = 1
        for token in _OF_KEYS.finditer(text):
            if token[0] == ".":
                parts += 1
            elif token[0] in "[]{}=,\n":
                parts = 1
            if parts > _DEEPEST:
                line = text.count("\n", 0, token.start()) + 1
                raise ValueError(f"a key of more than {_DEEPEST} parts (at line {line})")
    wrong = misgrouped(text)
    if wrong is not None:
        raise ValueError(f"{wrong} is no number: an underscore parts thousands, as in 1_000")
    return tomllib.loads(text)


def _once(pairs: list[tuple[str, Any]]) -> dict[str, object]:
    """Return a block of JSON; of a key that stands there twice JSON itself would take the last, TOML takes none."""
    fields: dict[str, Any] = {}
    for name, value in pairs:
        if name in fields:
            raise ValueError(f"{shown(name)} stands twice in one block")
        fields[name] = value
    return fields
