"""Dams of other sizes and densities, records with silence before and after, studies in another order: what changes is
known."""

from __future__ import annotations

import json
import math
import os
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from heeltoe import read_case
from heeltoe.app.live import answer
from shared.attack_page import CASES, SEED
from shared.attacked import Attack
from shared.command import command
from shared.every_field import Fields
from shared.scenes import unpacked
from shared.studies import GRID, study_file

NUMBERS = (
    "residual_slip_m",
    "peak_slip_downstream_m",
    "peak_slip_upstream_m",
    "opening_upstream_m",
    "opening_downstream_m",
)

MOVES = ("still-moves",)


def dam(
    draw: random.Random,
    *,
    watched: float,
    size: float = 1.0,
    dense: float = 1.0,
    before: float = 0.0,
    after: float = 0.0,
    cut: float = 0.0,
    mirrored: bool = False,
) -> Fields:
    """Return a dam, the same for a generator in the same state but for its size, its densities and stiffness, silence
    [s] around its motion, and the part of this that the case cuts away; for its mirror image, too, and for how long it
    is watched after its motion [s]."""
    height, width = draw.uniform(5.0, 60.0), draw.uniform(0.5, 0.9)
    depth, crack = height * draw.uniform(0.5, 1.0), height * draw.choice((0.0, 0.25))
    peak = draw.uniform(0.3, 1.5)
    times = sorted(round(draw.uniform(0.05, 1.0), 3) for _ in range(6))
    points = [(time, round(draw.uniform(-peak, peak), 3)) for time in times]
    end, slower = times[-1] + 0.25, size**0.5
    points = [(0.0, 0.0), *points, (end, 0.0)]
    points = [((time + before) * slower, value) for time, value in points]
    points = [*([(0.0, 0.0)] if before else []), *points, *([(points[-1][0] + after, 0.0)] if after else [])]
    way = -1.0 if mirrored else 1.0
    motion: Fields = {"points": [[f"{time!r} s", f"{way * value!r} g"] for time, value in points], "sign": "recorded"}
    if cut:
        ends = before * cut, before + end + after * (1.0 - cut)
        motion["processing"] = [{"step": "window", "start": f"{ends[0]!r} s", "end": f"{ends[1]!r} s"}]
    corners = [(0.0, 0.0), (width * height, 0.0), (0.08 * height, 0.9 * height), (0.08 * height, height), (0.0, height)]
    if mirrored:
        corners = [(-x, z) for x, z in reversed(corners)]
    return {
        "section": {"polygon": [[f"{x * size!r} m", f"{z * size!r} m"] for x, z in corners]},
        "concrete": {"density": f"{2400.0 * dense} kg/m^3", "modulus": f"{25e9 * dense * size!r} Pa"},
        "crack": {"elevation": f"{crack * size!r} m", "friction": draw.uniform(0.5, 1.1)},
        "tailwater" if mirrored else "reservoir": {
            "depth": f"{depth * size!r} m",
            "density": f"{1000.0 * dense} kg/m^3",
            "compressible": False,
        },
        # Rock and sound would have to be scaled, too.
        "rock": "rigid",
        "motion": motion,
        "flexible": {"elements_across": 2, "evidence": "none"},
        "analysis": {"silence": f"{watched * slower} s"},
    }


def numbers(fields: Fields, model: str, place: Path) -> dict[str, float] | None:
    """Return what the command says of a dam; None without a result, and of one that still moves in the end: how far it
    has slid then depends on how long it was watched."""
    (place / "case.json").write_text(json.dumps(fields))
    reply = command("run", "case.json", "--model", model, "--json", "-", cwd=place)
    assert reply.returncode != 2, reply.stderr
    answer: dict[str, Any] = json.loads(reply.stdout) if reply.returncode == 0 else {"outcome": reply.stderr}
    if answer["outcome"] != "ok" or any(warning["code"] in MOVES for warning in answer["warnings"]):
        return None
    return {name: answer[name] for name in NUMBERS}


def image(slips: dict[str, float]) -> dict[str, float]:
    """Return the numbers of a mirror image."""
    residual, down, up, heel, toe = (slips[name] for name in NUMBERS)
    return dict(zip(NUMBERS, (-residual, -up, -down, toe, heel), strict=True))


Change = dict[str, Any]
#: How long a model is watched after the motion [s]: an elastic dam rests within seconds, and its silence costs.
WATCHED = {"rigid": 60.0, "flexible": 4.0}
#: How a dam is changed, how many times as long its slips are then, the models, and how closely.
LAWS: dict[str, tuple[Change, float, str, float]] = {
    "size of a block": ({"size": 4.0}, 4.0, "rigid", 1e-9),
    "densities of a block": ({"dense": 1.7}, 1.0, "rigid", 1e-9),
    "silence after the motion of a block": ({"after": 0.5}, 1.0, "rigid", 1e-9),
    "silence before the motion of a block": ({"before": 0.5}, 1.0, "rigid", 1e-9),
    "cut in the silence around the motion of a block": (
        {"before": 0.5, "after": 0.5, "cut": 0.6},
        1.0,
        "rigid",
        1e-9,
    ),
    "mirror image of a block": ({"mirrored": True}, 1.0, "rigid", 1e-9),
    # The vibration that friction excites in an elastic dam lets rounding grow.
    "mirror image of an elastic dam": ({"mirrored": True}, 1.0, "flexible", 1e-7),
    "cut of the silence after the motion of an elastic dam": ({"after": 0.5, "cut": 1.0}, 1.0, "flexible", 0.0),
    # Four times the numbers, and twice their roots, round as they do without: nothing may differ at all.
    "densities of an elastic dam": ({"dense": 0.25}, 1.0, "flexible", 0.0),
}


def attack(law: str, seeds: range, place: Path, record_property: Any) -> None:
    change, factor, model, close = LAWS[law]
    strikes = Attack(f"laws: {law}")
    for seed in seeds:
        one = numbers(dam(random.Random(seed), watched=WATCHED[model]), model, place)
        other = numbers(dam(random.Random(seed), watched=WATCHED[model], **change), model, place)
        known = len(strikes.defects)
        if (one is None) is not (other is None):
            strikes.defects.append(f"dam(random.Random({seed})): {one}, {other}")
        elif one and other:
            other = image(other) if change.get("mirrored") else other
            size = max(abs(value) for value in one.values())
            wrong = {name for name in one if abs(other[name] - factor * one[name]) > close * factor * size}
            strikes.defects += [f"dam(random.Random({seed})), {name}: {one[name]!r}, {other[name]!r}" for name in wrong]
        strikes.ends["defect" if len(strikes.defects) > known else "accepted" if one else "no result"] += 1
    assert strikes.ends["accepted"]
    strikes.report(record_property)


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
def test_some_dams_obey_the_laws(law, tmp_path, record_property):
    attack(law, range(37_000, 37_006), tmp_path, record_property)


@pytest.mark.product
@pytest.mark.parametrize("law", LAWS)
def test_dams_obey_the_laws(law, tmp_path, record_property):
    first = SEED * 1_000_000 + 970_000
    attack(law, range(first, first + CASES // 10), tmp_path, record_property)


def attack_the_app(seeds: range, place: Path, record_property: Any) -> None:
    """The app says what the shell does, and draws the slip that this returns."""
    strikes = Attack("laws: app and shell")
    for seed in seeds:
        draw = random.Random(seed)
        model, fields = draw.choice(("rigid", "decoupled")), dam(draw, watched=WATCHED["rigid"])
        (place / "case.json").write_text(json.dumps(fields))
        reply = command("run", "case.json", "--model", model, "--json", "-", cwd=place)
        if reply.returncode == 2:  # a chain has something below its crack
            strikes.ends["refused"] += 1
            continue
        shell, app = json.loads(reply.stdout), answer(read_case(fields), {}, model, "si")
        same = (app["verdict"], app["ok"]) == (shell["verdict"], shell["outcome"] == "ok")
        if same and app["ok"]:
            # The curve has numbers of four bytes.
            slip = 1e-3 * float(unpacked(app["curves"]["slip"]["values"])[-1])
            same = math.isclose(slip, shell["residual_slip_m"], rel_tol=1e-6, abs_tol=1e-9)
        strikes.ends["defect" if not same else "accepted" if app["ok"] else "no result"] += 1
        if not same:
            strikes.defects.append(f"{seed}, {model}: {app['verdict']!r}, {shell['verdict']!r}")
    strikes.report(record_property)


def test_the_app_answers_some_dams_as_the_shell(tmp_path, record_property):
    attack_the_app(range(37_000, 37_006), tmp_path, record_property)


@pytest.mark.product
def test_the_app_answers_as_the_shell(tmp_path, record_property):
    first = SEED * 1_000_000 + 970_000
    attack_the_app(range(first, first + CASES // 10), tmp_path, record_property)


# Studies

REORDERED = GRID.replace('"crack.friction" = [0.3, 0.5]\n', "").replace(
    "[motions]", '"crack.friction" = [0.3, 0.5]\n[motions]'
)


def rows(out: Path) -> dict[tuple[Any, ...], float]:
    """Return the slip of each run of a study by what makes it."""
    tables = [pq.read_table(path).to_pylist() for path in sorted((out / "runs").glob("*.parquet"))]
    names = ("crack.friction", "crack.restitution", "motion", "factor")
    return {
        tuple(row[name] for name in names if name in row): row["residual_slip_m"] for rows in tables for row in rows
    }


def ran(out: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted((out / "runs").glob("*.parquet"))}


@pytest.mark.slow
@pytest.mark.usefixtures("empty_figures")
def test_studies_in_another_order_and_resumed(tmp_path, record_property):
    strikes = Attack("laws: studies")
    one, other = study_file(tmp_path, GRID), study_file(tmp_path, REORDERED, "other.toml")
    assert REORDERED != GRID
    for file, out in ((one, "one"), (other, "other")):
        assert strikes.strike(out, "study", file, "--out", out, cwd=tmp_path) == "accepted", strikes.defects
    whole = rows(tmp_path / "one")
    assert len(whole) > 10
    assert whole == rows(tmp_path / "other")
    before = ran(tmp_path / "one")
    (tmp_path / "one/runs" / next(iter(before))).unlink()
    assert strikes.strike("resumed", "study", one, "--out", "one", "--resume", cwd=tmp_path) == "accepted", (
        strikes.defects
    )
    assert ran(tmp_path / "one") == before
    strikes.report(record_property)


@pytest.mark.product
def test_studies_on_one_thread_and_on_many(tmp_path, record_property):
    file, strikes = study_file(tmp_path, GRID), Attack("laws: threads")
    for threads in ("1", "4"):
        words = [sys.executable, "-m", "heeltoe", "study", str(file), "--out", str(tmp_path / threads)]
        run = subprocess.run(
            words, env=os.environ | {"RAYON_NUM_THREADS": threads}, capture_output=True, text=True, check=False
        )
        assert run.returncode == 0, run.stderr
        strikes.ends["accepted"] += 1
    assert ran(tmp_path / "1") == ran(tmp_path / "4")
    strikes.report(record_property)
