"""Every field of the schema with every hostile value: a clear refusal or a sound run, in time."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from pydantic import WithJsonSchema
from pydantic.fields import FieldInfo

from heeltoe import read_case
from heeltoe.case.field_usage import READ_BY
from heeltoe.units.parse import DIMENSIONS
from shared.attacked import Attack
from shared.every_field import GONE, Fields, leaves, pair, put
from shared.hostile import values

ALL = dict(leaves())
UNITS = {shown.example: shown.unit for shown in DIMENSIONS.values()}
MODELS = ("rigid", "decoupled", "flexible", "statics")
# A record for the fields that are about records: 0.01 s apart, in g.
RECORD = "\n".join(f"{0.01 * k:.2f} {(-1) ** (k // 7) * 0.4}" for k in range(60))


@pytest.fixture
def place(tmp_path) -> Path:
    (tmp_path / "record.txt").write_text(f"# units: time [s], acceleration [g]\n{RECORD}\n")
    (tmp_path / "corners.csv").write_text("0,0\n26,0\n5,30\n0,30\n")
    return tmp_path


def help_of(place: Path) -> dict[str, tuple[Fields, Any]]:
    """Return what must be in a case that has the fields of records and of sections in files."""
    corners = {"section": {"file": str(place / "corners.csv"), "unit": "m"}}
    beside: dict[str, tuple[Fields, Any]] = {f"section.{name}": (corners, "1") for name in ("file", "layer", "unit")}
    (place / "fit.toml").write_text("[crack]\nfriction = 0.6\n")
    beside["crack.fit"] = (dict.fromkeys(("crack.static_friction", "crack.kinetic_friction"), GONE), "fit.toml")
    for block in ("motion", "motion.vertical", "motion.cross_valley"):
        file = {block: {"file": str(place / "record.txt")}}
        for name in ("file", "channel", "unit", "time_step"):
            beside[f"{block}.{name}"] = (file, "1")
        beside |= {f"{block}.layout": (file, "columns"), f"{block}.factor": (file, 1.0)}
        beside |= {f"{block}.points": ({}, []), f"{block}.pga": ({}, "0.5 g")}
    return beside | {"motion.duration": ({}, "1 s"), "motion.allow_zero": ({}, True)}


def unit_of(field: FieldInfo) -> str | None:
    """Return the unit of a quantity by the example that the schema gives; none for what is no quantity."""
    for part in field.metadata:
        if isinstance(part, WithJsonSchema) and part.json_schema:
            return next((UNITS[example] for example in part.json_schema.get("examples", ()) if example in UNITS), None)
    return None


def cases(place: Path) -> Iterator[tuple[str, Any, Callable[[], Fields]]]:
    """Walk all fields with all values: path, value and what makes the fields of the case."""

    def with_it(before: Fields, written: str, value: Any) -> Fields:
        fields: Fields = json.loads(json.dumps(before))
        # An estimate refuses runs that honestly take long, unless the case allows them.
        fields.setdefault("analysis", {}).setdefault("time_limit", "5 s")
        put(fields, written, value)
        return fields

    beside = help_of(place)
    for path, field in ALL.items():
        before, _, written = pair(path, field, beside)
        for value in values(unit_of(field)):
            yield path, value, partial(with_it, before, written, value)


def readers(path: str) -> list[str]:
    """Return the models that read a field."""
    plain = path.replace("[0]", "")
    while plain and plain not in READ_BY:
        plain = plain.rpartition(".")[0]
    return [model for model in MODELS if not plain or model in READ_BY[plain]]


def some(number: int, path: str, model: str) -> bool:
    """Whether one of some values is for a model that reads its field."""
    return number % 97 == 0 and model in readers(path)


def in_turn(number: int, path: str, model: str) -> bool:
    """Whether a value is for a model: those that read its field take turns, so that each value is tried once."""
    reading = readers(path)
    return bool(reading) and reading[number % len(reading)] == model


def attack(place: Path, model: str, chosen: Callable[[int, str, str], bool], record_property: Any) -> None:
    strikes = Attack(f"fields, {model}")
    run = set()
    for number, (path, value, made) in enumerate(cases(place)):
        if not chosen(number, path, model):
            continue
        fields = made()
        try:
            # What is the same case to us need not run again.
            same = repr(read_case(fields).model_dump())
        except Exception:  # the attack itself says what that is
            same = None
        if same in run:
            continue
        run.add(same) if same else None
        (place / "case.json").write_text(json.dumps(fields), encoding="utf-8", errors="surrogatepass")
        command = ("statics",) if model == "statics" else ("run", "--model", model)
        strikes.strike(f"{path} = {value!r}", *command, "case.json", "--json", "-", cwd=place, data=True)
    strikes.report(record_property)


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_some_values_of_every_field(model, place, record_property):
    attack(place, model, some, record_property)


@pytest.mark.product
@pytest.mark.parametrize("model", MODELS)
def test_every_value_of_every_field(model, place, record_property):
    attack(place, model, in_turn, record_property)
