"""Read a case: a file in TOML or JSON, or a dictionary, with fields set on the command line, to a
:class:`Case` that is sound.

The models are in :mod:`heeltoe.case.model`, the way from their complaints to one plain sentence in
:mod:`heeltoe.case.sentences`."""

from __future__ import annotations

import copy
import json
import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from heeltoe.case.dam import UPLIFT_OPTIONS
from heeltoe.case.model import Case
from heeltoe.case.motion import NO_MOTION
from heeltoe.case.sentences import first_error
from heeltoe.errors import InputError, shown
from heeltoe.geometry.section import ON_LINE

# An override says how it shall be now: what the file says in the other form of the same thing goes.
_REPLACES = {
    # Channel, unit and time step belong to the file that goes; taken for another one's they would spoil it silently.
    "motion.file": ("motion.points", "motion.channel", "motion.unit", "motion.time_step"),
    "motion.points": ("motion.file", "motion.channel", "motion.unit", "motion.time_step"),
    "motion.vertical.file": tuple(f"motion.vertical.{name}" for name in ("points", "channel", "unit", "time_step")),
    "motion.vertical.points": tuple(f"motion.vertical.{name}" for name in ("file", "channel", "unit", "time_step")),
    "crack.friction": ("crack.static_friction", "crack.kinetic_friction"),
    "crack.static_friction": ("crack.friction",),
    "crack.kinetic_friction": ("crack.friction",),
}


def read_case(source: str | os.PathLike[str] | Mapping[str, Any], overrides: Sequence[str] = ()) -> Case:
    """Read and check a case.

    Parameters
    ----------
    source
        Path of a TOML or JSON file (told apart by what is in it), or the fields themselves.
    overrides
        ``"PATH=VALUE"`` each, for example ``"crack.friction=1.0"`` or ``"reservoir.depth=95m"``; they win
        over `source`.

    Returns
    -------
    Case
        A case in which crack, water and section agree.

    Raises
    ------
    InputError
        The first thing that is wrong, and how many more there are.
    """
    if isinstance(source, Mapping):
        fields, directory = copy.deepcopy(dict(source)), Path()
    else:
        path = Path(source)
        fields, directory = _parsed(path), path.parent
    _apply(fields, overrides)
    try:
        case = Case.model_validate(fields)
    except ValidationError as found:
        raise first_error(found, Case) from None
    _check_loads(case)
    return case.based_in(directory)


def case_schema() -> dict[str, Any]:
    """Return the JSON schema of a case."""
    return Case.model_json_schema()


def _check_loads(case: Case) -> None:
    """Refuse water and silt above the crest, as flow over a dam is another problem, and anchors beyond the toe."""
    section = case.cut
    height = section.crest_elevation - section.base_elevation
    highest = height * (1.0 + ON_LINE)
    surfaces = {
        "reservoir.depth": case.reservoir.depth if case.reservoir else None,
        "tailwater.depth": case.tailwater.depth if case.tailwater else None,
        "statics.flood_depth": case.statics.flood_depth,
        "statics.flood_tailwater": case.statics.flood_tailwater,
    }
    for field, depth in surfaces.items():
        if depth is not None and depth > highest:
            raise InputError("water-above-crest", field, f"{depth:g} m", height=f"{height:g} m")
    if case.silt is not None and case.silt.depth > highest:
        raise InputError("silt-above-crest", "silt.depth", f"{case.silt.depth:g} m", height=f"{height:g} m")
    for place, anchor in enumerate(case.anchors):
        if anchor.distance > section.crack_width * (1.0 + ON_LINE):
            field, width = f"anchors[{place}].distance", f"{section.crack_width:g} m"
            raise InputError("anchor-outside", field, f"{anchor.distance:g} m", width=width)


def _parsed(path: Path) -> dict[str, Any]:
    name = str(path)
    try:
        text = path.read_bytes().decode("utf-8-sig")  # editors on Windows begin a file with a byte order mark
    except FileNotFoundError:
        raise InputError("case-file-missing", name) from None
    except UnicodeDecodeError:
        raise InputError("case-file-encoding", name) from None
    except (OSError, ValueError) as error:
        raise InputError("case-file-unreadable", name, reason=getattr(error, "strerror", None) or error) from None
    kind = "JSON" if text.lstrip().startswith("{") else "TOML"
    try:
        fields: dict[str, Any] = json.loads(text, object_pairs_hook=_once) if kind == "JSON" else tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError("case-file-syntax", name, kind=kind, reason=error) from None
    return fields


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return a block of JSON; of a key that stands there twice JSON itself would take the last, TOML takes none."""
    fields: dict[str, Any] = {}
    for name, value in pairs:
        if name in fields:
            raise ValueError(f"{shown(name)} stands twice in one block")
        fields[name] = value
    return fields


def _apply(fields: dict[str, Any], overrides: Sequence[str]) -> None:
    split = [_split(override) for override in overrides]
    _check_pair(fields, split)
    for path, value in split:
        for other in (*_REPLACES.get(".".join(path), ()), *_of_other_patterns(path, value)):
            _remove(fields, other.split("."))
    for path, value in split:
        block = fields
        for name in path[:-1]:
            inner = block.setdefault(name, {})
            if not isinstance(inner, dict):
                raise InputError("unknown-field", ".".join(path), suggestion=f'"{name}" has no fields')
            block = inner
        block[path[-1]] = value


def _check_pair(fields: dict[str, Any], split: Sequence[tuple[list[str], Any]]) -> None:
    """Refuse another horizontal motion beside the vertical one of the case: they are of one earthquake, and the
    vertical one would be scaled by a factor that is none of its own."""
    motion = fields.get("motion")
    if not isinstance(motion, dict) or motion.get("vertical") in (None, NO_MOTION):
        return
    given = {".".join(path): value for path, value in split}
    if not given.keys().isdisjoint({"motion", "motion.vertical", "motion.vertical.file", "motion.vertical.points"}):
        return
    for name in ("motion.file", "motion.points"):
        if name in given and given[name] != motion.get(name.removeprefix("motion.")):
            raise InputError("vertical-of-another", name, shown(given[name]), none=NO_MOTION)


def _of_other_patterns(path: Sequence[str], value: Any) -> tuple[str, ...]:
    """Return what belongs to another pattern of uplift than the one that is set."""
    if list(path) != ["uplift", "pattern"]:
        return ()
    gone = [f"uplift.{option}" for option, pattern in UPLIFT_OPTIONS.items() if pattern != value]
    return (*gone, "statics.drain_diameter") if value != "drained" else tuple(gone)


def _split(override: str) -> tuple[list[str], Any]:
    name, equals, text = override.partition("=")
    path = [part.strip() for part in name.split(".")]
    if not equals or not all(path):
        raise InputError("override-form", "--set", shown(override))
    return path, _value(text.strip())


def _value(text: str) -> Any:
    """Return a number, truth value, list or table where `text` reads as one in TOML, else `text` itself."""
    try:
        read = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    value = read.get("value")
    # A line break would smuggle in more fields, and TOML's dates are no values of ours.
    return value if len(read) == 1 and isinstance(value, bool | int | float | str | list | dict) else text


def _remove(fields: dict[str, Any], path: Sequence[str]) -> None:
    block: Any = fields
    for name in path[:-1]:
        block = block.get(name) if isinstance(block, dict) else None
    if isinstance(block, dict):
        block.pop(path[-1], None)
