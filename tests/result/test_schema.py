"""The JSON of every kind of result is as its schema says, and a JSON that is not so is found."""

from __future__ import annotations

import json

import pytest

from heeltoe import read_case, rigid, run, with_spread
from heeltoe.result.schema import run_schema
from heeltoe.result.write import json_text
from shared.command import command
from shared.dams import FAST, HEIGHT, KOYNA, example

KINDS = {
    "object": dict,
    "array": list,
    "string": str,
    "number": int | float,
    "integer": int,
    "boolean": bool,
    "null": type(None),
}


def wrong(value, schema, root, path="result"):
    """Walk what of a value is not as a schema says; what JSON schema knows beyond our own schemas is not looked at."""
    if "$ref" in schema:
        schema = root["$defs"][schema["$ref"].rpartition("/")[2]]
    if "anyOf" in schema:
        tries = [list(wrong(value, option, root, path)) for option in schema["anyOf"]]
        if all(tries):
            yield from min(tries, key=len)
        return
    if "enum" in schema and value not in schema["enum"]:
        yield f"{path}: {value!r} is none of {schema['enum']}"
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    fits = [isinstance(value, KINDS[kind]) and isinstance(value, bool) <= (kind == "boolean") for kind in kinds]
    if kinds and not any(fits):
        yield f"{path}: {type(value).__name__} is no {' or '.join(kinds)}"
        return
    if isinstance(value, dict):
        for name in schema.get("required", ()):
            if name not in value:
                yield f"{path}.{name}: missing"
        for name, inner in value.items():
            of = schema.get("properties", {}).get(name, schema.get("additionalProperties"))
            if of is not None:
                yield from wrong(inner, of, root, f"{path}.{name}")
    elif isinstance(value, list) and "items" in schema:
        for k, inner in enumerate(value):
            yield from wrong(inner, schema["items"], root, f"{path}[{k}]")


@pytest.fixture(scope="module")
def results():
    """JSON of every kind of result."""
    height = read_case(HEIGHT, FAST)
    law = {"name": "slip weakening", "peak_friction": 0.9, "residual_friction": 0.6, "slip": "20 mm"}
    full = read_case(KOYNA, [*FAST, "concrete.tensile_strength=1MPa", "motion.duration=1s"])
    result = {
        "block": rigid(example("block")),
        "both": run(full.with_("flexible.evidence=step"), "both"),
        "cracks": run(example("two-cracks", *FAST, "limits.residual_slip=1mm"), "flexible"),
        "blocks": run(example("two-cracks", *FAST), "rigid"),
        "aftershocks": run(example("aftershocks", *FAST), "rigid"),
        "chain": run(full, "decoupled"),
        "law": run(example("typical-base", *FAST).with_({"crack": {"friction": None, "law": law}}), "both"),
        "rough": run(example("rough-crack", *FAST), "rigid"),
        "spread": with_spread(run(height, "rigid"), height, 2),
        "unstable": rigid(example("typical-base", "crack.friction=0.2")),
    }
    return {name: json.loads(json_text(response.to_json())) for name, response in result.items()}


def test_every_kind_of_result_is_as_the_schema_says(results):
    schema = run_schema()
    for name, data in results.items():
        assert list(wrong(data, schema, schema)) == [], name


def test_every_key_of_a_result_is_in_the_schema(results):
    known = run_schema()["$defs"]["result"]["properties"].keys()
    for name, data in results.items():
        assert data.keys() - known == set(), name


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"residual_slip_m": "0.1"}, "residual_slip_m: str is no number"),
        ({"outcome": "fine"}, "outcome: 'fine' is none of"),
        ({"impacts": 1.5}, "impacts: float is no integer"),
        ({"slip_by_mode_m": {"sliding": 0.1}}, "slip_by_mode_m.slide_rocking: missing"),
        ({"limits": [{"met": True}]}, r"limits\[0\].name: missing"),
    ],
)
def test_a_result_that_is_not_so_is_found(results, change, what):
    schema = run_schema()
    (first, *_) = wrong(results["block"] | change, schema, schema)
    with pytest.raises(AssertionError, match=what):
        raise AssertionError(first)


def test_units_and_meanings_stand_in_it():
    slip = run_schema()["$defs"]["result"]["properties"]["residual_slip_m"]
    assert (slip["type"], slip["unit"]) == ("number", "m")
    assert slip["description"] == "Slip at the end, positive downstream."


def test_the_command_prints_it():
    printed = command("explain", "--schema")
    assert printed.returncode == 0
    assert json.loads(printed.stdout) == json.loads(json_text(run_schema()))
