"""Every field of a study file with every hostile value: a clear refusal or a sound plan, in time."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from heeltoe.case.distribution import Distribution
from heeltoe.study.plan.file import Study
from shared.attacked import Attack
from shared.every_field import Fields, leaves
from shared.hostile import values
from shared.studies import study_file

FRICTION = "crack.friction"
STUDY: Fields = {
    "case": "case.toml",
    "method": "latin hypercube",
    "samples": 4,
    "vary": {FRICTION: {"from": 0.3, "to": 0.6}, "concrete.density": {"from": "2300 kg/m^3", "to": "2500 kg/m^3"}},
    "correlation": [[FRICTION, "concrete.density", 0.5]],
    "motions": {"folder": "quakes", "scale": {"measure": "pga", "values": ["0.3 g"]}},
    "fragility": {"limits": {"residual_slip": ["1 mm"]}},
}
GRID: Fields = {"case": "case.toml", "vary": {FRICTION: {"from": 0.3, "to": 0.6, "count": 3}}}
EVENT = {"horizontal": ["quakes/quake-a-000.txt"]}
PERIOD = {"measure": "sa", "period": "0.3 s"}
OF = {
    "triangular": {"from": 0.3, "mode": 0.4, "to": 0.6},
    "normal": {"mean": 0.5, "std": 0.1, "lower": 0.2, "upper": 0.8},
    "lognormal": {"median": 0.5, "dispersion": 0.2},
}
DISTRIBUTIONS = {
    name: {**STUDY, "correlation": [], "vary": {FRICTION: {"distribution": name} | OF[name]}} for name in OF
}
HELPED: dict[str, Fields] = {
    "motions.files": {**STUDY, "motions": {"files": ["quakes/quake-a-000.txt"]}},
    "motions.events": {**STUDY, "motions": {"events": [EVENT]}},
    "motions.scale.period": {**STUDY, "motions": {"folder": "quakes", "scale": PERIOD | {"values": ["0.3 g"]}}},
    "fragility.period": {**STUDY, "fragility": {"limits": {"rotation": [0.01]}, **PERIOD}},
    **{
        f"vary.{field}": DISTRIBUTIONS[name]
        for name, fields in OF.items()
        for field in fields
        if field not in ("from", "to")
    },
    "vary.count": GRID,
}
#: Numbers as they would be given for some field that varies.
QUANTITIES = (None, "kg/m^3", "g", "s", "mm")


def paths() -> Iterator[tuple[str, ...]]:
    """Walk the schema: the way to every field that holds a value."""
    names = {f"vary.{name}" for name in Distribution.model_fields}
    for path, _ in leaves(Study):
        way = path.replace("from_", "from").replace("events[0]", "events").split(".")
        if path in names:
            yield "vary", FRICTION, *way[1:]
        elif path.startswith("motions.processing"):
            # Its steps are those of a case, read by the same code.
            yield "motions", "processing"
        elif path.startswith("motions.events"):
            yield "motions", "events", "0", way[-1]
        else:
            yield tuple(way)
    yield from [("vary",), ("vary", FRICTION), ("correlation", "0"), ("correlation", "0", "2"), ("motions", "scale")]
    yield from [("motions",), ("motions", "events"), ("fragility",), ("fragility", "limits")]


def cases() -> Iterator[tuple[tuple[str, ...], Any, Fields]]:
    """Walk all fields with all values: the way, the value, and the study that gets it."""
    for way in dict.fromkeys(paths()):
        plain = ".".join(key for key in way if key not in (FRICTION, "0"))
        base = HELPED.get(plain) or (HELPED["motions.events"] if "events" in way else STUDY)
        tried = [value for unit in QUANTITIES for value in values(unit)[0 if unit is None else len(values()) :]]
        yield from ((way, value, base) for value in tried)


def with_it(way: tuple[str, ...], value: Any, base: Fields) -> Fields:
    fields = copy.deepcopy(base)
    block: Any = fields
    if "values" in way[:-1]:
        fields["motions"]["scale"]["values"] = {"from": "0.2 g", "to": "1 g"}
    for name in way[:-1]:
        block = block[int(name)] if isinstance(block, list) else block.setdefault(name, {})
    block[int(way[-1]) if isinstance(block, list) else way[-1]] = value
    return fields


def attack(place: Path, every: int, record_property: Any) -> None:
    file, strikes = study_file(place, "", "study.json"), Attack("fields of a study")
    for number, (way, value, base) in enumerate(cases()):
        if number % every:
            continue
        file.write_text(json.dumps(with_it(way, value, base)), encoding="utf-8", errors="surrogatepass")
        strikes.strike(f"{'.'.join(way)} = {value!r}", "study", "study.json", "--dry-run", cwd=place)
    strikes.report(record_property)


@pytest.mark.parametrize("fields", [STUDY, GRID, *HELPED.values()])
def test_without_hostile_values_a_study_is_sound(fields, tmp_path):
    file, strikes = study_file(tmp_path, "", "study.json"), Attack("studies")
    file.write_text(json.dumps(fields))
    assert strikes.strike("", "study", "study.json", "--dry-run", cwd=tmp_path) == "accepted", strikes.defects


def test_some_values_of_every_field(tmp_path, record_property):
    attack(tmp_path, 83, record_property)


@pytest.mark.product
def test_many_values_of_every_field(tmp_path, record_property):
    attack(tmp_path, 3, record_property)
