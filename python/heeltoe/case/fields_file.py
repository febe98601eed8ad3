"""A file of fields, in TOML or JSON: a case, a study, criteria."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

from heeltoe.base.input_files import read_bounded
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
        raise InputError("source-unreadable", name, reason="it is not UTF-8 text", expected="a file in UTF-8") from None
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
