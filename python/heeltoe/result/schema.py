"""The JSON schema of ``heeltoe run --json``, from the typed blocks of a result."""

from __future__ import annotations

from typing import Any

from heeltoe.base.blocks import Block, json_schema
from heeltoe.mechanics.block import CriticalAccelerationsInG, StaticState
from heeltoe.result.contract import HEADLINES
from heeltoe.result.crest import CrestMotion
from heeltoe.result.judge import LimitCheck
from heeltoe.result.numbers import (
    OF_SEVERAL,
    BlockNumbers,
    Chain,
    Chosen,
    ElasticCrack,
    ElasticDam,
    Energy,
    FrictionBand,
    FrictionEffect,
    SignNumbers,
    Spread,
    Stage,
)
from heeltoe.result.outcome import Outcome
from heeltoe.result.write import MotionNumbers

_TEXT, _TEXTS = {"type": "string"}, {"type": "array", "items": {"type": "string"}}
_MODELS = ("rigid", "decoupled", "flexible")


def run_schema() -> dict[str, object]:
    """Return the schema: the keys that every result has, and those of the models by model.

    Units stand under ``unit`` beside the meaning, which is the ``description``.
    """
    result = {
        "type": "object",
        "properties": {**_of_every_run(), **_of_models()},
        "required": sorted(
            _of_every_run().keys()
            - {
                "crest",
                "spread",
                "sequence",
                "signs",
                "friction_band",
                "friction_effect",
                "cross_valley_motion",
                "ratio",
                "meaning",
                "beside",
            }
        ),
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "heeltoe run --json",
        "$defs": {"result": result},
        "$ref": "#/$defs/result",
    }


def _of_models() -> dict[str, object]:
    """Return the numbers of the crack of ``[crack]`` and of the dam, absent from a run that never started."""
    properties: dict[str, Any] = {}
    for kind in (BlockNumbers, Chain, ElasticCrack, ElasticDam):
        for name, schema in _properties(kind).items():
            known = properties.setdefault(name, schema)
            if known != schema:
                # The friction law of a block and that of an elastic dam, say.
                properties[name] = {"anyOf": [known, schema]}
    crack = {"anyOf": [json_schema(BlockNumbers), json_schema(ElasticCrack)]}
    several = {"governing_crack": {"type": "integer"}, "cracks": {"type": "array", "items": crack}}
    return {name: schema for name, schema in properties.items() if name not in OF_SEVERAL} | several


def _of_every_run() -> dict[str, object]:
    motion = json_schema(MotionNumbers)
    # What is no number is left out, and `left_out` says why.
    static = {name: schema for name, schema in _properties(StaticState).items() if name != "critical_acceleration_g"}
    ratio = {headline.key: {"type": ["number", "null"]} for headline in HEADLINES}
    return {
        "model": {"enum": list(_MODELS)},
        "chosen": _or_null(json_schema(Chosen)),
        "title": _TEXT,
        "outcome": {"enum": [str(outcome) for outcome in Outcome if outcome is not Outcome.REFUSED]},
        "advice": {"type": ["string", "null"]},
        "verdict": _TEXT,
        "warnings": {"type": "array", "items": {"type": "object", "required": ["code", "text", "severity"]}},
        "silence_s": {"type": "number", "unit": "s"},
        "critical_acceleration_g": {"type": "object", "properties": _properties(CriticalAccelerationsInG)},
        "static": {"type": "object", "properties": static},
        "left_out": {"type": "object", "additionalProperties": _TEXT},
        "energy": _or_null(json_schema(Energy)),
        "crest": json_schema(CrestMotion),
        "spread": json_schema(Spread),
        "sequence": {"type": "array", "items": json_schema(Stage)},
        "signs": {"type": "array", "items": json_schema(SignNumbers)},
        "friction_band": json_schema(FrictionBand),
        "friction_effect": json_schema(FrictionEffect),
        "limits": {"type": "array", "items": json_schema(LimitCheck)},
        "motion": motion,
        "vertical_motion": _or_null(motion),
        "cross_valley_motion": motion,
        "references": _TEXTS,
        "build": {"type": "object", "additionalProperties": _TEXT},
        "ratio": {"type": "object", "properties": ratio},
        "meaning": _TEXT,
        "beside": {"$ref": "#/$defs/result"},
    }


def _properties(kind: type[Block]) -> dict[str, Any]:
    properties: dict[str, Any] = json_schema(kind)["properties"]
    return properties


def _or_null(schema: dict[str, object]) -> dict[str, object]:
    return {"anyOf": [schema, {"type": "null"}]}
