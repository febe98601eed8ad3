"""The memory that random elastic dams take at their peak, beside what is said before."""

from __future__ import annotations

import json
import math
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from shared.attack_page import CASES, SEED
from shared.attacked import Attack
from shared.every_field import Fields

#: Below this [B] a message says "0.1 GB", and libraries keep as much for themselves.
NOTED = 3e7
#: Each in a process that has only loaded what all need: a heap that has been used has room that no one counts.
PEAKS = """
import json, os, sys
from pathlib import Path
from heeltoe import InputError, flexible, read_case
from heeltoe.models.run import cost_of

def resident(name):
    return next(int(line.split()[1]) * 1024 for line in Path("/proc/self/status").open() if line.startswith(name))

def peaks(fields, step):
    Path("/proc/self/clear_refs").write_text("5")
    before = resident("VmRSS")
    try:
        case = read_case(fields)
        flexible(case, output_step=step)
    except InputError:
        return 0.0, 0.0
    return resident("VmHWM") - before, cost_of(case, "flexible", step).memory

small, *loads = json.loads(sys.argv[1])
peaks(*small)
for load in loads:
    if os.fork() == 0:
        peaks(*small)  # what lies in files comes to a process when it is used
        print(json.dumps(peaks(*load)), flush=True)
        os._exit(0)
    os.wait()
"""


def random_load(draw: random.Random) -> tuple[Fields, float | None]:
    """Return an elastic dam that takes a megabyte or several hundred, and the step of its frames [s]."""
    height = draw.uniform(20.0, 150.0)
    across = round(math.exp(draw.uniform(math.log(2.0), math.log(28.0))))
    duration = draw.choice((0.2, 0.2, 1.0, 5.0))
    fields: Fields = {
        "section": {"height": f"{height} m", "crest_width": f"{0.1 * height} m", "base_width": f"{0.75 * height} m"},
        "concrete": {"modulus": f"{draw.uniform(10.0, 40.0)} GPa"},
        "crack": {"elevation": f"{draw.choice((0.0, 0.2)) * height} m", "friction": 1.0},
        "reservoir": {"depth": f"{0.9 * height} m", "compressible": draw.random() < 0.25},
        "motion": {"points": [["0 s", "0 g"], ["0.1 s", "0.3 g"], [f"{duration} s", "0 g"]], "sign": "recorded"},
        "flexible": {"elements_across": across, "evidence": draw.choice(("none", "none", "step"))},
        "analysis": {"silence": "0 s", "time_limit": "30 s", "memory_limit": "4 GB"},
    }
    if draw.random() < 0.3:
        levels = draw.choice(((0.6,), (0.5, 0.8)))
        fields["further_cracks"] = [{"elevation": f"{level * height} m"} for level in levels]
    if draw.random() < 0.2:
        fields["rock"] = {"modulus": f"{draw.uniform(5.0, 60.0)} GPa"}
    if draw.random() < 0.2:
        fields["flexible"]["modes"] = draw.choice((20, 300, 100_000))
    if draw.random() < 0.2:
        fields["flexible"]["elements_away"] = max(across // 3, 2)
    if draw.random() < 0.2:
        fields["flexible"]["time_step"] = "5e-5 s"
    return fields, draw.choice((None, None, 0.001))


def attack(seeds: range, record_property: Any) -> None:
    loads, strikes = [random_load(random.Random(seed)) for seed in seeds], Attack("memory beside its estimate")
    dry = {name: loads[0][0][name] for name in ("section", "concrete", "crack", "motion", "analysis")}
    # The libraries that water with sound and rock call lie in files, too.
    around = {"reservoir": {"depth": "15 m", "compressible": True}, "rock": {"modulus": "20 GPa"}}
    small = dry | around | {"flexible": {"elements_across": 2, "evidence": "step"}}
    child = subprocess.run(
        [sys.executable, "-c", PEAKS, json.dumps([(small, None), *loads])], capture_output=True, text=True, check=False
    )
    assert child.returncode == 0, child.stderr
    for seed, line in zip(seeds, child.stdout.splitlines(), strict=True):
        measured, estimated = json.loads(line)
        print(f"random_load(random.Random({seed})): {measured / 1e6:.0f} MB, estimated {estimated / 1e6:.0f} MB")
        low, high = sorted((max(measured, NOTED), max(estimated, NOTED)))
        end = "refused" if not estimated else "accepted" if high < 2.0 * low else "defect"
        strikes.ends[end] += 1
        if end == "defect":
            message = f"{measured / 1e6:.0f} MB, estimated {estimated / 1e6:.0f} MB"
            strikes.defects.append(f"random_load(random.Random({seed})): {message}")
    strikes.report(record_property)


pytestmark = pytest.mark.skipif(
    not Path("/proc/self/clear_refs").exists(), reason="the system does not say what was in use"
)


@pytest.mark.slow
def test_some_random_inputs_take_what_is_said(record_property):
    attack(range(39_000, 39_003), record_property)


@pytest.mark.product
@pytest.mark.parametrize("part", range(10))
def test_random_inputs_take_what_is_said(part, record_property):
    """200 of them in an attack of 20,000 cases."""
    first = SEED * 1_000_000 + 960_000 + 100 * part
    attack(range(first, first + math.ceil(CASES / 1_000)), record_property)
