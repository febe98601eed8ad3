"""All names, and the meanings of a name that a user has written."""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import SequenceMatcher, get_close_matches
from functools import cache

from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import near
from heeltoe.result.contract import HEADLINES
from heeltoe.result.crest import CREST_PEAKS
from heeltoe.views.explain.fields import fields_of_a_case, fields_of_a_study
from heeltoe.views.explain.keys import columns, keys_of_the_json, outcomes
from heeltoe.views.explain.meaning import KINDS, Meaning

# No name is so long; what is longer is not compared with all of them.
_LONGEST = 200
# So many names are suggested.
_SUGGESTED = 3
# Other names with a word of the name are listed, up to this number.
_RELATED = 6
# Keys of a result stand below these again, where models stand side by side or runs in a table.
_AGAIN = ("beside", "cracks", "runs", "sections", "statics", "rigid", "flexible", "decoupled")
_COMPONENT = re.compile(r"^(vertical|cross_valley)_motion\.")
_HEADLINES = frozenset((*(headline.key for headline in HEADLINES), *CREST_PEAKS))


@cache
def everything() -> tuple[Meaning, ...]:
    """Return all names with their meanings, in the order of their kinds."""
    return (*fields_of_a_case(), *fields_of_a_study(), *keys_of_the_json(), *columns(), *outcomes())


def usual_names() -> tuple[Meaning, ...]:
    """Return the names of lists that do not show everything: without fields of the thesis and repeated ones."""
    return tuple(meaning for meaning in everything() if not meaning.hidden)


def explain(name: str, *, all_: bool = False) -> tuple[Meaning, ...]:
    """Return the meanings of a name: all with that path, else all that end with it, else all with that word; fields
    come first.

    Parameters
    ----------
    name
        A path, its end or a word of it. Places in lists may be written or left out, ``anchors[0].capacity`` or
        ``anchors.capacity``.
    all_
        Whether to return fields of repeated blocks beside the first one, too.

    Raises
    ------
    InputError
        Where there is no such name.
    """
    # The keys of each component of a motion are those of the horizontal one.
    wanted = _COMPONENT.sub("motion.", _plain(name.strip()))
    if wanted not in ("", "*") and len(wanted) <= _LONGEST:
        for matches in (
            _with_fields(_of_path(wanted), wanted),
            _of_path(_shorter(wanted)),
            _ending(wanted),
            _with_word(wanted),
        ):
            # Only fields repeat; those of a block that is like another mean the same.
            found = matches if all_ or wanted in _by_name() else _first_of_each(matches)
            if found:
                return tuple(sorted(found, key=lambda meaning: list(KINDS).index(meaning.kind)))
    raise InputError("explain-unknown", "NAME", shown(name), near=_suggested(wanted[:_LONGEST]))


def _with_fields(matches: tuple[Meaning, ...], wanted: str) -> tuple[Meaning, ...]:
    """Return meanings with the fields that end with the same name first: `friction` is what a user writes before it is
    what the JSON has."""
    if not matches or any(meaning.kind.startswith("field") for meaning in matches):
        return matches
    fields = _first_of_each(tuple(meaning for meaning in _ending(wanted) if meaning.kind == "field of a case"))
    return (*fields, *matches)


def related(name: str, found: Sequence[Meaning]) -> tuple[str, ...]:
    """Return a few other names that have the same word: fields first, then keys of a result."""
    word = _plain(name.strip())
    names = [
        meaning.name
        for meaning in usual_names()
        if word in re.split(r"[_.]", meaning.last) and meaning not in found and meaning.name.count(".") < 2
    ]
    return tuple(dict.fromkeys(names))[:_RELATED]


def _first_of_each(matches: tuple[Meaning, ...]) -> tuple[Meaning, ...]:
    """Return meanings without the hidden ones that repeat another of them."""
    usual = {(meaning.last, meaning.meaning) for meaning in matches if not meaning.hidden}
    return tuple(meaning for meaning in matches if not meaning.hidden or (meaning.last, meaning.meaning) not in usual)


def _with_word(wanted: str) -> tuple[Meaning, ...]:
    """Return fields, else other names, whose last part has a word."""
    found = tuple(meaning for meaning in usual_names() if wanted in meaning.last.split("_"))
    return tuple(meaning for meaning in found if meaning.kind.startswith("field")) or found


def _suggested(wanted: str) -> str:
    """Return what may have been meant, in the words of a message: a name, or fields with a word that is nearer."""
    names = dict.fromkeys(key for path, (first, *_) in _by_name().items() for key in (path, first.last))
    of_word: dict[str, list[str]] = {}
    for path, (first, *_) in _by_name().items():
        for word in re.findall(r"[a-z0-9]{3,}", first.last) if first.kind == "field of a case" else ():
            of_word.setdefault(word, []).append(path)
    name, word = (get_close_matches(wanted, known, n=1) for known in (names, of_word))
    if not word or (name and _likeness(wanted, name[0]) >= _likeness(wanted, word[0])):
        return near(wanted, names)
    *others, last = (f'"{path}"' for path in of_word[word[0]][:_SUGGESTED])
    return f", did you mean {', '.join(others)}{' or ' if others else ''}{last}?"


def _likeness(one: str, other: str) -> float:
    return SequenceMatcher(None, one, other).ratio()


def _of_path(wanted: str) -> tuple[Meaning, ...]:
    exact = _by_name().get(wanted)
    return exact or tuple(
        meaning for name, meanings in _by_name().items() if "*" in name and _fits(name, wanted) for meaning in meanings
    )


def _ending(wanted: str) -> tuple[Meaning, ...]:
    ends = (f".{wanted}", f"[{wanted}]")
    return tuple(meaning for name, meanings in _by_name().items() if name.endswith(ends) for meaning in meanings)


@cache
def _by_name() -> dict[str, tuple[Meaning, ...]]:
    meanings: dict[str, tuple[Meaning, ...]] = {}
    for meaning in everything():
        name = _plain(meaning.name)
        meanings[name] = (*meanings.get(name, ()), meaning)
    return meanings


def _shorter(wanted: str) -> str:
    """Return a path without what a result of its own stands below."""
    parts: Sequence[str] = wanted.split(".")
    while len(parts) > 1 and parts[0] in _AGAIN:
        parts = parts[1:]
    # Of several motions each has the keys of one, and some of its own.
    if len(parts) > 1 and parts[0] == "motions":
        of_one = _of_path(f"motion.{parts[1]}")
        parts = [*(["motion"] if any(meaning.kind == "key of the JSON" for meaning in of_one) else []), *parts[1:]]
    return ".".join(parts)


def _plain(name: str) -> str:
    """Return a path without places in lists; what tells kinds of blocks apart stays."""
    return re.sub(r"\[\d*\]|\.\d+(?=\.|$)", "", name)


def _fits(pattern: str, name: str) -> bool:
    parts, words = pattern.split("."), name.split(".")
    if (
        parts[0] in ("evidence", "spread", "summary")
        and parts[1] == "*"
        and len(words) > 1
        and words[1] not in _HEADLINES
    ):
        return False
    return len(parts) == len(words) and all(part in ("*", word) for part, word in zip(parts, words, strict=True))
