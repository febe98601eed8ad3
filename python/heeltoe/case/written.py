"""A case file in TOML from the fields of a case, each with its meaning beside it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel

from heeltoe.case.model import Case
from heeltoe.case.sentences import block_of

_HEAD = "# A case for heeltoe: one dam, one crack, one earthquake."
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_WIDTH = 120
# From here on comments begin, where the line leaves room.
_COLUMN = 34


def case_text(fields: Mapping[str, Any]) -> str:
    """Return a case file in TOML.

    Parameters
    ----------
    fields
        As a file has them; they need not be those of a sound case. What is None is left out.
    """
    return toml_text(fields, Case, _HEAD)


def toml_text(fields: Mapping[str, Any], model: type[BaseModel], head: str) -> str:
    """Return fields as a file in TOML below a head, each with what a model says of it."""
    return "\n".join([head, "", *_block(fields, model, "")]).rstrip("\n") + "\n"


def _block(fields: Mapping[str, Any], model: type[BaseModel] | None, path: str) -> Iterator[str]:
    """Walk the lines of a block: its own values, then the blocks in it, in the order of the model."""
    known = list(model.model_fields) if model else []
    names = sorted((str(name) for name in fields), key=lambda name: known.index(name) if name in known else len(known))
    given = {name: fields[name] for name in names if fields[name] is not None}
    for name, value in given.items():
        if not isinstance(value, Mapping):
            yield from _line(name, value, _meaning(model, name))
    for name, value in given.items():
        if isinstance(value, Mapping):
            here = f"{path}.{_key(name)}" if path else _key(name)
            field = model.model_fields.get(name) if model else None
            yield ""
            yield _with_comment(f"[{here}]", _meaning(model, name))
            yield from _block(value, block_of(field.annotation) if field else None, here)


def _line(name: str, value: Any, meaning: str) -> Iterator[str]:
    """Walk the lines of a value: lists of blocks or of pairs have a line for each."""
    if isinstance(value, Sequence) and not isinstance(value, str) and any(map(_long, value)):
        yield _with_comment(f"{_key(name)} = [", meaning)
        yield from (f"  {_value(each)}," for each in value)
        yield "]"
    else:
        yield _with_comment(f"{_key(name)} = {_value(value)}", meaning)


def _long(value: object) -> bool:
    return isinstance(value, Mapping | list | tuple)


def _meaning(model: type[BaseModel] | None, name: str) -> str:
    """Return the choices of a field, or the first sentence that says what it means."""
    field = model.model_fields.get(name) if model else None
    if field is None:
        return ""
    choices = get_args(field.annotation) if get_origin(field.annotation) is Literal else ()
    said = " ".join((field.description or "").split())
    return f"one of {', '.join(choices)}" if choices else re.split(r"(?<=[a-z)])[.;] ", said)[0].rstrip(".")


def _with_comment(line: str, meaning: str) -> str:
    if not meaning:
        return line
    beside = f"{line:{_COLUMN}} # {meaning}"
    return beside if len(beside) <= _WIDTH else f"# {meaning}\n{line}"


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else _text(name)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        inner = ", ".join(f"{_key(str(name))} = {_value(each)}" for name, each in value.items() if each is not None)
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_value(each) for each in value if each is not None)}]"
    return repr(value) if isinstance(value, int | float) else _text(str(value))


def _text(text: str) -> str:
    # Escapes of JSON are those of TOML, but for DEL, and halves of letters, which no file can hold.
    whole = text.encode("utf-8", "replace").decode("utf-8")
    return json.dumps(whole, ensure_ascii=False).replace("\x7f", "\\u007f")
