"""The motions of a case as a list, a mainshock and its aftershocks: shown, moved, removed, with pauses in between.

What is changed are the fields as they were typed. A pause belongs to its place between two motions, not to a motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from heeltoe.base.payload import Json

#: Motions of one case.
MOST = 20

Fields = Mapping[str, Any]


def listed(fields: Fields, wrong: Mapping[str, str] = MappingProxyType({})) -> list[dict[str, str]]:
    """Return title and pause of each motion of a case, the first one without a pause, and its errors of `wrong`, by
    fields."""
    return [
        {"title": _title(motion), "pause": _text(pause), "wrong": _wrong(wrong, place)}
        for place, (motion, pause) in enumerate(zip(*_taken_apart(fields), strict=True))
    ]


def _wrong(wrong: Mapping[str, str], place: int) -> str:
    path = f"aftershocks[{place - 1}]" if place else "motion"
    return " ".join(text for field, text in wrong.items() if field == path or field.startswith(f"{path}."))


def with_one(fields: Fields, place: int, motion: Fields) -> Json:
    """Return the changes that put a motion at a place, or behind all of them."""
    motions, pauses = _taken_apart(fields)
    motions[place : place + 1] = [motion]
    return _changes(motions, [*pauses, None][: len(motions)])


def moved(fields: Fields, place: int, by: int) -> Json:
    """Return the changes that move a motion in the list; the pauses stay where they are."""
    motions, pauses = _taken_apart(fields)
    motions.insert(place + by, motions.pop(place))
    return _changes(motions, pauses)


def without(fields: Fields, place: int) -> Json:
    """Return the changes that remove a motion, and the pause before it; with the first one that after it."""
    motions, pauses = _taken_apart(fields)
    del motions[place], pauses[max(place, 1)]
    return _changes(motions, pauses)


def paused(fields: Fields, place: int, pause: str | None) -> Json:
    """Return the changes of the pause before a motion."""
    motions, pauses = _taken_apart(fields)
    pauses[place] = pause
    return _changes(motions, pauses)


def _taken_apart(fields: Fields) -> tuple[list[Fields], list[Any]]:
    """Return the motions, and the pause before each, None without one."""
    aftershocks = fields.get("aftershocks")
    motions_in_file = [fields["motion"]] if fields.get("motion") is not None else []
    motions_in_file += aftershocks if isinstance(aftershocks, list) else []
    blocks = [block if isinstance(block, Mapping) else {} for block in motions_in_file]
    motions = [{name: value for name, value in block.items() if name != "pause"} for block in blocks]
    return list(motions), [None if not place else block.get("pause") for place, block in enumerate(blocks)]


def _changes(motions: Sequence[Fields], pauses: Sequence[Any]) -> Json:
    together = [
        {**motion, **({} if pause is None else {"pause": pause})}
        for motion, pause in zip(motions[1:], pauses[1:], strict=True)
    ]
    return {"motion": dict(motions[0]) if motions else None, "aftershocks": together or None}


def _title(motion: Fields) -> str:
    name = _text(motion.get("file")) or ("drawn by points" if "points" in motion else "no record")
    peak = _text(motion.get("pga"))
    return ", ".join((name, *([f"peak {peak}"] if peak else []), *(["other sign"] if motion.get("reverse") else [])))


def _text(value: object) -> str:
    return "" if value is None else str(value)
