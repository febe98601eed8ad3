"""Lists of a case file that the case has as a first block and further ones: `[[motion]]` and `[[cracks]]`; `[joints]`
is such a list of cracks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from heeltoe.case.crack.crack import FRICTION, Crack
from heeltoe.case.joints import joints_as_cracks
from heeltoe.errors.error import InputError, shown
from heeltoe.units.parse import parse

#: The list of all cracks in a file.
CRACKS = "cracks"
#: What it holds, in words.
CRACKS_MEANING = (
    "All cracks in one list from the crest down, in place of `crack` and `further_cracks`; friction and restitution "
    "that one does not state are those of the first, and uplift that of `[uplift]`."
)
_FURTHER = "further_cracks"
_OF_CRACK = re.compile(r"(crack|further_cracks(?:\[(\d+)\])?)(?=[.\[]|$)")
_OF_LIST = re.compile(r"cracks\[(\d{1,4})\](?=\.|$)")


def as_blocks(fields: Mapping[str, object]) -> dict[str, object]:
    """Return the fields of a case with its lists of motions and cracks as first blocks and further ones.

    Raises
    ------
    InputError
        Where a list stands beside the blocks that it replaces, or joints cannot be used.
    """
    fields = joints_as_cracks(dict(fields))
    if CRACKS in fields and not _is_list_of_blocks(fields[CRACKS]):
        raise InputError("wrong-type", CRACKS, shown(fields[CRACKS]), expected="a list of cracks, [[cracks]]")
    return _split(motions_as_blocks(fields), CRACKS, "crack", _FURTHER)


def motions_as_blocks(fields: Mapping[str, object]) -> dict[str, object]:
    """Return the fields of a case with the first motion of a list as `motion` and the others as `aftershocks`.

    Raises
    ------
    InputError
        Where aftershocks stand beside such a list.
    """
    return _split(dict(fields), "motion", "motion", "aftershocks")


def _split(fields: dict[str, object], name: str, first: str, others: str) -> dict[str, object]:
    items = fields.get(name)
    if not isinstance(items, list) or not _is_list_of_blocks(items):
        return fields
    for beside in (others, first):
        if beside != name and beside in fields:
            raise InputError("fields-conflict", name, other=beside)
    rest = {key: value for key, value in fields.items() if key != name}
    return rest | {first: items[0]} | ({others: items[1:]} if len(items) > 1 else {})


def _is_list_of_blocks(items: Any) -> bool:
    return isinstance(items, list) and bool(items) and all(isinstance(item, Mapping) for item in items)


def as_listed(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a case with its cracks as one list."""
    listed = {name: value for name, value in fields.items() if name not in ("crack", _FURTHER)}
    return listed | {CRACKS: [fields["crack"], *fields.get(_FURTHER, ())]}


def as_one_list(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a case with its cracks as one list from the crest down, each with its friction and
    restitution; unreadable entries unchanged."""
    first, further = fields.get("crack"), fields.get(_FURTHER) or []
    if CRACKS in fields or not isinstance(first, Mapping) or (further and not _is_list_of_blocks(further)):
        return dict(fields)
    blocks = {"crack": first, **{f"{_FURTHER}[{place}]": crack for place, crack in enumerate(further)}}
    cracks = [{name: value for name, value in first.items() if value is not None}]
    if further:
        try:
            cracks = [_by_itself(blocks[path], blocks.values()) for path in _from_the_crest_down(fields)]
        except InputError:
            return dict(fields)
    listed: dict[str, Any] = {}
    for name, value in fields.items():
        if name != _FURTHER:
            listed |= {CRACKS: cracks} if name == "crack" else {name: value}
    return listed


def _by_itself(crack: Mapping[str, object], cracks: Iterable[Mapping[str, object]]) -> dict[str, object]:
    """Return one of several cracks with the fields that it takes from the first one."""
    first = next(iter(cracks))
    own = {"elevation": "0 m"} | {name: value for name, value in crack.items() if value is not None}
    if own.keys().isdisjoint(FRICTION):
        own |= {name: first[name] for name in FRICTION if first.get(name) is not None}
    if all(other.get("restitution") is None for other in cracks):
        return own
    restitution = first.get("restitution")
    return {"restitution": Crack.model_fields["restitution"].default if restitution is None else restitution} | own


def crack_path(path: str) -> str:
    """Return the path of a field of `crack` or `further_cracks` in the list of all cracks; other paths unchanged."""
    match = _OF_CRACK.match(path)
    if match is None:
        return path
    place = 0 if match[1] == "crack" else None if match[2] is None else int(match[2]) + 1
    return f"{CRACKS}{'' if place is None else f'[{place}]'}{path[match.end() :]}"


def place_in_list(path: str) -> int | None:
    """Return the place, from the crest down, of the crack whose field a path names in the list of all cracks."""
    match = _OF_LIST.match(path)
    return None if match is None else int(match[1])


def block_path(path: str) -> str:
    """Return the path of a field of a list of cracks as that of a block with the same fields; others unchanged."""
    match, place = _OF_LIST.match(path), place_in_list(path)
    if match is None or place is None:
        return path
    return f"{f'{_FURTHER}[{place - 1}]' if place else 'crack'}{path[match.end() :]}"


def aliases_of(fields: Mapping[str, object]) -> dict[str, str]:
    """Return the paths of the cracks of a file that lists them, by those of the blocks."""
    items = fields.get(CRACKS)
    count = len(items) if isinstance(items, list) else 0
    paths = ["crack", *(f"{_FURTHER}[{place}]" for place in range(count - 1)), _FURTHER]
    return {path: crack_path(path) for path in paths}


def path_in_fields(path: str, fields: Mapping[str, object]) -> str:
    """Return the path of a field of a crack in the form that the fields have: a list, or a first one and others.

    In a list cracks count in its order. In the blocks ``cracks[0]`` is the uppermost one.
    """
    if CRACKS in fields:
        return crack_path(path) if path not in ("crack", _FURTHER) else path
    match = _OF_LIST.match(path)
    paths = _from_the_crest_down(fields) if match else []
    if match is None or int(match[1]) >= len(paths):
        return path
    return f"{paths[int(match[1])]}{path[match.end() :]}"


def _from_the_crest_down(fields: Mapping[str, Any]) -> list[str]:
    further = fields.get(_FURTHER)
    blocks = {"crack": fields.get("crack"), **{f"{_FURTHER}[{k}]": crack for k, crack in enumerate(further or ())}}
    levels = {}
    for path, crack in blocks.items():
        elevation = crack.get("elevation", "0 m") if isinstance(crack, Mapping) else "0 m"
        levels[path] = parse(elevation, "length", f"{path}.elevation")
    return sorted(levels, key=lambda path: -levels[path])


def renamed(errors: Iterable[InputError], names: Mapping[str, str]) -> list[InputError]:
    """Return errors with their fields as the user wrote them."""
    listed = list(errors)
    for error in listed:
        path = next((path for path in names if re.match(rf"{re.escape(path)}(?=[.\[]|$)", error.field)), None)
        if path is not None:
            error.field = f"{names[path]}{error.field[len(path) :]}"
    return listed
