"""A case file in TOML from the fields of a case, each with its meaning beside it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel

from heeltoe.case.fields import field_texts
from heeltoe.case.lists import CRACKS, as_one_list
from heeltoe.case.model import Case
from heeltoe.case.sentences import block_of

_HEAD = "# A case for heeltoe: one dam, one crack, one earthquake."
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_WIDTH = 120
# From here on comments begin, where the line leaves room.
_COLUMN = 34


def case_text(fields: Mapping[str, Any], *, listed: bool = True) -> str:
    """Return a case file in TOML.

    Parameters
    ----------
    fields
        As a file has them; they need not be those of a sound case. What is None is left out.
    listed
        Whether to write all cracks as the list `[[cracks]]`, from the crest down.
    """
    return toml_text(as_one_list(fields) if listed else fields, Case, _HEAD)


def toml_text(fields: Mapping[str, Any], model: type[BaseModel], head: str) -> str:
    """Return fields as a file in TOML below a head, each with the text of a model beside it."""
    return "\n".join([head, "", *_block(fields, model, "")]).rstrip("\n") + "\n"


def _block(fields: Mapping[str, Any], model: type[BaseModel] | None, path: str) -> Iterator[str]:
    """Walk the lines of a block: its own values, then the blocks in it, in the order of the model."""
    known = list(model.model_fields) if model else []
    places = {name: place for place, name in enumerate(known)} | (
        {CRACKS: known.index("crack")} if model is Case else {}
    )
    names = sorted(map(str, fields), key=lambda name: places.get(name, len(known)))
    values = {name: fields[name] for name in names if fields[name] is not None}
    blocks = {name for name, value in values.items() if isinstance(value, Mapping) or _is_list(model, name, value)}
    for name, value in values.items():
        if name not in blocks:
            yield from _line(name, value, _meaning(model, name))
    for name, value in values.items():
        if name in blocks:
            here = f"{path}.{_key(name)}" if path else _key(name)
            field = model.model_fields.get("crack" if name == CRACKS else name) if model else None
            kind = block_of(field.annotation) if field else None
            yield from (
                _cracks(value, kind, here)
                if isinstance(value, list)
                else _table(value, kind, here, _meaning(model, name))
            )


def _is_list(model: type[BaseModel] | None, name: str, value: Any) -> bool:
    """Whether a value is the list of cracks of a case."""
    blocks = isinstance(value, list) and bool(value) and all(isinstance(item, Mapping) for item in value)
    return model is Case and name == CRACKS and blocks


def _table(value: Mapping[str, object], kind: type[BaseModel] | None, path: str, meaning: str) -> Iterator[str]:
    yield ""
    yield _with_comment(f"[{path}]", meaning)
    yield from _block(value, kind, path)


def _cracks(items: Sequence[Mapping[str, object]], kind: type[BaseModel] | None, path: str) -> Iterator[str]:
    for place, item in enumerate(items, 1):
        yield ""
        yield _with_comment(f"[[{path}]]", f"crack {place} of {len(items)}, from the crest down")
        yield from _block(item, kind, path)


def _line(name: str, value: Any, meaning: str) -> Iterator[str]:
    """Walk the lines of a value: lists of blocks or of pairs have a line for each."""
    if isinstance(value, Sequence) and not isinstance(value, str) and any(map(_long, value)):
        yield _with_comment(f"{_key(name)} = [", meaning)
        yield from (f"  {_value(item)}," for item in value)
        yield "]"
    else:
        yield _with_comment(f"{_key(name)} = {_value(value)}", meaning)


def _long(value: object) -> bool:
    return isinstance(value, Mapping | list | tuple)


def _meaning(model: type[BaseModel] | None, name: str) -> str:
    """Return the choices of a field, or the first sentence that says what it means."""
    field = model.model_fields.get(name) if model else None
    if model is None or field is None:
        return ""
    choices = get_args(field.annotation) if get_origin(field.annotation) is Literal else ()
    description = " ".join(field_texts(model).get(name, "").split())
    return f"one of {', '.join(choices)}" if choices else re.split(r"(?<=[a-z)])[.;] ", description)[0].rstrip(".")


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
        inner = ", ".join(f"{_key(str(name))} = {_value(item)}" for name, item in value.items() if item is not None)
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_value(item) for item in value if item is not None)}]"
    return repr(value) if isinstance(value, int | float) else _text(str(value))


def _text(text: str) -> str:
    # Escapes of JSON are those of TOML, but for DEL, and halves of letters, which no file can hold.
    whole = text.encode("utf-8", "replace").decode("utf-8")
    return json.dumps(whole, ensure_ascii=False).replace("\x7f", "\\u007f")
