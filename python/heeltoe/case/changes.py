"""Changes of single fields of a case, each by its path: on the command line, as a file is read, and from Python."""

from __future__ import annotations

import copy
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from heeltoe.case.dam import UPLIFT_OPTIONS
from heeltoe.case.joints import JOINTS
from heeltoe.case.lists import CRACKS, path_in_fields
from heeltoe.case.motion import FILE_OPTIONS, NO_MOTION
from heeltoe.case.options import NO_FLOOD
from heeltoe.errors.error import InputError, shown
from heeltoe.motion.records.catalog import PREFIX, find
from heeltoe.units.parse import misgrouped

#: ``"crack.friction=1.0"``, ``{"crack.friction": 1.0}`` or ``{"crack": {"friction": 1.0}}``; one or several of these.
Change = str | Mapping[str, object]
Changes = Change | Sequence[Change]

# Of a section: what its several forms are made of.
_SIZES, _DIMENSIONS = ("height", "crest_width"), ("neck_height", "neck_width", "base_width")
_FACES, _FILE = ("upstream", "downstream"), ("file", "layer", "unit")

_no_change = partial(InputError, "wrong-quantity", kind="a change of a field, PATH=VALUE", example="crack.friction=1.0")
_OF_A_FILE = tuple(f"motion.{name}" for name in FILE_OPTIONS)
_FIT = ("crack.fit", "crack.band")
_COEFFICIENTS = ("crack.friction", "crack.static_friction", "crack.kinetic_friction")

# An override says how it shall be now: what the file says in the other form of the same thing goes.
_REPLACES = {
    # Channel, unit and time step belong to the file that goes; taken for another one's they would spoil it silently.
    "motion.file": ("motion.points", "motion.direction", *_OF_A_FILE),
    "motion.points": ("motion.file", "motion.direction", *_OF_A_FILE),
    "motion.vertical.file": tuple(f"motion.vertical.{name}" for name in ("points", *FILE_OPTIONS)),
    "motion.vertical.points": tuple(f"motion.vertical.{name}" for name in ("file", *FILE_OPTIONS)),
    **{
        f"motion.cross_valley.{one}": tuple(
            f"motion.cross_valley.{name}" for name in (other, "direction", *FILE_OPTIONS)
        )
        for one, other in (("file", "points"), ("points", "file"))
    },
    **{
        f"section.{name}": tuple(f"section.{other}" for other in others)
        for name, others in {
            "polygon": (*_SIZES, *_DIMENSIONS, *_FACES, *_FILE),
            "file": (*_SIZES, *_DIMENSIONS, *_FACES, "polygon"),
            **dict.fromkeys(_FACES, (*_DIMENSIONS, *_FILE, "polygon")),
        }.items()
    },
    "suite.pga": ("suite.sa", "suite.period"),
    "suite.sa": ("suite.pga", "suite.period"),
    "uplift.drain_position": ("uplift.drain_x",),
    "uplift.drain_x": ("uplift.drain_position",),
    "statics.criteria": ("statics.criteria_file",),
    "statics.criteria_file": ("statics.criteria",),
    # The band, and the fit that may have given it, are about the friction before.
    "crack.friction": ("crack.static_friction", "crack.kinetic_friction", "crack.law", *_FIT),
    "crack.static_friction": ("crack.friction", "crack.law", *_FIT),
    "crack.kinetic_friction": ("crack.friction", "crack.law", *_FIT),
    "crack.fit": (*_COEFFICIENTS, "crack.law", "crack.band"),
    "crack.law": (*_COEFFICIENTS, "crack.fit"),
    "crack.law.name": (*_COEFFICIENTS, "crack.fit"),
}

# One of a list, by its place; a few digits, since no list is longer.
_ITEM = re.compile(r"(\w+)\[(\d{1,4})\]")
_LISTED = re.compile(r"(?:further_)?cracks\[\d{1,4}\](?=\.)")


def apply(fields: dict[str, object], changes: Changes, directory: Path | None = None) -> dict[str, str]:
    """Change the fields of a case, as a file has them, in place.

    Parameters
    ----------
    fields
        As a file has them.
    changes
        What wins over them.
    directory
        Where relative paths start; None where no file is looked for.

    Returns
    -------
    dict
        How the changes call cracks, by the paths of these cracks in the fields, where it is another way.

    Raises
    ------
    InputError
        Where a change says nothing, or what it says does not go together with the rest.
    """
    split, written = [], dict[str, str]()
    for path, value in _split_all(changes):
        if path == [CRACKS] or (CRACKS in fields and path in (["crack"], ["further_cracks"])):
            # Another form of all cracks takes the place of the one before.
            for name in {CRACKS, "crack", "further_cracks", JOINTS} - {path[0]}:
                fields.pop(name, None)
        place = path_in_fields(".".join(path), fields).split(".")
        if place != path:
            written[place[0]] = path[0]
        split.append((place, value))
    _check_pair(fields, split, directory)
    for path, value in split:
        for other in (*_replaced(".".join(path)), *_of_others(path, value)):
            _remove(fields, other.split("."))
    for path, value in split:
        block = fields
        for name in path[:-1]:
            inner = _inner(block, name, ".".join(path))
            if not isinstance(inner, dict):
                raise InputError("unknown-field", ".".join(path), suggestion=f'"{name}" has no fields')
            block = inner
        block[path[-1]] = value
    return written


def _inner(block: dict[str, object], name: str, path: str) -> Any:
    """Return the block of this name in another, which is made where it is not there, or one of a list of them."""
    item = _ITEM.fullmatch(name)
    if item is None:
        if name == "rock" and isinstance(block.get(name), str):
            # A word in place of the block.
            block[name] = {}
        return block.setdefault(name, {})
    item_block = _item_block(block, name)
    if item_block is None:
        items = block.get(item[1])
        count = len(items) if isinstance(items, list) else 0
        has = f'"{item[1]}" has {count}, counted from 0' if count else f'there is no list "{item[1]}"'
        raise InputError("unknown-field", path, suggestion=has)
    return item_block


def _item_block(block: dict[str, object], name: str) -> Any:
    """Return what is called so in a block, ``crack``, or so in a list of it, ``further_cracks[0]``; None without it."""
    item = _ITEM.fullmatch(name)
    if item is None:
        return block.get(name)
    items, place = block.get(item[1]), int(item[2])
    return items[place] if isinstance(items, list) and place < len(items) else None


def _replaced(path: str) -> tuple[str, ...]:
    """Return what goes where a field is set; all cracks of a list have their coefficients as `crack` has."""
    listed = _LISTED.match(path)
    if listed is None:
        return _REPLACES.get(path, ())
    others = _REPLACES.get(f"crack{path[listed.end() :]}", ())
    return tuple(other.replace("crack", listed[0], 1) for other in others)


def _check_pair(fields: dict[str, object], split: Sequence[tuple[list[str], Any]], directory: Path | None) -> None:
    """Refuse another horizontal motion beside the vertical one of the case, or that across the valley: they are of one
    earthquake, and the other one would be scaled by the factor of another motion."""
    motion = fields.get("motion")
    if not isinstance(motion, dict):
        return
    for component in ("vertical", "cross_valley"):
        if motion.get(component) not in (None, NO_MOTION):
            _check_component(f"motion.{component}", motion, split, directory)


def _check_component(
    component: str, motion: dict[str, Any], split: Sequence[tuple[list[str], Any]], directory: Path | None
) -> None:
    values = {".".join(path): value for path, value in split}
    if not values.keys().isdisjoint({"motion", component, f"{component}.file", f"{component}.points"}):
        return
    for name in ("motion.file", "motion.points"):
        if name in values and values[name] != motion.get(name.removeprefix("motion.")):
            if name == "motion.file" and directory is not None and not str(values[name]).startswith(PREFIX):
                find(str(values[name]), directory)  # a file that is missing is the first thing to say
            raise InputError("vertical-of-another", name, shown(values[name]), component=component, none=NO_MOTION)


def _of_others(path: Sequence[str], value: Any) -> tuple[str, ...]:
    """Return what belongs to another pattern of uplift than the one that is set, or to a flood that is none."""
    if list(path) == ["statics", "flood_depth"] and value == NO_FLOOD:
        return "statics.flood_tailwater", "statics.flood_rarity"
    if list(path) != ["uplift", "pattern"]:
        return ()
    gone = [f"uplift.{option}" for option, pattern in UPLIFT_OPTIONS.items() if pattern != value]
    return (
        (*gone, "uplift.drain_x", "statics.drain_diameter", "statics.closed_drains")
        if value != "drained"
        else tuple(gone)
    )


def _split_all(changes: Changes) -> Iterator[tuple[list[str], Any]]:
    """Walk through all fields that change: path and value."""
    if isinstance(changes, str):
        yield _split(changes)
    elif isinstance(changes, Mapping):
        for name, value in changes.items():
            if not isinstance(name, str) or not all(part.strip() for part in name.split(".")):
                raise _no_change("changes", shown(name))
            path = [part.strip() for part in name.split(".")]
            if isinstance(value, Mapping):
                yield from (([*path, *inner], part) for inner, part in _split_all(value))
            else:
                yield path, copy.deepcopy(value)
    elif isinstance(changes, Sequence):
        for change in changes:
            yield from _split_all(change)
    else:
        raise _no_change("changes", shown(changes))


def _split(override: str) -> tuple[list[str], Any]:
    name, equals, text = override.partition("=")
    path = [part.strip() for part in name.split(".")]
    if not equals or not all(path):
        raise _no_change("--set", shown(override))
    return path, _value(text.strip())


def _value(text: str) -> Any:
    """Return a number, truth value, list or table where `text` reads as one in TOML, else `text` itself."""
    if misgrouped(text) is not None:
        return text
    try:
        read = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    value = read.get("value")
    # A line break would smuggle in more fields, and TOML's dates are no values of ours.
    return value if len(read) == 1 and isinstance(value, bool | int | float | str | list | dict) else text


def _remove(fields: dict[str, object], path: Sequence[str]) -> None:
    block: Any = fields
    for name in path[:-1]:
        block = _item_block(block, name) if isinstance(block, dict) else None
    if isinstance(block, dict):
        block.pop(path[-1], None)
