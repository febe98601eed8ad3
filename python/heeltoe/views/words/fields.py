"""Fields of a case with their values as people read them, units and all.

Those of one table share a unit with all others of their quantity, that of the largest. What the crack may slip and open
is another quantity than the measures of the dam, and moduli another than stresses.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from pydantic import BaseModel

from heeltoe.case.fields import field_texts
from heeltoe.case.project import Project
from heeltoe.errors.sanitize import plain
from heeltoe.result.judge import LIMITS
from heeltoe.units.sentences import UNITS, scale
from heeltoe.units.write import angle, digits

# SI units as people write them, and those of a quantity (in SI, its name) from the largest; a largest number takes the
# first of them that it reaches.
_UNITS = {"kg/m^3": "kg/m³", "m/s^2": "m/s²", "N/m^2": "N/m²"}
_SI = {
    "length": ((1.0, "m"), (1e-3, "mm")),
    "displacement": ((1.0, "m"), (1e-3, "mm")),
    "modulus": ((1e9, "GPa"),),
    "pressure": ((1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")),
    "force": ((1e6, "MN/m"), (1e3, "kN/m"), (1.0, "N/m")),
}
_MEMORY = ((1e9, "GB"), (1e6, "MB"), (0.0, "B"))
# Half a metre is half a metre.
_ENOUGH = {"m": 0.5}
# No stress in a dam comes to so much, and all moduli do [Pa].
_MODULUS = 1e9
_MOVEMENTS = {name for name, limit in LIMITS.items() if limit.unit == "m"} - {"cracked_length"}
_QUANTITY = re.compile(r"(-?\d+(?:\.\d*)?(?:e[+-]?\d+)?) ([A-Za-z/^\d]+)")
# Longer lists, as the points of a drawn motion, are not read by anyone; their hash is in the report.
_MOST_ITEMS = 12
# Fields that hold people's own words, names and paths.
OWN_WORDS = ("title", "file", "unit", "mesh_above", "mesh_below")


def fields(
    model: BaseModel, written: Mapping[str, Any], *, units: str = "si", given: bool | None = None
) -> Iterator[tuple[str, str, bool, str]]:
    """Walk through all fields: path, value with its unit, whether it is given, meaning; blocks of fields come last.

    Those of the title block are left out: they are words of the report, which shows them as such. `given` leaves out
    those that are not, or those that are.
    """
    rows = [row for row in _walked(model, written, "") if given is None or row[2] == given]
    largest: dict[str, float] = {}
    for path, value, _, _ in rows:
        _add(largest, value, _name(path))
    for path, value, is_given, meaning in rows:
        own = _name(path) in OWN_WORDS and value
        text = plain(value) if own else _written(value, _name(path), units, largest)
        yield path, text, is_given, meaning


def shown(value: Any, units: str = "si", name: str = "") -> str:
    """Write a value of a case's JSON with its unit as people read it; `name` is that of its field."""
    return shown_values([value], units, name)[0]


def shown_values(values: Sequence[Any], units: str = "si", name: str = "") -> list[str]:
    """Write values of one field, see :func:`shown`, each quantity in one unit."""
    largest: dict[str, float] = {}
    for value in values:
        _add(largest, value, name)
    return [_written(value, name, units, largest) for value in values]


def _walked(model: BaseModel, written: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Any, bool, str]]:
    blocks: list[tuple[BaseModel, Mapping[str, Any], str]] = []
    texts = field_texts(type(model))
    for name in type(model).model_fields:
        value = getattr(model, name)
        if isinstance(value, Project):
            continue
        if isinstance(value, BaseModel):
            blocks.append((value, written[name], f"{prefix}{name}."))
        elif isinstance(value, tuple) and value and isinstance(value[0], BaseModel):
            blocks += [(item, written[name][k], f"{prefix}{name}[{k}].") for k, item in enumerate(value)]
        else:
            meaning = " ".join(texts.get(name, "").split())
            yield prefix + name, written[name], name in model.model_fields_set, meaning
    for block in blocks:
        yield from _walked(*block)


def _name(path: str) -> str:
    return path.rpartition(".")[2]


def _add(largest: dict[str, float], value: Any, name: str) -> None:
    """Note how large each quantity in a value is."""
    if isinstance(value, list | dict):
        for item in value.values() if isinstance(value, dict) else value:
            _add(largest, item, name)
    match = _QUANTITY.fullmatch(value) if isinstance(value, str) else None
    if match and match[2] in UNITS:
        kind, number = _kind(float(match[1]), match[2], name)
        largest[kind] = max(abs(number), largest.get(kind, 0.0))


def _kind(number: float, unit: str, name: str) -> tuple[str, float]:
    """Return what kind of quantity a number with a unit is, and the number in SI."""
    factor, kind = UNITS[unit]
    if kind in ("length", "displacement"):
        kind = "displacement" if name in _MOVEMENTS else "length"
    if kind == "pressure" and abs(number * factor) >= _MODULUS:
        kind = "modulus"
    return kind, number * factor


def _written(value: Any, name: str, units: str, largest: Mapping[str, float]) -> str:
    def inner(part: Any) -> str:
        return _written(part, name, units, largest)

    if value is None or value == []:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        items = [
            f"({', '.join(map(inner, item))})" if isinstance(item, list) else inner(item)
            for item in value[:_MOST_ITEMS]
        ]
        more = f" and {len(value) - _MOST_ITEMS} more" if len(value) > _MOST_ITEMS else ""
        return ", ".join(items) + more
    if isinstance(value, dict):
        return ", ".join(f"{key} {inner(item)}" for key, item in value.items() if item is not None)
    if isinstance(value, float):
        return _number(value)
    match = _QUANTITY.fullmatch(str(value))
    return plain(str(value)) if match is None else _quantity(float(match[1]), match[2], name, units, largest)


def _quantity(number: float, unit: str, name: str, units: str, largest: Mapping[str, float]) -> str:
    if unit == "rad" and name == "rotation":
        return angle(number)
    if unit == "rad":
        return f"{_number(np.degrees(number).item())}°"
    if unit == "B":
        step, unit = next(step for step in _MEMORY if number >= step[0])
        number /= step or 1.0
    if unit not in UNITS:
        return f"{_number(number)} {unit}"
    kind, value = _kind(number, unit, name)
    if units == "us":
        to = scale("pressure" if kind == "modulus" else kind, largest[kind])
        return f"{digits(to(value), 4)} {to.unit}"
    steps = _SI.get(kind)
    if steps is None or not largest[kind]:
        return f"{_number(number)} {_UNITS.get(unit, unit)}"
    step, unit = next((step for step in steps if largest[kind] >= _ENOUGH.get(step[1], 1.0) * step[0]), steps[-1])
    return f"{_number(value / step if step >= 1.0 else value * round(1.0 / step))} {unit}"


def _number(number: float) -> str:
    return f"{number:.7g}"
