"""What elastic parts take, measured beside what is estimated before; ``pytest -s`` prints both."""

from __future__ import annotations

import json
import subprocess
import sys
import time
import tracemalloc
from dataclasses import replace
from pathlib import Path

import pytest

from heeltoe import InputError
from heeltoe.mechanics.beam import band_of
from heeltoe.models.flexible.body import bonded, rock
from heeltoe.models.flexible.body.cost import building, part_of, parts_of, surroundings_of
from heeltoe.models.flexible.body.reduced import _build
from heeltoe.models.flexible.body.reservoir import water_body
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.expected import analysing, running
from heeltoe.models.flexible.surroundings import water
from heeltoe.models.run import cost_of, earthquake
from heeltoe.study.small.analysis import analyse
from shared.dams import ROOT, example


def factor(measured, estimated):
    return max(measured / estimated, estimated / measured)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["typical-base", "typical-height"])
@pytest.mark.parametrize("across", [4, 8, 16])
def test_the_parts_are_as_expected(name, across):
    case = example(name, f"flexible.elements_across={across}")
    dam = _build(case)
    for part, body, modes in zip(parts_of(case), dam.bodies, dam.modes, strict=True):
        assert factor(body.mesh.nodes.size, part.freedoms) < 1.6
        # Some modes more where the crack asks for them.
        assert factor(modes.omega_squared.size, replace(part, freedoms=body.mesh.nodes.size).modes) < 1.3
    meshed = building([part_of(case, body.mesh.crack.size, body.mesh.nodes.size) for body in dam.bodies])
    assert factor(meshed.seconds, building(parts_of(case)).seconds) < 1.6


@pytest.mark.slow
@pytest.mark.parametrize("name", ["typical-base", "typical-height"])
@pytest.mark.parametrize("across", [8, 16, 32])
def test_time(name, across):
    """Other work on the machine, and its make, are in the factor."""
    case = example(name, f"flexible.elements_across={across}", "motion.duration=6s", "flexible.evidence=none")
    bonded._KEPT.clear()
    begun = time.process_time()
    dam = _build(case)
    built = time.process_time()
    shaken = ShakenDam(case, dam, earthquake(case).shaking)
    shaken.run(shaken.first_step(), 0.01)
    ran = time.process_time()
    for message, measured, estimated in (
        ("building", built - begun, building(parts_of(case)).seconds),
        ("running", ran - built, running(case, 6.0, 0.01).seconds),
    ):
        print(f"{name}, {across} across, {message}: {measured:.2f} s, estimated {estimated:.2f} s")
        assert factor(measured, estimated) < 6.0


@pytest.mark.slow
def test_time_of_all_modes():
    """A dense problem; seven times as much was said before."""
    case = example("typical-base", "flexible.elements_across=12", "flexible.modes=100000")
    bonded._KEPT.clear()
    begun = time.process_time()
    _build(case)
    measured, estimated = time.process_time() - begun, building(parts_of(case)).seconds
    print(f"all modes: {measured:.2f} s, estimated {estimated:.2f} s")
    assert factor(measured, estimated) < 4.0


@pytest.mark.slow
@pytest.mark.parametrize(("modulus", "crack"), [("2 GPa", "0 m"), ("2 GPa", "25 m")])
def test_soft_rock_has_more_elements_for_its_shorter_waves(modulus, crack):
    """They are counted: rock of 2 GPa takes five times as long as rock of 40 GPa."""
    case = example("typical-base", f"crack.elevation={crack}", f"rock={{modulus='{modulus}'}}")
    case = case.with_("flexible.elements_across=3")
    rock._KEPT.clear()
    begun = time.process_time()
    _build(case)
    measured = time.process_time() - begun
    estimated = building(parts_of(case), surroundings_of(case)).seconds
    print(f"rock of {modulus}, crack at {crack}: {measured:.2f} s, estimated {estimated:.2f} s")
    assert factor(measured, estimated) < 3.0


PEAK = """
import gc, json, sys
from pathlib import Path
from heeltoe import flexible, read_case
from heeltoe.models.run import cost_of

def resident(name):
    return next(int(line.split()[1]) * 1024 for line in Path("/proc/self/status").open() if line.startswith(name))

case, step = read_case(json.loads(sys.argv[1])), json.loads(sys.argv[2])
# Without rock and water, whose reduction would be kept for the run that counts.
dry = {"reservoir.compressible": False, "rock": "rigid"}
flexible(case.with_({"flexible.elements_across": 2, "flexible.modes": 20, "motion.duration": "0.1s"} | dry))
gc.collect()
Path("/proc/self/clear_refs").write_text("5")
before = resident("VmRSS")
flexible(case, output_step=step)
print(resident("VmHWM") - before, cost_of(case, "flexible", step).memory)
"""
LITTLE = 8e6
BRIEF = {"motion.duration": "0.2s", "flexible.evidence": "none", "analysis.memory_limit": "20GB"}
SECOND, THIRD = ({"further_cracks": [{"elevation": f"{level} m"} for level in levels]} for levels in ((35,), (80, 40)))
LONG = {"motion.duration": "20s", "flexible.time_step": "2e-5s"}


def slow(*values):
    return pytest.param(*values, marks=pytest.mark.product)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="the system does not say what was in use")
@pytest.mark.parametrize(
    ("name", "across", "changes"),
    [
        ("typical-base", 16, {}),
        ("typical-base", 4, LONG),
        ("typical-height", 12, SECOND),
        ("typical-base", 6, {"rock.modulus": "20 GPa"}),
        *[slow(name, across, {}) for name in ("typical-base", "typical-height") for across in (8, 32, 64)],
        slow("typical-base", 32, THIRD),
        slow("typical-height", 32, SECOND),
        slow("typical-base", 24, {"rock.modulus": "20 GPa"}),
        slow("typical-base", 16, {"flexible.elements_away": 4}),
        slow("typical-base", 12, {"flexible.modes": 2000}),
        slow("typical-base", 8, {"reservoir.compressible": True}),
    ],
)
def test_memory(name, across, changes):
    """The peak of a process of its own, beyond what it takes without the dam."""
    case = example(name).with_({"analysis.silence": "0s", "flexible.elements_across": across} | BRIEF | changes)
    fields = json.dumps(case.model_dump(mode="json", exclude_unset=True))
    step = 0.001 if changes is LONG else None
    child = subprocess.run(
        [sys.executable, "-c", PEAK, fields, json.dumps(step)], capture_output=True, text=True, cwd=ROOT / "examples"
    )
    assert child.returncode == 0, child.stderr
    measured, estimated = map(float, child.stdout.split())
    print(f"{name}, {across} across, {changes.keys()}: {measured / 1e6:.0f} MB, estimated {estimated / 1e6:.0f} MB")
    # What the run before has given back serves again: some megabytes say nothing.
    assert factor(max(measured, LITTLE), max(estimated, LITTLE)) < 2.0


@pytest.mark.parametrize(("across", "away"), [(11, 3), (12, 3), (16, 4)])
def test_a_mesh_that_cannot_be_halved_is_estimated_as_it_is(across, away):
    case = example("typical-height").with_({"flexible.elements_across": across, "flexible.elements_away": away})
    for part, mesh in zip(parts_of(case), dam_mesh(case).parts, strict=True):
        assert factor(part.freedoms, 2.0 * len(mesh.nodes)) < 2.0


@pytest.mark.slow
@pytest.mark.parametrize("depth", [10, 100])
def test_memory_of_water_with_sound(depth):
    """It grows with the depth, and is no other with a full reservoir than a metre below the crest."""
    case, lower = (
        example("typical-base", "reservoir.compressible=true", f"reservoir.depth={z} m") for z in (depth, depth - 1)
    )
    bodies = bonded.bonded_dam(case).bodies
    for kept in (water._KEPT, water._FLUIDS):
        kept.clear()
    tracemalloc.start()
    water_body(case, bodies, band_of(case))
    _, measured = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert factor(measured, surroundings_of(case).memory) < 1.3
    assert factor(surroundings_of(case).memory, surroundings_of(lower).memory) < 1.02


def test_silence_and_spread_are_counted():
    case = example("typical-base", "flexible.evidence=none", "motion.duration=20s", "flexible.time_step=0.2ms")
    alone = analysing(case, 20.0, 0.01).seconds - building(parts_of(case)).seconds
    with_silence = analysing(case, 20.0, 0.01, silence=10.0).seconds - building(parts_of(case)).seconds
    # The run that counts, and all of the silence at most.
    assert with_silence == pytest.approx(alone * (22.5 + 10.0) / 20.0, rel=1e-6)
    # A run by penalties begins anew.
    penalties = case.with_("flexible.contact=idce", "flexible.damping=stiffness")
    again = analysing(penalties, 20.0, 0.01, silence=10.0).seconds - building(parts_of(penalties)).seconds
    assert again == pytest.approx(alone * (22.5 + 30.0) / 20.0, rel=1e-6)
    spread = analysing(case, 20.0, 0.01, spread=11).seconds - building(parts_of(case)).seconds
    assert spread == pytest.approx(12.0 * alone, rel=1e-6)


def test_a_spread_that_takes_too_long_is_refused_before_anything_runs(monkeypatch):
    case = example("typical-base", "flexible.evidence=none", "flexible.elements_across=2", "motion.duration=1s")
    few, many = (cost_of(case, "flexible", spread=runs).seconds for runs in (11, 1000))
    limited = case.with_({"analysis.time_limit": f"{(few + many) / 2.0} s"})
    monkeypatch.setattr("heeltoe.study.small.analysis.run", lambda *given, **named: pytest.fail("it ran"))
    with pytest.raises(InputError) as refused:
        analyse(limited, "flexible", spread=1000)
    assert (refused.value.code, refused.value.field) == ("too-costly", "--spread")


WATER, ROCK = {"reservoir.compressible": True}, {"rock.modulus": "20 GPa"}
BOND = {"tensile_strength": "0.5 MPa", "cohesion": "1 MPa", "fracture_energy": "100 N/m", "shear_energy": "500 N/m"}


@pytest.mark.slow
@pytest.mark.parametrize("changes", [WATER, ROCK, {"crack.bond": BOND}, WATER | {"crack.bond": BOND}])
@pytest.mark.parametrize("across", [4, pytest.param(16, marks=pytest.mark.product)])
def test_water_with_sound_rock_and_bonds_are_counted(changes, across):
    """A step takes up to five times as long with them; other work on the machine is in the factor."""
    bare = example("typical-base", f"flexible.elements_across={across}", "motion.duration=3s", "flexible.evidence=none")
    case = bare.with_(changes)
    for kept in (bonded._KEPT, rock._KEPT, water._KEPT, water._FLUIDS):
        kept.clear()
    begun = time.process_time()
    shaken = ShakenDam(case, _build(case), earthquake(case).shaking)
    shaken.run(shaken.first_step(), 0.01)
    measured = time.process_time() - begun
    estimated = building(parts_of(case), surroundings_of(case)) + running(case, 3.0, 0.01)
    print(f"{across} across, {changes.keys()}: {measured:.2f} s, estimated {estimated.seconds:.2f} s")
    assert factor(measured, estimated.seconds) < 6.0
    assert estimated.seconds > 1.1 * (building(parts_of(bare)) + running(bare, 3.0, 0.01)).seconds
