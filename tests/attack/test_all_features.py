"""Random cases over every field and feature, and every pair of features: an answer that does not contradict itself, or
one sentence. ``make attack`` tries many more, see docs/validation/attack.md."""

from __future__ import annotations

import itertools
import json
import random
from pathlib import Path
from typing import Any

import pytest

from heeltoe import InputError, read_case
from heeltoe.case.combinations import supports
from shared.attack_page import CASES, SEED
from shared.attacked import Attack
from shared.contradictions import contradictions
from shared.features import CHANGES, pair_fields, same_field
from shared.random_features import random_case

#: No run may compute longer [s]; the cases allow 20 s (``analysis.time_limit``).
HANGS = 30.0
USERS = {
    "rigid": ("rigid",),
    "decoupled": ("decoupled",),
    "flexible": ("flexible",),
    "both": ("flexible", "beside", "rigid"),
}
USERS["statics"] = ("flexible",)


def strike(strikes: Attack, what: str, model: str, fields: dict[str, Any], place: Path) -> str:
    """Run a case, and look at what it answers."""
    (place / "case.json").write_text(json.dumps(fields))
    command = ("statics",) if model == "statics" else ("run", "--model", model)
    return strikes.strike(what, *command, "case.json", "--json", "-", cwd=place, data=True, judge=contradictions)


def attack(seeds: range, place: Path, record_property: Any) -> None:
    strikes = Attack("random cases of all features", seconds=HANGS)
    for seed in seeds:
        model, fields = random_case(random.Random(seed))
        strike(strikes, f"random_case(random.Random({seed})), {model}", model, fields, place)
    strikes.report(record_property)


@pytest.mark.slow
def test_some_random_cases(tmp_path, record_property):
    attack(range(34_000, 34_040), tmp_path, record_property)


@pytest.mark.product
@pytest.mark.parametrize("part", range(10))
def test_many_random_cases(part, tmp_path, record_property):
    first = SEED * 1_000_000 + part * 100_000
    attack(range(first, first + CASES // 10), tmp_path, record_property)


PAIRS = [
    (*pair, model)
    for pair in itertools.combinations(CHANGES, 2)
    if not same_field(*pair) and "meshes from files" not in pair
    for model in USERS
]


def attack_pairs(pairs: list[tuple[str, str, str]], place: Path, record_property: Any) -> None:
    """What the table of features says of each pair is so: it runs, or is refused by the table."""
    strikes = Attack("pairs of features", seconds=HANGS)
    for one, other, model in pairs:
        fields = pair_fields(one, other)
        try:
            case = read_case(fields)
            # A chain needs something below its crack.
            at_base = model == "decoupled" and case.crack.elevation == 0.0
            runs = not at_base and all(supports(case, user) for user in USERS[model])
            # The slip for the static checks comes from a run of the model that fits, which may refuse the pair.
            either = model == "statics" and not runs
        except InputError:
            runs = either = False
        end = strike(strikes, f"{one}, {other}, {model}", model, fields, place)
        if (end == "refused") is runs and not either:
            strikes.defects.append(f"{one} with {other}, {model}: {end}, the table says {'yes' if runs else 'no'}")
            strikes.ends["defect"] += 1
    strikes.report(record_property)


@pytest.mark.slow
def test_some_pairs_of_features(tmp_path, record_property):
    attack_pairs(random.Random(34).sample(PAIRS, 25), tmp_path, record_property)


@pytest.mark.product
def test_all_pairs_of_features(tmp_path, record_property):
    pairs = PAIRS if len(PAIRS) <= CASES else random.Random(SEED).sample(PAIRS, CASES)
    attack_pairs(pairs, tmp_path, record_property)


# What looks for contradictions finds them.

SOUND: dict[str, Any] = {
    "model": "rigid",
    "outcome": "ok",
    "verdict": "As a rigid block, the dam slides 10.0 mm downstream. A limit is not met: so it is.",
    "residual_slip_m": 0.01,
    "peak_slip_downstream_m": 0.02,
    "peak_slip_upstream_m": 0.0,
    "opening_upstream_m": 0.0,
    "opening_downstream_m": 0.0,
    "rocking_downstream_rad": 0.0,
    "rocking_upstream_rad": 0.0,
    "crack_width_m": 1.0,
    "energy": {"residual": 0.0},
    "warnings": [],
    "limits": [{"name": "residual_slip", "value": 0.01, "allowed": 0.005, "met": False, "utilisation": 2.0}],
}


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ({}, None),
        ({"residual_slip_m": 0.03}, "outside its extremes"),
        ({"outcome": "overturned"}, "outcome overturned"),
        ({"outcome": "unstable"}, "outcome unstable"),
        ({"verdict": "As a rigid block, the dam slides 10 mm."}, "limits"),
        (
            {"limits": [{"name": "residual_slip", "value": 0.01, "allowed": 0.005, "met": True, "utilisation": 2.0}]},
            "limit",
        ),
        (
            {"limits": [{"name": "residual_slip", "value": 0.02, "allowed": 0.005, "met": False, "utilisation": 2.0}]},
            "limit on",
        ),
        ({"opening_upstream_m": -1.0}, "opening_upstream_m"),
        ({"energy": {"residual": 0.1}}, "energy"),
        ({"crack_width_m": float("nan")}, "crack_width_m is nan"),
        ({"joint": {"cracked_length_m": 1.1}}, "cracked length"),
    ],
)
def test_contradictions_are_found(change, part):
    sentences = contradictions(SOUND | change)
    assert any(part in sentence for sentence in sentences) if part else not sentences
