"""Complaints of pydantic about a case as one :class:`heeltoe.errors.InputError`.

Checks of our own raise :class:`InputError` as everywhere else; :func:`collected` hands it through pydantic,
which gathers all problems of a case, and :func:`first_error` takes it out again, with the full path of the
field."""

from __future__ import annotations

import difflib
import functools
import types
import typing
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache

from pydantic import BaseModel, ValidationError, WithJsonSchema
from pydantic_core import ErrorDetails, PydanticCustomError

from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import harmless
from heeltoe.units.parse import InSI, bound_beside

P = typing.ParamSpec("P")
R = typing.TypeVar("R")
M = typing.TypeVar("M", bound=BaseModel)

# No one reads more problems at a time, and each takes a search for the name that was meant.
_MOST = 100
_BOUNDS = {"gt": "above", "ge": "of at least", "lt": "below", "le": "of at most"}
# How pydantic calls the words of a field that holds one of them or a block.
_WORDS = "literal["
# Types that pydantic names in its error codes, as people call them.
_EXPECTED = {
    "bool": "true or false",
    "int": "a whole number",
    "string": "a text in quotes",
    "string_too_short": "a text that is not empty",
    "tuple": "a list",
    "model": "a block of fields",
}
# Which of the types that a field may have pydantic speaks of.
_TYPES = {"str", "int", "float", "bool"}


def collected(check: Callable[P, R]) -> Callable[P, R]:
    """Let a pydantic validator raise :class:`InputError`, its field relative to the block that is checked."""

    @functools.wraps(check)
    def inner(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return check(*args, **kwargs)
        except InputError as error:
            raise handed_on(error) from None

    return inner


def handed_on(error: InputError, others: Sequence[InputError] = ()) -> PydanticCustomError:
    # Pydantic can hand on no halves of letters.
    context = {"text": harmless(f"{error.problem}; {error.remedy}"), "error": error, "others": others}
    return PydanticCustomError("input_error", "{text}", context)


def gathered(check: Callable[[M], Iterator[InputError]]) -> Callable[[M], M]:
    """Make a validator of a block from a walk over its errors, with fields relative to it."""

    def inner(block: M) -> M:
        wrong = list(check(block))
        if wrong:
            raise handed_on(wrong[0], wrong[1:])
        return block

    return inner


def first_error(complaint: ValidationError, model: type[BaseModel]) -> InputError:
    """Return the first problem, with the others.

    Parameters
    ----------
    complaint
        What pydantic gathered.
    model
        The model of the whole case, for the names it knows.

    Returns
    -------
    InputError
        A field that does not exist goes first, since a slip of the pen makes the field that was meant look
        missing.
    """
    error, *others = all_errors(complaint, model)
    return error.with_others(others)


def all_errors(complaint: ValidationError, model: type[BaseModel]) -> list[InputError]:
    """Return all problems that pydantic gathered, fields that do not exist first; see :func:`first_error`.

    Of a field that may be of several types there is one problem, and none of a list for what is wrong inside it.
    """
    details = _of_what_was_meant(complaint.errors(include_url=False))
    details.sort(key=lambda detail: detail["type"] != "extra_forbidden")
    wrong: dict[str, InputError] = {}
    for detail in details[:_MOST]:
        for error in _all_translated(detail, model):
            wrong.setdefault(error.field, error)
    errors = [
        error
        for path, error in wrong.items()
        if error.code != "not-usable" or not any(path and other.startswith(f"{path}[") for other in wrong)
    ]
    more = len(details) - _MOST
    return [*errors, InputError("problems-more", "the file", f"{more:,}")] if more > 0 else errors


def _of_what_was_meant(details: list[ErrorDetails]) -> list[ErrorDetails]:
    """Return the complaints without those of the other kind where a field holds a block or a word: an unknown word is
    no block, and a block is no word."""
    words = {detail["loc"][:-1] for detail in details if _is_word(detail) and isinstance(detail["input"], str)}
    return [detail for detail in details if (detail["loc"][:-1] in words) == _is_word(detail)]


def _is_word(detail: ErrorDetails) -> bool:
    """Whether a complaint is that of a field that holds a block or one of a few words, of its words."""
    return str(detail["loc"][-1]).startswith(_WORDS) if detail["loc"] else False


def _all_translated(detail: ErrorDetails, model: type[BaseModel]) -> list[InputError]:
    """Return what one complaint says, and what a check of ours has found with it."""
    first = _translated(detail, model)
    path = _path(detail["loc"], model)
    others = detail.get("ctx", {}).get("others", ())
    for other in others:
        other.field = _joined(path, other.field)
    return [first, *others]


def _joined(path: str, field: str) -> str:
    return ".".join(part for part in (path, field) if part)


def _translated(detail: ErrorDetails, model: type[BaseModel]) -> InputError:
    kind, location, value = detail["type"], detail["loc"], detail["input"]
    value = str(value) if isinstance(value, InSI) else value
    context = detail.get("ctx", {})
    path = _path(location, model)
    if kind == "input_error":
        error: InputError = context["error"]
        error.field = _joined(path, error.field)
        return error
    if kind == "extra_forbidden":
        return InputError("unknown-field", path, shown(value), suggestion=_suggestion(location, model))
    if (kind == "missing" and isinstance(location[-1], int)) or kind == "too_long":
        # All lists of fixed length in a case are pairs. What is missing has the place inside the list.
        place = location[:-1] if kind == "missing" else location
        return InputError("wrong-length", _path(place, model), shown(value), length=2)
    if kind == "missing":
        return InputError("missing-field", path, example=_example(location, model))
    if _is_word(detail):
        return InputError(
            "not-a-choice", path, shown(value), choices=f"{_quoted(context['expected'])} or a block of fields"
        )
    if kind == "literal_error":
        return InputError("not-a-choice", path, shown(value), choices=_quoted(context["expected"]))
    if kind in ("union_tag_not_found", "union_tag_invalid"):
        tag = f"{path}.{context['discriminator'].strip(chr(39))}"
        if kind == "union_tag_not_found":
            return InputError("missing-field", tag, example=_tag_example(location, model))
        return InputError("not-a-choice", tag, shown(context["tag"]), choices=_quoted(context["expected_tags"]))
    if kind in ("greater_than", "greater_than_equal", "less_than", "less_than_equal"):
        key, limit = next((key, limit) for key, limit in context.items() if key in _BOUNDS)
        # The limits are SI numbers, and zero is zero in any unit.
        bound = bound_beside(value, limit) if isinstance(value, str) and limit else f"{limit:g}"
        return InputError("out-of-range", path, shown(value), bound=f"{_BOUNDS[key]} {bound}")
    expected = _EXPECTED.get(kind) or _EXPECTED.get(kind.split("_")[0])
    if expected:
        return InputError("wrong-type", path, shown(value), expected=expected)
    return InputError("not-usable", path, shown(value), reason=detail["msg"])


def _quoted(choices: str) -> str:
    return choices.replace("'", '"')


def _path(location: Sequence[int | str], model: type[BaseModel]) -> str:
    """Return ``("section", "polygon", 2, 0)`` as ``section.polygon[2][0]``."""
    text = ""
    for part, _, tells in _steps(location, model):
        if isinstance(part, int):
            text += f"[{part}]"
        # A name of blanks, or of a type, tells which kind of value stands there, and no more.
        elif part.strip() and not tells and part not in _TYPES:
            text += f".{part}" if text else part
    return text


def block_of(annotation: object) -> type[BaseModel] | None:
    """Return the model that a field holds, also behind ``| None``; None where it holds a plain value."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    if typing.get_origin(annotation) is typing.Annotated:
        return block_of(typing.get_args(annotation)[0])
    if isinstance(annotation, types.UnionType) or typing.get_origin(annotation) is typing.Union:
        return next(filter(None, map(block_of, typing.get_args(annotation))), None)
    return None


def kinds_in(annotation: object) -> Iterator[type[BaseModel]]:
    """Walk all models that a list of blocks of several kinds may hold."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for inner in typing.get_args(annotation):
        yield from kinds_in(inner)


def _steps(location: Sequence[int | str], model: type[BaseModel]) -> Iterator[tuple[int | str, type[BaseModel], bool]]:
    """Walk a location: each part, the block that it stands in, and whether it only tells the kind of a block."""
    kinds: list[type[BaseModel]] = []
    named = False
    for place, part in enumerate(location):
        tells = isinstance(part, str) and place > 0 and isinstance(location[place - 1], int) and len(kinds) > 1
        tells = tells or part == model.__name__ or str(part).startswith(_WORDS)
        yield part, model, tells
        field = model.model_fields.get(str(part))
        if (isinstance(part, int) or named) and len(kinds) == 1:
            # A block of a list, or one that the user has named.
            model, named = kinds[0], False
        elif tells:
            model = next((kind for kind in kinds if part in _tags(kind)), model)
        elif field:
            kinds = list(kinds_in(field.annotation))
            named = typing.get_origin(field.annotation) is dict
            model = block_of(field.annotation) or model


def _owner(location: Sequence[int | str], model: type[BaseModel]) -> type[BaseModel]:
    """Return the model of the block in which the last name of `location` stands."""
    return [block for _, block, _ in _steps(location, model)][-1]


def _tags(model: type[BaseModel]) -> tuple[object, ...]:
    """Return the field that identifies a block by its only value."""
    values = (typing.get_args(field.annotation) for field in model.model_fields.values() if field.is_required())
    return tuple(tag for tags in values for tag in tags)


def _tag_example(location: Sequence[int | str], model: type[BaseModel]) -> str:
    """Return the first line of a block whose kind is missing."""
    owner = _owner(location, model)
    names = [part for part in location if isinstance(part, str)]
    first = next(kinds_in(owner.model_fields[names[-1]].annotation))
    name, field = next(iter(first.model_fields.items()))
    return f"{name} = {shown(typing.get_args(field.annotation)[0])}"


def _places(model: type[BaseModel], above: str = "") -> Iterator[tuple[str, str]]:
    """Walk all fields of a model: their name and their full path."""
    for name, field in model.model_fields.items():
        yield name, above + name
        block = block_of(field.annotation)
        if block:
            yield from _places(block, f"{above}{name}.")


@cache
def _first_places(model: type[BaseModel]) -> dict[str, str]:
    """Return the full path of the first field of each name, once for all names of a long file that are unknown."""
    paths: dict[str, str] = {}
    for name, path in _places(model):
        paths.setdefault(name, path)
    return paths


def _suggestion(location: Sequence[int | str], model: type[BaseModel]) -> str:
    name = str(location[-1])
    known = [field.alias or own for own, field in _owner(location, model).model_fields.items()]
    elsewhere = _first_places(model).get(name)
    near = difflib.get_close_matches(name, known, n=1)
    if elsewhere or near:
        return f'did you mean "{elsewhere or near[0]}"?'
    return f"the fields here are {', '.join(known)}"


def _example(location: Sequence[int | str], model: type[BaseModel]) -> str:
    name = str(location[-1])
    field = _owner(location, model).model_fields[name]
    if block_of(field.annotation):
        return f"[{_path(location, model)}]"
    schemas = (part.json_schema for part in field.metadata if isinstance(part, WithJsonSchema))
    schema: Mapping[str, typing.Any] = next((schema for schema in schemas if schema), {})
    return f"{name} = {shown(next(iter(schema.get('examples', [''])), ''))}"
