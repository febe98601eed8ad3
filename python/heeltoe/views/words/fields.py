"""Fields of a case with their values as people read them, units and all."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from pydantic import BaseModel

from heeltoe.case.project import Project
from heeltoe.plain import plain
from heeltoe.units.sentences import UNITS, scale

# SI units as people write them, and larger ones for what would have many zeros.
_UNITS = {"kg/m^3": "kg/m³", "m/s^2": "m/s²", "N/m^2": "N/m²"}
_LARGER = {"Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa")), "N/m": ((1e6, "MN/m"), (1e3, "kN/m"))}
# Lengths below are written in millimetres [m].
_LEAST_METRES = 0.5
_QUANTITY = re.compile(r"(-?\d+(?:\.\d*)?(?:e[+-]?\d+)?) ([A-Za-z/^\d]+)")
# Longer lists, as the points of a drawn motion, are not read by anyone; their hash is in the report.
_MOST_ITEMS = 12
# Fields that hold people's own words, names and paths.
OWN_WORDS = ("title", "file", "unit", "mesh_above", "mesh_below")


def fields(
    model: BaseModel, written: Mapping[str, Any], prefix: str = "", *, units: str = "si"
) -> Iterator[tuple[str, str, bool, str]]:
    """Walk through all fields: path, value with its unit, whether it is given, meaning; blocks of fields come last.

    Those of the title block are left out: they are words of the report, which shows them as such.
    """
    blocks = []
    for name, info in type(model).model_fields.items():
        value = getattr(model, name)
        if isinstance(value, Project):
            continue
        if isinstance(value, BaseModel):
            blocks.append((value, written[name], f"{prefix}{name}."))
        elif isinstance(value, tuple) and value and isinstance(value[0], BaseModel):
            blocks += [(item, written[name][k], f"{prefix}{name}[{k}].") for k, item in enumerate(value)]
        else:
            meaning = " ".join((info.description or "").split())
            text = plain(written[name]) if name in OWN_WORDS and written[name] else shown(written[name], units)
            yield prefix + name, text, name in model.model_fields_set, meaning
    for block in blocks:
        yield from fields(*block, units=units)


def shown(value: Any, units: str = "si") -> str:
    """Write a value of a case's JSON with its unit as people read it."""
    if value is None or value == []:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        items = [
            f"({shown_list(item, units)})" if isinstance(item, list) else shown(item, units)
            for item in value[:_MOST_ITEMS]
        ]
        more = f" and {len(value) - _MOST_ITEMS} more" if len(value) > _MOST_ITEMS else ""
        return ", ".join(items) + more
    if isinstance(value, dict):
        return ", ".join(f"{name} {shown(each, units)}" for name, each in value.items() if each is not None)
    if isinstance(value, float):
        return _number(value)
    text = str(value)
    match = _QUANTITY.fullmatch(text)
    return plain(text) if match is None else _quantity(float(match[1]), match[2], units)


def shown_list(values: list[Any], units: str) -> str:
    """Write the parts of a point."""
    return ", ".join(shown(value, units) for value in values)


def _quantity(number: float, unit: str, units: str) -> str:
    if units == "us" and unit in UNITS:
        factor, quantity = UNITS[unit]
        to = scale(quantity, number * factor)
        return f"{number * factor * to.factor:.6g} {to.unit}"
    if unit == "m" and 0.0 < abs(number) < _LEAST_METRES:
        return f"{_number(1e3 * number)} mm"
    for least, larger in _LARGER.get(unit, ()):
        if abs(number) >= least:
            return f"{_number(number / least)} {larger}"
    if unit == "rad":
        return f"{_number(np.degrees(number).item())}°"
    return f"{_number(number)} {_UNITS.get(unit, unit)}"


def _number(number: float) -> str:
    return f"{number:.7g}"
