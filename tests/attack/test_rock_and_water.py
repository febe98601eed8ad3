"""Random dams on elastic rock before water with sound: what always holds. ``make attack`` tries 300 of them."""

from __future__ import annotations

import math
import random
from typing import Any

import pytest

from heeltoe import read_case
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake
from shared.attack_page import CASES
from shared.random_features import pulse

# Masses and moduli so many times as large change forces and energies alone.
HEAVIER = 1.2


def drawn(seed: int) -> dict[str, Any]:
    """Return a dam on rock before water with sound, with one or two cracks, of every other one from the base up."""
    draw = random.Random(seed)
    height = draw.uniform(20.0, 150.0)
    base, crest, batter = (
        draw.uniform(0.7, 0.9) * height,
        draw.uniform(0.08, 0.15) * height,
        draw.uniform(0.0, 0.1) * height,
    )
    corners = [(0.0, 0.0), (base, 0.0), (batter + crest, height), (batter, height)]
    low = 0.0 if seed % 2 else draw.uniform(0.15, 0.4) * height
    cracks = [low] + ([draw.uniform(0.6, 0.8) * height] if draw.random() < 0.3 else [])
    water = {"compressible": True, "floor_reflection": draw.choice([0.3, 0.75, 1.0])}
    fields: dict[str, Any] = {
        "section": {"polygon": [[f"{x!r} m", f"{z!r} m"] for x, z in corners]},
        "concrete": {"modulus": f"{draw.uniform(15, 35):.4g} GPa", "density": "2400 kg/m^3"},
        "crack": {"elevation": f"{cracks[0]!r} m", "friction": round(draw.uniform(0.7, 1.2), 3)},
        "further_cracks": [{"elevation": f"{z!r} m", "friction": round(draw.uniform(0.7, 1.2), 3)} for z in cracks[1:]],
        "reservoir": water | {"depth": f"{draw.uniform(0.5, 1.0) * height!r} m", "density": "1000 kg/m^3"},
        "rock": {
            "modulus": f"{draw.uniform(3, 60):.4g} GPa",
            "poisson": round(draw.uniform(0.1, 0.35), 3),
            "density": f"{draw.uniform(2200, 2800):.5g} kg/m^3",
            "damping": draw.choice([0.0, 0.02, 0.05]),
        },
        "motion": {"points": pulse(draw)},
        "flexible": {"elements_across": 2, "evidence": "none", "modes": 8},
        "analysis": {"silence": "0 s"},
    }
    if draw.random() < 0.3:
        fields["tailwater"] = {
            "depth": f"{draw.uniform(0.1, 0.3) * height!r} m",
            "compressible": True,
            "density": "1000 kg/m^3",
        }
    return fields


def summary(fields: dict[str, Any]):
    """Run a dam; return the summaries of its cracks, and whether it stands before the earthquake."""
    case = read_case(fields)
    dam = build_flexible_dam(case)
    shaken = ShakenDam(case, dam, earthquake(case).shaking)
    return shaken.run(shaken.first_step()), dam.start.stands


def mirrored(fields: dict[str, Any]) -> dict[str, Any]:
    """Return the dam with upstream and downstream exchanged, and the ground moving the other way."""
    corners = [[float(x.split()[0]), z] for x, z in fields["section"]["polygon"]]
    image = fields | {"section": {"polygon": [[f"{-x!r} m", z] for x, z in corners[::-1]]}}
    for one, other in (("reservoir", "tailwater"), ("tailwater", "reservoir")):
        image.pop(one, None)
        if other in fields:
            image[one] = fields[other]
    points = [[time, f"{-float(value.split()[0])!r} g"] for time, value in fields["motion"]["points"]]
    return image | {"motion": {"points": points}}


def times(fields: dict[str, Any], factor: float) -> dict[str, Any]:
    """Return the dam with so many times its masses and moduli."""

    def more(block: dict[str, Any]) -> dict[str, Any]:
        scaled = {
            name: f"{factor * float(block[name].split()[0])!r} {block[name].split()[1]}"
            for name in ("modulus", "density")
            if name in block
        }
        return block | scaled

    return {name: more(block) if isinstance(block, dict) else block for name, block in fields.items()}


def faults(seed: int) -> list[str]:
    """Return what is wrong with a dam."""
    fields = drawn(seed)
    run, stands = summary(fields)
    if not stands:
        return []
    result = []

    def expect(what: str, good: bool) -> None:
        if not good:
            result.append(f"dam {seed}: {what}")

    slips = [row.slip for row in run.summaries]
    first = run.summary
    expect(f"it ends {run.outcome}", run.outcome == "ok")
    expect("a number is none", all(math.isfinite(x) for row in run.summaries for x in row.by_name().values()))
    expect(f"the ledger leaves {first.energy_residual:.1e}", first.energy_residual < 1e-9)
    taken = (first.energy_boundary, first.energy_floor, first.energy_far_end)
    expect("rock and water give energy", min(taken) > -1e-9 * first.energy_turnover)
    still = {"points": [["0 s", "0 g"], ["0.02 s", "0 g"]], "allow_zero": True}
    rest, _ = summary(fields | {"motion": still})
    expect(
        "it moves without an earthquake",
        all(row.slip == 0.0 for row in rest.summaries) and rest.summary.energy_input == 0.0,
    )
    least = 1e-3 * max(map(abs, slips)) + 1e-6
    # One or the other: rock and water of each are made anew.
    name, other, sign = (
        ("heavier", times(fields, HEAVIER), 1.0) if seed % 4 < 2 else ("mirrored", mirrored(fields), -1.0)
    )
    changed, _ = summary(other)
    off = max(abs(sign * row.slip - slip) for row, slip in zip(changed.summaries, slips, strict=True))
    expect(f"{name} it slides {off:.1e} m otherwise than {max(map(abs, slips)):.1e} m", off < least)
    return result


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_random_dams_on_rock_before_water_with_sound(seed):
    assert not faults(seed)


@pytest.mark.product
@pytest.mark.parametrize("part", range(4))
def test_many_random_dams_on_rock_before_water_with_sound(part):
    count = min(CASES, 300)
    assert not [fault for seed in range(part * count // 4, (part + 1) * count // 4) for fault in faults(seed)]
