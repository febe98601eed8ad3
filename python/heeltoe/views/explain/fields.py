"""Fields of a case and of a study, as the models of their files describe them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel, WithJsonSchema
from pydantic.fields import FieldInfo

from heeltoe.case.combinations import rules_of
from heeltoe.case.crack.crack import Crack
from heeltoe.case.distribution import Distribution
from heeltoe.case.field_usage import READERS, readers
from heeltoe.case.fields import field_texts
from heeltoe.case.joints import JOINTS, JOINTS_MEANING, Joints
from heeltoe.case.lists import CRACKS, CRACKS_MEANING
from heeltoe.case.model import Case
from heeltoe.case.paths import constraints, is_list, quantities_of
from heeltoe.case.plausible import PLAUSIBLE
from heeltoe.case.sentences import kinds_in
from heeltoe.case.thesis import THESIS_FIELDS
from heeltoe.study.plan.file import Study
from heeltoe.units.parse import DIMENSIONS
from heeltoe.units.sentences import listed
from heeltoe.views.explain.meaning import Meaning
from heeltoe.views.explain.pages import page_of
from heeltoe.views.words.fields import shown

_COMPARED = {"gt": "more than {}", "ge": "{} or more", "lt": "less than {}", "le": "{} at most"}
_PLAIN = {bool: "true or false", int: "a whole number", float: "a number", str: "a text"}
# Words and units of what is shown, on which no number depends.
_SHOWN = ("title", "units", "project")
_UNKNOWN = "a value of the field that varies"
# Blocks with the fields of another one.
_LIKE = {
    "cracks": "crack",
    "further_cracks": "crack",
    "joints": "crack",
    "aftershocks": "motion",
    "motion.vertical": "motion",
    "motion.cross_valley": "motion",
    "suite.processing": "motion.processing",
    "project.revisions": "project",
    "tailwater": "reservoir",
}
# The kind of a step stands in the name of its block already.
_STEP = re.compile(r"\[[a-z-]+\]\.step$")


def fields_of_a_case() -> Iterator[Meaning]:
    """Walk all fields of a case, each block before its fields; those that repeat another block are marked hidden."""
    fields = list(_all_fields())
    names = {meaning.name for meaning in fields}
    for meaning in fields:
        name = meaning.name
        twins = [
            (block, f"{_LIKE[block]}{name[len(block) :].removeprefix('[]')}") for block in _LIKE if _in(name, block)
        ]
        repeated = any(twin in names and name != block for block, twin in twins)
        hidden = repeated or name in THESIS_FIELDS or _STEP.search(name) is not None
        yield replace(meaning, hidden=hidden, like=_LIKE.get(name, ""))


def _in(name: str, block: str) -> bool:
    return name == block or name.startswith((f"{block}.", f"{block}["))


def _all_fields() -> Iterator[Meaning]:
    for meaning in _walk(Case, "", "field of a case"):
        if meaning.name == "further_cracks":
            # A file may list all cracks in place of both blocks.
            yield from _block(CRACKS, f"{CRACKS}[]", Crack, CRACKS_MEANING, meaning.kind)
            yield from _block(JOINTS, JOINTS, Joints, JOINTS_MEANING, meaning.kind)
        yield meaning


def fields_of_a_study() -> Iterator[Meaning]:
    """Walk all fields of a study file; those of distributions stand under ``vary.*``."""
    yield from _walk(Study, "", "field of a study")
    yield from _walk(Distribution, "vary.*.", "field of a study")


def _walk(model: type[BaseModel], above: str, kind: str) -> Iterator[Meaning]:
    texts = field_texts(model)
    for name, field in model.model_fields.items():
        path, meaning = above + (field.alias or name), _one_line(texts.get(name))
        # What varies may be a list or a distribution, which is told once for all.
        blocks = [] if path == "vary" or path.endswith(".values") else list(kinds_in(field.annotation))
        if not blocks:
            yield _leaf(path, field, meaning, kind)
        elif len(blocks) == 1:
            place = f"{path}[]" if is_list(field) else path
            yield from _block(path, place, blocks[0], meaning, kind)
        else:
            # A list of blocks of several kinds.
            places = [f"{path}[{get_args(block.model_fields['step'].annotation)[0]}]" for block in blocks]
            yield _named(path, meaning, "a list of blocks", kind, tuple(places))
            for place, block in zip(places, blocks, strict=True):
                yield from _block(place, place, block, _one_line(block.__doc__), kind)


def _block(path: str, place: str, block: type[BaseModel], meaning: str, kind: str) -> Iterator[Meaning]:
    inner = list(_walk(block, f"{place}.", kind))
    parts = tuple(field.name for field in inner if not re.search(r"[.[]", field.name[len(place) + 1 :]))
    yield _named(path, meaning, "a list of blocks" if place.endswith("[]") else "a block", kind, parts)
    yield from inner


def _named(path: str, meaning: str, holds: str, kind: str, parts: tuple[str, ...]) -> Meaning:
    return Meaning(
        path,
        kind,
        meaning,
        holds,
        found_in=_place(path, kind),
        not_with=_not_with(path, kind),
        page=page_of(path, kind),
        parts=parts,
    )


def _leaf(path: str, field: FieldInfo, meaning: str, kind: str) -> Meaning:
    quantities = quantities_of(field)
    unit = DIMENSIONS[quantities[0]].unit if len(quantities) == 1 else ""
    default = "" if field.is_required() else _shown(field.get_default(call_default_factory=True), unit)
    needed = "it must be said" if field.is_required() else ""
    return Meaning(
        path,
        kind,
        meaning,
        _holds(field, quantities),
        needed or default,
        "; ".join(filter(None, (_limits(field, quantities), _plausible(path) if kind == "field of a case" else ""))),
        _place(path, kind),
        _not_with(path, kind),
        page_of(path, kind),
    )


def _one_line(text: str | None) -> str:
    return " ".join((text or "").split())


def _place(path: str, kind: str) -> str:
    if kind != "field of a case":
        return ""
    if path.partition(".")[0] in _SHOWN:
        return "what is shown alone"
    models = readers(path.replace("[]", "").partition("[")[0] if "[" in path else path)
    if not models:
        return "suites of records alone"
    names = [name for model, name in READERS.items() if model in models]
    return "all models" if len(names) == len(READERS) else listed(names)


def _not_with(path: str, kind: str) -> str:
    """Return what a field cannot be combined with, and what does not support it, as the table of combinations says."""
    if kind != "field of a case":
        return ""
    plain = re.sub(r"\[.*?\]", "", path)
    return "; ".join(dict.fromkeys(rule.without(plain) for rule in rules_of(plain)))


def _choices(annotation: Any) -> tuple[str, ...]:
    if get_origin(annotation) is Literal:
        return tuple(map(str, get_args(annotation)))
    return next((choices for argument in get_args(annotation) if (choices := _choices(argument))), ())


def _holds(field: FieldInfo, names: list[str]) -> str:
    listed = is_list(field)
    choices = _choices(field.annotation)
    if choices:
        return f"{'one or several' if listed else 'one'} of {', '.join(choices)}"
    quantities = [DIMENSIONS[name] for name in names]
    schemas = [what.json_schema or {} for what in field.metadata if isinstance(what, WithJsonSchema)]
    for schema in schemas:
        if quantities and "array" in schema.get("type", ""):
            return f'{quantities[0].kind}, alone or one for each side, for example "{schema["examples"][0]}"'
    if listed and len(quantities) > 1:
        return f"rows of {' and '.join(quantity.kind for quantity in quantities)}"
    if quantities:
        example = quantities[0].example
        written = f', for example "{example}"' if isinstance(example, str) else ""
        return f"{'a list, each ' if listed else ''}{quantities[0].kind}{written}"
    for schema in schemas:
        if schema.get("type") == ["boolean", "string"]:
            return f"true or false, or a text, for example {' or '.join(map(json.dumps, schema['examples']))}"
    kinds = [kind for kind in _plain(field.annotation) if kind in _PLAIN]
    if len(set(kinds)) > 1:
        return _UNKNOWN
    return f"{'a list, each ' if listed else ''}{_PLAIN[kinds[0]] if kinds else _UNKNOWN}"


def _plain(annotation: Any) -> Iterator[Any]:
    yield annotation
    for argument in get_args(annotation):
        yield from _plain(argument)


def _limits(field: FieldInfo, quantities: list[str]) -> str:
    if len(quantities) > 1 or get_origin(field.annotation) is tuple:
        return ""  # of rows each cell has its own
    unit = DIMENSIONS[quantities[0]].unit if quantities else ""
    limits = []
    for constraint in constraints(field):
        for name, words in _COMPARED.items():
            # Its class is asked: a type would look for the name in all that it is made of.
            if hasattr(type(constraint), name):
                value = float(getattr(constraint, name))
                number = shown(f"{value:.10g} {unit}") if unit else f"{value:.10g}"
                limits.append(words.format(number))
    return ", ".join(dict.fromkeys(limits))


def _plausible(path: str) -> str:
    """Return in which range a field is seldom a mistake."""
    if path not in PLAUSIBLE:
        return ""
    rule = PLAUSIBLE[path]
    low, high = (shown(f"{end:.10g} {rule.unit}") if rule.unit else f"{end:g}" for end in (rule.low, rule.high))
    return f"warned of outside {low} to {high}" if math.isfinite(rule.high) else f"warned of below {low}"


def _shown(value: object, unit: str) -> str:
    if value is None or value in ("", (), {}) or isinstance(value, BaseModel):
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple):
        return ", ".join(map(str, value))
    number = f"{value:.10g}" if isinstance(value, float) else str(value)
    return shown(f"{number} {unit}") if unit and isinstance(value, float) else number
