"""The input: section, what the case says, what was left to defaults; its hash and how to run it again."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from pydantic import BaseModel

from heeltoe.case.read import Case
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.response import build_info
from heeltoe.views.report.content import Block, Code, Inline, Listing, Own, Section, Strong, Table, paragraph
from heeltoe.views.report.subject import Subject
from heeltoe.views.report.wording import UNITS, scale

# SI units as people write them, and larger ones for what would have many zeros.
_UNITS = {"kg/m^3": "kg/m³", "m/s^2": "m/s²", "N/m^2": "N/m²"}
_LARGER = {"Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa")), "N/m": ((1e6, "MN/m"), (1e3, "kN/m"))}
# Lengths below are written in millimetres [m].
_LEAST_METRES = 0.5
_QUANTITY = re.compile(r"(-?\d+(?:\.\d*)?(?:e[+-]?\d+)?) ([A-Za-z/^\d]+)")
# Longer lists, as the points of a drawn motion, are not read by anyone; their hash is in the report.
_MOST_ITEMS = 12
_SYSTEMS = {"si": "SI", "us": "US"}
# Fields that hold people's own words, names and paths.
_OWN_WORDS = ("title", "file", "unit", "mesh_above", "mesh_below")
# Blocks that only one model looks at.
_OWNERS = {"flexible": ("flexible",), "decoupled": ("decoupled",), "analysis": ("rigid", "decoupled")}


def given_input(subject: Subject) -> Section:
    """Return the section with the drawing of the dam and all fields that the case gives."""
    rows = _rows(subject, given=True)
    text = (
        f"All that the case says, in {_SYSTEMS[subject.units]} units per metre of dam; x points downstream, z up. "
        "What it leaves to the program’s defaults is in the appendix."
    )
    return Section(
        "Input",
        (
            paragraph(text),
            Table(("field", "value", "meaning"), rows, "Given by the case.", "lll", (3.8, 2.7, 5.7)),
            *subject.figure("section"),
        ),
    )


def defaults(subject: Subject) -> Section:
    """Return the appendix with all fields at their defaults."""
    rows = _rows(subject, given=False)
    return Section(
        "Appendix: defaults",
        (
            paragraph(
                f"Fields that the case does not give, with the values that were used. {_unused(subject)}".strip()
            ),
            Table(("field", "value", "meaning"), rows, "Left to defaults.", "lll", (3.8, 2.7, 5.7)),
        ),
    )


def rerun(subject: Subject) -> Section:
    """Return the section that lets anyone run the same again."""
    build = " ".join(f"{name} {version}" for name, version in build_info().items())
    digest = input_hash(subject.case, *((run.response.motion, run.response.vertical) for run in subject.runs[:1]))
    blocks: list[Block] = [
        paragraph("With the input above, this command writes this report again:"),
        Listing(subject.command or _command(subject)),
        paragraph(Strong("Build. "), Code(build)),
        paragraph(Strong("Input, SHA-256. "), Code(digest)),
        paragraph(
            "The hash covers every field of the case in SI units, defaults included, and the samples of the ground "
            "motion as used, so that the same hash and the same build mean the same numbers."
        ),
    ]
    return Section("To run it again", tuple(blocks))


def input_hash(case: Case, motions: tuple[GroundMotion, GroundMotion | None]) -> str:
    """Return the SHA-256 of a case as canonical JSON, of its mesh files and of the samples of its motions."""
    hashed = hashlib.sha256()
    text = json.dumps(case.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    hashed.update(text.encode())
    for name in (case.flexible.mesh_above, case.flexible.mesh_below):
        path = name and case.base_directory / name
        if path and path.is_file():
            hashed.update(path.read_bytes())
    for motion in motions:
        if motion is not None:
            for samples in (motion.time, motion.acceleration):
                hashed.update(np.ascontiguousarray(samples, dtype="<f8").tobytes())
    return hashed.hexdigest()


def _command(subject: Subject) -> str:
    models = [run.response.model for run in subject.runs]
    model = models[0] if len(models) == 1 else "both"
    spread = " --spread" if any(run.response.spread is not None for run in subject.runs) else ""
    return f"heeltoe run CASE.toml --model {model}{spread} --report"


def _rows(subject: Subject, *, given: bool) -> tuple[tuple[Inline, ...], ...]:
    written = subject.case.model_dump(mode="json")
    return tuple(
        (Code(path), Own(value) if path.rpartition(".")[2] in _OWN_WORDS else value, meaning.replace("`", ""))
        for path, value, is_given, meaning in fields(subject.case, written, units=subject.units)
        if is_given == given
    )


def _unused(subject: Subject) -> str:
    """Say which blocks the models of this report do not look at."""
    models = {run.response.model for run in subject.runs}
    blocks = [f"[{block}]" for block, owners in _OWNERS.items() if not models & set(owners)]
    return f"Fields of {' and '.join(blocks)} play no part in this report." if blocks else ""


def fields(
    model: BaseModel, written: Mapping[str, Any], prefix: str = "", *, units: str = "si"
) -> Iterator[tuple[str, str, bool, str]]:
    """Walk through all fields: path, value with its unit, whether it is given, meaning; blocks of fields come last."""
    blocks = []
    for name, info in type(model).model_fields.items():
        value = getattr(model, name)
        if isinstance(value, BaseModel):
            blocks.append((value, written[name], f"{prefix}{name}."))
        elif isinstance(value, tuple) and value and isinstance(value[0], BaseModel):
            blocks += [(item, written[name][k], f"{prefix}{name}[{k}].") for k, item in enumerate(value)]
        else:
            meaning = " ".join((info.description or "").split())
            text = written[name] if name in _OWN_WORDS and written[name] else shown(written[name], units)
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
        return _plain(value)
    text = str(value)
    match = _QUANTITY.fullmatch(text)
    return text if match is None else _quantity(float(match[1]), match[2], units)


def shown_list(values: list[Any], units: str) -> str:
    """Write the parts of a point."""
    return ", ".join(shown(value, units) for value in values)


def _quantity(number: float, unit: str, units: str) -> str:
    if units == "us" and unit in UNITS:
        factor, quantity = UNITS[unit]
        to = scale(quantity, number * factor)
        return f"{number * factor * to.factor:.6g} {to.unit}"
    if unit == "m" and 0.0 < abs(number) < _LEAST_METRES:
        return f"{_plain(1e3 * number)} mm"
    for least, larger in _LARGER.get(unit, ()):
        if abs(number) >= least:
            return f"{_plain(number / least)} {larger}"
    if unit == "rad":
        return f"{_plain(np.degrees(number).item())}°"
    return f"{_plain(number)} {_UNITS.get(unit, unit)}"


def _plain(number: float) -> str:
    return f"{number:.7g}"
